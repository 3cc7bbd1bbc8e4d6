"""stability.json -> Matrix; what is wrong in the file becomes one line with its place."""
import json
import math
import re

from ..errors import DrawError
from ..report.reading import Node
from ..series import result_folder
from . import FILE
from .grades import GRADES
from .matrix import Case, Figure, Matrix, Trial


class MatrixNode(Node):
    command = "orthodyn stability"


def short(reason):
    """Without the place of a file that nobody will look into: '/tmp/x/scene.yaml:18:13: integrator: ...'."""
    reason = re.sub(r"^[^:]*\.ya?ml:\d+(:\d+)?: ", "", reason)
    return re.sub(r"(^|(?<=\s))\S+\.ya?ml:\d+(:\d+)?: ", "", reason).strip()


def _reason(node):
    """Reason and message, whichever there are; one may say the other already."""
    reason, message = short(node.text("reason")), short(node.text("message"))
    return ": ".join(part for part in (reason, message) if part) if reason not in message else message


def _figure(node):
    if not node.value:
        return None
    return Figure(node.text("title"), *map(node.number, ("computed", "expected", "limit")), node.text("source"),
                  node.text("tolerance"))


def _trial(index, node, cases, variants, integrators):
    return Trial(index, node.one_of("case", cases), node.one_of("variant", variants),
                 node.one_of("integrator", integrators), node.text("folder"), node.one_of("grade", GRADES),
                 _reason(node), _figure(node.child("worst")), *map(node.number, ("time_reached", "wall", "cpu")),
                 node.child("statistics").number("steps"))


def _parsed(path):
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise DrawError(f"{path}: missing; `orthodyn stability FILE.yaml --out {path.parent}` writes it") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise DrawError(f"{path}: not readable as JSON ({error}); if it is cut off, run `orthodyn stability` again") \
            from None
    if not isinstance(content, dict) or content.get("kind") != "stability":
        raise DrawError(f"{path}: no matrix of hard cases, \"kind\" is not \"stability\"; "
                        "give the folder that `orthodyn stability` wrote")
    return content


def read_matrix(folder):
    path = result_folder(folder) / FILE
    node = MatrixNode(path, "", _parsed(path))
    cases = [Case(n.needed("label"), *map(n.text, ("file", "sentence", "model"))) for n in node.children("cases")]
    labels, variants, integrators = ([c.label for c in cases],
                                     *([str(x) for x in node.list(key)] for key in ("variants", "integrators")))
    trials = [_trial(k, n, labels, variants, integrators) for k, n in enumerate(node.children("trials"))]
    limit = node.number("limit") if "limit" in node.value else math.nan
    return Matrix(node.text("title", path.parent.name), node.text("description"), node.text("file"), node.text("at"),
                  node.child("machine").texts(), node.child("versions").texts(), limit,
                  node.value.get("complete") is True, cases, variants, integrators, trials,
                  [str(s) for s in node.list("suspected")])
