"""Natural modes as small multiples: the shapes, enlarged to be seen, over the outline of the body."""
import csv
from dataclasses import replace
from pathlib import Path

import numpy as np

from .errors import DrawError
from .picture import draw_strip
from .scene import Scene, PictureSpec
from .series import Series

LARGEST = 0.12  # displacement in the picture, of the body's largest extent


class Shapes(Series):
    """modes.pvd as a series over the numbers of the modes; shapes stand where displacements are looked for."""

    def __init__(self, name):
        super().__init__(name, "modes.pvd")

    def frame(self, index):
        frame = super().frame(index)
        if "shape" not in frame.node_fields:
            raise DrawError(f"{self.paths[index]}: has no field 'shape'; did `orthodyn modes` write it?")
        shape = frame.node_fields["shape"]
        return replace(frame, points=frame.points + frame.node_fields.get("displacement", 0),
                       node_fields={"displacement": shape, "shape": shape})


class Picture(Scene):
    note = ""  # how far a shape is enlarged means nothing


def frequencies(folder):
    path = Path(folder) / "modes.csv"
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return [float(row["frequency [Hz]"]) for row in csv.DictReader(file)]
    except (KeyError, TypeError, ValueError) as error:
        raise DrawError(f"{path}: not readable as what `orthodyn modes` writes ({error})") from None


def frequency_label(hertz):
    return f"{hertz / 1000:.4g} kHz" if abs(hertz) >= 1000 else f"{hertz:.4g} Hz"


def draw_modes(folder, path, count, view, up):
    shapes, hertz = Shapes(folder), frequencies(folder)
    if len(hertz) != len(shapes):
        raise DrawError(f"{folder}: modes.csv and modes.pvd do not belong together; run `orthodyn modes` again")
    chosen = [k for k in range(len(shapes)) if hertz[k] != 0][:count]
    if not chosen:
        raise DrawError(f"{folder}: all {len(hertz)} modes are rigid; ask for more with -n")
    scale = LARGEST * float(np.ptp(shapes.frame(chosen[0]).points, axis=0).max())
    spec = PictureSpec(color="shape", view=view, up=up, scale=scale, ghost=True, limits=(0, 1))
    scene = Picture(shapes, chosen, spec)
    scene.labels = {k: f"{k + 1}: {frequency_label(hertz[k])}" for k in chosen}
    return draw_strip(scene, chosen, path)
