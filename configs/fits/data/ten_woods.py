#!/usr/bin/env python3
"""Which constants of ten woods do the tests of wood_five_tests.yaml find? Replaces the wood by those of `orthodyn list
presets`, the data by exact ones, and prints the half widths of the 95 % intervals as a table.

    configs/fits/data/ten_woods.py build/release/orthodyn
"""
from __future__ import annotations

import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = Path(__file__).resolve().parents[1] / "scenes"
PROGRAM = Path(sys.argv[1]).resolve()
WOODS = ["sitka_spruce", "douglas_fir", "engelmann_spruce", "yellow_poplar", "yellow_birch", "black_walnut", "sweetgum",
         "balsa", "honduras_mahogany", "african_mahogany"]
CUTS = {"L": "{first: [1, 0, 0], second: [0, 1, 0]}", "R": "{first: [0, 1, 0], second: [1, 0, 0]}",
        "T": "{first: [0, 1, 0], second: [0, 0, 1]}"}  # the direction of wood that lies along x
PATHS = {"EL": "young.0", "ER": "young.1", "ET": "young.2", "nuLR": "nu12", "nuRT": "nu23", "nuLT": "nu13", "GLR": "g12",
         "GRT": "g23", "GLT": "g13"}


def presets() -> dict[str, dict[str, float]]:
    text = subprocess.run([PROGRAM, "list", "presets"], capture_output=True, text=True, check=True).stdout
    woods: dict[str, dict[str, float]] = {}
    for line in text.splitlines():
        if match := re.fullmatch(r"  (\w+)", line):
            woods[match[1]] = {}
        elif re.match(r"    (E1|nu12) ", line):
            found = re.findall(r"(E[123]|G\d\d|nu\d\d) ([-\d.e]+)", line.split("(")[0])
            list(woods.values())[-1].update({name: float(value) for name, value in found})
    return woods


def changes(wood: dict[str, float], cut: str) -> dict[str, str]:
    young = ", ".join(f"{wood[f'E{i}']} GPa" for i in (1, 2, 3))
    named = {f"materials.wood.{key}": str(wood[key]) for key in ("nu12", "nu23", "nu13")}
    named |= {f"materials.wood.{key.lower()}": f"{wood[key]} GPa" for key in ("G12", "G23", "G13")}
    return {"materials.wood.young": f"[{young}]", **named, "regions.body.axes": CUTS[cut]}


def rows(command: str, scene: str, wood: dict[str, float], cut: str, table: str) -> list[dict[str, float]]:
    with tempfile.TemporaryDirectory() as folder:
        arguments = [arg for key, value in changes(wood, cut).items() for arg in ("--set", f"{key}={value}")]
        subprocess.run([PROGRAM, command, SCENES / scene, "--force", "--out", folder, *arguments], check=True,
                       capture_output=True)
        with (Path(folder) / table).open(encoding="utf-8") as file:
            return [{key.split(" [")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def fit_of(wood: dict[str, float]) -> dict[str, object]:
    lines = ["refine: false", "experiments:"]
    for cut in CUTS:
        sets = "{" + ", ".join(f"{key}: {value}" for key, value in changes(wood, cut).items()) + "}"
        if cut != "T":
            found = [row["frequency"] for row in rows("modes", "wood_bar.yaml", wood, cut, "modes.csv")]
            elastic = [frequency for frequency in found if frequency > 1][:3]
            lines += [f"  bar {cut}:", f"    scene: {{file: {SCENES / 'wood_bar.yaml'}, set: {sets}}}",
                      "    measured: [{frequencies: [" + ", ".join(f"{x:.8g} Hz" for x in elastic) + "], relative: 0.005}]"]
        strains = rows("run", "wood_block.yaml", wood, cut, "probes.csv")[-1]
        lines += [f"  block {cut}:", f"    scene: {{file: {SCENES / 'wood_block.yaml'}, set: {sets}}}", "    measured:"]
        lines += [f"      - {{quantity: gauge.nodal_strain_space.{c}, value: {strains[f'gauge.nodal_strain_space.{c}']:.8g}, "
                  "relative: 0.01}" for c in ("xx", "yy", "zz")]
    lines += ["parameters:", *(f"  {name}: materials.wood.{path}" for name, path in PATHS.items())]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "fit.yaml").write_text("\n".join(lines), encoding="utf-8")
        subprocess.run([PROGRAM, "fit", folder / "fit.yaml", "--quiet", "--no-report", "--out", folder / "fit"], check=True,
                       stderr=subprocess.DEVNULL)
        return json.loads((folder / "fit" / "fit.json").read_text(encoding="utf-8"))


def main() -> None:
    print("| wood |", " | ".join(PATHS), "|\n|" + " --- |" * (1 + len(PATHS)))
    known = presets()
    for name in WOODS:
        precisions = [one["precision"] for one in fit_of(known[name])["parameters"]]
        print(f"| {name.replace('_', ' ')} |", " | ".join(precisions), "|", flush=True)


if __name__ == "__main__":
    main()
