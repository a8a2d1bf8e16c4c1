#!/usr/bin/env bash
# slice.sh HEDDLE: a slice of a yarn, and its yarn in a file.
. "$(dirname "$0")/functions.sh"

works slice cotton --size 64 -o slice.png --yarn-file slice.toml --occlusion dark.png \
    --mipmaps sizes.png
fails 2 "is not a procedural yarn" slice slice.toml -o again.png

finish
