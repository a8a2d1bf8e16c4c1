#!/usr/bin/env bash
# window_test.sh HEDDLE TESTS: drives the window of `heddle view` under Xvfb by mouse and keys:
# orbit, edit, voxelize, save, close. Exits with 77 without Xvfb or xdotool. With RECORD=DIR it
# saves a screenshot of each step there (ImageMagick's import).
set -uo pipefail
heddle=$1
tests=$2
for tool in Xvfb xdotool; do
    command -v $tool >/dev/null || { echo "no $tool here: skipped"; exit 77; }
done
work=$(mktemp -d)
cd "$work" || exit 1
failures=0
xvfb=""
trap '[ -z "$xvfb" ] || kill "$xvfb"; rm -rf "$work"' EXIT

wrong() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
# until_true SECONDS COMMAND...: tries the command ten times per second
until_true() {
    local left=$(($1 * 10))
    shift
    until "$@"; do
        [ $((left -= 1)) -gt 0 ] || return 1
        sleep 0.1
    done
}
step=0
record() {
    step=$((step + 1))
    [ -z "${RECORD:-}" ] || import -window root "$RECORD/$step-$1.png"
}
# saved FILE: the file is new, or has changed
saved() {
    [ -s "$1" ] && { [ ! -e "$1.before" ] || ! cmp -s "$1" "$1.before"; }
}
# save KEY FILE: presses the key until the file is written again
save() {
    press_for_file() {
        xdotool key "$1"
        sleep 0.3
        saved "$2"
    }
    until_true 30 press_for_file "$1" "$2" || wrong "key $1 did not save $2"
    cp "$2" "$2.before"
}

# libraries of X and EGL keep memory after they are unloaded; only that remains to be reported
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"

Xvfb -displayfd 3 -screen 0 700x500x24 3>display.txt >/dev/null 2>&1 &
xvfb=$!
until_true 20 test -s display.txt || { wrong "Xvfb does not start"; exit 1; }
export DISPLAY=:$(cat display.txt)

"$heddle" generate knit --counts 3,3 -o knit.bcc --quiet || wrong "generate"
"$heddle" view knit.bcc --yarn cotton --fibers 30 --up z --size 640x480 >report.txt 2>words.txt &
view=$!
until_true 60 xdotool search --name 'knit - heddle' >/dev/null 2>&1 ||
    wrong "no window: $(cat words.txt)"
xdotool mousemove 450 250
save s knit_view.png
record open
xdotool mousedown 1 mousemove 400 230 mousemove 350 200 mouseup 1
save s knit_view.png
record orbit
xdotool key bracketright key bracketright key period
save s knit_view.png
record radius-and-twist
xdotool click 4 click 4
save s knit_view.png
record zoom
xdotool key v
save w knit_view.vdb
record voxels
save s knit_view.png
xdotool key 1
save s knit_view.png
save e knit_view.toml
record slices-again
xdotool key q
wait $view
status=$?
[ $status -eq 0 ] || wrong "exit code $status: $(cat words.txt)"
grep -q 'inputs shown' report.txt || wrong "no report: $(cat report.txt)"
! grep -qv '^note: ' words.txt || wrong "words on stderr: $(cat words.txt)"
cat report.txt

"$heddle" render knit_view.toml --samples 1 --size 32x32 --quiet -o scene.png ||
    wrong "the saved scene does not render"
[ "$("$heddle" info knit_view.vdb | grep -c voxels)" -gt 0 ] ||
    wrong "the saved .vdb cannot be read"

# Ctrl-C closes it
"$heddle" view knit.bcc --size 200x200 >/dev/null 2>words.txt &
view=$!
until_true 60 xdotool search --name 'knit - heddle' >/dev/null 2>&1 || wrong "no second window"
kill -INT $view
wait $view
[ $? -eq 130 ] || wrong "Ctrl-C does not end it with 130: $(cat words.txt)"

"$tests" --gtest_filter='Window.*' >out.txt 2>&1 || wrong "$(cat out.txt)"
! grep -q SKIPPED out.txt || wrong "the window's own tests were skipped"

# no display: one line
DISPLAY=:12345 "$heddle" view knit.bcc >out.txt 2>words.txt
[ $? -eq 4 ] || wrong "not exit code 4 without a display"
[ "$(grep -vc '^note: ' words.txt)" -eq 1 ] ||
    wrong "not one line without a display: $(cat words.txt)"

[ $failures -eq 0 ] && echo "window: all right"
exit $((failures > 0))
