#!/usr/bin/env bash
# view_sheet.sh HEDDLE OUT [SWEATER.bcc]: pictures of `heddle view` like figures 10 and 12 to 15 of
# [LopezMoreno17], of a sweater if one is given and of generated knits. The commands are written to
# OUT/commands.txt.
set -euo pipefail
heddle=$(realpath "$1")
mkdir -p "$2"
cd "$2"
sweater=${3:-}
: >commands.txt
run() {
    echo "heddle $*" >>commands.txt
    "$heddle" "$@" --quiet
}
# picture NAME ARGUMENT...: one picture of the view as NAME.png
picture() {
    local name=$1
    shift
    run view "$@" --headless --size 700x700 -o "$name"
    mv "$name/frame_0000.png" "$name.png"
}
run slice cotton -o cotton.png --yarn-file cotton.toml
run generate knit --counts 24,16 -o knit.bcc
run generate knit --counts 1,1 -o loop.bcc
knit="knit.bcc --yarn cotton.toml"

# fig. 12, 13: far, middle, near; with and without shadows
if [ -n "$sweater" ]; then
    far="$sweater --yarn cotton.toml --yarn-radius 0.1"
    picture fig12_far $far
    picture fig12_middle $far --from 0,0,1 --target 0,12,10 --zoom 5
    picture fig12_near $far --from 0,0,1 --target 0,12,10 --zoom 25
fi
picture fig13_shadows $knit --zoom 3
picture fig13_no_shadows $knit --zoom 3 --no-shadows

# sorted, by weights, as placed
picture blend_sorted $knit --zoom 8
picture blend_weighted $knit --zoom 8 --blend weighted
picture blend_placed $knit --zoom 8 --blend placed

# fig. 10: a yarn's voxels by density over its slices
run voxelize loop.bcc --yarn cotton.toml --voxels 200 -o loop.vdb
picture fig10_voxels loop.bcc --yarn cotton.toml --volume loop.vdb --show voxels --color density
picture fig10_slices loop.bcc --yarn cotton.toml

# fig. 13, 14: blocks; slices in the voxels' directions; one block white
run voxelize knit.bcc --yarn cotton.toml --voxels 768 -o knit.vdb
picture fig13_blocks $knit --volume knit.vdb --blocks
picture fig14_grid $knit --volume knit.vdb --color grid --zoom 3
picture fig14_slices $knit --volume knit.vdb --color direction --zoom 3
picture fig14_block $knit --volume knit.vdb --color grid --blocks --white-block 12,8,0 --zoom 12
picture fig14_voxels $knit --volume knit.vdb --show voxels --blocks --white-block 12,8,0 --zoom 12

# fig. 15: slices, voxels, and the path-traced volume in the same view
picture fig15_slices $knit --volume knit.vdb --zoom 5 --scene
picture fig15_voxels $knit --volume knit.vdb --show voxels --zoom 5
run render fig15_slices/knit_view.toml --samples 32 -o fig15_traced.png
