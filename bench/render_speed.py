#!/usr/bin/env python3
"""Speed of `heddle render`: by level, against traced geometry, by threads, and the time to the
first picture; as markdown tables.

usage: bench/render_speed.py [-o FOLDER] [--part levels traced threads first] [--paths 1000000]
levels: a generated knit from the front that fills the picture, one voxel of the level per pixel:
time of all threads per path that hits it. traced: the pattern of the flame ribbing with 150 fibers
per yarn at levels 3 and 4, one voxel per pixel, beside its geometry through Embree: variance x
time, memory, and seconds until --noise percent. threads: the same with 1 and 2. first: wall time
until the first picture of a file of 50 M voxels exists. Volumes are kept in FOLDER (default
build/render_speed). HEDDLE and HEDDLE_TEST_DATA as in the other scripts. Nothing else should run.
"""
import argparse
import math
import os
import subprocess
import time

import protocol
from protocol import DATA, HEDDLE, heddle, made, middle, plus

SUN = protocol.sun_text([0.4, -0.6, -0.7], 3.0)
SKY = "[[light]]\nkind = \"constant\"\ncolor = [0.35, 0.4, 0.5]\n"
FIBER = "[material.matte]\nmodel = \"fiber\"\nalbedo = [0.9, 0.5, 0.2]\n"


def facing(bounds, height):
    """An orthographic camera in front of the cloth, which lies in the xy plane."""
    c = middle(bounds)
    eye = plus((1, c), (2 * (bounds[1][0] - bounds[0][0]), (0, 0, 1)))
    return (
        f"[camera]\nkind = \"orthographic\"\neye = {eye}\ntarget = {c}\nup = [0.0, 1.0, 0.0]\nview_height = {height!r}\n"
    )


def write_scene(folder, name, text):
    path = os.path.join(folder, f"{name}.toml")
    with open(path, "w") as file:
        file.write(text)
    return path


def met(picture):
    """The fraction of the camera's paths that hit the object."""
    from heddle_compare.picture import read_picture
    return float((1.0 - read_picture(picture).transmittance).mean(dtype=float))


