"""The page of a convergence study: one HTML file that opens offline."""
import math
import shlex

from ..report import formatting
from ..report.details import command, pairs
from ..report.document import document, header, run_data, section, when
from ..report.markup import joined, tag
from ..report.tables import headed_table, number
from .figures import Figures, words

READ = ("Marks are meshes, each twice as fine as the one before; strokes are errors of the same mesh as it "
        "estimates them itself. Lower left is better. The dashed line is an error of one per cent; hollow marks are below "
        "the uncertainty of the limit.")


def _cheaper(metric, study):
    """'quadratic elements by 12 ×', or the only elements that reach the target."""
    costs = {o: c for o, c in metric.cost_of_target.items() if math.isfinite(c) and c > 0}
    if not costs:
        return f"none reaches {100 * study.target:g} %"
    best, worst = min(costs, key=costs.get), max(costs, key=costs.get)
    others = [words(o) for o in study.orders if o not in costs]
    if others:
        return f"{words(best)} elements; {others[0]} ones do not reach {100 * study.target:g} %"
    if len(costs) < 2:
        return formatting.UNKNOWN
    bound = "at least " if best in metric.at_most else "at most " if worst in metric.at_most else ""
    if {best, worst} <= metric.at_most:
        bound = "about "
    return f"{words(best)} elements by {bound}{costs[worst] / costs[best]:.2g} ×"


def _seconds(seconds):
    """A time with three digits, because small meshes take less than a millisecond."""
    return formatting.general(seconds, 3) if math.isfinite(seconds) else formatting.UNKNOWN


def _cost(metric, order):
    cost = metric.cost_of_target.get(order, math.nan)
    if not math.isfinite(cost):
        return "not reached"
    return f"{'≤ ' if order in metric.at_most else ''}{_seconds(cost)}"


def _limit_of(metric):
    return formatting.general(metric.limit, 7, metric.resolution)


def _value(study, metric, mesh):
    """The value with the digits that exceed its error."""
    return formatting.general(mesh.values.get(metric.name, math.nan), 7, study.known_error(metric, mesh))


def _answer_row(study, metric):
    known = math.isfinite(metric.limit)
    limit = f"{_limit_of(metric)} ± {metric.uncertainty:.1g}" if known else formatting.UNKNOWN
    cells = [tag("th", metric.heading, scope="row"), tag("td", limit, class_="word")]
    for order in study.orders:
        cells.append(number(_cost(metric, order)))
    return tag("tr", *cells, tag("td", _cheaper(metric, study), class_="word"))


def _table(title, heads, rows, label, kind=None):
    cells = [tag("th", text, scope="col", class_="num" if numeric else "word") for text, numeric in heads]
    return headed_table(title, cells, rows, label, kind)


def _answer(study):
    """The first metric's sentence as the headline, the other sentences as a list, then a table."""
    first, *others = [f.answer for f in study.metrics]
    return joined([tag("p", first, class_="headline"), tag("ul", *(tag("li", s) for s in others)) if others else None,
                   _limits(study)])


def _limits(study):
    heads = [("Metric", False), ("Limit", False)]
    heads += [(f"{words(o)} [s]", True) for o in study.orders]
    heads.append(("Cheaper", False))
    return _table(f"Limits of the metrics, and the CPU time for an error of {100 * study.target:g} %", heads,
                  [_answer_row(study, f) for f in study.metrics], "Limits and costs")


def _row(study, mesh):
    cells = [tag("th", words(mesh.order), scope="row"), number(mesh.level), number(formatting.count(mesh.elements)),
             number(formatting.count(mesh.unknowns))]
    for metric in study.metrics:
        order = mesh.orders.get(metric.name, math.nan)
        cells += [number(_value(study, metric, mesh)),
                  number(formatting.exponent(mesh.errors.get(metric.name, math.nan))),
                  number(f"{order:.2f}" if math.isfinite(order) else formatting.UNKNOWN),
                  number(formatting.exponent(mesh.mesh_errors.get(metric.name, math.nan))),
                  number(_seconds(mesh.cpu_seconds.get(metric.name, math.nan)))]
    cells += [tag("td", "" if mesh.status == "completed" else mesh.reason or mesh.status, class_="word")]
    return tag("tr", *cells, class_="failed" if mesh.status != "completed" else None)


def _meshes(study):
    heads = [("Elements", False), ("level", True), ("number", True), ("unknowns", True)]
    for metric in study.metrics:
        heads += [(text, True) for text in (metric.heading, "error", "observed order", "mesh error", "CPU [s]")]
    heads.append(("", False))
    return _table("All meshes; the same in convergence.csv", heads, [_row(study, m) for m in study.meshes],
                  "All meshes", "long")


def _failures(study):
    if not study.failed:
        return None
    rows = [tag("tr", tag("th", f"{words(m.order)}, level {m.level}", scope="row"), tag("td", m.reason, class_="word"),
                tag("td", m.message, class_="message")) for m in study.failed]
    return _table("Meshes that failed", (("Mesh", False), ("Reason", False), ("Message", False)), rows, "Failures")


def _details(study, folder):
    changes = "".join(f" --set {shlex.quote(s)}" for s in study.about["set"])
    machine = study.about["machine"]
    made_by = command("converge", study.about["file"], folder, study.about.get("ranks", 1)) + changes
    return pairs([("Scene", study.about["file"]), ("Command", tag("code", made_by)),
                  ("Refinement", f"cells {study.about['ratio']} times as small on each level"),
                  ("Limit", "Richardson's extrapolation of the finest meshes; its uncertainty after Roache (1998)"),
                  ("Mesh error", "for frequencies and load factors their own error, for other metrics the error's "
                   "share of the elastic energy; estimated on each mesh alone"),
                  ("Machine", machine.get("processor", "")), ("Written", study.about["written"])])


def _tip(study, mesh):
    rows = []
    for f in study.metrics:
        error = mesh.mesh_errors.get(f.name, math.nan)
        rows += [[f.heading, _value(study, f, mesh)]]
        rows += [[f"{f.name}, mesh error estimated", formatting.exponent(error)]] if math.isfinite(error) else []
    return {"title": f"{words(mesh.order)} elements, level {mesh.level}", "rows": rows, "e": {}}


def page(study, folder):
    figures = Figures()
    pictures = [joined([tag("h3", f.heading) if len(study.metrics) > 1 else None,
                        tag("figure", tag("div", figures.of(study, f), class_="stage"),
                            tag("figcaption", READ) if f is study.metrics[0] else None, aria_label=f.name)])
                for f in study.metrics]
    parts = [("answer", "Result", _answer(study)), ("errors", "Errors", joined(pictures)),
             ("meshes", "Meshes", joined([_meshes(study), _failures(study)])),
             ("details", "Details", _details(study, folder))]
    title = f"Convergence of {study.name}"
    top = header(title, (f"{len(study.meshes)} meshes", when(study.about["written"])), [part[:2] for part in parts])
    return document(title, figures.styles.css(), top, [section(*part) for part in parts],
                    run_data([_tip(study, m) for m in study.meshes]))
