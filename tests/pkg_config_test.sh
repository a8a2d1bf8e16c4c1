#!/usr/bin/env bash
# pkg_config_test.sh PREFIX SOURCE CXX [FLAG...]: builds and runs a program by pkg-config.
set -euo pipefail
prefix=$1 source=$2 cxx=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pc=$(find "$prefix" -name heddle.pc)
export PKG_CONFIG_PATH=${pc%/*}
# shellcheck disable=SC2046 # flags are words
"$cxx" -std=c++20 "$@" "$source" $(pkg-config --cflags --libs heddle) -o "$work/program"
LD_LIBRARY_PATH=$(pkg-config --variable=libdir heddle) "$work/program"
