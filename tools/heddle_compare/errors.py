"""Errors of a picture against its reference.

FLIP is NVIDIA's (`flip-evaluator`): LDR-FLIP at its standard 67 pixels a degree, on exposed colours
clamped to [0, 1] and put through the sRGB curve. LDR and not HDR, because it judges the picture
that is shown: HDR-FLIP takes the worst of several exposures, which it chooses by the reference, so
that its figures are of other pictures than those in the sheet (and the paper's are LDR as well, as
far as it says). The means are over the touched pixels: those where either picture has alpha > 0.
[Fabre26, sec. 5.3: "a mask applied to ignore the background"]
"""
import numpy as np

from .picture import BadInput

TOUCHED = 1e-4  # alpha; a float's rounding of 1 - transmittance is 1e-7, one path of 1024 is 1e-3
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def srgb_from_linear(rgb):
    x = np.clip(rgb, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x,
                    1.055 * np.power(x, 1 / 2.4) - 0.055).astype(np.float32)


def auto_exposure(reference):
    """Stops that bring the 95th percentile of the luminance of the reference's touched pixels to
    .8."""
    values = (reference.rgb @ LUMINANCE)[reference.transmittance < 1 - TOUCHED]
    high = float(np.percentile(values, 95)) if values.size else 0.0
    return float(np.log2(0.8 / high)) if high > 0 else 0.0


def flip_map(reference_rgb, test_rgb):
    """(height, width), 0 to 1, of two linear pictures already exposed.   @throws ImportError
    without flip-evaluator"""
    import flip_evaluator

    return flip_evaluator.evaluate(srgb_from_linear(reference_rgb),
                                   srgb_from_linear(test_rgb),
                                   "LDR",
                                   applyMagma=False)[0][..., 0]


def noise_flip(reference, test, scale, mask):
    """Mean FLIP that the noise of both pictures would make alone: the reference against itself plus
    noise of their variances."""
    deviation = np.sqrt(np.maximum(reference.variance + test.variance, 0.0)) * scale
    if not deviation.any():
        return 0.0
    exposed = reference.rgb * scale
    noise = np.random.default_rng(1).standard_normal(deviation.shape) * deviation
    return float(flip_map(exposed, np.maximum(exposed + noise[..., None], 0.0))[mask].mean())


def noise_transmittance(reference, test, mask):
    """Mean |difference| of transmittance that the paths of both pictures would make alone, if each
    saw all or nothing at random: an upper bound, since samples are stratified. 0 without a channel
    `samples`."""
    t = 0.5 * (reference.transmittance + test.transmittance)
    share = sum(1.0 / np.maximum(p.samples, 1) * (p.samples > 0) for p in (reference, test))
    return float(np.sqrt(2 / np.pi * np.clip(t * (1 - t), 0, 1) * share)[mask].mean())


def check_sizes(reference, test):
    if reference.size != test.size:
        raise BadInput(
            "{}: {} x {} pixels, its reference '{}' has {} x {}; render both with the same --size".
            format(test.path, *test.size, reference.path, *reference.size))


def measure(reference, test, exposure):
    """The errors by name, and the FLIP map. Colour ratios are of sums over the touched pixels;
    `ratio_per_alpha` is of luminance by covered area, which leaves the error of coverage out.
    @throws BadInput where sizes differ or no pixel is touched"""
    check_sizes(reference, test)
    mask = (reference.transmittance < 1 - TOUCHED) | (test.transmittance < 1 - TOUCHED)
    if not mask.any():
        raise BadInput(
            f"{test.path}: no pixel of it or of its reference shows the object; mind the camera")
    scale = 2.0 ** exposure
    a, b = reference.rgb * scale, test.rgb * scale
    flip = flip_map(a, b)
    absolute = np.abs(np.clip(a, 0, 1) - np.clip(b, 0, 1)).mean(axis=-1)
    off = (test.transmittance - reference.transmittance)[mask]
    sums_a, sums_b = a[mask].sum(axis=0, dtype=float), b[mask].sum(axis=0, dtype=float)
    ratio = sums_b / np.where(sums_a > 0, sums_a, np.nan)
    alpha_a, alpha_b = ((1.0 - p.transmittance)[mask].sum(dtype=float) for p in (reference, test))
    light = (sums_b @ LUMINANCE) / max(sums_a @ LUMINANCE, 1e-30)
    return {
        "pixels": int(mask.sum()),
        "exposure": exposure,
        "flip": float(flip[mask].mean()),
        "flip_noise": noise_flip(reference, test, scale, mask),
        "flip_picture": float(flip.mean()),
        "l1": float(absolute[mask].mean()),
        "l1_picture": float(absolute.mean()),
        "transmittance_bias": float(off.mean()),
        "transmittance_mean": float(np.abs(off).mean()),
        "transmittance_p95": float(np.percentile(np.abs(off), 95)),
        "transmittance_noise": noise_transmittance(reference, test, mask),
        "ratio_r": float(ratio[0]),
        "ratio_g": float(ratio[1]),
        "ratio_b": float(ratio[2]),
        "ratio_per_alpha": float(light * alpha_a / alpha_b) if alpha_b > 0 else float("nan"),
    }, flip
