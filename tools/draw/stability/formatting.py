"""Numbers of a trial in words."""
import math

from ..report import formatting

LONG = 220  # largest number of letters of a reason in a tooltip


def computed(expectation):
    """The computed value: '0.00135', '3.35e3', or words if it is not finite."""
    if formatting.known(expectation.computed):
        return formatting.exponent(expectation.computed, 3)
    return "never" if expectation.title.startswith("onset") else "not finite"


def expected(expectation):
    limit = f" ± {formatting.exponent(expectation.limit)}" if formatting.known(expectation.limit) else ""
    return formatting.exponent(expectation.expected, 4) + limit


def reached(trial):
    if not formatting.known(trial.time_reached):
        return formatting.UNKNOWN
    return f"t = {formatting.general(trial.time_reached)}{formatting.THIN}s"


def own_reason(trial):
    """The reason of the grade, or '' if it only repeats the worst expectation."""
    if trial.worst and trial.reason.startswith((f"{trial.worst.title} is ", f"{trial.worst.title} did not occur")):
        return ""
    return trial.reason


def tooltip(trial):
    """A trial's tooltip, as data for the page's script."""
    rows = [["Grade", trial.grade]]
    if trial.worst:
        rows += [[trial.worst.title, computed(trial.worst)], ["Expected", expected(trial.worst)]]
    reason = own_reason(trial)
    rows += [["Reason", reason if len(reason) <= LONG else reason[:LONG - 1] + "…"]] if reason else []
    rows += [["Reached", reached(trial)]] if formatting.known(trial.time_reached) else []
    rows += [["Wall", formatting.seconds(trial.wall)]] if formatting.known(trial.wall) else []
    return {"title": trial.title, "rows": rows, "e": {}}


def case_tooltip(case):
    rows = [["", case.sentence]] if case.sentence else []
    return {"title": case.label, "rows": rows + ([["Model", case.model]] if case.model else []), "e": {}}


def spoken(trial):
    """The text alternative of a trial's field in the matrix."""
    worst = trial.worst
    text = f"{trial.integrator} on {trial.case}: {trial.grade}"
    if trial.grade != "pass" and worst and not math.isnan(worst.limit):
        text += f", {worst.title} {computed(worst)}, expected {expected(worst)}"
    return text + (f", {own_reason(trial)}" if own_reason(trial) and trial.grade == "fail" else "")
