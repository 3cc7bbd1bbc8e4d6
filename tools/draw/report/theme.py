"""Colours and markers: one pair for each method, the same in every figure and table.

Figures are drawn in the colours of the light theme; in the page each colour becomes a CSS variable.
The hues are Okabe and Ito's (2008) and Tol's, darkened to a contrast of 3 on white; markers distinguish
methods where hues do not.
"""
from matplotlib.markers import MarkerStyle

LIGHT = {
    "paper": "#ffffff", "ink": "#1d2330", "muted": "#647084", "rule": "#e4e7ec", "band": "#f0f2f5", "lane": "#f8eeec",
    "c1": "#0b6fb0", "c2": "#d3560a", "c3": "#0a8a66", "c4": "#a8459b", "c5": "#a67c00", "c6": "#2b93c4",
    "c7": "#882255", "c8": "#6f7a8c",
    "k1": "#1f3a5f", "k2": "#3f6d9e", "k3": "#7ba3c8", "k4": "#b5cde2", "k5": "#d9dce1",
}
DARK = {
    "paper": "#14171d", "ink": "#e6e9ef", "muted": "#98a2b3", "rule": "#2b313b", "band": "#1f242d", "lane": "#2c2022",
    "c1": "#58aef0", "c2": "#ff8f52", "c3": "#3ecaa0", "c4": "#e08ad6", "c5": "#e0bb45", "c6": "#8fdcff",
    "c7": "#ef7fa9", "c8": "#a9b2c0",
    "k1": "#d5e4f5", "k2": "#93bbe4", "k3": "#5a8cc0", "k4": "#38608c", "k5": "#454c58",
}
MARKERS = ("o", "s", "^", "D", "v", "P", "p", "*", "<", "h", ">", "d")
SIZES = {"s": 0.9, "D": 0.86, "*": 1.4, "P": 1.2, "h": 1.1, "p": 1.15, "^": 1.12, "v": 1.12, "<": 1.12, ">": 1.12}
HUES = 8
FAILURE = {"marker": "x", "mew": 1.9, "ms": 7, "ls": "none"}


def colour(index):
    return LIGHT[f"c{index % HUES + 1}"]


def variable(index):
    return f"var(--c{index % HUES + 1})"


def marker(index):
    return MARKERS[index % len(MARKERS)]


def marker_size(index, size):
    return size * SIZES.get(marker(index), 1.0)


def dashes(index):
    """The dash pattern of a method's line. Methods beyond the eighth use the same hues again, with dashes."""
    return "-" if index < HUES else (0, (4, 2))


def glyph(index, size=8.0):
    """The marker as an SVG path around the origin, for legends in the page."""
    style = MarkerStyle(marker(index))
    path = style.get_path().transformed(style.get_transform())
    scale = marker_size(index, size)
    commands = {1: "M", 2: "L", 3: "Q", 4: "C", 79: "Z"}
    parts, previous = [], None
    for vertex, code in zip(path.vertices, path.codes if path.codes is not None else [1] + [2] * len(path)):
        letter = commands[int(code)]
        if letter == "Z":
            parts.append("Z")
        else:
            point = f"{scale * vertex[0]:.2f} {-scale * vertex[1]:.2f}"
            parts.append(point if letter == previous and letter in "QC" else letter + point)
        previous = letter
    return " ".join(parts)
