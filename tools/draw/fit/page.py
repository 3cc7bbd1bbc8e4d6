"""The page of a fit: one HTML file that opens offline."""
import math
from pathlib import Path

from ..report import formatting
from ..report.details import command, drawing, pairs
from ..report.document import document, header, run_data, section
from ..report.markup import joined, tag
from . import data_tables, search_table
from .answer import answer, banner
from .figures import Figures
from .next_tables import candidates_section

CSS = Path(__file__).resolve().parent / "page.css"
CORRELATION = ("Near +1 or −1 the data determine only a combination of the two parameters: a change of one is made up for by "
               "the other. Near 0 they are determined independently.")
COMBINATIONS = ("Each row is a combination of the parameters, independent of the others; the number in a cell is the "
                "parameter's weight. A short bar is a combination that the data determine well. Left of the first dashed line "
                "(0.1) it is known to about 10 %; right of the second (1) it is undetermined. Positive numbers count by their "
                "logarithm, so that 0.01 is 1 %; angles in radians; Poisson's ratios by a logistic scale of their stable "
                "range.")
FIELD = ("White: as stiff as the material. Given the smoothness, {smoothness:g} for the logarithm of the ratio of neighbouring factors, "
         "the intervals tell where the data determine the factors. A scene uses them by stiffness_factors: {{grid: [{grid}], file: "
         "{name}.csv}}.")
LINEAR = ("linearised at the result: the covariance is the inverse of JᵀJ, with the derivatives J of the residuals over their "
          "deviations")


def _counted(fit):
    cpu = formatting.seconds(fit.cpu_seconds)
    return (formatting.plural(len(fit.data), "measured value"), formatting.plural(len(fit.parameters) + sum(f.factors.size for f in fit.fields), "parameter"),
            formatting.plural(fit.runs, "run"), f"{cpu} of CPU time" if math.isfinite(fit.cpu_seconds) else "")


def _figure(picture, words, label):
    if not picture:
        return None
    return tag("figure", tag("div", picture, class_="stage"), tag("figcaption", words), aria_label=label)


def _fields(fit, figures):
    return joined(_figure(figures.field(f), FIELD.format(smoothness=f.smoothness, grid=", ".join(map(str, f.grid)), name=f.name),
                          f.name) for f in fit.fields)


def _knowledge(fit, figures):
    if len(fit.parameters) < 2:
        return tag("p", "The fit has a single parameter, so there are no correlations.", class_="empty")
    return joined([_figure(figures.correlation(fit), CORRELATION, "Correlation"),
                   _figure(figures.directions(fit), COMBINATIONS, "Combinations")])


def _search(fit, figures):
    return joined([_figure(figures.search(fit), search_table.search_words(fit), "Search"), search_table.attempts_table(fit)])


def _material(name, yaml):
    use = f"materials: {{{name}: {{include: {name}.yaml}}}}"
    return joined([tag("h3", name), tag("p", "In a scene beside ", tag("code", f"{name}.yaml"), ", write ",
                                        tag("code", use), "."), tag("pre", tag("code", yaml.rstrip()))])


def _details(fit, folder):
    said = pairs([("File", tag("code", fit.file) if fit.file else ""),
                  ("Version", f"orthodyn {fit.version}" if fit.version else ""), ("Intervals", LINEAR),
                  ("Tables", "parameters.csv and data.csv, in the same folder")])
    again = f"{command('fit', fit.file, folder)}\n{drawing(folder)}"
    return joined([said, tag("h3", "To reproduce"), tag("pre", tag("code", again))])


def _parts(fit, folder, figures):
    result = joined([answer(fit), _fields(fit, figures)]) if fit.fields else answer(fit)
    parts = [("answer", "Result", result), ("data", "Data and fit", data_tables.data_section(fit, figures))]
    if fit.parameters:
        parts.append(("knowledge", "What the data determine", _knowledge(fit, figures)))
    if fit.candidates:
        parts.append(("next", "What to measure next", candidates_section(fit)))
    parts.append(("search", "Search", _search(fit, figures)))
    if fit.materials:
        parts.append(("materials", "Materials", joined(_material(*m) for m in fit.materials)))
    return parts + [("details", "Details", _details(fit, folder))]


def page(fit, folder):
    figures = Figures()
    parts = _parts(fit, folder, figures)
    top = header(fit.title, _counted(fit), [part[:2] for part in parts], fit.description, banner(fit))
    tips = [data_tables.tip(d) for d in fit.data]
    tips += [search_table.tip(fit, k, i) for k, attempt in enumerate(fit.attempts) for i in attempt.iterations]
    css = figures.styles.css() + CSS.read_text(encoding="utf-8")
    return document(fit.title, css, top, [section(*part) for part in parts], run_data(tips))
