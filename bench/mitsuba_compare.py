#!/usr/bin/env python3
"""Heddle's flakes beside Mitsuba 3 on the same volume, camera and lights, as a markdown table.

usage: bench/mitsuba_compare.py [--size 256] [--spp 4] [--picture 64] [--picture-spp 256]
                                [--variant scalar_rgb] [--keep DIR]
The scarf part is voxelized from its Mitsuba 0.6 dictionary, exported by `heddle export` (the dense
box, and doubled on each axis) and rendered by Mitsuba and by `heddle render --transport flakes`:
albedo 0.8 0.8 0.9, depth 64, Russian roulette from 5. --size and --spp are for the speed, --picture
and --picture-spp for the pictures that are compared. The mean ratio is over pixels that are not
pure sky. FLIP is that of the pictures in sRGB; FLIP of noise compares two of Heddle's pictures with
different seeds. Variance x time: Mitsuba's over Heddle's, from two pictures each.
Needs build/release/bin/heddle (or HEDDLE=...), ../shared/data (or HEDDLE_TEST_DATA=...), and Python
with mitsuba, numpy, flip-evaluator, OpenEXR.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEDDLE = os.environ.get("HEDDLE", os.path.join(ROOT, "build/release/bin/heddle"))
DATA = os.environ.get("HEDDLE_TEST_DATA", os.path.join(ROOT, "../shared/data"))


def render_mitsuba(scene_xml, variant, runs):
    """Runs in its own process, to get Mitsuba's peak. runs: [(size, spp, seed, .npy or '')]"""
    import mitsuba as mi
    import numpy as np
    mi.set_variant(variant)
    start = time.perf_counter()
    mi.load_file(scene_xml, spp=1, width=16, height=16)
    load = time.perf_counter() - start
    results = []
    for size, spp, seed, out in runs:
        scene = mi.load_file(scene_xml, spp=spp, width=size, height=size)
        if variant.startswith("llvm"):
            np.array(mi.render(scene, spp=spp, seed=99))  # compiles
        start = time.perf_counter()
        image = np.array(mi.render(scene, spp=spp, seed=seed))
        results.append(size * size * spp / (time.perf_counter() - start))
        if out:
            np.save(out, image)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"rates": results, "load": load, "peak": peak}))


def heddle(*words):
    out = subprocess.run([HEDDLE, *map(str, words), "--json"], check=True,
                         capture_output=True).stdout
    return json.loads(out)


def write_toml(folder, vdb):
    """Writes scene.toml beside scene.xml, with its camera and lights."""
    xml = ElementTree.parse(f"{folder}/scene.xml").getroot()
    look = xml.find("sensor/transform/lookat").attrib
    angle = xml.find("sensor/float[@name='fov']").attrib["value"]
    sky, sun = xml.findall("emitter")
    path = f"{folder}/scene.toml"
    with open(path, "w") as f:
        f.write(f"""[camera]
eye = [{look['origin']}]
target = [{look['target']}]
up = [{look['up']}]
view_angle = {angle}
[integrator]
max_depth = 64
roulette_depth = 5
level = 0
transport = "flakes"
[[light]]
kind = "constant"
color = [{sky.find("rgb").attrib['value']}]
[[light]]
kind = "directional"
direction = [{sun.find("vector").attrib['value']}]
color = [{sun.find("rgb").attrib['value']}]
[object.scarf]
volume = "{vdb}"
""")
    return path


def render_heddle(toml, size, spp, out, seed=0):
    result = heddle("render", toml, "-o", out, "--size", f"{size}x{size}", "--samples", spp,
                    "--seed", seed)
    return result["rate"], result["peak_memory_bytes"] / 1048576


def cost(pictures, seen, rate):
    """Relative variance of a pixel's luminance x seconds per path, from two pictures with different
    seeds: the cost of equal noise."""
    import numpy as np
    a, b = (p[seen] @ np.array([0.2126, 0.7152, 0.0722]) for p in pictures)
    return float(((a - b) ** 2).mean() / 2 / ((a + b).mean() / 2) ** 2 / rate)


def read_exr(path):
    import numpy as np
    import OpenEXR
    channels = OpenEXR.File(path).channels()
    for name in ("RGB", "RGBA"):
        if name in channels:
            return np.asarray(channels[name].pixels, np.float32)[..., :3]
    return np.stack([np.asarray(channels[c].pixels, np.float32) for c in "RGB"], -1)


