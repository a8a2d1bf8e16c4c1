"""The contact sheet: a row a reference, then its tests, each above its FLIP map."""
import numpy as np

from .errors import srgb_from_linear

EDGE = 160   # px, of a tile
TEXT = 12    # px, of a line of label
GAP = 4      # px


def tile(rgb):
    """An sRGB picture fitted into a tile; small ones are enlarged by whole pixels, to be judged."""
    from PIL import Image
    image = Image.fromarray((np.clip(rgb, 0, 1) * 255 + 0.5).astype(np.uint8))
    longest = max(image.size)
    if longest < EDGE:
        factor = EDGE // longest
        return image.resize((image.width * factor, image.height * factor), Image.Resampling.NEAREST)
    return image.resize((max(1, image.width * EDGE // longest), max(1, image.height * EDGE // longest)), Image.Resampling.BOX)


def heat(values):
    """FLIP's own colour map, magma."""
    from matplotlib import colormaps
    return colormaps["magma"](np.clip(values, 0, 1))[..., :3]


def write_sheet(path, entries):
    """@param entries  (row, reference Picture, test Picture, FLIP map), in order; tests of one reference stand in one row"""
    from PIL import Image, ImageDraw
    by_reference = {}
    for entry in entries:
        by_reference.setdefault(entry[0]["reference"], []).append(entry)
    columns = 1 + max(len(tests) for tests in by_reference.values())
    wide, tall = EDGE + GAP, 2 * (EDGE + GAP) + 3 * TEXT
    sheet = Image.new("RGB", (columns * wide + GAP, len(by_reference) * tall + GAP), (40, 40, 40))
    draw = ImageDraw.Draw(sheet)
    for j, tests in enumerate(by_reference.values()):
        top = GAP + j * tall
        row, reference, _, _ = tests[0]
        gain = 2.0 ** row["exposure"]
        draw.text((GAP, top), f"{row['scene']} {row['view']} reference"[:30], fill="white")
        sheet.paste(tile(srgb_from_linear(reference.rgb * gain)), (GAP, top + 2 * TEXT))
        for i, (row, _, test, flip) in enumerate(tests, 1):
            left = GAP + i * wide
            draw.text((left, top), f"{row['method']} level {row['level']}"[:30], fill="white")
            draw.text((left, top + TEXT), f"FLIP {row['flip']:.3f} x{row['ratio_g']:.2f}", fill=(200, 200, 120))
            sheet.paste(tile(srgb_from_linear(test.rgb * gain)), (left, top + 2 * TEXT))
            sheet.paste(tile(heat(flip)), (left, top + 2 * TEXT + EDGE + GAP))
    sheet.save(path)
