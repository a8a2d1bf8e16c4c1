#!/usr/bin/env bash
# level_sheet.sh X.vdb OUT.png [COLOR]: levels 0 to 5 of a volume side by side, one row per method
# in the order below, all built from the volume's own level 0. COLOR as in `heddle preview --color`.
# Needs build/release/bin/heddle (or HEDDLE=...) and ImageMagick.
set -euo pipefail
heddle=${HEDDLE:-$(dirname "$0")/../build/release/bin/heddle}
volume=$1
out=$2
color=${3:-tangent}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rows=()
for method in moments single naive random interpolate; do
    "$heddle" lod "$volume" --lod $method --quiet -o "$work/y.vdb" 2>"$work/words" ||
        { cat "$work/words" >&2; exit 1; }
    for level in 0 1 2 3 4 5; do
        "$heddle" preview "$work/y.vdb" --level $level --color "$color" --size 300x300 \
            --quiet -o "$work/$level.png"
    done
    convert "$work"/[0-5].png +append "$work/$method.png"
    rows+=("$work/$method.png")
done
convert "${rows[@]}" -append "$out"
echo "$out"
