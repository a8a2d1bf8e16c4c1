#!/usr/bin/env python3
"""Speed, memory and size of the levels of detail that `heddle voxelize` builds, as a markdown
table.

usage: bench/levels_speed.py [--quick]
The sweater at 1024 and 2048 voxels, straight hair, generated cloth of solid yarn from 1 M to 50 M
voxels of one size, and the scarf part (an import: levels from stored lobes). Times of levels are
the sum over all threads, divided by their number.
Needs build/release/bin/heddle (or HEDDLE=...) and ../shared/data (or HEDDLE_TEST_DATA=...).
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEDDLE = os.environ.get("HEDDLE", os.path.join(ROOT, "build/release/bin/heddle"))
DATA = os.environ.get("HEDDLE_TEST_DATA", os.path.join(ROOT, "../shared/data"))
THREADS = os.cpu_count()


def heddle(*words):
    out = subprocess.run([HEDDLE, *words, "--json"], check=True, capture_output=True).stdout
    return json.loads(out)


def row(name, result, path):
    levels = heddle("info", path)["levels"]
    sizes = [level["bytes"] for level in levels]
    if "levels_thread_seconds" in result:  # built within the voxelizer
        seconds = result["levels_thread_seconds"] / THREADS
        share = f"{seconds / (result['voxelize_seconds'] - seconds):.0%}"
    else:
        seconds = result["levels_seconds"]
        share = "-"
    peak = result["peak_memory_bytes"]
    predicted = result.get("predicted_peak_memory_bytes")
    off = f"{predicted / peak - 1:+.0%}" if predicted else "-"
    voxels = levels[0]["voxels"]
    print(
        f"| {name} | {voxels / 1e6:.2f} | {len(levels)} | {seconds:.2f} | {voxels / seconds / 1e6:.1f} | "
        f"{seconds / voxels * 1e9:.0f} | {share} | {sum(sizes) / sizes[0]:.2f} | {peak / 1048576:.0f} | {off} |"
    )
    sys.stdout.flush()
    os.remove(path)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="small sizes only")
    quick = arguments.parse_args().quick
    print(
        "| input | M voxels of level 0 | levels | seconds | M voxels/s | ns a voxel | of the voxelizing | "
        "file / level 0 | peak MiB | predicted |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        out = os.path.join(folder, "out.vdb")
        sweater = os.path.join(DATA, "yarn/bcc/sweater_flame_ribbing.bcc")
        if os.path.exists(sweater):
            for voxels in (512,) if quick else (1024, 2048):
                result = heddle("voxelize", sweater, "-o", out, "--yarn", "silk", "--yarn-radius",
                                "0.1", "--fibers", "150", "--voxels", str(voxels))
                row(f"sweater, 150 fibers, {voxels}", result, out)
            result = heddle("voxelize", os.path.join(DATA, "hair/straight.hair"), "-o", out)
            row("straight hair, 512", result, out)
        cloth = os.path.join(folder, "cloth.bcc")
        size = None  # of a voxel, the same for all: only the cloth grows
        for yarns in (88, 200) if quick else (88, 200, 400, 620):
            heddle("generate", "plain", "--counts", f"{yarns},{yarns}", "-o", cloth)
            how = ["--voxel-size", size] if size else ["--voxels", "400"]
            result = heddle("voxelize", cloth, "-o", out, *how)
            size = size or repr(result["voxel_size"][0])
            row(f"plain weave, {yarns} x {yarns} solid yarns", result, out)
        scarf = os.path.join(DATA, "volume/scarf-part.tar.xz")
        if os.path.exists(scarf):
            subprocess.run(["tar", "xJf", scarf, "-C", folder], check=True)
            path = os.path.join(folder, "scarfpart/data/volume_description.vol")
            row("scarf part, import", heddle("voxelize", path, "-o", out), out)


if __name__ == "__main__":
    main()
