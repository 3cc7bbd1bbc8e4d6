"""Pages: one frame, or several side by side, with one colour bar, scale bar and triad below."""
import math

import numpy as np

from . import annotations
from .style import DPI, pyplot, save

TOP, BOTTOM, SIDE = 0.42, 0.78, 0.22  # inches around the body
BUDGET = 14000  # largest number of small triangles on a page


def _page(scene, columns, rows, panel, indices, budget=BUDGET):
    """A figure with rows x columns panels of the size `panel` (inches), each with its time above."""
    width = columns * panel[0] + (columns + 1) * SIDE
    height = rows * (panel[1] + TOP) + BOTTOM
    figure = pyplot.figure(figsize=(width, height))
    page = annotations.page(figure)
    xlim, ylim = scene.window.fitted(*panel)
    for k, index in enumerate(indices):
        row, column = divmod(k, columns)
        left = SIDE + column * (panel[0] + SIDE)
        low = BOTTOM + (rows - 1 - row) * (panel[1] + TOP)
        axes = figure.add_axes([left / width, low / height, panel[0] / width, panel[1] / height], xlim=xlim, ylim=ylim)
        axes.axis("off")
        scene.draw(axes, index, budget // min(len(indices), 3))
        annotations.time_label(page, left, low + panel[1] + 0.13, scene.labels[index],
                             scene.note if k == columns - 1 else "")
    annotations.triad(page, scene.camera, SIDE + 0.34, 0.30)
    annotations.scale_bar(page, SIDE + 0.98, 0.28, (xlim[1] - xlim[0]) / panel[0])
    annotations.colour_bar(page, scene.colouring, width - SIDE - 0.08, 0.27, min(3.0, width - 3.0))
    return figure


def _one_panel(aspect):
    """Size (inches) of a panel with width / height = aspect: the largest that fits into 8 by about 6 inches."""
    width, tallest = 8 - 2 * SIDE, 5.6
    if width / aspect <= tallest:
        return width, max(width / aspect, 1.6)
    return min(max(tallest * aspect, 5.4), width), tallest


def frame_figure(scene, index, size=None, budget=BUDGET):
    """A figure of one frame. `size` in inches; the default depends on the body's shape."""
    panel = _one_panel(scene.window.size[0] / scene.window.size[1])
    if size:
        panel = size[0] - 2 * SIDE, size[1] - TOP - BOTTOM
    return _page(scene, 1, 1, panel, [index], budget)


def draw_frame(scene, index, path, size_px=None):
    size = [pixels / DPI for pixels in size_px] if size_px else None
    return save(frame_figure(scene, index, size), path)


def strip_columns(count, aspect):
    """Number of columns for which the grid is close to a 16:9 page and has few empty panels."""
    def cost(columns):
        rows = math.ceil(count / columns)
        page = columns * aspect / rows
        return abs(math.log(page / 1.8)) + 0.9 * (rows * columns - count) / count
    return min(range(1, count + 1), key=cost)


def _panel(columns, aspect):
    """Size (inches) of one of several panels side by side."""
    page_width = 10.0 if columns > 1 else 8.0
    width = (page_width - (columns + 1) * SIDE) / columns
    return width, float(np.clip(width / aspect, 0.5, 5.5))


def draw_page(scene, columns, indices, path):
    """Draws the frames `indices` row by row in `columns` columns."""
    aspect = scene.window.size[0] / scene.window.size[1]
    return save(_page(scene, columns, math.ceil(len(indices) / columns), _panel(columns, aspect), indices), path)


def draw_strip(scene, indices, path):
    return draw_page(scene, strip_columns(len(indices), scene.window.size[0] / scene.window.size[1]), indices, path)