def flip(a, b):
    import flip_evaluator
    import numpy as np
    srgb = lambda x: np.clip(
        np.where(x < .0031308, 12.92 * x, 1.055 * np.clip(x, 0, 1)**(1 / 2.4) - .055), 0, 1)
    tone = lambda x: np.ascontiguousarray(srgb(np.clip(x, 0, None)), np.float32)
    return float(flip_evaluator.evaluate(tone(a), tone(b), "LDR")[1])


def compare(name, folder, vdb, pad, o):
    import numpy as np
    box = heddle("export", vdb, "-o", folder, "--pad", pad)["resolution"]
    toml = write_toml(folder, vdb)
    runs = [(o.size, o.spp, 1, "")
            ] + [(o.picture, o.picture_spp, seed, f"{folder}/mitsuba{seed}.npy")
                 for seed in (1, 2) if o.picture_spp]
    out = subprocess.run([
        sys.executable, __file__, "--mitsuba", f"{folder}/scene.xml", "--variant", o.variant,
        "--runs",
        json.dumps(runs)
    ],
                         check=True,
                         capture_output=True,
                         text=True).stdout
    theirs = json.loads(out.splitlines()[-1])
    ours, peak = render_heddle(toml, o.size, 4 * o.spp, f"{folder}/speed.exr")
    quality = "- | - | - | -"
    if o.picture_spp:
        pictures = []
        for seed in (0, 1):
            path = f"{folder}/heddle{seed}.exr"
            rate, _ = render_heddle(toml, o.picture, o.picture_spp, path, seed)
            pictures.append(read_exr(path))
        references = [np.load(f"{folder}/mitsuba{seed}.npy") for seed in (1, 2)]
        reference = references[0]
        seen = np.ptp(reference.reshape(-1, 3) / reference[0, 0], -1).reshape(
            reference.shape[:2]) > 1e-3  # not pure sky
        ratio = pictures[0][seen].mean() / reference[seen].mean()
        quality = f"{flip(reference, pictures[0]):.4f} | {flip(pictures[1], pictures[0]):.4f} | {ratio:.4f} | {cost(references, seen, theirs['rates'][1]) / cost(pictures, seen, rate):.1f}"
    print(
        f"| {name}, {' x '.join(map(str, box))} | {theirs['rates'][0]:.0f} | {ours:.0f} | {ours / theirs['rates'][0]:.1f} | "
        f"{theirs['peak']:.0f} | {peak:.0f} | {theirs['peak'] / peak:.1f} | {quality} |",
        flush=True)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--size", type=int, default=256)
    arguments.add_argument("--spp",
                           type=int,
                           default=4,
                           help="samples for timing Mitsuba; Heddle takes four times as many")
    arguments.add_argument("--picture", type=int, default=64)
    arguments.add_argument("--picture-spp", type=int, default=256)
    arguments.add_argument("--variant", default="scalar_rgb")
    arguments.add_argument("--only", choices=["dense", "doubled"])
    arguments.add_argument("--keep", help="folder for the files; none: a temporary one")
    arguments.add_argument("--mitsuba", help=argparse.SUPPRESS)
    arguments.add_argument("--runs", help=argparse.SUPPRESS)
    o = arguments.parse_args()
    if o.mitsuba:
        return render_mitsuba(o.mitsuba, o.variant, json.loads(o.runs))
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as temporary:
        folder = os.path.abspath(o.keep or temporary)
        os.makedirs(folder, exist_ok=True)
        subprocess.run(["tar", "xf", f"{DATA}/volume/scarf-part.tar.xz", "-C", folder], check=True)
        dictionary = f"{folder}/scarfpart/data/volume_description.vol"
        vdb = f"{folder}/scarf.vdb"
        heddle("voxelize", dictionary, "-o", vdb, "--levels", 0, "--albedo", ".8,.8,.9")
        print(
            "| box | Mitsuba paths/s | Heddle paths/s | ratio | Mitsuba peak MiB | Heddle peak MiB | ratio | FLIP | FLIP of noise | "
            "mean ratio | variance x time |")
        print("|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
        for name, pad in (("dense", 1), ("doubled", 2)):
            if o.only in (None, name):
                compare(name, f"{folder}/{name}", vdb, pad, o)


if __name__ == "__main__":
    main()
