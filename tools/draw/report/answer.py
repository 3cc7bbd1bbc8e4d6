"""The answer in words, and the times to reach several errors as a table with bars."""
import math

from . import measures, formatting
from .comparable import main_target, representatives
from .pareto_front_answer import pareto_front_answer
from .markup import Html, joined, tag
from .method_name import method_name
from .tables import headed_table

EQUAL = 1.1  # smaller ratios of times are called equal


def _with_percent(target, measure):
    text = formatting.exponent(target)
    percent = formatting.percent(target) if measure != "phase" else ""
    return f"{text} ({percent})" if percent else f"{text} rad" if measure == "phase" else text


def _answers(comparison, problem):
    """The problem's answers for the main error measure, loose targets first."""
    primary = measures.primary(comparison)
    return sorted((a for a in comparison.answers if a.problem == problem.id and a.error == primary and a.target > 0),
                  key=lambda a: -a.target)


def _main(comparison, problem):
    target = main_target(comparison)
    return next((a for a in _answers(comparison, problem) if a.target == target), None)


def _ranked(answer):
    """(method, seconds) of the methods that reached the target, fastest first."""
    return sorted(((m, s) for m, s in answer.seconds.items() if math.isfinite(s)), key=lambda pair: pair[1])


def _missed(answer):
    """The methods that missed the target, nearest first; those without a finished run come last."""
    def best(method):
        error = answer.best_error.get(method, math.nan)
        return error if formatting.known(error) else math.inf
    return sorted((m for m, s in answer.seconds.items() if not math.isfinite(s)), key=best)


MEANING = ("An error is the distance from a far more accurate solution, as a share of the largest motion. "
           "rtol is the tolerance that a method with error control was asked to keep in each step. A loose "
           "tolerance may take as long as a tighter one: then the method's cheapest run counts for both.")


def _label(comparison, method):
    return comparison.methods[comparison.method_index(method)].label


def headline(comparison):
    """One sentence: who is fastest, on how many problems."""
    wins, open_problems = {}, []
    for problem in comparison.problems:
        answer = _main(comparison, problem)
        ranked = _ranked(answer) if answer else []
        if not ranked:
            open_problems.append(problem)
        for method, seconds in ranked:
            if seconds <= EQUAL * ranked[0][1]:
                wins.setdefault(method, []).append((problem, seconds))
    if not wins:
        return tag("p", _nothing_reached(comparison), class_="headline")
    target = _with_percent(main_target(comparison), measures.primary(comparison))
    if len(comparison.problems) == 1:
        return tag("p", f"For an error of {target}, ", *_fastest(comparison, comparison.problems[0]), class_="headline")
    nobody = formatting.joined(problem.label for problem in open_problems)
    return tag("p", f"For an error of {target}, fastest (or within 10 % of it) is ", joined(_wins(comparison, wins), "; "),
               f"; no method reached it on {nobody}." if nobody else ".", class_="headline")


def _fastest(comparison, problem):
    """'a is fastest: 0.2 s; next is b with 0.3 s.' Methods within 10 % of each other are named together."""
    ranked = _ranked(_main(comparison, problem))
    equal = [pair for pair in ranked if pair[1] <= EQUAL * ranked[0][1]]
    names = formatting.joined(_label(comparison, method) for method, _ in equal)
    first = formatting.seconds(ranked[0][1])
    if len(equal) > 1:
        yield tag("strong", f"{names} are fastest")
        yield f", {first} to {formatting.seconds(equal[-1][1])}"
    else:
        yield tag("strong", f"{names} is fastest")
        yield f": {first}"
    later = ranked[len(equal):]
    yield f"; next is {_label(comparison, later[0][0])} with {formatting.seconds(later[0][1])}." if later else "."


def _wins(comparison, wins):
    for method, won in sorted(wins.items(), key=lambda item: -len(item[1])):
        named = formatting.joined(problem.label for problem, _ in won)
        where = f" on {len(won)} of {len(comparison.problems)} problems ({named})" if len(won) > 1 else f" on {named}"
        if len(won) == len(comparison.problems):
            where = " on both problems" if len(won) == 2 else f" on all {len(won)} problems"
        yield joined([tag("strong", _label(comparison, method)), where])


