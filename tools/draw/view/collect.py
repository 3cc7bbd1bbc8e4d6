"""Collects one result for a page: a description for the page's script, and blocks of numbers."""
import json
from dataclasses import dataclass

import numpy as np

from ..colouring import Colouring
from ..errors import DrawError
from ..quantity import NEUTRAL, component_names, find_quantity, magnitude, von_mises
from ..table import Table
from .setup import add_setup
from .skin import Skin
from .strokes import strokes

MOST_ROWS = 20000  # largest number of rows of a table
SAMPLED = 24  # number of frames of which all values enter a field's colour range; of other frames only the extremes do
TABLES = ("probes", "energy", "momentum", "sensitivities")
NOTES = ("status", "warnings")


@dataclass(frozen=True)
class Extent:
    """The part of a result to include: with or without the interior, which fields (None: all), and every K-th frame."""
    volume: bool = False
    fields: tuple = None
    every: int = None  # None: Source.every


class _Kept:
    """The nodes and cells to include, in the order of the page."""

    def __init__(self, skin, frame, volume):
        if volume:
            self.nodes, self.cells = np.arange(len(frame.points)), np.arange(frame.num_cells)
        else:
            self.nodes, self.cells = skin.surface.nodes, np.unique(skin.cell)
        self._node, self._cell = (_places(*pair) for pair in ((self.nodes, len(frame.points)),
                                                              (self.cells, frame.num_cells)))

    def of(self, frame, name):
        """The values of a field at the included nodes or cells."""
        if name in frame.node_fields:
            return frame.node_fields[name][self.nodes]
        return frame.by_cell(name)[self.cells]

    def node(self, numbers):
        return self._node[numbers]

    def cell(self, numbers):
        return self._cell[numbers]


def _places(kept, size):
    place = np.zeros(size, np.int64)
    place[kept] = np.arange(len(kept))
    return place


def add_result(blocks, key, item, extent):
    """Adds the blocks of an Item, with names KEY/... Returns the Item's description."""
    series = item.series
    frames = sorted({*range(0, len(series), extent.every), len(series) - 1})
    first = series.frame(0)
    if not len(first.tets):
        raise DrawError(f"{series.paths[0]}: no tetrahedra to show")
    skin = Skin(first)
    shown = _Kept(skin, first, extent.volume)
    fields = _fields(first, extent)
    centre = 0.5 * (first.points.min(axis=0) + first.points.max(axis=0))
    survey = _Survey(series, frames, shown, fields, centre)
    _add_mesh(blocks, key, first, skin, shown, centre, extent.volume)
    return {
        "name": item.name, "group": item.group, "shape": item.is_shape, "static": item.is_static, "facts": list(item.facts),
        "labels": [item.labels[k] for k in frames] if item.labels else None,
        "centre": centre.tolist(), "reach": survey.reach(), "times": [float(series.times[k]) for k in frames],
        "cells": first.num_cells, "volume": extent.volume,
        "fields": _add_frames(blocks, key, series, frames, shown, survey),
        "quantities": survey.quantities(),
        "strokes": _add_strokes(blocks, key, first, skin),
        "curves": [curve for table in TABLES for curve in _add_table(blocks, key, item.folder, table)],
        "setup": add_setup(blocks, key, item.folder, len(first.points), shown), "notes": _notes(item.folder)}


def _fields(frame, extent):
    names = field_names(frame)
    wanted = [name for name in extent.fields if name in names] if extent.fields else [
        name for name in names if not name.startswith("material_axis")]
    return ["displacement"] * ("displacement" in names) + [name for name in wanted if name != "displacement"]


def field_names(frame):
    return [*frame.node_fields, *frame.cell_fields]


def _add_mesh(blocks, key, frame, skin, shown, centre, volume):
    blocks.add(f"{key}/rest", "f32", frame.points[shown.nodes] - centre)
    blocks.add(f"{key}/number", "u32", shown.nodes)
    blocks.add(f"{key}/faces", "u32", shown.node(skin.faces))
    blocks.add(f"{key}/normals", "u32", skin.normal)
    blocks.add(f"{key}/cell", "u32", shown.cell(skin.cell))
    blocks.add(f"{key}/cell_number", "u32", shown.cells)
    blocks.add(f"{key}/edges", "u32", shown.node(skin.edges))
    blocks.add(f"{key}/creases", "u32", shown.node(skin.creases))
    if volume:
        blocks.add(f"{key}/tets", "u32", frame.tets)
        blocks.add(f"{key}/tet_cell", "u32", frame.cell_of)


def _add_frames(blocks, key, series, frames, shown, survey):
    """Adds the blocks KEY/FIELD/FRAME. Of a field that is constant in time, only the first frame is added."""
    first = series.frame(0)
    for k, index in enumerate(frames):
        frame = series.frame(index)
        for name in survey.fields:
            if k == 0 or name not in survey.steady:
                values = shown.of(frame, name)
                if name == "displacement":
                    blocks.add(f"{key}/{name}/{k}", "linear", values)
                else:
                    blocks.add(f"{key}/{name}/{k}", "half", values, offset=NEUTRAL.get(name, 0.0))
    return [{"name": name, "on": "nodes" if name in first.node_fields else "cells", "steady": name in survey.steady,
             "components": shown.of(first, name).shape[1]} for name in survey.fields]


