#!/usr/bin/env bash
# raster.sh HEDDLE: OpenGL gives the same bits for any thread count; without a driver, one line.
. "$(dirname "$0")/functions.sh"

make_knit
make_grass
make_yarn

fails 2 "--composition needs --backend raster" voxelize knit.bcc -o a.vdb --composition max
fails 2 "--fit last cannot be used with --backend raster" voxelize knit.bcc -o a.vdb \
    --backend raster --fit last
fails 3 "has meshes" voxelize grass.glb --voxels 32 -o a.vdb --backend raster
__EGL_VENDOR_LIBRARY_DIRS=/nonexistent fails 4 "opengl: no driver" voxelize knit.bcc \
    --yarn-radius 0.1 --voxels 32 -o a.vdb --backend raster --quiet
for threads in 1 2; do
    works voxelize knit.bcc --yarn slice.toml --voxels 32 --backend raster --threads $threads \
        -o "raster$threads.vdb"
done
works info raster1.vdb --json && hash1=$(json content_hash)
works info raster2.vdb --json && [ "$(json content_hash)" = "$hash1" ] ||
    wrong "raster: other bits with 2 threads"
fails 2 "--raster-path needs --backend raster" voxelize knit.bcc -o a.vdb --raster-path compute
for path in fragment compute; do
    works voxelize knit.bcc --yarn slice.toml --voxels 32 --backend raster --raster-path $path \
        -o path.vdb --json
    [ "$(json raster_path)" = $path ] || wrong "raster: path $path was not taken"
    works info path.vdb --json && [ "$(json content_hash)" = "$hash1" ] ||
        wrong "raster: other bits by $path shaders"
done
fails 2 "--device-memory cannot be used with --backend raster" voxelize knit.bcc -o a.vdb \
    --backend raster --device-memory 1G

finish
