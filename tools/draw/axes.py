"""Material axes of a body: strokes along axis 1 on its surface, and axes 1 and 2 in two sections."""
import math

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb

from . import annotations
from .body import INK, Paint, add_body, front_faces
from .camera import Camera, Window
from .errors import DrawError, unknown
from .grain import FIELD, SPACING as STROKE_SPACING, Grain
from .slicing import Section
from .style import FAINT, pyplot, save
from .surface import Surface, unit
from .units import prefix

SPACING = 0.13  # inches between strokes in a section
SIDE, TITLE, FOOT = 0.25, 0.34, 0.48  # inches: between panels, above a panel, and below it for the scale bar
LEGEND = 0.62
BUDGET = 14000
END_GRAIN = 0.25  # sine of the angle between axis 1 and the line of sight, below which axis 1 is drawn as a dot
WHITE = np.ones(3)


def direction_colours(axis):
    """RGB (n,3) of directions: red for x, green for y and blue for z, mixed in proportion to the squared components."""
    return unit(axis) ** 2 @ np.array([to_rgb(c) for c in annotations.AXIS_COLOURS])


def paler(rgb, part):
    return (1 - part) * rgb + part


class _CellColours:
    """A Colouring whose values are indices of cells."""

    def __init__(self, rgb):
        self.rgb = rgb

    def __call__(self, values):
        return self.rgb[np.rint(values).astype(int)]


class Axes:
    """A body with its material axes, and three views of it."""

    def __init__(self, path, frame, at=None, view=(-60.0, 20.0)):
        if not len(frame.tets):
            raise DrawError(f"{path}: no tetrahedra to draw")
        for name in ("axis_1", "axis_2"):
            if name not in frame.cell_fields or frame.cell_fields[name].shape[1] != 3:
                raise unknown("field", name, list(frame.cell_fields))
        self.frame, self.points = frame, frame.points
        self.axes = [unit(frame.cell_fields[f"axis_{k}"].astype(float)) for k in (1, 2)]
        frame.cell_fields[FIELD] = self.axes[0]
        self.surface = Surface(self.points, frame.tets, frame.cell_edges())
        self.colours = _CellColours(paler(direction_colours(self.axes[0]), 0.35))
        low, high = self.points[self.surface.nodes].min(axis=0), self.points[self.surface.nodes].max(axis=0)
        digit = 10.0 ** (np.floor(np.log10(high - low)) - 2)  # rounded for the label
        self.at = np.round((low + high) / 2 / digit) * digit if at is None else np.array(at)
        if not ((low <= self.at) & (self.at <= high)).all():
            raise DrawError(f"--at {','.join(f'{v:g}' for v in self.at)} is outside of the body, which extends from "
                            f"{','.join(f'{v:g}' for v in low)} to {','.join(f'{v:g}' for v in high)} m")
        longest = int(np.argmax(high - low))
        lengthwise = min((i for i in (1, 0, 2) if i != longest), key=lambda i: round(high[i] - low[i], 12))
        self.panels = [_Surface(self, Camera(*view)), _Cut(self, lengthwise), _Cut(self, longest)]
        for cut in self.panels[1:]:
            self.panels[0].mark(cut.section)


class _Surface:
    title = "surface"

    def __init__(self, body, camera):
        self.body, self.camera, self.window = body, camera, Window()
        self.window.include(camera.flat(body.points[body.surface.nodes]))
        self.marks = []

    def mark(self, section):
        seen = front_faces(self.body.surface, self.camera.flat(self.body.points))[section.face]
        self.marks.append(section.outline[seen])

    def draw(self, axes, metres_per_inch):
        body, camera = self.body, self.camera
        paint = Paint()
        cells = np.repeat(body.surface.cell[:, None], 3, axis=1).astype(float)
        add_body(paint, body.surface, body.points, cells, body.colours, camera, BUDGET)
        grain = Grain(body.surface, body.points, STROKE_SPACING * metres_per_inch)
        grain.add(paint, body.frame, body.points, cells, body.colours, camera)
        for outline in filter(len, self.marks):
            flat = camera.flat(outline)
            longest = np.linalg.norm(outline[:, 1] - outline[:, 0], axis=1).max()  # in front of the faces it crosses
            paint.add_segments(flat[:, 0], flat[:, 1], camera.depth(outline.mean(axis=1)) + longest, WHITE, 1.2)
        paint.draw(axes)


