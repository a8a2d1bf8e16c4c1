#!/usr/bin/env python3
"""Brightness of volumes against their geometry traced, under single lights: a row for each object,
view, order of scattering and angle between light and view, a column for each level.

usage: bench/lights.py [-o FOLDER] [--heddle PROGRAM] [--quick] [--object NAME...] [--level L...]
                       [--angle DEGREES...] [--depth 1 64] [--view facing oblique]
                       [--transport auto] [--error 0.01] [--most 1024] [--result FILE]
knit: stockinette of yarn `cotton` with Lambertian fibers, knit_tt: with fibers that transmit most
of the light (R + TT at most 0.94); hair_dark, hair_blond: the right side of straight hair, with its
rim, which light from behind reaches; sphere: a mesh with a Lambertian surface; leaves: a part of
smallpine. Pictures are crops of 32 x 32 pixels. The light is `angle` degrees beside the camera: 0
is behind it, 160 nearly in front of it. Luminance and R G B are means by covered area. Samples are
added until the standard error of each ratio is below --error. Where the traced luminance is under
2 % of the brightest that the object has in this view and order of scattering, the table gives the
difference as a share of that brightest, as +0.0000b. Goal: ratios of 0.97 to 1.03, give or take two
standard errors, none beyond 0.9 to 1.1, differences of at most 0.003. Volumes and traced means are
kept in FOLDER (default build/lights): what is traced is traced once, volumes are made again for
another heddle. --quick has fewer angles and levels, at an error of 0.02. Needs the packages of
tools/compare.
"""
import argparse
import math
import os
import struct

import protocol
from protocol import DATA, basis, made, plus, unit

SIZE, VIEW_ANGLE = 32, 4.0
ANGLES = [0, 20, 40, 60, 80, 100, 130, 160]
DIM, DIFFERENCE = 0.02, 0.003  # of the brightest
FIBER = "model = \"fiber\"\nalbedo = [0.9, 0.5, 0.2]\n"
TT = "model = \"lobe_fiber\"\ncolor_r = 0.04\ncolor_tt = [0.9, 0.6, 0.3]\nwidth_r = 8\nwidth_tt = 27\nazimuth_tt = 38\n"
HAIR = "model = \"hair\"\nmelanin = {}\nwidth_m = 0.3\nwidth_n = 0.3\ntilt = 2\n"
SURFACE = "model = \"surface\"\nalbedo = [0.9, 0.5, 0.2]\nroughness = 1\nmetalness = 0\nspecular = 0\n"
COTTON = ("cotton", 0.1)
CLOTH = {
    "input": "knit", "voxel": 0.0336, "yarn": COTTON, "middle": (4.0, 3.9, 0.0), "high": 4.2,
    "front": (0, 0, 1), "up": (0, 1, 0)
}
STRANDS = {
    "input": "hair", "voxel": 0.169, "middle": (25.0, -4.0, 14.0), "high": 16.0,
    "front": (0, -1, 0), "up": (0, 0, 1), "along": True
}
# input: a name of prepare(); voxel: its size; high: height of the view of the middle
OBJECTS = {
    "knit": {**CLOTH, "material": FIBER},
    "knit_tt": {**CLOTH, "material": TT},
    "hair_dark": {**STRANDS, "material": HAIR.format("[4.0, 0.0]")},
    "hair_blond": {**STRANDS, "material": HAIR.format("[0.3, 0.1]")},
    "sphere": {
        "input": "sphere", "voxel": 2 / 256, "middle": (0, 0, 0), "high": 2.1, "front": (0, 0, 1),
        "up": (0, 1, 0), "material": SURFACE
    },
    "leaves": {
        "input": "pine", "voxel": 0.1465, "middle": (14.0, 26.0, 0.0), "high": 22.0,
        "front": (0, 0, 1), "up": (0, 1, 0)
    },
}
FILES = {"hair": "hair/straight.hair", "pine": "mesh/smallpine/scene.gltf"}
VIEWS = {"facing": 0.0, "oblique": 45.0}


