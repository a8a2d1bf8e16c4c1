#!/usr/bin/env bash
# vol.sh HEDDLE: Mitsuba volumes as input, valid and damaged.
. "$(dirname "$0")/functions.sh"

make_knit
echo old >old.vdb

# vol ENCODING CHANNELS BYTES prints 2 x 2 x 2 samples in [0, 1]^3
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
grep -q '^orientation *directions, a-orientation.vol' out.txt ||
    wrong "info of a .vol: $(cat out.txt)"
works voxelize a-density.vol -o vol.vdb --json
[ "$(json voxels)" = 8 ] || wrong "8 samples became $(json voxels) voxels"
works preview vol.vdb -o vol.png --size 32x32
kept_old

finish