def _nothing_reached(comparison):
    if not any(p.completed for p in comparison.points):
        return "No run has finished, so there is no error to compare; the failures and their reasons are listed below."
    if not comparison.answers:
        return "The comparison holds no times to given errors; the diagrams below show error against time directly."
    return "No method has reached any of the errors asked for; the table says how far each one came."


def _tightest(comparison, problem):
    """The answer for the smallest error that several methods reach, if below the main target."""
    main = _main(comparison, problem)
    found = [a for a in _answers(comparison, problem) if len(_ranked(a)) > 1 and main and a.target < main.target]
    return found[-1] if found else None


def _quantities(comparison, problem):
    """Sentence with the errors of the requested quantities, in the fastest run that reaches the main target."""
    measure = measures.primary(comparison)
    point = next((p for p, reached in representatives(comparison, problem) if reached), None)
    kind = measure.rsplit(".", 1)[-1]
    errors = [(name, point.error(f"quantities.{name}.{kind}")) for name in problem.quantity_scales] if point else []
    parts = [f"{name} {formatting.exponent(error)}" for name, error in errors if formatting.known(error)]
    if not parts:
        return None
    return tag("p", f"In the fastest run with that error, {_label(comparison, point.method)} with "
               f"{formatting.control(point.control)}, the named quantities are off by, relative to their largest size: "
               f"{', '.join(parts)} ({measures.KINDS.get(kind, kind)}).")


def sentence(comparison, problem, answer):
    """'To reach an error of 1e-3 on damped_beam: a 0.2 s, b 0.3 s; c did not reach it, best 3e-3.'"""
    if not answer:
        return None
    ranked = _ranked(answer)
    first = ranked[0][1] if ranked else math.nan
    reached = [f"{_label(comparison, m)} {formatting.seconds(s)}"
               + (f" ({_ratio(s / first)})" if k and first > 0 else "")
               for k, (m, s) in enumerate(ranked)]
    missed = [f"{_label(comparison, m)} did not reach it ({_best(answer, m)})" for m in _missed(answer)]
    target = _with_percent(answer.target, answer.error)
    parts = [part for part in (", ".join(reached), ", ".join(missed)) if part]
    return tag("p", f"To reach an error of {target} on ", tag("em", problem.label), f": {'; '.join(parts)}.")


def _best(answer, method):
    best = answer.best_error.get(method, math.nan)
    return f"best {formatting.exponent(best)}" if formatting.known(best) else "no finished run"


def _ratio(x):
    return f"{x:.1f}×" if x < 10 else f"{x:.0f}×"


def _target_words(answer):
    percent = formatting.percent(answer.target) if answer.error != "phase" else ""
    return formatting.exponent(answer.target), tag("small", f" ({percent})") if percent else None


def _cell(answer, method):
    if method not in answer.seconds:
        return tag("td", formatting.UNKNOWN, class_="none")
    seconds = answer.seconds[method]
    if not math.isfinite(seconds):
        return tag("td", "not reached", tag("small", _best(answer, method)), class_="none")
    ranked = _ranked(answer)
    fastest, slowest = ranked[0][1], ranked[-1][1]
    ratio = _ratio(seconds / fastest) if fastest > 0 and seconds > fastest else "fastest"
    share = max(1.0, 100 * seconds / slowest) if slowest > 0 else 1.0
    return tag("td", tag("b" if seconds == fastest else "span", formatting.seconds(seconds)),
               tag("small", ratio), Html(f'<i class="bar" style="width:{share:.1f}%"></i>'), )


def table(comparison, problem):
    """Table of methods (rows, ordered by their times for the main target) and targets (columns)."""
    answers = _answers(comparison, problem)
    if not answers:
        return None
    main = _main(comparison, problem) or answers[0]
    order = [m for m, _ in _ranked(main)] + _missed(main)
    order += [m.id for m in comparison.methods if m.id not in order and comparison.points_of(problem, m.id)]
    head = [tag("th", "Method", scope="col")] + [
        tag("th", *_target_words(a), scope="col", class_="main" if a is main else None) for a in answers]
    rows = [tag("tr", tag("th", method_name(comparison, m), scope="row"), *(_cell(a, m) for a in answers))
            for m in order]
    title = ("Wall time to reach an error of …, and its ratio to the fastest; interpolated between runs. "
             f"Error: {measures.label(main.error)}.")
    return headed_table(title, head, rows, f"Times to reach an error on {problem.label}", "targets")


