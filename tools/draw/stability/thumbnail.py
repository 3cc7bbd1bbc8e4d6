"""A small picture of a body as the text of an image in a page."""
import base64
import io

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

WIDTH, LOWEST, HIGHEST = 180, 100, 180  # px of the page
SHARPNESS = 2  # pixels of the picture in one of the page
COLOURS = 96  # of the palette
BUDGET = 3000  # small triangles
FAST_OCTREE = 2  # the one method of Pillow's that keeps what is transparent


def height(scene):
    """Pixels of the page that the scene's window asks for."""
    across, up = scene.window.size
    return int(np.clip(WIDTH * up / across, LOWEST, HIGHEST))


def _drawn(scene, index):
    tall = height(scene)
    figure = Figure(figsize=(WIDTH / 72, tall / 72), dpi=72 * SHARPNESS)
    figure.patch.set_alpha(0)
    canvas = FigureCanvasAgg(figure)
    xlim, ylim = scene.window.fitted(WIDTH, tall, margin=0.04)
    axes = figure.add_axes([0, 0, 1, 1], xlim=xlim, ylim=ylim)
    axes.axis("off")
    scene.draw(axes, index, BUDGET)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())


def picture(scene, index):
    """(data URI, width, height) of the body at a frame, on a transparent ground."""
    stream = io.BytesIO()
    Image.fromarray(_drawn(scene, index), "RGBA").quantize(COLOURS, method=FAST_OCTREE).save(stream, "PNG",
                                                                                             optimize=True)
    return "data:image/png;base64," + base64.b64encode(stream.getvalue()).decode("ascii"), WIDTH, height(scene)
