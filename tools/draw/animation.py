"""Frames as an animated GIF with one palette, scaled down until it fits a file size."""
import io

import matplotlib
import numpy as np
from PIL import Image

from .annotations import AXIS_COLOURS
from .errors import DrawError
from .picture import frame_figure
from .style import TEXT, pyplot

DPI = 100
COLOURS = 256
BUDGET = 3500  # largest number of small triangles; more would be as small as pixels and look noisy


def _rendered(scene, index):
    """One frame as an RGB image."""
    figure = frame_figure(scene, index, budget=BUDGET)
    figure.set_dpi(DPI)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3].copy())
    pyplot.close(figure)
    return image


def _keys(pixels):
    """Colours rounded to six bits per channel, as one number."""
    coarse = pixels.astype(np.int32) >> 2
    return (coarse[..., 0] << 12) | (coarse[..., 1] << 6) | coarse[..., 2]


def _reserved(scene):
    """Colours (k,3) that must be in the palette unchanged: those of the page, the axes and the colour bar."""
    named = [matplotlib.colors.to_rgb(c) for c in ("white", TEXT, *AXIS_COLOURS)]
    return np.round(255 * np.vstack([named, scene.colouring.samples(56)])).astype(int)


def _palette(used, reserved):
    """The palette of 256 colours, which are the reserved ones and others chosen for the keys `used`; and the colour of
    each key."""
    rgb = np.stack([used >> 12, used >> 6 & 63, used & 63], axis=-1) * 4 + 2
    chosen = Image.fromarray(rgb[None].astype(np.uint8)).quantize(COLOURS - len(reserved), Image.Quantize.MEDIANCUT)
    colours = np.array(chosen.getpalette()).reshape(-1, 3)[:COLOURS - len(reserved)]
    return np.vstack([reserved, colours]), rgb


def _encoded(images, fps, reserved):
    """The GIF as bytes, with one palette for all frames. Every colour is replaced by the nearest one in the palette."""
    keys = [_keys(np.asarray(image)) for image in images]
    used = np.unique(np.concatenate([np.unique(k) for k in keys]))
    palette, rgb = _palette(used, reserved)
    nearest = np.zeros(1 << 18, np.uint8)
    nearest[used] = np.concatenate([((part[:, None] - palette) ** 2).sum(axis=-1).argmin(axis=1)
                                    for part in np.array_split(rgb, 1 + len(rgb) // 4096)])
    indexed = [Image.fromarray(nearest[k], "P") for k in keys]
    for image in indexed:
        image.putpalette(palette.astype(np.uint8).tobytes())
    stream = io.BytesIO()
    indexed[0].save(stream, "GIF", save_all=True, append_images=indexed[1:], duration=round(1000 / fps), loop=0,
                    optimize=False)
    return stream.getvalue()


def _shrunk(image, factor):
    return image.resize([max(1, round(side * factor)) for side in image.size], Image.Resampling.LANCZOS)


def draw_animation(scene, indices, path, fps=15, most_megabytes=4.0):
    images = [_rendered(scene, index) for index in indices]
    reserved = _reserved(scene)
    factor, content = 1.0, _encoded(images, fps, reserved)
    while len(content) > most_megabytes * 1e6:
        factor *= 0.95 * min(1.0, (most_megabytes * 1e6 / len(content)) ** 0.5)
        if factor < 0.2:
            raise DrawError(f"{path}: {len(images)} frames do not fit {most_megabytes:g} MB; use a larger --every")
        content = _encoded([_shrunk(image, factor) for image in images], fps, reserved)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path
