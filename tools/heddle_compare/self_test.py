"""Checks of tools/compare on small pictures made here: known errors must come out, bad input must
be one line."""
import os
import subprocess
import sys
import tempfile

import numpy as np

from . import errors, jobs, run
from .picture import BadInput

SIZE = 32


def write(path, rgb, transmittance, **more):
    import OpenEXR
    channels = {
        "R": rgb[..., 0], "G": rgb[..., 1], "B": rgb[..., 2], "transmittance": transmittance, **more
    }
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {k: np.ascontiguousarray(v, np.float32)
                          for k, v in channels.items()}).write(path)


def disc():
    """A grey disc with stripes before black; its transmittance is 0 inside."""
    y, x = np.mgrid[:SIZE, :SIZE] - (SIZE - 1) / 2
    inside = x * x + y * y < (SIZE / 3) ** 2
    rgb = (np.where(inside, 0.3 + 0.2 * np.sin(x), 0.0)[..., None] *
           [1.0, 0.8, 0.6]).astype(np.float32)
    return rgb, np.where(inside, 0.0, 1.0).astype(np.float32)


def of_two(folder, change_rgb, change_transmittance, **more):
    rgb, t = disc()
    a, b = os.path.join(folder, "a.exr"), os.path.join(folder, "b.exr")
    write(a, rgb, t)
    write(b, change_rgb(rgb, t), change_transmittance(t), **more)
    return run.compare([jobs.Job(a, b, "disc", "1", "x")], 0.0)[0][0]


def equal_pictures_have_no_error(folder):
    row = of_two(folder, lambda c, t: c, lambda t: t)
    assert row["flip"] == row["l1"] == row["transmittance_mean"] == 0 and row["ratio_r"] == 1, row


def a_brighter_picture_has_its_ratio_and_l1(folder):
    row = of_two(folder, lambda c, t: c * [1.2, 1.1, 1.0], lambda t: t)
    rgb, t = disc()
    asked = (rgb[t < 1] * [0.2, 0.1, 0.0]).mean()
    assert abs(row["ratio_r"] - 1.2) < 1e-5 and abs(row["ratio_b"] - 1) < 1e-5, row
    assert abs(row["l1"] - asked) < 1e-6 and abs(row["l1_picture"] - asked *
                                                 (t < 1).mean()) < 1e-6, (row, asked)
    assert row["flip"] > row["flip_picture"] > 0, row


def transmittance_is_taken_over_pixels_that_either_touches(folder):
    row = of_two(folder, lambda c, t: c, lambda t: np.where(t < 1, 0.25, 1.0))
    assert abs(row["transmittance_bias"] - 0.25) < 1e-6 and abs(row["transmittance_p95"] -
                                                                0.25) < 1e-6, row
    assert abs(row["ratio_per_alpha"] - 1 / 0.75) < 1e-5, row
    row = of_two(folder, lambda c, t: c, lambda t: np.full_like(t, 0.5))
    assert row["pixels"] == SIZE * SIZE, row


def noise_of_the_variance_channel_is_what_noise_costs(folder):
    sigma, draw = 0.1, np.random.default_rng(7)
    row = of_two(folder,
                 lambda c, t: np.maximum(
                     c + sigma * draw.standard_normal(t.shape)[..., None] * (t < 1)[..., None], 0),
                 lambda t: t,
                 variance=np.where(disc()[1] < 1, sigma**2, 0))
    assert 0.65 < row["flip_noise"] / row["flip"] < 1.5, row  # FLIP blurs: few independent pixels


def exposure_brings_the_bright_part_to_point_eight(folder):
    rgb, t = disc()
    write(os.path.join(folder, "a.exr"), rgb * 1000, t)
    row = run.compare(
        [jobs.Job(os.path.join(folder, "a.exr"), os.path.join(folder, "a.exr"), "", "", "")])[0][0]
    high = np.percentile((rgb @ errors.LUMINANCE)[t < 1] * 1000, 95) * 2 ** row["exposure"]
    assert abs(high - 0.8) < 1e-3, (high, row)


def all_is_written(folder):
    rgb, t = disc()
    names = {name: os.path.join(folder, name + ".exr") for name in ("ref", "naive", "moments")}
    for name, factor in (("ref", 1.0), ("naive", 1.5), ("moments", 1.1)):
        write(names[name], rgb * factor, t)
    tests = [
        jobs.job_from_words(names["ref"], f"disc/1/{name}={names[name]}")
        for name in ("naive", "moments")
    ]
    run.write_all(os.path.join(folder, "out"), run.compare(tests))
    assert sorted(os.listdir(os.path.join(
        folder, "out"))) == ["errors.csv", "errors.md", "errors.png", "gains.png", "sheet.png"]


def bad_input_is_one_clear_line(folder):
    rgb, t = disc()
    good, path = os.path.join(folder, "good.exr"), os.path.join(folder, "bad.exr")
    write(good, rgb, t)
    with open(good, "rb") as file:
        half = file.read()[:700]

    def with_text(name, text):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
        return [os.path.join(folder, name)]

    for words, write_it in (
        ([good,
          os.path.join(folder,
                       "none.exr")], lambda: None), ([good,
                                                      path], lambda: write(path, rgb[:16], t[:16])),
        ([good, path], lambda: write(path, rgb * np.nan, t)),
        ([good,
          path], lambda: open(path, "wb").write(half)), ([good,
                                                          path], lambda: open(path, "wb").close()),
        ([path,
          path], lambda: write(path, rgb * 0, t * 0 + 1)), ([good,
                                                             "a/b=" + good], lambda: None),
        (with_text("a.json",
                   "[1"), lambda: None), (with_text("b.json",
                                                    '[{"reference": "x.exr"}]'), lambda: None),
        (with_text("c.toml", "[[picture]]\nreference = 'good.exr'\ntest = 'good.exr'\nmthod = 'x'"),
         lambda: None), (with_text("d.json", '"x"'), lambda: None)):
        write_it()
        tool = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "compare")
        done = subprocess.run([sys.executable, tool, *words], capture_output=True, text=True)
        assert done.returncode == 3 and done.stderr.count("\n") == 1 and "; " in done.stderr, (
            words, done)


def run_all():
    """Prints one line a check; 0 where all hold, else 1."""
    failed = 0
    for check in (equal_pictures_have_no_error, a_brighter_picture_has_its_ratio_and_l1,
                  transmittance_is_taken_over_pixels_that_either_touches,
                  noise_of_the_variance_channel_is_what_noise_costs,
                  exposure_brings_the_bright_part_to_point_eight, all_is_written,
                  bad_input_is_one_clear_line):
        with tempfile.TemporaryDirectory() as folder:
            try:
                check(folder)
                print(f"ok      {check.__name__}")
            except (AssertionError, BadInput) as error:
                failed += 1
                print(f"failed  {check.__name__}: {error}")
    return 1 if failed else 0
