#!/usr/bin/env bash
# voxelize.sh HEDDLE: the same voxels for any thread count and device; invalid values.
. "$(dirname "$0")/functions.sh"

make_knit
make_grass
make_hair
echo old >old.vdb

for size in 0 nan -1 inf 1,1,0 ''; do
    fails 2 "--voxel-size" voxelize knit.bcc --voxel-size "$size" -o old.vdb
done
fails 2 "2^40" voxelize knit.bcc --voxel-size 1e-30 -o old.vdb
fails 2 "2^40" voxelize knit.bcc --voxel-size 1e-9 -o old.vdb
fails 2 "--fibers" voxelize knit.bcc --fibers 10 -o old.vdb
fails 2 "--yarn" voxelize grass.glb --yarn cotton -o old.vdb
fails 4 "" voxelize knit.bcc --memory 1M --voxels 512 -o old.vdb
works voxelize knit.bcc --fill-memory --memory 60M --dry-run -o filled.vdb
fails 2 "--fill-memory chooses" voxelize knit.bcc --fill-memory --voxels 9 -o filled.vdb
fails 2 "--levels" voxelize knit.bcc --levels -1 -o old.vdb
kept_old

# the same bits for any thread count
works voxelize knit.bcc --yarn cotton --voxels 64 --threads 1 -o one.vdb --json
[ "$(json voxels)" -gt 100 ] || wrong "a knit has few voxels: $(json voxels)"
works voxelize knit.bcc --yarn cotton --voxels 64 --threads 3 -o three.vdb --json
works info one.vdb --json
hash=$(json content_hash)
works info three.vdb --json
[ "$(json content_hash)" = "$hash" ] || wrong "one thread and three give different voxels"
# the choice of a device: machines that run this have no GPU, or one that gives the same voxels
works voxelize knit.bcc --voxels 40 --device auto -o auto.vdb
works voxelize knit.bcc --voxels 40 --device cpu -o cpu.vdb
works info auto.vdb --json
auto_hash=$(json content_hash)
works info cpu.vdb --json
[ "$auto_hash" = "$(json content_hash)" ] || wrong "--device auto and cpu differ"
if ! "$heddle" voxelize knit.bcc --voxels 40 --device cuda -o cuda.vdb >out.txt 2>err.txt; then
    cp cpu.vdb cuda.vdb
    fails 4 "use --device cpu" voxelize knit.bcc --voxels 40 --device cuda -o cuda.vdb
    cmp -s cpu.vdb cuda.vdb || wrong "a refused --device cuda touched the old output"
fi
fails 2 "--device-memory cannot be used with --device cpu" voxelize knit.bcc -o a.vdb \
    --device cpu --device-memory 1G
works voxelize knit.bcc --dry-run --json -o dry.vdb
[ "$(json predicted_peak_memory_bytes)" -gt 0 ] || wrong "a dry run predicts no memory"
[ ! -e dry.vdb ] || wrong "a dry run wrote its output"
works voxelize grass.glb --voxels 64 -o grass.vdb --quiet
[ ! -s out.txt ] && [ ! -s err.txt ] || wrong "--quiet is not"
works voxelize hair.hair --voxels 64 -o hair.vdb
if command -v vdb_print >/dev/null; then
    vdb_print one.vdb | grep density >value.txt || wrong "vdb_print finds no density in our file"
fi

finish
