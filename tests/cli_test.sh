#!/usr/bin/env bash
# cli_test.sh HEDDLE: what scripts may rely on: exit codes, one line for an error, old outputs kept, the same bits.
set -uo pipefail
heddle=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

wrong() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
# Mesa's threads may end while LeakSanitizer looks at them, and then it fails (1 run in 30): leaks of what draws are
# looked for by the rooms' own tests.
heddle() {
    case " $* " in
    *" view "* | *" raster "*) ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0" "$heddle" "$@" ;;
    *) "$heddle" "$@" ;;
    esac
}
# fails CODE TEXT ARGUMENT...: exit code CODE, nothing on stdout, one line on stderr that holds TEXT
fails() {
    local code=$1 text=$2
    shift 2
    heddle "$@" >out.txt 2>err.txt
    local status=$?
    [ $status -eq "$code" ] || wrong "exit code $status, not $code: heddle $* ($(cat err.txt))"
    [ ! -s out.txt ] || wrong "an error printed to stdout: heddle $*"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "not one line on stderr: heddle $*: $(cat err.txt)"
    grep -qF -- "$text" err.txt || wrong "no '$text' in: $(cat err.txt)"
}
# works ARGUMENT...: exit code 0, nothing on stderr but notes; stdout is in out.txt
works() {
    heddle "$@" >out.txt 2>err.txt || wrong "exit code $?: heddle $*: $(cat err.txt)"
    ! grep -qv '^note: ' err.txt || wrong "words on stderr: heddle $*: $(cat err.txt)"
}
# json KEY: prints the value of out.txt's key
json() {
    cat >json.cmake <<'CMAKE'
file(READ out.txt text)
string(JSON value GET "${text}" ${KEY})
file(WRITE value.txt "${value}")
CMAKE
    cmake -DKEY="$1" -P json.cmake || wrong "no key '$1' in: $(cat out.txt)"
    cat value.txt
}

# words
works
[ "$(wc -l <out.txt)" -eq 8 ] || wrong "heddle alone prints $(wc -l <out.txt) lines, not 8"
for name in $("$heddle" help-tables | sed -n 's/^## heddle \(.*\)$/\1/p'); do
    grep -qw -- "$name" out.txt || wrong "heddle alone does not name $name"
done
works --version
for command in info generate slice voxelize lod lod-report material preview render view export; do
    works "$command" --help
    grep -q -- '--threads N' out.txt || wrong "no --threads in the help of $command"
done
fails 2 "did you mean 'voxelize'?" voxelise
fails 2 "did you mean '--voxels'?" voxelize a.bcc -o a.vdb --voxles 5
fails 2 "--lobes: 9 is out of range" voxelize a.bcc -o a.vdb --lobes 9
fails 2 "option --output is missing" voxelize a.bcc
fails 2 "did you mean 'knit'?" generate knot -o a.bcc
fails 2 "must end in .bcc" generate knit -o a.obj

# inputs to work with
works generate knit --counts 6,6 -o knit.bcc
works generate grass --counts 20,4 -o grass.glb
works generate hair --counts 50,8 -o hair.hair

# a weave's file holds its warp and its weft: NX yarns of 8 NY + 3 points, NY of 8 NX + 3, as the report says
number() { od -An -t u8 -j "$1" -N 8 "$2" | tr -d ' '; }
for kind in plain twill satin; do
    works generate $kind --counts 7,5 -o weave.bcc --json
    points=$(number 16 weave.bcc)
    [ "$(number 8 weave.bcc)" -eq 12 ] || wrong "$kind: $(number 8 weave.bcc) curves are in the file, not 7 + 5"
    [ "$points" -eq $((7 * 43 + 5 * 59)) ] || wrong "$kind: $points points are in the file"
    [ "$points" -eq "$(json nodes)" ] || wrong "$kind: $points points are in the file, the report says $(json nodes)"
    [ "$(wc -c <weave.bcc)" -eq $((64 + 12 * 4 + points * 12)) ] || wrong "$kind: $(wc -c <weave.bcc) bytes"
    works info weave.bcc --json
    [ "$(json curves)" -eq 12 ] || wrong "$kind: info sees $(json curves) curves"
