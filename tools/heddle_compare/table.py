"""CSV and markdown of measured jobs. A row is a dict: scene, view, level, method, reference, test
and the errors."""
import csv

COLUMNS = ("scene", "view", "level", "method", "flip", "flip_noise", "flip_picture", "l1",
           "l1_picture", "transmittance_bias", "transmittance_mean", "transmittance_p95",
           "transmittance_noise", "ratio_r", "ratio_g", "ratio_b", "ratio_per_alpha", "pixels",
           "exposure", "reference", "test")


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, extrasaction="ignore")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


def markdown(header, rows):
    """A markdown table of words."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(x) for x in row) + " |" for row in rows]) + "\n"


def ordered(rows, key):
    """Different values in the order of the rows."""
    return list(dict.fromkeys(row[key] for row in rows))


def groups(rows):
    """((scene, view, level), {method: row}) in the order of the rows."""
    out = {}
    for row in rows:
        out.setdefault((row["scene"], row["view"], row["level"]), {})[row["method"]] = row
    return out.items()


def gain(naive, other):
    """Relative improvement against naive: 1 - other / naive   [Fabre26, fig. 7]"""
    return 1.0 - other / naive if naive > 0 else float("nan")


def error_table(rows):
    """All errors, a row a picture."""
    header = ("scene", "view", "level", "method", "FLIP", "noise", "L1", "T bias", "T mean abs",
              "p95", "noise", "R", "G", "B", "per alpha", "pixels")
    keys = ("flip", "flip_noise", "l1", "transmittance_bias", "transmittance_mean",
            "transmittance_p95", "transmittance_noise", "ratio_r", "ratio_g", "ratio_b",
            "ratio_per_alpha")
    body = []
    for row in rows:
        words = [
            f"{row[k]:+.4f}" if k == "transmittance_bias" else
            f"{row[k]:.3f}" if k.startswith("ratio") else f"{row[k]:.4f}" for k in keys
        ]
        body.append([row["scene"], row["view"], row["level"], row["method"], *words, row["pixels"]])
    return markdown(header, body)


def method_table(rows, error="flip"):
    """The form of table 2 of [Fabre26]: a row a scene and level, a column a method."""
    methods = ordered(rows, "method")
    body = []
    for (scene, view, level), by_method in groups(rows):
        values = [f"{by_method[m][error]:.4f}" if m in by_method else "-" for m in methods]
        body.append([f"{scene} {view}".strip(), level, *values])
    return markdown(["scene", "level", *methods], body)
