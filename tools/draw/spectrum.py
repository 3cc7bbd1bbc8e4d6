"""Amplitude spectra of probed values, from the probes.csv of a motion."""
import numpy as np

from .chart import COLOURS, panels, title
from .curves import by_vector
from .errors import DrawError
from .style import save
from .table import Table
from .units import prefix

UNEVEN = 1e-6     # largest accepted deviation of the intervals, relative to their mean
FEWEST = 8        # rows
SHOWN = 1e-4      # share of the largest amplitude down to which the axis reaches


def amplitude_spectrum(times, values):
    """Frequencies (Hz) and amplitudes of a real signal at equal intervals: a sine has its own amplitude at its frequency.
    The mean is left out, and a Hann window keeps peaks apart."""
    window = np.hanning(len(values))
    mean = np.average(values, weights=window)
    amplitudes = 2 * np.abs(np.fft.rfft((values - mean) * window)) / window.sum()
    if len(values) % 2 == 0:
        amplitudes[-1] /= 2  # half the sampling frequency has no partner
    return np.fft.rfftfreq(len(values), (times[-1] - times[0]) / (len(times) - 1)), amplitudes


def _require_even(path, times):
    if len(times) < FEWEST:
        raise DrawError(f"{path}: {len(times)} rows are too few for a spectrum; give output.history.interval")
    steps = np.diff(times)
    if np.abs(steps - steps.mean()).max() > UNEVEN * steps.mean():
        raise DrawError(f"{path}: a spectrum needs rows at equal intervals: set output: {{history: {{interval: ...}}}}")


def draw_spectrum(folder, path):
    """One panel for each probed vector, with one line for each component. Ends at half the sampling frequency."""
    table = Table(folder / "probes.csv")
    times = table.axis.values
    if table.axis.name != "t":
        raise DrawError(f"{folder}: a spectrum needs a motion over time")
    _require_even(folder / "probes.csv", times)
    groups = by_vector(table.others())
    figure, axes = panels([2.4] * len(groups), right=0.9)
    for panel, ((name, unit), columns) in zip(axes, groups.items()):
        spectra = [amplitude_spectrum(times, column.values) for column in columns]
        largest = max(amplitudes.max() for _, amplitudes in spectra)
        factor, unit = prefix(unit, largest)
        for k, (column, (frequencies, amplitudes)) in enumerate(zip(columns, spectra)):
            panel.plot(frequencies, amplitudes / factor, color=COLOURS[k % len(COLOURS)], lw=1.2,
                       label=column.name.rpartition(".")[2])
        if largest > 0:
            panel.set_yscale("log")
            panel.set_ylim(SHOWN * largest / factor, 2 * largest / factor)
        unit = unit.replace("^2", "²")
        panel.set_ylabel(f"amplitude [{unit}]" if unit and unit != "1" else "amplitude")
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        title(panel, name.replace("_", " "))
    resolution = 1 / (times[-1] - times[0])
    axes[-1].set_xlabel(f"frequency [Hz]; resolution {resolution:.3g} Hz")
    axes[-1].set_xlim(0, 0.5 * (len(times) - 1) * resolution)
    return save(figure, path)