done

# a slice, its yarn, and OpenGL: the same bits at any thread count; one line where there is no driver
works slice cotton --size 64 -o slice.png --yarn-file slice.toml --occlusion dark.png --mipmaps sizes.png
fails 2 "is not a procedural yarn" slice slice.toml -o again.png
fails 2 "--composition needs --backend raster" voxelize knit.bcc -o a.vdb --composition max
fails 2 "--fit last cannot be used with --backend raster" voxelize knit.bcc -o a.vdb --backend raster --fit last
fails 3 "has meshes" voxelize grass.glb --voxels 32 -o a.vdb --backend raster
__EGL_VENDOR_LIBRARY_DIRS=/nonexistent fails 4 "opengl: no driver" voxelize knit.bcc --yarn-radius 0.1 --voxels 32 -o a.vdb --backend raster --quiet
for threads in 1 2; do
    works voxelize knit.bcc --yarn slice.toml --voxels 32 --backend raster --threads $threads -o "raster$threads.vdb"
done
works info raster1.vdb --json && hash1=$(json content_hash)
works info raster2.vdb --json && [ "$(json content_hash)" = "$hash1" ] || wrong "raster: other bits with 2 threads"
fails 2 "--raster-path needs --backend raster" voxelize knit.bcc -o a.vdb --raster-path compute
for path in fragment compute; do
    works voxelize knit.bcc --yarn slice.toml --voxels 32 --backend raster --raster-path $path -o path.vdb --json
    [ "$(json raster_path)" = $path ] || wrong "raster: path $path was not taken"
    works info path.vdb --json && [ "$(json content_hash)" = "$hash1" ] || wrong "raster: other bits by $path shaders"
done


# a sequence in one run: each frame has the bits of a run of its own, and is kept where a later one fails
for k in 1 2 3; do works generate knit --counts $((k + 1)),2 -o cloth_000$k.bcc; done
fails 2 "must contain the frame number exactly once" voxelize cloth.bcc --frames 1-3 -o 'o_%02d.vdb'
fails 2 "--output: 'o.vdb' must contain" voxelize 'cloth_%04d.bcc' --frames 1-3 -o o.vdb
fails 2 "is not a range" voxelize 'cloth_%04d.bcc' --frames 3-1 -o 'o_%02d.vdb'
fails 2 "it needs curves or meshes" voxelize 'cloth_%04d.vol' --frames 1-3 -o 'o_%02d.vdb'
for backend in sample raster; do
    works voxelize 'cloth_%04d.bcc' --frames 1-3:2 --yarn slice.toml --voxels 32 --backend $backend -o 'o_%02d.vdb' --json
    grep -q '"file": "cloth_0003.bcc"' out.txt || wrong "frames: no row for the second"
    [ ! -e o_02.vdb ] || wrong "frames: a step was not taken"
    works voxelize cloth_0003.bcc --yarn slice.toml --voxels 32 --backend $backend -o alone.vdb
    works info alone.vdb --json && alone=$(json content_hash)
    works info o_03.vdb --json && [ "$(json content_hash)" = "$alone" ] || wrong "frames: other bits than alone, $backend"
done
works voxelize 'cloth_%04d.bcc' --frames 1-3 --voxels 32 --dry-run -o 'dry_%02d.vdb'
[ "$(grep -c '^predicted' out.txt)" -eq 4 ] && [ ! -e dry_01.vdb ] || wrong "frames: no sums of a dry run"
echo broken >cloth_0002.bcc
rm o_01.vdb
fails 3 "cloth_0002.bcc: frame 2: byte 0" voxelize 'cloth_%04d.bcc' --frames 1-3 --voxels 32 -o 'o_%02d.vdb' --quiet
[ -e o_01.vdb ] && [ ! -e o_02.vdb ] || wrong "frames: the one before the broken one was not kept"

