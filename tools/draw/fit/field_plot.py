"""Maps of a field of stiffness factors: the factors, and half of their 95 % intervals. A grid of several layers along z is
drawn layer by layer."""
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from ..report.layout import PixelLayout, styled
from ..report.theme import LIGHT
from .numbers import minus

BAR, GAP, TITLE, FOOT = 64, 26, 30, 40  # px
MOST_LAYERS = 4


def _layers(field):
    """Indices of the drawn layers, from the lowest to the highest."""
    count = field.grid[2]
    return range(count) if count <= MOST_LAYERS else np.unique(np.linspace(0, count - 1, MOST_LAYERS).round().astype(int))


def _height(field, width):
    x, y = (field.high_corner[a] - field.low_corner[a] for a in (0, 1))
    return min(max(width * y / x, 36), 320)


def _map(layout, field, values, box, colours, limits):
    axes = layout.axes(*box)
    (x0, y0, _), (x1, y1, _) = field.low_corner, field.high_corner
    image = axes.imshow(values, origin="lower", extent=(1e3 * x0, 1e3 * x1, 1e3 * y0, 1e3 * y1), aspect="auto", cmap=colours,
                        vmin=limits[0], vmax=limits[1], interpolation="nearest")
    axes.grid(False)
    axes.tick_params(labelsize=10)
    return image


def _bar(layout, image, box, limits):
    axes = layout.axes(*box)
    axes.imshow(np.linspace(0, 1, 64)[:, None], origin="lower", extent=(0, 1, *limits), aspect="auto", cmap=image.get_cmap())
    axes.set_xticks([])
    axes.grid(False)
    axes.yaxis.tick_right()
    axes.set_yticks(limits, [minus(f"{v:.3g}") for v in limits])


@styled
def draw_field(field, width):
    colours = LinearSegmentedColormap.from_list("field", [LIGHT["c2"], LIGHT["paper"], LIGHT["c1"]])
    shades = LinearSegmentedColormap.from_list("interval", [LIGHT["paper"], LIGHT["ink"]])
    across, left = width - 48 - BAR, 48
    height = _height(field, across)
    layers = _layers(field)
    rows = [("Stiffness factors", field.factors, colours), ("Half of the 95 % interval, relative", field.half_widths, shades)]
    layout = PixelLayout(width, len(rows) * (TITLE + len(layers) * (height + GAP)) + FOOT)
    top = 0
    for title, values, colour in rows:
        limits = float(np.nanmin(values)), float(np.nanmax(values))
        if colour is colours:  # white for a factor of 1
            far = max(abs(limits[0] - 1), abs(limits[1] - 1), 1e-6)
            limits = 1 - far, 1 + far
        elif limits[1] <= limits[0]:
            limits = limits[0], limits[0] + 1e-6
        layout.text(0, top + 14, f"{field.name}: {title[0].lower()}{title[1:]}", weight="bold")
        top += TITLE
        for layer in layers:
            image = _map(layout, field, values[layer], (left, top, across, height), colour, limits)
            if len(layers) > 1:
                layout.text(left, top + height + 20, f"layer {layer + 1} of {field.grid[2]} along z")
            _bar(layout, image, (left + across + 12, top, 12, height), limits)
            top += height + GAP
    layout.text(left + across / 2, top + 16, "x [mm]; upward y [mm]", ha="center")
    layout.description = (f"{field.name}: factors from {np.nanmin(field.factors):.3g} to {np.nanmax(field.factors):.3g} on a grid "
                          f"of {' x '.join(map(str, field.grid))} cells.")
    return layout
