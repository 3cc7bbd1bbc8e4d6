"""Energies, steps, probes and momentum over time."""
import json

import numpy as np
from matplotlib.lines import Line2D

from .chart import COLOURS, draw_lines, panels, time_axis, title
from .errors import DrawError
from .series import analysis
from .style import FAINT, save
from .table import Column, Table

ENERGY_STYLE = {"kinetic": {"color": COLOURS[0]}, "elastic": {"color": COLOURS[1]},
                "gravitational": {"color": COLOURS[2]}, "dissipated": {"color": COLOURS[3]},
                "loads": {"color": COLOURS[4]}, "balance": {"color": "#c0392b"},
                "total": {"color": "#22252b", "ls": (0, (4, 2)), "lw": 1.1}}
ORDER_COLOURS = ("#5b2a86", "#3f7fd1", "#17a398", "#7cc344", "#e0b000", "#d1622b", "#8c564b")
REJECTED = "#c0392b"


def _y_label(axes, quantity, unit):
    unit = unit.replace("^2", "²").replace("^3", "³")
    axes.set_ylabel(f"{quantity} [{unit}]".strip() if unit and unit != "1" else quantity)


def _stored_total(table):
    parts = [table[n] for n in ("kinetic", "elastic", "gravitational") if n in table]
    return [Column("total", parts[0].unit, sum(p.values for p in parts))] if len(parts) > 1 else []


def relative_drift(table):
    """The largest change of the energy balance, relative to the largest kinetic or elastic energy. Taken from run.json,
    as in the run's summary, because the run evaluated more states than it wrote; without run.json, from the table."""
    try:
        energy = json.loads((table.path.parent / "run.json").read_text(encoding="utf-8"))["energy"]
        drift, scale = float(energy["balance_drift"]), float(energy["scale"])
    except (OSError, ValueError, KeyError, TypeError):
        drift = np.nanmax(np.abs(table["balance"].values))
        scale = max((np.nanmax(table[n].values) for n in ("kinetic", "elastic") if n in table), default=0.0)
    return drift / scale if scale > 0 else 0.0


def draw_energy(table, path):
    """Draws the energies that are not always zero. The error of the balance has its own scale."""
    energies = [c for c in table.others() if c.name != "balance"] + _stored_total(table)
    if not energies:
        energies = table.others()
    moving = [c for c in energies if np.any(c.values)]
    quiet = [c.name for c in energies if not np.any(c.values)] if moving else []
    energies = moving or energies
    with_balance = "balance" in table
    figure, axes = panels([3.2, 1.25] if with_balance else [3.2])
    times = time_axis(axes[-1], table.axis.values, table.axis.unit, table.axis.name)
    unit = draw_lines(axes[0], times, energies, ENERGY_STYLE)
    _y_label(axes[0], "energy", unit)
    title(axes[0], "Energy", f"zero throughout: {', '.join(quiet)}" if quiet else "")
    if with_balance:
        balance = table["balance"]
        axes[1].axhline(0, color=FAINT, lw=0.7)
        _y_label(axes[1], "balance", draw_lines(axes[1], times, [balance], ENERGY_STYLE, lambda column: ""))
        title(axes[1], "Balance (zero when exact)", f"largest: {relative_drift(table):.3g} of the largest energy")
    return save(figure, path)


def _draw_steps(axes, times, table):
    h = table["h"].values
    order = table["order"].values if "order" in table else np.ones(len(h))
    rejected = np.nan_to_num(table["rejected"].values) > 0 if "rejected" in table else np.zeros(len(h), bool)
    dots = 9 if len(h) < 400 else 4
    axes.semilogy(times, h, color="#c5cad3", lw=0.8, drawstyle="steps-pre", zorder=1)
    key = []
    for k in np.unique(order[np.isfinite(order)]).astype(int):
        colour = ORDER_COLOURS[(k - 1) % len(ORDER_COLOURS)]
        axes.scatter(times[order == k], h[order == k], s=dots, color=colour, linewidths=0, zorder=2)
        key.append(Line2D([], [], ls="", marker="o", ms=4, color=colour, label=f"order {k}"))
    if rejected.any():
        axes.scatter(times[rejected], h[rejected], s=34, marker="x", color=REJECTED, linewidths=1.2, zorder=3)
        key.append(Line2D([], [], ls="", marker="x", ms=5, color=REJECTED, label="after rejection"))
    axes.legend(handles=key if "order" in table else key[1:], loc="center left", bbox_to_anchor=(1.0, 0.5),
                handletextpad=0.2)
    title(axes, "Step size", f"{len(h)} steps, {int(rejected.sum())} of them after a rejected attempt")


def draw_steps(table, path):
    """Draws step sizes, orders and Newton iterations. The column `rejected` counts failed attempts before a step."""
    effort = "newton_iterations" in table
    figure, axes = panels([3.0, 1.1] if effort else [3.0])
    t = table.axis
    times = time_axis(axes[-1], t.values, t.unit, t.name, start=t.values[0] - np.nan_to_num(table["h"].values[0]))
    _draw_steps(axes[0], times, table)
    _y_label(axes[0], "h", table["h"].unit)
    if effort:
        iterations = table["newton_iterations"].values
        axes[1].vlines(times, 0, iterations, color=COLOURS[0], lw=float(np.clip(250 / len(times), 0.4, 1.6)))
        axes[1].set_ylim(0, max(1.0, np.nanmax(iterations)) * 1.1)
        axes[1].yaxis.get_major_locator().set_params(integer=True)
        axes[1].set_ylabel("iterations")
        title(axes[1], "Newton iterations per step", f"mean {np.nanmean(iterations):.2f}")
    return save(figure, path)


def by_vector(columns):
    """Groups columns by panel: those whose names differ only in the last part (.x, .y, .z)."""
    groups = {}
    for column in columns:
        groups.setdefault((column.name.rpartition(".")[0] or column.name, column.unit), []).append(column)
    return groups


def draw_components(table, path):
    """Draws probes or momentum: one panel per vector, one line per component."""
    groups = by_vector(table.others())
    longest = max(len(c.name.rpartition(".")[2]) for c in table.others())
    figure, axes = panels([1.7 if len(groups) > 1 else 3.0] * len(groups), right=0.45 + 0.08 * longest)
    times = time_axis(axes[-1], table.axis.values, table.axis.unit, table.axis.name)
    for panel, ((stem, _), columns) in zip(axes, groups.items()):
        unit = draw_lines(panel, times, columns, name=lambda column: column.name.rpartition(".")[2])
        _y_label(panel, "", unit)
        title(panel, "linear momentum" if stem == "linear" else "angular momentum" if stem == "angular" else
              stem.replace("_", " "))
    return save(figure, path)


CURVES = {"energy": draw_energy, "steps": draw_steps, "probes": draw_components, "momentum": draw_components}

MOTION = ("energy", "steps", "momentum")  # files of motions only
INSTEAD = {"static": "draw the load path (draw load), its probes (draw probes) or a frame (draw frame)",
           "buckling": "draw its shapes (draw modes)",
           "harmonic": "draw its response (draw response) or its modes (draw modes)"}


def draw_curve(kind, folder, path):
    """Draws the curve `kind` from FOLDER/KIND.csv."""
    found = analysis(folder)
    if kind in MOTION and found in INSTEAD and not (folder / f"{kind}.csv").is_file():
        raise DrawError(f"{folder}: no {kind} over time: a {found} analysis has no motion; {INSTEAD[found]}")
    return CURVES[kind](Table(folder / f"{kind}.csv"), path)