works export raster1.vdb --to mitsuba06 -o flakes
works info flakes/volume.vol
works voxelize flakes/volume.vol --levels 0 -o flakes.vdb
fails 2 "--pad cannot be used with --to mitsuba06" export raster1.vdb --to mitsuba06 --pad 2 -o flakes
works export raster1.vdb --to mitsuba06 --block-samples 0 -o flake --json
[ "$(json blocks)" -eq 1 ] && works voxelize flake/volume.vol --levels 0 -o flake.vdb || wrong "more than one block holds all"
fails 2 "the minimum is 2" export raster1.vdb --to mitsuba06 --block-samples 1 -o flake
fails 2 "--block-samples needs --to mitsuba06" export raster1.vdb --block-samples 8 -o flakes
fails 2 "--stddev needs --to mitsuba06" export raster1.vdb --stddev 0.5 -o flakes
works view knit.bcc --headless --yarn slice.toml --frames 2 --size 64x64 -o frames
[ "$(head -c 4 frames/frame_0001.png | tail -c 3)" = PNG ] || wrong "the second frame is no PNG"
fails 2 "needs a folder" view knit.bcc --headless
fails 2 "needs --headless" view knit.bcc --frames 2
fails 2 "--color level is not available for slices" view knit.bcc --headless --color level -o frames
fails 2 "there are no voxels to show" view knit.bcc --headless --color grid -o frames
fails 2 "there are no voxels to show" view knit.bcc --headless --scene -o frames
works voxelize knit.bcc --voxels 40 -o seen.vdb
works voxelize knit.bcc --fill-memory --memory 60M --dry-run -o filled.vdb
fails 2 "--fill-memory chooses" voxelize knit.bcc --fill-memory --voxels 9 -o filled.vdb
works view seen.vdb --headless --size 64x64 --color density --blocks --white-block 0,0,0 --scene -o seen
[ -s seen/frame_0000.png ] || wrong "no picture of a volume"
works render seen/seen_view.toml --samples 1 --size 16x16 -o scene.png
works view knit.bcc --volume seen.vdb --headless --size 64x64 --color grid --blocks -o seen
fails 2 "--volume cannot be used with a .vdb" view seen.vdb --volume seen.vdb --headless -o seen
fails 3 "has meshes" view grass.glb --headless -o frames
fails 2 "--yarn needs curves" view grass.glb --headless --yarn cotton -o frames

# bad inputs, with an old output in the way
echo old >old.vdb
bad() { fails 3 "$1" voxelize "$2" --voxels 32 -o old.vdb; }
bad "missing.bcc" missing.bcc
for suffix in bcc hair data pyp obj ply gltf glb; do # one row a trap, for every reader
    mkdir "folder.$suffix" && bad "folder.$suffix: is a directory" "folder.$suffix"
    : >"empty.$suffix" && bad "empty.$suffix" "empty.$suffix"
    echo "some words that are long enough to be a header: 0123456789 0123456789 0123456789" >"text.$suffix"
    bad "text.$suffix" "text.$suffix"
    head -c 5000 /dev/zero >"zero.$suffix" && bad "zero.$suffix" "zero.$suffix"
    ln -s /dev/zero "device.$suffix" && bad "device.$suffix: is a device" "device.$suffix"
    mkfifo "pipe.$suffix" && bad "pipe.$suffix: is a device or pipe" "pipe.$suffix"
done
for n in 1 4 16 60 90 200 1000; do
    for whole in knit.bcc hair.hair grass.glb; do
        head -c $n $whole >"cut.${whole#*.}" && bad "cut.${whole#*.}" "cut.${whole#*.}"
    done
