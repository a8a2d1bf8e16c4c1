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
# fails CODE TEXT ARGUMENT...: exit code CODE, nothing on stdout, one line on stderr that holds TEXT
fails() {
    local code=$1 text=$2
    shift 2
    "$heddle" "$@" >out.txt 2>err.txt
    local status=$?
    [ $status -eq "$code" ] || wrong "exit code $status, not $code: heddle $* ($(cat err.txt))"
    [ ! -s out.txt ] || wrong "an error printed to stdout: heddle $*"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "not one line on stderr: heddle $*: $(cat err.txt)"
    grep -qF -- "$text" err.txt || wrong "no '$text' in: $(cat err.txt)"
}
# works ARGUMENT...: exit code 0, nothing on stderr but notes; stdout is in out.txt
works() {
    "$heddle" "$@" >out.txt 2>err.txt || wrong "exit code $?: heddle $*: $(cat err.txt)"
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
works --version
for command in info generate voxelize preview; do
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

# bad inputs, with an old output in the way
echo old >old.vdb
bad() { fails 3 "$1" voxelize "$2" --voxels 32 -o old.vdb; }
bad "missing.bcc" missing.bcc
mkdir folder.bcc && bad "folder.bcc" folder.bcc
: >empty.bcc && bad "empty.bcc" empty.bcc
head -c 90 knit.bcc >cut.bcc && bad "cut.bcc" cut.bcc
echo "some words that are long enough to be a header: 0123456789 0123456789 0123456789" >text.bcc
bad "text.bcc" text.bcc
cp text.bcc text.xyz && bad "known: .bcc" text.xyz
head -c 200 grass.glb >cut.glb && bad "cut.glb" cut.glb
echo "v 0 0 0" >empty.obj && bad "empty.obj" empty.obj
cp text.bcc text.vdb && fails 3 "text.vdb" info text.vdb
fails 3 "text.vdb" preview text.vdb -o text.png
if [ "$(id -u)" -ne 0 ]; then
    cp knit.bcc locked.bcc && chmod 000 locked.bcc && bad "locked.bcc" locked.bcc
fi
fails 2 "2^40" voxelize knit.bcc --voxel-size 1e-9 -o old.vdb
fails 2 "--voxel-size" voxelize knit.bcc --voxel-size 0 -o old.vdb
fails 2 "--voxel-size" voxelize knit.bcc --voxel-size nan -o old.vdb
fails 2 "--fibers" voxelize knit.bcc --fibers 10 -o old.vdb
fails 2 "--yarn" voxelize grass.glb --yarn cotton -o old.vdb
fails 4 "" voxelize knit.bcc --memory 1M --voxels 512 -o old.vdb

# outputs that cannot be written: said before the work starts
fails 1 "nowhere" voxelize knit.bcc -o nowhere/x.vdb
mkdir folder.vdb && fails 1 "folder.vdb" voxelize knit.bcc -o folder.vdb
fails 1 "/dev/full" generate knit -o /dev/full
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
works preview one.vdb -o one.png
[ "$(head -c 4 one.png | tail -c 3)" = PNG ] || wrong "the preview is no PNG"

[ "$failures" -eq 0 ] && echo "all as expected"
exit "$failures"
