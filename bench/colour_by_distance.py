#!/usr/bin/env python3
"""Colour and covered area of a cable knit at 1, 3, 10 and 30 times the distance, relative to the
same knit traced.

usage: bench/colour_by_distance.py [-o FOLDER] [--heddle PROGRAM] [--quick] [--transport auto]
                                   [--distance 1 3 10 30] [--paths 250000] [--result FILE]
A quarter of the cable work pattern with yarn `cotton`, of fibers that transmit most of the light
(R + TT is 1 at most), under sky and sun. At distance 1 a pixel is 1.25 voxels wide; further away it
keeps its angle, so the picture has fewer pixels and each more samples. Colours are means by covered
area; the sky that is seen through the knit is taken off. Goal: each channel within 5 % at every
distance. The volume and what is traced are kept in FOLDER (default build/colour_by_distance). Needs
the packages of tools/compare.
"""
import argparse
import math
import os
import struct
import sys

import protocol
from protocol import DATA, dot, heddle, made, middle, plus, unit

PIXEL = math.radians(30.0) / 512  # angle of a pixel
NEAR, VOXEL = 100.0, 0.082  # scene units
GOAL = 0.05
TRACED_PATHS = 250000
FILE = "yarn/bcc/cable_work_pattern.bcc"
YARN = ("cotton", 0.0915)
MATERIAL = "[material.it]\nmodel = \"lobe_fiber\"\ncolor_r = 0.05\ncolor_tt = [0.95, 0.83, 0.62]\nwidth_r = 8\nwidth_tt = 27\nazimuth_tt = 38\n"
LIGHTS = protocol.SKY_TEXT + protocol.sun_text([-0.7, -1.0, -0.5], protocol.SUN)


def write_piece(source, path, low, high):
    """The parts of the curves of a .bcc file between two corners."""
    with open(source, "rb") as file:
        data = file.read()
    curves, = struct.unpack("<Q", data[8:16])
    pieces, at = [], 64
    for _ in range(curves):
        count = abs(struct.unpack("<i", data[at:at + 4])[0])
        xyz = struct.unpack(f"<{3 * count}f", data[at + 4:at + 4 + 12 * count])
        at += 4 + 12 * count
        points = [xyz[3 * i:3 * i + 3] for i in range(count)]
        # a spline needs four points
        pieces += [run for run in protocol.runs_inside(points, low, high) if len(run) >= 4]
    with open(path, "wb") as file:
        file.write(data[:8] + struct.pack("<QQ", len(pieces), sum(map(len, pieces))) + data[24:64])
        for piece in pieces:
            file.write(struct.pack("<i", len(piece)))
            file.write(b"".join(struct.pack("<3f", *p) for p in piece))


def view(bounds, distance):
    """The camera's text and the picture's width and height."""
    right, top, back = protocol.basis(unit((0.3, 0.2, 1.0)), (0, 1, 0))
    c, far = middle(bounds), NEAR * distance
    size = []
    for axis in (right, top):
        reach = max(
            abs(dot(plus((1, p), (-1, c)), axis)) / (far - dot(plus((1, p), (-1, c)), back))
            for p in protocol.corners(bounds))
        size.append(2 * math.ceil(reach / PIXEL) + 4)
    angle = math.degrees(2 * math.atan(0.5 * size[1] * PIXEL))
    return protocol.camera_text(plus((1, c), (far, back)), c, top, angle), size


def mean_of(picture):
    """Colour by covered area without the sky, the largest relative standard error of a channel
    (that of luminance stands for it), and the covered area in pixels."""
    import numpy as np
    from heddle_compare.errors import LUMINANCE
    from heddle_compare.picture import read_picture
    p = read_picture(picture)
    area = float((1.0 - p.transmittance).sum(dtype=float))
    light = p.rgb - p.transmittance[..., None] * np.array(protocol.SKY)
    color = light.sum(axis=(0, 1), dtype=float) / area
    error = math.sqrt(float(p.variance.sum(dtype=float))) / area / float(np.dot(color, LUMINANCE))
    return {"color": [float(x) for x in color], "error": error, "area": area}