def write_hair_piece(source, path, low, high):
    """The parts of the strands of a .hair file between two corners."""
    with open(source, "rb") as file:
        data = file.read()
    _, strands, points, fields, segments = struct.unpack("<4sIIII", data[:20])
    at, lengths = 128, [segments] * strands
    if fields & 1:
        lengths = struct.unpack(f"<{strands}H", data[at:at + 2 * strands])
        at += 2 * strands
    xyz = struct.unpack(f"<{3 * points}f", data[at:at + 12 * points])
    pieces, first = [], 0
    for length in lengths:
        strand = [xyz[3 * i:3 * i + 3] for i in range(first, first + length + 1)]
        pieces += protocol.runs_inside(strand, low, high)
        first += length + 1
    with open(path, "wb") as file:
        count = sum(map(len, pieces))
        # the fields are the number of segments and the points; radii come from the header
        file.write(struct.pack("<4sIII", b"HAIR", len(pieces), count, 3) + data[16:128])
        file.write(struct.pack(f"<{len(pieces)}H", *(len(p) - 1 for p in pieces)))
        file.write(b"".join(struct.pack("<3f", *p) for piece in pieces for p in piece))


def write_sphere(path, rings=96):
    """The unit sphere as an .obj with its normals."""
    rows, columns = rings + 1, 2 * rings
    with open(path, "w") as file:
        for i in range(rows):
            for j in range(columns):
                t, p = math.pi * i / rings, math.pi * j / rings
                n = f"{math.sin(t) * math.cos(p):.7f} {math.sin(t) * math.sin(p):.7f} {math.cos(t):.7f}"
                file.write(f"v {n}\nvn {n}\n")
        for i in range(rings):
            for j in range(columns):
                a, b = i * columns + j + 1, i * columns + (j + 1) % columns + 1
                c, d = b + columns, a + columns
                if i > 0:
                    file.write(f"f {a}//{a} {d}//{d} {b}//{b}\n")
                if i < rings - 1:
                    file.write(f"f {b}//{b} {d}//{d} {c}//{c}\n")


def prepare(folder, name, a):
    """The paths of the geometry and of the volume of an object's input."""
    it = OBJECTS[name]
    kind = it["input"]
    path = os.path.join(DATA, FILES.get(kind, ""))
    if kind == "knit":
        path = os.path.join(folder, "knit.bcc")
        made(path, "generate", "knit", "--counts", "10,12")
    elif kind == "sphere":
        path = os.path.join(folder, "sphere.obj")
        write_sphere(path)
    elif kind == "hair":
        path = os.path.join(folder, "hair.hair")
        write_hair_piece(os.path.join(DATA, FILES["hair"]), path, (9, -36, -2), (33, 26, 30))
    volume = os.path.join(folder, f"{kind}.vdb")
    yarn = ["--yarn", it["yarn"][0], "--yarn-radius", it["yarn"][1]] if "yarn" in it else []
    made(volume, "voxelize", path, "--voxel-size", it["voxel"], "--levels", 5, *yarn, by=a.made_by)
    return path, volume


def scene_text(name, path, volume, view, angle, depth):
    """The object with a light `angle` degrees to the side of the camera; below it for hair that is
    seen obliquely, since strands reflect light of the mirrored inclination alone."""
    it = OBJECTS[name]
    tilt, turn = math.radians(VIEWS[view]), math.radians(angle)
    front, up = unit(it["front"]), unit(it["up"])
    right, top, back = basis(plus((math.cos(tilt), front), (math.sin(tilt), up)),
                             up if tilt < 1 else front)
    distance = 0.5 * it["high"] / math.tan(math.radians(0.5 * VIEW_ANGLE))
    text = protocol.camera_text(plus((1, it["middle"]), (distance, back)), it["middle"], top,
                                VIEW_ANGLE)
    aside = plus((-1, top)) if "along" in it and tilt > 0 else right
    text += protocol.sun_text(unit(plus((-math.cos(turn), back), (-math.sin(turn), aside))), 3.0)
    text += f"[integrator]\nmax_depth = {depth}\n"
    material = "material" in it
    text += f"[material.it]\n{it['material']}" if material else ""
    return text + protocol.object_text(volume, path, it.get("yarn"), "it" if material else None)


