#!/usr/bin/env bash
# view.sh HEDDLE: pictures without a window, of slices and of voxels.
. "$(dirname "$0")/functions.sh"

make_knit
make_grass
make_yarn

works view knit.bcc --headless --yarn slice.toml --frames 2 --size 64x64 -o frames
[ "$(head -c 4 frames/frame_0001.png | tail -c 3)" = PNG ] || wrong "the second frame is no PNG"
fails 2 "needs a folder" view knit.bcc --headless
fails 2 "needs --headless" view knit.bcc --frames 2
fails 2 "--color level is not available for slices" view knit.bcc --headless --color level -o frames
fails 2 "there are no voxels to show" view knit.bcc --headless --color grid -o frames
fails 2 "there are no voxels to show" view knit.bcc --headless --scene -o frames
works voxelize knit.bcc --voxels 40 -o seen.vdb
works view seen.vdb --headless --size 64x64 --color density --blocks --white-block 0,0,0 --scene \
    -o seen
[ -s seen/frame_0000.png ] || wrong "no picture of a volume"
works render seen/seen_view.toml --samples 1 --size 16x16 -o scene.png
works view knit.bcc --volume seen.vdb --headless --size 64x64 --color grid --blocks -o seen
fails 2 "--volume cannot be used with a .vdb" view seen.vdb --volume seen.vdb --headless -o seen
fails 3 "has meshes" view grass.glb --headless -o frames
fails 2 "--yarn needs curves" view grass.glb --headless --yarn cotton -o frames

finish
