#!/usr/bin/env bash
# export.sh HEDDLE: volumes for Mitsuba can be read back.
. "$(dirname "$0")/functions.sh"

make_knit
make_yarn
works voxelize knit.bcc --yarn slice.toml --voxels 32 -o small.vdb

works export small.vdb --to mitsuba06 -o flakes
works info flakes/volume.vol
works voxelize flakes/volume.vol --levels 0 -o flakes.vdb
fails 2 "--pad cannot be used with --to mitsuba06" export small.vdb --to mitsuba06 --pad 2 -o flakes
works export small.vdb --to mitsuba06 --block-samples 0 -o flake --json
[ "$(json blocks)" -eq 1 ] && works voxelize flake/volume.vol --levels 0 -o flake.vdb ||
    wrong "more than one block holds all"
fails 2 "the minimum is 2" export small.vdb --to mitsuba06 --block-samples 1 -o flake
fails 2 "--block-samples needs --to mitsuba06" export small.vdb --block-samples 8 -o flakes
fails 2 "--stddev needs --to mitsuba06" export small.vdb --stddev 0.5 -o flakes

finish