class _Cut:
    """The section normal to a coordinate axis, seen from the axis' positive side (for y: from its negative side)."""
    VIEWS = ((0.0, 0.0), (-90.0, 0.0), (-90.0, 90.0))

    def __init__(self, body, axis):
        self.body, self.camera = body, Camera(*self.VIEWS[axis])
        self.section = Section(body.points, body.frame.tets, body.surface, body.at, np.eye(3)[axis])
        factor, name = prefix("m", float(np.abs(body.points).max()))
        self.title = f"section at {'xyz'[axis]} = {body.at[axis] / factor + 0.0:.4g} {name}"
        self.window = Window()
        self.window.include(self.camera.flat(self.section.outline).reshape(-1, 2))

    def draw(self, axes, metres_per_inch):
        flat = self.camera.flat(self.section.triangles)
        rgb = self.body.colours(self.section.cell)
        axes.add_collection(PolyCollection(flat, facecolors=rgb, edgecolors=rgb, linewidths=0.3), autolim=False)
        axes.add_collection(LineCollection(self.camera.flat(self.section.outline), colors=[INK], linewidths=0.9),
                            autolim=False)
        spacing = STROKE_SPACING * metres_per_inch
        places = self._places(spacing)
        found = self.section.find(flat, places)
        places, cells = places[found >= 0], self.section.cell[found[found >= 0]]
        for axis, colour, length, width, order in ((1, WHITE, 0.62, 1.0, 3), (0, INK, 0.80, 0.8, 4)):
            along = self.camera.flat(self.body.axes[axis][cells])
            on_end = (axis == 0) & (np.linalg.norm(along, axis=1) < END_GRAIN)
            along = np.where(on_end[:, None], [[0.03, 0]], along) * (length * spacing / 2)  # no length, no dot
            ends = places - along, places + along
            axes.add_collection(LineCollection(np.stack(ends, axis=1), colors=[colour], capstyle="round", zorder=order,
                                               linewidths=np.where(on_end, 1.6, width)), autolim=False)

    def _places(self, spacing):
        """Points of a staggered grid over the window."""
        low, high = self.window.low, self.window.high
        rows = np.arange(low[1] + spacing / 2, high[1], spacing * math.sqrt(0.75))
        columns = np.arange(low[0] - spacing, high[0] + spacing, spacing)
        middle = (low[0] + high[0]) / 2
        columns = columns - columns.mean() + middle
        return np.concatenate([np.stack([columns + (k % 2) * spacing / 2, np.full(len(columns), y)], axis=1)
                               for k, y in enumerate(rows)]) if len(rows) else np.empty((0, 2))


def _panel_sizes(panels):
    """Size (inches) of each panel. For tall bodies the panels have the same height and are side by side, else they are
    one above the other."""
    aspects = [panel.window.size[0] / panel.window.size[1] for panel in panels]
    tall = aspects[1] < 1.25
    if tall:
        height = 5.0
        sizes = [(float(np.clip(height * a, 1.9, 5.0)), height) for a in aspects[:2]]
    else:
        sizes = [(7.6, float(np.clip(7.6 / a, 1.0, 4.4))) for a in aspects[:2]]
    longest = 3.4 if tall else 2.4
    across = (longest, longest / aspects[2]) if aspects[2] > 1 else (longest * aspects[2], longest)
    return tall, [*sizes, (max(across[0], 1.9), max(across[1], 0.8))]


def _figure(body):
    tall, sizes = _panel_sizes(body.panels)
    extra = TITLE + FOOT
    if tall:
        width = sum(s[0] for s in sizes) + 4 * SIDE
        height = max(s[1] for s in sizes) + extra + LEGEND
        lows = [(SIDE + sum(s[0] + SIDE for s in sizes[:k]), height - TITLE - s[1]) for k, s in enumerate(sizes)]
    else:
        width = sizes[0][0] + 2 * SIDE
        height = sum(s[1] + extra for s in sizes) + LEGEND
        lows = [(SIDE, height - sum(t[1] + extra for t in sizes[:k]) - TITLE - s[1]) for k, s in enumerate(sizes)]
    figure = pyplot.figure(figsize=(width, height))
    page = annotations.page(figure)
    for panel, size, (x, y) in zip(body.panels, sizes, lows):
        xlim, ylim = panel.window.fitted(*size)
        axes = figure.add_axes([x / width, y / height, size[0] / width, size[1] / height], xlim=xlim, ylim=ylim)
        axes.axis("off")
        metres_per_inch = (xlim[1] - xlim[0]) / size[0]
        panel.draw(axes, metres_per_inch)
        page.text(x, y + size[1] + 0.10, panel.title, ha="left", va="baseline", fontsize=10, weight="bold")
        annotations.triad(page, panel.camera, x + 0.14, y - 0.38, 0.2)
        annotations.scale_bar(page, x + 0.55, y - 0.38, metres_per_inch, min(1.1, 0.5 * size[0]))
    _legend(page, width)
    return figure


def _legend(page, width):
    y = 0.30
    page.plot([SIDE, SIDE + 0.28], [y, y], color=INK, lw=1.2, solid_capstyle="round")
    page.text(SIDE + 0.36, y, "axis 1", va="center", fontsize=8.5)
    page.plot([SIDE + 0.95, SIDE + 1.23], [y, y], color="#9aa0aa", lw=3.0, solid_capstyle="butt")
    page.plot([SIDE + 0.99, SIDE + 1.19], [y, y], color="white", lw=1.4, solid_capstyle="round")
    page.text(SIDE + 1.31, y, "axis 2 (sections)", va="center", fontsize=8.5)
    page.text(SIDE, y - 0.20, "dot or short: out of the plane; white lines on the surface: where the sections are",
              va="center", fontsize=7.5, color=FAINT)
    x = SIDE + 2.75
    page.text(x, y, "axis 1 along", va="center", fontsize=8.5)
    for k, name in enumerate("xyz"):
        colour = paler(np.array(to_rgb(annotations.AXIS_COLOURS[k])), 0.35)
        page.add_patch(pyplot.Rectangle((x + 0.85 + 0.42 * k, y - 0.075), 0.15, 0.15, facecolor=colour,
                                        edgecolor="none"))
        page.text(x + 1.06 + 0.42 * k, y, name, va="center", fontsize=8.5)


def draw_axes(path, frame, out, at=None, view=(-60.0, 20.0)):
    return save(_figure(Axes(path, frame, at, view)), out)
