"""Scenes: a body, its loads and supports, and the method of computation."""
from __future__ import annotations

import json
import re
import shutil
import tempfile
import warnings
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from . import _core
from .model import Model
from .progress import Progress
from .result import TEMPORARY, Result


class OrthodynWarning(UserWarning):
    """A warning of the program about a scene or a result."""


class Scene:
    """A scene from a dict with the content of its YAML file. `Scene.load` reads a file. Scenes are immutable: `set` and
    `with_integrator` return a new one."""

    def __init__(self, scene: Mapping[str, Any], name: str = "scene") -> None:
        """`name` replaces the file name in messages; file names in the scene are relative to the working directory."""
        if not isinstance(scene, Mapping):
            raise TypeError(f"expected a scene as a dict, found {scene!r}; Scene.load reads a file")
        self._text = as_yaml(scene)
        self.name = name
        self._file = str(Path(f"{name}.yaml").absolute())
        self._is_file = False
        self._set: tuple[str, ...] = ()
        self._integrator: str | None = None

    @classmethod
    def load(cls, file: str | Path) -> Scene:
        """Reads a YAML file. Raises ConfigError if it cannot be read."""
        try:
            text = Path(file).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise _core.ConfigError(f"{file}: cannot be read: {getattr(error, 'strerror', None) or error}") from None
        made = cls({}, Path(file).stem)
        made._text, made._file, made._is_file = text, str(Path(file).absolute()), True
        made._simulation()
        return made

    def set(self, path: str, value: Any) -> Scene:
        """A scene with another value at a path such as "integrator.rtol" or "materials.spruce.young.0". A str is read as YAML,
        as with --set on the command line: "12 GPa", "null"."""
        return self._changed(_set=(*self._set, f"{path}={value if isinstance(value, str) else as_yaml(value)}"))

    def with_integrator(self, name: str) -> Scene:
        """A scene with another integrator. Options that this integrator also has are kept."""
        known = _core.integrators()
        if name not in known:
            raise _core.ConfigError(f"no integrator '{name}'; there are {', '.join(known)}")
        return self._changed(_integrator=name)

    def _changed(self, **attributes: Any) -> Scene:
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__, **attributes)
        made._simulation()  # reports an invalid change immediately
        return made

    def _simulation(self) -> _core.Simulation:
        with self._by_name():
            return _core.Simulation.from_text(self._text, self._file, list(self._set), self._integrator)

    def _named(self, text: str) -> str:
        """The message `text`. For a scene from a dict, its name replaces the file and line."""
        return text if self._is_file else re.sub(re.escape(self._file) + r"(:\d+)*", lambda _: self.name, text)

    @contextmanager
    def _by_name(self) -> Iterator[None]:
        try:
            yield
        except (_core.ConfigError, _core.RunError) as error:
            error.args = tuple(self._named(part) if isinstance(part, str) else part for part in error.args)
            raise

    @property
    def folder(self) -> Path:
        """The folder to which file names in the scene are relative."""
        return Path(self._file).parent

    def to_yaml(self) -> str:
        """The scene as YAML, including its changes."""
        return self._simulation().resolved()

    def model(self) -> Model:
        """The finite element model. Raises ConfigError for an invalid scene."""
        simulation = self._simulation()
        with self._by_name():
            return Model(_core.SceneModel(simulation))

    def run(self, out: str | Path | None = None, *, force: bool = False, resume: bool = False, estimate_error: bool = False,
            fields: Iterable[str] | None = None, progress: bool | None = None) -> Result:
        """Runs the scene, as `orthodyn run` does, and returns the result.

        out             folder of the output files; default a temporary folder that is deleted with the result
        force           replace an earlier result in the folder
        resume          continue from the checkpoint in the folder
        estimate_error  repeat the run more accurately to estimate its error
        fields          fields kept in memory at each output, in double precision; default those that the scene writes
        progress        show the progress; default in a terminal or a notebook

        Warnings are `OrthodynWarning`s. Raises ConfigError for invalid input, before the computation starts, and
        RunError if the computation fails. The RunError's `result` holds what was computed so far. Ctrl-C ends the run
        after the current step; the KeyboardInterrupt also has a `result`. Other threads continue during the run.
        """
        holder = tempfile.mkdtemp(prefix=TEMPORARY) if out is None else None
        folder = Path(out) if out is not None else Path(str(holder)) / self.name
        if fields is not None:
            fields = [fields] if isinstance(fields, str) else list(fields)
            self._check_fields(fields)
        result = Result(folder)
        if holder:
            weakref.finalize(result, shutil.rmtree, holder, True)
        callbacks = _Callbacks(Progress(self.name, progress), self._named)
        simulation = self._simulation()
        try:
            with self._by_name():
                status, message, kept = simulation.run(str(folder), force, resume, estimate_error, fields, callbacks)
        except KeyboardInterrupt as interrupt:
            interrupt.result = result  # type: ignore[attr-defined]
            raise
        finally:
            callbacks.progress.end()
        result._keep(kept)
        for text in result.record.get("warnings", ()):
            if text not in callbacks.texts:
                warnings.warn(self._named(_core.in_python(text)), OrthodynWarning, stacklevel=2)
        if status == "failed":
            error = _core.RunError(self._named(_core.in_python(message)))
            error.result = result  # type: ignore[attr-defined]
            raise error
        return result

    def _check_fields(self, fields: list[str]) -> None:
        known = self.model().fields
        for name in fields:
            if name not in known:
                raise ValueError(f"no field '{name}'; there are {', '.join(known)}")

    def __repr__(self) -> str:
        changes = "".join(f", {change}" for change in self._set)
        return f"Scene({self.name}{changes})"


class _Callbacks:
    """Callbacks of a run for warnings, notices and progress. `named` converts the messages."""

    def __init__(self, progress: Progress, named: Callable[[str], str]) -> None:
        self.progress = progress
        self._named = named
        self.texts: set[str] = set()

    def on_warning(self, text: str) -> None:
        self.texts.add(text)
        warnings.warn(self._named(_core.in_python(text)), OrthodynWarning, stacklevel=3)

    def on_notice(self, text: str) -> None:
        self.progress.say(_core.in_python(text))

    def on_progress(self, time: float, end: float) -> None:
        self.progress.show(time, end)


def as_yaml(value: Any) -> str:
    """Any value of a scene, including numpy numbers and arrays, as JSON, which is valid YAML."""
    def plain(item: Any) -> Any:
        if hasattr(item, "tolist"):
            return item.tolist()
        if isinstance(item, Path):
            return str(item)
        raise TypeError(f"{type(item).__name__} cannot be used in a scene: {item!r}")
    return json.dumps(value, default=plain, ensure_ascii=False)
