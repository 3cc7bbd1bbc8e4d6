"""Dynamics of large-deformation orthotropic solids, with adaptive integrators.

    import orthodyn

    result = orthodyn.Scene.load("cantilever.yaml").set("integrator.rtol", 1e-5).run()
    result.plot("probes")
    result.view()

A `Scene` is a YAML file or a dict; running it gives a `Result` with numpy arrays. `Scene.model()` is its finite element
model; a `Problem` is a user-defined model `M q'' = f(t, q, v)` for any integrator. `compare`, `sweep`, `stability` and
`converge` run studies and return data frames.
"""
from pathlib import Path as _Path

# The drawing tool is not among the Python modules: it is installed in share/orthodyn, in the wheel or below the prefix.
_here = _Path(__file__).parent
__path__.extend(str(folder) for folder in (_here / "share" / "orthodyn", *(up / "share" / "orthodyn" for up in _here.parents[3:4]))
                if (folder / "draw").is_dir())

from ._core import ConfigError, RecoverableError, RunError
from ._core import version as __version__
from .model import Model, Modes
from .problem import Problem, Solution
from .result import Result
from .scene import OrthodynWarning, Scene
from .studies import Study, compare, converge, fit, stability, sweep

__all__ = ["ConfigError", "Model", "Modes", "OrthodynWarning", "Problem", "RecoverableError", "Result", "RunError", "Scene",
           "Solution", "Study", "__version__", "compare", "converge", "fit", "stability", "sweep"]