done
# volumes: vol ENCODING CHANNELS BYTES prints 2 x 2 x 2 samples in [0, 1]^3
vol() {
    printf "VOL\\3\\$1\\0\\0\\0\\2\\0\\0\\0\\2\\0\\0\\0\\2\\0\\0\\0\\$2\\0\\0\\0"
    head -c 12 /dev/zero
    printf '\0\0\200\77\0\0\200\77\0\0\200\77'
    head -c "$3" /dev/zero | tr '\0' @
}
bad_vol() { fails 3 "$1" voxelize "$2" -o old.vdb; }
bad_vol "no such file" missing.vol
mkdir folder.vol && bad_vol "folder.vol: is a directory" folder.vol
: >empty.vol && bad_vol "empty.vol" empty.vol
head -c 5000 /dev/zero >zero.vol && bad_vol "are no interval: not a volume" zero.vol
vol 3 1 7 >cut.vol && bad_vol "7 bytes are left" cut.vol
vol 3 1 9 >long.vol && bad_vol "1 bytes follow" long.vol
vol 4 3 16 >a-orientation.vol && bad_vol "not density" a-orientation.vol
vol 3 1 8 >a-density.vol
fails 2 "--voxels cannot be used with a .vol" voxelize a-density.vol --voxels 32 -o old.vdb
fails 2 "--albedo applies only to .vol files" voxelize knit.bcc --albedo 0.5 -o old.vdb
works info a-density.vol
grep -q '^orientation *directions, a-orientation.vol' out.txt || wrong "info of a .vol: $(cat out.txt)"
works voxelize a-density.vol -o vol.vdb --json
[ "$(json voxels)" = 8 ] || wrong "8 samples became $(json voxels) voxels"
works preview vol.vdb -o vol.png --size 32x32

cp knit.bcc knit.glb && bad "knit.glb" knit.glb
cp text.bcc text.xyz && bad "known: .bcc" text.xyz
mesh() { # TEXT FACE X: a mesh of three points, the first at X
    printf 'v %s 0 0\nv 1 0 0\nv 0 1 0\nf %s\n' "$3" "$2" >bad.obj && bad "$1" bad.obj
}
mesh "bad.obj:4" "1 2 4" 0
printf 'v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3000000\r' >bad.obj && bad "bad.obj:4: names vertex 3000000 of 3" bad.obj
printf '# a Mac\rv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1/ 2 3\r' >mac.obj && works info mac.obj --json
[ "$(json triangles)" -eq 1 ] || wrong "a file of carriage returns has $(json triangles) triangles"
mesh "bad.obj:1" "1 2 3" nan
mesh "bad.obj:1" "1 2 3" 1e39
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >point.obj && bad "has no extent" point.obj
{ # .data: one strand of two points, which are one
    printf '\001\000\000\000\002\000\000\000' && head -c 24 /dev/zero
} >point.data
bad "has no extent" point.data
fails 3 "has no extent" voxelize point.data --yarn-radius 0.1 -o old.vdb
for file in text folder zero empty; do
    [ "$file" = folder ] && mkdir folder.vdb || cp "$file.bcc" "$file.vdb"
    fails 3 "$file.vdb" info "$file.vdb"
    fails 3 "$file.vdb" preview "$file.vdb" -o text.png
    fails 3 "$file.vdb" material "$file.vdb" --set 0.alpha=1
done
if [ "$(id -u)" -ne 0 ]; then
    cp knit.bcc locked.bcc && chmod 000 locked.bcc && bad "locked.bcc" locked.bcc
fi
for size in 0 nan -1 inf 1,1,0 ''; do
    fails 2 "--voxel-size" voxelize knit.bcc --voxel-size "$size" -o old.vdb
done
fails 2 "2^40" voxelize knit.bcc --voxel-size 1e-30 -o old.vdb
fails 2 "2^40" voxelize knit.bcc --voxel-size 1e-9 -o old.vdb
fails 2 "--fibers" voxelize knit.bcc --fibers 10 -o old.vdb
fails 2 "--yarn" voxelize grass.glb --yarn cotton -o old.vdb
fails 4 "" voxelize knit.bcc --memory 1M --voxels 512 -o old.vdb

# outputs that cannot be written: said before the work starts
fails 1 "nowhere" voxelize knit.bcc -o nowhere/x.vdb
fails 1 "folder.vdb" voxelize knit.bcc -o folder.vdb
fails 1 "/dev/full" generate knit -o /dev/full
for suffix in bcc vdb png; do ln -s /dev/full "full.$suffix"; done
fails 1 "full.bcc" generate knit -o full.bcc
fails 1 "full.vdb" voxelize knit.bcc -o full.vdb
fails 1 "full.png" preview old.vdb -o full.png
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && chmod 555 locked && fails 1 "locked/x.vdb" voxelize knit.bcc -o locked/x.vdb
fi
[ -c /dev/full ] || wrong "/dev/full was replaced"
"$heddle" info knit.bcc >/dev/full 2>err.txt
[ $? -eq 1 ] && grep -q "stdout" err.txt || wrong "a full stdout goes unnoticed"
# a full disk, as a limit on what one file may hold
(
    trap '' XFSZ
    ulimit -f 4
    fails 1 "old.vdb" voxelize knit.bcc --voxels 128 -o old.vdb --quiet
    fails 1 "big.bcc" generate knit --counts 60,60 -o big.bcc
    exit "$failures"
)
failures=$?
[ "$(cat old.vdb)" = old ] || wrong "a failed run changed the old output"