class _Survey:
    """A first pass over all frames. Checks that they match, and finds the extent of the body, the constant fields and
    the range of each quantity."""

    def __init__(self, series, frames, shown, fields, centre):
        first = series.frame(0)
        self.fields, self.steady = fields, {name for name in fields if name != "displacement"}
        self.low, self.high = np.full(3, np.inf), np.full(3, -np.inf)
        self._kinds = {name: _kinds(name, first, shown.of(first, name).shape[1]) for name in fields}
        self._samples = {name: [[] for _ in kinds] for name, kinds in self._kinds.items()}
        sampled = {frames[int(i)] for i in np.linspace(0, len(frames) - 1, min(SAMPLED, len(frames))).round()}
        for index in frames:
            frame = series.frame(index)
            self._check(series.paths[index], frame, first)
            self._reach(series.paths[index], frame, shown, centre)
            self._sample(frame, shown, index in sampled)
            self.steady = {name for name in self.steady
                           if np.array_equal(shown.of(first, name), shown.of(frame, name), equal_nan=True)}

    def _check(self, path, frame, first):
        if frame.points.shape != first.points.shape or frame.tets.shape != first.tets.shape:
            raise DrawError(f"{path}: the mesh differs from that of the first frame")
        for name in self.fields:
            if not _has(frame, name):
                raise DrawError(f"{path}: has no field '{name}', which the first frame has")

    def _reach(self, path, frame, shown, centre):
        moved = frame.points[shown.nodes] - centre
        if "displacement" in frame.node_fields:
            moved = moved + shown.of(frame, "displacement")
        if not np.isfinite(moved).all():
            raise DrawError(f"{path}: a displacement is not finite")
        self.low, self.high = np.minimum(self.low, moved.min(axis=0)), np.maximum(self.high, moved.max(axis=0))

    def _sample(self, frame, shown, whole):
        for name in self.fields:
            values = shown.of(frame, name).astype(float)
            for kind, sample in zip(self._kinds[name], self._samples[name]):
                own = _values(kind, values)
                sample.append((own if whole or kind.peaked else _ends(own)).astype(np.float32))

    def reach(self):
        return [self.low.tolist(), self.high.tolist()]

    def quantities(self):
        """The quantities that can colour the body, with their ranges."""
        return [_described(kind, sample) for name in self.fields
                for kind, sample in zip(self._kinds[name], self._samples[name])]


def _has(frame, name):
    return name in frame.node_fields or name in frame.cell_fields


def _ends(values):
    """The smallest and the largest finite value."""
    finite = values[np.isfinite(values)]
    return np.array([finite.min(), finite.max()]) if finite.size else np.zeros(0)


def _kinds(name, frame, count):
    """The Quantities of a field: the default one first, then the components."""
    whole = find_quantity(name, frame)
    parts = [find_quantity(f"{name}.{part}", frame) for part in component_names(name, count)] if count > 1 else []
    if count == 6 and whole.kind == "von_mises":
        parts.append(find_quantity(f"{name}.magnitude", frame))
    return [whole] + [part for part in parts if part != whole]


def _values(quantity, values):
    if quantity.kind == "von_mises":
        return von_mises(values)
    if quantity.kind == "magnitude":
        return magnitude(values)
    return values[:, 0 if quantity.kind == "value" else quantity.kind]


def _described(quantity, samples):
    colouring = Colouring(quantity, samples)
    kind = 0 if quantity.kind == "value" else quantity.kind
    low, high = colouring.norm.vmin * colouring.factor, colouring.norm.vmax * colouring.factor
    part = quantity.label.split()[-1] if isinstance(quantity.kind, int) else quantity.kind
    name = quantity.field if part == "value" else f"{quantity.field}.{part}"
    return {"key": f"{quantity.field}.{kind}", "name": name, "field": quantity.field, "kind": kind, "label": quantity.label,
            "unit": quantity.unit, "low": low, "high": high, "least": _end(np.min, samples), "most": _end(np.max, samples),
            "neutral": quantity.neutral or 0.0, "diverging": quantity.neutral is not None,
            "categories": quantity.categorical}


def _end(which, samples):
    """which(all finite values); None if there are none."""
    ends = [which(finite) for sample in samples if (finite := sample[np.isfinite(sample)]).size]
    return float(which(ends)) if ends else None


def _add_strokes(blocks, key, frame, skin):
    """Adds strokes along the material axes. Returns the axes."""
    moved = frame.points + frame.node_fields.get("displacement", 0)
    axes = [axis for axis in (1, 2, 3) if f"material_axis_{axis}" in frame.cell_fields and len(skin.faces)]
    for axis in axes:
        face, ends = strokes(skin, frame, moved, f"material_axis_{axis}")
        blocks.add(f"{key}/stroke_face_{axis}", "u32", face)
        blocks.add(f"{key}/stroke_ends_{axis}", "f32", ends.reshape(len(face), 6))
    return axes


def _add_table(blocks, key, folder, name):
    """Adds a table as one block, if it exists. Returns the table's curves."""
    path = folder and folder / f"{name}.csv"
    if not path or not path.is_file():
        return []
    try:
        table = Table(path)
    except DrawError:  # no rows: the run has just begun
        return []
    rows = np.unique(np.linspace(0, len(table.axis.values) - 1, min(len(table.axis.values), MOST_ROWS)).round().astype(int))
    columns = [table.axis, *table.others()]
    blocks.add(f"{key}/{name}.csv", "f32", np.stack([c.values for c in columns], axis=1)[rows])
    return [{"table": name, "column": k, "name": c.name, "unit": c.unit} for k, c in enumerate(columns) if k]


def _notes(folder):
    """The status and the warnings from run.json."""
    if not folder:
        return {}
    try:
        record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {key: record[key] for key in NOTES if key in record}