def overview(comparison):
    """Table of methods and problems at the main target. Methods are ordered by their mean ratio to the fastest time."""
    found = [(p, _main(comparison, p)) for p in comparison.problems]
    found = [(problem, answer) for problem, answer in found if answer]
    if len(found) < 2:
        return None
    target = _with_percent(found[0][1].target, found[0][1].error)
    head = [tag("th", "Method", scope="col"), *(tag("th", problem.label, scope="col") for problem, _ in found)]
    rows = [tag("tr", tag("th", method_name(comparison, m.id), scope="row"), *(_cell(a, m.id) for _, a in found))
            for m in sorted(comparison.methods, key=lambda m: _rank([a for _, a in found], m.id))]
    title = (f"Wall time to reach an error of {target}, and its ratio to the fastest, on every problem. "
             f"Error: {measures.label(found[0][1].error)}.")
    return headed_table(title, head, rows, "Times on every problem", "targets")


def _rank(answers, method):
    """Key for sorting: (no run finished, sum of the log ratios to the fastest times). A missed target counts as a ratio
    of 1000."""
    total = 0.0
    for answer in answers:
        seconds, ranked = answer.seconds.get(method, math.nan), _ranked(answer)
        reached = ranked and seconds > 0 and ranked[0][1] > 0
        total += math.log(seconds / ranked[0][1]) if reached else math.log(1000)
    return not any(formatting.known(a.best_error.get(method, math.nan)) for a in answers), total


def _why_no_answer(comparison, problem):
    finished = len(comparison.finished(problem))
    if not finished:
        return "No run has finished."
    if problem.reference.kind == "none":
        return f"{formatting.plural(finished, 'run')} finished, but there is no reference to measure an error against."
    return f"{formatting.plural(finished, 'run')} finished; times to given errors were not asked for."


ALIKE, LEAST_METHODS = 1.05, 3


def _suspected(comparison, problem):
    """Warns that the reference is in doubt if all methods reach the same error, far above the smallest resolved error:
    they then agree with each other but not with the reference."""
    measure = measures.primary(comparison)
    errors = [[p.error(measure) for p in comparison.finished(problem, m.id) if p.error(measure) > 0]
              for m in comparison.methods]
    best = [min(found) for found in errors if found]
    reach = problem.reference.reach(measure)
    if len(best) < LEAST_METHODS or max(best) > ALIKE * min(best) or min(best) < reach:
        return None
    return tag("p", tag("strong", "Reference in doubt. "), f"The most accurate runs of all {len(best)} methods have the "
               f"same error, {formatting.exponent(min(best))}: they agree with each other rather than with the "
               "reference. Suspect the reference before the methods.", class_="banner")


def _scene(problem):
    """The description of the scene, and the changes to the scene."""
    changes = ", ".join(f"{k} left out" if v in ("~", "null") else f"{k}: {v}" for k, v in problem.set.items())
    text = " ".join(part for part in (problem.sentence, f"Changed here: {changes}." if changes else "") if part)
    return tag("p", text, class_="scene") if text else None


def answer_section(comparison):
    if comparison.pareto_fronts:
        return pareto_front_answer(comparison)
    parts = [headline(comparison), tag("p", MEANING, class_="scene"), overview(comparison)]
    for problem in comparison.problems:
        size = f"{formatting.count(problem.unknowns)} unknowns" if formatting.known(problem.unknowns) else ""
        content = [sentence(comparison, problem, _main(comparison, problem)), _quantities(comparison, problem),
                   sentence(comparison, problem, _tightest(comparison, problem)), table(comparison, problem)]
        if not any(content):
            content = [tag("p", _why_no_answer(comparison, problem), class_="empty")]
        parts.append(tag("div", tag("h3", problem.label, " ", tag("small", size)),
                         _scene(problem), _suspected(comparison, problem), *content,
                         class_="problem"))
    return joined(parts)
