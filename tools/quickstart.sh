#!/usr/bin/env bash
# From nothing to a picture: packages, build, a knitted swatch, its volume, its picture; then a
# table of what was done.
set -euo pipefail
cd "$(dirname "$0")/.."
out=build/quickstart
heddle=build/release/bin/heddle
mkdir -p "$out"

table=""
# step LABEL RESULT COMMAND...: runs the command and adds a row with its seconds and what RESULT
# then says
step() {
    local label=$1 result=$2 start=$EPOCHREALTIME
    shift 2
    echo "== $label: $*"
    "$@"
    local seconds
    seconds=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
    table+=$(printf '%-10s %8s  %s' "$label" "$seconds" "$(eval "$result")")$'\n'
}
size_of() { echo "$1, $(numfmt --to=iec-i --suffix=B "$(stat -c %s "$1")")"; }
build() {
    cmake --preset release >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
    cmake --build --preset release --target heddle
}

step packages "echo tools/packages.txt" bash tools/setup.sh
step build "echo $heddle" build
step generate "size_of $out/knit.bcc" "$heddle" generate knit -o "$out/knit.bcc"
step voxelize "size_of $out/knit.vdb" \
    "$heddle" voxelize "$out/knit.bcc" --yarn cotton -o "$out/knit.vdb"
step render "size_of $out/knit.png" "$heddle" render "$out/knit.vdb" -o "$out/knit.png" --samples 32

printf '\n%-10s %8s  %s\n%s' step seconds result "$table"
