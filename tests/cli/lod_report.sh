#!/usr/bin/env bash
# lod_report.sh HEDDLE: errors of levels, as a table, a plot and JSON.
. "$(dirname "$0")/functions.sh"

make_knit

works voxelize knit.bcc --yarn cotton --voxels 48 --keep-masks -o masks.vdb --quiet
works lod-report masks.vdb --parents 20 --methods moments,naive --plot errors.svg
[ "$(grep -c '^| 1 |' out.txt)" -eq 3 ] ||
    wrong "not a row for the file and two methods: $(cat out.txt)"
[ "$(head -c 4 errors.svg)" = '<svg' ] || wrong "the plot is no SVG"
works lod-report masks.vdb --parents 20 --methods single --json
[ "$(json coverage_truth)" = union ] || wrong "masks give no union"
works lod-report masks.vdb --parents 20 --methods wasserstein --part 500 --quiet
works voxelize knit.bcc --voxels 32 --levels 0 -o level0.vdb --quiet
fails 3 "level0.vdb: has only the finest level" lod-report level0.vdb
fails 3 "missing.vdb" lod-report missing.vdb
fails 3 "knit.bcc: byte 0: not a VDB" lod-report knit.bcc
fails 2 "did you mean 'moments'?" lod-report masks.vdb --methods moment
fails 2 "--plot: 'x.png' must end in .svg" lod-report masks.vdb --plot x.png
fails 1 "nowhere" lod-report masks.vdb --plot nowhere/x.svg

finish
