#!/usr/bin/env bash
# Puts the program's option tables into docs/options.md; tests/readme_test.sh fails where they
# differ.
set -euo pipefail
cd "$(dirname "$0")/.."
build/release/bin/heddle help-tables >build/help-tables.md
awk '/^<!-- end of heddle help-tables -->/ { inside = 0 }
     !inside
     /^<!-- heddle help-tables -->/ {
         inside = 1
         while ((getline line < "build/help-tables.md") > 0) print line
     }
    ' docs/options.md >build/options.md
cp build/options.md docs/options.md
