"""compare.json -> Comparison; what is wrong in the file becomes one line with its place."""
import json
import math

import numpy as np

from ..errors import DrawError, unknown
from ..series import result_folder
from . import measures
from .comparison import (PARTS, Answer, Comparison, Control, Front, Method, Order, Point, Problem, Reference,
                         Spread, Work)

FORMAT = 1
FILE = "compare.json"


class Node:
    """An object of the file with its place, `points[3].wall`; null and missing keys read as unknown."""
    command = "orthodyn compare"  # writes the file

    def __init__(self, file, place, value):
        self.file, self.place = file, place
        if not isinstance(value, dict):
            raise self.wrong(None, value, "an object {...}")
        self.value = value

    def wrong(self, key, found, wanted):
        place = ".".join(str(part) for part in (self.place, key) if part) or "the file"
        return DrawError(f"{self.file}: {place}: found {json.dumps(found)[:60]} where {wanted} belongs; "
                         f"was it changed by hand? `{self.command}` writes it anew")

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
        """All values that are numbers, by key."""
        return {key: self.number(key) for key, value in self.value.items() if not isinstance(value, (str, dict, list))}

    def texts(self):
        return {key: self.text(key) for key, value in self.value.items() if value is not None}

    def child(self, key):
        value = self.value.get(key)
        return type(self)(self.file, f"{self.place}.{key}".lstrip("."), {} if value is None else value)

    def list(self, key):
        value = self.value.get(key)
        if value is not None and not isinstance(value, list):
            raise self.wrong(key, value, "a list [...]")
        return value or []

    def children(self, key):
        return [type(self)(self.file, f"{self.place}.{key}[{k}]".lstrip("."), value)
                for k, value in enumerate(self.list(key))]

    def series(self, key):
        try:
            return np.array([math.nan if v is None else v for v in self.list(key)], float)
        except (TypeError, ValueError):
            raise self.wrong(key, self.value[key], "a list of numbers") from None

    def one_of(self, key, known):
        """A name that must be among `known`."""
        name = self.needed(key)
        if name not in known:
            raise DrawError(f"{self.file}: {self.place}.{key}: {unknown(key, name, known)}")
        return name


def _errors(node):
    """{"displacement": {"l2": x}, "phase": y} as {"displacement.l2": x, "phase": y}."""
    flat = {"phase": node.number("phase")} if "phase" in node.value else {}
    for name in ("displacement", "velocity"):
        flat.update({f"{name}.{kind}": x for kind, x in node.child(name).numbers().items()})
    for group in ("probes", "quantities"):
        named = node.child(group)
        for name in named.value:
            flat.update({f"{group}.{name}.{kind}": x for kind, x in named.child(name).numbers().items()})
    return flat


def _drifts(node):
    """Drifts are measures of a run like its errors, and need no reference."""
    return {f"{measures.DRIFT}{name}": x for name, x in node.numbers().items()}


def _reference(node):
    return Reference(node.text("kind", "none"), node.text("method"), node.text("check"), node.number("seconds"),
                     node.text("message"), _errors(node.child("errors")), node.number("mesh_error"),
                     node.number("unknowns"), node.text("folder"), node.number("shared_mesh_error"))


def _problem(node):
    scales, time = node.child("scales"), node.child("time")
    name = node.needed("id")
    return Problem(name, node.text("label", name), node.text("scene"), node.child("set").texts(),
                   node.text("sentence"), *map(node.number, ("unknowns", "elements", "nodes")), time.number("start"),
                   time.number("end"), scales.numbers(), scales.text("words"), node.child("probe_scales").numbers(),
                   node.child("quantity_scales").numbers(),
                   node.number("dominant_frequency"), _reference(node.child("reference")), node.text("mesh", name))


def _method(node):
    name = node.needed("id")
    return Method(name, node.text("label", name), node.text("integrator"), node.text("sentence"),
                  node.child("set").texts(), node.text("control"))


def _spread(node):
    return Spread(node.number("median"), node.number("min"), node.number("max"))


