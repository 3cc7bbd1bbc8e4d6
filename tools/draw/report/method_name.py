"""A method's marker and name in HTML; they look as in the figures."""
from . import theme
from .markup import Html, joined, tag


def glyphs(comparison):
    """The SVG definitions of all markers, needed once per page."""
    symbols = [f'<symbol id="g{k}" viewBox="-8 -8 16 16"><path d="{theme.glyph(k, 9.5)}" '
               f'style="fill:{theme.variable(k)}"/></symbol>' for k in range(len(comparison.methods))]
    return Html(f'<svg class="glyphs" width="0" height="0" aria-hidden="true">{"".join(symbols)}</svg>')


def method_name(comparison, method_id):
    k = comparison.method_index(method_id)
    mark = Html(f'<svg class="glyph" aria-hidden="true"><use href="#g{k}"/></svg>')
    return joined([mark, tag("span", comparison.methods[k].label, class_="method")])
