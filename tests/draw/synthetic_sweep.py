"""A sweep.json with values from a formula."""
import itertools
import json

from tiny_result import Vtu, fields_at


def variable(name, numeric=True, unit="", scale="linear"):
    return {"name": name, "path": "", "unit": unit, "numeric": numeric, "scale": scale}


def sweep(levels, closed_form="2*a", combine="cartesian", **changes):
    """`levels`: values by variable; the metric f is the sum of the numbers in mm, the closed form 1 % more."""
    points = []
    for values in itertools.product(*levels.values()):
        value = sum(v for v in values if not isinstance(v, str)) + 1.0
        points.append({"title": ", ".join(map(str, values)), "status": "completed", "folder": f"points/{len(points)}",
                       "values": dict(zip(levels, values)), "metrics": {"f": 1e-3 * value}, "reason": None,
                       "message": None,
                       "closed_forms": {"f": 1.01e-3 * value if closed_form else None}, "frame": None,
                       "cost": {"wall_seconds": 0.1, "steps": 7}, "model": {"unknowns": 3}})
    return {"orthodyn_sweep": 1, "name": "s", "title": "A & B", "description": "", "combine": combine, "file": "s.yaml",
            "scene": "scene.yaml", "written": "2026-01-31T12:00:00Z", "missing": 0, "machine": {"processor": "x"},
            "versions": {"orthodyn": "0"}, "plots": [], "frames": None, "definitions": {"E": "1e9"},
            "variables": [variable(k, not isinstance(v[0], str)) for k, v in levels.items()],
            "metrics": [{"name": "f", "title": "deflection", "unit": "mm", "factor": 1e-3, "scale": "linear",
                         "closed_form": closed_form}], "points": points, **changes}


def write_sweep(folder, content):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "sweep.json").write_text(json.dumps(content))
    return folder


def write_frames(folder, content):
    """A frame for every point; each later one has moved farther."""
    for k, point in enumerate(content["points"]):
        (folder / point["folder"]).mkdir(parents=True)
        (folder / point["folder"] / "frame.vtu").write_bytes(Vtu().content(*fields_at(0.1 * k)))
        point["frame"] = "frame.vtu"
    content["frames"] = {"at": None, "color": "displacement", "view": [-60, 20], "up": "z", "enlarged": 1, "most": 5, "ghost": True}
    return content
