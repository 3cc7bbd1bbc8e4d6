"""View of a stability matrix: the distinct end states of each case, which are labelled by their trials."""
from ..errors import DrawError
from ..view.item import Item, Source
from .end_states import COLOUR, RANGE, EndStates
from .grades import GRADES
from .reading import read_matrix


def _label(matrix, variant, cluster):
    trials = [f"{grade}: " + ", ".join(t.integrator for t in cluster.trials if t.grade == grade)
              for grade in GRADES if any(t.grade == grade for t in cluster.trials)]
    return (f"{variant}; " if len(matrix.variants) > 1 else "") + "; ".join(trials)


def view_source(folder):
    matrix, items = read_matrix(folder), []
    for case in matrix.cases:
        states = EndStates(matrix, folder, case)
        labels = [_label(matrix, variant, cluster) for variant, clusters in states.clusters.items() for cluster in clusters]
        if labels:
            items.append(Item(case.label, states.series(), labels=labels, facts=(case.sentence,) if case.sentence else ()))
    if not items:
        raise DrawError(f"{folder}: no trial has an end state that can be drawn")
    return Source(folder, "hard cases", items, {"color": COLOUR, "range": list(RANGE), "rest": True})
