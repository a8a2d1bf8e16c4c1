#!/usr/bin/env bash
# resume.sh HEDDLE: a render stopped by Ctrl-C is resumed.
. "$(dirname "$0")/functions.sh"

make_knit
make_one

# stopped by Ctrl-C and resumed: the same bits as without a stop
"$heddle" render one.vdb -o killed.exr --size 64x64 --time 60 --threads 1 --quiet 2>err.txt &
interrupt $!
[ -s killed.exr ] && [ -s killed.exr.checkpoint ] || wrong "Ctrl-C left no picture or no checkpoint"
fails 3 "another scene" render one.vdb -o killed.exr --size 64x64 --level-offset 1 --resume
fails 3 "64 x 64" render one.vdb -o killed.exr --size 32x32 --resume
works render one.vdb -o killed.exr --size 64x64 --samples 1 --resume --json
[ "$(json resumed_from)" -ge 1 ] || wrong "a resumed render began again"

finish
