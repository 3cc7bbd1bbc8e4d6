"""Studies: many runs, one data frame. Each run has its own process, as with the program `orthodyn`.

Common arguments:
    out    result folder, whose results are reused; default out/KIND/NAME, where NAME comes from the file's name or the
           title
    retry  repeat failed points
    quiet  print nothing
    ranks  MPI processes per point (compare, sweep, converge)
"""
from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from .notebook import Page
from .scene import Scene, as_yaml

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

HERE = Path(__file__).parent  # not resolved, because the file is a link in a build tree
CONFIG_ERROR = 2


@dataclass(frozen=True)
class Study:
    """A finished study: its points as a data frame, its folder, and its report."""
    kind: str
    folder: Path
    table: pandas.DataFrame

    @property
    def report(self) -> Path:
        return self.folder / "report.html"

    def show(self, height: int = 700) -> Page:
        """The report as a page for a notebook."""
        return Page(self.report, height)

    def view(self, height: int = 620) -> Page:
        """3D view of the points. A sweep or comparison needs `frames`; a stability study shows the last states."""
        from .draw.errors import DrawError
        from .draw.view.page import write_view
        from .draw.view_sources import source_of
        try:
            return Page(write_view([source_of(self.folder)]), height)
        except DrawError as error:
            raise ValueError(str(error)) from None

    def plot(self, x: str, y: str, by: str | None = None, ax: Axes | None = None, *, log: bool = False) -> Axes:
        """Plots column `y` over `x`, with one line per value of `by`."""
        from .plots import new_axes
        x, y, by = self.column(x), self.column(y), by and self.column(by)
        ax = new_axes(ax)
        groups = self.table.groupby(by) if by else [("", self.table)]
        for name, rows in groups:
            rows = rows.dropna(subset=[x, y]).sort_values(x)
            ax.plot(rows[x], rows[y], marker="o", label=str(name))
        if log:
            ax.set_xscale("log")
            ax.set_yscale("log")
        ax.set_xlabel(x)
        ax.set_ylabel(y)
        if by:
            ax.legend(frameon=False)
        return ax

    def column(self, name: str) -> str:
        """The full name of a column: "deflection" becomes "deflection [m]"."""
        found = [c for c in self.table.columns if c == name or c.split(" [")[0] == name]
        if not found:
            raise KeyError(f"no column '{name}'; there are {', '.join(self.table.columns)}")
        return str(found[0])

    def __repr__(self) -> str:
        return f"Study({self.kind}, {len(self.table)} points, {self.folder})"


def compare(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, retry: bool = False,
            quiet: bool = False, ranks: int | None = None) -> Study:
    """Compares integrators on scenes: error against time. `study`: a YAML file, or a dict with its content:

        orthodyn.compare({"title": "Beam", "scenes": [scene], "integrators": ["cvode_bdf", "tr_bdf2"],
                          "tolerances": [1e-2, 1e-4]})

    A scene is a file or a `Scene`. Points are measured one after the other.
    """
    return _run(_Call("compare", out, quiet, retry, ranks=ranks), study)


def sweep(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, jobs: int | None = None, retry: bool = False,
          quiet: bool = False, ranks: int | None = None) -> Study:
    """Varies keys of a scene:

        orthodyn.sweep({"title": "Stiffer", "scene": scene, "vary": {"materials.spruce.young.0": ["8 GPa", "12 GPa"]},
                        "quantities": {"deflection": {"quantity": "tip.displacement.z"}}})

    A scene is a file, a `Scene`, or {"file": file or Scene, "set": {"damping.stiffness": "=zeta/30"}}. A formula after
    "=" uses named variables: "vary": {"zeta": [0.01, 0.1]}. `jobs`: concurrent points, default the number of
    processors.
    """
    return _run(_Call("sweep", out, quiet, retry, jobs, ranks), study)


def stability(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, jobs: int | None = None,
              retry: bool = False, quiet: bool = False) -> Study:
    """Grades integrators on hard cases. `jobs`: concurrent runs, default the number of processors."""
    return _run(_Call("stability", out, quiet, retry, jobs), study)


def converge(study: str | Path | Scene, out: str | Path | None = None, *, jobs: int | None = None, retry: bool = False,
             quiet: bool = False, ranks: int | None = None) -> Study:
    """Runs a scene or its file on successively refined meshes. `jobs`: concurrent meshes, default the number of processors."""
    return _run(_Call("converge", out, quiet, retry, jobs, ranks), study)


def fit(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, jobs: int | None = None, retry: bool = False,
        quiet: bool = False) -> Study:
    """Finds numbers of scenes that explain measured values:

        orthodyn.fit({"title": "Plate",
                      "experiments": {"plate": {"scene": scene,
                                                "measured": [{"frequencies": [51.2, 80.4, 117], "relative": 0.005}]}},
                      "parameters": {"E1": "materials.spruce.young.0", "G12": "materials.spruce.g12"}})

    The table has a row per parameter: value, standard deviation, and 95 % interval. `data.csv` in the folder has the
    data beside the computed values. `jobs`: concurrent runs, default the number of processors.
    """
    return _run(_Call("fit", out, quiet, retry, jobs), study)


