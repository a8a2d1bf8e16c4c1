#!/usr/bin/env bash
# Voxelizes and previews every file under shared/data/{yarn,hair,mesh}, one command each, and joins
# the pictures to one sheet per folder. usage: bash bench/contact_sheet.sh OUT_FOLDER (needs
# build/release/bin/heddle, xz; for the sheets ImageMagick's montage)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
data=${HEDDLE_TEST_DATA:-$root/../shared/data}
heddle=${HEDDLE:-$root/build/release/bin/heddle}
out=${1:?usage: contact_sheet.sh OUT_FOLDER}
[ -d "$data" ] || { echo "contact_sheet: skipped, no $data" >&2; exit 0; }
mkdir -p "$out"
: >"$out/commands.txt"

# picture NAME FOLDER FILE PREVIEW-OPTIONS VOXELIZE-OPTIONS...
picture() {
  local name=$1 sheet=$2 file=$3 look=$4
  shift 4
  echo "heddle voxelize ${file#"$data"/} -o $name.vdb $*" >>"$out/commands.txt"
  "$heddle" voxelize "$file" -o "$out/$name.vdb" --quiet "$@" ||
      { echo "failed: $name" >&2; return; }
  # shellcheck disable=SC2086 # options are words
  "$heddle" preview "$out/$name.vdb" -o "$out/$sheet-$name.png" --size 640x640 --quiet $look
  rm "$out/$name.vdb"
}

yarn=$data/yarn
for f in cable_work_pattern flame_ribbing_pattern sweater_flame_ribbing tea_cozy; do
  picture $f yarn "$yarn/bcc/$f.bcc" "" --yarn cotton --voxels 640
done
for f in glove knittubeinit; do picture $f yarn "$yarn/bcc-modified/$f.bcc" "" --yarn wool \
    --voxels 512; done
for f in basket cartridge_belt_rib satin stockinette stockinette_small; do
  picture $f yarn "$yarn/patterns/$f.pyp" "" --yarn cotton --repeat 3,3 --voxels 512
done
for fit in cotton1 rayon1 silk1; do # a close-up of a piece, which shows plies and fibers
  params=$(find "$data/params" -name "$fit*.txt" | head -1)
  picture cable_$fit fits "$yarn/bcc/cable_work_pattern.bcc" "--color tangent" --yarn "$params" \
    --voxel-size 0.012 --bounds -1.5,-1.5,-5,1.5,1.5,5
done
picture straight hair "$data/hair/straight.hair" "" --voxels 512
picture bangs_hair hair "$data/hair/ct2hair/Bangs_100.hair" "--color tangent" --yarn-radius 0.1 \
    --voxels 512
picture bangs_data hair "$data/hair/ct2hair/Bangs_100.data" "--color tangent" --yarn-radius 0.1 \
    --voxels 512
picture harolongo hair "$data/hair/digital-salon/harolongo.data" "--color tangent" --voxels 512
for f in "$data"/mesh/*.glb "$data"/mesh/*/*.gltf "$data"/mesh/*.obj; do
  look=""
  case $f in *Anisotropy*) look="--color tangent" ;; esac
  picture "$(basename "$f" | cut -d. -f1)" mesh "$f" "$look" --voxels 512
done
for f in $(find "$data/mesh" -name '*.obj.xz'); do
  name=$(basename "$f" .obj.xz)
  xz -dc "$f" >"$out/$name.obj"
  picture "$name" mesh "$out/$name.obj" "" --voxels 512
  rm "$out/$name.obj"
done
if command -v montage >/dev/null; then
  for sheet in yarn fits hair mesh; do
    montage "$out/$sheet"-*.png -label '%t' -geometry 480x480+4+4 -tile 3x "$out/sheet-$sheet.png"
  done
fi
