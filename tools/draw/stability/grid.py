"""The matrix as a table of fields for each variant, with cases as rows and integrators as columns."""
from ..report import formatting
from ..report.markup import Html, joined, scrolling, tag
from ..report.tables import caption
from .formatting import spoken
from .grades import GRADES, MEANING, UNTRIED, named, symbol
from .ranking import ranked, tally

DAGGER = "†"


def breakable(label):
    """The label, in which lines may break after underscores."""
    return joined(label.split("_"), Html("_<wbr>"))


def row_id(trial):
    """HTML id of the trial's row in the table of trials that did not pass."""
    return f"trial-{trial.index}"


def _field(matrix, trial):
    if trial is None:
        return tag("td", tag("span", "·", role="img", aria_label=UNTRIED, class_="untried"))
    target = matrix.case_id(trial.case) if trial.grade == "pass" else row_id(trial)
    return tag("td", tag("a", symbol(trial.grade), href=f"#{target}", class_=f"mark g-{trial.grade}",
                         data_p=trial.index, aria_label=spoken(trial)))


def _row(matrix, variant, columns, number, case):
    trials = matrix.of(variant, case.label)
    count = tally(trials)
    name = tag("a", breakable(case.label), href=f"#{matrix.case_id(case.label)}", data_p=len(matrix.trials) + number)
    mark = tag("sup", DAGGER, title=case.model) if case.model else None
    return tag("tr", tag("th", name, mark, scope="row"),
               *(_field(matrix, matrix.trial(variant, case.label, name)) for name in columns),
               tag("td", f"{count['pass']}/{count.tried}" if count.tried else formatting.UNKNOWN, class_="num"))


def _foot(matrix, variant, columns, grade, title):
    counts = [tally(matrix.of(variant, integrator=name))[grade] for name in columns]
    return tag("tr", tag("th", title, scope="row"), *(tag("td", n) for n in counts),
               tag("td", sum(counts), class_="num"))


def _table(matrix, variant, columns):
    head = [tag("th", tag("span", "case", class_="unseen"), scope="col"),
            *(tag("th", tag("span", name), scope="col", class_="turned") for name in columns),
            tag("th", "passes", scope="col", class_="num")]
    rows = [_row(matrix, variant, columns, k, case) for k, case in enumerate(matrix.cases)]
    feet = [_foot(matrix, variant, columns, "pass", "passes"), _foot(matrix, variant, columns, "fail", "fails")]
    table = tag("table", caption(tag("strong", variant)), tag("thead", tag("tr", *head)), tag("tbody", *rows),
                tag("tfoot", *feet), class_="matrix")
    return scrolling(table, label=f"Grades of all integrators, {variant}")


def _legend():
    return tag("ul", *(tag("li", named(grade), tag("span", f": {MEANING[grade]}")) for grade in GRADES),
               class_="legend")


def _models(matrix):
    found = [f"{case.label} ({case.model})" for case in matrix.cases if case.model]
    return tag("p", f"{DAGGER} The model itself is at fault there, and no integrator can help: {'; '.join(found)}.",
               class_="scene") if found else None


def grid(matrix):
    """The tables of all variants. Their columns have the same order, which is the ranking over all trials."""
    columns = [name for name, _ in ranked(matrix)]
    return joined([_legend(), tag("div", *(_table(matrix, v, columns) for v in matrix.variants), class_="pair"),
                   _models(matrix), tag("p", "Integrators stand in the order of their passes in all variants.",
                                        class_="scene")])
