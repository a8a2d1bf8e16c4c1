#!/usr/bin/env python3
"""Converged crops in which a voxel covers a pixel: FLIP, transmittance and colour against traced
geometry, and what of FLIP is the error of coverage, of the mean colour, or of neither.

usage: bench/protocol_c.py [-o FOLDER] [--heddle PROGRAM] [--quick]
                           [--scene knit hair pine lamp helmet] [--view facing oblique along]
                           [--level 1 3 5] [--transport auto] [--noise 0.03] [--voxels 512]
                           [--result FILE]
Scenes, lights and pixels are those of protocol B. A crop has 24 x 24 pixels, near an edge of the
object; from level 5 on it shows all of it. Knit alone is seen along, too. Samples are added until
the FLIP that noise alone makes is below --noise. Goals: with that noise taken off, FLIP is at most
0.10 in every cell and 0.07 on average; the bias of transmittance is at most 0.010 in every cell and
its mean absolute error 0.025 on average. Volumes and traced crops are kept in FOLDER (default
build/protocol_c), with errors.csv and sheet.png: what is traced is traced once, volumes are made
again for another heddle. --quick has more noise, 0.06. Needs the packages of tools/compare.
"""
import argparse
import dataclasses
import math
import os

import protocol
import protocol_b
from protocol import dot, heddle, middle, plus

SIZE = 24
# where the crop lies, in the picture's half width and height; at most at the object's border
CROPS = {
    "knit": (-0.5, 0.85), "hair": (-1.0, 0.0), "pine": (0.5, -0.2), "lamp": (0.25, 0.0),
    "helmet": (0.8, 0.0)
}
ALONG = ("knit", )


def crop_scene(name, path, volume, bounds, voxel, view, level):
    """The scene text of the crop."""
    right, top, back, up = protocol_b.view_axes(name, view)
    edge = voxel * 2**level  # of a pixel, where the target is
    c = middle(bounds)
    target = c
    for axis, part in zip((right, top), CROPS[name]):
        reach = max(abs(dot(plus((1, p), (-1, c)), axis)) for p in protocol.corners(bounds))
        # two pixels of background are left at the border
        free = max(0.0, reach - (0.5 * SIZE - 2) * edge)
        target = plus((1, target), (part * free, axis))
    return protocol_b.scene_text(name, path, volume, target, back, up, edge / protocol_b.PIXEL,
                                 [SIZE, SIZE])


def own_noise(picture, stops):
    """The FLIP that the noise of one picture makes."""
    from heddle_compare.errors import TOUCHED, noise_flip
    still = dataclasses.replace(picture, variance=0 * picture.variance)
    mask = picture.transmittance < 1 - TOUCHED
    return noise_flip(picture, still, 2.0**stops, mask) if mask.any() else 0.0


def render_crop(out, scene, more, a, stops=None):
    """Renders until the picture's own noise is small enough. FLIP grows as the 0.7th power of a
    small difference of colours, so noise falls as the samples to the power of 0.35."""
    from heddle_compare.errors import auto_exposure
    from heddle_compare.picture import read_picture
    allowed = a.noise / 2**0.35  # two pictures of this noise make a.noise
    samples = a.pilot
    while True:
        heddle("render", scene, "-o", out, "--size", f"{SIZE}x{SIZE}", "--samples", samples, *more)
        picture = read_picture(out)
        noise = own_noise(picture, auto_exposure(picture) if stops is None else stops)
        if noise <= allowed or samples >= a.most:
            return out
        more_samples = min(16.0, 1.1 * (noise / allowed)**(1 / 0.35))
        samples = min(a.most, math.ceil(samples * max(more_samples, 1.5)))


def crop(a, prepared, cell):
    """The Job of a cell: its two pictures."""
    from heddle_compare.errors import auto_exposure
    from heddle_compare.jobs import Job
    from heddle_compare.picture import read_picture
    name, view, level = cell
    path, bounds, volume, voxel = prepared[name]
    label = f"{name}_{view}_{level}"
    text = crop_scene(name, path, volume, bounds, voxel, view, level)
    scene = protocol.write_text(os.path.join(a.output, f"{label}.toml"), text)
    key = protocol.digest(text.replace(a.output, ""), a.noise, a.most)
    traced = os.path.join(a.output, "traced", f"{label}_{key}.exr")
    if not os.path.exists(traced):
        part = traced.replace(".exr", ".part.exr")
        os.replace(render_crop(part, scene, ["--geometry", "--seed", 1], a), traced)
    stops = auto_exposure(read_picture(traced))
    test = render_crop(os.path.join(a.output, f"{label}.exr"), scene, ["--transport", a.transport],
                       a, stops)
    return Job(traced, test, name, str(level), a.transport, view)


def area_colors(picture):
    """Colour by covered area of each pixel, with the mean where little is covered, and the mean."""
    import numpy as np
    alpha = 1.0 - picture.transmittance
    mean = picture.rgb.sum(axis=(0, 1), dtype=float) / max(float(alpha.sum(dtype=float)), 1e-9)
    some = alpha[..., None] > 0.01
    return np.where(some, picture.rgb / np.maximum(alpha, 0.01)[..., None], mean), mean, alpha


