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
for option in "--voxels 32" "--voxel-size 0.1" --fill-memory "--bounds 0,0,0,1,1,1" "--repeat 2,2" \
    "--yarn cotton" "--footprints 4" --correlation --keep-masks "--device cpu" "--device-memory 1G" \
    "--subvoxels 8" "--coverage mask" "--fit last" "--backend raster"; do
    # shellcheck disable=SC2086 # an option and its value
    fails 2 "${option%% *} cannot be used with a .vol" voxelize a-density.vol $option -o old.vdb
done
fails 2 "--frames cannot be used with a .vol" voxelize a-density.vol --frames 1-2 -o old.vdb
for option in "--voxels 32" "--voxel-size 0.1" "--yarn cotton" "--yarn-radius 1" "--repeat 2,2" \
    "--fibers 3" "--fiber-radius 1" "--height-map a.png" "--height-scale 1" "--height-offset 1"; do
    # shellcheck disable=SC2086 # an option and its value
    fails 2 "${option%% *} cannot be used with a .vol" info a-density.vol $option
done
fails 2 "--albedo applies only to .vol files" voxelize knit.bcc --albedo 0.5 -o old.vdb
works info a-density.vol
grep -q '^orientation *directions, a-orientation.vol' out.txt ||
    wrong "info of a .vol: $(cat out.txt)"
works voxelize a-density.vol --lobes 1 --occupancy 0 --levels 1 --lod single --memory 1G -o vol.vdb
works voxelize a-density.vol -o vol.vdb --json
[ "$(json voxels)" = 8 ] || wrong "8 samples became $(json voxels) voxels"
fails 2 "--voxels cannot be used with a .vdb" info vol.vdb --voxels 32
works preview vol.vdb -o vol.png --size 32x32
kept_old

finish
