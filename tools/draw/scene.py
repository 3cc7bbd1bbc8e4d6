"""Surface, camera, colour range and window, shared by all frames of a picture."""
from dataclasses import dataclass

import numpy as np

from .body import Paint, add_body, draw_ghost
from .camera import Camera, Window
from .colouring import Colouring
from .errors import DrawError
from .grain import SPACING, Grain
from .quantity import find_quantity
from .series import is_static
from .surface import Surface
from .units import load_factor_labels, time_labels


@dataclass(frozen=True)
class PictureSpec:
    """The user's options for a picture of the body."""
    color: str = None
    view: tuple = (-60.0, 20.0)
    up: str = "z"
    scale: float = 1.0
    grain: bool = False
    ghost: bool = False
    limits: tuple = None


class Scene:
    """What all frames of a picture share. Made from all frames to be drawn, so that they can be compared."""

    def __init__(self, series, indices, spec):
        self.series, self.spec, self.camera = series, spec, Camera(*spec.view, spec.up)
        first = series.frame(indices[0])
        if not len(first.tets):
            raise DrawError(f"{series.paths[indices[0]]}: no tetrahedra to draw")
        self.surface = Surface(first.points, first.tets, first.cell_edges())
        labels = load_factor_labels if is_static(series.folder) else time_labels
        self.labels = dict(zip(indices, labels([series.times[i] for i in indices])))
        self._shape = first.points.shape, first.tets.shape
        self.quantity = find_quantity(spec.color, first)
        self._grain = None
        self.window, samples = Window(), []
        for index in indices:
            frame = self._frame(index)
            self.window.include(self.camera.flat(self.positions(frame)[self.surface.nodes]))
            samples.append(self.corner_values(frame).ravel())
        if spec.ghost:
            self.window.include(self.camera.flat(first.points[self.surface.nodes]))
        self.colouring = Colouring(self.quantity, samples, spec.limits)

    def _frame(self, index):
        frame = self.series.frame(index)
        if (frame.points.shape, frame.tets.shape) != self._shape:
            raise DrawError(f"{self.series.paths[index]}: another mesh than in the first frame")
        return frame

    def positions(self, frame):
        moved = frame.node_fields.get("displacement")
        points = frame.points if moved is None else frame.points + self.spec.scale * moved
        if not np.isfinite(points).all():
            raise DrawError("a displacement is not finite: the run has diverged; choose an earlier --time")
        return points

    def corner_values(self, frame):
        return self.surface.corner_values(self.quantity.values(frame), self.quantity.on_nodes)

    def _grain_on(self, axes, rest):
        """The strokes of axis 1. They are computed once, because all panels have the same size."""
        if self._grain is None:
            inches = axes.get_position().width * axes.figure.get_size_inches()[0]
            self._grain = Grain(self.surface, rest, SPACING * np.ptp(axes.get_xlim()) / inches)
        return self._grain

    @property
    def note(self):
        return "" if self.spec.scale == 1 else f"deformation × {self.spec.scale:g}"

    def add_lines(self, paint, points, values):
        """Derived classes draw further lines on the body here."""

    def draw(self, axes, index, budget):
        """Draws the body at frame `index`; the limits of the axes must be set."""
        frame = self._frame(index)
        points = self.positions(frame)
        values = self.corner_values(frame)
        paint = Paint()
        add_body(paint, self.surface, points, values, self.colouring, self.camera, budget)
        if self.spec.grain:
            self._grain_on(axes, frame.points).add(paint, frame, points, values, self.colouring, self.camera)
        self.add_lines(paint, points, values)
        paint.draw(axes)
        if self.spec.ghost:
            draw_ghost(axes, self.surface, frame.points, self.camera)