def levels_part(folder, a):
    cloth, volume = os.path.join(folder, "knit.bcc"), os.path.join(folder, "knit.vdb")
    made(cloth, "generate", "knit", "--counts", "40,50")
    info = made(volume, "voxelize", cloth, "--voxels", 1536, "--yarn", "cotton", "--yarn-radius",
                0.1, "--levels", 7)
    bounds, voxel = heddle("info", cloth)["bounds"], info["voxel_size"][0]
    wide = 1024 * voxel
    print(
        f"Knit, {info['voxels'] / 1e6:.0f} M voxels of level 0; the view is {1024} of them wide and high.\n"
    )
    print("| level | pixels | paths | meet | us a path that meets | of level 0 |\n" + "|---" * 6 +
          "|")
    first = None
    for level in range(7):
        size = 1024 >> level
        samples = max(1, a.paths // size ** 2)
        scene = write_scene(
            folder, f"level_{level}", FIBER + SUN + SKY + facing(bounds, wide) +
            f"[object.it]\nvolume = \"{volume}\"\nmaterials = {{ \"*\" = \"matte\" }}\n")
        out = os.path.join(folder, "level.exr")
        r = heddle("render", scene, "-o", out, "--size", f"{size}x{size}", "--samples", samples)
        paths = size ** 2 * samples * met(out)
        each = r["render_seconds"] * os.cpu_count() / paths * 1e6
        first = first or each
        print(
            f"| {level} | {size} x {size} | {size ** 2 * samples} | {paths / size ** 2 / samples:.2f} | {each:.2f} | 1/{first / each:.2f} |",
            flush=True)


def traced_part(folder, a):
    path = os.path.join(DATA, "yarn/bcc/flame_ribbing_pattern.bcc")
    volume = os.path.join(folder, "flame.vdb")
    fit = os.path.join(DATA, "params/zhao2016/cotton1.txt")
    yarn = ["--yarn", fit, "--fibers", 150]
    info = made(volume, "voxelize", path, "--voxels", 512, *yarn)
    bounds = heddle("info", path)["bounds"]
    text = FIBER + SUN + SKY
    body = (
        f"[object.it]\nvolume = \"{volume}\"\ngeometry = \"{path}\"\nyarn = \"{fit}\"\nfibers = 150\nmaterials = {{ \"*\" = \"matte\" }}\n"
    )
    print(
        "\n| level | pixels | of | load s | us a path | noise % | variance x time | against traced | seconds to "
        f"{a.noise} % | against | scene MiB | against |\n" + "|---" * 12 + "|")
    for level in (3, 4):
        size = 2 * math.ceil(
            max(bounds[1][i] - bounds[0][i] for i in (0, 1)) / info["voxel_size"][0] / 2**level / 2)
        scene = write_scene(folder, f"traced_{level}",
                            text + facing(bounds, size * info["voxel_size"][0] * 2**level) + body)
        rows = {}
        for name, more in (("volume", []), ("traced", ["--geometry"])):
            out = os.path.join(folder, f"{name}_{level}.exr")
            began = time.perf_counter()
            r = heddle("render", scene, "-o", out, "--size", f"{size}x{size}", "--samples", 256,
                       *more)
            wall = time.perf_counter() - began
            cost = r["noise"] ** 2 * r["render_seconds"]
            load = wall - r["render_seconds"]
            rows[name] = (load, cost, load + cost / (0.01 * a.noise) ** 2, r["scene_memory_bytes"])
            each = r["render_seconds"] * os.cpu_count() / (size ** 2 * 256 * met(out)) * 1e6
            ratio = [rows["traced"][i] / rows["volume"][i]
                     for i in (1, 2, 3)] if name == "traced" else [1, 1, 1]
            print(
                f"| {level} | {size} x {size} | {name} | {load:.2f} | {each:.2f} | {100 * r['noise']:.2f} | {cost:.5f} | {ratio[0]:.1f} | "
                f"{rows[name][2]:.2f} | {ratio[1]:.1f} | {r['scene_memory_bytes'] / 2 ** 20:.0f} | {ratio[2]:.0f} |",
                flush=True)


def threads_part(folder, a):
    scene = os.path.join(folder, "traced_3.toml")
    times = {1: [], 2: []}
    for _ in range(3):
        for threads in times:
            r = heddle("render", scene, "-o", os.path.join(folder, "threads.exr"), "--size",
                       "128x128", "--samples", 64, "--threads", threads)
            times[threads].append(r["render_seconds"])
    one, two = (min(times[n]) for n in times)
    print(f"\n1 thread {one:.2f} s, 2 threads {two:.2f} s: {one / two:.2f} times (best of 3).")


def first_part(folder, a):
    cloth, volume = os.path.join(folder, "plain.bcc"), os.path.join(folder, "plain.vdb")
    made(cloth, "generate", "plain", "--counts", "620,620")
    info = made(volume, "voxelize", cloth, "--voxels", 2048 + 780)
    out = os.path.join(folder, "first.exr")
    if os.path.exists(out):
        os.remove(out)
    began = time.perf_counter()
    with subprocess.Popen([HEDDLE, "render", volume, "-o", out, "--samples", "4",
                           "--quiet"]) as process:
        while not os.path.exists(out) and process.poll() is None:
            time.sleep(0.01)
        first = time.perf_counter() - began
        process.wait()
    print(
        f"\nPlain weave, {info['voxels'] / 1e6:.1f} M voxels: first picture after {first:.2f} s, 4 samples of 512 x 512 after "
        f"{time.perf_counter() - began:.1f} s.")


def main():
    parts = {
        "levels": levels_part, "traced": traced_part, "threads": threads_part, "first": first_part
    }
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o",
                           "--output",
                           default=os.path.join(protocol.ROOT, "build/render_speed"))
    arguments.add_argument("--part", nargs="+", choices=list(parts), default=list(parts))
    arguments.add_argument("--paths", type=int, default=2 ** 20)
    arguments.add_argument("--noise", type=float, default=1.0)
    a = arguments.parse_args()
    protocol.need_packages()
    a.output = os.path.abspath(a.output)
    os.makedirs(a.output, exist_ok=True)
    print(protocol.head("Speed of rendering"))
    for part in a.part:
        parts[part](a.output, a)


if __name__ == "__main__":
    main()
