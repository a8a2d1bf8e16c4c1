#!/usr/bin/env python3
"""Speed and memory of `heddle voxelize` on a knitted sweater, as a markdown table.

usage: bench/voxelize_speed.py [--quick] [--yarn silk]
Nine runs (512, 1024, 2048 voxels x 50, 150, 450 fibers per yarn) on all cores, one on one thread,
one with flyaways, one with --memory 1500M. Fits seconds = a steps + b touched subvoxels + c voxels
to the nine. heddle_expand_bench (HEDDLE_BENCH=ON) measures the evaluation of fibers alone.
Needs build/release/bin/heddle (or HEDDLE=...) and ../shared/data (or HEDDLE_TEST_DATA=...).
"""
import argparse
import itertools
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEDDLE = os.environ.get("HEDDLE", os.path.join(ROOT, "build/release/bin/heddle"))
DATA = os.environ.get("HEDDLE_TEST_DATA", os.path.join(ROOT, "../shared/data"))
SWEATER = os.path.join(DATA, "yarn/bcc/sweater_flame_ribbing.bcc")


def voxelize(folder, voxels, fibers, yarn, *more):
    out = os.path.join(folder, "out.vdb")
    command = [HEDDLE, "voxelize", SWEATER, "-o", out, "--yarn", yarn, "--yarn-radius", "0.1",
               "--fibers", str(fibers), "--voxels", str(voxels), "--levels", "0", "--json", *more]
    result = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    os.remove(out)
    return result


def solve(rows, values):
    """Least squares by the normal equations."""
    n = len(rows[0])
    m = [[sum(r[i] * r[j] for r in rows) for j in range(n)] +
         [sum(r[i] * v for r, v in zip(rows, values))] for i in range(n)]
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(m[k][i]))
        m[i], m[p] = m[p], m[i]
        for k in range(n):
            if k != i:
                f = m[k][i] / m[i][i]
                m[k] = [x - f * y for x, y in zip(m[k], m[i])]
    return [m[i][n] / m[i][i] for i in range(n)]


def fit(runs):
    """Relative least squares without negative costs: the best of all subsets of the three terms."""
    best = None
    for keep in itertools.chain.from_iterable(
            itertools.combinations(range(3), k) for k in (3, 2, 1)):
        rows = [[r["terms"][i] / r["total_seconds"] for i in keep] for r in runs]
        cost = [0.0] * 3
        for i, c in zip(keep, solve(rows, [1.0] * len(rows))):
            cost[i] = c
        if min(cost) < 0:
            continue
        error = sum((sum(c * t for c, t in zip(cost, r["terms"])) / r["total_seconds"] - 1)**2
                    for r in runs)
        if best is None or error < best[0]:
            best = (error, cost)
    return best[1]


def row(name, r, extra=""):
    mib = 1 / 1048576
    print(
        f"| {name} | {r['steps'] / 1e6:.0f} | {r['voxels'] / 1e6:.2f} | {r['read_seconds']:.2f} "
        f"| {r['plan_seconds']:.2f} | {r['voxelize_seconds']:.2f} | {r['write_seconds']:.2f} "
        f"| {r['total_seconds']:.2f} | {r['steps'] / r['total_seconds'] / 1e6:.1f} "
        f"| {r['peak_memory_bytes'] * mib:.0f} | {r['predicted_peak_memory_bytes'] / r['peak_memory_bytes'] - 1:+.0%} "
        f"| {extra} |")
    sys.stdout.flush()


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--yarn", default="silk")
    arguments.add_argument("--quick", action="store_true", help="512 voxels only")
    a = arguments.parse_args()
    if not os.path.exists(SWEATER):
        sys.exit(f"voxelize_speed: skipped, no {SWEATER}")
    sizes = [512] if a.quick else [512, 1024, 2048]
    print(
        "| run | M steps | M voxels | read s | plan s | voxelize s | write s | total s | M steps/s | peak MiB "
        "| predicted peak | |\n|---|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(dir=".") as folder:
        runs = []
        for voxels in sizes:
            for fibers in (50, 150, 450):
                r = voxelize(folder, voxels, fibers, a.yarn)
                r["terms"] = [r["steps"], r["predicted_touched_subvoxels"], r["voxels"]]
                r["name"] = f"{voxels} voxels, {fibers} fibers"
                runs.append(r)
                row(r["name"], r)
        mid = sizes[len(sizes) // 2]
        one = voxelize(folder, mid, 150, a.yarn, "--threads", "1")
        two = next(r for r in runs if r["name"] == f"{mid} voxels, 150 fibers")
        row(f"{mid}, 150, 1 thread", one,
            f"all cores: {one['total_seconds'] / two['total_seconds']:.2f} times as fast")
        row(f"{mid}, 150, wool (flyaways)", voxelize(folder, mid, 150, "wool"))
        big = next(r for r in runs if r["name"] == f"{sizes[-1]} voxels, 150 fibers")
        small = voxelize(folder, sizes[-1], 150, a.yarn, "--memory", "1500M")
        row(f"{sizes[-1]}, 150, --memory 1500M", small,
            f"{small['total_seconds'] / big['total_seconds']:.2f} times as long")
        cost = fit(runs)
        print(
            f"\nseconds = {cost[0]:.3g} steps + {cost[1]:.3g} touched subvoxels + {cost[2]:.3g} voxels, "
            "by run: " + ", ".join(
                f"{sum(c * t for c, t in zip(cost, r['terms'])) / r['total_seconds'] - 1:+.0%}"
                for r in runs))
        print("planner's own estimate, by run: " + ", ".join(
            f"{r['predicted_time_seconds'] / r['total_seconds'] - 1:+.0%}" for r in runs))


main()
