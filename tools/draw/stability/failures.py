"""The table of all trials that did not pass."""
from ..report import formatting
from ..report.markup import tag
from ..report.tables import number, table
from .formatting import computed, own_reason
from .grades import named
from .grid import breakable, row_id

HEADS = (("Case", False), ("Variant", False), ("Integrator", False), ("Grade", False), ("Worst expectation", False),
         ("Computed", True), ("Expected", True), ("Limit ±", True), ("Reached t [s]", True), ("Wall [s]", True),
         ("Reason", False))


def _row(trial):
    worst = trial.worst
    cells = (worst.title, computed(worst), formatting.exponent(worst.expected, 4),
             formatting.exponent(worst.limit)) if worst else [""] * 4
    return tag("tr", tag("th", breakable(trial.case), scope="row"), tag("td", trial.variant, class_="word"),
               tag("td", trial.integrator, class_="word"), tag("td", named(trial.grade), class_="word"),
               tag("td", cells[0], class_="word", title=worst.source if worst else None), *map(number, cells[1:]),
               number(formatting.general(trial.time_reached)), number(formatting.plain_seconds(trial.wall)),
               tag("td", own_reason(trial), class_="message"), id=row_id(trial))


def failures(matrix):
    found = [t for t in matrix.trials if t.grade != "pass"]
    if not found:
        return tag("p", "Every trial passes." if matrix.trials else "No trial has ended yet.")
    title = f"{formatting.plural(len(found), 'trial')} of {formatting.count(len(matrix.trials))} did not pass; SI units"
    return table(title, HEADS, [_row(t) for t in found], "Trials that did not pass", "long")
