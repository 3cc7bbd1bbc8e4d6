"""Grades as word, symbol and colour. The colour only repeats what symbol and word say.

Nearly everyone can distinguish blue and orange (Okabe and Ito 2008). A fail has the strongest colour, a refusal the
palest.
"""
from ..report.markup import Html, joined, tag
from ..report.theme import LIGHT

# The symbols as strokes in a field of 16 x 16; y points down.
GRADES = {
    "pass": [[(3.5, 8.5), (6.5, 11.5), (12.5, 4.5)]],
    "degraded": [[(2.8, 9.4), (4.4, 7.2), (6.2, 6.8), (9.8, 9.2), (11.6, 8.8), (13.2, 6.6)]],
    "fail": [[(4, 4), (12, 12)], [(12, 4), (4, 12)]],
    "refused": [[(4.5, 8), (11.5, 8)]],
}
MEANING = {
    "pass": "every expectation is met",
    "degraded": "outside the limit, but not by much",
    "fail": "far outside the limit, or the run stopped",
    "refused": "the integrator says that it cannot serve the scene",
}
COLOURS = {  # (theme colour, its opacity in the field, colour of the symbol)
    "pass": ("c1", 0.16, "c1"), "degraded": ("c5", 0.45, "ink"), "fail": ("c2", 1.0, "paper"),
    "refused": ("band", 1.0, "muted")}
UNTRIED = "not tried yet"


def field_colour(grade):
    """The colour of a field in pictures, '#rrggbb' on white."""
    name, share, _ = COLOURS[grade]
    parts = (int(LIGHT[name][k:k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(share * x + (1 - share) * 255):02x}" for x in parts)


def symbol_colour(grade):
    return LIGHT[COLOURS[grade][2]]


def css():
    """CSS rules for the field and symbol of every grade, with the theme's variables."""
    return "".join(f".g-{grade}{{background:color-mix(in srgb,var(--{name}) {100 * share:.0f}%,var(--paper));"
                   f"color:var(--{ink})}}" for grade, (name, share, ink) in COLOURS.items())


def symbols():
    """The SVG definitions of all symbols, needed once per page."""
    def path(strokes):
        return "".join("M" + "L".join(f"{x:g} {y:g}" for x, y in stroke) for stroke in strokes)
    found = [f'<symbol id="s-{grade}" viewBox="0 0 16 16"><path d="{path(strokes)}"/></symbol>'
             for grade, strokes in GRADES.items()]
    return Html(f'<svg class="glyphs" width="0" height="0" aria-hidden="true">{"".join(found)}</svg>')


def symbol(grade):
    return Html(f'<svg aria-hidden="true"><use href="#s-{grade}"/></svg>')


def named(grade, words=None):
    """The field of a grade with its symbol, followed by the word."""
    return joined([tag("span", symbol(grade), class_=f"mark g-{grade}"), words or grade])
