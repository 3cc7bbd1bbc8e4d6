"""Curves of several results in the same plots, and their differences from the first."""
import numpy as np
from matplotlib.lines import Line2D

from .chart import COLOURS, panels, time_axis, title
from .errors import DrawError
from .series import result_folder
from .style import save
from .table import Table
from .units import prefix

FILES = ("probes.csv", "energy.csv")
STYLES = ("-", (0, (5, 2)), (0, (1, 1.4)), (0, (5, 2, 1, 2)))
# The first result is drawn as a broad band, so that the others stay visible where they coincide with it.
LOOKS = [{"lw": 3.6, "alpha": 0.35, "ls": STYLES[0]}] + [{"lw": 1.2, "ls": style} for style in STYLES[1:]]


def _groups(table, leave_out=("balance",)):
    """Groups columns by panel: components of a vector, or energies."""
    groups = {}
    for column in table.others():
        if column.name in leave_out:
            continue
        stem = column.name.rpartition(".")[0] or ("energy" if column.unit == "J" else column.name)
        groups.setdefault((stem, column.unit), []).append(column.name)
    return groups


def _difference(tables, other, names):
    """The largest distance of table `other` from the first table, relative to the first's largest magnitude. Evaluated
    at the first's times within the span of the other."""
    first, second = tables[0], tables[other]
    shared = (first.axis.values >= second.axis.values[0]) & (first.axis.values <= second.axis.values[-1])
    if not shared.any():
        return np.nan
    a = np.array([first[n].values[shared] for n in names])
    b = np.array([np.interp(first.axis.values[shared], second.axis.values, second[n].values) for n in names])
    largest = np.linalg.norm(a, axis=0).max()
    return np.linalg.norm(a - b, axis=0).max() / largest if largest > 0 else np.nan


def _draw_file(tables, labels, path):
    groups = {key: [n for n in names if all(n in t for t in tables)] for key, names in _groups(tables[0]).items()}
    groups = {key: names for key, names in groups.items() if names}
    if not groups:
        raise DrawError(f"{tables[0].path}: the results have no common column")
    figure, axes = panels([2.2] * len(groups), right=1.9)
    time_axis(axes[-1], np.concatenate([t.axis.values for t in tables]), tables[0].axis.unit, tables[0].axis.name)
    factor = prefix(tables[0].axis.unit, max(np.abs(t.axis.values).max() for t in tables))[0]
    axes[-1].set_xlim(min(t.axis.values[0] for t in tables) / factor, max(t.axis.values[-1] for t in tables) / factor)
    for panel, ((stem, unit), names) in zip(axes, groups.items()):
        scale, shown = prefix(unit, max(np.nanmax(np.abs(t[n].values)) for t in tables for n in names))
        for k, name in enumerate(names):
            for table, look in zip(tables, LOOKS):
                panel.plot(table.axis.values / factor, table[name].values / scale, color=COLOURS[k % len(COLOURS)],
                           **look)
        panel.set_ylabel(f"[{shown}]" if shown else "")
        handles = [Line2D([], [], color=COLOURS[k % len(COLOURS)], label=n.rpartition(".")[2])
                   for k, n in enumerate(names)]
        handles += [Line2D([], [], color="#6b7280", label=label, **look) for label, look in zip(labels, LOOKS)]
        panel.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7.5)
        apart = ", ".join(f"{_difference(tables, k, names):.2g}" for k in range(1, len(tables)))
        title(panel, stem.replace("_", " "), f"apart by at most {apart} of the first's largest value")
    return save(figure, path)


def draw_comparison(names, out):
    """Draws a picture for each table that all results have into the folder `out`; yields the paths."""
    if not 2 <= len(names) <= len(STYLES):
        raise DrawError(f"compare: expected 2 to {len(STYLES)} results, found {len(names)}")
    folders = [result_folder(name) for name in names]
    drawn = 0
    for file in FILES:
        if all((folder / file).is_file() for folder in folders):
            tables = [Table(folder / file) for folder in folders]
            if len({t.axis.name for t in tables}) > 1:
                raise DrawError(f"{file}: static and dynamic analyses cannot be compared")
            yield _draw_file(tables, names, out / f"compare_{file.removesuffix('.csv')}.png")
            drawn += 1
    if not drawn:
        raise DrawError(f"compare: none of the files {', '.join(FILES)} is in all of {', '.join(names)}")
