#!/usr/bin/env bash
# lod.sh HEDDLE: levels that are built again, and level 0 alone.
. "$(dirname "$0")/functions.sh"

make_knit
make_yarn
make_one

# the correlation of neighbours: level 0 alone has the same bytes as level 0 with others
for backend in sample raster; do
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --correlation --backend $backend \
        -o shared.vdb
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --correlation --backend $backend \
        --levels 0 -o shared0.vdb
    works lod shared.vdb --levels 0 -o cut.vdb
    works info shared0.vdb --json && hash0=$(json content_hash)
    works info cut.vdb --json && [ "$(json content_hash)" = "$hash0" ] ||
        wrong "--levels 0 has another correlation, $backend"
    works voxelize knit.bcc --yarn slice.toml --voxels 64 --backend $backend --levels 0 \
        -o shared0.vdb
    works info shared0.vdb --json && [ "$(json content_hash)" != "$hash0" ] ||
        wrong "no correlation is stored, $backend"
done
# levels built again: from masks bit for bit; without masks --exact refuses
works voxelize knit.bcc --yarn cotton --voxels 64 --keep-masks --correlation -o masks.vdb
works info masks.vdb --json
masks=$(json content_hash)
works lod masks.vdb --exact -o again.vdb
works info again.vdb --json
[ "$(json content_hash)" = "$masks" ] || wrong "levels built again from masks differ"
works lod one.vdb --lod single --lobes 1 -o single.vdb
works info single.vdb --json
[ "$(json lod)" = single ] || wrong "lod single says $(json lod)"
# a file without the cells of its voxels is of format 2, and so is what is made from it
format_of() {
    local at
    at=$(grep -obUa heddle_format "$1" | head -1 | cut -d: -f1)
    tail -c +$((at + 27)) "$1" | head -c 1 | od -An -tu1 | tr -d ' '
}
works voxelize knit.bcc --yarn cotton --voxels 32 --occupancy 0 -o plain.vdb
works lod plain.vdb --lod single -o plain_lod.vdb
works material plain.vdb --set 0.albedo=0.8,0.2,0.1 -o plain_red.vdb
for file in plain plain_lod plain_red; do
    [ "$(format_of $file.vdb)" = 2 ] || wrong "$file.vdb is of format $(format_of $file.vdb)"
done
for file in one single masks again; do
    [ "$(format_of $file.vdb)" = 3 ] || wrong "$file.vdb is of format $(format_of $file.vdb)"
    works info $file.vdb --json && grep -q '"occupancy_level_1"' out.txt ||
        wrong "$file.vdb has no occupancy"
done
fails 2 "--occupancy" voxelize knit.bcc --yarn cotton --voxels 32 --occupancy 8 -o kept.vdb
echo old >kept.vdb
fails 3 "one.vdb: holds no columns and sums" lod one.vdb --exact -o kept.vdb
fails 3 "kept.vdb: " lod kept.vdb -o new.vdb
fails 2 "did you mean 'moments'" lod one.vdb --lod moment -o kept.vdb
grep -q '^old$' kept.vdb || wrong "a refused command changed its output"
[ ! -e new.vdb ] || wrong "a refused command left an output"

finish