def program() -> str:
    """Path of the program `orthodyn`: that of this package, otherwise the first on the PATH."""
    own = [HERE / "bin" / "orthodyn", *(parent / "orthodyn" for parent in HERE.parents[:2]),  # of a wheel, a build tree,
           *(parent / "bin" / "orthodyn" for parent in HERE.parents[3:4])]  # and of a prefix
    found = next((str(path) for path in own if path.is_file() and os.access(path, os.X_OK)), shutil.which("orthodyn"))
    if not found:
        raise FileNotFoundError("the program `orthodyn` is neither in this package nor on the PATH")
    return found


@dataclass(frozen=True)
class _Call:
    """A call of the program."""
    kind: str
    out: str | Path | None
    quiet: bool
    retry: bool
    jobs: int | None = None
    ranks: int | None = None

    def folder(self, name: str) -> Path:
        return Path(self.out) if self.out else Path("out") / _FOLDER[self.kind] / name

    def arguments(self, file: str, folder: Path) -> list[str]:
        counts = {"--jobs": self.jobs, "--ranks": self.ranks}
        given = [word for option, count in counts.items() if count is not None for word in (option, str(count))]
        return [program(), self.kind, file, "--out", str(folder), *["--retry"] * self.retry, *given]


def _run(call: _Call, study: Any) -> Study:
    import pandas
    with _Files(call.kind) as files:
        if isinstance(study, Scene):
            file, name = files.with_files(study), study.name
        elif isinstance(study, Mapping):
            file, name = files.add(as_yaml(files.with_files(study)), Path("."), "the study"), _name(study)
        else:
            file, name = str(study), Path(study).stem
        folder = call.folder(name)
        _start(call, file, folder, files.named)
    return Study(call.kind, folder, pandas.read_csv(folder / _TABLE[call.kind]))


class _Files(ExitStack):
    """Temporary files with studies and scenes for the program, deleted on exit."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.kind = kind
        self.names: dict[str, str] = {}

    def add(self, text: str, folder: Path, name: str) -> str:
        """Writes a file into `folder`, to which file names in the text are relative. Messages use `name` instead of its path."""
        with tempfile.NamedTemporaryFile("w", suffix=".yaml", prefix=f".{self.kind}-", dir=folder, encoding="utf-8",
                                         delete=False) as stream:
            stream.write(text)
        path = os.path.abspath(stream.name)
        self.callback(os.unlink, path)
        self.names[path] = name
        return path

    def with_files(self, item: Any) -> Any:
        """A copy of `item` with each Scene replaced by a file."""
        if isinstance(item, Scene):
            return self.add(item.to_yaml(), item.folder, f"scene '{item.name}'")
        if isinstance(item, Mapping):
            return {key: self.with_files(_labelled(value) if key in ("scenes", "cases") else value)
                    for key, value in item.items()}
        return [self.with_files(value) for value in item] if isinstance(item, (list, tuple)) else item

    def named(self, message: str) -> str:
        for path, name in self.names.items():
            message = message.replace(path, name)
        return message


def _labelled(entries: Any) -> Any:
    """Labels Scenes by their names, because their temporary files have arbitrary names: "beam", "beam 2"."""
    if not isinstance(entries, (list, tuple)):
        return entries
    found, seen = [], Counter[str]()
    for entry in ({"file": e} if isinstance(e, Scene) else e for e in entries):
        if isinstance(entry, Mapping) and isinstance(entry.get("file"), Scene) and "label" not in entry:
            name = entry["file"].name
            seen[name] += 1
            entry = {**entry, "label": name if seen[name] == 1 else f"{name} {seen[name]}"}
        found.append(entry)
    return found


def _name(study: Mapping[str, Any]) -> str:
    """Name of the result folder, from the title."""
    return re.sub(r"[^a-z0-9]+", "_", str(study.get("title", "")).lower()).strip("_") or "study"


_FOLDER = {"compare": "comparisons", "sweep": "sweeps", "stability": "stability", "converge": "convergence",
           "fit": "fits"}
_TABLE = {"compare": "compare.csv", "sweep": "sweep.csv", "stability": "stability.csv", "converge": "convergence.csv",
          "fit": "parameters.csv"}


def _start(call: _Call, file: str, folder: Path, named: Callable[[str], str]) -> None:
    """Runs the program. Ctrl-C ends it with the finished points kept; a second Ctrl-C kills it."""
    environment = {**os.environ, "ORTHODYN_END_WITH_PARENT": "1"}
    if sys.executable:
        environment["ORTHODYN_DRAW_PYTHON"] = sys.executable
    with tempfile.TemporaryFile() as errors:
        # With its own process group, the program receives Ctrl-C only from this function, once.
        with subprocess.Popen(call.arguments(file, folder), stdout=subprocess.DEVNULL if call.quiet else None, stderr=errors,
                              env=environment, process_group=0) as process:
            try:
                process.wait()
            except BaseException as interrupt:
                interrupt.add_note(f"Finished points are kept in {folder}; the same call continues from there.")
                _end(process)
                raise
        errors.seek(0)
        said = named(_core.in_python(errors.read().decode(errors="replace").strip()))
    if process.returncode == CONFIG_ERROR:
        raise _core.ConfigError(said.removeprefix("error: "))
    if process.returncode:
        raise _core.RunError(said or f"{program()} {call.kind} ended with exit code {process.returncode}")
    if said and not call.quiet:
        sys.stderr.write(said + "\n")


def _end(process: subprocess.Popen[bytes]) -> None:
    process.send_signal(signal.SIGINT)
    try:
        process.wait()
    except BaseException:
        process.kill()
        process.wait()
        raise
