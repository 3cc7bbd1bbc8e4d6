"""Thumbnail of a body as a data URI."""
import base64
import io

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

WIDTH, LOWEST, HIGHEST = 180, 100, 180  # pixels of the page: width, smallest and largest height
SHARPNESS = 2  # picture pixels per page pixel
COLOURS = 96  # number of colours in the palette
BUDGET = 3000  # largest number of small triangles
FAST_OCTREE = 2  # Pillow's only method of quantisation that keeps transparency


def height(scene):
    """Height of the thumbnail (pixels of the page) that fits the scene's window."""
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
    """(data URI, width, height) of a picture of the body at a frame, with a transparent background."""
    stream = io.BytesIO()
    Image.fromarray(_drawn(scene, index), "RGBA").quantize(COLOURS, method=FAST_OCTREE).save(stream, "PNG",
                                                                                             optimize=True)
    return "data:image/png;base64," + base64.b64encode(stream.getvalue()).decode("ascii"), WIDTH, height(scene)