def parts_of_flip(reference, test, stops):
    """FLIP if only coverage were wrong, if only the mean colour were, and if neither were."""
    import numpy as np
    from heddle_compare.errors import TOUCHED, flip_map
    scale = 2.0**stops
    color_a, mean_a, alpha_a = area_colors(reference)
    color_b, mean_b, alpha_b = area_colors(test)
    ratio = mean_b / np.maximum(mean_a, 1e-9)
    mask = (alpha_a > TOUCHED) | (alpha_b > TOUCHED)
    wrong = (color_a * alpha_b[..., None], reference.rgb * ratio,
             color_b / np.maximum(ratio, 1e-9) * alpha_a[..., None])
    truth = reference.rgb * scale
    flips = [float(flip_map(truth, (x * scale).astype(np.float32))[mask].mean()) for x in wrong]
    return flips, [float(x) for x in ratio]


def clean(row):
    """FLIP with the noise taken off."""
    return math.sqrt(max(row["flip"]**2 - row["flip_noise"]**2, 0.0))


def short(x):
    """Two digits after the point, without the zero before it."""
    return f"{x:.2f}".lstrip("0") if 0 <= x < 1 else f"{x:.2f}"


def goal_line(what, goal, worst, value):
    met = "goal met" if value <= goal else f"goal not met: {worst} {value:.3f}"
    return f"{what} at most {goal}: {met}\n\n"


def result_text(entries, a):
    from heddle_compare.table import markdown
    cells, names = {}, []
    for row, reference, test, _ in entries:
        flips, ratio = parts_of_flip(reference, test, row["exposure"])
        key = f"{row['scene']} {row['view']}"
        names += [key] if key not in names else []
        cells[key, row["level"]] = (
            f"{short(row['flip'])} ({short(row['flip_noise'])}) {row['transmittance_bias']:+.3f}/{row['transmittance_mean']:.3f} "
            f"{' '.join(map(short, ratio))} [{' '.join(map(short, flips))}]")
    text = markdown(["", *(f"level {level}" for level in a.level)],
                    [[n, *(cells.get((n, str(level)), "") for level in a.level)] for n in names])

    def label(row):
        return f"{row['scene']} {row['view']} level {row['level']}"

    rows = [entry[0] for entry in entries]
    worst = max(rows, key=clean)
    biased = max(rows, key=lambda row: abs(row["transmittance_bias"]))
    noisy = max(rows, key=lambda row: row["flip_noise"])
    count = len(rows)
    text += f"\nLargest noise: {label(noisy)} {noisy['flip_noise']:.3f}.\n\n"
    text += goal_line("Mean absolute error of transmittance, mean of cells,", 0.025, "mean",
                      sum(row["transmittance_mean"] for row in rows) / count)
    text += goal_line("Bias of transmittance in every cell", 0.010, label(biased),
                      abs(biased["transmittance_bias"]))
    text += goal_line("FLIP without noise, mean of cells,", 0.07, "mean",
                      sum(map(clean, rows)) / count)
    return text + goal_line("FLIP without noise in every cell", 0.10, label(worst),
                            clean(worst)).strip() + "\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    protocol.add_options(arguments, "protocol_c")
    arguments.add_argument("--scene", nargs="+", choices=list(CROPS), default=list(CROPS))
    arguments.add_argument("--view",
                           nargs="+",
                           choices=list(protocol_b.VIEWS),
                           default=list(protocol_b.VIEWS))
    arguments.add_argument("--level", nargs="+", type=int, default=[1, 3, 5])
    arguments.add_argument("--noise", type=float, help="default: 0.03, with --quick 0.06")
    arguments.add_argument("--voxels", type=int, default=512)
    a = arguments.parse_args()
    protocol.use_options(a, "protocol_c")
    from heddle_compare import run
    a.noise = a.noise or (0.06 if a.quick else 0.03)
    a.pilot, a.most = 64, 1024 if a.quick else 16384
    a.footprints = a.correlation = None
    a.scene = protocol.existing(
        a.scene, {
            n: os.path.join(protocol.DATA, s["file"]) if "file" in s else None
            for n, s in protocol_b.SCENES.items()
        })
    prepared = {name: protocol_b.prepare(a.output, name, a) for name in a.scene}
    cells = [(name, view, level) for name in a.scene for view in a.view
             if view != "along" or name in ALONG for level in a.level]
    jobs = protocol.in_parallel(lambda cell: crop(a, prepared, cell), cells, a.threads)
    entries = run.compare(jobs)
    run.write_all(a.output, entries)
    text = protocol.head("Protocol C: converged crops, a voxel a pixel, against traced geometry")
    text += (
        "Cells: FLIP (FLIP of the noise alone), bias / mean absolute error of transmittance, R G B by covered area relative to traced, [FLIP if only coverage "
        "were wrong, only the mean colour, neither]. Means are over touched pixels.\n\n")
    text += result_text(entries, a)
    protocol.write_text(a.result, text)
    print(text, end="")


if __name__ == "__main__":
    main()
