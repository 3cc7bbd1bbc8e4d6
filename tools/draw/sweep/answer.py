"""The answer of a sweep in sentences: how far each figure changes, where, and whether closed forms hold."""
import math

from ..report import formatting
from ..report.markup import joined, tag
from . import mesh

SAME = 1e-6   # relative changes below it are none
AGREES = 0.1  # integrators agree if they differ by less than this share of their distance from the closed form
FAR = 0.01    # and that distance is a matter of the formula from here on
COARSE = 0.05  # share of the elastic energy that is the error of the mesh


def _with_unit(figure, number):
    return number.replace("-", "−") + (f" {figure.unit}" if figure.unit else "")


def words(figure, value):
    return _with_unit(figure, formatting.general(value))


def _said(figure, point):
    """The value there, with the digits that the mesh lets be known."""
    return _with_unit(figure, figure.shown(point))


def where(sweep, point):
    """'stiffer 10, along L', without variables that have one value."""
    varied = [v for v in sweep.variables if len(sweep.levels(v)) > 1] or sweep.variables
    return ", ".join(f"{v.name} {v.words(point['values'][v.name])}" for v in varied)


def _valued(sweep, figure):
    """(value, point) of points that have one; along the axis where there is one numeric variable."""
    found = [(figure.value(p), p) for p in sweep.done if math.isfinite(figure.value(p))]
    if len(sweep.variables) == 1 and sweep.variables[0].numeric:
        found.sort(key=lambda entry: entry[1]["values"][sweep.variables[0].name])
    return found


def _monotonic(sweep, values):
    """'rises', 'falls', or '' where it turns or where there is no one axis."""
    if len(sweep.variables) > 1 or not sweep.variables[0].numeric:
        return ""
    steps = [b - a for a, b in zip(values, values[1:])]
    return "rises" if all(s >= 0 for s in steps) else "falls" if all(s <= 0 for s in steps) else ""


def _by_how_much(low, high, about):
    """', a factor of 12', ', by 4.2 %', or `about` so much; '' where the sign changes."""
    small, large = sorted((abs(low), abs(high)))
    if low * high <= 0:
        return ""
    if large >= 2 * small:
        return f", a factor of {about}{large / small:.{2 if about else 3}g}"
    return f", by {about}{100 * (large / small - 1):.2g} %"


def _change(sweep, figure):
    """Words that follow the figure's title; None where no point has it."""
    found = _valued(sweep, figure)
    if not found:
        return None
    low, high = (choose(found, key=lambda entry: entry[0]) for choose in (min, max))
    if high[0] - low[0] <= SAME * max(abs(low[0]), abs(high[0])):
        return f"is {_said(figure, low[1])} at {'the only point' if len(found) == 1 else 'all points'}"
    about = "about " if any(abs(figure.mesh_error(p)) > FAR for _, p in (low, high)) else ""
    much, verb = _by_how_much(low[0], high[0], about), _monotonic(sweep, [value for value, _ in found])
    first, last = (p for _, p in ((found[0], found[-1]) if verb else (low, high)))
    if about and _said(figure, first) == _said(figure, last):
        return (f"is {_said(figure, first)} at all points as far as the mesh lets it be known; it {verb or 'ranges'} from "
                f"{where(sweep, first)} to {where(sweep, last)}{much}")
    return (f"{verb or 'ranges'} from {_said(figure, first)} ({where(sweep, first)}) "
            f"to {_said(figure, last)} ({where(sweep, last)}){much}")


def _crossings(variable, found, limit):
    """Values of the variable at which the figure passes the limit, interpolated between points."""
    place, back = (math.log, math.exp) if variable.log else (float, float)
    rows = [(place(point["values"][variable.name]), value) for value, point in found]
    return [back(x + (limit - a) / (b - a) * (y - x)) for (x, a), (y, b) in zip(rows, rows[1:])
            if (a < limit) != (b < limit)]


def _failure(sweep, figure):
    """'; 1 fails, which it crosses at theta 12.3 deg', of exposures."""
    limit, found = figure.failure, _valued(sweep, figure)
    if not math.isfinite(limit) or not found:
        return ""
    fails = f"; {words(figure, limit)} fails, "
    above = sum(value >= limit for value, _ in found)
    if above in (0, len(found)):
        return fails + ("and no point reaches it" if not above else "as all points do")
    if len(sweep.variables) > 1 or not sweep.variables[0].numeric:
        return fails + f"as {above} of {formatting.plural(len(found), 'point')} do"
    variable = sweep.variables[0]
    at = formatting.joined(variable.words(x) for x in _crossings(variable, found, limit))
    return fails + f"which it crosses at {variable.name} {at} by interpolation"


