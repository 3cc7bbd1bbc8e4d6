"""Maps of a field of stiffness factors: the factors, and half of their 95 % intervals. A grid of several layers along z is
drawn layer by layer."""
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

from ..report.layout import PixelLayout, styled
from ..report.theme import LIGHT
from .numbers import minus

BAR, GAP, TITLE, FOOT = 64, 26, 30, 40  # px
MOST_LAYERS = 4


class _Plane:
    """The axes (0, 1, 2 for x, y, z) along and across a map, and the axis of its layers: that with the fewest cells."""

    def __init__(self, field):
        self.layer = min(range(3), key=lambda a: (field.grid[a], -a))
        self.along, self.across = (a for a in range(3) if a != self.layer)

    def layers(self, values):
        """The array, by layer, then across, then along."""
        return np.transpose(values, (2 - self.layer, 2 - self.across, 2 - self.along))


def _drawn(count):
    """Indices of the drawn layers, from the lowest to the highest."""
    return range(count) if count <= MOST_LAYERS else np.unique(np.linspace(0, count - 1, MOST_LAYERS).round().astype(int))


def _height(field, plane, width):
    along, across = (field.high_corner[a] - field.low_corner[a] for a in (plane.along, plane.across))
    return min(max(width * across / along, 36), 320)


def _map(layout, field, plane, values, box, colours, limits):
    axes = layout.axes(*box)
    edges = [1e3 * np.linspace(field.low_corner[a], field.high_corner[a], field.grid[a] + 1)
             for a in (plane.along, plane.across)]
    image = axes.pcolormesh(*edges, values, cmap=colours, vmin=limits[0], vmax=limits[1], lw=0)
    axes.grid(False)
    axes.tick_params(labelsize=10)
    return image


def _bar(layout, image, box, limits):
    axes = layout.axes(*box)
    levels = np.linspace(*limits, 33)
    axes.pcolormesh([0, 1], levels, levels[:-1, None], cmap=image.get_cmap(), lw=0)
    axes.set_xticks([])
    axes.grid(False)
    axes.yaxis.tick_right()
    axes.set_yticks(limits, [minus(f"{v:.3g}") for v in limits])


@styled
def draw_field(field, width):
    colours = LinearSegmentedColormap.from_list("field", [LIGHT["c2"], LIGHT["paper"], LIGHT["c1"]])
    shades = LinearSegmentedColormap.from_list("interval", [LIGHT["paper"], LIGHT["ink"]])
    across, left = width - 48 - BAR, 48
    plane = _Plane(field)
    height = _height(field, plane, across)
    layers = _drawn(field.grid[plane.layer])
    rows = [("stiffness factors", field.factors, colours)]
    if np.isfinite(field.half_widths).any():
        rows.append(("half of the 95 % interval, relative", field.half_widths, shades))
    layout = PixelLayout(width, len(rows) * (TITLE + len(layers) * (height + GAP)) + FOOT)
    top = 0
    for title, values, colour in rows:
        limits = float(np.nanmin(values[np.isfinite(values)])), float(np.nanmax(values[np.isfinite(values)]))
        if colour is colours:  # white for a factor of 1
            far = max(abs(limits[0] - 1), abs(limits[1] - 1), 1e-6)
            limits = 1 - far, 1 + far
        elif limits[1] <= limits[0]:
            limits = limits[0], limits[0] + 1e-6
        layout.text(0, top + 14, f"{field.name}: {title}", weight="bold")
        top += TITLE
        for layer in layers:
            image = _map(layout, field, plane, plane.layers(values)[layer], (left, top, across, height), colour, limits)
            if len(layers) > 1:
                layout.text(left, top + height + 20, f"layer {layer + 1} of {field.grid[plane.layer]} along {'xyz'[plane.layer]}")
            _bar(layout, image, (left + across + 12, top, 12, height), limits)
            top += height + GAP
    layout.text(left + across / 2, top + 16, f"{'xyz'[plane.along]} [mm]; upward {'xyz'[plane.across]} [mm]", ha="center")
    layout.description = (f"{field.name}: factors from {np.nanmin(field.factors):.3g} to {np.nanmax(field.factors):.3g} on a grid "
                          f"of {' x '.join(map(str, field.grid))} cells.")
    return layout
