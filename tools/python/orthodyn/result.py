"""Results of runs: arrays, tables, and the record of the computation."""
from __future__ import annotations

import csv
import json
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .draw.errors import DrawError
from .draw.series import Series
from .draw.table import Table
from .notebook import Page

if TYPE_CHECKING:
    import meshio
    import pandas
    from matplotlib.axes import Axes

TEMPORARY = "orthodyn-"  # prefix of temporary result folders
# meshio's name and the number of nodes, by VTK type
CELL_TYPES = {10: ("tetra", 4), 12: ("hexahedron", 8), 13: ("wedge", 6), 24: ("tetra10", 10),
              25: ("hexahedron20", 20), 26: ("wedge15", 15), 29: ("hexahedron27", 27), 32: ("wedge18", 18)}


class Columns(dict[str, np.ndarray]):
    """The columns of a table by name; an unknown name raises a KeyError that lists the names."""

    def __missing__(self, name: str) -> np.ndarray:
        raise KeyError(f"no column '{name}'; there are {', '.join(self)}")


class Result:
    """The result of a run. Fields that a run in this process kept in memory have double precision. All other fields are
    read from the frames, in single precision."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self._kept: dict[str, Any] = {}
        self._from_frames: dict[str, np.ndarray] = {}

    def _keep(self, kept: dict[str, Any]) -> None:
        """Stores the fields that a run kept in memory."""
        self._kept = kept

    @classmethod
    def load(cls, folder: str | Path) -> Result:
        """The result in a folder that `orthodyn run` wrote."""
        if not (Path(folder) / "run.json").is_file():
            raise FileNotFoundError(f"{folder}: holds no run.json; `orthodyn run SCENE.yaml` writes one")
        return cls(folder)

    @cached_property
    def record(self) -> dict[str, Any]:
        """Content of run.json: model, method, cost, errors and warnings."""
        try:
            return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}

    @property
    def status(self) -> str:
        """"completed", "interrupted" or "failed"."""
        return self.record.get("status", "")

    @property
    def statistics(self) -> dict[str, Any]:
        """Steps, Newton iterations, and the count and seconds of each kind of work."""
        return self.record.get("statistics", {})

    @property
    def warnings(self) -> list[str]:
        """Warnings about the result."""
        return self.record.get("warnings", [])

    @cached_property
    def _series(self) -> Series:
        try:
            return Series(str(self.folder))
        except DrawError as error:
            raise FileNotFoundError(f"{self._by_name(error)} (available tables: {self._tables()})") from None

    @cached_property
    def times(self) -> np.ndarray:
        """Times (frames,), s; load factors of a static analysis."""
        return self._kept["times"] if "times" in self._kept else self._series.times

    @cached_property
    def points(self) -> np.ndarray:
        """Rest positions (nodes, 3), m."""
        return self._kept["points"] if "points" in self._kept else self._series.frame(0).points

    @cached_property
    def cells(self) -> np.ndarray:
        """Nodes of the elements (elements, most nodes of an element); -1 after the nodes of smaller elements."""
        return self._kept["cells"] if "cells" in self._kept else self._series.frame(0).cells

    @cached_property
    def cell_types(self) -> np.ndarray:
        """VTK types of the elements (elements,): 10 and 24 tetrahedra, 25 and 29 hexahedra, 26 and 32 wedges."""
        return self._kept["cell_types"] if "cell_types" in self._kept else self._series.frame(0).cell_types

    @property
    def fields(self) -> list[str]:
        """Names for `result[name]`."""
        names = list(self._kept.get("fields", {}))
        if (self.folder / "frames.pvd").is_file():
            frame = self._series.frame(0)
            names += [name for name in (*frame.node_fields, *frame.cell_fields) if name not in names]
        return names

    def __getitem__(self, name: str) -> np.ndarray:
        """A field, (frames, nodes or elements, components)."""
        kept = self._kept.get("fields", {})
        if name in kept:
            return kept[name]
        if name not in self.fields:
            raise KeyError(f"no field '{name}'; there are {', '.join(self.fields) or 'none'} (output.fields of the scene)")
        if name not in self._from_frames:
            self._from_frames[name] = self._read(name)
        return self._from_frames[name]

    def _read(self, name: str) -> np.ndarray:
        frames = [self._series.frame(k) for k in range(len(self._series))]
        if name in frames[0].node_fields:
            return np.stack([frame.node_fields[name] for frame in frames])
        return np.stack([frame.by_cell(name) for frame in frames])

    @property
    def displacement(self) -> np.ndarray:
        """(frames, nodes, 3), m."""
        return self["displacement"]

    @property
    def velocity(self) -> np.ndarray:
        """(frames, nodes, 3), m/s."""
        return self["velocity"]

    @property
    def stress(self) -> np.ndarray:
        """Cauchy stress (frames, nodes or elements, 6), Pa: xx yy zz xy yz zx; recovered nodal stress if the scene writes
        it."""
        return self["nodal_stress" if "nodal_stress" in self.fields else "stress"]

    def table(self, name: str) -> dict[str, np.ndarray]:
        """The columns of a CSV file: "probes", "energy", "momentum", "steps", ... The first column is t (s), or the
        load factor of a static analysis."""
        return Columns((column.name, column.values) for column in self._table(name).columns.values())

    def _table(self, name: str) -> Table:
        path = self.folder / f"{name}.csv"
        if not path.is_file():
            raise FileNotFoundError(f"no table '{name}'; there are {self._tables()} (output of the scene)")
        try:
            return Table(path)
        except DrawError as error:
            raise FileNotFoundError(self._by_name(error)) from None

    def _by_name(self, error: DrawError) -> str:
        """A message without the name of a temporary folder."""
        return str(error).replace(f"{self.folder}/", "") if self._is_temporary else str(error)

    @property
    def _is_temporary(self) -> bool:
        return self.folder.parent.name.startswith(TEMPORARY)

    def _tables(self) -> str:
        return ", ".join(sorted(path.stem for path in self.folder.glob("*.csv"))) or "none"

    @property
    def probes(self) -> dict[str, np.ndarray]:
        """Values of the scene's probes: t (or the load factor) and one column per value."""
        return self.table("probes")

    @property
    def sensitivities(self) -> dict[str, np.ndarray]:
        """Derivatives of probes, reactions and energies with respect to the scene's `sensitivities`, per SI unit of the
        parameter: t (or the load factor), "d tip.displacement.z / d materials.wood.young.0", ... In a buckling analysis
        "mode", "load_factor" and "d load_factor / d materials.wood.young.0", one row per mode."""
        return self.table("sensitivities")

    @property
    def extremes(self) -> dict[str, dict[str, Any]]:
        """The extremes of the scene's `output.extremes` by name: "value", "time", "place" and, of probes in a motion with
        `sensitivities`, "derivatives" by path, per SI unit of the parameter. "remark" tells why there are none."""
        return self.record.get("extremes") or {}

    @property
    def event_sensitivities(self) -> list[dict[str, Any]]:
        """One entry per event of a motion with `sensitivities`: "t" (s), "event" (its name), "derivatives" of this time by
        path, in s per SI unit of the parameter, and "remark", which tells why there are none."""
        path = self.folder / "sensitivities_of_events.csv"
        if not path.is_file():
            raise FileNotFoundError("no derivatives of events; the scene needs `events` and `sensitivities`, and a motion")
        with path.open(newline="", encoding="utf-8") as stream:
            header, *rows = csv.reader(stream)
        paths = [name.removeprefix("d t / d ").removesuffix(" [s / SI unit]") for name in header[2:-1]]
        return [{"t": float(row[0]), "event": row[1], "remark": row[-1],
                 "derivatives": {p: float(cell) for p, cell in zip(paths, row[2:-1]) if cell}} for row in rows]

    @property
    def energies(self) -> dict[str, np.ndarray]:
        """Energies, J: kinetic, elastic, ... and the balance, which should stay zero."""
        return self.table("energy")

    @property
    def response(self) -> dict[str, np.ndarray]:
        """Response in a harmonic analysis: "frequency" (Hz), and the complex amplitude of each quantity
        ("tip.velocity.z"), whose angle is the phase."""
        table = self.table("response")
        phases = {name: np.deg2rad(values) for name, values in table.items() if name.endswith(".phase")}
        return Columns((name, values * np.exp(1j * phases[name + ".phase"]) if name + ".phase" in phases else values)
                       for name, values in table.items() if name not in phases)

    def to_pandas(self, table: str = "probes") -> pandas.DataFrame:
        """A table as a data frame whose index is the first column."""
        import pandas
        columns = self.table(table)
        return pandas.DataFrame(columns).set_index(next(iter(columns)))

    def to_meshio(self, frame: int = -1) -> meshio.Mesh:
        """One frame as a meshio.Mesh: the rest shape with the displacement and all other fields. Elements are grouped by
        their type."""
        import meshio
        nodes, cells = len(self.points), len(self.cells)
        values = {name: self[name][frame] for name in self.fields}
        of_nodes = {name: v for name, v in values.items() if len(v) == nodes and not self._is_of_cells(name)}
        blocks = [np.flatnonzero(self.cell_types == kind) for kind in np.unique(self.cell_types)]
        of_cells = {name: [v[block] for block in blocks] for name, v in values.items()
                    if name not in of_nodes and len(v) == cells}
        named = [CELL_TYPES[int(self.cell_types[block[0]])] for block in blocks]
        return meshio.Mesh(self.points, [(name, self.cells[block, :size]) for (name, size), block in zip(named, blocks)],
                           of_nodes, of_cells)

    def view(self, *others: Result | str | Path, out: str | Path | None = None, volume: bool = False, height: int = 620,
             time: float | None = None, color: str | None = None, scale: float | None = None) -> Page:
        """A page with a 3D view, which a notebook shows. `others`: results or folders to compare with. `volume`: include the
        interior, for the clip plane. `time`, `color` ("nodal_stress.von_mises") and `scale` of the deformation set the initial
        view. Without `scale`, a deflection too small to see is enlarged, as the page then states."""
        from .draw.view.collect import Extent
        from .draw.view.page import write_view
        from .draw.view_sources import sources_of
        folders = [getattr(result, "folder", result) for result in (self, *others)]
        given = {"scale": scale, "time": time, "color": color}
        start = {key: value if key == "color" else float(value) for key, value in given.items() if value is not None}
        try:
            path = write_view(sources_of(folders), out, Extent(volume=volume), start)
        except DrawError as error:
            raise ValueError(str(error)) from None
        return Page(path, height, (self, *others))

    def plot(self, table: str = "probes", columns: str | list[str] | None = None, ax: Axes | None = None) -> Axes:
        """Plots columns of a table over its first column."""
        from .plots import plot_table
        return plot_table(self._table(table), columns, ax)

    def __repr__(self) -> str:
        name = self.folder.name if self._is_temporary else self.folder
        return f"Result({name}, {self.status or 'no record'}{self._mesh_error()})"

    def _mesh_error(self) -> str:
        """The mesh error in words; "" if the record has none."""
        share = (self.record.get("errors") or {}).get("mesh")
        if share is not None:
            return f", mesh error {100 * share:.2g} % of the elastic energy"
        modes = [mode["mesh_error"] for mode in self.record.get("modes") or () if mode.get("mesh_error") is not None]
        value = "frequency" if self.record.get("analysis") == "harmonic" else "load factor"
        return f", mesh error {100 * modes[0]:+.2g} % of the lowest {value}" if modes else ""

    def _is_of_cells(self, name: str) -> bool:
        if name in self._kept.get("cell_fields", ()):
            return True
        return name not in self._kept.get("fields", {}) and name in self._series.frame(0).cell_fields
