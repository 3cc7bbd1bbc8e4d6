"""A scene with a short run time, as a dict."""
import sys

sys.dont_write_bytecode = True


def beam(**changes):
    return {
        "mesh": {"type": "box", "size": [1, 0.1, 0.1], "cells": [6, 1, 1], "order": 1},
        "materials": {"wood": {"type": "orthotropic_stable", "density": 500, "young": [1e7, 1e6, 1e6], "nu": 0.3}},
        "regions": {"all": {"material": "wood"}},
        "gravity": [0, 0, -9.81],
        "damping": {"stiffness": 1e-3},
        "clamps": [{"surface": "x0"}],
        "time": {"end": 0.2},
        "integrator": {"type": "cvode_bdf", "rtol": 1e-4},
        "output": {"frames": 8, "fields": ["displacement", "velocity", "stress"], "probes": {"tip": {"at": [1, 0, 0]}}},
        **changes,
    }
