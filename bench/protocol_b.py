#!/usr/bin/env python3
"""The protocol of levels at a distance: the camera is so far away that a voxel of level L covers
one pixel; compared with traced geometry.

usage: bench/protocol_b.py [-o FOLDER] [--scene knit satin hair pine lamp]
                           [--view facing oblique along] [--level 1 2 3 4 5]
                           [--transport product...] [--samples 32] [--voxels 512] [--force-level]
                           [--footprints 4|8] [--correlation]
Scenes: generated stockinette and satin of yarn `cotton`, straight hair, smallpine, the barn lamp;
`helmet`, and `sweater` (280 s to build, 8 GiB), only if named. Materials: cloth and hair are
Lambertian round fibers of albedo 0.9 0.5 0.2, the others have their own. Lights: five directional
ones and a black background, so that colour ratios are those of the object alone. Views: facing,
45 and 80 degrees off. The level is chosen by the footprint of rays, or by --force-level. --samples
is for level 1; each level above has 4 times as many, up to 1024. --keep reuses existing pictures
with the same options: the traced ones, or all, which continues a run that was stopped. Volumes are
kept in FOLDER (default build/protocol_b), with result.md, errors.csv, sheet.png and errors.png.
Needs the packages of tools/compare.
"""
import argparse
import json
import math
import os
import sys

import protocol
from protocol import DATA, basis, dot, heddle, made, middle, plus, unit

PIXEL = math.radians(30.0) / 512  # angle of a pixel: that of 512 px in a view of 30 degrees
# front: direction towards the camera that faces it; up: in the picture
CLOTH = {"front": (0, 0, 1), "up": (-0.34, 0.94, 0), "yarn": True}
SCENES = {
    "knit": {"generate": "knit", **CLOTH},
    "satin": {"generate": "satin", **CLOTH},
    "hair": {"file": "hair/straight.hair", "front": (0, -1, 0), "up": (0, 0, 1), "fiber": True},
    "pine": {"file": "mesh/smallpine/scene.gltf", "front": (0, 0, 1), "up": (0, 1, 0)},
    "lamp": {
        "file": "mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf", "front": (0, 0, 1),
        "up": (0, 1, 0)
    },
    "helmet": {"file": "mesh/DamagedHelmet.glb", "front": (0, 0, 1), "up": (0, 1, 0)},
    "sweater": {
        "file": "yarn/bcc/sweater_flame_ribbing.bcc", "front": (0, 0, 1), "up": (0, 1, 0),
        "yarn": True
    },
}
VIEWS = {"facing": 0.0, "oblique": 45.0, "along": 80.0}
MATTE = "[material.matte]\nmodel = \"fiber\"\nalbedo = [0.9, 0.5, 0.2]\n"


def prepare(folder, name, a):
    """The scene's geometry file, its bounds, and its volume."""
    scene = SCENES[name]
    path = os.path.join(folder, f"{name}.bcc")
    if "generate" in scene:
        made(path, "generate", scene["generate"])
    else:
        path = os.path.join(DATA, scene["file"])
    model = ["--yarn", "cotton", "--yarn-radius", 0.1] if "yarn" in scene else []
    extra = (["--footprints", a.footprints] if a.footprints else []) + (["--correlation"]
                                                                        if a.correlation else [])
    volume = os.path.join(
        folder, "_".join([name, str(a.voxels), *(str(x).strip("-") for x in extra)]) + ".vdb")
    voxels = made(volume, "voxelize", path, "--voxels", a.voxels, *model, *extra, "--levels",
                  max(a.level) + 1, by=getattr(a, "made_by", None))
    reach = 0.2 if "yarn" in scene else 0.0  # curves may have the bounds of centrelines
    lo, hi = heddle("info", path)["bounds"]
    return path, ([x - reach for x in lo], [x + reach for x in hi]), volume, voxels["voxel_size"][0]


def scene_text(name, path, volume, c, back, up, distance, size):
    """The scene seen from `back` of the point c at a distance, lit by the five lights."""
    scene = SCENES[name]
    front = unit(scene["front"])
    side, top, _ = basis(front, scene["up"])
    angle = math.degrees(2 * math.atan(0.5 * size[1] * PIXEL))
    text = MATTE + protocol.camera_text(plus((1, c), (distance, back)), c, up, angle)
    for s, t, f, strength in ((0.5, -0.6, -1.0, 2.0), (-1.0, -0.3, -0.7, 0.7),
                              (0.2, 1.0, -0.6, 0.4), (0.1, -1.0, -0.1, 0.7), (0.0, 0.0, -1.0, 0.5)):
        text += protocol.sun_text(unit(plus((s, side), (t, top), (f, front))), strength)
    yarn = ("cotton", 0.1) if "yarn" in scene else None
    return text + protocol.object_text(volume, path, yarn, "matte"
                                       if "yarn" in scene or "fiber" in scene else None)


def view_axes(name, view):
    """The axes right, up and back of the view, and the camera's up."""
    scene = SCENES[name]
    tilt = math.radians(VIEWS[view])
    front, up = unit(scene["front"]), unit(scene["up"])
    back = unit(plus((math.cos(tilt), front), (math.sin(tilt), up)))
    sign = -1.0 if "yarn" in scene and tilt > 0 else 1.0  # cloth: its far end is up
    camera_up = plus((sign, up)) if sign > 0 or tilt == 0 else front
    return *basis(back, camera_up), camera_up


