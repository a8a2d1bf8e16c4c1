#!/usr/bin/env bash
# preview.sh HEDDLE: the quick picture of a level.
. "$(dirname "$0")/functions.sh"

make_knit
make_one

works voxelize knit.bcc --yarn cotton --voxels 64 --levels 0 -o flat.vdb
fails 3 "flat.vdb: has no level 1; its only level is 0" preview flat.vdb --level 1 -o one.png
fails 3 "one.vdb: has no level 9; its levels are 0 to 6" preview one.vdb --level 9 -o one.png
works preview one.vdb --level 5 -o one.png
works preview one.vdb -o one.png
[ "$(head -c 4 one.png | tail -c 3)" = PNG ] || wrong "the preview is no PNG"

finish