# Ctrl-C
"$heddle" voxelize knit.bcc --yarn cotton --voxels 2048 --threads 1 -o old.vdb >out.txt 2>err.txt &
job=$!
sleep 1
kill -INT $job
wait $job
status=$?
[ $status -eq 130 ] || wrong "Ctrl-C gives exit code $status, not 130: $(cat err.txt)"
[ "$(cat old.vdb)" = old ] || wrong "Ctrl-C changed the old output"
left=$(find . -name '*.part' -o -name '.*heddle*' -o -name '*spool*')
[ -z "$left" ] || wrong "left behind: $left"

# results: the same bits for any thread count, and numbers that a program can read
works voxelize knit.bcc --yarn cotton --voxels 64 --threads 1 -o one.vdb --json
[ "$(json voxels)" -gt 100 ] || wrong "a knit has few voxels: $(json voxels)"
works voxelize knit.bcc --yarn cotton --voxels 64 --threads 3 -o three.vdb --json
works info one.vdb --json
hash=$(json content_hash)
works info three.vdb --json
[ "$(json content_hash)" = "$hash" ] || wrong "one thread and three give different voxels"
# where voxels are made: machines that run this have no GPU, or give the same voxels by it
works voxelize knit.bcc --voxels 40 --device auto -o auto.vdb
works voxelize knit.bcc --voxels 40 --device cpu -o cpu.vdb
works info auto.vdb --json
auto_hash=$(json content_hash)
works info cpu.vdb --json
[ "$auto_hash" = "$(json content_hash)" ] || wrong "--device auto and cpu differ"
if ! "$heddle" voxelize knit.bcc --voxels 40 --device cuda -o cuda.vdb >out.txt 2>err.txt; then
    cp cpu.vdb cuda.vdb
    fails 4 "use --device cpu" voxelize knit.bcc --voxels 40 --device cuda -o cuda.vdb
    cmp -s cpu.vdb cuda.vdb || wrong "a refused --device cuda touched the old output"
fi
fails 2 "--device-memory cannot be used with --backend raster" voxelize knit.bcc -o a.vdb --backend raster --device-memory 1G
fails 2 "--device-memory cannot be used with --device cpu" voxelize knit.bcc -o a.vdb --device cpu --device-memory 1G
works voxelize knit.bcc --dry-run --json -o dry.vdb
[ "$(json predicted_peak_memory_bytes)" -gt 0 ] || wrong "a dry run predicts no memory"
[ ! -e dry.vdb ] || wrong "a dry run wrote its output"
works voxelize grass.glb --voxels 64 -o grass.vdb --quiet
[ ! -s out.txt ] && [ ! -s err.txt ] || wrong "--quiet is not"
works voxelize hair.hair --voxels 64 -o hair.vdb
works info knit.bcc --json
[ "$(json curves)" -eq 6 ] || wrong "6 rows are not 6 curves: $(json curves)"
if command -v vdb_print >/dev/null; then
    vdb_print one.vdb | grep density >value.txt || wrong "vdb_print finds no density in our file"