def render_mean(a, label, text, more, target):
    """The Mean of a picture whose standard error is at most target(Mean)."""
    scene = protocol.write_text(os.path.join(a.output, f"{label}.toml"), text)
    picture = os.path.join(a.output, f"{label}.exr")
    mean = protocol.render_to_error(picture, scene, f"{SIZE}x{SIZE}", more, target, a.pilot, a.most)
    os.remove(picture)
    os.remove(scene)
    return vars(mean)


def traced_mean(a, files, row):
    """Traced once: the key is all that the mean depends on."""
    name = row[0]
    text = scene_text(name, files[name][0], None, *row[1:])
    label = "_".join(map(str, row))
    key = protocol.digest(text.replace(a.output, ""), SIZE, a.error, a.most)
    return protocol.kept(
        os.path.join(a.output, "traced", f"{label}_{key}.json"),
        lambda: render_mean(a, f"{label}_traced", text, ["--geometry", "--seed", 1], lambda mean:
                            0.7 * a.error * mean.luminance))


def volume_mean(a, files, row, level, traced, brightest):
    """As good as the ratio needs it, or the difference where it is dim."""
    name = row[0]
    dim = traced["luminance"] < DIM * brightest
    allowed = 0.3 * DIFFERENCE * brightest if dim else 0.7 * a.error * traced["luminance"]
    return render_mean(a, "_".join(map(str,
                                       (*row, level))), scene_text(name, *files[name], *row[1:]),
                       ["--level", level, "--transport", a.transport], lambda mean: allowed)


def cell_of(traced, volume, brightest):
    """What a cell of the tables shows, and the worst measure of it."""
    if traced["luminance"] < DIM * brightest:
        off = (volume["luminance"] - traced["luminance"]) / brightest
        error = math.hypot(volume["error"], traced["error"]) / brightest
        return {"dim": True, "value": off, "error": error, "text": f"{off:+.4f}b"}
    ratio = volume["luminance"] / traced["luminance"]
    colors = " ".join(f"{v / max(t, 1e-12):.2f}" for v, t in zip(volume["color"], traced["color"]))
    error = ratio * math.hypot(volume["error"] / max(volume["luminance"], 1e-12),
                               traced["error"] / traced["luminance"])
    return {"dim": False, "value": ratio, "error": error, "text": f"{ratio:.2f} ({colors})"}


def meets(cell):
    """Whether a cell is within the goal, give or take two standard errors."""
    slack = 2 * cell["error"]
    if cell["dim"]:
        return abs(cell["value"]) <= DIFFERENCE + slack
    return 0.97 - slack <= cell["value"] <= 1.03 + slack and 0.9 <= cell["value"] <= 1.1


def summary(cells, a):
    """A table of an object by level, and the lines of the goal."""
    from heddle_compare.table import markdown
    body = []
    for name in a.object:
        for depth in a.depth:
            line = [name, depth]
            for level in a.level:
                some = [
                    c for (row, at), c in cells.items()
                    if at == level and row[0] == name and row[3] == depth
                ]
                bright = [c["value"] for c in some if not c["dim"]]
                met = sum(map(meets, some))
                line.append(f"{min(bright):.2f} to {max(bright):.2f}, {met}/{len(some)}")
            body.append(line)
    return markdown(["object", "depth", *(f"level {level}" for level in a.level)], body)


def goal_lines(cells):
    bright = {k: c for k, c in cells.items() if not c["dim"]}
    dim = {k: c for k, c in cells.items() if c["dim"]}
    beyond = sum(not 0.9 <= c["value"] <= 1.1 for c in bright.values())
    text = (
        f"{sum(map(meets, bright.values()))} of {len(bright)} ratios are within 0.97 to 1.03, {beyond} are beyond 0.9 to 1.1; "
        f"{sum(map(meets, dim.values()))} of {len(dim)} differences are within {DIFFERENCE} of the brightest. "
        f"Largest standard error of a ratio: {max(c['error'] for c in bright.values()):.3f}.\n\n")
    failed = {k: c for k, c in cells.items() if not meets(c)}
    if not failed:
        return text + "goal met\n"

    def distance(key):
        c = failed[key]
        return abs(c["value"]) / DIFFERENCE * 0.03 if c["dim"] else abs(
            math.log(max(c["value"], 1e-9)))

    (name, view, angle, depth), level = worst = max(failed, key=distance)
    value = f"{failed[worst]['value']:+.4f} of the brightest" if failed[worst][
        "dim"] else f"{failed[worst]['value']:.2f}"
    return text + f"goal not met: {name} {view} depth {depth} {angle} degrees level {level} {value}\n"


