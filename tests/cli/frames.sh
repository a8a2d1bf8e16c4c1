#!/usr/bin/env bash
# frames.sh HEDDLE: a sequence in one run: each frame has the bits of a separate run.
. "$(dirname "$0")/functions.sh"

make_yarn

for k in 1 2 3; do works generate knit --counts $((k + 1)),2 -o cloth_000$k.bcc; done
fails 2 "must contain the frame number exactly once" voxelize cloth.bcc --frames 1-3 -o 'o_%02d.vdb'
fails 2 "--output: 'o.vdb' must contain" voxelize 'cloth_%04d.bcc' --frames 1-3 -o o.vdb
fails 2 "is not a range" voxelize 'cloth_%04d.bcc' --frames 3-1 -o 'o_%02d.vdb'
fails 2 "it needs curves or meshes" voxelize 'cloth_%04d.vol' --frames 1-3 -o 'o_%02d.vdb'
for backend in sample raster; do
    works voxelize 'cloth_%04d.bcc' --frames 1-3:2 --yarn slice.toml --voxels 32 \
        --backend $backend -o 'o_%02d.vdb' --json
    grep -q '"file": "cloth_0003.bcc"' out.txt || wrong "frames: no row for the second"
    [ ! -e o_02.vdb ] || wrong "frames: a step was not taken"
    works voxelize cloth_0003.bcc --yarn slice.toml --voxels 32 --backend $backend -o alone.vdb
    works info alone.vdb --json && alone=$(json content_hash)
    works info o_03.vdb --json && [ "$(json content_hash)" = "$alone" ] ||
        wrong "frames: other bits than alone, $backend"
done
works voxelize 'cloth_%04d.bcc' --frames 1-3 --voxels 32 --dry-run -o 'dry_%02d.vdb'
[ "$(grep -c '^predicted' out.txt)" -eq 4 ] && [ ! -e dry_01.vdb ] ||
    wrong "frames: no sums of a dry run"
echo broken >cloth_0002.bcc
rm o_01.vdb
fails 3 "cloth_0002.bcc: frame 2: byte 0" voxelize 'cloth_%04d.bcc' --frames 1-3 --voxels 32 \
    -o 'o_%02d.vdb' --quiet
[ -e o_01.vdb ] && [ ! -e o_02.vdb ] || wrong "frames: the one before the broken one was not kept"

finish
