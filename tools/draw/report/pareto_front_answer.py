"""The answer of a comparison across meshes: the fastest run for each error, and the Pareto front."""
import math

from . import formatting, measures
from .markup import joined, tag
from .tables import headed_table

MAIN_TARGET = 0.01
MEANING = ("An error is the distance of the probes from those of a far more accurate solution on a finer mesh, as a "
           "share of the largest motion: it is made by the mesh and by the integration together. rtol is the tolerance "
           "that a method with error control was asked to keep in each step.")


def _headline(comparison, front):
    """Sentence with the fastest run for the target error nearest to 1 %."""
    if not front.answers:
        return tag("p", f"{front.label}: no error is resolved, so nothing is concluded.", class_="headline")
    _, _, words = min(front.answers, key=lambda answer: abs(math.log10(answer[0] / MAIN_TARGET)))
    words = f"{front.label}, {words}" if len(comparison.pareto_fronts) > 1 else words[0].upper() + words[1:]
    return tag("p", f"{words}.", class_="headline")


def _row(comparison, point, measure):
    problem = comparison.problem(point.problem)
    reach = problem.reference.reach(measure)
    error = formatting.exponent(point.error(measure))
    if comparison.is_near_reference(point, measure):
        error = f"below {formatting.exponent(reach)}"
    method = comparison.methods[comparison.method_index(point.method)].label
    cells = (formatting.control(point.control), formatting.count(problem.unknowns), error,
             formatting.seconds(point.seconds("cpu")))
    return tag("tr", tag("th", problem.mesh, scope="row"), tag("td", method),
               *(tag("td", cell, class_="num") for cell in cells))


def _table(comparison, front, measure):
    rows = [_row(comparison, comparison.points[k], measure) for k in front.points]
    if not rows:
        return None
    head = [*(tag("th", h, scope="col") for h in ("Mesh", "Method")),
            *(tag("th", h, scope="col", class_="num") for h in ("Control", "Unknowns", "Error", "CPU"))]
    title = ("The Pareto front: runs that no other run beats in both error and CPU time. "
             f"Error: {measures.label(measure)}, of the probes.")
    return headed_table(title, head, rows, f"Pareto front of {front.label}", "small")


def _own_error(reference, measure):
    if not reference.has_own_mesh:
        return "The reference's own mesh error is not known."
    return (f"The reference, with {formatting.count(reference.unknowns)} unknowns, is itself off by its mesh, by about "
            f"{formatting.exponent(reference.mesh_error)} (estimated), and in time by "
            f"{formatting.exponent(reference.errors.get(measure))}; errors below "
            f"{formatting.exponent(reference.reach(measure))} are not resolved.")


def _section(comparison, front):
    measure, problems = measures.primary(comparison), [comparison.problem(p) for p in front.problems]
    sizes = [p.unknowns for p in problems]
    size = f"{len(sizes)} meshes, {formatting.count(min(sizes))} to {formatting.count(max(sizes))} unknowns"
    answers = tag("ul", *(tag("li", f"{words}.") for _, _, words in front.answers)) if front.answers else None
    sentence = tag("p", problems[0].sentence, class_="scene") if problems[0].sentence else None
    return tag("div", tag("h3", front.label, " ", tag("small", size)), sentence, answers,
               _table(comparison, front, measure),
               tag("p", _own_error(problems[0].reference, measure), class_="scene"), class_="problem")


def pareto_front_answer(comparison):
    return joined([*(_headline(comparison, front) for front in comparison.pareto_fronts), tag("p", MEANING, class_="scene"),
                   *(_section(comparison, front) for front in comparison.pareto_fronts)])
