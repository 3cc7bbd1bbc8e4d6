"""A stability.json with two cases, three integrators and two variants."""
import json

import numpy as np

from tiny_result import POINTS, TETS, Vtu

CASES, VARIANTS, INTEGRATORS = ("mirrored", "spinning"), ("exact", "warped"), ("alpha", "beta", "gamma")
REFUSAL = "/tmp/some where/trials/1a2b/scene.yaml:18:13: integrator: explicit: names no part of the force"
GRADES = {  # variant, case: grades by integrator
    ("exact", "mirrored"): ("pass", "pass", "degraded"), ("warped", "mirrored"): ("pass", "fail", "refused"),
    ("exact", "spinning"): ("pass", "fail", "fail"), ("warped", "spinning"): ("fail", "refused", "pass")}


def worst(title="drift of energy.balance", computed=0.386, limit=0.01):
    return {"title": title, "computed": computed, "expected": 0.0, "limit": limit, "source": "nothing can add energy",
            "tolerance": "100 rtol"}


def trial(case, variant, integrator, grade, **changes):
    found = {"case": case, "variant": variant, "integrator": integrator,
             "folder": f"trials/{case}{variant}{integrator}", "status": "completed", "grade": grade, "reason": "",
             "worst": worst(computed=1e-5), "time_reached": 1.0, "wall": 0.25, "cpu": 0.2,
             "statistics": {"steps": 100}}
    if grade == "refused":
        found.update(status="refused", reason=REFUSAL, worst=None)
        for key in ("time_reached", "wall", "cpu", "statistics"):
            del found[key]
    elif grade != "pass":
        found.update(worst=worst(), reason="drift of energy.balance is 0.386, expected 0 +- 0.01")
    return {**found, **changes}


def matrix(**changes):
    """The contents of stability.json."""
    trials = [trial(case, variant, name, grade) for case in CASES for variant in VARIANTS
              for name, grade in zip(INTEGRATORS, GRADES[variant, case])]
    return {"kind": "stability", "title": "Hard cases", "description": "What breaks integrators.",
            "file": "configs/stability/hard_cases.yaml", "at": "2026-11-21T11:00:00Z",
            "machine": {"processor": "AMD EPYC 7B13", "cores": 2, "memory_bytes": 24e9},
            "versions": {"orthodyn": "0.1.0", "SUNDIALS": "6.4.1"}, "limit": 20.0,
            "cases": [{"label": c, "file": f"cases/{c}.yaml", "sentence": f"A {c} block.",
                       "model": "layers slide" if c == "spinning" else ""} for c in CASES],
            "variants": list(VARIANTS), "integrators": list(INTEGRATORS), "complete": True, "trials": trials, **changes}


def write_matrix(folder, content):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "stability.json").write_text(json.dumps(content))
    return folder


def write_end_state(folder, trial_, positions, det_f=(1.0, 1.0)):
    """Writes an end state of the tiny body with its nodes at `positions`."""
    place = folder / trial_["folder"]
    place.mkdir(parents=True, exist_ok=True)
    moved = np.asarray(positions) - POINTS
    (place / "end.vtu").write_bytes(Vtu(POINTS, TETS).content({"displacement": moved},
                                                              {"det_f": np.array(det_f)[:, None]}))