fi
[ "$(grep -c bytes_per_voxel out.txt)" -eq 0 ] || wrong "curves have no levels"
works info one.vdb
grep -q '^level 0 .* KiB' out.txt || wrong "info lists no level 0: $(cat out.txt)"
works voxelize knit.bcc --yarn cotton --voxels 64 --levels 0 -o flat.vdb
# what neighbours share: level 0 alone has the bytes of level 0 among all
for backend in sample raster; do
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --correlation --backend $backend -o shared.vdb
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --correlation --backend $backend --levels 0 -o shared0.vdb
    works lod shared.vdb --levels 0 -o cut.vdb
    works info shared0.vdb --json && hash0=$(json content_hash)
    works info cut.vdb --json && [ "$(json content_hash)" = "$hash0" ] || wrong "--levels 0 has another correlation, $backend"
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --backend $backend --levels 0 -o shared0.vdb
    works info shared0.vdb --json && [ "$(json content_hash)" != "$hash0" ] || wrong "no correlation is stored, $backend"
done
fails 3 "flat.vdb: has no level 1; its only level is 0" preview flat.vdb --level 1 -o one.png
fails 3 "one.vdb: has no level 9; its levels are 0 to 6" preview one.vdb --level 9 -o one.png
works preview one.vdb --level 5 -o one.png
# levels again: from masks bit for bit, without them not if --exact
works voxelize knit.bcc --yarn cotton --voxels 64 --keep-masks --correlation -o masks.vdb
works info masks.vdb --json
masks=$(json content_hash)
works lod masks.vdb --exact -o again.vdb
works info again.vdb --json
[ "$(json content_hash)" = "$masks" ] || wrong "levels built again from masks differ"
works lod one.vdb --lod single --lobes 1 -o single.vdb
works info single.vdb --json
[ "$(json lod)" = single ] || wrong "lod single says $(json lod)"
echo old >kept.vdb
fails 3 "one.vdb: holds no columns and sums" lod one.vdb --exact -o kept.vdb
fails 3 "kept.vdb: " lod kept.vdb -o new.vdb
fails 2 "--levels" voxelize knit.bcc --levels -1 -o kept.vdb
fails 2 "did you mean 'moments'" lod one.vdb --lod moment -o kept.vdb
grep -q '^old$' kept.vdb || wrong "a refused command changed its output"
[ ! -e new.vdb ] || wrong "a refused command left an output"
works material one.vdb --set 0.albedo=0.8,0.2,0.1 -o red.vdb --json
works info red.vdb --json
[ "$(json content_hash)" = "$hash" ] || wrong "another colour gives different voxels"
fails 2 "did you mean 'albedo'?" material one.vdb --set 0.albdo=1,1,1
fails 1 "nowhere" material one.vdb --set 0.alpha=1 -o nowhere/red.vdb
works preview one.vdb -o one.png
[ "$(head -c 4 one.png | tail -c 3)" = PNG ] || wrong "the preview is no PNG"

# levels
works voxelize knit.bcc --yarn cotton --voxels 48 --keep-masks -o masks.vdb --quiet
works lod-report masks.vdb --parents 20 --methods moments,naive --plot errors.png
[ "$(grep -c '^| 1 |' out.txt)" -eq 3 ] || wrong "not a row for the file and two methods: $(cat out.txt)"
[ "$(head -c 4 errors.png | tail -c 3)" = PNG ] || wrong "the plot is no PNG"
works lod-report masks.vdb --parents 20 --methods single --json
[ "$(json coverage_truth)" = union ] || wrong "masks give no union"
works lod-report masks.vdb --parents 20 --methods wasserstein --part 500 --quiet
works voxelize knit.bcc --voxels 32 --levels 0 -o level0.vdb --quiet
fails 3 "level0.vdb: has only the finest level" lod-report level0.vdb
fails 3 "missing.vdb" lod-report missing.vdb
fails 3 "knit.bcc: byte 0: not a VDB" lod-report knit.bcc
fails 2 "did you mean 'moments'?" lod-report masks.vdb --methods moment
fails 2 "--plot: 'x.pdf' must end in .png" lod-report masks.vdb --plot x.pdf
fails 1 "nowhere" lod-report masks.vdb --plot nowhere/x.png

