"""The end states of a matrix of hard cases: of each case those that differ, with the trials that ended so."""
from pathlib import Path

from ..errors import DrawError
from ..stability import FILE
from ..stability.end_states import COLOUR, RANGE, EndStates
from ..stability.grades import GRADES
from ..stability.reading import read_matrix
from .item import Item, Source


def is_matrix(folder):
    return (Path(folder) / FILE).is_file()


def _label(matrix, variant, cluster):
    trials = [f"{grade}: " + ", ".join(t.integrator for t in cluster.trials if t.grade == grade)
              for grade in GRADES if any(t.grade == grade for t in cluster.trials)]
    return (f"{variant}; " if len(matrix.variants) > 1 else "") + "; ".join(trials)


def of_matrix(folder):
    matrix, items = read_matrix(folder), []
    for case in matrix.cases:
        states = EndStates(matrix, folder, case)
        labels = [_label(matrix, variant, cluster) for variant, clusters in states.clusters.items() for cluster in clusters]
        if labels:
            items.append(Item(case.label, states.series(), labels=labels, facts=(case.sentence,) if case.sentence else ()))
    if not items:
        raise DrawError(f"{folder}: no trial has left an end state that can be drawn")
    return Source("hard cases", items, {"color": COLOUR, "range": list(RANGE), "rest": True})
