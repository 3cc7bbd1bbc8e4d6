"""Details: references, definitions, methods, machine, and the command that reproduces the study."""
import shlex

from . import measures, formatting
from .markup import joined, tag
from .method_name import method_name
from .tables import headed_table


def _reference_words(problem):
    reference = problem.reference
    if reference.kind == "exact":
        return f"Exact solution{': ' + reference.method if reference.method else ''}."
    if reference.kind == "none" or not reference.kind:
        return "None, so errors are not known." + (f" {reference.message}" if reference.message else "")
    parts = [f"Computed by {reference.method or 'an unnamed method'}"]
    if formatting.known(reference.seconds):
        parts.append(f" in {formatting.seconds(reference.seconds)}")
    if reference.check and not reference.errors:
        parts.append(f". The check by {reference.check} failed, so its own error is unknown and no conclusions "
                     "are drawn")
    elif reference.check:
        parts.append(f". Its own error is its difference to a second solution by {reference.check}")
    if reference.has_own_mesh:
        parts.append(f". It has its own mesh with {formatting.count(reference.unknowns)} unknowns, whose error is about "
                     f"{formatting.exponent(reference.mesh_error)} of the elastic energy, estimated from recovered "
                     "stresses")
    if formatting.known(reference.shared_mesh_error):
        parts.append(f". It has the mesh of the scene, like all points: errors are time integration errors only; the mesh "
                     f"error is about {formatting.exponent(reference.shared_mesh_error)} of the elastic energy")
    return "".join(parts) + "." + (f" {reference.message}" if reference.message else "")


def _own_errors(problem):
    """Table of the reference's own errors: a row for each measure, a column for each norm (over time, final,
    largest)."""
    own = problem.reference.errors
    whats = list(dict.fromkeys(key.rsplit(".", 1)[0] for key in own if "." in key))
    rows = [_own_row(measures.name(what), [own.get(f"{what}.{kind}") for kind in measures.KINDS])
            for what in whats]
    if "phase" in own:
        rows.append(_own_row("phase [rad]", [own["phase"]] + [None] * (len(measures.KINDS) - 1)))
    if not rows:
        return None
    head = [tag("th", "Quantity", scope="col"),
            *(tag("th", name, scope="col", class_="num") for name in measures.KINDS.values())]
    return headed_table("The reference's own errors", head, rows, f"Own errors of the reference of {problem.label}", "small")


def _own_row(name, values):
    cells = (tag("td", "" if v is None else formatting.fixed_exponent(v), class_="num") for v in values)
    return tag("tr", tag("th", name, scope="row"), *cells)


def pairs(items):
    """A description list of the items, leaving out unknown ones."""
    return tag("dl", *(joined([tag("dt", key), tag("dd", value)]) for key, value in items if value))


def _settings(changes):
    return joined((tag("code", f"{k}={v}") for k, v in changes.items()), " ")


def _size(problem):
    sizes = ((problem.unknowns, "unknowns"), (problem.elements, "elements"), (problem.nodes, "nodes"))
    return ", ".join(f"{formatting.count(value)} {name}" for value, name in sizes if formatting.known(value))


def problem_details(problem):
    scales = {**{k: v for k, v in problem.scales.items() if formatting.known(v)},
              **{f"probe {k}": v for k, v in problem.probe_scales.items() if formatting.known(v)},
              **{k: v for k, v in problem.quantity_scales.items() if formatting.known(v)}}
    span, frequency = "", ""
    if formatting.known(problem.end):
        span = f"{formatting.general(problem.start)} to {formatting.general(problem.end)} s"
    if formatting.known(problem.dominant_frequency):
        frequency = f"{formatting.general(problem.dominant_frequency)} Hz"
    scale_text = ", ".join(f"{k} {formatting.general(v)}" for k, v in scales.items())
    scale_text += f" ({problem.scale_words})" if problem.scale_words and scale_text else ""
    return tag("div", tag("h3", problem.label), pairs((
        ("Shows", problem.sentence), ("Scene", tag("code", problem.scene) if problem.scene else ""),
        ("Changed in it", _settings(problem.set)), ("Size", _size(problem)), ("Time span", span),
        ("Dominant frequency", frequency), ("Scales of the errors", scale_text),
        ("Reference", _reference_words(problem)))), _own_errors(problem))


ACROSS_MESHES = ("Here the reference has its own mesh. Probes are interpolated within the elements; "
                 "displacement and velocity are the root mean square over the probes. Errors below ten times the "
                 "reference's own time error or twice its mesh error are not resolved.")


def definitions(comparison):
    kinds = [joined([tag("dt", kind), tag("dd", f"{text}.")]) for kind, text in
             ((measures.KINDS[k], measures.DEFINITIONS[k]) for k in measures.KINDS)]
    return joined([
        tag("p", "An error is the difference between a run and the reference at the same times, in one number. "
                 "For displacement and velocity the difference of all nodes is measured in the mass norm, "
                 "‖d‖ = √(dᵀ M d) with the mass matrix M, so that heavy parts count more than light ones; a probe "
                 "is one point of the body, a quantity a number or vector of its own. Each is divided by the scale named for its problem: an error of 1e-2 "
                 "is one per cent of that scale. Over time it becomes"),
        tag("dl", *kinds),
        tag("p", "The phase error is the angle, in radians, by which the swing of the dominant frequency is ahead "
                 "of or behind the reference over the whole span. A drift is the largest change of a quantity "
                 "that is conserved or balanced, relative (energy: to the largest energy)."),
        tag("p", "No reference is exact to the last digit. An error below ten times the reference's own error says "
                 "little about the method: its marker is hollow and the diagrams are shaded there."),
        tag("p", ACROSS_MESHES) if comparison.pareto_fronts else None])


def methods_table(comparison):
    rows = [tag("tr", tag("th", method_name(comparison, m.id), scope="row"), tag("td", m.integrator),
                tag("td", m.control), tag("td", m.sentence, class_="message"), tag("td", _settings(m.set)))
            for m in comparison.methods]
    head = [tag("th", h, scope="col", class_="word" if h == "What it is" else None)
            for h in ("Method", "Integrator", "Controlled by", "What it is", "Set")]
    return headed_table("Methods and what was set for them", head, rows, "Methods")


def _value(key, text):
    """The text of an entry: memory_bytes 24e9 becomes 24000 MB; other texts are unchanged."""
    try:
        return f"{formatting.megabytes(float(text))} MB" if "bytes" in key else text
    except ValueError:
        return text


def facts(values):
    """Names and values of machine, versions or settings as text."""
    return pairs((k.replace("_bytes", "").replace("_", " "), _value(k, v)) for k, v in values.items())


def command(study, file, folder, ranks=1):
    """The command that made a study; `file` may be None."""
    place = shlex.quote(str(folder))
    several = f" --ranks {ranks}" if ranks > 1 else ""
    return f"orthodyn {study} {shlex.quote(file or 'FILE.yaml')} --out {place}{several}"


def drawing(folder):
    return f"tools/draw/draw report {shlex.quote(str(folder))}"


def provenance(comparison, folder):
    ranks = int(float(comparison.settings.get("ranks", 1)))
    lines = f"{command('compare', comparison.file, folder, ranks)}\n{drawing(folder)}"
    blocks = (("Machine", comparison.machine), ("Versions", comparison.versions), ("Settings", comparison.settings))
    return joined([tag("div", *(tag("div", tag("h3", name), facts(values)) for name, values in blocks if values),
                       class_="columns"), tag("h3", "To reproduce"), tag("pre", tag("code", lines))])
