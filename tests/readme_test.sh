#!/usr/bin/env bash
# readme_test.sh HEDDLE REPO: runs every marked command of README.md and compares the option tables
# of docs/options.md with those of the program.
set -euo pipefail
PATH=$(dirname "$1"):$PATH
readme=$2/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

awk '/^<!-- run by tests\/readme_test.sh -->/ { marked = 1; next }
     marked && /^```sh/ { inside = 1; next }
     /^```/ { inside = 0; marked = 0 }
     inside' "$readme" >commands.sh
[ "$(grep -c '^heddle ' commands.sh)" -ge 8 ] ||
    { echo "README.md has lost its commands" >&2; exit 1; }
bash -euxo pipefail commands.sh

awk '/^<!-- end of heddle help-tables -->/ { inside = 0 }
     inside
     /^<!-- heddle help-tables -->/ { inside = 1 }' "$2/docs/options.md" >tables.md
heddle help-tables >program.md
diff -u tables.md program.md || {
    echo "the option tables of docs/options.md differ from the program's: run tools/update_options.sh" >&2
    exit 1
}
