#!/usr/bin/env bash
# On a machine with a GPU, cmake, a C++20 compiler and nvcc, and nothing else: builds the core,
# compares the bits of the CPU, the host executor and CUDA, looks for errors of memory on a small
# case, and prints tables of speed to commit under bench/results/. Needs no data and no network.
# Where libepoxy's headers and an OpenGL driver are, slices are drawn too. Usage: bash
# tools/gpu_check.sh [ROWS of the speed table, default 9] [MILLIONS OF SLICES, default "2.5 17.6
# 22.8 35.2"]
set -euo pipefail
cd "$(dirname "$0")/.."
rows=${1:-9}
slices=${2:-2.5 17.6 22.8 35.2}
PATH=$PATH:/usr/local/cuda/bin
build=build/gpu_check
start=$SECONDS

mkdir -p $build
architectures="75-virtual;90-real"
command -v nvidia-smi >/dev/null && architectures=native
gl=OFF
[ -e /usr/include/epoxy/egl.h ] && gl=ON
cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release -DHEDDLE_CUDA=ON -DHEDDLE_APPS=OFF \
    -DHEDDLE_TESTS=OFF \
    -DHEDDLE_PARALLEL=threads -DHEDDLE_WERROR=ON -DHEDDLE_DEVICE_CHECK=ON -DHEDDLE_GL_CHECK=$gl \
    -DCMAKE_CUDA_ARCHITECTURES="$architectures" >$build/configure.log 2>&1 ||
    { cat $build/configure.log >&2; exit 1; }
targets="heddle_device_parity heddle_device_speed"
[ $gl = OFF ] || targets="$targets heddle_gl_speed"
# shellcheck disable=SC2086 # targets are words
cmake --build $build -j "$(nproc)" --target $targets >$build/build.log 2>&1 ||
    { tail -40 $build/build.log >&2; exit 1; }
parity=$(find $build -name heddle_device_parity -type f)
speed=$(find $build -name heddle_device_speed -type f)

echo "# GPU check"
echo
echo "commit $(git rev-parse --short HEAD 2>/dev/null || echo unknown), $(date -u +%F), built in $((SECONDS - start)) s"
command -v nvidia-smi >/dev/null &&
    nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader
echo
echo "## Bits"
echo
"$parity"
echo
echo "## compute-sanitizer, small cases"
echo
if command -v compute-sanitizer >/dev/null; then
    for tool in memcheck racecheck initcheck; do
        compute-sanitizer --tool $tool --error-exitcode 9 "$parity" \
            --small >$build/$tool.log 2>&1 &&
            echo "- $tool: nothing found" ||
                { echo "- $tool: see below"; tail -30 $build/$tool.log; }
    done
else
    echo "not on this machine"
fi
echo
echo "## Speed"
echo
"$speed" "$rows"
echo
echo "## Longest kernels"
echo
if command -v ncu >/dev/null; then
    ncu --target-processes all --launch-skip 0 --launch-count 40 --section SpeedOfLight \
        --section Occupancy \
        --csv "$speed" 1 >$build/ncu.csv 2>$build/ncu.log || tail -5 $build/ncu.log
    grep -E '"(Duration|Compute \(SM\) Throughput|Memory Throughput|Achieved Occupancy)"' \
        $build/ncu.csv |
        awk -F'","' '{ print "- " substr($5, 1, 60) ": " $(NF-2) " " $NF " " $(NF-1) }' | tail -60
else
    echo "no ncu on this machine"
fi
echo
echo "## Slices by OpenGL"
echo
if [ $gl = ON ]; then
    # shellcheck disable=SC2086 # counts are words
    "$(find $build -name heddle_gl_speed -type f)" $slices || echo "not drawn"
else
    echo "no libepoxy here: bring libepoxy-dev, libepoxy0, libegl-dev, libgl-dev, libglx-dev, libx11-dev, x11proto-dev and the loaders"
fi
echo
echo "all in $((SECONDS - start)) s"
