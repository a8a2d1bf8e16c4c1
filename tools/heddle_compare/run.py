"""Measures jobs and writes what was asked for."""
import os

from . import plot, sheet, table
from .errors import auto_exposure, measure
from .picture import BadInput, read_picture


def compare(jobs, exposure=None):
    """@param exposure  stops; None: by each reference, the same for all of its tests
    @return (row, reference, test, FLIP map) by job; rows as in table.py
    @throws BadInput, all pictures' problems at once"""
    pictures, out, problems = {}, [], []
    for job in jobs:
        try:
            for path in (job.reference, job.test):
                if path not in pictures:
                    pictures[path] = read_picture(path)
            reference, test = pictures[job.reference], pictures[job.test]
            stops = auto_exposure(reference) if exposure is None else exposure
            errors, flip = measure(reference, test, stops)
            row = {"scene": job.scene, "view": job.view, "level": job.level, "method": job.method,
                   "reference": job.reference, "test": job.test, **errors}
            out.append((row, reference, test, flip))
        except BadInput as error:
            problems.append(str(error))
    if problems:
        raise BadInput("\n".join(dict.fromkeys(problems)))
    return out


def write_all(folder, entries):
    """errors.csv, errors.md, sheet.png, errors.png and, with `naive` among the methods,
    gains.png."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise BadInput(
            f"{folder}: {error.strerror.lower()}; name a folder that can be made") from error
    rows = [entry[0] for entry in entries]
    table.write_csv(os.path.join(folder, "errors.csv"), rows)
    with open(os.path.join(folder, "errors.md"), "w") as file:
        file.write("Mean FLIP over touched pixels\n\n" + table.method_table(rows) + "\n" +
                   table.error_table(rows))
    sheet.write_sheet(os.path.join(folder, "sheet.png"), entries)
    plot.plot_errors(os.path.join(folder, "errors.png"), rows)
    plot.plot_gains(os.path.join(folder, "gains.png"), rows)
