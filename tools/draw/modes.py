"""Natural modes or buckling shapes, magnified, as small pictures over the outline of the body."""
import csv
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from .body import INK, front_faces
from .digits import known_digits
from .errors import DrawError
from .picture import draw_strip
from .scene import Scene, PictureSpec
from .series import Series

FAINT = 0.02  # fraction of the largest displacement: a part of one sign that moves less has no nodal line around it
LARGEST = 0.12  # largest displacement in the picture, as a fraction of the body's largest extent
MOST_DIGITS = 4  # largest number of digits in a label


class Shapes(Series):
    """modes.pvd as a Series over mode numbers; shapes take the place of displacements."""

    def __init__(self, name):
        super().__init__(name, "modes.pvd")

    def frame(self, index):
        frame = super().frame(index)
        if "shape" not in frame.node_fields:
            raise DrawError(f"{self.paths[index]}: has no field 'shape'; is it a file of `orthodyn modes`?")
        shape = frame.node_fields["shape"]
        swing = _along_largest(shape)[:, None]
        return replace(frame, points=frame.points + frame.node_fields.get("displacement", 0),
                       node_fields={"displacement": shape, "shape": shape, "swing": swing})


def _along_largest(shape):
    """The signed component of (n,3) along the main direction of motion, scaled to a maximum of 1."""
    along = shape @ np.linalg.eigh(shape.T @ shape)[1][:, -1]
    return along / (along[np.argmax(abs(along))] or 1)


def faint_nodes(faces, value):
    """(n,): whether a node belongs to a part of the surface on which `value` has one sign and stays below FAINT times
    the largest value. Round-off and the mesh cause such parts near supports; they get no nodal line. Nodal lines
    between two parts that move are drawn completely."""
    a, b = faces.ravel(), np.roll(faces, 1, axis=1).ravel()
    same = value[a] * value[b] > 0
    a, b = a[same], b[same]
    part, before = np.arange(len(value)), None
    while before is None or (part != before).any():  # each part gets its smallest node number
        before, least = part, np.minimum(part[a], part[b])
        part = part.copy()
        np.minimum.at(part, before[a], least)
        np.minimum.at(part, before[b], least)
        part = part[part]
    largest = np.zeros(len(value))
    np.maximum.at(largest, part, abs(value))
    return (value != 0) & (largest[part] < FAINT * abs(value).max())


class Picture(Scene):
    note = ""  # no magnification is stated, because the size of a shape is arbitrary

    def add_lines(self, paint, points, values):
        """Adds nodal lines: on visible faces whose corners have values of both signs."""
        flat = self.camera.flat(points)
        faces, swing = self.surface.faces, np.zeros(len(points))
        swing[faces] = values
        faint = faint_nodes(faces, swing)[faces].any(axis=1)
        seen = front_faces(self.surface, flat) & (values.min(axis=1) < 0) & (values.max(axis=1) > 0) & ~faint
        corners, own = points[faces[seen]], values[seen]
        ends = [[] for _ in own]
        for k in range(3):
            a, b = own[:, k], own[:, (k + 1) % 3]
            for f in np.nonzero((a < 0) != (b < 0))[0]:
                share = a[f] / (a[f] - b[f])
                ends[f].append((1 - share) * corners[f, k] + share * corners[f, (k + 1) % 3])
        if not ends:
            return
        start, end = np.array([e[:2] for e in ends]).swapaxes(0, 1)
        nearer = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(axis=1)
        paint.add_segments(self.camera.flat(start), self.camera.flat(end), self.camera.depth(0.5 * (start + end)) + nearer,
                           INK, 1.1)


def frequency_label(hertz, error=math.nan):
    value, unit = (hertz / 1000, "kHz") if abs(hertz) >= 1000 else (hertz, "Hz")
    return f"{known_digits(value, error, MOST_DIGITS)} {unit}"


def factor_label(factor, error=math.nan):
    return f"load factor {known_digits(factor, error, MOST_DIGITS)}"


# For each kind of mode: file, column of the value, function that makes the label, command that writes the file.
KINDS = (("modes.csv", "frequency [Hz]", frequency_label, "orthodyn modes"),
         ("buckling.csv", "load_factor", factor_label, "orthodyn run"))


def read_modes(folder):
    """The values and the labels of all modes. A label has the digits that exceed the mesh error."""
    for name, column, label, command in KINDS:
        path = Path(folder) / name
        if not path.exists():
            continue
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = [(float(row[column]), float(row.get("mesh_error") or "nan")) for row in csv.DictReader(file)]
                return [figure for figure, _ in rows], [label(*row) for row in rows]
        except (KeyError, TypeError, ValueError) as error:
            raise DrawError(f"{path}: not readable as a table of `{command}` ({error})") from None
    raise DrawError(f"{folder}: neither modes.csv (`orthodyn modes`) nor buckling.csv (analysis: buckling)")


def is_of_modes(folder):
    """Whether the shapes are vibration modes, not buckling shapes."""
    return (Path(folder) / "modes.csv").is_file()


def _read_all(folder, shapes):
    figures, labels = read_modes(folder)
    if len(figures) != len(shapes):
        raise DrawError(f"{folder}: the table and modes.pvd have different modes; compute them again")
    return figures, labels


def labelled_modes(folder, shapes):
    """The label of each shape: '3: 12.5 Hz'."""
    _, labels = _read_all(folder, shapes)
    return [f"{k + 1}: {label}" for k, label in enumerate(labels)]


def draw_modes(folder, path, count, view, up):
    shapes = Shapes(folder)
    figures, labels = _read_all(folder, shapes)
    chosen = [k for k in range(len(shapes)) if figures[k] != 0][:count]
    if not chosen:
        raise DrawError(f"{folder}: all {len(figures)} modes are rigid; compute more with -n")
    scale = LARGEST * float(np.ptp(shapes.frame(chosen[0]).points, axis=0).max())
    spec = PictureSpec(color="swing", view=view, up=up, scale=scale, ghost=True, limits=(-1, 1))
    scene = Picture(shapes, chosen, spec)
    scene.labels = {k: f"{k + 1}: {labels[k]}" for k in chosen}
    return draw_strip(scene, chosen, path)
