"""Shared by the scripts that compare volumes with traced geometry: heddle's command, volumes and
pictures that are made once, scene files, cameras, means, the head of results."""
import argparse
import concurrent.futures
import dataclasses
import hashlib
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


THREADS = None  # of one command; None: as many as it likes


def heddle(*words):
    """Runs heddle with --json and returns its result; if it fails, exits with its message."""
    more = ["--threads", str(THREADS)] if THREADS and words[0] != "info" else []
    done = subprocess.run([HEDDLE, *map(str, words), *more, "--quiet", "--json"],
                          capture_output=True,
                          text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr.strip()}")
    return json.loads(done.stdout)


def made(path, *words, by=None):
    """Makes `path` with heddle unless it exists; the JSON result is kept beside it. With `by` it is
    made again if it was made by something else than `by` says."""
    note = path + ".json"
    if os.path.exists(path) and os.path.exists(note):
        with open(note) as file:
            result = json.load(file)
        if by is None or result.get("made_by") == by:
            return result
    print(f"  {' '.join(map(str, words))}", file=sys.stderr, flush=True)
    result = {**heddle(*words, "-o", path), **({"made_by": by} if by else {})}
    with open(note, "w") as file:
        json.dump(result, file)
    return result


def digest(*words):
    """Twelve digits that tell the words apart from others."""
    return hashlib.sha256("\n".join(map(str, words)).encode()).hexdigest()[:12]


def program_digest():
    """Twelve digits that tell this heddle from another one."""
    with open(HEDDLE, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:12]


def add_options(arguments, name):
    """The options that the scripts which judge transport share."""
    arguments.add_argument("-o",
                           "--output",
                           default=os.path.join(ROOT, "build", name),
                           help="folder of volumes, pictures and tables")
    arguments.add_argument("--heddle", default=HEDDLE, help="the program that is measured")
    arguments.add_argument("--transport", default="auto")
    arguments.add_argument("--quick", action="store_true", help="fewer rows; not to bench/results")
    arguments.add_argument("--keep-volumes",
                           action="store_true",
                           help="takes volumes that another heddle made")
    arguments.add_argument("--threads", type=int, default=os.cpu_count(), help="renders at once")
    arguments.add_argument("--result",
                           help="default: bench/results, with --quick the output folder")


def use_options(a, name):
    """Applies them: the program, one thread a command, the folders, the path of the result."""
    global HEDDLE, THREADS
    HEDDLE, THREADS = os.path.abspath(a.heddle), 1
    need_packages()
    a.output = os.path.abspath(a.output)
    os.makedirs(os.path.join(a.output, "traced"), exist_ok=True)
    a.made_by = None if a.keep_volumes else program_digest()
    a.result = a.result or os.path.join(a.output if a.quick else os.path.join(ROOT, "bench/results"),
                                        f"{name}.md")


def in_parallel(function, items, threads):
    """The results of function(item), in the order of the items; commands run `threads` at once."""
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        return list(pool.map(function, items))


def existing(names, inputs):
    """Those names whose input is there (inputs: path or None by name); says which are not."""
    lost = [n for n in names if inputs[n] and not os.path.exists(inputs[n])]
    for n in lost:
        print(f"  {n}: skipped, no '{os.path.relpath(inputs[n], DATA)}' in the test data",
              file=sys.stderr)
    return [n for n in names if n not in lost]


def runs_inside(points, low, high):
    """The parts of a polyline between two corners, of at least two points."""
    runs, run = [], []
    for p in points:
        if all(a <= x <= b for a, x, b in zip(low, p, high)):
            run.append(p)
            continue
        runs.append(run)
        run = []
    return [r for r in [*runs, run] if len(r) > 1]


@dataclasses.dataclass
class Mean:
    """Means over a picture by covered area: R, G, B, luminance and its standard error; and the
    covered fraction of the picture."""
    color: list
    luminance: float
    error: float
    covered: float


def mean_of(picture):
    """The Mean of a picture's path; no light falls on the background of the scenes here."""
    import numpy as np
    from heddle_compare.errors import LUMINANCE
    from heddle_compare.picture import read_picture
    p = read_picture(picture)
    alpha = float((1.0 - p.transmittance).sum(dtype=float))
    color = p.rgb.sum(axis=(0, 1), dtype=float) / max(alpha, 1e-9)
    error = math.sqrt(float(p.variance.sum(dtype=float))) / max(alpha, 1e-9)
    return Mean([float(x) for x in color], float(np.dot(color, LUMINANCE)), error,
                alpha / p.transmittance.size)


def render_to_error(out, scene, size, more, allowed, pilot, most):
    """Renders until the standard error of the mean luminance is at most allowed(Mean): a pilot
    tells how many samples that takes, up to `most`.   @return Mean"""
    samples = pilot
    while True:
        heddle("render", scene, "-o", out, "--size", size, "--samples", samples, *more)
        mean = mean_of(out)
        excess = mean.error / max(allowed(mean), 1e-12)
        if excess <= 1 or samples >= most:
            return mean
        # a tenth more, as the pilot knows its own error only roughly
        samples = min(most, max(samples + pilot, math.ceil(samples * 1.1 * excess ** 2)))


def kept(path, make):
    """The JSON value of `path`, made by make() if the file is not there."""
    if not os.path.exists(path):
        value = make()
        with open(path, "w") as file:
            json.dump(value, file)
    with open(path) as file:
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


def object_text(volume, geometry, yarn=None, material=None):
    """An object that is its volume and, with --geometry, its geometry; `yarn` is preset and
    radius."""
    text = f"[object.it]\ngeometry = \"{os.path.abspath(geometry)}\"\n"
    text += f"volume = \"{os.path.abspath(volume)}\"\n" if volume else ""
    text += f"yarn = \"{yarn[0]}\"\nyarn_radius = {yarn[1]}\n" if yarn else ""
    return text + (f"materials = {{ \"*\" = \"{material}\" }}\n" if material else "")


def write_text(path, text):
    with open(path, "w") as file:
        file.write(text)
    return path


SKY = [0.35, 0.4, 0.5]  # with SUN the light that heddle gives a scene without any
SUN = [4.0, 3.8, 3.4]
SKY_TEXT = f"[[light]]\nkind = \"constant\"\ncolor = {SKY}\n"


def commit():
    """Of the sources of the program that is measured, or of this script's."""
    for folder in (os.path.dirname(HEDDLE), ROOT):
        done = subprocess.run(["git", "-C", folder, "rev-parse", "--short", "HEAD"],
                              capture_output=True,
                              text=True)
        if done.returncode == 0:
            return done.stdout.strip()
    return "unknown"


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
    """Title, command without the paths that are this machine's own, commit and machine."""
    words = [os.path.relpath(sys.argv[0], ROOT)]
    own = False
    for word in sys.argv[1:]:
        own = own or word in ("-o", "--output", "--heddle", "--result", "--threads")
        if not own:
            words.append(word)
        elif not word.startswith("-"):
            own = False
    return f"# {title}\n\n`{' '.join(words)}`, commit {commit()}, {machine()}. Errors: `tools/heddle_compare/errors.py`.\n\n"


def need_packages():
    try:
        # only checks that they exist
        import flip_evaluator, matplotlib, numpy, OpenEXR, PIL  # noqa: F401, E401
    except ImportError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: the Python package '{error.name}' is missing; "
                 "pip install -r tools/heddle_compare/requirements.txt")
    if not os.path.exists(HEDDLE):
        sys.exit(f"{os.path.basename(sys.argv[0])}: no '{HEDDLE}'; build it or set HEDDLE")
