"""The part of the page with the end states of each case."""
from ..report import formatting
from ..report.markup import joined, tag, void
from .clusters import about_middle, turned_back
from .end_states import EndStates
from .grades import GRADES, named
from .thumbnail import picture

MOST = 5  # largest number of pictures for a case and variant

READ = ("Trials whose nodes all end within 2 % of the body's extent of each other share a picture, the most common "
        "state first. Grey lines are the shape at rest. Red has grown, blue has shrunk (white: the volume at rest, the "
        "darkest blue: none left). All pictures of a case have one camera and one scale.")

PLACED = {
    about_middle: "The bodies ended far from each other; each is drawn about its own middle.",
    turned_back: "The bodies ended turned in many ways; each is turned back onto the shape at rest, so that only "
                 "shapes tell them apart.",
}


def _names(trials, grade):
    return ", ".join(t.integrator for t in trials if t.grade == grade)


def _by_grade(trials):
    """A line for each grade: the symbol, the word, and the integrators with this grade."""
    return joined(tag("p", named(grade), ": ", _names(trials, grade), class_="who") for grade in GRADES
                  if any(t.grade == grade for t in trials))


def _alt(case, variant, cluster):
    return f"{case.label}, {variant}: how " + formatting.joined(t.integrator for t in cluster.trials) + " ended"


def _damage(states, cluster):
    """Words about damage that the picture hardly shows."""
    if states.is_a_point(cluster):
        return ", shrunk to a point"
    number = cluster.leader.inverted
    return f", {formatting.plural(number, 'element')} flat or inverted" if number else ""


def _card(states, shown, case, variant, cluster):
    uri, width, height = picture(states.scene(shown), cluster.index)
    count = formatting.plural(len(cluster.trials), "integrator")
    image = void("img", src=uri, width=width, height=height, loading="lazy", alt=_alt(case, variant, cluster))
    title = tag("p", tag("strong", count), _damage(states, cluster), class_="who")
    return tag("figure", image, tag("figcaption", title, _by_grade(cluster.trials)))


def _times(ratios):
    low, high = min(ratios), max(ratios)
    span = formatting.exponent(low)
    if high >= 1.05 * low:
        span += f" to {formatting.exponent(high)}"
    return f"{span} times as large as those that did well"


def _in_words(states, variant, more):
    """Words about the trials that have no picture."""
    exploded, absent = states.exploded[variant], states.absent[variant]
    if more:
        yield tag("p", tag("strong", f"{len(more)} more end state{'s' if len(more) > 1 else ''}: "),
                  "; ".join(formatting.joined(t.integrator for t in c.trials) for c in more) + ".", class_="rest")
    if exploded:
        yield tag("p", tag("strong", "Exploded"), f", {_times([r for _, r in exploded])}: ",
                  ", ".join(f"{t.integrator} ({t.grade})" for t, _ in exploded) + ".", class_="rest")
    if absent:
        yield tag("p", tag("strong", "No end state: "), ", ".join(f"{t.integrator} ({t.grade})" for t in absent) + ".",
                  class_="rest")


def _variant(matrix, states, shown, case, variant):
    clusters = states.clusters[variant]
    cards = [_card(states, shown, case, variant, c) for c in clusters[:MOST]]
    title = tag("h4", variant) if len(matrix.variants) > 1 else None
    return tag("div", title, tag("div", *cards, class_="cards") if cards else None,
               *_in_words(states, variant, clusters[MOST:]), class_="states")


def _case(matrix, folder, case):
    states = EndStates(matrix, folder, case)
    shown = [c.index for clusters in states.clusters.values() for c in clusters[:MOST]]
    tried = [v for v in matrix.variants if matrix.of(v, case.label)]
    return tag("div", tag("h3", case.label), tag("p", case.sentence) if case.sentence else None,
               tag("p", tag("strong", "Model: "), case.model, class_="scene") if case.model else None,
               tag("p", PLACED[states.place], class_="scene") if states.place in PLACED else None,
               tag("div", *(_variant(matrix, states, shown, case, v) for v in tried), class_="pair"),
               None if tried else tag("p", "Not tried yet.", class_="empty"), id=matrix.case_id(case.label),
               class_="case")


def gallery(matrix, folder):
    return joined([tag("p", READ, class_="scene"), *(_case(matrix, folder, case) for case in matrix.cases)])
