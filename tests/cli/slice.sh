#!/usr/bin/env bash
# slice.sh HEDDLE: the slice image of a yarn, and the yarn file that uses it.
. "$(dirname "$0")/functions.sh"

works slice cotton --size 64 -o slice.png --yarn-file slice.toml --occlusion dark.png \
    --mipmaps sizes.png
fails 2 "is not a procedural yarn" slice slice.toml -o again.png

finish
