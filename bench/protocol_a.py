#!/usr/bin/env python3
"""The protocol of the paper: with a fixed camera, each level against the finest at full resolution,
by method.   [Fabre26, table 2, fig. 7]

usage: bench/protocol_a.py [-o FOLDER] [--scene helmet lamp scarf] [--method naive single moments]
                           [--samples 64] [--lamp-voxels 2048]
Volumes are kept in FOLDER (default build/protocol_a; the lamp takes 8 GB there); pictures are
always rendered again. Prints a table like table 2 with the paper's figures beside ours;
FOLDER/result.md, sheet.png, gains.png and errors.csv have more. The row `floor` is the finest level
with another seed: the error of noise. Lights: sky, sun and three panels. Needs the packages of
tools/compare; HEDDLE and HEDDLE_TEST_DATA as in the other scripts.
"""
import argparse
import os
import sys
import tarfile

import protocol
from protocol import DATA, basis, dot, heddle, made, middle, plus, unit

# FLIP of table 2 by scene and coarseness: naive, SGGX (ours: single), SGGX-H (ours: moments). For
# the brushed metal table of the paper we use the lamp.
PAPER = {"lamp": ((0.095, 0.094, 0.085), (0.105, 0.103, 0.094), (0.111, 0.118, 0.101)),
         "helmet": ((0.100, 0.103, 0.098), (0.163, 0.154, 0.151), (0.201, 0.181, 0.179)),
         "scarf": ((0.0642, 0.091, 0.0641), (0.103, 0.133, 0.101), (0.281, 0.284, 0.202))}
LEVELS = {"lamp": (3, 4, 5), "helmet": (3, 4, 5), "scarf": (1, 2, 3)}
# The scarf's 73 blocks of 63 samples of 0.02 begin at block (8, 0, 3) of a lattice with the origin
# (-14.0744, -0.1166, -9.8952); they span 5 x 4 x 5 blocks
SCARF_BOUNDS = ([-3.9944, -0.1166, -6.1152], [2.3056, 4.9234, 0.1848])
VIEWS = {
    "lamp": ((0.6, 0.35, 1.0), (0, 1, 0)), "helmet": ((0.35, 0.2, 1.0), (0, 1, 0)),
    "scarf": ((0.3, 1.0, 0.5), (0, 0, -1))
}


def source(folder, scene):
    """The input, its bounds and its options of voxelize."""
    if scene == "scarf":
        where = os.path.join(folder, "scarfpart")
        if not os.path.isdir(where):
            with tarfile.open(os.path.join(DATA, "volume/scarf-part.tar.xz")) as archive:
                archive.extractall(folder, filter="data")
        return os.path.join(where, "data/volume_description.vol"), SCARF_BOUNDS, []
    path = os.path.join(
        DATA, "mesh/DamagedHelmet.glb"
        if scene == "helmet" else "mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf")
    return path, heddle("info", path)["bounds"], ["--keep-masks"]


def area_text(corner, edge_u, edge_v, color):
    return f"[[light]]\nkind = \"area\"\nposition = {corner}\nedge_u = {edge_u}\nedge_v = {edge_v}\ncolor = {color}\n"


def scene_text(volume, bounds, back, up):
    """A scene framed with a margin of 5 %, with the sky and sun of `heddle render X.vdb`, the sun
    at the camera's upper left, and three panels out of view that metal can mirror."""
    right, top, back = basis(back, up)
    c = middle(bounds)
    inside = [plus((1, p), (-1, c)) for p in protocol.corners(bounds)]
    tall = 0.26795 / 1.05  # tan 15 deg
    away = max(dot(p, back) + max(abs(dot(p, right)), abs(dot(p, top))) / tall for p in inside)
    r = max(dot(p, p) for p in inside) ** 0.5
    panel = 4 * r
    text = protocol.camera_text(plus((1, c), (away, back)), c, up, 30.0)
    text += "[[light]]\nkind = \"constant\"\ncolor = [0.35, 0.4, 0.5]\n"
    text += protocol.sun_text(unit(plus((0.6, right), (-0.8, top), (-0.9, back))), [4.0, 3.8, 3.4])
    above = plus((1, c), (3 * r, top), (-2 * r, right), (-1.5 * r, back))
    text += area_text(above, plus((panel, right)), plus((panel, back)), 3.0)
    text += area_text(plus((1, c), (3 * r, right), (-2 * r, top)), plus((panel, back)),
                      plus((panel, top)), 2.0)
    text += area_text(plus((1, c), (-3 * r, right), (-2 * r, top)), plus((panel, top)),
                      plus((panel, back)), 1.0)
    return text + f"[object.it]\nvolume = \"{os.path.abspath(volume)}\"\n"


