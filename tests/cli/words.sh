#!/usr/bin/env bash
# words.sh HEDDLE: the list of commands, the help of each, and the message for a misspelled word.
. "$(dirname "$0")/functions.sh"

works
[ "$(wc -l <out.txt)" -eq 8 ] || wrong "heddle alone prints $(wc -l <out.txt) lines, not 8"
for name in $("$heddle" help-tables | sed -n 's/^## heddle \(.*\)$/\1/p'); do
    grep -qw -- "$name" out.txt || wrong "heddle alone does not name $name"
done
works --version
for command in info generate slice voxelize lod lod-report material preview render view export; do
    works "$command" --help
    grep -q -- '--threads N' out.txt || wrong "no --threads in the help of $command"
done
fails 2 "did you mean 'voxelize'?" voxelise
fails 2 "did you mean '--voxels'?" voxelize a.bcc -o a.vdb --voxles 5
fails 2 "--lobes: 9 is out of range" voxelize a.bcc -o a.vdb --lobes 9
fails 2 "option --output is missing" voxelize a.bcc

finish
