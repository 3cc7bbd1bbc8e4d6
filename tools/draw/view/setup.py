"""Held and loaded nodes from setup.vtu, which `orthodyn run` writes with the frames."""
import numpy as np

from ..errors import DrawError
from ..vtu import read_vtu


def add_setup(blocks, key, folder, num_points, shown):
    """Adds blocks of the held nodes and of the loaded nodes with their forces. Returns how many there are of each."""
    path = folder and folder / "setup.vtu"
    if not path or not path.is_file():
        return {"held": 0, "loaded": 0}
    frame = read_vtu(path)
    if len(frame.points) != num_points:
        raise DrawError(f"{path}: {len(frame.points)} nodes, but the frames have {num_points}")
    counts = {}
    for kind, field in (("held", "held"), ("loaded", "load")):
        values = frame.node_fields.get(field)
        nodes = np.zeros(0, int) if values is None else np.intersect1d(np.nonzero(values.any(axis=1))[0], shown.nodes)
        counts[kind] = len(nodes)
        if len(nodes):
            blocks.add(f"{key}/{kind}", "u32", shown.node(nodes))
            if kind == "loaded":
                blocks.add(f"{key}/load_values", "f32", values[nodes])
    return counts
