#!/usr/bin/env python3
"""A sheet of ten objects, traced beside their volumes, near and 3, 10 and 30 times as far: would
one accept the swap?

usage: bench/distance_sheet.py [-o FOLDER] [--heddle PROGRAM] [--quick] [--object NAME...]
                               [--transport auto] [--samples 16] [--size 256] [--voxels 512]
The cable pattern, a knit and three weaves of fibers that transmit light, blond and dark hair lit
from behind, smallpine, the barn lamp, the helmet, under sky and sun. A pixel keeps its angle, so
far pictures have fewer pixels; these are shown enlarged, and have more samples. An object has one
exposure. Writes sheet.png and sheet_NAME.png to FOLDER (default build/distance_sheet), where
volumes and traced pictures are kept. Needs the packages of tools/compare.
"""
import argparse
import math
import os

import protocol
from protocol import DATA, dot, heddle, made, middle, plus, unit

DISTANCES = {1: 1, 3: 1, 10: 3, 30: 6}  # how much a picture is enlarged
VIEW_ANGLE = 30.0  # of the near picture
TT = "model = \"lobe_fiber\"\ncolor_r = 0.05\ncolor_tt = {}\nwidth_r = 8\nwidth_tt = 27\nazimuth_tt = 38\n"
HAIR = "model = \"hair\"\nmelanin = {}\nwidth_m = 0.3\nwidth_n = 0.3\ntilt = 2\n"
SIDE, BEHIND = [-0.7, -1.0, -0.5], [0.3, -0.7, 0.65]  # right, top, front
ACROSS = ((0, 0, 1), (0, 1, 0))
UPRIGHT = ((0, -1, 0), (0, 0, 1))
# input (a file, or words of generate), yarn, material, front and up, light
OBJECTS = {
    "cable": ("yarn/bcc/cable_work_pattern.bcc", ("cotton", 0.0915),
              TT.format("[0.95, 0.83, 0.62]"), ACROSS, SIDE),
    "knit": (["knit"], ("cotton", 0.1), TT.format("[0.95, 0.55, 0.45]"), ACROSS, SIDE),
    "plain": (["plain"], ("cotton", None), TT.format("[0.85, 0.85, 0.8]"), ACROSS, SIDE),
    "twill": (["twill"], ("wool", None), TT.format("[0.6, 0.8, 0.55]"), ACROSS, SIDE),
    "satin": (["satin"], ("silk", None), TT.format("[0.5, 0.6, 0.95]"), ACROSS, SIDE),
    "hair_blond": ("hair/straight.hair", None, HAIR.format("[0.3, 0.1]"), UPRIGHT, BEHIND),
    "hair_dark": ("hair/straight.hair", None, HAIR.format("[4.0, 0.0]"), UPRIGHT, BEHIND),
    "pine": ("mesh/smallpine/scene.gltf", None, None, ACROSS, SIDE),
    "lamp": ("mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf", None, None, ACROSS, SIDE),
    "helmet": ("mesh/DamagedHelmet.glb", None, None, ACROSS, SIDE),
}


def prepare(a, name):
    """The geometry's path, the volume's, and the yarn with its radius."""
    origin, yarn = OBJECTS[name][:2]
    path = os.path.join(DATA, origin) if isinstance(origin, str) else None
    kind = os.path.splitext(os.path.basename(path))[0] if path else name
    if path is None:
        path = os.path.join(a.output, f"{name}.bcc")
        note = made(path, "generate", *origin)
        yarn = (yarn[0], yarn[1] or note["radius"])
    volume = os.path.join(a.output, f"{kind}.vdb")
    words = ["--yarn", yarn[0], "--yarn-radius", yarn[1]] if yarn else []
    made(volume, "voxelize", path, "--voxels", a.voxels, *words, by=a.made_by)
    return path, volume, yarn


def scene_text(a, name, path, volume, yarn, distance):
    """The scene, and the width of the picture."""
    material, (front, up), light = OBJECTS[name][2:]
    side, top, front = protocol.basis(front, up)
    right, camera_up, back = protocol.basis(unit(plus((0.35, side), (0.2, top), (1, front))), up)
    bounds = heddle("info", path)["bounds"]
    c = middle(bounds)
    reach = max(
        abs(dot(plus((1, p), (-1, c)), axis)) for p in protocol.corners(bounds)
        for axis in (right, camera_up))
    pixel = 2 * math.tan(math.radians(0.5 * VIEW_ANGLE)) / a.size
    width = 2 * math.ceil(0.5 * a.size / distance) + (0 if distance == 1 else 4)
    far = 1.2 * reach / math.tan(math.radians(0.5 * VIEW_ANGLE)) * distance
    text = protocol.camera_text(plus((1, c), (far, back)), c, camera_up,
                                math.degrees(2 * math.atan(0.5 * width * pixel)))
    text += protocol.SKY_TEXT + protocol.sun_text(
        plus((light[0], side), (light[1], top), (light[2], front)), protocol.SUN)
    text += f"[material.it]\n{material}" if material else ""
    return text + protocol.object_text(volume, path, yarn, "it" if material else None), width


