"""Reads one VTU file of solid cells: VTK XML UnstructuredGrid, arrays ascii or appended raw.

Appended raw data are an underscore, then for each array a header integer (the number of bytes) and the bytes:
https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html.
"""
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

import numpy as np

from .cells import NAMES, SIZES, edges_of, tets_of
from .errors import DrawError

NUMPY_TYPE = {f"{k}{bits}": f"{c}{bits // 8}" for k, c, sizes in
              (("Float", "f", (32, 64)), ("Int", "i", (8, 16, 32, 64)), ("UInt", "u", (8, 16, 32, 64)))
              for bits in sizes}


@dataclass
class Frame:
    """Rest positions (n,3); linear tets (m,4), the parts of the cells of the file; fields by name, each (n or m,
    components); the cell of each tet (m,), ascending; and the cells of the file (c, most nodes of a cell), with -1 after the nodes of smaller cells, with their VTK types (c,)."""
    points: np.ndarray
    tets: np.ndarray
    node_fields: dict = field(default_factory=dict)
    cell_fields: dict = field(default_factory=dict)
    cell_of: np.ndarray = None
    cells: np.ndarray = None
    cell_types: np.ndarray = None

    def __post_init__(self):
        if self.cell_of is None:
            self.cell_of = np.arange(len(self.tets))
        if self.cells is None:
            self.cells, self.cell_types = self.tets, np.full(len(self.tets), 10)

    @property
    def num_cells(self):
        return int(self.cell_of[-1]) + 1 if len(self.cell_of) else 0

    def cell_edges(self):
        """The edges (m,2) of the cells of the file."""
        return np.concatenate([np.empty((0, 2), np.int64)] + [
            edges_of(int(kind), self.cells[self.cell_types == kind][:, :SIZES[int(kind)][0]])
            for kind in np.unique(self.cell_types)])

    def by_cell(self, name):
        """The values of a cell field, one row per cell of the file."""
        return self.cell_fields[name][np.searchsorted(self.cell_of, np.arange(self.num_cells))]


