"""The answer of a sweep in sentences: the change of each metric, and its agreement with closed forms."""
import math

from ..report import formatting
from ..report.markup import joined, tag
from . import mesh

SAME = 1e-6   # a smaller relative change counts as none
AGREES = 0.1  # integrators agree if they differ by less than this fraction of their distance from the closed form
FAR = 0.01    # a larger relative distance from the closed form casts doubt on the formula
COARSE = 0.05  # mesh error, relative to the elastic energy, above which a mesh is called coarse


def _with_unit(metric, number):
    return number.replace("-", "−") + (f" {metric.unit}" if metric.unit else "")


def words(metric, value):
    return _with_unit(metric, formatting.general(value))


def _said(metric, point):
    """The metric's value at a point as text, with the digits that exceed the mesh error."""
    return _with_unit(metric, metric.shown(point))


def where(sweep, point):
    """The values at a point: 'stiffer 10, along L'. Leaves out variables with a single value."""
    varied = [v for v in sweep.variables if len(sweep.levels(v)) > 1] or sweep.variables
    return ", ".join(f"{v.name} {v.words(point['values'][v.name])}" for v in varied)


def _valued(sweep, metric):
    """(value, point) of the points that have a value. They are sorted if the only variable is numeric."""
    found = [(metric.value(p), p) for p in sweep.done if math.isfinite(metric.value(p))]
    if len(sweep.variables) == 1 and sweep.variables[0].numeric:
        found.sort(key=lambda entry: entry[1]["values"][sweep.variables[0].name])
    return found


def _monotonic(sweep, values):
    """'rises', 'falls', or '' if the metric is not monotonic or does not depend on a single variable."""
    if len(sweep.variables) > 1 or not sweep.variables[0].numeric:
        return ""
    steps = [b - a for a, b in zip(values, values[1:])]
    return "rises" if all(s >= 0 for s in steps) else "falls" if all(s <= 0 for s in steps) else ""


def _by_how_much(low, high, about):
    """', a factor of 12', ', by 4.2 %', with `about` in front; '' if the sign changes."""
    small, large = sorted((abs(low), abs(high)))
    if low * high <= 0:
        return ""
    if large >= 2 * small:
        return f", a factor of {about}{large / small:.{2 if about else 3}g}"
    return f", by {about}{100 * (large / small - 1):.2g} %"


def _change(sweep, metric):
    """The words about the change that follow the metric's title; None without values."""
    found = _valued(sweep, metric)
    if not found:
        return None
    low, high = (choose(found, key=lambda entry: entry[0]) for choose in (min, max))
    if high[0] - low[0] <= SAME * max(abs(low[0]), abs(high[0])):
        return f"is {_said(metric, low[1])} at {'the only point' if len(found) == 1 else 'all points'}"
    about = "about " if any(abs(metric.mesh_error(p)) > FAR for _, p in (low, high)) else ""
    much, verb = _by_how_much(low[0], high[0], about), _monotonic(sweep, [value for value, _ in found])
    first, last = (p for _, p in ((found[0], found[-1]) if verb else (low, high)))
    if about and _said(metric, first) == _said(metric, last):
        return (f"is {_said(metric, first)} at all points within the mesh error; it {verb or 'ranges'} from "
                f"{where(sweep, first)} to {where(sweep, last)}{much}")
    return (f"{verb or 'ranges'} from {_said(metric, first)} ({where(sweep, first)}) "
            f"to {_said(metric, last)} ({where(sweep, last)}){much}")


def _crossings(variable, found, limit):
    """The values of the variable at which the metric crosses the limit, interpolated between points."""
    place, back = (math.log, math.exp) if variable.log else (float, float)
    rows = [(place(point["values"][variable.name]), value) for value, point in found]
    return [back(x + (limit - a) / (b - a) * (y - x)) for (x, a), (y, b) in zip(rows, rows[1:])
            if (a < limit) != (b < limit)]


def _failure(sweep, metric):
    """For a failure index, the failure and where it starts: '; 1 fails, which it crosses at theta 12.3 deg'."""
    limit, found = metric.failure, _valued(sweep, metric)
    if not math.isfinite(limit) or not found:
        return ""
    fails = f"; {words(metric, limit)} fails, "
    above = sum(value >= limit for value, _ in found)
    if above in (0, len(found)):
        return fails + ("and no point reaches it" if not above else "as all points do")
    if len(sweep.variables) > 1 or not sweep.variables[0].numeric:
        return fails + f"as {above} of {formatting.plural(len(found), 'point')} do"
    variable = sweep.variables[0]
    at = formatting.joined(variable.words(x) for x in _crossings(variable, found, limit))
    return fails + f"which it crosses at {variable.name} {at} (interpolated)"


