"""Shared by protocols A and B: heddle's command, scene files, cameras, the path of results."""
import json
import math
import os
import platform
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEDDLE = os.environ.get("HEDDLE", os.path.join(ROOT, "build/release/bin/heddle"))
DATA = os.environ.get("HEDDLE_TEST_DATA", os.path.join(ROOT, "../shared/data"))
sys.path.insert(0, os.path.join(ROOT, "tools"))


def heddle(*words):
    """Runs heddle with --json and returns its result; if it fails, exits with its message."""
    done = subprocess.run([HEDDLE, *map(str, words), "--quiet", "--json"],
                          capture_output=True,
                          text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr.strip()}")
    return json.loads(done.stdout)


def made(path, *words):
    """Makes `path` with heddle unless it exists; the JSON result is kept beside it."""
    note = path + ".json"
    if not (os.path.exists(path) and os.path.exists(note)):
        print(f"  {' '.join(map(str, words))}", file=sys.stderr, flush=True)
        result = heddle(*words, "-o", path)
        with open(note, "w") as file:
            json.dump(result, file)
    with open(note) as file:
        return json.load(file)


def plus(*terms):
    """The sum of (factor, vector) pairs."""
    return [sum(f * v[i] for f, v in terms) for i in range(3)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    return plus((1 / math.sqrt(dot(v, v)), v))


def basis(back, up):
    """The axes right, up and back of a camera that looks along -back."""
    back = unit(back)
    right = unit(cross(up, back))
    return right, cross(back, right), back


def corners(bounds):
    lo, hi = bounds
    return [[(lo, hi)[(c >> i) & 1][i] for i in range(3)] for c in range(8)]


def middle(bounds):
    return plus((0.5, bounds[0]), (0.5, bounds[1]))


def camera_text(eye, target, up, angle):
    return (
        f"[camera]\neye = {list(eye)}\ntarget = {list(target)}\nup = {list(map(float, up))}\nview_angle = {angle!r}\n"
    )


def sun_text(direction, color):
    return f"[[light]]\nkind = \"directional\"\ndirection = {list(direction)}\ncolor = {color}\n"


def commit():
    done = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"],
                          capture_output=True,
                          text=True)
    return done.stdout.strip() or "unknown"


def machine():
    """The processor and its cores, for the head of a result file."""
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as file:
            name = next(
                line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{name}, {os.cpu_count()} cores"


def head(title):
    command = " ".join([os.path.relpath(sys.argv[0], ROOT), *sys.argv[1:]])
    return f"# {title}\n\n`{command}`, commit {commit()}, {machine()}. Errors: `tools/heddle_compare/errors.py`.\n\n"


def need_packages():
    try:
        # only checks that they exist
        import flip_evaluator, matplotlib, numpy, OpenEXR, PIL  # noqa: F401, E401
    except ImportError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: the Python package '{error.name}' is missing; "
                 "pip install -r tools/heddle_compare/requirements.txt")
    if not os.path.exists(HEDDLE):
        sys.exit(f"{os.path.basename(sys.argv[0])}: no '{HEDDLE}'; build it or set HEDDLE")