def camera(name, view, bounds, voxel, level):
    """The camera for which a voxel of the level covers a pixel, and the size of the picture."""
    right, top, back, camera_up = view_axes(name, view)
    distance = voxel * 2 ** level / PIXEL
    c = middle(bounds)
    reach = [0.0, 0.0]
    for corner in protocol.corners(bounds):
        p = plus((1, corner), (-1, c))
        for i, axis in enumerate((right, top)):
            reach[i] = max(reach[i], abs(dot(p, axis)) / max(distance - dot(p, back), 1e-9) / PIXEL)
    return back, camera_up, distance, [2 * math.ceil(r) + 4 for r in reach]


def render(folder, label, scene, more, keep):
    """The path of the picture and the result of `heddle render`."""
    out = os.path.join(folder, f"{label}.exr")
    if keep and os.path.exists(out) and os.path.exists(out + ".json"):
        with open(out + ".json") as file:
            return out, json.load(file)
    print(f"  render {label}", file=sys.stderr, flush=True)
    result = heddle("render", scene, "-o", out, *more)
    with open(out + ".json", "w") as file:
        json.dump(result, file)
    return out, result


def run_scene(folder, name, a):
    """(Job, result of the volume, result of the traced geometry) by picture."""
    from heddle_compare.jobs import Job
    path, bounds, volume, voxel = prepare(folder, name, a)
    out = []
    for view in a.view:
        for level in a.level:
            back, up, distance, size = camera(name, view, bounds, voxel, level)
            label = f"{name}_{a.voxels}_{view}_{level}"
            scene = os.path.join(folder, f"{label}.toml")
            with open(scene, "w") as file:
                file.write(
                    scene_text(name, path, volume, middle(bounds), back, up, distance, size))
            samples = min(1024, a.samples * 4 ** max(level - 1, 0))
            common = ["--size", f"{size[0]}x{size[1]}", "--samples", samples]
            reference, traced = render(folder, f"{label}_traced", scene,
                                       [*common, "--geometry", "--seed", 1], a.keep != "none")
            for transport in a.transport:
                more = [
                    *common, "--transport", transport,
                    *(["--level", level] if a.force_level else [])
                ]
                test, walked = render(folder, f"{label}_{transport}", scene, more, a.keep == "all")
                out.append((Job(reference, test, name, str(level), transport,
                                view), walked, traced))
    return out


def microseconds(result, picture):
    """Microseconds of all threads per path that hits the object, counted by 1 - transmittance."""
    met = float((1.0 - picture.transmittance).sum(dtype=float)) * result["samples"]
    return result["render_seconds"] * os.cpu_count() / max(met, 1.0) * 1e6


def result_table(entries, results):
    from heddle_compare.table import markdown
    body = []
    for (row, reference, test, _), (_, walked, traced) in zip(entries, results):
        body.append([
            row["scene"], row["view"], row["level"], row["method"], f"{row['flip']:.3f}",
            f"{row['flip_noise']:.3f}", f"{row['transmittance_bias']:+.3f}",
            f"{row['transmittance_mean']:.3f}", f"{row['transmittance_p95']:.3f}",
            f"{row['transmittance_noise']:.3f}",
            f"{row['ratio_r']:.2f} {row['ratio_g']:.2f} {row['ratio_b']:.2f}",
            f"{row['ratio_per_alpha']:.2f}", f"{microseconds(walked, test):.2f}",
            f"{microseconds(traced, reference):.2f}", f"{walked['scene_memory_bytes'] / 2**20:.1f}",
            f"{traced['scene_memory_bytes'] / 2**20:.0f}", row["pixels"]
        ])
    return markdown([
        "scene", "view", "level", "transport", "FLIP", "noise", "T bias", "T mean abs", "p95",
        "noise", "R G B", "per alpha", "us a path", "traced", "MiB", "traced", "pixels"
    ], body)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o",
                           "--output",
                           default=os.path.join(protocol.ROOT, "build/protocol_b"))
    arguments.add_argument("--scene",
                           nargs="+",
                           choices=list(SCENES),
                           default=[s for s in SCENES if s not in ("helmet", "sweater")])
    arguments.add_argument("--view", nargs="+", choices=list(VIEWS), default=list(VIEWS))
    arguments.add_argument("--level", nargs="+", type=int, default=[1, 2, 3, 4, 5])
    arguments.add_argument("--transport", nargs="+", default=["product"])
    arguments.add_argument("--samples", type=int, default=32)
    arguments.add_argument("--voxels", type=int, default=512)
    arguments.add_argument("--force-level", action="store_true")
    arguments.add_argument("--footprints", type=int, choices=(4, 8))
    arguments.add_argument("--correlation", action="store_true")
    arguments.add_argument("--keep",
                           choices=("none", "traced", "all"),
                           default="none",
                           help="reuses existing pictures")
    a = arguments.parse_args()
    protocol.need_packages()
    from heddle_compare import run, table
    os.makedirs(a.output, exist_ok=True)
    results = [x for name in a.scene for x in run_scene(a.output, name, a)]
    entries = run.compare([job for job, _, _ in results])
    run.write_all(a.output, entries)
    text = protocol.head("Protocol B: a voxel a pixel, against traced geometry")
    text += (
        "Means over touched pixels. T: transmittance, test - traced. `noise`: the error of the pictures' noise alone (T: at most). R G B: ratio of colour "
        "sums; per alpha: of luminance by covered area. Times: of all threads, per path that meets the object, other work on the machine. Goal: FLIP "
        "and T mean abs 0.02 and 0.01.\n\n")
    text += result_table(entries, results)
    with open(os.path.join(a.output, "result.md"), "w") as file:
        file.write(text)
    print(text, end="")


if __name__ == "__main__":
    main()
