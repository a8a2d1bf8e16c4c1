"""What to compare: picture files named on the command line, or a list in .json or .toml."""
import dataclasses
import json
import os
import tomllib

from .picture import BadInput

KEYS = ("reference", "test", "scene", "level", "method", "view")


@dataclasses.dataclass
class Job:
    """One test picture. What is compared among methods and levels shares scene and view."""
    reference: str
    test: str
    scene: str
    level: str
    method: str
    view: str = ""

    @property
    def label(self):
        return " ".join(x for x in (self.scene, self.view,
                                    f"level {self.level}" if self.level else "", self.method) if x)


def job_from_words(reference, word):
    """`PATH` or `SCENE/LEVEL/METHOD=PATH`; without a label the scene is the reference's name, the
    method the test's."""
    label, equals, path = word.partition("=")
    if not equals:
        return Job(reference, word, stem(reference), "", stem(word))
    parts = label.split("/")
    if len(parts) != 3:
        raise BadInput(
            f"compare: label '{label}' has {len(parts)} parts, 3 are needed; write SCENE/LEVEL/METHOD=FILE"
        )
    return Job(reference, path, *parts)


def stem(path):
    return os.path.splitext(os.path.basename(path))[0]


def read_jobs(path):
    """A list file: `picture` (TOML: [[picture]]; JSON: that key, or a bare list) of tables with
    reference, test, scene, level, method and maybe view; paths relative to the file.   @throws
    BadInput, one line for each problem"""
    try:
        with open(path, "rb") as file:
            data = tomllib.load(file) if path.endswith(".toml") else json.load(file)
    except OSError as error:
        raise BadInput(
            f"{path}: {error.strerror.lower()}; name a list in .json or .toml") from error
    except ValueError as error:  # of both parsers
        raise BadInput(f"{path}: {error}; it must be JSON or TOML") from error
    rows = data if isinstance(data,
                              list) else data.get("picture") if isinstance(data, dict) else None
    if not isinstance(rows, list) or not rows:
        raise BadInput(
            f"{path}: no pictures in it; write a list 'picture' of tables with {', '.join(KEYS)}")
    problems, out = [], []
    for i, row in enumerate(rows):
        if not isinstance(row, dict):
            problems.append(f"{path}: picture {i} is no table; write {', '.join(KEYS)}")
            continue
        problems += [
            f"{path}: picture {i} has an unknown key '{key}'; known: {', '.join(KEYS)}"
            for key in row if key not in KEYS
        ]
        missing = [key for key in KEYS[:2] if not isinstance(row.get(key), str)]
        problems += [f"{path}: picture {i} has no '{key}'; give a path" for key in missing]
        if not missing:
            folder = os.path.dirname(path)
            reference, test = (os.path.join(folder, row[key]) for key in KEYS[:2])
            out.append(
                Job(reference, test, str(row.get("scene", stem(reference))),
                    str(row.get("level", "")), str(row.get("method", stem(test))),
                    str(row.get("view", ""))))
    if problems:
        raise BadInput("\n".join(problems))
    return out
