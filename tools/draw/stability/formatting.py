"""Numbers of a trial in words."""
import math

from ..report import formatting

LONG = 220  # letters of a reason under the pointer


def computed(figure):
    """'0.00135', '3.35e3'; a figure that is none is said to be none."""
    if formatting.known(figure.computed):
        return formatting.exponent(figure.computed, 3)
    return "never" if figure.title.startswith("onset") else "not finite"


def expected(figure):
    limit = f" ± {formatting.exponent(figure.limit)}" if formatting.known(figure.limit) else ""
    return formatting.exponent(figure.expected, 4) + limit


def reached(trial):
    if not formatting.known(trial.time_reached):
        return formatting.UNKNOWN
    return f"t = {formatting.general(trial.time_reached)}{formatting.THIN}s"


def own_reason(trial):
    """The reason, but where it only repeats the worst figure."""
    if trial.worst and trial.reason.startswith((f"{trial.worst.title} is ", f"{trial.worst.title} never came")):
        return ""
    return trial.reason


def tooltip(trial):
    """What is shown under the pointer, as data for the page's script."""
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
    """A field of the matrix for those who hear it."""
    figure = trial.worst
    text = f"{trial.integrator} on {trial.case}: {trial.grade}"
    if trial.grade != "pass" and figure and not math.isnan(figure.limit):
        text += f", {figure.title} {computed(figure)}, expected {expected(figure)}"
    return text + (f", {own_reason(trial)}" if own_reason(trial) and trial.grade == "fail" else "")
