"""Plots of error over level, and of the gain over naive in the form of [Fabre26, fig. 7]."""
from .table import gain, groups, ordered

ERRORS = (("l1", "L1"), ("flip", "FLIP"), ("transmittance_mean", "mean |transmittance error|"))


def axes(rows, columns):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    scenes = list(dict.fromkeys((row["scene"], row["view"]) for row in rows))
    figure, grid = plt.subplots(len(scenes),
                                columns,
                                figsize=(4 * columns, 2.7 * len(scenes)),
                                squeeze=False)
    return plt, figure, grid, scenes


def finish(plt, figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)


def plot_errors(path, rows):
    """A row of panels a scene and view, one a kind of error, one line a method, over level."""
    plt, figure, grid, scenes = axes(rows, len(ERRORS))
    for line, (scene, view) in zip(grid, scenes):
        here = [row for row in rows if (row["scene"], row["view"]) == (scene, view)]
        for panel, (key, name) in zip(line, ERRORS):
            for method in ordered(here, "method"):
                points = [row for row in here if row["method"] == method]
                panel.plot([p["level"] or "-" for p in points], [p[key] for p in points],
                           marker="o",
                           label=method)
            panel.set(title=f"{scene} {view}".strip(), xlabel="level", ylabel=name)
            panel.set_ylim(bottom=0)
            panel.grid(alpha=0.3)
        line[0].legend(fontsize=7)
    finish(plt, figure, path)


def plot_gains(path, rows):
    """Per cent by which each method's error is below naive's, over level as the paper draws it: the
    coarsest on the left. Nothing where no `naive` is among the methods; then False."""
    if "naive" not in ordered(rows, "method"):
        return False
    plt, figure, grid, scenes = axes(rows, 2)
    for line, (scene, view) in zip(grid, scenes):
        here = [row for row in rows if (row["scene"], row["view"]) == (scene, view)]
        cells = [(level, by) for (_, _, level), by in groups(here) if "naive" in by][::-1]
        for panel, (key, name) in zip(line, ERRORS):
            for method in ordered(here, "method"):
                points = [(level, 100 * gain(by["naive"][key], by[method][key]))
                          for level, by in cells if method in by]
                if method != "naive" and points:
                    panel.plot(*zip(*points), marker="o", label=method)
            panel.axhline(0, color="black", linewidth=0.8)
            panel.set(title=f"{scene} {view}".strip(),
                      xlabel="level",
                      ylabel=f"{name}: % better than naive")
            panel.grid(alpha=0.3)
        line[0].legend(fontsize=7)
    finish(plt, figure, path)
    return True
