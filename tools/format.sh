#!/usr/bin/env bash
# Formats the sources in place, and names the lines that pass 100 columns, which are wrapped by
# hand; with --check it changes nothing. Fails where a line is too long, or with --check where a
# file differs.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=-i
if [ "${1:-}" = --check ]; then mode="--dry-run -Werror"; fi
sources() {
    find . \( -path ./build -o -path ./.git \) -prune -o -type f \( "$@" \) -print0
}
# shellcheck disable=SC2086 # mode is words
sources -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' |
    xargs -0 -P "$(nproc)" -n 8 clang-format-14 $mode

# a text of a program stays whole, so that it can be searched for: its length does not count
sources -name '*.h' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' -o -name '*.cmake' \
    -o -name CMakeLists.txt -o -name '*.sh' -o -name '*.py' -o -path ./.ci/run |
    xargs -0 perl -CSD -ne '
        chomp;
        my $line = $_;
        s/"(?:\\.|[^"\\])*"/""/g;
        s/\x27[^\x27]*\x27/\x27\x27/g if $ARGV =~ /\.(sh|py)$|run$/ && !/^\s*#/;
        if (length > 100) {
            print STDERR "$ARGV:$.: ", length $line, " columns, 100 are allowed\n";
            $long = 1;
        }
        close ARGV if eof;
        END { exit($long ? 1 : 0) }'
