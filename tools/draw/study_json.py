"""Reads the JSON file of a study. Every error message is one line: file and place, what was found, what to do."""
import json
import math
from dataclasses import dataclass

import numpy as np

from .errors import DrawError, unknown
from .series import result_folder


@dataclass(frozen=True)
class StudyKind:
    """A kind of study: its file, the program's command that writes it, and how the file is recognised."""
    file: str  # "sweep.json"
    command: str  # "orthodyn sweep"
    mark: tuple  # (key, value) that the file must have: ("orthodyn_sweep", 1)
    renamed: tuple = ()  # top-level keys of older versions, as (old, new)


class Node:
    """A JSON object with its place in the file, such as `points[3].wall`. Null and missing values are read as "", nan
    or empty."""

    def __init__(self, file, place, value, kind):
        self.file, self.place, self.kind = file, place, kind
        if not isinstance(value, dict):
            raise self.wrong(None, value, "an object {...}")
        self.value = value

    def wrong(self, key, found, wanted):
        place = ".".join(str(part) for part in (self.place, key) if part) or "the file"
        return DrawError(f"{self.file}: {place}: found {json.dumps(found)[:60]}, expected {wanted}; "
                         f"if the file was edited, run `{self.kind.command}` again to restore it")

    def text(self, key, default=""):
        value = self.value.get(key)
        if isinstance(value, (dict, list)):
            raise self.wrong(key, value, "a text")
        return default if value is None else str(value)

    def needed(self, key):
        value = self.text(key)
        if not value:
            raise self.wrong(key, None, "a name")
        return value

    def number(self, key):
        value = self.value.get(key)
        if value is None:
            return math.nan
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.wrong(key, value, "a number")
        return float(value)

    def numbers(self):
        """All numbers of the object, by key."""
        return {key: self.number(key) for key, value in self.value.items() if not isinstance(value, (str, dict, list))}

    def texts(self):
        return {key: self.text(key) for key, value in self.value.items() if value is not None}

    def child(self, key):
        value = self.value.get(key)
        return Node(self.file, f"{self.place}.{key}".lstrip("."), {} if value is None else value, self.kind)

    def list(self, key):
        value = self.value.get(key)
        if value is not None and not isinstance(value, list):
            raise self.wrong(key, value, "a list [...]")
        return value or []

    def children(self, key):
        return [Node(self.file, f"{self.place}.{key}[{k}]".lstrip("."), value, self.kind)
                for k, value in enumerate(self.list(key))]

    def series(self, key):
        try:
            return np.array([math.nan if v is None else v for v in self.list(key)], float)
        except (TypeError, ValueError):
            raise self.wrong(key, self.value[key], "a list of numbers") from None

    def one_of(self, key, known):
        """A text that must be one of `known`."""
        name = self.needed(key)
        if name not in known:
            raise DrawError(f"{self.file}: {self.place}.{key}: {unknown(key, name, known)}")
        return name


def read_study(result, kind):
    """The file of `kind` in the folder `result`, as a Node. Raises DrawError if it is missing, unreadable, of another kind
    or of another version."""
    path = result_folder(result) / kind.file
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise DrawError(f"{path}: missing; `{kind.command} FILE.yaml --out {path.parent}` writes it") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise DrawError(f"{path}: not readable as JSON ({error}); if it is truncated, run `{kind.command}` again") from None
    key, value = kind.mark
    found = content.get(key) if isinstance(content, dict) else None
    if found is None:
        raise DrawError(f"{path}: the key {key} is missing; is it a file written by `{kind.command}`?")
    if found != value:
        raise DrawError(f"{path}: {key} is {json.dumps(found)}, expected {json.dumps(value)}; "
                        "use `draw` and `orthodyn` of the same version")
    for old, new in kind.renamed:
        if old in content and new not in content:
            raise DrawError(f"{path}: has the key '{old}' of an older version of orthodyn, expected '{new}'; "
                            f"run `{kind.command}` again: finished points are kept")
    return Node(path, "", content, kind)


def checked(node, parse):
    """parse(content of the file); a missing key or a wrong type becomes a DrawError."""
    try:
        return parse(node.value)
    except (KeyError, TypeError, AttributeError) as error:
        raise DrawError(f"{node.file}: {error} is missing or has the wrong type; run `{node.kind.command}` again") from None


def about(found, keys):
    """What the page's details say about the study."""
    return {"ranks": found.get("ranks", 1), **{key: found[key] for key in keys}}


def number(value):
    """A JSON number as float; nan for null."""
    return math.nan if value is None else float(value)


def with_unit(title, unit):
    """'deflection [mm]'; the title alone without a unit."""
    return f"{title} [{unit}]" if unit else title
