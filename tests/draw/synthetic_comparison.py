"""Comparisons like those of `orthodyn compare`, made from a formula: error ~ control^order, time ~ 1/step."""
import json
import math
import random

MEASURES = ("final", "l2", "max")
METHODS = {  # integrator: (kind of control, order, seconds of a step, error constant)
    "cvode_bdf": ("rtol", 0.8, 0.004, 1.5), "ida_bdf": ("rtol", 0.78, 0.005, 2.0),
    "arkode_dirk": ("rtol", 0.95, 0.02, 0.4), "arkode_ark": ("rtol", 0.9, 0.03, 0.8),
    "newmark": ("step", 2.0, 0.003, 40.0), "generalized_alpha": ("step", 2.0, 0.0035, 25.0),
    "backward_euler": ("step", 1.0, 0.0025, 8.0), "midpoint": ("step", 2.0, 0.0032, 20.0),
    "rattle": ("step", 2.0, 0.0005, 15.0), "cvode_adams": ("rtol", 0.85, 0.006, 1.1),
    "exponential": ("step", 2.0, 0.009, 4.0), "linearly_implicit_long_name": ("rtol", 0.9, 0.004, 3.0)}
PROBLEMS = ("damped_beam", "free_flight", "laminate", "twisted_plate", "wave_bar", "impact_block")


def _errors(error, reference, dice):
    def three(scale):
        return {kind: scale * f * error + reference for kind, f in zip(MEASURES, (1.3, 1.0, 2.4))}
    return {"displacement": three(1.0), "velocity": three(3.0 * dice.uniform(0.8, 1.2)),
            "probes": {"tip": three(0.9)}, "phase": 4 * error}


def _statistics(wall, steps):
    """Parts that sum to 86 % of the wall time."""
    shares = {"force": (0.22, 3.8), "tangent": (0.10, 0.2), "factorization": (0.32, 0.3), "solve": (0.22, 2.7)}
    found = {part: {"count": round(n * steps), "seconds": share * wall} for part, (share, n) in shares.items()}
    return {"steps": steps, "rejected_steps": steps // 15, "error_test_failures": steps // 20,
            "convergence_failures": steps // 40, "newton_iterations": round(2.7 * steps), "gauss_newton_fallbacks": 0,
            **found}


def _drift(size, dice, end, count=60):
    t = [end * k / count for k in range(count + 1)]
    energy = [size * (x / end) * (0.55 + 0.45 * math.sin(9 * x / end + dice.random())) for x in t]
    return {"t": t, "energy": energy}


def completed(problem, method, value, dice, end=1.0):
    kind, order, cost, constant = METHODS[method]
    error = constant * value ** order * dice.uniform(0.8, 1.25)
    steps = max(8, round(end / value if kind == "step" else 14 * value ** -0.3 * end))
    wall = cost * steps * dice.uniform(0.95, 1.05)
    return {"problem": problem, "method": method, "control": {"kind": kind, "value": value}, "status": "completed",
            "reason": None, "message": None, "time_reached": end, "repeats": 3,
            "wall": {"median": wall, "min": 0.97 * wall, "max": 1.06 * wall},
            "cpu": {"median": 1.7 * wall, "min": 1.6 * wall, "max": 1.8 * wall},
            "statistics": _statistics(wall, steps), "peak_memory_bytes": 5.2e7, "factor_bytes": 2.1e7,
            "errors": _errors(error, 1e-8, dice), "near_reference": ["displacement.l2"] if error < 9e-8 else [],
            "drift": {"energy": 0.3 * error, "linear_momentum": 1e-12, "angular_momentum": None},
            "drift_over_time": _drift(0.3 * error, dice, end), "smallest_det_f": 0.8, "decisions": {"max_order": "5"},
            "scene": f"points/{problem}_{method}_{value:g}/scene.yaml"}


def failed(problem, method, value, reason, reached=0.34, wall=0.5):
    return {"problem": problem, "method": method, "control": {"kind": METHODS[method][0], "value": value},
            "status": "failed", "reason": reason,
            "message": f"stopped at t = {reached} s: {reason}; use a smaller step",
            "time_reached": reached, "repeats": 1, "wall": {"median": wall, "min": wall, "max": wall},
            "cpu": None, "statistics": None, "errors": None, "drift": None, "drift_over_time": None}


