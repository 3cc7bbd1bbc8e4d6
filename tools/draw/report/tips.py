"""What is shown under the pointer: lines of label and value for every run, as data for the page's script."""
import math

from . import words
from .comparison import PARTS


def _times(spread):
    if not words.known(spread.median):
        return words.UNKNOWN
    text = f"{words.plain_seconds(spread.median)}{words.THIN}s"
    return text + (f" ({words.span(spread)})" if spread.max > spread.min else "")


def _rows(point):
    rows = [("Wall", _times(point.clocks["wall"])), ("CPU", _times(point.clocks["cpu"]))]
    steps = words.count(point.counts.get("steps", math.nan))
    rejected = point.counts.get("rejected_steps", math.nan)
    rows.append(("Steps", steps + (f", {words.count(rejected)} rejected" if words.known(rejected) else "")))
    rows += [(part.capitalize().replace("Factoriz", "Factoris"),
              f"{words.seconds(point.work[part].seconds)}, {words.count(point.work[part].count)}×")
             for part in PARTS if words.known(point.work[part].seconds)]
    return [[label, text] for label, text in rows if not text.startswith(words.UNKNOWN)]


def _failure(point):
    rows = [["Failed", point.reason or point.status], ["Reached", f"t = {words.general(point.time_reached)} s"]]
    return rows + ([["", point.message]] if point.message else [])


def tip(comparison, point):
    method = comparison.methods[comparison.method_index(point.method)]
    rows = _rows(point) if point.completed else _failure(point) + _rows(point)[:1]
    near = [key for key in point.errors if comparison.is_near_reference(point, key)]
    return {"m": comparison.method_index(point.method), "title": f"{method.label}, {words.control(point.control)}",
            "rows": rows, "e": {key: words.fixed_exponent(e) for key, e in point.errors.items() if words.known(e)},
            **({"near": near} if near else {})}
