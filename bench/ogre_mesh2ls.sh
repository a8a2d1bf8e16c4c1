#!/usr/bin/env bash
# ogre.obj at 2048 voxels along the longest axis, 1 subvoxel per axis: heddle against OpenVDB's mesh
# to level set, from the .obj to a finished .vdb, alternating in one run. usage: bash
# bench/ogre_mesh2ls.sh [RUNS]   (needs build/release/bin/heddle, vdb_tool, xz, GNU time)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
data=${HEDDLE_TEST_DATA:-$root/../shared/data}
heddle=${HEDDLE:-$root/build/release/bin/heddle}
runs=${1:-5}
voxels=2048
for tool in "$heddle" vdb_tool xz /usr/bin/time; do
  command -v "$tool" >/dev/null || { echo "ogre_mesh2ls: '$tool' is missing" >&2; exit 1; }
done
[ -f "$data/mesh/ogre.obj.xz" ] ||
    { echo "ogre_mesh2ls: skipped, no $data/mesh/ogre.obj.xz" >&2; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
xz -dc "$data/mesh/ogre.obj.xz" >"$work/ogre.obj"
cd "$work"

# measure FILE COMMAND...: appends "wall CPU MiB" of the command to the file
measure() {
  local name=$1
  shift
  /usr/bin/time -o time.txt -f "%e %U %S %M" "$@" >log.txt 2>&1
  awk '{ printf "%s %.2f %.0f\n", $1, $2 + $3, $4 / 1024 }' time.txt >>"$name.runs"
}
median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
column() { awk -v c="$2" '{ print $c }' "$1" | median; }

for _ in $(seq "$runs"); do
  measure heddle "$heddle" voxelize ogre.obj -o ogre.vdb --voxels $voxels --subvoxels 1
  sed -n 's/^\(read\|plan\|voxelize\|write\) .* \([0-9.]*\) s$/\1 \2/p' log.txt >>stages.txt
  grep -E '^voxels ' log.txt >voxels.txt
  for width in 3 1; do # 3: the default of vdb_tool; 1: the minimum, one voxel on each side
    measure "mesh2ls, width $width" vdb_tool -read ogre.obj -mesh2ls dim=$voxels width=$width \
      -write ls.vdb
  done
done
model=$(lscpu | sed -n 's/^Model name: *//p')
commit=$(git -C "$root" rev-parse --short HEAD)
echo "| ogre.obj to .vdb, $voxels voxels | wall s | CPU s | peak MiB | times heddle's: wall | CPU | peak |"
echo "|---|---|---|---|---|---|---|"
for who in heddle "mesh2ls, width 3" "mesh2ls, width 1"; do
  echo -n "| $who"
  for c in 1 2 3; do echo -n " | $(column "$who.runs" $c)"; done
  for c in 1 2 3; do # the ratio of the two runs of each pair
    paste -d' ' "$who.runs" heddle.runs | awk -v c=$c '{ print $c / $(c + 3) }' | median |
      awk '{ printf " | %.1f", $1 }'
  done
  echo " |"
done
echo
echo "heddle's stages, median s: $(for s in read plan voxelize write; do
  echo -n "$s $(awk -v s=$s '$1 == s { print $2 }' stages.txt | median); "
done)$(tr -s ' ' <voxels.txt)"
echo "Median of $runs runs by turns; $model, $(nproc) cores; load $(cut -d' ' -f1 /proc/loadavg) at the end;" \
  "commit $commit."
