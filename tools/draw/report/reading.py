"""compare.json as a Comparison."""
from ..study_json import StudyKind, read_study
from . import measures
from .comparison import (PARTS, Answer, Comparison, Control, Method, Order, ParetoFront, Point, Problem, Reference,
                         Spread, Work)

KIND = StudyKind("compare.json", "orthodyn compare", ("orthodyn_comparison", 1), (("fronts", "pareto_fronts"),))


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
    """The drifts, with keys like those of errors: they are reported like errors but need no reference."""
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


def _pareto_front(node, problems, points):
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
    return ParetoFront(node.text("id"), node.text("label"), members, indices(node.list("points"), "points"), answers)


def read_comparison(folder):
    node = read_study(folder, KIND)
    problems = [_problem(n) for n in node.children("problems")]
    methods = [_method(n) for n in node.children("methods")]
    ids, names = [p.id for p in problems], [m.id for m in methods]
    points = [_point(k, n, ids, names) for k, n in enumerate(node.children("points"))]
    ended = {p.method for p in points if p.completed}
    methods.sort(key=lambda m: m.id not in ended)  # methods without a finished run last
    return Comparison(
        node.text("name", node.file.parent.name), node.text("title"), node.text("description"), node.text("file"),
        node.text("started"), node.value.get("complete") is True, node.number("planned_points"),
        *(node.child(key).texts() for key in ("machine", "versions", "settings")), problems, methods, points,
        [_answer(n, ids, names) for n in node.children("answers")],
        [Order(n.text("problem"), n.text("method"), n.text("error"), n.number("slope"))
         for n in node.children("orders")],
        [_pareto_front(n, ids, len(node.list("points"))) for n in node.children("pareto_fronts")])
