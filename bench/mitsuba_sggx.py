#!/usr/bin/env python3
"""Does Mitsuba 3's `sggx` phase function sample its own density? One JSON line per S and direction.

usage: bench/mitsuba_sggx.py    (Python with mitsuba and numpy)
Prints the `integral` of the pdf over the sphere, and the mean of |wo . z| under the pdf and of the
directions that `sample` draws: the last two must agree.
"""
import json

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")


def check(S, wi, n=20000):
    grid = mi.VolumeGrid(np.broadcast_to(np.array(S, np.float32), (4, 4, 4, 6)).copy())
    phase = mi.load_dict({"type": "sggx", "S": {"type": "gridvolume", "grid": grid, "raw": True}})
    at = mi.MediumInteraction3f()
    at.p = [.5, .5, .5]
    at.t = 1
    at.wi = mi.Vector3f(wi)
    at.sh_frame = mi.Frame3f(at.wi)
    rng = np.random.default_rng(1)
    context = mi.PhaseFunctionContext()
    by_pdf = integral = drawn = 0.0
    for _ in range(n):
        w = rng.normal(size=3)
        w /= np.linalg.norm(w)
        pdf = phase.eval_pdf(context, at, mi.Vector3f(w))[1] * 4 * np.pi
        integral += pdf / n
        by_pdf += pdf * abs(w[2]) / n
        wo = phase.sample(context, at, float(rng.random()), mi.Point2f(*rng.random(2)))[0]
        drawn += abs(wo[2]) / n
    print(json.dumps({
        "S": S, "wi": [round(float(x), 3) for x in wi], "integral": round(float(integral), 3),
        "mean |wo z| by pdf": round(float(by_pdf), 3), "drawn": round(float(drawn), 3)
    }),
          flush=True)


for matrix in ((1, 1, 1, 0, 0, 0), (1, 1, .01, 0, 0, 0), (1, 1, .3, 0, 0, 0)):
    for direction in ((1, 0, 0), (.6, 0, .8)):
        check(matrix, direction)
