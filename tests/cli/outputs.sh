#!/usr/bin/env bash
# outputs.sh HEDDLE: an output that cannot be written is reported before the work; old ones stay.
. "$(dirname "$0")/functions.sh"

make_knit
echo old >old.vdb
mkdir folder.vdb

fails 1 "nowhere" voxelize knit.bcc -o nowhere/x.vdb
fails 1 "folder.vdb" voxelize knit.bcc -o folder.vdb
fails 1 "/dev/full" generate knit -o /dev/full
for suffix in bcc vdb png; do ln -s /dev/full "full.$suffix"; done
fails 1 "full.bcc" generate knit -o full.bcc
fails 1 "full.vdb" voxelize knit.bcc -o full.vdb
fails 1 "full.png" preview old.vdb -o full.png
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && chmod 555 locked && fails 1 "locked/x.vdb" voxelize knit.bcc -o locked/x.vdb
fi
[ -c /dev/full ] || wrong "/dev/full was replaced"
"$heddle" info knit.bcc >/dev/full 2>err.txt
[ $? -eq 1 ] && grep -q "stdout" err.txt || wrong "a full stdout goes unnoticed"
# a full disk, simulated by a limit on the size of a file
(
    trap '' XFSZ
    ulimit -f 4
    fails 1 "old.vdb" voxelize knit.bcc --voxels 128 -o old.vdb --quiet
    fails 1 "big.bcc" generate knit --counts 60,60 -o big.bcc
    exit "$failures"
)
failures=$?
kept_old

# Ctrl-C
"$heddle" voxelize knit.bcc --yarn cotton --voxels 2048 --threads 1 -o old.vdb >out.txt 2>err.txt &
interrupt $!
kept_old

finish