def _problem(name, k):
    own = {kind: 1e-8 for kind in MEASURES}
    return {"id": name, "label": name, "scene": f"configs/benchmarks/{name}.yaml", "set": {"mesh.cells": "[45, 9, 9]"},
            "sentence": "A clamped beam of spruce is released from a bent shape and swings, damped.",
            "unknowns": 2700 * (k + 1), "elements": 3125, "nodes": 936, "time": {"start": 0, "end": 1},
            "scales": {"displacement": 0.42, "velocity": 2.1,
                       "words": "largest displacement, and largest velocity, of the reference over time, in the mass norm"},
            "probe_scales": {"tip": 0.9}, "quantity_scales": {"von_mises.largest": 3e6}, "dominant_frequency": 1.23,
            "reference": {"kind": "computed", "method": "arkode_dirk, rtol 1e-9", "check": "ida_bdf, rtol 1e-8",
                          "seconds": 12.3, "message": None,
                          "errors": {"displacement": own, "velocity": own, "probes": {"tip": own}, "phase": 1e-8}}}


def _method(name):
    return {"id": name, "label": name, "integrator": name, "sentence": f"{name.upper()}: what it is in one sentence.",
            "set": {"integrator.max_order": "2"}, "control": METHODS[name][0]}


def _answers(points, problems, methods, targets=(1e-2, 1e-3, 1e-4, 1e-5)):
    answers = []
    for problem in problems:
        for target in targets:
            entries = []
            for method in methods:
                runs = [(p["wall"]["median"], p["errors"]["displacement"]["l2"]) for p in points
                        if (p["problem"], p["method"], p["status"]) == (problem, method, "completed")]
                below = [t for t, e in runs if e <= target]
                entries.append({"method": method, "seconds": min(below, default=None),
                                "best_error": min((e for _, e in runs), default=None)})
            answers.append({"problem": problem, "error": "displacement.l2", "target": target, "methods": entries})
    return answers


def controls(method, count):
    return [10.0 ** -(2 + 0.75 * k) if METHODS[method][0] == "rtol" else 0.04 / 2 ** k for k in range(count)]


def comparison(problems=1, methods=6, points=6, seed=1):
    """The contents of compare.json; the loosest run of every third method and two others fail."""
    dice, problem_names, names = random.Random(seed), PROBLEMS[:problems], list(METHODS)[:methods]
    found = []
    for k, problem in enumerate(problem_names):
        for m, name in enumerate(names):
            for c, value in enumerate(controls(name, points)):
                if (m + k) % 3 == 2 and c == 0:
                    found.append(failed(problem, name, value, "diverged"))
                elif m == 4 and c == points - 1:
                    found.append(failed(problem, name, value, "time limit", 0.81, 60.0))
                else:
                    found.append(completed(problem, name, value, dice))
    orders = [{"problem": p, "method": m, "error": "displacement.l2", "slope": METHODS[m][1], "points": points,
               "from": 1e-2, "to": 1e-6} for p in problem_names for m in names]
    return {"orthodyn_comparison": 1, "name": "damped_beam", "title": "Integrators on a damped wooden beam",
            "description": "Six integrators follow a clamped spruce beam over one second.",
            "file": "configs/comparisons/damped_beam.yaml", "started": "2026-11-21T11:00:00Z", "complete": True,
            "planned_points": len(found), "machine": {"processor": "AMD EPYC 7B13", "cores": 2, "memory_bytes": 24e9},
            "versions": {"orthodyn": "0.1.0", "SUNDIALS": "6.4.1"},
            "settings": {"repeats": 3, "samples": 100, "limit_seconds": 60, "limit_memory_bytes": 4e9},
            "problems": [_problem(p, k) for k, p in enumerate(problem_names)], "methods": [_method(m) for m in names],
            "points": found, "answers": _answers(found, problem_names, names), "orders": orders}


def write_comparison(folder, content):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compare.json").write_text(json.dumps(content))
    return folder
