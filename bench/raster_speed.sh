#!/usr/bin/env bash
# raster_speed.sh HEDDLE: a table of both voxelizers on knitted swatches of slices. CPU seconds.
set -euo pipefail
heddle=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$heddle" slice cotton -o slice.png --yarn-file slice.toml --quiet
echo "| loops | slices | bricks | sample: CPU s | raster: CPU s | of it three passes, s |"
echo "|---|---|---|---|---|---|"
for counts in 4,4 8,4 8,8 16,8; do
    "$heddle" generate knit --counts $counts -o knit.bcc --quiet
    for backend in sample raster; do
        (
            TIMEFORMAT=%U
            time "$heddle" voxelize knit.bcc --yarn slice.toml -o out.vdb --voxel-size 0.06 \
                --yarn-radius 0.1 \
                --backend $backend --levels 0 >$backend.txt 2>/dev/null
        ) 2>$backend.time
    done
    value() { sed -n "s/^$1  *\([0-9.]* *[kM]\{0,1\}\).*/\1/p" raster.txt; }
    echo "| $counts | $(value slices) | $(value bricks) | $(cat sample.time) | $(cat raster.time) | $(value 'three passes') |"
done
