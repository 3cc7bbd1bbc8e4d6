"""Error measures, in the order of the report."""
import math

KINDS = {"l2": "over time (L2)", "final": "at the end", "max": "largest in time"}
FIELDS = ("displacement", "drift", "velocity", "probes", "quantities", "phase")
DRIFT = "drift."
DEFAULT = "displacement.l2"
DEFINITIONS = {
    "l2": "the root mean square over all sampled times",
    "final": "the value at the end time",
    "max": "the largest value over all sampled times",
}


def label(measure):
    """displacement.l2 -> 'displacement, over time (L2)'."""
    if measure == "phase":
        return "phase of the dominant frequency"
    if measure.startswith(DRIFT):
        return f"drift of {measure[len(DRIFT):].replace('_', ' ')}, largest in time"
    what, kind = measure.rsplit(".", 1)
    return f"{name(what)}, {KINDS.get(kind, kind)}"


def name(what):
    """probes.tip -> 'probe tip', quantities.von_mises.largest -> 'von_mises.largest'."""
    if what.startswith("probes."):
        return "probe " + what[len("probes."):]
    return what.removeprefix("quantities.")


def unit(measure):
    return "rad" if measure == "phase" else "relative"


def _rank(measure):
    what, kind = measure.rsplit(".", 1) if "." in measure else (measure, "")
    if measure.startswith(DRIFT):
        kind = ""
        what = measure.replace("energy", "")  # first of the drifts
    return FIELDS.index(measure.split(".")[0]), what, list(KINDS).index(kind) if kind in KINDS else len(KINDS)


def present(points):
    """The measures that at least one finished point has."""
    found = {key for p in points if p.completed for key, value in p.errors.items() if math.isfinite(value)}
    return sorted(found, key=_rank)


def primary(comparison):
    """The measure shown first: that of the answers, or without answers the displacement over time."""
    found = present(comparison.points)
    wanted = [a.error for a in comparison.answers] + [DEFAULT]
    return next((m for m in wanted if m in found), found[0] if found else DEFAULT)