def means(a, geometry, volume, bounds, distance):
    """The means of the traced picture and of the volume's."""
    camera, size = view(bounds, distance)
    text = MATERIAL + LIGHTS + camera
    pixels = size[0] * size[1]
    words = ["--size", f"{size[0]}x{size[1]}", "--samples"]
    samples = max(1, round(TRACED_PATHS / pixels))
    label = os.path.join(a.output, f"distance_{distance}")
    scene = protocol.write_text(f"{label}.toml",
                                text + protocol.object_text(volume, geometry, YARN, "it"))

    def trace():
        heddle("render", scene, "-o", f"{label}_traced.exr", *words, samples, "--geometry",
               "--seed", 1)
        return mean_of(f"{label}_traced.exr")

    key = protocol.digest(text, samples)
    traced = protocol.kept(os.path.join(a.output, "traced", f"{distance}_{key}.json"), trace)
    heddle("render", scene, "-o", f"{label}.exr", *words, max(1, round(a.paths / pixels)),
           "--transport", a.transport)
    return traced, mean_of(f"{label}.exr")


def result_text(a, results):
    from heddle_compare.table import markdown
    colors, areas, ratios = [], [], {}
    for distance, (traced, volume) in zip(a.distance, results):
        for channel, t, v in zip("RGB", traced["color"], volume["color"]):
            ratios[distance, channel] = v / t
        colors.append([distance, *(f"{ratios[distance, c]:.3f}" for c in "RGB")])
        areas.append([
            distance, f"{volume['area'] / traced['area']:.3f}", f"{traced['area']:.0f}",
            " ".join(f"{x:.3f}" for x in traced["color"]),
            f"{math.hypot(traced['error'], volume['error']):.3f}"
        ])
    text = markdown(["distance", "R", "G", "B"], colors)
    text += "\nCovered area relative to traced; of what is traced the area in pixels and the colour; standard error of the ratios.\n\n"
    text += markdown(["distance", "area", "pixels traced", "R G B traced", "error"], areas) + "\n"
    worst = max(ratios, key=lambda k: abs(ratios[k] - 1))
    if abs(ratios[worst] - 1) <= GOAL:
        return text + "goal met\n"
    return text + f"goal not met: {worst[0]} {worst[1]} {ratios[worst]:.3f}\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    protocol.add_options(arguments, "colour_by_distance")
    arguments.add_argument("--distance", nargs="+", type=int, default=[1, 3, 10, 30])
    arguments.add_argument("--paths", type=int, help="default: 250000, with --quick 100000")
    a = arguments.parse_args()
    protocol.use_options(a, "colour_by_distance")
    a.paths = a.paths or (100000 if a.quick else 250000)
    if not protocol.existing(["cable"], {"cable": os.path.join(DATA, FILE)}):
        sys.exit(0)
    geometry, volume = (os.path.join(a.output, f"cable.{kind}") for kind in ("bcc", "vdb"))
    write_piece(os.path.join(DATA, FILE), geometry, (-10, -10, -9), (10, 10, 9))
    made(volume, "voxelize", geometry, "--voxel-size", VOXEL, "--yarn", YARN[0], "--yarn-radius",
         YARN[1], by=a.made_by)
    lo, hi = heddle("info", geometry)["bounds"]
    bounds = [x - YARN[1] for x in lo], [x + YARN[1] for x in hi]
    results = protocol.in_parallel(lambda d: means(a, geometry, volume, bounds, d), a.distance,
                                   a.threads)
    text = protocol.head("Colour by distance, volume relative to traced geometry")
    text += "Rows: times the distance. Colours by covered area, relative to traced.\n\n"
    text += result_text(a, results)
    protocol.write_text(a.result, text)
    print(text, end="")


if __name__ == "__main__":
    main()