def _point(index, node, problems, methods):
    control, statistics, drift = node.child("control"), node.child("statistics"), node.child("drift_over_time")
    times, energy = drift.series("t"), drift.series("energy")
    if len(times) != len(energy):
        raise drift.wrong("energy", len(energy), f"a list of {len(times)} numbers, as in t,")
    works = {part: statistics.child(part) for part in PARTS}
    return Point(
        index, node.one_of("problem", problems), node.one_of("method", methods),
        Control(control.text("kind"), control.number("value")), node.text("status", "failed"), node.text("reason"),
        node.text("message"), node.number("time_reached"), node.number("repeats"),
        {clock: _spread(node.child(clock)) for clock in ("wall", "cpu")}, statistics.numbers(),
        {part: Work(n.number("count"), n.number("seconds")) for part, n in works.items()},
        node.number("peak_memory_bytes"), node.number("factor_bytes"),
        {**_errors(node.child("errors")), **_drifts(node.child("drift"))},
        {str(key) for key in node.list("near_reference")}, node.child("drift").numbers(), times, energy,
        node.number("smallest_det_f"), node.child("decisions").texts(), node.text("scene"))


def _answer(node, problems, methods):
    entries = [(e.one_of("method", methods), e) for e in node.children("methods")]
    return Answer(node.one_of("problem", problems), node.text("error"), node.number("target"),
                  {name: e.number("seconds") for name, e in entries},
                  {name: e.number("best_error") for name, e in entries})


def _front(node, problems, points):
    def indices(values, key):
        for value in values:
            if not isinstance(value, int) or not 0 <= value < points:
                raise node.wrong(key, value, f"the index of one of {points} points")
        return values
    members = node.list("problems")
    for name in members:
        if name not in problems:
            raise node.wrong("problems", name, "the id of a problem")
    answers = [(n.number("target"), n.value.get("point"), n.text("words")) for n in node.children("answers")]
    indices([point for _, point, _ in answers], "answers")
    return Front(node.text("id"), node.text("label"), members, indices(node.list("points"), "points"), answers)


def _parsed(path):
    """The file's JSON, checked to be a comparison that this program can read."""
    if not path.is_file():
        raise DrawError(f"{path}: missing; `orthodyn compare FILE.yaml --out {path.parent}` writes it")
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise DrawError(f"{path}: not readable as JSON ({error}); if it is cut off, let `orthodyn compare` finish "
                        "or run it again") from None
    found = content.get("orthodyn_comparison") if isinstance(content, dict) else None
    if found is None:
        raise DrawError(f"{path}: no comparison, the key orthodyn_comparison is missing; "
                        "give the folder that `orthodyn compare` wrote")
    if found != FORMAT:
        raise DrawError(f"{path}: written in format {json.dumps(found)}, readable is format {FORMAT}; "
                        "use the `draw` and the `orthodyn` of one version")
    return content


def read_comparison(folder):
    path = result_folder(folder) / FILE
    node = Node(path, "", _parsed(path))
    problems = [_problem(n) for n in node.children("problems")]
    methods = [_method(n) for n in node.children("methods")]
    ids, names = [p.id for p in problems], [m.id for m in methods]
    points = [_point(k, n, ids, names) for k, n in enumerate(node.children("points"))]
    ended = {p.method for p in points if p.completed}
    methods.sort(key=lambda m: m.id not in ended)  # what never came to an end stands last everywhere
    return Comparison(
        node.text("name", path.parent.name), node.text("title"), node.text("description"), node.text("file"),
        node.text("started"), node.value.get("complete") is True, node.number("planned_points"),
        *(node.child(key).texts() for key in ("machine", "versions", "settings")), problems, methods, points,
        [_answer(n, ids, names) for n in node.children("answers")],
        [Order(n.text("problem"), n.text("method"), n.text("error"), n.number("slope"))
         for n in node.children("orders")],
        [_front(n, ids, len(node.list("points"))) for n in node.children("fronts")])
