"""The page of a comparison: one HTML file that opens offline."""
from . import answer, details, measures, tables, formatting
from .document import document, header, not_finished, run_data, section, when
from .drift import drift_runs
from .figures import CLOCKS, Figures
from .markup import joined, tag, void
from .method_name import glyphs
from .tooltips import tooltip

BUDGET = 2_700_000  # characters of the page, beyond which variants of figures are left out

READ = {
    "wp": "One marker is one run, one line one method from loose to tight control; lower left is better: less error in "
          "less time. Hollow markers are near the reference's own error. Crosses above are runs that failed, at the "
          "time they took (at the left edge where it is not known). Thin horizontal lines span the repeats.",
    "tol": "How the error follows what was asked for. The slope is the order observed in log-log; a method that keeps "
           "its promise has slope 1 against a tolerance, and its order against a step.",
    "cost": "For each method the cheapest run whose error is below the target, or its most accurate run if none is "
            "(pale, and cut off where it is longer than the others). Rest is wall time minus the parts that were "
            "measured.",
    "drift": "Change of the energy balance since the start, in magnitude, at one tolerance for all methods. A method "
             "that was not run at it, or has a step instead, is named with its own control; of those with a step it is "
             "the run in the cost breakdown.",
}


READ_PARETO_FRONT = (
    "One marker is one run, one line one method on one mesh from loose to tight control; lower left is better. A colour is a "
    "mesh, a marker a method. The broad grey line is the Pareto front: runs that no other run beats in both error and time. "
    "Where a line is level, the mesh error remains. Hollow markers are within reach of the reference's own error.")


def _counted(comparison):
    finished = sum(p.completed for p in comparison.points)
    failed = len(comparison.points) - finished
    parts = [formatting.plural(len(comparison.methods), "method"),
             formatting.plural(len(comparison.problems), "problem"),
             formatting.plural(len(comparison.points), "run") + (f" ({failed} failed)" if failed else "")]
    machine = comparison.machine.get("processor", "")
    cores = comparison.machine.get("cores")
    where = machine + (f", {cores} cores" if machine and cores else "")
    return parts + [part for part in (when(comparison.started), where) if part]


def _banner(comparison):
    if comparison.complete:
        return None
    planned = f" of {formatting.count(comparison.planned)}" if formatting.known(comparison.planned) else ""
    return not_finished(f"{len(comparison.points)}{planned} points. What follows covers the points so far.")


LINKS = (("answer", "Fastest"), ("precision", "Work and precision"), ("tolerance", "Tolerance"), ("cost", "Cost"),
         ("drift", "Drift"), ("runs", "Runs"), ("details", "Details"))


def _choosers(offered, group, with_clock=True):
    """Selectors of error measure and clock. They are hidden if scripts are disabled."""
    found = list(dict.fromkeys(measure for measure, _ in offered))
    clocks = list(dict.fromkeys(clock for _, clock in offered)) if with_clock else []
    parts = []
    if len(found) > 1:
        options = (tag("option", measures.label(m), value=m) for m in found)
        select = tag("select", *options, data_pick="measure", autocomplete="off")
        parts.append(tag("label", "Error measured as ", select))
    if len(clocks) > 1:
        radios = (tag("label", void("input", type="radio", name=f"clock-{group}", value=c, data_pick="clock",
                                    checked=c == clocks[0], autocomplete="off"), tag("span", CLOCKS[c]))
                  for c in clocks)
        parts.append(tag("fieldset", tag("legend", "Time", class_="unseen"), *radios))
    return tag("div", *parts, class_="choosers js") if parts else None


def _pareto_fronts(comparison, figures, variants, first):
    """A figure for each Pareto front."""
    parts = []
    for k, front in enumerate(comparison.pareto_fronts):
        stage = tag("div", figures.pareto_front(front, *first), class_="stage")
        title = tag("h3", front.label) if len(comparison.pareto_fronts) > 1 else None
        figure = tag("figure", stage, *variants.get(("front", front.id), ()),
                     tag("figcaption", READ_PARETO_FRONT) if not k else None, data_kind="wp", data_measure=first[0],
                     data_clock=first[1], aria_label=front.label)
        parts.append(tag("div", title, figure, class_="problem"))
    return joined(parts)


