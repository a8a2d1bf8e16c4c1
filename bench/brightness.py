#!/usr/bin/env python3
"""Brightness of voxels against the same geometry traced, by level, order of scattering and angle
between light and camera.

usage: bench/brightness.py [-o FOLDER] [--scene knit lobes strands spot] [--level 0 2 4]
                           [--angle 0 35 80 130] [--depth 1 64] [--samples 32]
                           [--transport product...]
knit: 4 x 5 stockinette loops of yarn `cotton` at 1024 voxels; strands: 40 hairs far apart; spot: a
cow with a Lambertian surface at 256 voxels. A fixed camera, one directional light, albedo
0.9 0.5 0.2 (lobes: the knit with R and TT lobes), 64 x 64 pixels. Depth 1 is single scattering: it
shows the error of the phase function and of the correlation of view and light alone. At angle 0 a
medium of independent points returns half of the light of opaque objects, which are lit wherever
they are visible. Needs the packages of tools/compare.
"""
import argparse
import math
import os

import protocol
from protocol import DATA, basis, corners, dot, heddle, made, middle, plus, unit

FIBER = "model = \"fiber\"\nalbedo = [0.9, 0.5, 0.2]\n"
LOBES = "model = \"lobe_fiber\"\ncolor_r = 0.04\ncolor_tt = [0.9, 0.6, 0.3]\nwidth_r = 8\nwidth_tt = 27\nazimuth_tt = 38\n"
SURFACE = "model = \"surface\"\nalbedo = [0.9, 0.5, 0.2]\nroughness = 1\nmetalness = 0\nspecular = 0\n"
# input that is generated or read, options of voxelize, yarn, material, side of the camera
SCENES = {
    "knit": (["knit", "--counts",
              "4,5"], ["--voxels", 1024, "--yarn", "cotton", "--yarn-radius",
                       0.1], "yarn = \"cotton\"\nyarn_radius = 0.1\n", FIBER, (0, 0, 1)),
    "lobes": (["knit", "--counts",
               "4,5"], ["--voxels", 1024, "--yarn", "cotton", "--yarn-radius",
                        0.1], "yarn = \"cotton\"\nyarn_radius = 0.1\n", LOBES, (0, 0, 1)),
    "strands": (["hair", "--counts", "40,4"], ["--voxels", 1024], "", FIBER, (0, 0, 1)),
    "spot": ("mesh/spot.obj", ["--voxels", 256], "", SURFACE, (0.3, 0.2, -1)),
}


def prepare(folder, name):
    """The paths of the geometry and of the volume."""
    origin, voxels, _, _, _ = SCENES[name]
    path = os.path.join(folder, "strands.hair" if name == "strands" else f"{name}.bcc")
    if isinstance(origin, str):
        path = os.path.join(DATA, origin)
    else:
        made(path, "generate", *origin)
    volume = os.path.join(folder, f"{name}.vdb")
    made(volume, "voxelize", path, *voxels)
    return path, volume


def scene_text(name, path, volume, angle, depth):
    """The camera faces the object; the light is `angle` degrees to its side."""
    _, _, yarn, material, front = SCENES[name]
    bounds = heddle("info", path)["bounds"]
    c = middle(bounds)
    right, top, back = basis(front, (0, 1, 0))
    reach = max(
        abs(dot(plus((1, p), (-1, c)), axis)) for p in corners(bounds) for axis in (right, top))
    text = protocol.camera_text(plus((1, c), (1.1 * reach / math.tan(math.radians(7.5)), back)), c,
                                top, 15.0)
    turn = math.radians(angle)
    text += protocol.sun_text(unit(plus((-math.cos(turn), back), (-math.sin(turn), right))), 3.0)
    text += f"[integrator]\nmax_depth = {depth}\n[material.matte]\n{material}"
    return text + (
        f"[object.it]\nvolume = \"{os.path.abspath(volume)}\"\ngeometry = \"{os.path.abspath(path)}\"\n{yarn}"
        "materials = { \"*\" = \"matte\" }\n")


def rows(name, a, run, jobs):
    """Prints the rows of a scene."""
    path, volume = prepare(a.output, name)
    common = ["--size", "64x64", "--samples", a.samples]
    scene, traced, test = (os.path.join(a.output, file)
                           for file in ("it.toml", "traced.exr", "test.exr"))
    for depth in a.depth:
        for angle in a.angle:
            with open(scene, "w") as file:
                file.write(scene_text(name, path, volume, angle, depth))
            heddle("render", scene, "-o", traced, *common, "--geometry", "--seed", 1)
            for level in a.level:
                for transport in a.transport:
                    heddle("render", scene, "-o", test, *common, "--level", level, "--transport",
                           transport)
                    r = run.compare([jobs.Job(traced, test, "", "", "")])[0][0]
                    print(
                        f"| {name} | {depth} | {angle:g} | {level} | {transport} | {r['ratio_r']:.3f} | {r['ratio_g']:.3f} | {r['ratio_b']:.3f} | "
                        f"{r['ratio_per_alpha']:.3f} | {r['transmittance_bias']:+.3f} |",
                        flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o",
                           "--output",
                           default=os.path.join(protocol.ROOT, "build/brightness"))
    arguments.add_argument("--scene", nargs="+", choices=list(SCENES), default=list(SCENES))
    arguments.add_argument("--level", nargs="+", type=int, default=[0, 2, 4])
    arguments.add_argument("--angle", nargs="+", type=float, default=[0, 35, 80, 130])
    arguments.add_argument("--depth", nargs="+", type=int, default=[1, 64])
    arguments.add_argument("--samples", type=int, default=32)
    arguments.add_argument("--transport", nargs="+", default=["product"])
    a = arguments.parse_args()
    protocol.need_packages()
    from heddle_compare import jobs, run
    os.makedirs(a.output, exist_ok=True)
    print(protocol.head("Brightness of voxels against traced geometry"))
    print("| scene | depth | angle | level | transport | R | G | B | per alpha | T bias |\n" +
          "|---|" + "---|" * 9)
    for name in a.scene:
        rows(name, a, run, jobs)


if __name__ == "__main__":
    main()
