#!/usr/bin/env bash
# generate.sh HEDDLE: weaves have their curves, and the kind and the suffix are checked.
. "$(dirname "$0")/functions.sh"

fails 2 "did you mean 'knit'?" generate knot -o a.bcc
fails 2 "must end in .bcc" generate knit -o a.obj

# the file of a weave contains its warp and its weft, as reported: NX yarns of 8 NY + 3 points and
# NY of 8 NX + 3
number() { od -An -t u8 -j "$1" -N 8 "$2" | tr -d ' '; }
for kind in plain twill satin; do
    works generate $kind --counts 7,5 -o weave.bcc --json
    points=$(number 16 weave.bcc)
    [ "$(number 8 weave.bcc)" -eq 12 ] ||
        wrong "$kind: $(number 8 weave.bcc) curves are in the file, not 7 + 5"
    [ "$points" -eq $((7 * 43 + 5 * 59)) ] || wrong "$kind: $points points are in the file"
    [ "$points" -eq "$(json nodes)" ] ||
        wrong "$kind: $points points are in the file, the report says $(json nodes)"
    [ "$(wc -c <weave.bcc)" -eq $((64 + 12 * 4 + points * 12)) ] ||
        wrong "$kind: $(wc -c <weave.bcc) bytes"
    works info weave.bcc --json
    [ "$(json curves)" -eq 12 ] || wrong "$kind: info sees $(json curves) curves"
done

finish
