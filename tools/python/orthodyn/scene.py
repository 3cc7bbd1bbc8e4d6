"""A scene: one body, what acts on it, and how its motion is computed."""
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
from .progress import Progress, Silence
from .result import TEMPORARY, Result


class OrthodynWarning(UserWarning):
    """What the program prints as a warning: something about a scene or a result that should not be taken on trust."""


class Scene:
    """A scene from a dict, as its YAML file would hold it. `Scene.load` reads a file. A scene never changes: `set` and
    `with_integrator` return another one."""

    def __init__(self, scene: Mapping[str, Any], name: str = "scene") -> None:
        """`name` stands for the file in messages; files that the scene names are looked for in the working directory."""
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
        """The scene of a YAML file. Raises ConfigError if it cannot be read."""
        try:
            text = Path(file).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise _core.ConfigError(f"{file}: cannot be read: {getattr(error, 'strerror', None) or error}") from None
        made = cls({}, Path(file).stem)
        made._text, made._file, made._is_file = text, str(Path(file).absolute()), True
        made._simulation()
        return made

    def set(self, path: str, value: Any) -> Scene:
        """The scene with another value at a path such as "integrator.rtol" or "materials.spruce.young.0". A str is YAML, as
        after --set on the command line: "12 GPa", "null"."""
        return self._changed(_set=(*self._set, f"{path}={value if isinstance(value, str) else as_yaml(value)}"))

    def with_integrator(self, name: str) -> Scene:
        """The scene with another integrator; options that both have are kept."""
        known = _core.integrators()
        if name not in known:
            raise _core.ConfigError(f"no integrator '{name}'; there are {', '.join(known)}")
        return self._changed(_integrator=name)

    def _changed(self, **attributes: Any) -> Scene:
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__, **attributes)
        made._simulation()  # a change that does not apply is told where it is made
        return made

    def _simulation(self) -> _core.Simulation:
        with self._by_name():
            return _core.Simulation.from_text(self._text, self._file, list(self._set), self._integrator)

    def _named(self, text: str) -> str:
        """A message, in which a scene from a dict goes by its name: there is no file, and no line."""
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
        """Where files that it names are looked for."""
        return Path(self._file).parent

    def to_yaml(self) -> str:
        """The scene as YAML, with its changes."""
        return self._simulation().resolved()

    def model(self) -> Model:
        """The finite element model. Raises ConfigError for a scene that is at fault."""
        simulation = self._simulation()
        with self._by_name():
            return Model(_core.SceneModel(simulation))

    def run(self, out: str | Path | None = None, *, force: bool = False, resume: bool = False, estimate_error: bool = False,
            fields: Iterable[str] | None = None, progress: bool | None = None) -> Result:
        """Computes the scene, as `orthodyn run` does, and returns what came of it.

        out             folder for the files; without it they are in a temporary one, which goes with the result
        force           replace an earlier result in the folder
        resume          go on from the checkpoint in the folder
        estimate_error  then repeat the run more accurately, and compare
        fields          what is kept in memory at each output; default what the scene writes. All at double precision
        progress        show how far it is; default in a terminal or a notebook

        Warnings are `OrthodynWarning`s. Raises ConfigError before anything is computed, and RunError where the computation
        could not go on: its `result` holds what was computed so far. Ctrl-C ends the run after the step that it is in; the
        KeyboardInterrupt has a `result`, too. Other threads run on meanwhile.
        """
        holder = tempfile.mkdtemp(prefix=TEMPORARY) if out is None else None
        folder = Path(out) if out is not None else Path(str(holder)) / self.name
        if fields is not None:
            fields = [fields] if isinstance(fields, str) else list(fields)
            self._check_fields(fields)
        result = Result(folder)
        if holder:
            weakref.finalize(result, shutil.rmtree, holder, True)
        told = _Told(Progress(self.name) if Progress.wanted(progress) else Silence(), self._named)
        simulation = self._simulation()
        try:
            with self._by_name():
                status, message, kept = simulation.run(str(folder), force, resume, estimate_error, fields, told)
        except KeyboardInterrupt as interrupt:
            interrupt.result = result  # type: ignore[attr-defined]
            raise
        finally:
            told.progress.end()
        result._keep(kept)
        for text in result.record.get("warnings", ()):
            if text not in told.texts:
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


class _Told:
    """What a run tells while it works; `named` is what its messages go through."""

    def __init__(self, progress: Progress | Silence, named: Callable[[str], str]) -> None:
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
    """Any value of a scene as YAML, which JSON is; numpy's numbers and arrays too."""
    def plain(item: Any) -> Any:
        if hasattr(item, "tolist"):
            return item.tolist()
        if isinstance(item, Path):
            return str(item)
        raise TypeError(f"{type(item).__name__} has no meaning in a scene: {item!r}")
    return json.dumps(value, default=plain, ensure_ascii=False)
