#!/usr/bin/env bash
# view_record.sh HEDDLE FILE YARN OUT: drives the window of `heddle view` on a file under Xvfb by
# mouse and keys: open, orbit, radius and twist, zoom, voxelize the visible part, pick the block
# under the mouse, save. Saves a screenshot of each step in OUT.
set -euo pipefail
heddle=$(realpath "$1")
file=$(realpath "$2")
yarn=$3
[ ! -e "$yarn" ] || yarn=$(realpath "$yarn")
mkdir -p "$4"
cd "$4"
trap 'kill "$xvfb" 2>/dev/null' EXIT
Xvfb -displayfd 3 -screen 0 1280x800x24 3>display.txt >/dev/null 2>&1 &
xvfb=$!
until [ -s display.txt ]; do sleep 0.1; done
export DISPLAY=:$(cat display.txt)
step=0
# shot NAME SECONDS: waits until the picture is refined, and saves the screen
shot() {
    sleep "$2"
    step=$((step + 1))
    import -window root "$step-$1.png"
}
"$heddle" view "$file" --yarn "$yarn" --size 1280x800 >report.txt 2>notes.txt &
view=$!
until xdotool search --name ' - heddle' >/dev/null 2>&1; do sleep 0.2; done
shot open 12
xdotool mousemove 900 400 mousedown 1 mousemove 850 420 mousemove 780 450 mouseup 1
shot orbit_at_once 0.4
shot orbit 12
for key in bracketright bracketright bracketright period period; do xdotool key $key; done
shot radius_and_twist 12
xdotool mousemove 800 400
for _ in $(seq 12); do xdotool click 4; sleep 0.05; done
shot nearer 15
xdotool key v
shot voxelizing 1
shot voxels 25
xdotool key b
shot white_block 12
xdotool key 1
shot slices_again 15
xdotool key s key e
sleep 15
shot saved 2
xdotool key q
wait $view
cat report.txt