def tables(cells, traced, brightest, a):
    """A table of all angles for each object."""
    from heddle_compare.table import markdown
    text = ""
    for name in a.object:
        body = []
        for view in a.view:
            for depth in a.depth:
                for angle in a.angle:
                    row = (name, view, angle, depth)
                    share = traced[row]["luminance"] / brightest[name, view, depth]
                    body.append([
                        view, depth, angle, f"{share:.3f}",
                        *(cells[row, level]["text"] for level in a.level)
                    ])
        text += f"\n## {name}\n\n" + markdown(
            ["view", "depth", "angle", "traced", *(f"level {level}" for level in a.level)], body)
    return text


def measure(a):
    """The cells by (row, level), the traced means by row, and the brightest of each object."""
    folder = a.output
    inputs = {
        n: os.path.join(DATA, FILES[o["input"]]) if o["input"] in FILES else None
        for n, o in OBJECTS.items()
    }
    a.object = protocol.existing(a.object, inputs)
    files = dict(zip(a.object, [prepare(folder, name, a) for name in a.object]))
    rows = [(name, view, angle, depth) for name in a.object for view in a.view for depth in a.depth
            for angle in a.angle]
    traced = dict(
        zip(rows, protocol.in_parallel(lambda row: traced_mean(a, files, row), rows, a.threads)))
    brightest = {}
    for (name, view, _, depth), mean in traced.items():
        key = (name, view, depth)
        brightest[key] = max(brightest.get(key, 0.0), mean["luminance"])
    keys = [(row, level) for row in rows for level in a.level]

    def measured(key):
        row, level = key
        top = brightest[row[0], row[1], row[3]]
        mean = volume_mean(a, files, row, level, traced[row], top)
        return cell_of(traced[row], mean, top)

    return dict(zip(keys, protocol.in_parallel(measured, keys, a.threads))), traced, brightest


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    protocol.add_options(arguments, "lights")
    arguments.add_argument("--object", nargs="+", choices=list(OBJECTS), default=list(OBJECTS))
    arguments.add_argument("--view", nargs="+", choices=list(VIEWS), default=list(VIEWS))
    arguments.add_argument("--level", nargs="+", type=int)
    arguments.add_argument("--angle", nargs="+", type=int)
    arguments.add_argument("--depth", nargs="+", type=int, default=[1, 64])
    arguments.add_argument("--error", type=float, help="default: 0.01, with --quick 0.02")
    arguments.add_argument("--most",
                           type=int,
                           help="samples of a pixel; default: 1024, with --quick 64")
    a = arguments.parse_args()
    protocol.use_options(a, "lights")
    a.level = a.level or ([1, 3, 5] if a.quick else [0, 1, 2, 3, 4, 5])
    a.angle = a.angle or ([0, 40, 80, 130] if a.quick else ANGLES)
    a.error = a.error or (0.02 if a.quick else 0.01)
    a.pilot, a.most = 8, a.most or (64 if a.quick else 1024)
    cells, traced, brightest = measure(a)
    text = protocol.head("Brightness under single lights, volume against traced geometry")
    text += (
        "Ratios of luminance by covered area, in brackets of R, G and B; `traced`: its share of the object's brightest; a value with `b` is the difference as a share of the "
        "brightest, where the traced one is under 2 % of it. The light is as many degrees beside the camera.\n\n"
        "By object and level: least and largest ratio, and how many of the angles and views meet the goal.\n\n"
    )
    text += summary(cells, a) + tables(cells, traced, brightest, a) + "\n" + goal_lines(cells)
    protocol.write_text(a.result, text)
    print(text, end="")


if __name__ == "__main__":
    main()
