#!/usr/bin/env bash
# Runs clang-tidy with the checks of .clang-tidy over the sources that build/release compiles, tests
# and benches left out, and fails if one has findings. Two quiet cores take some 5 minutes. The
# precompiled headers are taken away, so a file that does not include what it uses is found as well.
# Usage: bash tools/tidy.sh [REGEX of the paths to check, default all]
set -euo pipefail
cd "$(dirname "$0")/.."
start=$SECONDS
tidy=$(command -v clang-tidy-14 || command -v clang-tidy) ||
    { echo "no clang-tidy here" >&2; exit 1; }
mkdir -p build/tidy
[ -e build/release/compile_commands.json ] || cmake --preset release >build/tidy/configure.log
# clang knows neither g++'s precompiled headers nor the flags that go with them
sed -E 's/ -Winvalid-pch| -fpch-preprocess| -include [^ ]*cmake_pch\.hxx//g' \
    build/release/compile_commands.json >build/tidy/compile_commands.json
files=$(sed -nE "s|^ *\"file\": \"$PWD/(src/heddle/[^\"]*\.cpp)\",?$|\1|p" \
    build/tidy/compile_commands.json | grep -v '_test\.cpp$' | grep -E -- "${1:-.}" | sort -u)
# shellcheck disable=SC2016,SC2086 # the inner shell expands; files are words
if printf '%s\n' $files | xargs -P "$(nproc)" -n 4 "$tidy" -p build/tidy --quiet \
    --extra-arg=-w >build/tidy/findings.txt 2>build/tidy/errors.txt; then
    echo "tidy: $(wc -w <<<"$files") files are clean, $((SECONDS - start)) s"
else
    grep -E '(error|warning):' build/tidy/findings.txt | sort -u
    grep -E 'error' build/tidy/errors.txt | sort -u | head -20 || true
    echo "tidy: findings in $(wc -w <<<"$files") files, $((SECONDS - start)) s" >&2
    exit 1
fi
