"""Pictures as `heddle render` writes them: linear RGB, transmittance, variance of the pixel
means."""
import contextlib
import dataclasses
import os

import numpy as np


class BadInput(Exception):
    """What the user can mend: one line, `path: what is wrong; what to do`."""


@dataclasses.dataclass
class Picture:
    path: str
    rgb: np.ndarray            # (height, width, 3), linear
    transmittance: np.ndarray  # (height, width), 0 to 1
    # (height, width), of the pixel's mean luminance; zeros where the file has none
    variance: np.ndarray
    samples: np.ndarray        # (height, width), paths; zeros where the file has none

    @property
    def size(self):
        return self.rgb.shape[1], self.rgb.shape[0]


@contextlib.contextmanager
def quiet():
    """Nothing reaches stdout and stderr meanwhile: the OpenEXR library prints by itself what it
    then throws."""
    kept, nowhere = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        for to, old in enumerate(kept, 1):
            os.dup2(old, to)
            os.close(old)
        os.close(nowhere)


def read_channels(path):
    """A dict of float32 arrays (height, width) by channel name.   @throws BadInput"""
    try:
        import OpenEXR
    except ImportError as error:
        raise BadInput(
            "compare: the Python package 'OpenEXR' is missing; pip install OpenEXR") from error
    if not os.path.isfile(path):
        raise BadInput(
            f"{path}: no such file; render it with 'heddle render -o {os.path.basename(path)}'")
    try:
        with quiet(), OpenEXR.File(path, separate_channels=True) as file:
            channels = {
                name: np.array(channel.pixels, np.float32)
                for name, channel in file.channels().items()
            }
    except Exception as error:  # the package throws several kinds
        first = (str(error).splitlines() or ["unreadable"])[0]
        raise BadInput(
            f"{path}: not an OpenEXR picture ({first}); compare takes what 'heddle render' writes"
        ) from error
    return channels


def read_picture(path):
    """@throws BadInput where a file has no R, G, B, no transmittance or A, or numbers that are not
    finite"""
    channels = read_channels(path)
    missing = [name for name in "RGB" if name not in channels]
    if missing:
        found = ", ".join(sorted(channels)) or "none"
        raise BadInput(
            f"{path}: channel '{missing[0]}' is missing, found {found}; compare needs R, G and B")
    rgb = np.stack([channels[name] for name in "RGB"], axis=-1)
    if "transmittance" in channels:
        transmittance = channels["transmittance"]
    elif "A" in channels:
        transmittance = 1.0 - channels["A"]
    else:
        raise BadInput(
            f"{path}: neither 'transmittance' nor 'A' is there; compare needs one to know the object's pixels"
        )
    nothing = np.zeros_like(transmittance)
    for name, values in (("colour", rgb), ("transmittance", transmittance)):
        if not np.isfinite(values).all():
            count = int((~np.isfinite(values)).sum())
            raise BadInput(f"{path}: {count} numbers of its {name} are not finite; render it again")
    return Picture(path, rgb, transmittance, np.nan_to_num(channels.get("variance", nothing)),
                   channels.get("samples", nothing))