class _Arrays:
    """Decodes DataArray elements of one file."""

    def __init__(self, path, root, appended):
        self.path, self.appended = path, appended
        self.order = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.header = np.dtype(self.order + NUMPY_TYPE.get(root.get("header_type", "UInt32"), "u4"))
        if root.get("compressor"):
            raise self.damaged(f"compressed with {root.get('compressor')}; write raw appended data instead")

    def damaged(self, what):
        return DrawError(f"{self.path}: {what}")

    def read(self, element, tuples):
        """The values as (tuples, components). `tuples`: the number expected, or None for any number."""
        name, form = element.get("Name", "?"), element.get("format", "ascii")
        if element.get("type") not in NUMPY_TYPE:
            raise self.damaged(f"array '{name}' has the type {element.get('type')}, which is no number")
        dtype = np.dtype(self.order + NUMPY_TYPE[element.get("type")])
        if form == "appended":
            values = self._appended(name, dtype, int(element.get("offset", "0")))
        elif form == "ascii":
            values = self._ascii(name, dtype, element.text or "")
        else:
            raise self.damaged(f"array '{name}' has format=\"{form}\"; readable are appended (raw) and ascii")
        components = int(element.get("NumberOfComponents", "1"))
        if tuples is None:
            tuples = len(values) // components
        if len(values) != tuples * components:
            raise self.damaged(f"array '{name}' has {len(values)} values where {tuples} x {components} belong")
        return values.reshape(tuples, components)

    def _ascii(self, name, dtype, text):
        try:
            return np.array(text.split(), dtype=np.float64 if dtype.kind == "f" else np.int64).astype(dtype)
        except ValueError as error:
            raise self.damaged(f"array '{name}': {error}") from None

    def _appended(self, name, dtype, offset):
        begin = offset + self.header.itemsize
        if offset < 0 or begin > len(self.appended):
            raise self.damaged(f"array '{name}' begins beyond the end of the file; is the file cut off?")
        size = int(np.frombuffer(self.appended, self.header, 1, offset)[0])
        if begin + size > len(self.appended) or size % dtype.itemsize:
            raise self.damaged(f"array '{name}' should have {size} bytes, but the file holds "
                               f"{len(self.appended) - begin}; is the file cut off?")
        native = dtype.newbyteorder("=")
        return np.frombuffer(self.appended, dtype, size // dtype.itemsize, begin).astype(native)


def _split_appended(path, content):
    """The XML text and the bytes after the underscore."""
    tag = re.search(rb"<AppendedData[^>]*>", content)
    if not tag:
        return content, b""
    if b'encoding="raw"' not in tag.group():
        raise DrawError(f"{path}: appended data is not raw; only encoding=\"raw\" is readable")
    underscore = content.find(b"_", tag.end())
    appended = content[underscore + 1:] if underscore >= 0 else b""
    return content[:tag.start()] + b"</VTKFile>", appended


def _cells(arrays, cells, count, num_points):
    """The linear tets, and what else a Frame has of its cells, by name."""
    named = {a.get("Name"): a for a in cells}
    missing = {"connectivity", "offsets", "types"} - set(named)
    if missing:
        raise arrays.damaged(f"Cells lack {', '.join(sorted(missing))}")
    types = arrays.read(named["types"], count).ravel().astype(np.int64)
    unknown = set(types.tolist()) - SIZES.keys()
    if unknown:
        raise arrays.damaged(f"cells of VTK type {sorted(unknown)}; only {NAMES} can be drawn")
    nodes = arrays.read(named["connectivity"], None).ravel().astype(np.int64)
    sizes = np.array([SIZES[kind][0] for kind in types.tolist()], np.int64)
    if nodes.size != sizes.sum():
        raise arrays.damaged(f"connectivity has {nodes.size} entries; its {count} cells need {sizes.sum()}")
    if nodes.size and (nodes.min() < 0 or nodes.max() >= num_points):
        raise arrays.damaged(f"connectivity names point {nodes.max()}, but there are {num_points} points")
    start = np.cumsum(sizes) - sizes
    table = np.full((count, sizes.max(initial=4)), -1)
    table[np.arange(table.shape[1]) < sizes[:, None]] = nodes
    tets, owners = [np.empty((0, 4), np.int64)], [np.empty(0, np.int64)]
    for kind in np.unique(types):
        size = SIZES[int(kind)][0]
        own = np.flatnonzero(types == kind)
        of_kind = nodes[start[own][:, None] + np.arange(size)]
        parts, row = tets_of(int(kind), of_kind)
        tets.append(parts)
        owners.append(own[row])
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(tets)[order], {"cell_of": owner[order], "cells": table, "cell_types": types}


def read_vtu(path):
    """The Frame in `path`. Raises DrawError if the file is missing or damaged, or has cells that cannot be drawn."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise DrawError(f"{path}: {error.strerror}") from None
    text, appended = _split_appended(path, content)
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise DrawError(f"{path}: not readable as VTU ({error})") from None
    arrays = _Arrays(path, root, appended)
    piece = root.find("UnstructuredGrid/Piece")
    if piece is None or piece.find("Points/DataArray") is None or piece.find("Cells") is None:
        raise arrays.damaged("no UnstructuredGrid with Points and Cells inside")
    try:
        num_points, num_cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        points = arrays.read(piece.find("Points/DataArray"), num_points).astype(float)
        if points.shape[1] != 3:
            raise arrays.damaged(f"points have {points.shape[1]} components; 3 belong")
        fields = [{a.get("Name"): arrays.read(a, count) for a in piece.findall(f"{where}/DataArray")}
                  for where, count in (("PointData", num_points), ("CellData", num_cells))]
        tets, cells = _cells(arrays, piece.find("Cells"), num_cells, num_points)
        of_nodes, of_cells = fields
        return Frame(points, tets, of_nodes, {name: values[cells["cell_of"]] for name, values in of_cells.items()}, **cells)
    except (TypeError, ValueError) as error:
        raise arrays.damaged(f"a count or offset is no whole number ({error})") from None
