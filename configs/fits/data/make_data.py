#!/usr/bin/env python3
"""Makes the synthetic measurements of the examples: each scene with known constants, on a mesh twice as fine, plus random
errors of the stated standard deviation. Prints the values; tables go to this folder.

    configs/fits/data/make_data.py build/release/orthodyn
"""
from __future__ import annotations

import csv
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

FITS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(FITS.parents[1] / "tools"))
from draw.vtu import read_vtu  # noqa: E402

PROGRAM = Path(sys.argv[1]).resolve()


def run(scene: str, changes: list[str]) -> Path:
    folder = Path(tempfile.mkdtemp())
    arguments = [arg for change in changes for arg in ("--set", change)]
    subprocess.run([PROGRAM, "run", FITS / "scenes" / scene, "--quiet", "--force", "--out", folder, *arguments], check=True)
    return folder


def table(path: Path) -> list[dict[str, float]]:
    with path.open(encoding="utf-8") as file:
        return [{key.split(" [")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def muscle_release(noise: random.Random) -> None:
    """The end's way over time, with 1 mm. Truth: E1 = 60 kPa, damping 8 ms."""
    rows = table(run("muscle_release.yaml", ["mesh.cells=[20, 4, 2]", "integrator.rtol=1e-6"]) / "probes.csv")
    with (FITS / "data" / "muscle_release.csv").open("w", encoding="utf-8") as file:
        file.write("t [s],y [mm]\n")
        for row in rows[1:]:
            y = 1e3 * row["end.displacement.y"] + noise.gauss(0, 1)
            file.write(f"{row['t']:.2f},{y:.1f}\n")


def off_axis_strip(noise: random.Random) -> None:
    """Strains with 1 %, displacements with 5 um. Truth: E1 = 40, E2 = 10 GPa, angle 25 deg."""
    row = table(run("off_axis_strip.yaml", ["mesh.cells=[24, 8, 2]"]) / "probes.csv")[-1]
    for name in ("xx", "yy", "xy"):
        print(f"strain {name} {row[f'rosette.nodal_strain_space.{name}'] * noise.gauss(1, 0.01):.3e}")
    for name in ("x", "y"):
        print(f"displacement {name} {1e3 * row[f'end.displacement.{name}'] + noise.gauss(0, 0.005):.4f} mm")


def soundboard(noise: random.Random) -> None:
    """Peaks of the mobility with 5 %. Truth: losses of E1, E2 and G12 0.008, 0.02 and 0.014."""
    losses = "harmonic.losses={spruce: {young: [0.008, 0.02, 0.02], shear: [0.014, 0.016, 0.016]}}"
    for low, high in ((250, 350), (450, 560), (620, 740), (780, 900), (1050, 1180)):
        band = [f"harmonic.from={low}", f"harmonic.to={high}"]
        rows = table(run("soundboard.yaml", ["mesh.cells=[24, 16, 1]", losses, *band]) / "response.csv")
        peak = max(row["driven.velocity.z"] for row in rows)
        print(f"peak from {low} to {high} Hz: {peak * noise.gauss(1, 0.05):.3f} m/s")


PLATE = ["mesh.cells=[36, 24, 1]", "materials.spruce.young=[11e9, 0.9e9, 0.5e9]", "materials.spruce.g12=0.75e9",
         "materials.spruce.nu12=0.37"]


def spruce_plate(noise: random.Random) -> None:
    """Shapes at 35 points of the upper side, with 2 % of the largest amplitude and another scale and sign each; the exact
    frequencies, of which those in spruce_plate.yaml have errors of 0.5 %. Truth: E1 = 11, E2 = 0.9, G12 = 0.75 GPa, nu12 =
    0.37."""
    folder = Path(tempfile.mkdtemp())
    arguments = [arg for change in PLATE for arg in ("--set", change)]
    subprocess.run([PROGRAM, "modes", FITS / "scenes" / "spruce_plate.yaml", "-n", "14", "--out", folder, "--force", *arguments],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    frequencies = [row["frequency"] for row in table(folder / "modes.csv")][6:14]
    print("plate:", ", ".join(f"{frequency:.1f} Hz" for frequency in frequencies))
    places = [(x, y) for y in (0, 50, 100, 150, 200) for x in (0, 50, 100, 150, 200, 250, 300)]
    columns = []
    for k in range(8):
        grid = read_vtu(folder / "modes" / f"mode_{k + 7:03}.vtu")
        nodes = {tuple(round(1e4 * c) for c in point): shape[2] for point, shape in zip(grid.points, grid.node_fields["shape"])}
        found = [nodes[10 * x, 10 * y, 40] for x, y in places]
        largest, scale = max(map(abs, found)), noise.uniform(5, 20) * noise.choice((1, -1))
        columns.append([f"{scale * (z + largest * noise.gauss(0, 0.02)):.2f}" for z in found])
    with (FITS / "data" / "spruce_plate_shapes.csv").open("w", encoding="utf-8") as file:
        file.write("x [mm],y [mm],z [mm]," + ",".join(f"mode {k + 1} [mm/s]" for k in range(8)) + "\n")
        for p, (x, y) in enumerate(places):
            file.write(f"{x},{y},4," + ",".join(column[p] for column in columns) + "\n")


CUTS = {"L": "{first: [1, 0, 0], second: [0, 1, 0]}", "R": "{first: [0, 1, 0], second: [1, 0, 0]}",
        "T": "{first: [0, 1, 0], second: [0, 0, 1]}"}  # the direction of wood that lies along x


def wood_five_tests(noise: random.Random) -> None:
    """Strains with 1 %, frequencies with 0.5 %. Truth: the constants in the scenes (Sitka spruce)."""
    for cut, axes in CUTS.items():
        row = table(run("wood_block.yaml", [f"regions.body.axes={axes}"]) / "probes.csv")[-1]
        strains = [row[f"gauge.nodal_strain_space.{name}"] * noise.gauss(1, 0.01) for name in ("xx", "yy", "zz")]
        print(f"block {cut}:", ", ".join(f"{strain:.3e}" for strain in strains))
    for cut, axes in CUTS.items():
        folder = Path(tempfile.mkdtemp())
        subprocess.run([PROGRAM, "modes", FITS / "scenes" / "wood_bar.yaml", "-n", "10", "--out", folder, "--force",
                        "--set", f"regions.body.axes={axes}", "--set", "mesh.cells=[20, 8, 4]"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        frequencies = [row["frequency"] for row in table(folder / "modes.csv")][6:9]
        print(f"bar {cut}:", ", ".join(f"{frequency * noise.gauss(1, 0.005):.0f} Hz" for frequency in frequencies))


MIRRORED = ["clamps=[{surface: x1}]", "loads=[{surface: x0, force: [0, -200 N, 0]}]"]  # clamped at the other end


def knotty_beam(noise: random.Random) -> None:
    """Displacements with 1 um. Truth: a factor of 0.4 in the middle of a knot of 14 mm, 180 mm from the left end and 28 mm
    above the lower edge; it grows to 1 as a bell curve."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv", encoding="utf-8") as factors:
        factors.write("i,j,k,factor\n")
        for i in range(100):
            for j in range(8):
                square = (4 * i + 2 - 180) ** 2 + (5 * j + 2.5 - 28) ** 2
                factors.write(f"{i + 1},{j + 1},1,{1 - 0.6 * math.exp(-square / (2 * 14 ** 2)):.6f}\n")
        factors.flush()
        finer = [f"regions.body.stiffness_factors={{grid: [100, 8, 1], file: {factors.name}}}", "mesh.cells=[100, 8, 2]"]
        for side, changes in (("left", []), ("right", MIRRORED)):
            row = table(run("knotty_beam.yaml", finer + changes) / "probes.csv")[-1]
            print(f"clamped at the {side}:")
            for key, value in row.items():
                if key.endswith(("displacement.x", "displacement.y")):
                    print(f"      - {{quantity: {key}, value: {1e3 * value + noise.gauss(0, 0.001):.4f} mm, deviation: 1 um}}")


for make in (spruce_plate, knotty_beam, muscle_release, off_axis_strip, soundboard, wood_five_tests):
    print(make.__name__)
    make(random.Random(1))
