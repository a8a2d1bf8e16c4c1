#!/usr/bin/env bash
# view_answer.sh HEDDLE [OUT]: a markdown table of the time from an input to the picture that shows
# it, in the window of `heddle view` with slices, under Xvfb: 40 steps each of orbit, zoom, light,
# radius and twist. Screenshots are saved in OUT.
set -euo pipefail
heddle=$(realpath "$1")
out=${2:+$(realpath "$2")}
work=$(mktemp -d)
trap 'kill "$xvfb" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
Xvfb -displayfd 3 -screen 0 1100x1000x24 3>display.txt >/dev/null 2>&1 &
xvfb=$!
until [ -s display.txt ]; do sleep 0.1; done
export DISPLAY=:$(cat display.txt)
"$heddle" slice cotton -o cotton.png --yarn-file cotton.toml --quiet

# input COUNTS
input() {
    for i in $(seq 10); do
        xdotool mousemove $((700 - 10 * i)) 500 mousedown 1 mousemove $((690 - 10 * i)) \
            $((500 - 3 * i)) mouseup 1
        sleep 0.3
        xdotool click $((4 + i % 2))
        sleep 0.3
        xdotool mousedown 3 mousemove $((680 - 10 * i)) 480 mouseup 3
        sleep 0.3
        xdotool key "$([ $((i % 2)) = 0 ] && echo bracketright || echo period)"
        sleep 0.3
    done
}
echo "| loops | slices | inputs | median answer, ms | slowest, ms |"
echo "|---|---|---|---|---|"
for counts in 8,8 17,8 34,16 68,32; do
    "$heddle" generate knit --counts $counts -o knit.bcc --quiet
    "$heddle" view knit.bcc --yarn cotton.toml --up z --size 960x960 \
        --json >report.json 2>words.txt &
    view=$!
    until xdotool search --name 'knit - heddle' >/dev/null 2>&1; do sleep 0.2; done
    sleep 5
    input
    [ -z "$out" ] || import -window root "$out/knit_$counts.png"
    slices=$("$heddle" view knit.bcc --yarn cotton.toml --up z --headless -o pictures --size 960x960 \
        --json 2>/dev/null | grep -o '"slices":[^,]*' | tr -dc 0-9)
    xdotool key q
    wait $view
    number() { grep -o "\"$1\": *[0-9.e+]*" report.json | grep -o '[0-9.e+]*$'; }
    echo "| $counts | $slices | $(number inputs_shown) | $(number median_answer) | $(number slowest_answer) |"
done
