"""The matrix as a picture for papers and the documentation, as SVG and PNG."""
from matplotlib.patches import FancyBboxPatch

from ..report.figure_files import file_name, write_paper_figure
from ..report.layout import LETTER, PixelLayout, styled
from ..report.theme import LIGHT
from .grades import GRADES, field_colour, symbol_colour
from .ranking import ranked, tally

FIELD, GAP, BETWEEN = 18, 2, 34  # px: size of a field, gap between fields, gap between variants
STEP = FIELD + GAP
LINE = 1.6


def _draw_field(axes, x, y, grade):
    """Draws a field with its symbol. Its top left corner is at (x, y)."""
    axes.add_patch(FancyBboxPatch((x + 1, y + 1), FIELD - 2, FIELD - 2, boxstyle="round,pad=1,rounding_size=3",
                                  fc=field_colour(grade), ec="none"))
    for stroke in GRADES[grade]:
        axes.plot(*zip(*((x + FIELD * u / 16, y + FIELD * v / 16) for u, v in stroke)), color=symbol_colour(grade),
                  lw=LINE, solid_capstyle="round", solid_joinstyle="round")


def _canvas(layout):
    """Axes whose coordinates are the layout's pixels, counted from its top left corner."""
    axes = layout.axes(0, 0, layout.width, layout.height)
    axes.set(xlim=(0, layout.width), ylim=(layout.height, 0))
    axes.axis("off")
    return axes


def _legend(axes, left, y, noted):
    for grade in GRADES:
        _draw_field(axes, left, y, grade)
        axes.text(left + FIELD + 6, y + FIELD / 2, grade, va="center")
        left += FIELD + 28 + LETTER * len(grade)
    if noted:
        axes.text(left, y + FIELD / 2, "† model at fault", va="center")


def _variant(matrix, axes, left, top, variant, columns):
    middle = left + (STEP * len(columns) - GAP) / 2
    axes.text(middle, 14, variant, ha="center", va="center", weight="bold", fontsize=13)
    for k, name in enumerate(columns):
        axes.text(left + STEP * k + FIELD / 2, top - 6, name, rotation=90, ha="center", va="bottom")
    for row, case in enumerate(matrix.cases):
        for k, name in enumerate(columns):
            trial = matrix.trial(variant, case.label, name)
            if trial:
                _draw_field(axes, left + STEP * k, top + STEP * row, trial.grade)
    for k, name in enumerate(columns):
        passes = tally(matrix.of(variant, integrator=name))["pass"]
        axes.text(left + STEP * k + FIELD / 2, top + STEP * len(matrix.cases) + 10, passes, ha="center", va="center",
                  fontsize=10.5, color=LIGHT["muted"])


@styled
def draw_matrix(matrix, variants):
    """Draws the matrix of cases (rows) and integrators (columns), with the variants side by side."""
    columns = [name for name, _ in ranked(matrix)]
    names = max((len(case.label) for case in matrix.cases), default=0) * LETTER + 14
    top = 34 + max((len(name) for name in columns), default=0) * LETTER
    wide = STEP * len(columns)
    width = names + len(variants) * (wide + BETWEEN) - BETWEEN + 4
    bottom = top + STEP * len(matrix.cases)
    layout = PixelLayout(max(width, 480), bottom + 62,
                         f"Grades of {len(columns)} integrators on {len(matrix.cases)} cases")
    axes = _canvas(layout)
    for row, case in enumerate(matrix.cases):
        axes.text(names - 8, top + STEP * row + FIELD / 2, case.label + (" †" if case.model else ""), ha="right",
                  va="center")
    axes.text(names - 8, bottom + 10, "passes", ha="right", va="center", fontsize=10.5, color=LIGHT["muted"])
    for k, variant in enumerate(variants):
        _variant(matrix, axes, names + k * (wide + BETWEEN), top, variant, columns)
    _legend(axes, names, bottom + 34, any(case.model for case in matrix.cases))
    return layout


def _pictures(matrix):
    """(name, variants) of each picture: all variants side by side, and each variant alone."""
    yield "matrix", matrix.variants
    if len(matrix.variants) > 1:
        for variant in matrix.variants:
            yield "matrix_" + (file_name(variant).strip("._") or "variant"), [variant]


def write_figures(matrix, folder):
    """Writes matrix.svg and matrix.png, and both also as matrix_VARIANT. Yields their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, variants in _pictures(matrix):
        yield from write_paper_figure(draw_matrix(matrix, variants), folder / name)
