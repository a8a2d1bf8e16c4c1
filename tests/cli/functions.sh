# Sourced by each script of this folder, which is called with the path of the program: checks of
# exit codes and messages, in a temporary folder that is removed at the end. `finish` ends a script.
set -uo pipefail
heddle=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

wrong() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
finish() {
    [ "$failures" -eq 0 ] && echo "all as expected"
    exit $((failures > 0))
}
# Mesa's threads may end while LeakSanitizer inspects them, and then it fails (1 run in 30): leaks
# in drawing are checked by the tests of the rooms.
heddle() {
    case " $* " in
    *" view "* | *" raster "*) ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0" "$heddle" "$@" ;;
    *) "$heddle" "$@" ;;
    esac
}
# fails CODE TEXT ARGUMENT...: exit code CODE, no stdout, one line on stderr that contains TEXT
fails() {
    local code=$1 text=$2
    shift 2
    heddle "$@" >out.txt 2>err.txt
    local status=$?
    [ $status -eq "$code" ] ||
        wrong "exit code $status, not $code: heddle $* ($(cat err.txt))"
    [ ! -s out.txt ] || wrong "an error printed to stdout: heddle $*"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "not one line on stderr: heddle $*: $(cat err.txt)"
    grep -qF -- "$text" err.txt || wrong "no '$text' in: $(cat err.txt)"
}
# works ARGUMENT...: exit code 0, only notes on stderr; stdout is in out.txt
works() {
    heddle "$@" >out.txt 2>err.txt || wrong "exit code $?: heddle $*: $(cat err.txt)"
    ! grep -qv '^note: ' err.txt || wrong "words on stderr: heddle $*: $(cat err.txt)"
}
# json KEY: prints the value of a key in out.txt
json() {
    cat >json.cmake <<'CMAKE'
file(READ out.txt text)
string(JSON value GET "${text}" ${KEY})
file(WRITE value.txt "${value}")
CMAKE
    cmake -DKEY="$1" -P json.cmake || wrong "no key '$1' in: $(cat out.txt)"
    cat value.txt
}
# interrupt JOB: sends Ctrl-C after a second of work; the job must end with exit code 130
interrupt() {
    sleep 1
    kill -INT "$1"
    wait "$1"
    local status=$?
    [ $status -eq 130 ] || wrong "Ctrl-C gives exit code $status, not 130: $(cat err.txt)"
}
# kept_old: the output from before the failed runs is unchanged, and there are no other files beside
# it
kept_old() {
    [ "$(cat old.vdb)" = old ] || wrong "a failed run changed the old output"
    local left
    left=$(find . -name '*.part' -o -name '.*heddle*' -o -name '*spool*')
    [ -z "$left" ] || wrong "left behind: $left"
}

# inputs
make_knit() { works generate knit --counts 6,6 -o knit.bcc; }
make_grass() { works generate grass --counts 20,4 -o grass.glb; }
make_hair() { works generate hair --counts 50,8 -o hair.hair; }
make_yarn() { works slice cotton --size 64 -o slice.png --yarn-file slice.toml; }
make_one() { works voxelize knit.bcc --yarn cotton --voxels 64 -o one.vdb; }
