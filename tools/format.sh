#!/usr/bin/env bash
# Formats the sources in place; with --check only says which differ, and fails if one does.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=-i
if [ "${1:-}" = --check ]; then mode="--dry-run -Werror"; fi
# shellcheck disable=SC2086 # mode is words
find . \( -path ./build -o -path ./.git \) -prune -o \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' \) -print |
    xargs -P "$(nproc)" -n 8 clang-format-14 $mode
