"""Load factor over displacement of a static analysis, from its probes.csv or load_steps.csv."""
import json

import numpy as np
from matplotlib.lines import Line2D

from .chart import COLOURS, panels, title
from .errors import DrawError
from .series import analysis, is_static
from .style import save
from .table import Table
from .units import prefix

FILES = ("probes.csv", "load_steps.csv")


def has_load_path(folder):
    return is_static(folder) and any((folder / name).is_file() for name in FILES)


def _displacements(folder):
    """The load factors, and the displacements at the probes or, without probes, the largest one."""
    for name in FILES:
        if not (folder / name).is_file():
            continue
        table = Table(folder / name)
        columns = [c for c in table.others() if "displacement" in c.name]
        if columns and table.axis.name == "load_factor":
            return table["load_factor"].values, columns
    raise DrawError(f"{folder}: no displacements in {' or '.join(FILES)}; is it a static analysis?")


def _panels_of(columns):
    """(name, columns) of each probe."""
    groups = {}
    for column in columns:
        probe, _, component = column.name.rpartition(".")
        vector = probe.endswith("displacement")
        groups.setdefault(probe.removesuffix(".displacement") if vector else "", []).append(
            (component if vector else column.name.replace("_", " "), column))
    return groups


def _that_move(lines):
    """The lines except those that are negligible relative to the largest."""
    largest = max(abs(column.values).max() for _, column in lines)
    return [(name, column) for name, column in lines if abs(column.values).max() >= 1e-3 * largest]


def _critical(folder):
    """Critical points as (kind, load factor), and whether the path jumped at one of them."""
    try:
        record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except (OSError, json.JSONDecodeError):
        return [], False
    points = [(p["kind"], p["load_factor"]) for p in record.get("critical_points", [])]
    return points, record.get("jumps", 0) > 0


def _jumps(factors, critical, jumped):
    """Indices at which the steps start that jump to another path."""
    levels = [factor for kind, factor in critical if kind != "sharp turn"] if jumped else []
    return [i for i in range(len(factors) - 1) if any(factors[i] < level <= factors[i + 1] for level in levels)]


def _plot_path(panel, x, factors, jumps, colour):
    """Draws the path, dotted where the body jumped."""
    after = [i + 1 for i in jumps]
    panel.plot(np.insert(x, after, np.nan), np.insert(factors, after, np.nan), marker="o", ms=3, lw=1.3, color=colour)
    for i in jumps:
        panel.plot(x[i:i + 2], factors[i:i + 2], lw=1, ls=":", color=colour)


def _require_static(folder):
    """Raises DrawError for a motion. Without run.json, the tables show whether it is one."""
    kind = analysis(folder)
    if (folder / "run.json").is_file() and kind != "static":
        raise DrawError(f"{folder}: no load path: not a static analysis; "
                        + ("draw its shapes (draw modes)" if kind == "buckling" else
                           "draw its probes (draw probes) or energies (draw energy) over time"))


def draw_load_path(folder, path):
    _require_static(folder)
    factors, columns = _displacements(folder)
    critical, jumped = _critical(folder)
    jumps = _jumps(factors, critical, jumped)
    groups = _panels_of(columns)
    figure, axes = panels([2.6] * len(groups), sharex=False)
    for panel, (probe, all_lines) in zip(axes, groups.items()):
        lines = _that_move(all_lines)
        factor, unit = prefix("m", max(abs(c.values).max() for _, c in lines))
        for k, (_, column) in enumerate(lines):
            _plot_path(panel, column.values / factor, factors, jumps, COLOURS[k])
        for kind, level in critical:
            panel.axhline(level, color="#6b7280", lw=0.8, ls=(0, (6, 3)))
            panel.annotate(f"{kind} {level:.4g}", (0.01, level), xycoords=panel.get_yaxis_transform(), fontsize=7,
                           color="#6b7280", va="bottom")
        panel.set_xlabel(f"displacement [{unit}]")
        panel.set_ylabel("load factor")
        panel.legend(handles=[Line2D([], [], color=COLOURS[k], marker="o", ms=3, label=name)
                              for k, (name, _) in enumerate(lines)], loc="center left", bbox_to_anchor=(1.0, 0.5))
        title(panel, f"Load over displacement{f' of {probe}' if probe else ''}", f"{len(factors) - 1} load steps")
    return save(figure, path)
