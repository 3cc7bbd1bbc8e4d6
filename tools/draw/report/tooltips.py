"""Tooltips: pairs of label and value for every run, as data for the page's script."""
import math

from . import formatting
from .comparison import PARTS


def _times(spread):
    if not formatting.known(spread.median):
        return formatting.UNKNOWN
    text = f"{formatting.plain_seconds(spread.median)}{formatting.THIN}s"
    return text + (f" ({formatting.span(spread)})" if spread.max > spread.min else "")


def _rows(point):
    rows = [("Wall", _times(point.clocks["wall"])), ("CPU", _times(point.clocks["cpu"]))]
    steps = formatting.count(point.counts.get("steps", math.nan))
    rejected = point.counts.get("rejected_steps", math.nan)
    rows.append(("Steps", steps + (f", {formatting.count(rejected)} rejected" if formatting.known(rejected) else "")))
    rows += [(part.capitalize().replace("Factoriz", "Factoris"),
              f"{formatting.seconds(point.work[part].seconds)}, {formatting.count(point.work[part].count)}×")
             for part in PARTS if formatting.known(point.work[part].seconds)]
    return [[label, text] for label, text in rows if not text.startswith(formatting.UNKNOWN)]


def _failure(point):
    rows = [["Failed", point.reason or point.status], ["Reached", f"t = {formatting.general(point.time_reached)} s"]]
    return rows + ([["", point.message]] if point.message else [])


def tooltip(comparison, point):
    method = comparison.methods[comparison.method_index(point.method)]
    rows = _rows(point) if point.completed else _failure(point) + _rows(point)[:1]
    near = [key for key in point.errors if comparison.is_near_reference(point, key)]
    return {"m": comparison.method_index(point.method), "title": f"{method.label}, {formatting.control(point.control)}",
            "rows": rows,
            "e": {key: formatting.fixed_exponent(e) for key, e in point.errors.items() if formatting.known(e)},
            **({"near": near} if near else {})}
