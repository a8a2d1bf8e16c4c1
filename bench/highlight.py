#!/usr/bin/env python3
"""Position and width of highlights by level, beside traced geometry, as a markdown table.

usage: bench/highlight.py [-o FOLDER] [--voxels 256] [--level 0 1 2 3 4 5] [--samples 256]
A brushed plate and a sheet of straight dark hair lie in the xy plane, brushed and combed along y.
Camera and light are at 45 degrees on opposite sides, so that the middle mirrors the light. Measures
profiles of luminance through the middle third, across and along: centre and full width at half
maximum, in degrees from the camera. Volumes are kept in FOLDER (default build/highlight), which
also gets the pictures (.png too). Needs the packages of tools/compare.
"""
import argparse
import math
import os
import random
import struct

import protocol
from protocol import heddle, made

SIZE, ANGLE = 128, 60.0
HAIR = "[material.hair]\nmodel = \"hair\"\nmelanin = [4.0, 0.0]\nwidth_m = 0.15\nwidth_n = 0.3\ntilt = 0\n"


def write_hair(path):
    """Three layers of straight strands along y, 4 x 4 scene units."""
    draw = random.Random(1)
    strands = [(4 * (i + draw.random()) / 1200 - 2, 0.02 * draw.random()) for i in range(1200)]
    with open(path, "wb") as file:
        file.write(
            struct.pack("<4sIIIIfffff88s", b"HAIR", len(strands), 9 * len(strands), 2, 8, 0.008,
                        0.0, 0.5, 0.4, 0.3, b""))
        for x, z in strands:
            for k in range(9):
                file.write(struct.pack("<fff", x, k / 2 - 2, z))


def scene_text(path, volume, middle, distance, material):
    lean = math.sqrt(0.5)
    eye = [middle[0], middle[1] - lean * distance, middle[2] + lean * distance]
    text = protocol.camera_text(eye, middle,
                                (0, 0, 1), ANGLE) + protocol.sun_text([0.0, -lean, -lean], 3.0)
    return text + material + f"[object.it]\nvolume = \"{volume}\"\ngeometry = \"{path}\"\n" + (
        "materials = { \"*\" = \"hair\" }\n" if material else "")


def half_width(profile):
    """Centre and full width at half maximum, in samples; smoothed by a pixel or two."""
    import numpy as np
    p = np.convolve(np.pad(profile, 2, "edge"), [0.1, 0.2, 0.4, 0.2, 0.1], "valid")
    top = int(p.argmax())
    half = 0.5 * float(p[top])
    ends = []
    for step in (-1, 1):
        i = top
        while 0 <= i + step < len(p) and p[i + step] > half:
            i += step
        j = min(max(i + step, 0), len(p) - 1)
        ends.append(i + step *
                    (float(p[i]) - half) / max(float(p[i] - p[j]), 1e-9) if j != i else i)
    return 0.5 * (ends[0] + ends[1]), ends[1] - ends[0]


def shape(picture):
    """(centre, width) across and along, degrees from the picture's middle."""
    import numpy as np
    from heddle_compare.picture import read_picture
    p = read_picture(picture)
    luminance = p.rgb @ np.array([0.2126, 0.7152, 0.0722])
    third = slice(SIZE // 3, 2 * SIZE // 3)
    degree = ANGLE / SIZE
    out = []
    for profile in (luminance[third].mean(axis=0), luminance[:, third].mean(axis=1)):
        centre, width = half_width(profile)
        out += [(centre + 0.5 - SIZE / 2) * degree, width * degree]
    return out, float(luminance.mean())


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", default=os.path.join(protocol.ROOT, "build/highlight"))
    arguments.add_argument("--voxels", type=int, default=256)
    arguments.add_argument("--level", nargs="+", type=int, default=[0, 1, 2, 3, 4, 5])
    arguments.add_argument("--samples", type=int, default=256)
    a = arguments.parse_args()
    protocol.need_packages()
    folder = os.path.abspath(a.output)
    os.makedirs(folder, exist_ok=True)
    plate, hair = os.path.join(folder, "plate.glb"), os.path.join(folder, "sheet.hair")
    made(plate, "generate", "brushed", "--counts", "256,256")
    write_hair(hair)
    print(
        protocol.head("Highlights by level") +
        "| scene | level | across: centre | width | along: centre | width | mean / traced |\n" +
        "|---" * 7 + "|")
    for name, path, centre, distance, material in (("plate", plate, [1.28, 1.28, 0.0], 2.2, ""),
                                                   ("hair", hair, [0.0, 0.0, 0.01], 3.0, HAIR)):
        volume = os.path.join(folder, f"{name}.vdb")
        made(volume, "voxelize", path, "--voxels", a.voxels)
        scene = os.path.join(folder, f"{name}.toml")
        with open(scene, "w") as file:
            file.write(scene_text(path, volume, centre, distance, material))
        traced = None
        for level in ["traced", *a.level]:
            out = os.path.join(folder, f"{name}_{level}.exr")
            how = ["--geometry"] if level == "traced" else ["--level", level]
            heddle("render", scene, "-o", out, "--size", f"{SIZE}x{SIZE}", "--samples", a.samples,
                   *how)
            (ac, aw, lc, lw), mean = shape(out)
            traced = traced or mean
            print(
                f"| {name} | {level} | {ac:+.1f} | {aw:.1f} | {lc:+.1f} | {lw:.1f} | {mean / traced:.2f} |",
                flush=True)


if __name__ == "__main__":
    main()
