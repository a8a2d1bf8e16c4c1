#!/usr/bin/env bash
# raster_tables.sh BUILD sort|slices|images|paths|frames|blocks ...: tables of [LopezMoreno17] and
# of the rasterizing voxelizer, from a build with -DHEDDLE_BENCH=ON. Files are written to TMPDIR:
# with a tmpfs there the times exclude the disk.
set -euo pipefail
heddle=$(realpath "$1/bin/heddle")
tables=$(realpath "$1/bench/heddle_raster_tables")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# json FILE KEY: prints a number or text of a report
json() { sed -n "s/^  \"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p" "$1"; }
mib() { awk -v b="$1" 'BEGIN { printf "%.1f", b / 1048576 }'; }
# cpu ARGUMENT...: the CPU seconds of the median of three runs
cpu() {
    local TIMEFORMAT=%U
    for _ in 1 2 3; do { time "$heddle" "$@" --quiet >/dev/null; } 2>&1; done | sort -n | sed -n 2p
}

paths() {
    echo "| drawn | slices | fragment: CPU s | compute: CPU s | same bits |"
    echo "|---|---|---|---|---|"
    local row hash
    for row in "knit.bcc --yarn slice.toml --yarn-radius 0.1 --voxel-size 0.06" \
        "hair.hair --voxels 256"; do
        # shellcheck disable=SC2086
        set -- $row --backend raster --levels 0 -o path.vdb
        "$heddle" voxelize "$@" --raster-path fragment --json >report.txt 2>/dev/null
        "$heddle" info path.vdb --json >info.txt
        hash=$(json info.txt content_hash)
        echo -n "| $1 | $(json report.txt slices) | $(cpu voxelize "$@" --raster-path fragment) |"
        echo -n " $(cpu voxelize "$@" --raster-path compute) |"
        "$heddle" info path.vdb --json >info.txt
        [ "$(json info.txt content_hash)" = "$hash" ] && echo " yes |" || echo " no |"
    done
}

frames() {
    echo "| loops | backend | 4 frames in one run, s | 4 runs, s | CPU s | CPU s of 4 runs |"
    echo "|---|---|---|---|---|---|"
    local TIMEFORMAT="%R %U" loops backend k
    for loops in 2,2 8,8; do
        for k in 1 2 3 4; do "$heddle" generate knit --counts $loops -o f_000$k.bcc --quiet; done
        for backend in sample raster; do
            set -- --yarn slice.toml --voxel-size 0.06 --yarn-radius 0.1 --backend $backend --quiet
            { time "$heddle" voxelize f_%04d.bcc --frames 1-4 "$@" -o f_%04d.vdb; } 2>one.txt
            { time for k in 1 2 3 4; do "$heddle" voxelize f_000$k.bcc "$@" \
                -o f_000$k.vdb; done; } 2>four.txt
            read -r real user <one.txt
            read -r real4 user4 <four.txt
            echo "| $loops | $backend | $real | $real4 | $user | $user4 |"
        done
    done
}

# render FILE: the CPU seconds of a path tracer, and its MiB of voxels
render() {
    local TIMEFORMAT=%U
    { time "$heddle" render "$1" -o picture.exr --size 256x256 --samples 32 \
        --json >picture.txt 2>/dev/null; } 2>picture.time
    echo "$(cat picture.time) | $(mib "$(json picture.txt scene_memory_bytes)")"
}

blocks() {
    echo "| cloth | file | blocks an axis | blocks | of them occupied | MiB | export: CPU s | import: CPU s | render: CPU s | scene, MiB |"
    echo "|---|---|---|---|---|---|---|---|---|---|"
    local shape n voxels TIMEFORMAT=%U
    for shape in flat hanging; do
        "$heddle" generate knit --counts 40,40 --shape $shape -o sheet.bcc --quiet
        for n in "all levels|" "level 0|--levels 0" \
            "level 0, as exported|--levels 0 --lobes 1 --footprints 0"; do
            # shellcheck disable=SC2086
            "$heddle" voxelize sheet.bcc --yarn cotton --voxels 512 ${n#*|} -o sheet.vdb --quiet
            echo "| $shape | .vdb, ${n%|*} | | | | $(mib "$(stat -c %s sheet.vdb)") | | | $(render sheet.vdb) |"
        done
        voxels=
        for n in 0 65 33 17 9 5; do
            rm -rf blocks
            { time "$heddle" export sheet.vdb --to mitsuba06 --block-samples $n -o blocks \
                --json >export.txt; } 2>export.time
            { time "$heddle" voxelize blocks/volume.vol --levels 0 -o back.vdb \
                --quiet; } 2>import.time
            "$heddle" info back.vdb --json >info.txt
            [ "$(json info.txt voxels)" = "${voxels:=$(json info.txt voxels)}" ] ||
                echo "other voxels with $n" >&2
            read -r x y z <<<"$(tr -d '\n' <export.txt | sed 's/.*"cells": \[\([^]]*\)\].*/\1/; s/,/ /g')"
            echo -n "| $shape | blocks of $n samples | $x x $y x $z | $((x * y * z)) |"
            echo -n " $(awk -v b="$(json export.txt blocks)" -v n=$((x * y * z)) 'BEGIN { printf "%.0f %%", 100 * b / n }') |"
            echo " $(mib "$(json export.txt files_bytes)") | $(tail -1 export.time) | $(tail -1 import.time) | $(render back.vdb) |"
        done
    done
}

"$heddle" slice cotton -o slice.png --yarn-file slice.toml --quiet
"$heddle" generate knit --counts 8,8 -o knit.bcc --quiet
"$heddle" generate hair --counts 200,8 -o hair.hair --quiet
for table in "${@:2}"; do
    echo "### $table"
    case $table in
    sort | slices | images) "$tables" "$table" ;;
    *) "$table" ;;
    esac
done
