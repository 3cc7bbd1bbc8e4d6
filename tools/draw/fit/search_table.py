"""The search: a table of its attempts."""
from ..report import formatting
from ..report.markup import joined, tag
from ..report.tables import number, table
from ..study_json import with_unit
from . import numbers


def outcome(attempt):
    """'converged', or why not."""
    if attempt.failure:
        return attempt.failure or "failed"
    return "converged" if attempt.converged else attempt.message or "not converged"


def _end(fit, attempt, k):
    return numbers.rounded(attempt.end[k], fit.parameters[k].half_width, 4) if attempt.end else formatting.UNKNOWN


def _row(fit, index):
    attempt = fit.attempts[index]
    values = [number(f"{numbers.brief(attempt.start[k])} → {_end(fit, attempt, k)}") for k in range(len(fit.parameters))]
    name = f"{index + 1}" + (" (best)" if index == fit.best and len(fit.attempts) > 1 else "")
    iterations = formatting.count(attempt.iterations[-1].number) if attempt.iterations else formatting.UNKNOWN
    failed = attempt.failed_evaluations
    evaluations = formatting.count(attempt.evaluations) + (f", {failed:.0f} failed" if failed > 0 else "")
    return tag("tr", tag("th", name, scope="row"), number(numbers.brief(attempt.chi_square)), number(iterations),
               number(evaluations), tag("td", outcome(attempt), class_="message"), *values,
               class_="failed" if attempt.failure else None)


def attempts_table(fit):
    head = [("Attempt", False), ("Chi-square", True), ("Iterations", True), ("Evaluations", True), ("Outcome", False),
            *((with_unit(p.name, p.unit), True) for p in fit.parameters)]
    rows = [_row(fit, k) for k in range(len(fit.attempts))]
    return table("Attempts, with start → end of each parameter", head, rows, "Attempts")


def tip(fit, index, iteration):
    """The tooltip of an iteration."""
    rows = [["Chi-square", numbers.brief(iteration.chi_square)]]
    rows += [[p.name, numbers.with_unit(numbers.brief(v), p.unit)] for p, v in zip(fit.parameters, iteration.values)]
    rejected = "" if iteration.accepted else ", rejected"
    return {"m": index, "title": f"Attempt {index + 1}, iteration {iteration.number}{rejected}", "rows": rows, "e": {}}


def search_words(fit):
    failed = sum(bool(a.failure) for a in fit.attempts)
    hollow = " Hollow marks are steps that were rejected." if any(
        not i.accepted for a in fit.attempts for i in a.iterations) else ""
    words = ("Chi-square is the sum of the squared residuals over their deviations, with those of the priors. It should "
             f"fall to about the number of degrees of freedom, or below.{hollow}")
    return joined([words, f" {failed} of {formatting.plural(len(fit.attempts), 'attempt')} failed." if failed else None])
