"""Errors that the user can correct."""
import difflib


class DrawError(Exception):
    """One line for stderr: what was found, where, and what is expected."""


def unknown(kind, name, known):
    """DrawError for an unknown name, suggesting the nearest of `known`."""
    known = list(known)
    lowered = {k.lower(): k for k in known}
    near = difflib.get_close_matches(name.lower(), lowered, n=1, cutoff=0.5)
    hint = f"; did you mean '{lowered[near[0]]}'?" if near else ""
    listed = ", ".join(known) if known else "none"
    return DrawError(f"no {kind} '{name}'{hint} (present: {listed})")
