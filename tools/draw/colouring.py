"""Maps values to colours, with one range for all frames of a picture."""
import matplotlib
import numpy as np
from matplotlib.colors import ListedColormap, Normalize

from .units import prefix

# From Paul Tol's qualitative schemes "bright" and "muted" (personal.sron.nl/~pault).
CATEGORIES = ("#4477AA", "#EE8866", "#228833", "#CCBB44", "#AA3377", "#66CCEE", "#BBBBBB", "#882255", "#44AA99")
NOT_A_NUMBER = "#E6007E"
FEW_BEYOND = 0.4  # percentage of a peaked field's values that the colour range leaves out at each end


def _cut(name, low, high):
    return ListedColormap(matplotlib.colormaps[name](np.linspace(low, high, 256)))


SEQUENTIAL, DIVERGING = _cut("viridis", 0.06, 1.0), _cut("RdBu_r", 0.06, 0.94)


class Colouring:
    """Colour map and range. `below`, `above`: whether values lie outside the range; `has_nan`: whether some are not
    numbers."""

    def __init__(self, quantity, samples, limits=None):
        finite = np.concatenate([s[np.isfinite(s)] for s in samples])
        self.quantity = quantity
        self.has_nan = any(np.isnan(s).any() for s in samples)
        self.categories = np.unique(finite).astype(int) if quantity.categorical else None
        low, high = limits or self._range(finite)
        self.factor, self.unit = prefix(quantity.unit, max(abs(low), abs(high)))
        self.norm = Normalize(low / self.factor, high / self.factor)
        self.below, self.above = bool((finite < low).any()), bool((finite > high).any())
        self.map = (DIVERGING if quantity.neutral is not None else SEQUENTIAL).with_extremes(bad=NOT_A_NUMBER)

    def _range(self, finite):
        if finite.size == 0:
            return 0.0, 1.0
        ends = (FEW_BEYOND, 100 - FEW_BEYOND) if self.quantity.peaked else (0, 100)
        low, high = np.percentile(finite, ends)
        neutral = self.quantity.neutral
        if neutral is not None:
            half = max(high - neutral, neutral - low)
            low, high = neutral - half, neutral + half
        elif self.quantity.kind in ("magnitude", "von_mises"):
            low = 0.0 if low < 0.3 * high else low
        if not high - low > 1e-12 * max(abs(high), abs(low)):
            pad = 0.05 * abs(high) if high else 1.0
            low, high = (low, high + pad) if low == 0 else (low - pad, high + pad)
        return float(low), float(high)

    def __call__(self, values):
        """RGB (..., 3)."""
        if self.categories is None:
            return self.map(self.norm(np.ma.masked_invalid(values / self.factor)))[..., :3]
        table = np.array([matplotlib.colors.to_rgb(c) for c in CATEGORIES])
        return table[np.nan_to_num(values).round().astype(int) % len(CATEGORIES)]

    def samples(self, count):
        """RGB (k,3): at most about `count` colours that represent the map."""
        if self.categories is None:
            return np.vstack([self.map(np.linspace(0, 1, count))[:, :3], self.map.get_bad()[None, :3]])
        return self(self.categories.astype(float))

    @property
    def label(self):
        return f"{self.quantity.label} [{self.unit}]" if self.unit else self.quantity.label
