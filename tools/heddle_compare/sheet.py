"""The contact sheet: references, each followed by its tests above their FLIP maps; a line a scene
and view."""
import numpy as np

from .errors import srgb_from_linear

EDGE = 160   # px, of a tile
TEXT = 12    # px, of a line of label
GAP = 4      # px
COLUMNS = 10 # tiles in a line, or as many as one reference's tests take


def tile(rgb):
    """An sRGB picture fitted into a tile; small ones are enlarged by whole pixels, to be judged."""
    from PIL import Image
    image = Image.fromarray((np.clip(rgb, 0, 1) * 255 + 0.5).astype(np.uint8))
    longest = max(image.size)
    if longest < EDGE:
        factor = EDGE // longest
        return image.resize((image.width * factor, image.height * factor), Image.Resampling.NEAREST)
    return image.resize(
        (max(1, image.width * EDGE // longest), max(1, image.height * EDGE // longest)),
        Image.Resampling.BOX)


def heat(values):
    """FLIP's own colour map, magma."""
    from matplotlib import colormaps
    return colormaps["magma"](np.clip(values, 0, 1))[..., :3]


def places(groups):
    """(line, column) of each group of tiles: a new line for a new scene or view, or where a line is
    full."""
    line, column, before, out = -1, 0, None, []
    for tests in groups:
        wide = 1 + len(tests)
        scene = (tests[0][0]["scene"], tests[0][0]["view"])
        if scene != before or column + wide > max(COLUMNS, wide):
            line, column = line + 1, 0
        out.append((line, column))
        column, before = column + wide, scene
    return out


def draw_group(sheet, draw, left, top, tests):
    """A reference and, to its right, its tests above their FLIP maps."""
    row, reference = tests[0][0], tests[0][1]
    gain = 2.0 ** row["exposure"]
    draw.text((left, top), f"{row['scene']} {row['view']} reference"[:30], fill="white")
    sheet.paste(tile(srgb_from_linear(reference.rgb * gain)), (left, top + 2 * TEXT))
    for i, (row, _, test, flip) in enumerate(tests, 1):
        x = left + i * (EDGE + GAP)
        draw.text((x, top), f"{row['method']} level {row['level']}"[:30], fill="white")
        draw.text((x, top + TEXT),
                  f"FLIP {row['flip']:.3f} x{row['ratio_g']:.2f}",
                  fill=(200, 200, 120))
        sheet.paste(tile(srgb_from_linear(test.rgb * gain)), (x, top + 2 * TEXT))
        sheet.paste(tile(heat(flip)), (x, top + 2 * TEXT + EDGE + GAP))


def write_sheet(path, entries):
    """@param entries  (row, reference Picture, test Picture, FLIP map), in order; tests of one
    reference stand together"""
    from PIL import Image, ImageDraw
    groups = {}
    for entry in entries:
        groups.setdefault(entry[0]["reference"], []).append(entry)
    where = places(groups.values())
    columns = max(column + 1 + len(tests) for (_, column), tests in zip(where, groups.values()))
    wide, tall = EDGE + GAP, 2 * (EDGE + GAP) + 3 * TEXT
    sheet = Image.new("RGB", (columns * wide + GAP, (where[-1][0] + 1) * tall + GAP), (40, 40, 40))
    draw = ImageDraw.Draw(sheet)
    for (line, column), tests in zip(where, groups.values()):
        draw_group(sheet, draw, GAP + column * wide, GAP + line * tall, tests)
    sheet.save(path)
