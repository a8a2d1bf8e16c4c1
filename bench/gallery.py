#!/usr/bin/env python3
"""Pictures of volumes beside the same geometry traced: gallery.png and one .png each.

usage: bench/gallery.py [-o FOLDER] [--scene NAME...] [--size 384] [--samples 64] [--no-traced]
Scenes without a camera are framed and lit by `heddle render`. sweater: `cotton1`, three instances
at distances 1, 4 and 16 (Embree: 280 s, 8.4 GiB); scarf has no geometry; weaves are lit at a
grazing angle. Volumes are kept in FOLDER (default build/gallery). Needs Pillow; HEDDLE and
HEDDLE_TEST_DATA as in the other scripts.
"""
import argparse
import os
import tarfile

import protocol
from protocol import DATA, heddle, made

HAIR = "[material.it]\nmodel = \"hair\"\nmelanin = [{}, 0.1]\nwidth_m = 0.2\nwidth_n = 0.3\n"
FIBER = "[material.it]\nmodel = \"lobe_fiber\"\ncolor_r = 0.04\ncolor_tt = {}\nwidth_r = 8\nwidth_tt = 27\nazimuth_tt = 38\n"
ALL = "materials = { \"*\" = \"it\" }\n"
COTTON1 = os.path.join(DATA, "params/zhao2016/cotton1.txt")
SKY = "[[light]]\nkind = \"constant\"\ncolor = [0.1, 0.12, 0.15]\n"
GRAZING = SKY + protocol.sun_text([1.0, 0.25, -0.2], [6.0, 5.6, 5.0])
# name: input (a file, or words of generate), options of voxelize, keys of the object, rest of it
SCENES = {
    "scarf": ("volume/scarf-part.tar.xz", ["--albedo", ".8,.55,.35"], "", ""),
    "straight": ("hair/straight.hair", ["--voxels", 768], ALL, HAIR.format(0.6)),
    "harolongo": ("hair/digital-salon/harolongo.data", ["--voxels", 768], ALL, HAIR.format(1.5)),
    "smallpine": ("mesh/smallpine/scene.gltf", ["--voxels", 512], "", ""),
    "helmet": ("mesh/DamagedHelmet.glb", ["--voxels", 512], "", ""),
    "lamp": ("mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf", ["--voxels", 768], "", ""),
    "plain": (["plain", "--counts", "24,24"], ["--voxels", 1024, "--yarn",
                                               "cotton"], "yarn = \"cotton\"\n" + ALL,
              FIBER.format("[0.9, 0.6, 0.3]") + GRAZING),
    "satin": (["satin", "--counts", "24,24"], ["--voxels", 1024, "--yarn",
                                               "silk"], "yarn = \"silk\"\n" + ALL,
              FIBER.format("[0.5, 0.6, 0.95]") + GRAZING),
    "sweater": ("yarn/bcc/sweater_flame_ribbing.bcc", ["--voxels", 1024, "--yarn",
                                                       COTTON1], f"yarn = \"{COTTON1}\"\n" + ALL +
                "".join(f"[[object.it.instance]]\ntranslate = {list(at)}\n"
                        for at in ((-30, 0, 0), (100, 10, -580), (240, 260, -2400))),
                FIBER.format("[0.95, 0.75, 0.5]") + protocol.camera_text([0, 10, 200], [0, 0, 0],
                                                                         (0, 1, 0), 30.0) +
                "[[light]]\nkind = \"constant\"\ncolor = [0.35, 0.4, 0.5]\n" +
                protocol.sun_text([0.5, -0.5, -0.7], 4.0)),
}


def source(folder, name):
    """The file to voxelize; the geometry is None if there is none to trace."""
    origin = SCENES[name][0]
    if isinstance(origin, list):
        path = os.path.join(folder, f"{name}.bcc")
        made(path, "generate", *origin)
        return path, path
    path = os.path.join(DATA, origin)
    if not path.endswith(".tar.xz"):
        return path, path
    where = os.path.join(folder, "scarfpart")
    if not os.path.isdir(where):
        with tarfile.open(path) as archive:
            archive.extractall(folder, filter="data")
    return os.path.join(where, "data/volume_description.vol"), None


def pictures(folder, name, a):
    """The picture of the volume, and that of the geometry, or None."""
    path, geometry = source(folder, name)
    _, options, keys, more = SCENES[name]
    volume = os.path.join(folder, f"{name}.vdb")
    made(volume, "voxelize", path, *options)
    scene = os.path.join(folder, f"{name}.toml")
    with open(scene, "w") as file:
        file.write(f"{more}[object.it]\nvolume = \"{volume}\"\n" +
                   (f"geometry = \"{geometry}\"\n" if geometry else "") + keys)
    out = []
    for kind in ("volume", "traced"):
        picture = os.path.join(folder, f"{name}_{kind}.png")
        if kind == "traced" and (a.no_traced or not geometry):
            out.append(None)
            continue
        r = heddle("render", scene, "-o", picture, "--size", f"{a.size}x{a.size}", "--samples",
                   a.samples, *(["--geometry"] if kind == "traced" else []))
        print(
            f"{name} {kind}: {r['render_seconds']:.0f} s, scene {r['scene_memory_bytes'] / 2**20:.0f} MiB",
            flush=True)
        out.append(picture)
    return out


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", default=os.path.join(protocol.ROOT, "build/gallery"))
    arguments.add_argument("--scene",
                           nargs="+",
                           choices=list(SCENES),
                           default=[s for s in SCENES if s != "sweater"])
    arguments.add_argument("--size", type=int, default=384)
    arguments.add_argument("--samples", type=int, default=64)
    arguments.add_argument("--no-traced", action="store_true")
    a = arguments.parse_args()
    from PIL import Image
    folder = os.path.abspath(a.output)
    os.makedirs(folder, exist_ok=True)
    rows = [pictures(folder, name, a) for name in a.scene]
    sheet = Image.new("RGB", (4 * a.size, a.size * ((len(rows) + 1) // 2)))
    for i, row in enumerate(rows):
        for j, picture in enumerate(row):
            if picture:
                sheet.paste(
                    Image.open(picture).convert("RGB"),
                    ((2 * (i % 2) + j) * a.size, i // 2 * a.size))
    sheet.save(os.path.join(folder, "gallery.png"))


if __name__ == "__main__":
    main()
