"""The HTML document of a study's report: head, header with links, sections, data and script."""
from pathlib import Path

from .markup import Html, data_script, tag, void
from .theme import DARK, LIGHT

HERE = Path(__file__).resolve().parent
SCRIPT = HERE / "page.js"


def _style(css):
    def variables(colours):
        return "".join(f"--{name}:{value};" for name, value in colours.items())
    light, dark = variables(LIGHT) + "color-scheme:light;", variables(DARK) + "color-scheme:dark;"
    themes = (f":root{{{light}}}@media (prefers-color-scheme:dark){{:root:not([data-theme=light]){{{dark}}}}}"
              f":root[data-theme=dark]{{{dark}}}@media print{{:root:root:root{{{light}}}}}")
    return tag("style", Html(themes + (HERE / "page.css").read_text(encoding="utf-8") + css))


def when(time):
    """The time '2026-01-31T12:00:00Z' in readable form."""
    return time.replace("T", " ").replace("Z", " UTC")


def not_finished(text):
    """A banner for a study with missing points."""
    return tag("p", tag("strong", "Not finished: "), text, class_="banner", role="status")


def header(title, counted, links, description="", banner=None, view=None):
    """The head of the page: title, description, the line of facts `counted`, `banner`, and links: to the sections,
    `links` [(id, name)], and to the 3D view."""
    return tag("header", tag("button", "Dark", type="button", id="theme", class_="js"), tag("h1", title),
               tag("p", description, class_="lede") if description else None,
               tag("p", " · ".join(part for part in counted if part), class_="facts"), banner,
               tag("nav", *(tag("a", name, href=f"#{identity}") for identity, name in links),
                   tag("a", "In 3D", href=view) if view else None, aria_label="Sections"))


def section(identity, title, *content):
    return tag("section", tag("h2", title), *content, id=identity)


def run_data(tooltips, measure="", clock=None, labels=None):
    """Data for the page's script: tooltips of the marks, and the measure and clock shown first."""
    clocks = {"clock": clock} if clock else {}
    return data_script("run-data", {"measure": measure, **clocks, "labels": labels or {}, "runs": tooltips})


def document(title, css, top, sections, data, symbols=None):
    """The whole page as text. `css`: rules for the figures; `symbols`: SVG definitions."""
    head = tag("head", void("meta", charset="utf-8"),
               void("meta", name="viewport", content="width=device-width, initial-scale=1"), tag("title", title),
               _style(css), void("link", rel="icon", href="data:,"))
    body = tag("body", symbols, top, tag("main", *sections), data, tag("script", Html(SCRIPT.read_text(encoding="utf-8"))))
    return "<!DOCTYPE html>\n" + tag("html", head, body, lang="en") + "\n"
