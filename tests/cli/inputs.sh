#!/usr/bin/env bash
# inputs.sh HEDDLE: an invalid input gives one line, and the old output stays.
. "$(dirname "$0")/functions.sh"

make_knit
make_grass
make_hair

# an old output is in the way
echo old >old.vdb
bad() { fails 3 "$1" voxelize "$2" --voxels 32 -o old.vdb; }
bad "missing.bcc" missing.bcc
for suffix in bcc hair data pyp obj ply gltf glb; do # every row is a trap, for every reader
    mkdir "folder.$suffix" && bad "folder.$suffix: is a directory" "folder.$suffix"
    : >"empty.$suffix" && bad "empty.$suffix" "empty.$suffix"
    echo "some words that are long enough to be a header: 0123456789 0123456789 0123456789" \
        >"text.$suffix"
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
cp knit.bcc knit.glb && bad "knit.glb" knit.glb
cp text.bcc text.xyz && bad "known: .bcc" text.xyz
mesh() { # TEXT FACE X: a mesh of three points, the first at X
    printf 'v %s 0 0\nv 1 0 0\nv 0 1 0\nf %s\n' "$3" "$2" >bad.obj && bad "$1" bad.obj
}
mesh "bad.obj:4" "1 2 4" 0
printf 'v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3000000\r' >bad.obj &&
    bad "bad.obj:4: names vertex 3000000 of 3" bad.obj
printf '# a Mac\rv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1/ 2 3\r' >mac.obj && works info mac.obj --json
[ "$(json triangles)" -eq 1 ] || wrong "a file of carriage returns has $(json triangles) triangles"
mesh "bad.obj:1" "1 2 3" nan
mesh "bad.obj:1" "1 2 3" 1e39
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >point.obj && bad "has no extent" point.obj
{ # .data: one strand of two points at the same position
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
kept_old

finish
