#!/usr/bin/env python3
"""How often do the 95 % intervals of `orthodyn fit` hold the truth? Fits an off-axis strip many times to values with other
random errors, and counts. Intervals are right if 92 to 98 % of 200 repetitions hold the truth.

    tools/bench/fit_coverage.py build/release/orthodyn --repetitions 200
"""
from __future__ import annotations

import argparse
import csv
import json
import random
import subprocess
import tempfile
from pathlib import Path

SCENES = Path(__file__).resolve().parents[2] / "configs" / "fits" / "scenes"
COARSE = {"mesh.cells": [4, 2, 1]}
QUANTITIES = ["rosette.nodal_strain_space.xx", "rosette.nodal_strain_space.yy", "rosette.nodal_strain_space.xy",
              "end.displacement.x", "end.displacement.y"]
DEVIATION = 0.01  # of each value
PARAMETERS = {  # path, start, truth in the unit of the scene
    "angle": ("regions.body.axes.angle", "23 deg", 25),
    "E1": ("materials.glass_epoxy.young_axial", "36 GPa", 40),
    "E2": ("materials.glass_epoxy.young_transverse", "11 GPa", 10)}


def true_values(program: Path, folder: Path) -> list[float]:
    changes = [arg for key, value in COARSE.items() for arg in ("--set", f"{key}={value}")]
    subprocess.run([program, "run", SCENES / "off_axis_strip.yaml", "--quiet", "--force", "--out", folder / "truth", *changes],
                   check=True)
    with (folder / "truth" / "probes.csv").open(encoding="utf-8") as file:
        row = {key.split(" [")[0]: float(value) for key, value in list(csv.DictReader(file))[-1].items()}
    return [row[quantity] for quantity in QUANTITIES]


def intervals(program: Path, folder: Path, values: list[float]) -> dict[str, tuple[float, float]]:
    """The 95 % intervals of a fit, by parameter."""
    measured = [{"quantity": quantity, "value": value, "relative": DEVIATION}
                for quantity, value in zip(QUANTITIES, values, strict=True)]
    scene = {"file": str(SCENES / "off_axis_strip.yaml"), "set": COARSE}
    fit = {"experiments": {"tension": {"scene": scene, "measured": measured}}, "refine": False,
           "parameters": {name: {"path": path, "start": start} for name, (path, start, _) in PARAMETERS.items()}}
    (folder / "fit.yaml").write_text(json.dumps(fit), encoding="utf-8")  # JSON is YAML
    subprocess.run([program, "fit", folder / "fit.yaml", "--quiet", "--no-report", "--out", folder / "fit"], check=True,
                   stderr=subprocess.DEVNULL)
    table = json.loads((folder / "fit" / "fit.json").read_text(encoding="utf-8"))
    return {one["name"]: (one["low"], one["high"]) for one in table["parameters"]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--repetitions", type=int, default=200)
    arguments = parser.parse_args()
    noise = random.Random(1)
    held = dict.fromkeys(PARAMETERS, 0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        truth = true_values(arguments.program, folder)
        for repetition in range(arguments.repetitions):
            own = folder / str(repetition)
            own.mkdir()
            found = intervals(arguments.program, own, [value * noise.gauss(1, DEVIATION) for value in truth])
            for parameter, (_, _, value) in PARAMETERS.items():
                low, high = found[parameter]
                held[parameter] += low <= value <= high
    for parameter, count in held.items():
        print(f"{parameter}: {count} of {arguments.repetitions} intervals hold the truth ({100 * count / arguments.repetitions:.1f} %)")


if __name__ == "__main__":
    main()