def _figure(comparison, problem, kind, picture, variants=(), first=None):
    """A figure with its variants; `first`: the (measure, clock) shown."""
    if picture is None:
        return None
    measure, clock = first or (None, None)
    explained = problem is comparison.problems[0]  # each kind of figure is explained once
    stage = tag("div", picture, class_="stage")
    return tag("figure", stage, *variants, tag("figcaption", READ[kind]) if explained else None, data_kind=kind,
               data_measure=measure, data_clock=clock if kind == "wp" else None,
               aria_label=f"{problem.label}")


def _each(comparison, content):
    """`content(problem)` of each problem, below its name if there are several problems."""
    parts = []
    for problem in comparison.problems:
        found = content(problem) or tag("p", "Nothing to show: no finished run has it.", class_="empty")
        title = tag("h3", problem.label) if len(comparison.problems) > 1 else None
        parts.append(tag("div", title, found, class_="problem"))
    return joined(parts) or tag("p", "The comparison names no problem.", class_="empty")


def _cost(comparison, figures, problem):
    picture = figures.cost(problem)
    return picture and joined([_figure(comparison, problem, "cost", picture), tables.cost_table(comparison, problem)])


def _drift(comparison, figures, problem):
    picture, runs = figures.drift(problem), drift_runs(comparison, problem)
    return picture and joined([_figure(comparison, problem, "drift", picture),
                               tables.drift_table(comparison, problem, runs)])


def _after(comparison, figures, folder):
    """The sections that have no variants."""
    return joined([
        section("cost", "Where the time goes", _each(comparison, lambda p: _cost(comparison, figures, p))),
        section("drift", "Energy drift", _each(comparison, lambda p: _drift(comparison, figures, p))),
        section("runs", "All runs", _each(comparison, lambda p: tables.runs_table(comparison, p)),
                 tag("h3", "Failures"), tables.failures_table(comparison)),
        section("details", "How this was measured", tag("h3", "What an error is"), details.definitions(comparison),
                 tag("h3", "Methods"), details.methods_table(comparison),
                 *(details.problem_details(p) for p in comparison.problems), details.provenance(comparison, folder))])


def page(comparison, folder, view=None):
    """The page as HTML. `folder`: for the command that reproduces the comparison; `view`: file of the 3D view, or
    None."""
    figures = Figures(comparison)
    first = figures.choices()[0]
    shown = {p.id: (None if comparison.pareto_fronts else figures.work_precision(p), figures.tolerance(p))
             for p in comparison.problems}
    after = _after(comparison, figures, folder)
    runs = run_data([tooltip(comparison, p) for p in comparison.points], *first,
                    {m: measures.label(m) for m in measures.present(comparison.points)})
    base = len(after) + len(runs) + sum(len(a or "") + len(b) for a, b in shown.values()) + 100_000
    variants, offered = figures.variants(BUDGET - base)

    def pictures(kind, which):
        return _each(comparison, lambda p: _figure(comparison, p, kind, shown[p.id][which],
                                                   variants.get((kind, p.id), ()), first))

    sections = (section("answer", "The fastest at each error", answer.answer_section(comparison)),
                section("precision", "Work and precision", _choosers(offered, "wp"),
                        _pareto_fronts(comparison, figures, variants, first) if comparison.pareto_fronts
                        else pictures("wp", 0)),
                section("tolerance", "Error against tolerance and step", _choosers(offered, "tol", False),
                        pictures("tol", 1)), after)
    title = comparison.title or comparison.name
    top = header(title, _counted(comparison), LINKS, comparison.description, _banner(comparison), view)
    return document(title, figures.styles.css(), top, sections, runs, glyphs(comparison))