def render(folder, name, volume, bounds, view, level, samples, seed=0):
    scene = os.path.join(folder, f"{name}.toml")
    with open(scene, "w") as file:
        file.write(scene_text(volume, bounds, *view))
    out = os.path.join(folder, f"{name}.exr")
    print(f"  render {name}", file=sys.stderr, flush=True)
    heddle("render", scene, "-o", out, "--size", "256x256", "--level", level, "--samples", samples,
           "--seed", seed)
    return out


def run_scene(folder, scene, a):
    """The jobs to compare."""
    from heddle_compare.jobs import Job
    path, bounds, masks = source(folder, scene)
    voxels = [] if scene == "scarf" else ["--voxels", a.lamp_voxels if scene == "lamp" else 512]
    base = os.path.join(folder,
                        f"{scene}_{a.lamp_voxels}.vdb" if scene == "lamp" else f"{scene}.vdb")
    made(base, "voxelize", path, *voxels, "--levels", 5, *masks)
    volumes = {m: base if m == "moments" else f"{base[:-4]}_{m}.vdb" for m in a.method}
    for method, volume in volumes.items():
        if volume != base:
            made(volume, "lod", base, "--lod", method, "--levels", 5)
    reference = render(folder, f"{scene}_0", base, bounds, VIEWS[scene], 0, a.samples)
    floor = render(folder, f"{scene}_0_floor", base, bounds, VIEWS[scene], 0, a.samples, 1)
    jobs = [Job(reference, floor, scene, "0", "floor")]
    for level in LEVELS[scene]:
        for method, volume in volumes.items():
            test = render(folder, f"{scene}_{level}_{method}", volume, bounds, VIEWS[scene], level,
                          a.samples)
            jobs.append(Job(reference, test, scene, str(level), method))
    return jobs


def table_2(rows, key="flip"):
    """FLIP by method, the gain over naive, and the figures of the paper."""
    from heddle_compare.table import gain, groups, markdown
    body = []
    for (scene, _, level), by in groups(rows):
        if "naive" not in by:
            continue
        paper = PAPER[scene][LEVELS[scene].index(int(level))]
        words = [scene, level]
        for method in by:
            words.append(f"{by[method][key]:.4f}")
        ours = gain(by["naive"][key], by["moments"][key]) if "moments" in by else float("nan")
        theirs = gain(paper[0], paper[2])
        words += [
            f"{ours:.1%}", *(f"{x:.4g}" for x in paper), f"{theirs:.1%}", f"{ours / theirs:.1f}"
        ]
        body.append(words)
    methods = [m for m in dict.fromkeys(row["method"] for row in rows) if m != "floor"]
    return markdown([
        "scene", "level", *methods, "gain", "paper naive", "SGGX", "SGGX-H", "its gain",
        "gain / its"
    ], body)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o",
                           "--output",
                           default=os.path.join(protocol.ROOT, "build/protocol_a"))
    arguments.add_argument("--scene", nargs="+", choices=list(LEVELS), default=list(LEVELS))
    arguments.add_argument("--method", nargs="+", default=["naive", "single", "moments"])
    arguments.add_argument("--samples", type=int, default=64)
    arguments.add_argument("--lamp-voxels", type=int, default=2048)
    a = arguments.parse_args()
    protocol.need_packages()
    from heddle_compare import run, table
    os.makedirs(a.output, exist_ok=True)
    jobs = [job for scene in a.scene for job in run_scene(a.output, scene, a)]
    entries = run.compare(jobs)
    run.write_all(a.output, entries)
    rows = [entry[0] for entry in entries]
    text = protocol.head("Protocol A: fixed camera, a level against the finest")
    text += f"256 x 256, {a.samples} samples, mean over touched pixels; `floor`: the finest level with another seed. Goal: gain / its >= 2.\n\n"
    text += "FLIP\n\n" + table_2(rows) + "\nL1 (the paper's figures are FLIP)\n\n" + table_2(
        rows, "l1")
    text += "\nAll errors\n\n" + table.error_table(rows)
    with open(os.path.join(a.output, "result.md"), "w") as file:
        file.write(text)
    print(text, end="")


if __name__ == "__main__":
    main()