def _closed_form(sweep, figure):
    gaps = [(abs(figure.difference(p)), p) for p in sweep.done if math.isfinite(figure.difference(p))]
    if not gaps:
        return ""
    gap, point = max(gaps, key=lambda entry: entry[0])
    if gap < 1e-9:
        return "; it equals the closed form"
    at = f" ({where(sweep, point)})" if len(gaps) > 1 else ""
    return f"; at most {formatting.general(100 * gap, 2)} % from the closed form{at}"


def _by_the_mesh(sweep, figure):
    off = mesh.off_at(figure, sweep.done)
    return f"; the mesh makes it {off}" if off else ""


def _groups(sweep, figure):
    """Differences from the closed form by the values of all variables but the integrator."""
    chooser = next((v for v in sweep.variables if v.path == "integrator.type"), None)
    groups = {}
    for point in sweep.done if chooser else ():
        key = tuple(value for name, value in point["values"].items() if name != chooser.name)
        if math.isfinite(figure.difference(point)):
            groups.setdefault(key, []).append(figure.difference(point))
    return [g for g in groups.values() if len(g) > 1]


def _suspected(sweep, figure):
    """Where integrators agree with each other and not with the closed form, the formula is in doubt."""
    groups = _groups(sweep, figure)
    if not groups or not all(min(map(abs, g)) > FAR and max(g) - min(g) < AGREES * min(map(abs, g)) for g in groups):
        return ""
    return ". All integrators agree with each other and not with the closed form: the formula is suspected"


def _capitalised(figure):
    """The title at the start of a sentence; names of keys and of figures stay as they are."""
    is_name = figure.title == figure.name or "_" in figure.title or "." in figure.title
    return figure.title if is_name else figure.title[:1].upper() + figure.title[1:]


def _sentence(sweep, figure):
    change = _change(sweep, figure)
    if change is None:
        return None
    return joined([tag("strong", _capitalised(figure)),
                   f" {change}{_failure(sweep, figure)}{_closed_form(sweep, figure)}{_by_the_mesh(sweep, figure)}"
                   f"{_suspected(sweep, figure)}."])


def _warnings(sweep):
    """What the program warned of at some points: slips of input, strains beyond the law's limits."""
    warned = [p for p in sweep.points if p.get("warnings")]
    if not warned:
        return None
    first = warned[0]
    return tag("p", tag("strong", "Warnings"), f" of {len(warned)} of "
               f"{formatting.plural(len(sweep.points), 'point')} (column warnings of sweep.csv); that with "
               f"{first['title']}: {first['warnings'][0]}")


def _coarse(sweep):
    """Where the mesh puts figures with errors of their own far off, and where the elastic energy tells that it is coarse."""
    parts, count = [], formatting.plural(len(sweep.points), "point")
    figures = [f for f in sweep.figures if any(abs(f.mesh_error(p)) > COARSE for p in sweep.done)]
    if figures:
        error, figure, point = mesh.worst(figures, sweep.done)
        points = [p for p in sweep.done if any(abs(f.mesh_error(p)) > COARSE for f in figures)]
        parts.append(tag("p", tag("strong", "The mesh is coarse"), f" for {formatting.joined(f.title for f in figures)} at "
                         f"{len(points)} of {count}: up to {mesh.off(error)} ({figure.title}, {where(sweep, point)}). "
                         "Numbers have no more digits than that lets be known; sweep.csv has all. Finer cells would reduce it."))
    points = [p for p in sweep.done if (p.get("mesh_error") or 0) > COARSE]
    if points:
        worst = max(p["mesh_error"] for p in points)
        parts.append(tag("p", tag("strong", "The mesh is coarse"), f" for {len(points)} of {count}: of the elastic energy up to "
                         f"{mesh.percent(worst)}{formatting.THIN}% is its error. Deflections are too small and "
                         "frequencies too high; `orthodyn converge` tells by how much."))
    return joined(parts) or None


def answer(sweep):
    """The first figure as the headline, the others as a list."""
    sentences = [s for s in (_sentence(sweep, f) for f in sweep.figures) if s]
    if not sentences:
        return tag("p", "No point has finished with a figure yet.", class_="headline")
    failed = len(sweep.failed)
    return joined([
        tag("p", sentences[0], class_="headline"),
        tag("ul", *(tag("li", s) for s in sentences[1:])) if sentences[1:] else None,
        tag("p", f"{failed} of {formatting.plural(len(sweep.points), 'point')} failed.") if failed else None,
        _coarse(sweep),
        _warnings(sweep)])
