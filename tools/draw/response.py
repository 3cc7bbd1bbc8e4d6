"""Amplitude and phase over the frequency, from the response.csv of a harmonic analysis."""
import csv

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from .chart import COLOURS, panels, title
from .curves import by_vector
from .errors import DrawError
from .style import FAINT, save
from .table import Table
from .units import prefix

HIDDEN = 1e-3  # components whose largest amplitude is below this share of the largest of their vector are left out
WIDE = 4       # ratio of the highest to the lowest frequency from which the axis is logarithmic


def has_response(folder):
    return (folder / "response.csv").is_file()


def _natural_frequencies(folder):
    path = folder / "modes.csv"
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [float(row["frequency [Hz]"]) for row in csv.DictReader(file)]


def _that_answer(columns):
    largest = max(np.nanmax(column.values) for column in columns)
    if not largest > 0:
        return []
    return [column for column in columns if np.nanmax(column.values) >= HIDDEN * largest]


def _draw_amplitude(axes, frequencies, name, columns):
    shown = _that_answer(columns)
    if not shown:
        raise DrawError(f"{name}: the amplitude is zero at all frequencies")
    factor, unit = prefix(columns[0].unit, max(np.nanmax(column.values) for column in shown))
    for column in shown:
        k = columns.index(column)
        axes.plot(frequencies, column.values / factor, color=COLOURS[k % len(COLOURS)], lw=1.4,
                  label=column.name.rpartition(".")[2])
    axes.set_yscale("log")
    unit = unit.replace("^2", "²")
    axes.set_ylabel(f"amplitude [{unit}]" if unit and unit != "1" else "amplitude")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    title(axes, name.replace("_", " "))
    return max(shown, key=lambda column: np.nanmax(column.values))


def _draw_phase(axes, frequencies, table, column):
    axes.plot(frequencies, table[column.name + ".phase"].values, color=FAINT, lw=1.1)
    axes.set_ylim(-190, 190)
    axes.set_yticks([-180, -90, 0, 90, 180])
    axes.set_ylabel(f"phase of {column.name.rpartition('.')[2]} [°]")


def draw_response(folder, path):
    """Two panels for each probed field: the amplitudes of its components, and the phase of the largest. Vertical lines
    are natural frequencies."""
    table = Table(folder / "response.csv")
    groups = by_vector([column for column in table.others() if not column.name.endswith(".phase")])
    if table.axis.name != "frequency" or not groups:
        raise DrawError(f"{folder / 'response.csv'}: not a response of a harmonic analysis")
    figure, axes = panels([2.6, 1.1] * len(groups), right=0.9)
    frequencies = table.axis.values
    for ((name, _), columns), amplitude, phase in zip(groups.items(), axes[::2], axes[1::2]):
        _draw_phase(phase, frequencies, table, _draw_amplitude(amplitude, frequencies, name, columns))
    for natural in _natural_frequencies(folder):
        if frequencies[0] <= natural <= frequencies[-1]:
            for panel in axes:
                panel.axvline(natural, color=FAINT, lw=0.5, alpha=0.5, zorder=0)
    axes[-1].set_xlabel("frequency [Hz]; vertical lines: natural frequencies")
    axes[-1].set_xlim(frequencies[0], max(frequencies[-1], frequencies[0] * 1.001))
    if frequencies[-1] >= WIDE * frequencies[0]:
        axes[-1].set_xscale("log")
        axes[-1].xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes[-1].xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes[-1].xaxis.set_minor_formatter(NullFormatter())
    return save(figure, path)
