#!/usr/bin/env bash
# Installs what is missing, checks the format, builds build/release and runs its tests.
set -euo pipefail
cd "$(dirname "$0")/.."
start=$SECONDS
bash tools/setup.sh
bash tools/format.sh --check
echo "test: format is right"
mkdir -p build
cmake --preset release >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
cmake --build --preset release
ctest --preset release -j "$(nproc)"
echo "test: all passed in $((SECONDS - start)) s"
