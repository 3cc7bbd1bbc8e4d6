"""The one error that is the user's to solve, and the sentence that helps to solve it."""
import difflib


class DrawError(Exception):
    """One line for stderr: what was found, where, and what would be right."""


def unknown(kind, name, known):
    """DrawError for a name that is not among `known`, with the nearest one."""
    known = list(known)
    lowered = {k.lower(): k for k in known}
    near = difflib.get_close_matches(name.lower(), lowered, n=1, cutoff=0.5)
    hint = f"; did you mean '{lowered[near[0]]}'?" if near else ""
    listed = ", ".join(known) if known else "none"
    return DrawError(f"no {kind} '{name}'{hint} (present: {listed})")