def pictures(a, name):
    """(traced, volume) by distance."""
    path, volume, yarn = prepare(a, name)
    out = []
    for distance in DISTANCES:
        text, width = scene_text(a, name, path, volume, yarn, distance)
        label = os.path.join(a.output, f"{name}_{distance}")
        scene = protocol.write_text(f"{label}.toml", text)
        samples = min(1024, a.samples * distance**2)
        common = ["--size", f"{width}x{width}", "--samples", samples]
        traced = os.path.join(a.output, "traced",
                              f"{name}_{distance}_{protocol.digest(text, samples)}.exr")
        if not os.path.exists(traced):
            part = traced.replace(".exr", ".part.exr")
            heddle("render", scene, "-o", part, *common, "--geometry", "--seed", 1)
            os.replace(part, traced)
        heddle("render", scene, "-o", f"{label}.exr", *common, "--transport", a.transport)
        out.append((traced, f"{label}.exr"))
    return out


def sheet_of(a, name, pairs):
    """The pictures of an object: traced on the left, near above."""
    import numpy as np
    from PIL import Image, ImageDraw
    from heddle_compare.errors import auto_exposure, srgb_from_linear
    from heddle_compare.picture import read_picture
    scale = 2.0**auto_exposure(read_picture(pairs[0][0]))
    half = max(a.size, sum((round(a.size / d) + 6) * k for d, k in list(DISTANCES.items())[1:])) + 4
    below = max((round(a.size / d) + 6) * k for d, k in list(DISTANCES.items())[1:])
    sheet = Image.new("RGB", (2 * half, a.size + below + 8), (40, 40, 40))
    for j in (0, 1):
        x = j * half
        for pair, enlarged in zip(pairs, DISTANCES.values()):
            rgb = srgb_from_linear(read_picture(pair[j]).rgb * scale)
            tile = Image.fromarray(np.uint8(np.round(255 * rgb)))
            tile = tile.resize((tile.width * enlarged, tile.height * enlarged), Image.NEAREST)
            near = pair is pairs[0]
            sheet.paste(tile, (x, 0 if near else a.size + 4))
            x = x if near else x + tile.width + 4
    ImageDraw.Draw(sheet).text((3, 2), f"{name}: traced, volume", fill=(255, 255, 0))
    sheet.save(os.path.join(a.output, f"sheet_{name}.png"))
    return sheet


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    protocol.add_options(arguments, "distance_sheet")
    arguments.add_argument("--object", nargs="+", choices=list(OBJECTS), default=list(OBJECTS))
    arguments.add_argument("--samples", type=int, help="near; default: 16, with --quick 4")
    arguments.add_argument("--size", type=int, default=256)
    arguments.add_argument("--voxels", type=int, default=512)
    a = arguments.parse_args()
    protocol.use_options(a, "distance_sheet")
    from PIL import Image
    a.samples = a.samples or (4 if a.quick else 16)
    a.object = protocol.existing(a.object, {
        n: os.path.join(DATA, o[0]) if isinstance(o[0], str) else None
        for n, o in OBJECTS.items()
    })
    if not a.object:
        return
    for name in a.object:  # volumes first: two objects share one
        prepare(a, name)
    all_pairs = protocol.in_parallel(lambda name: pictures(a, name), a.object, a.threads)
    sheets = [sheet_of(a, name, pairs) for name, pairs in zip(a.object, all_pairs)]
    width, height = sheets[0].size
    sheet = Image.new("RGB", (2 * width + 8, ((len(sheets) + 1) // 2) * (height + 8)), (20, 20, 20))
    for i, one in enumerate(sheets):
        sheet.paste(one, (i % 2 * (width + 8), i // 2 * (height + 8)))
    sheet.save(os.path.join(a.output, "sheet.png"))
    print(os.path.join(a.output, "sheet.png"))


if __name__ == "__main__":
    main()
