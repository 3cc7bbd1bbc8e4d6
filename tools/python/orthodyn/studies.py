"""Studies: many runs, one data frame. Each run is a process of its own, as with the program."""
from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from .notebook import Page
from .scene import Scene, as_yaml

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

HERE = Path(__file__).parent  # not resolved: of links in a build tree
CONFIG_ERROR = 2


@dataclass(frozen=True)
class Study:
    """What a study wrote: its points as a data frame, its folder, and the page that tells what it says."""
    kind: str
    folder: Path
    table: pandas.DataFrame

    @property
    def report(self) -> Path:
        return self.folder / "report.html"

    def show(self, height: int = 700) -> Page:
        """The report, which a notebook shows."""
        return Page(self.report, height)

    def plot(self, x: str, y: str, by: str | None = None, ax: Axes | None = None, *, log: bool = False) -> Axes:
        """One column over another, a line for each value of a third."""
        from .plots import new_axes
        x, y, by = (name and self.column(name) for name in (x, y, by))
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
        """The column of that name, with its unit: "deflection" is "deflection [m]"."""
        found = [c for c in self.table.columns if c == name or c.split(" [")[0] == name]
        if not found:
            raise KeyError(f"no column '{name}'; there are {', '.join(self.table.columns)}")
        return found[0]

    def __repr__(self) -> str:
        return f"Study({self.kind}, {len(self.table)} points, {self.folder})"


def compare(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, quiet: bool = False) -> Study:
    """Integrators on scenes: error against time. `study`: a YAML file, or a dict as it would hold:

        orthodyn.compare({"title": "Beam", "scenes": [scene], "integrators": ["cvode_bdf", "tr_bdf2"],
                          "tolerances": [1e-2, 1e-4]})

    A scene is a file, or a `Scene`.
    """
    return _run("compare", "compare.csv", study, out, quiet)


def sweep(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, quiet: bool = False) -> Study:
    """A scene over values of its keys:

        orthodyn.sweep({"title": "Stiffer", "scene": scene, "vary": {"materials.spruce.young.0": ["8 GPa", "12 GPa"]},
                        "quantities": {"deflection": {"quantity": "tip.displacement.z"}}})

    A scene is a file, a `Scene`, or {"file": one of these, "set": {"damping.stiffness": "=zeta/30"}}, where what is varied
    may have a name of its own, "vary": {"zeta": [0.01, 0.1]}.
    """
    return _run("sweep", "sweep.csv", study, out, quiet)


def stability(study: str | Path | Mapping[str, Any], out: str | Path | None = None, *, quiet: bool = False) -> Study:
    """Integrators on hard cases: which keep what they should."""
    return _run("stability", "stability.csv", study, out, quiet)


def converge(study: str | Path | Scene, out: str | Path | None = None, *, quiet: bool = False) -> Study:
    """A scene, or its file, on finer and finer meshes."""
    return _run("converge", "convergence.csv", study, out, quiet)


def program() -> str:
    """The program `orthodyn`: that of this package, else the first on the PATH."""
    own = [HERE / "bin" / "orthodyn", *(parent / "orthodyn" for parent in HERE.parents[:2]),  # of a wheel, a build tree,
           *(parent / "bin" / "orthodyn" for parent in HERE.parents[3:4])]  # and of a prefix
    found = next((str(path) for path in own if path.is_file() and os.access(path, os.X_OK)), shutil.which("orthodyn"))
    if not found:
        raise FileNotFoundError("the program `orthodyn` is neither in this package nor on the PATH")
    return found


def _run(kind: str, table: str, study: Any, out: str | Path | None, quiet: bool) -> Study:
    import pandas
    with ExitStack() as written:
        if isinstance(study, Scene):
            file, name = _with_files(kind, study, written), study.name
        elif isinstance(study, Mapping):
            file, name = written.enter_context(_file(kind, as_yaml(_with_files(kind, study, written)))), _name(study)
        else:
            file, name = str(study), Path(study).stem
        folder = Path(out) if out else Path("out") / _PLURAL[kind] / name
        _call(kind, file, folder, quiet)
    return Study(kind, folder, pandas.read_csv(folder / table))


@contextmanager
def _file(kind: str, text: str, folder: Path = Path(".")) -> Iterator[str]:
    """A file for the program: what it names is looked for beside it."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", prefix=f".{kind}-", dir=folder, encoding="utf-8", delete=False) as stream:
        stream.write(text)
    try:
        yield os.path.abspath(stream.name)
    finally:
        os.unlink(stream.name)


def _with_files(kind: str, item: Any, written: ExitStack) -> Any:
    """The same with a file for each Scene."""
    if isinstance(item, Scene):
        return written.enter_context(_file(kind, item.to_yaml(), item.folder))
    if isinstance(item, Mapping):
        return {key: _with_files(kind, value, written) for key, value in item.items()}
    return [_with_files(kind, value, written) for value in item] if isinstance(item, (list, tuple)) else item


def _name(study: Mapping[str, Any]) -> str:
    """Of its folder, from its title."""
    return re.sub(r"[^a-z0-9]+", "_", str(study.get("title", "")).lower()).strip("_") or "study"


_PLURAL = {"compare": "comparisons", "sweep": "sweeps", "stability": "stability", "converge": "convergence"}


def _call(kind: str, file: str, folder: Path, quiet: bool) -> None:
    ended = subprocess.run([program(), kind, file, "--out", str(folder)], stdout=subprocess.DEVNULL if quiet else None,
                           stderr=subprocess.PIPE, text=True, check=False)
    if ended.returncode == CONFIG_ERROR:
        raise _core.ConfigError(ended.stderr.strip().removeprefix("error: "))
    if ended.returncode:
        raise _core.RunError(ended.stderr.strip() or f"{program()} {kind} ended with {ended.returncode}")
    if ended.stderr and not quiet:
        sys.stderr.write(ended.stderr)
