"""The page of a sweep: one HTML file that opens offline."""
import base64
import math
from pathlib import Path

from ..report import formatting
from ..report.details import command, drawing, facts, pairs
from ..report.document import document, header, not_finished, run_data, section, when
from ..report.markup import joined, tag, void
from ..report.tables import table
from . import mesh
from .answer import answer, where
from .figures import Figures
from .plan import MOST_PANELS, left_out, plans
from .point_table import point_table

READ = "Marks are points of the sweep. Lines without marks, and strokes, are closed forms."
WITHOUT = "Thin strokes lead from a mark to where it would be without that error."


def _counted(sweep):
    machine = sweep.about["machine"].get("processor", "")
    parts = [formatting.plural(len(sweep.points), "point") + (f" ({len(sweep.failed)} failed)" if sweep.failed else "")]
    parts += [formatting.plural(len(sweep.levels(v)), "value") + f" of {v.name}" for v in sweep.variables]
    return parts + [when(sweep.about["written"]), machine]


def _banner(sweep):
    missing = sweep.about["missing"]
    return not_finished(f"{missing} of {len(sweep.points)} points are missing. What follows covers the points so "
                        "far.") if missing else None


def _place(sweep, metric, point):
    """A point in words, 'length 30 mm', and the mesh error of the metric at the point."""
    off = mesh.off(metric.mesh_error(point))
    return where(sweep, point) + (f"; by the mesh {off}" if off else "")


def _range_row(sweep, metric, closed_forms):
    values = [(metric.value(p), p) for p in sweep.done if math.isfinite(metric.value(p))]
    if not values:
        return tag("tr", tag("th", metric.heading, scope="row"), tag("td", "no point has it", colspan=3, class_="word"))
    ends = (min(values, key=lambda v: v[0]), max(values, key=lambda v: v[0]))
    cells = [(metric.shown(point), _place(sweep, metric, point)) for _, point in ends]
    gaps = [(abs(metric.difference(p)), p) for _, p in values if math.isfinite(metric.difference(p))]
    if gaps:
        gap, point = max(gaps, key=lambda g: g[0])
        cells.append((f"{formatting.general(100 * gap, 3)}{formatting.THIN}%", where(sweep, point)))
    elif closed_forms:
        cells.append((formatting.UNKNOWN, ""))
    return tag("tr", tag("th", metric.heading, scope="row"),
               *(tag("td", words, void("br"), tag("small", place), class_="word") for words, place in cells))


def _ranges(sweep):
    closed_forms = any(f.closed_form for f in sweep.metrics)
    heads = [(text, False) for text in ("Metric", "Smallest", "Largest")]
    heads += [("Farthest from the closed form", False)] if closed_forms else []
    rows = [_range_row(sweep, f, closed_forms) for f in sweep.metrics]
    return table("Over all points", heads, rows, "Smallest and largest")


def _figures(sweep, figures):
    parts = []
    for k, plan in enumerate(plans(sweep)):
        pictures = [tag("div", picture, class_="stage") for picture in figures.of(sweep, plan)]
        off = mesh.off_at(plan.metric, plan.points(sweep))
        said = [READ] * (k == 0) + ([f"The mesh makes {plan.metric.title} {off}. {WITHOUT}"] if off else [])
        explained = tag("figcaption", " ".join(said)) if said else None
        parts.append(tag("figure", *pictures, explained, aria_label=plan.metric.title))
    for metric, count, others in left_out(sweep):
        names = " and ".join(v.name for v in others)
        parts.append(tag("p", f"Of {metric.title} the first {MOST_PANELS} of {count} combinations of {names} are drawn; "
                         "all are in the table.", class_="empty"))
    return joined(parts) or tag("p", "Nothing to show: no point has finished.", class_="empty")


def _embedded(path):
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode("ascii")


def _gallery(sweep, paths, view):
    scale, at = sweep.frames["enlarged"], sweep.frames["at"]
    names = ", ".join(v.heading for v in sweep.variables)
    when = "at the end of their runs" if at is None else f"after {at:g} s"
    enlarged = f" Deformations are enlarged {scale:g} times." if scale != 1 else ""
    alt = f"The body at {len(sweep.done)} points of the sweep, side by side"
    return tag("figure", *(void("img", src=_embedded(path), class_=f"photo {theme}", alt=alt)
                           for theme, path in zip(("day", "night"), paths)),
               tag("figcaption", f"Points {when}, with one camera and one range of colours. Above each: {names}.{enlarged} ",
                   joined([tag("a", "The same in 3D", href=view), "."]) if view else None))


def _failures(sweep):
    if not sweep.failed:
        return tag("p", "No point failed.", class_="empty")
    rows = [tag("tr", tag("th", p["title"], scope="row"), tag("td", p["reason"], class_="word"),
                tag("td", p["message"] or "", class_="message")) for p in sweep.failed]
    return table("Points that failed", (("Point", False), ("Reason", False), ("Message", False)), rows, "Failures")


def _details(sweep, folder):
    closed = [(f.name, f.closed_form) for f in sweep.metrics if f.closed_form]
    formulas = (("Closed forms (SI units)", closed), ("Definitions", sweep.about["definitions"].items()))
    blocks = [*((name, pairs((k, str(v)) for k, v in values)) for name, values in formulas if values),
              ("Machine of this page", facts(sweep.about["machine"])), ("Versions", facts(sweep.about["versions"]))]
    made_by = command("sweep", sweep.about["file"], folder, sweep.about.get("ranks", 1))
    listed = (joined([tag("h3", name), content]) for name, content in blocks)
    return joined([*listed, tag("h3", "To reproduce"), tag("pre", tag("code", f"{made_by}\n{drawing(folder)}"))])


def _tip(sweep, point):
    rows = [[v.heading, v.words(point["values"][v.name])] for v in sweep.variables]
    for f in sweep.metrics:
        off = mesh.off(f.mesh_error(point))
        rows += [[f.heading, f.shown(point, 6)]] + ([[f"{f.title}, by the mesh", off]] if off else [])
    rows += [[f"{f.title}, closed form", formatting.general(f.closed(point), 6)]
             for f in sweep.metrics if f.closed_form]
    return {"title": f"Point {point['index'] + 1}", "rows": rows, "e": {}}


def page(sweep, folder, gallery, view=None):
    """The page as HTML. `gallery`: paths of the light and dark picture of points, or empty; `view`: file of the 3D view, or
    None."""
    figures = Figures()
    parts = [("answer", "Result", joined([answer(sweep), _ranges(sweep)])),
             ("figures", "Figures", _figures(sweep, figures))]
    if gallery:
        parts.append(("frames", "Frames", _gallery(sweep, gallery, view)))
    parts += [("points", "Points", joined([point_table(sweep), tag("h3", "Failures"), _failures(sweep)])),
              ("details", "Details", _details(sweep, folder))]
    top = header(sweep.title, _counted(sweep), [part[:2] for part in parts], sweep.description, _banner(sweep), view)
    return document(sweep.title, figures.styles.css(), top, [section(*part) for part in parts],
                    run_data([_tip(sweep, p) for p in sweep.points]))
