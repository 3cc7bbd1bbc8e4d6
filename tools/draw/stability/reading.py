"""stability.json as a Matrix."""
import math
import re

from ..study_json import StudyKind, read_study
from .grades import GRADES
from .matrix import Case, Expectation, Matrix, Trial

KIND = StudyKind("stability.json", "orthodyn stability", ("kind", "stability"))


def short(reason):
    """The reason without the file name and line of the trial's scene, as in '/tmp/x/scene.yaml:18:13: integrator:
    ...'."""
    reason = re.sub(r"^[^:]*\.ya?ml:\d+(:\d+)?: ", "", reason)
    return re.sub(r"(^|(?<=\s))\S+\.ya?ml:\d+(:\d+)?: ", "", reason).strip()


def _reason(node):
    """The reason and the message, or only the message if it contains the reason."""
    reason, message = short(node.text("reason")), short(node.text("message"))
    return ": ".join(part for part in (reason, message) if part) if reason not in message else message


def _expectation(node):
    if not node.value:
        return None
    return Expectation(node.text("title"), *map(node.number, ("computed", "expected", "limit")), node.text("source"),
                  node.text("tolerance"))


def _trial(index, node, cases, variants, integrators):
    return Trial(index, node.one_of("case", cases), node.one_of("variant", variants),
                 node.one_of("integrator", integrators), node.text("folder"), node.one_of("grade", GRADES),
                 _reason(node), _expectation(node.child("worst")), *map(node.number, ("time_reached", "wall", "cpu")),
                 node.child("statistics").number("steps"))


def read_matrix(folder):
    node = read_study(folder, KIND)
    cases = [Case(n.needed("label"), *map(n.text, ("file", "sentence", "model"))) for n in node.children("cases")]
    labels, variants, integrators = ([c.label for c in cases],
                                     *([str(x) for x in node.list(key)] for key in ("variants", "integrators")))
    trials = [_trial(k, n, labels, variants, integrators) for k, n in enumerate(node.children("trials"))]
    limit = node.number("limit") if "limit" in node.value else math.nan
    return Matrix(node.text("title", node.file.parent.name), node.text("description"), node.text("file"), node.text("at"),
                  node.child("machine").texts(), node.child("versions").texts(), limit,
                  node.value.get("complete") is True, cases, variants, integrators, trials,
                  [str(s) for s in node.list("suspected")])
