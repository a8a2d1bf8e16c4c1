#!/usr/bin/env bash
# info.sh HEDDLE: the contents of a file, as a table and as JSON.
. "$(dirname "$0")/functions.sh"

make_knit
make_one

works info knit.bcc --json
[ "$(json curves)" -eq 6 ] || wrong "6 rows are not 6 curves: $(json curves)"
[ "$(grep -c bytes_per_voxel out.txt)" -eq 0 ] || wrong "curves have no levels"
works info one.vdb
grep -q '^level 0 .* KiB' out.txt || wrong "info lists no level 0: $(cat out.txt)"

finish