# pictures
works render one.vdb -o picture.exr --size 32x24 --samples 2 --json
[ "$(json samples)" -eq 2 ] || wrong "2 samples became $(json samples)"
[ "$(json render_seconds)" != 0 ] || wrong "a render takes no time"
[ "$(head -c 4 picture.exr | od -An -tx1 | tr -d ' ')" = 762f3101 ] || wrong "the picture is no OpenEXR"
works render one.vdb -o picture.png --size 32x24 --samples 1 --quiet --level 2 --transport product
[ "$(head -c 4 picture.png | tail -c 3)" = PNG ] || wrong "the picture is no PNG"
[ ! -s out.txt ] && [ ! -s err.txt ] || wrong "--quiet is not"
works render one.vdb -o other.png --size 32x24 --samples 1 --quiet --level 2 --transport product --threads 1
cmp picture.png other.png || wrong "one thread renders another picture"
[ ! -e picture.png.checkpoint ] || wrong "a finished picture left its checkpoint"
cat >inside.toml <<'TOML'
[camera]
eye = [0.5, 0.5, 0.1]
target = [0, 0, 0]
[film]
size = [16, 16]
[integrator]
samples = 1
[[light]]
kind = "constant"
[object.cloth]
volume = "one.vdb"
TOML
works render inside.toml -o inside.exr --quiet
fails 2 "did you mean 'product'?" render one.vdb -o x.exr --transport prodct
fails 2 "--transport: ''" render one.vdb -o x.exr --transport ''
sed 's/samples = 1/transport = "prodct"/' inside.toml >transport.toml
fails 2 "unknown transport 'prodct'" render transport.toml -o x.exr
fails 2 "x.jpg' must end in .exr or .png" render one.vdb -o x.jpg
fails 2 "option --output is missing" render one.vdb
fails 2 "--size" render one.vdb -o x.exr --size 0x10
fails 2 "2^28" render one.vdb -o x.exr --size 65536x65536
fails 2 "--samples" render one.vdb -o x.exr --samples 0
fails 2 "--exposure" render one.vdb -o x.png --exposure nan
fails 2 "--geometry cannot be used with a .vdb" render one.vdb -o x.exr --geometry
fails 1 "nowhere" render one.vdb -o nowhere/x.exr
mkdir folder.exr && fails 1 "folder.exr" render one.vdb -o folder.exr
fails 3 "missing.vdb" render missing.vdb -o x.exr
fails 3 "missing.toml" render missing.toml -o x.exr
fails 3 "knit.bcc" render knit.bcc -o x.exr
fails 3 "one.vdb: has no level 9" render one.vdb -o x.exr --level 9
fails 3 "x.exr.checkpoint" render one.vdb -o x.exr --resume
for n in 100 5000 20000; do
    head -c $n one.vdb >cut.vdb && fails 3 "cut.vdb" render cut.vdb -o x.exr
done
sed 's/one.vdb/missing.vdb/' inside.toml >gone.toml && fails 3 "gone.toml:11" render gone.toml -o x.exr
printf '%s\n' '[film]' 'size = [0, 5]' '[object.a]' 'volume = 5' 'colour = 1' >many.toml
"$heddle" render many.toml -o x.exr >out.txt 2>err.txt
[ $? -eq 3 ] && [ "$(wc -l <err.txt)" -ge 3 ] || wrong "not all problems of a scene at once: $(cat err.txt)"
[ ! -e x.exr ] && [ ! -e x.exr.checkpoint ] || wrong "a refused render left an output"
# stopped by Ctrl-C and resumed: the bits of one go
"$heddle" render one.vdb -o killed.exr --size 64x64 --time 60 --threads 1 --quiet 2>err.txt &
job=$!
sleep 1
kill -INT $job
wait $job
status=$?
[ $status -eq 130 ] || wrong "Ctrl-C gives exit code $status, not 130: $(cat err.txt)"
[ -s killed.exr ] && [ -s killed.exr.checkpoint ] || wrong "Ctrl-C left no picture or no checkpoint"
fails 3 "another scene" render one.vdb -o killed.exr --size 64x64 --level-offset 1 --resume
fails 3 "64 x 64" render one.vdb -o killed.exr --size 32x32 --resume
works render one.vdb -o killed.exr --size 64x64 --samples 1 --resume --json
[ "$(json resumed_from)" -ge 1 ] || wrong "a resumed render began again"

[ "$failures" -eq 0 ] && echo "all as expected"
exit "$failures"