def _closed_form(sweep, metric):
    gaps = [(abs(metric.difference(p)), p) for p in sweep.done if math.isfinite(metric.difference(p))]
    if not gaps:
        return ""
    gap, point = max(gaps, key=lambda entry: entry[0])
    if gap < 1e-9:
        return "; it equals the closed form"
    at = f" ({where(sweep, point)})" if len(gaps) > 1 else ""
    return f"; at most {formatting.general(100 * gap, 2)} % from the closed form{at}"


def _by_the_mesh(sweep, metric):
    off = mesh.off_at(metric, sweep.done)
    return f"; the mesh makes it {off}" if off else ""


def _groups(sweep, metric):
    """Differences from the closed form, in groups of points that differ only in the integrator."""
    chooser = next((v for v in sweep.variables if v.path == "integrator.type"), None)
    groups = {}
    for point in sweep.done if chooser else ():
        key = tuple(value for name, value in point["values"].items() if name != chooser.name)
        if math.isfinite(metric.difference(point)):
            groups.setdefault(key, []).append(metric.difference(point))
    return [g for g in groups.values() if len(g) > 1]


def _suspected(sweep, metric):
    """Says that the formula is in doubt, if integrators agree with each other but not with the formula."""
    groups = _groups(sweep, metric)
    if not groups or not all(min(map(abs, g)) > FAR and max(g) - min(g) < AGREES * min(map(abs, g)) for g in groups):
        return ""
    return ". All integrators agree with each other but not with the closed form: check the formula"


def _capitalised(metric):
    """The title for the start of a sentence. It is capitalised unless it is the name of a key or metric."""
    is_name = metric.title == metric.name or "_" in metric.title or "." in metric.title
    return metric.title if is_name else metric.title[:1].upper() + metric.title[1:]


def _sentence(sweep, metric):
    change = _change(sweep, metric)
    if change is None:
        return None
    return joined([tag("strong", _capitalised(metric)),
                   f" {change}{_failure(sweep, metric)}{_closed_form(sweep, metric)}{_by_the_mesh(sweep, metric)}"
                   f"{_suspected(sweep, metric)}."])


def _warnings(sweep):
    """The warnings that the program gave at points, such as questionable input or strains beyond the law's limits."""
    warned = [p for p in sweep.points if p.get("warnings")]
    if not warned:
        return None
    first = warned[0]
    return tag("p", tag("strong", "Warnings"), f" of {len(warned)} of "
               f"{formatting.plural(len(sweep.points), 'point')} (column warnings of sweep.csv); the first, at "
               f"{first['title']}: {first['warnings'][0]}")


def _coarse(sweep):
    """Says at which points the mesh is coarse, judged by the mesh errors of metrics and by that of the elastic
    energy."""
    parts, count = [], formatting.plural(len(sweep.points), "point")
    metrics = [f for f in sweep.metrics if any(abs(f.mesh_error(p)) > COARSE for p in sweep.done)]
    if metrics:
        error, metric, point = mesh.worst(metrics, sweep.done)
        points = [p for p in sweep.done if any(abs(f.mesh_error(p)) > COARSE for f in metrics)]
        parts.append(tag("p", tag("strong", "The mesh is coarse"), f" for {formatting.joined(f.title for f in metrics)} at "
                         f"{len(points)} of {count}: up to {mesh.off(error)} ({metric.title}, {where(sweep, point)}). "
                         "Numbers are rounded accordingly; sweep.csv has all digits. Finer cells reduce the error."))
    points = [p for p in sweep.done if (p.get("mesh_error") or 0) > COARSE]
    if points:
        worst = max(p["mesh_error"] for p in points)
        parts.append(tag("p", tag("strong", "The mesh is coarse"), f" for {len(points)} of {count}: its error is up to "
                         f"{mesh.percent(worst)}{formatting.THIN}% of the elastic energy. Deflections are too small and "
                         "frequencies too high; `orthodyn converge` estimates by how much."))
    return joined(parts) or None


def answer(sweep):
    """The first metric as the headline, the others as a list."""
    sentences = [s for s in (_sentence(sweep, f) for f in sweep.metrics) if s]
    if not sentences:
        return tag("p", "No point has finished with a metric yet.", class_="headline")
    failed = len(sweep.failed)
    return joined([
        tag("p", sentences[0], class_="headline"),
        tag("ul", *(tag("li", s) for s in sentences[1:])) if sentences[1:] else None,
        tag("p", f"{failed} of {formatting.plural(len(sweep.points), 'point')} failed.") if failed else None,
        _coarse(sweep),
        _warnings(sweep)])
