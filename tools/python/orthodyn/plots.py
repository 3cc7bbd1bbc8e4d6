"""Plots of result tables."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .draw.table import Table


def new_axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    from matplotlib import pyplot
    return pyplot.subplots(figsize=(7, 4), layout="constrained")[1]


def plot_table(table: Table, columns: str | list[str] | None, ax: Axes | None) -> Axes:
    """Plots columns that have the same unit over the first column. By default: all columns with the unit of the
    second."""
    columns = [columns] if isinstance(columns, str) else columns
    for name in columns or ():
        if name not in table:
            raise KeyError(f"no column '{name}'; there are {', '.join(c.name for c in table.others())}")
    chosen = [table[name] for name in columns] if columns else table.others()
    units = sorted({column.unit for column in chosen})
    if len(units) > 1 and columns is None:
        chosen = [column for column in chosen if column.unit == chosen[0].unit]
    elif len(units) > 1:
        raise ValueError(f"columns with different units, {', '.join(units)}: plot them separately")
    ax = new_axes(ax)
    for column in chosen:
        ax.plot(table.axis.values, column.values, label=column.name)
    ax.set_xlabel(f"{table.axis.name} [{table.axis.unit}]" if table.axis.unit else table.axis.name)
    ax.set_ylabel(chosen[0].unit)
    ax.legend(frameon=False)
    return ax
