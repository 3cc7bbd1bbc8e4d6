"""Figures as compact inline SVG, coloured by CSS variables, with data attributes for the script."""
import io
import re
import xml.etree.ElementTree as ElementTree

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG

from .theme import LIGHT

SVG = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}href"
DROPPED = ("metadata", "style", "title")
NUMBER = re.compile(r"-?\d+\.\d+")
VARIABLES = {hexadecimal: f"var(--{name})" for name, hexadecimal in LIGHT.items()}
ElementTree.register_namespace("", SVG[1:-1])


def _raw_svg(figure, salt):
    """matplotlib's SVG; `salt` makes its ids distinct."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        FigureCanvasSVG(figure).print_svg(stream, metadata={"Date": None})
    return stream.getvalue()


def _rounded(text, digits):
    return NUMBER.sub(lambda m: f"{float(m.group()):.{digits}f}".rstrip("0").rstrip("."), text)


def _themed(style):
    """Replaces colours by CSS variables and removes the font."""
    style = re.sub(r"#[0-9a-f]{6}", lambda m: VARIABLES.get(m.group(), m.group()), style)
    style = re.sub(r"font: (?:(bold|\d+) )?([\d.]+)px [^;]*", _font, style)
    return re.sub(r";\s*$", "", re.sub(r"([:;]) ", r"\1", style))


def _font(match):
    weight, size = match.groups()
    return f"font-size:{size}px" + (f";font-weight:{weight}" if weight else "")


def _marked(element, identity):
    """Sets data attributes of `element` from its gid, `pt-INDEX-METHOD` or `me-METHOD`."""
    kind, *numbers = identity.split("-")
    if kind == "pt":
        element.set("data-p", numbers[0])
    element.set("data-m", numbers[-1])


def _short_names(root, salt):
    """New names for the ids that are referred to, as {old: new}."""
    used = set()
    for element in root.iter():
        for value in element.attrib.values():
            used.update(re.findall(r"(?:url\(#|^#)([^)]+)", value))
    return {old: f"{salt}-{k}" for k, old in enumerate(sorted(used))}


def _cleaned(element, names, in_definition=False):
    for child in list(element):
        if child.tag.replace(SVG, "") in DROPPED:
            element.remove(child)
    for key, value in list(element.attrib.items()):
        if key == "id":
            del element.attrib["id"]
            if re.match(r"(pt|me)-\d", value):
                _marked(element, value)
            elif value in names:
                element.set("id", names[value])
        elif key == LINK:
            del element.attrib[LINK]
            element.set("href", "#" + names[value[1:]])
        elif key == "style":
            element.set(key, _themed(value))
        else:
            value = re.sub(r"url\(#([^)]+)\)", lambda m: f"url(#{names[m.group(1)]})", value)
            rounded = key in ("d", "x", "y", "transform", "width", "height")
            element.set(key, _rounded(value, 2 if in_definition or key == "transform" else 1) if rounded else value)
    if re.match(r"rotate\(-?0[ ,)]", element.get("transform", "")):
        del element.attrib["transform"]
    for child in element:
        _cleaned(child, names, in_definition or element.tag == SVG + "defs")
    element[:] = [kept for child in element for kept in _unwrapped(child)]


def _unwrapped(element):
    """Replaces groups without attributes by their content."""
    if element.tag == SVG + "g" and len(element) == 1 and element[0].tag == SVG + "use":
        element[0].attrib.update(element.attrib)
        return [element[0]]
    empty = element.tag == SVG + "defs" and not len(element)
    return list(element) if empty or element.tag == SVG + "g" and not element.attrib else [element]


class Styles:
    """CSS classes that replace the inline styles of all figures of a page."""

    def __init__(self):
        self._names = {}

    def named(self, style):
        return self._names.setdefault(style, f"s{len(self._names)}")

    def css(self):
        return "".join(f".{name}{{{style}}}" for style, name in self._names.items())


def page_svg(layout, salt, styles):
    """The layout as an SVG element for the page. `salt` must be unique in the page and start with a letter."""
    text = _raw_svg(layout.figure, salt)
    root = ElementTree.fromstring(text[text.index("<svg"):])
    _cleaned(root, _short_names(root, salt))
    for key in ("width", "height", "version"):
        root.attrib.pop(key, None)
    root.set("viewBox", f"0 0 {layout.width:g} {layout.height:g}")
    root.set("role", "img")
    root.set("aria-label", layout.description)
    root.set("tabindex", "0")
    text = ElementTree.tostring(root, encoding="unicode").replace(' xmlns="http://www.w3.org/2000/svg"', "", 1)
    text = re.sub(r'style="([^"]*)"', lambda m: f'class="{styles.named(m.group(1))}"', text)
    text = re.sub(r'(\sd=")([^"]*)', lambda m: m.group(1) + _joined_path(m.group(2)), text)
    return re.sub(r">\s+<", "><", text).replace(" />", "/>")


def _joined_path(path):
    """'M 1 2  L 3 4' as 'M1 2L3 4'."""
    return re.sub(r"\s*([A-Za-z])\s*", r"\1", path.strip())
