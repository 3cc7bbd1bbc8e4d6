"""Table of all points. Constant columns are listed below the table instead."""
import math
from dataclasses import dataclass, field

from ..report import formatting
from ..report.markup import joined, scrolling, tag
from ..report.tables import caption
from . import mesh
from .answer import SAME


@dataclass(frozen=True)
class Column:
    heading: str
    numeric: bool
    cells: list  # texts, one per point
    values: list = field(default=None)  # the numbers in the cells

    @property
    def empty(self):
        return all(cell in ("", formatting.UNKNOWN) for cell in self.cells)

    @property
    def constant(self):
        if not self.values:
            return len(self.cells) > 1 and len(set(self.cells)) == 1
        if len(self.values) < 2 or not all(math.isfinite(v) for v in self.values):
            return False
        return max(self.values) - min(self.values) <= SAME * max(abs(v) for v in self.values)


def _percent(gap):
    return f"{100 * gap:+.3f}".replace("-", "−") if math.isfinite(gap) else formatting.UNKNOWN


def _off(share):
    """A relative error in per cent: '+25', '−0.31'."""
    if not math.isfinite(share):
        return formatting.UNKNOWN
    return ("+" if share > 0 else "−" if share < 0 else "") + mesh.percent(abs(share))


def _columns(sweep):
    points = sweep.points
    for v in sweep.variables:
        yield Column(v.heading, v.numeric, [v.plain(p["values"][v.name]) for p in points])
    for f in sweep.metrics:
        yield Column(f.heading, True, [f.shown(p, 6) for p in points], [f.value(p) for p in points])
        if any(math.isfinite(f.mesh_error(p)) for p in points):
            yield Column(f"{f.title}, by the mesh [%]", True, [_off(f.mesh_error(p)) for p in points])
        if f.closed_form:
            yield Column("from closed form [%]", True, [_percent(f.difference(p)) for p in points])
    if any(p.get("mesh_error") is not None for p in points):
        shares = [p.get("mesh_error") for p in points]
        yield Column("elastic energy that is the mesh's error [%]", True,
                     [formatting.UNKNOWN if share is None else mesh.percent(share) for share in shares])
    seconds = [(p["cost"] or {}).get("wall_seconds", math.nan) for p in points]
    yield Column("wall time [s]", True, [formatting.plain_seconds(s) for s in seconds])
    yield Column("status", False, ["" if p["status"] == "completed" else p["reason"] or p["status"] for p in points])


def _left_out(columns):
    """The constant columns, as the text below the table."""
    same = [f"{c.heading} {c.cells[0]}" for c in columns if c.constant and not c.empty]
    none = [c.heading for c in columns if c.empty and c.heading != "status"]
    parts = ([f"The same at all points: {'; '.join(same)}."] if same else []) + \
            ([f"No point has {formatting.joined(none)}."] if none else [])
    return tag("p", " ".join(parts), class_="empty") if parts else None


def _row(shown, k, failed):
    first, *others = shown
    cells = (tag("td", c.cells[k], class_="num" if c.numeric else "word") for c in others)
    return tag("tr", tag("th", first.cells[k], scope="row"), *cells, class_="failed" if failed else None)


def point_table(sweep):
    columns = list(_columns(sweep))
    shown = [c for c in columns if not c.empty and not c.constant] or columns[:1]
    heads = [tag("th", c.heading, scope="col", class_=None if not k else "num" if c.numeric else "word")
             for k, c in enumerate(shown)]
    rows = [_row(shown, k, p["status"] != "completed") for k, p in enumerate(sweep.points)]
    table = tag("table", caption("All points; the same in sweep.csv"), tag("thead", tag("tr", *heads)),
                tag("tbody", *rows), class_="long")
    return joined([scrolling(table, label="All points"), _left_out([c for c in columns if c not in shown])])
