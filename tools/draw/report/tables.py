"""Tables of all runs, of failed runs, of the cost of each part, and of drifts."""
import math

from . import cost, measures, formatting
from .comparable import representatives
from .comparison import PARTS
from .markup import joined, scrolling, tag
from .method_name import method_name


def number(text, **attributes):
    return tag("td", text, class_="num", **attributes)


def caption(words_):
    """A caption that stays visible when the table scrolls."""
    return tag("caption", tag("span", words_, class_="inner"))


def headed_table(title, cells, rows, label, kind=None):
    """A scrollable table. `cells`: the cells of its head."""
    return scrolling(tag("table", caption(title), tag("thead", tag("tr", *cells)), tag("tbody", *rows), class_=kind),
                     label=label)


def table(title, head, rows, label, kind=None):
    """A scrollable table. `head`: (words, whether the column contains numbers) of each column."""
    cells = [tag("th", text, scope="col", class_="num" if numeric else "word" if k else None)
             for k, (text, numeric) in enumerate(head)]
    return headed_table(title, cells, rows, label, kind)


def status(point):
    return "finished" if point.completed else point.reason or point.status


def _count(point, key):
    return formatting.count(point.counts.get(key, math.nan))


def _run_row(comparison, point, measure):
    near = comparison.is_near_reference(point, measure)
    cells = [formatting.plain_seconds(point.seconds()), formatting.span(point.clocks["wall"]),
             formatting.plain_seconds(point.seconds("cpu")),
             *(_count(point, k) for k in ("steps", "rejected_steps", "newton_iterations")),
             *(formatting.count(point.work[part].count) for part in PARTS), formatting.megabytes(point.peak_memory),
             *(formatting.fixed_exponent(point.drift.get(k, math.nan)) for k in
               ("energy", "linear_momentum", "angular_momentum"))]
    return tag("tr", tag("th", method_name(comparison, point.method), scope="row"),
               number(formatting.control(point.control)), tag("td", status(point), class_="word"),
               number(formatting.fixed_exponent(point.error(measure)), data_e=point.index, data_near=near or None),
               *map(number, cells), class_=None if point.completed else "failed")


RUN_HEAD = ("Wall [s]", "Repeats [s]", "CPU [s]", "Steps", "Rejected", "Newton", "Force", "Tangent", "Factorisation",
            "Solve", "Memory [MB]", "Energy drift", "Linear mom.", "Angular mom.")


def runs_table(comparison, problem):
    measure = measures.primary(comparison)
    head = [("Method", False), ("Control", True), ("Status", False), ("Error", True), *((h, True) for h in RUN_HEAD)]
    rows = [_run_row(comparison, p, measure) for p in comparison.points_of(problem)]
    name = tag("span", measures.label(measure), data_measure_name=True)
    title = joined([f"All runs on {problem.label}. Error: ", name, "; Force to Solve: number of calls; "
                      "drifts: largest, relative. Grey errors are near the reference's own error."])
    return table(title, head, rows, f"All runs on {problem.label}", "long")


def failures_table(comparison):
    failed = [(problem, p) for problem in comparison.problems for p in comparison.failed(problem)]
    if not failed:
        return tag("p", "Every run has finished.")
    rows = [tag("tr", tag("th", method_name(comparison, p.method), scope="row"),
                tag("td", problem.label, class_="word"),
                number(formatting.control(p.control)), tag("td", p.reason or p.status, class_="word"),
                number(_reached(problem, p)), number(formatting.plain_seconds(p.seconds())),
                tag("td", p.message or formatting.UNKNOWN, class_="message")) for problem, p in failed]
    head = (("Method", False), ("Problem", False), ("Control", True), ("Reason", False), ("Reached t [s]", True),
            ("Wall [s]", True), ("Message", False))
    title = f"{formatting.plural(len(failed), 'run')} of {len(comparison.points)} did not finish"
    return table(title, head, rows, "Failures")


def _reached(problem, point):
    reached = formatting.general(point.time_reached)
    return f"{reached} of {formatting.general(problem.end)}" if formatting.known(problem.end) else reached


def cost_table(comparison, problem):
    """Time (s), share and count of each part, for the runs that the bars show."""
    rows, measure = [], measures.primary(comparison)
    for point, _ in representatives(comparison, problem):
        parts, total = cost.parts_of(point), point.seconds()
        cells = [number(_part(seconds, total, point.work.get(part))) for part, seconds in parts.items()]
        rows.append(tag("tr", tag("th", method_name(comparison, point.method), scope="row"),
                        number(formatting.control(point.control)),
                        number(formatting.fixed_exponent(point.error(measure))),
                        number(formatting.plain_seconds(total)), *cells))
    head = [("Method", False), ("Control", True), ("Error", True), ("Wall [s]", True),
            *((name.capitalize(), True) for name in cost.NAMES.values())]
    title = "Seconds, share of the wall time, and number of calls"
    return table(title, head, rows, f"Cost on {problem.label}", "cost")


def _part(seconds, total, work):
    share = f"{100 * seconds / total:.0f}{formatting.THIN}%" if total > 0 else ""
    calls = f", {formatting.count(work.count)}×" if work and formatting.known(work.count) else ""
    return joined([formatting.plain_seconds(seconds), tag("small", (share + calls).removeprefix(", "))])


def drift_table(comparison, problem, runs):
    rows = [tag("tr", tag("th", method_name(comparison, p.method), scope="row"), number(formatting.control(p.control)),
                *(number(formatting.fixed_exponent(p.drift.get(k, math.nan)))
                  for k in ("energy", "linear_momentum", "angular_momentum"))) for p in runs]
    head = (("Method", False), ("Control", True), ("Energy", True), ("Linear momentum", True),
            ("Angular momentum", True))
    return table("Largest relative drift of the runs shown", head, rows, f"Drift on {problem.label}")
