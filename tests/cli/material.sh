#!/usr/bin/env bash
# material.sh HEDDLE: a new colour leaves the voxels unchanged.
. "$(dirname "$0")/functions.sh"

make_knit
make_one

works info one.vdb --json
hash=$(json content_hash)
works material one.vdb --set 0.albedo=0.8,0.2,0.1 -o red.vdb --json
works info red.vdb --json
[ "$(json content_hash)" = "$hash" ] || wrong "another colour gives different voxels"
fails 2 "did you mean 'albedo'?" material one.vdb --set 0.albdo=1,1,1
fails 1 "nowhere" material one.vdb --set 0.alpha=1 -o nowhere/red.vdb

finish
