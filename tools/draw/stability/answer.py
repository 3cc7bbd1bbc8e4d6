"""The answer of a stability study: ranking of integrators, hardest cases, and trials that pass in one variant only."""
from ..report import formatting
from ..report.markup import Html, joined, scrolling, tag
from ..report.tables import headed_table, number
from .grades import GRADES, MEANING, named
from .grid import DAGGER
from .ranking import hard_cases, lost, ranked

EQUAL = 3  # largest number of integrators that are named as the best
SHORT = 6  # largest number of rows of a table that is shown unfolded


def _best(order):
    """The best integrators: those with as many passes and fails as the first."""
    first = order[0][1]
    return [name for name, t in order if (t["pass"], t["fail"]) == (first["pass"], first["fail"])]


def _headline(matrix, variant):
    order = [(name, t) for name, t in ranked(matrix, variant) if t.tried]
    if not order or not order[0][1]["pass"]:
        return "no integrator has passed a case yet."
    best, first = _best(order), order[0][1]
    more = [f"{len(best) - EQUAL} more"] if len(best) > EQUAL else []
    named_ = formatting.joined(best[:EQUAL] + more)
    verb = "passes" if len(best) == 1 else "pass"
    rest = f", failing {formatting.count(first['fail'])}" if first["fail"] else ", failing none"
    each = " each" if len(best) > 1 else ""
    return joined([tag("strong", named_), f" {verb} most: {first['pass']} of {formatting.plural(len(matrix.cases), 'case')}"
                   f"{each}{rest}."])


def headline(matrix):
    lines = [joined([f"With {variant}, " if len(matrix.variants) > 1 else "", _headline(matrix, variant)])
             for variant in matrix.variants]
    return tag("p", joined(lines, " "), class_="headline")


def _share(t):
    """A bar of full width that shows the share of each grade."""
    parts = "".join(f'<i class="g-{grade}" style="flex:{t[grade]}"></i>' for grade in GRADES if t[grade])
    return tag("td", tag("span", Html(parts), class_="share", aria_hidden="true"), class_="word")


def _ranking(matrix, variant):
    heads = [tag("th", "Integrator", scope="col"),
             tag("th", tag("span", "shares", class_="unseen"), scope="col", class_="word"),
             *(tag("th", named(grade, label), scope="col", class_="num", title=MEANING[grade]) for grade, label in
               (("fail", "fails"), ("degraded", "degraded"), ("pass", "passes"), ("refused", "refused"))),
             tag("th", "CPU [s]", scope="col", class_="num")]
    rows = [tag("tr", tag("th", name, scope="row"), _share(t),
                *(number(t[grade]) for grade in ("fail", "degraded", "pass", "refused")),
                number(formatting.plain_seconds(t.cpu))) for name, t in ranked(matrix, variant)]
    title = joined([tag("strong", variant), ": integrators by passes, then by fails"])
    return headed_table(title, heads, rows, f"Integrators in order, {variant}", "ranking")


def _hard(matrix, variant):
    found = hard_cases(matrix, variant)
    if not found:
        return None
    alike = {}  # cases by the number of passes
    for case, t in found:
        alike.setdefault(f"{t['pass'] or 'none'} of {t.tried}", []).append(case)
    items = [tag("li", count, ": ", joined((_linked(matrix, case) for case in cases), ", "))
             for count, cases in alike.items()]
    return joined([tag("p", f"Hardly any integrator passes with {variant}:"), tag("ul", *items)])


def _linked(matrix, case):
    """The case's name, with a link to its end states, and with a dagger if the model is at fault."""
    mark = tag("sup", DAGGER, title=case.model) if case.model else None
    return joined([tag("a", case.label, href=f"#{matrix.case_id(case.label)}"), mark])


def _lost_row(matrix, label, trials):
    cells = [joined([named(grade), ": ", ", ".join(t.integrator for t in trials if t.grade == grade)])
             for grade in GRADES if any(t.grade == grade for t in trials)]
    return tag("tr", tag("th", tag("a", label, href=f"#{matrix.case_id(label)}"), scope="row"),
               number(len(trials)), tag("td", joined(cells, Html("<br>")), class_="message"))


def _losses(matrix, variant):
    """A sentence and a table of the trials that pass with the first variant but not with this one."""
    first = matrix.variants[0]
    gone, won = lost(matrix, variant, first), lost(matrix, first, variant)
    both = sum(1 for t in matrix.of(first) if t.grade == "pass" and matrix.trial(variant, t.case, t.integrator))
    counts = [f"{n} {word}" for grade, word in (("fail", "fail"), ("degraded", "are degraded"),
                                                ("refused", "are refused"))
              if (n := sum(t.grade == grade for t in gone))]
    sentence = (f"Of {formatting.plural(both, 'trial')} that pass with {first}, {len(gone) or 'none'} "
                f"{'does' if len(gone) == 1 else 'do'} not with {variant}")
    sentence += f": {formatting.joined(counts)}. " if counts else ". "
    sentence += f"{len(won) or 'None'} of those that do not pass with {first} {'does' if len(won) == 1 else 'do'} so " \
                f"with {variant}."
    rows = [_lost_row(matrix, case.label, mine) for case in matrix.cases
            if (mine := [t for t in gone if t.case == case.label])]
    heads = (tag("th", "Case", scope="col"), tag("th", "Lost", scope="col", class_="num"),
             tag("th", f"Passes with {first}, and now", scope="col", class_="word"))
    table = scrolling(tag("table", tag("thead", tag("tr", *heads)), tag("tbody", *rows), class_="lost"),
                      label=f"What {variant} loses") if rows else None
    folded = table and tag("details", tag("summary", "Which integrators, case by case"), table,
                           open=len(rows) <= SHORT)
    return joined([tag("h3", f"What {variant} loses"), tag("p", sentence), folded])


def answer(matrix):
    tried = [v for v in matrix.variants if matrix.of(v)]
    if not tried:
        return tag("p", "No trial has ended yet.", class_="headline")
    hard = [part for part in (_hard(matrix, v) for v in tried) if part]
    suspected = [tag("p", tag("strong", "Expectation in doubt. "), f"{s}.", class_="banner") for s in matrix.suspected]
    return joined([headline(matrix), *suspected, tag("div", *(_ranking(matrix, v) for v in tried), class_="pair"),
                   tag("h3", "The hardest cases") if hard else None,
                   tag("div", *(tag("div", part) for part in hard), class_="columns"),
                   *(_losses(matrix, v) for v in tried[1:])])
