#!/usr/bin/env bash
# render.sh HEDDLE: pictures of volumes and scenes, and invalid options.
. "$(dirname "$0")/functions.sh"

make_knit
make_one

works render one.vdb -o picture.exr --size 32x24 --samples 2 --json
[ "$(json samples)" -eq 2 ] || wrong "2 samples became $(json samples)"
[ "$(json render_seconds)" != 0 ] || wrong "a render takes no time"
[ "$(head -c 4 picture.exr | od -An -tx1 | tr -d ' ')" = 762f3101 ] ||
    wrong "the picture is no OpenEXR"
works render one.vdb -o picture.png --size 32x24 --samples 1 --quiet --level 2 --transport product
[ "$(head -c 4 picture.png | tail -c 3)" = PNG ] || wrong "the picture is no PNG"
[ ! -s out.txt ] && [ ! -s err.txt ] || wrong "--quiet is not"
works render one.vdb -o other.png --size 32x24 --samples 1 --quiet --level 2 --transport product \
    --threads 1
cmp picture.png other.png || wrong "one thread renders another picture"
[ ! -e picture.png.checkpoint ] || wrong "a finished picture left its checkpoint"
cat >inside.toml <<'TOML'
[camera]
eye = [0.5, 0.5, 0.1]
target = [0, 0, 0]
[film]
size = [16, 16]
[integrator]
samples = 1
[[light]]
kind = "constant"
[object.cloth]
volume = "one.vdb"
TOML
works render inside.toml -o inside.exr --quiet
fails 2 "did you mean 'product'?" render one.vdb -o x.exr --transport prodct
fails 2 "--transport: ''" render one.vdb -o x.exr --transport ''
sed 's/samples = 1/transport = "prodct"/' inside.toml >transport.toml
fails 2 "unknown transport 'prodct'" render transport.toml -o x.exr
fails 2 "x.jpg' must end in .exr or .png" render one.vdb -o x.jpg
fails 2 "option --output is missing" render one.vdb
fails 2 "--size" render one.vdb -o x.exr --size 0x10
fails 2 "2^28" render one.vdb -o x.exr --size 65536x65536
fails 2 "--samples" render one.vdb -o x.exr --samples 0
fails 2 "--exposure" render one.vdb -o x.png --exposure nan
fails 2 "--geometry cannot be used with a .vdb" render one.vdb -o x.exr --geometry
fails 1 "nowhere" render one.vdb -o nowhere/x.exr
mkdir folder.exr && fails 1 "folder.exr" render one.vdb -o folder.exr
fails 3 "missing.vdb" render missing.vdb -o x.exr
fails 3 "missing.toml" render missing.toml -o x.exr
fails 3 "knit.bcc" render knit.bcc -o x.exr
fails 3 "one.vdb: has no level 9" render one.vdb -o x.exr --level 9
fails 3 "x.exr.checkpoint" render one.vdb -o x.exr --resume
for n in 100 5000 20000; do
    head -c $n one.vdb >cut.vdb && fails 3 "cut.vdb" render cut.vdb -o x.exr
done
sed 's/one.vdb/missing.vdb/' inside.toml >gone.toml && fails 3 "gone.toml:11" render gone.toml \
    -o x.exr
printf '%s\n' '[film]' 'size = [0, 5]' '[object.a]' 'volume = 5' 'colour = 1' >many.toml
"$heddle" render many.toml -o x.exr >out.txt 2>err.txt
[ $? -eq 3 ] && [ "$(wc -l <err.txt)" -ge 3 ] ||
    wrong "not all problems of a scene at once: $(cat err.txt)"
[ ! -e x.exr ] && [ ! -e x.exr.checkpoint ] || wrong "a refused render left an output"

finish
