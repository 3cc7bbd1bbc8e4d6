#!/usr/bin/env python3
"""Prints the table of docs/accuracy.md: rubber and fibres at large strain, computed by orthodyn and by CalculiX.

    ORTHODYN_EXECUTABLE=build/release/orthodyn /usr/bin/python3 tools/bench/calculix_laws.py

A block of 60 x 60 x 30 mm is bonded between two plates. The upper plate presses and shears it. Both programs read the same
mesh of quadratic tetrahedra (C3D10). Each row compares the displacements of all nodes (largest difference over the largest
displacement) and the force on the plate (difference over its magnitude). Needs `ccx` (Debian: calculix-ccx).
"""
import csv
import itertools
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from draw.vtu import read_vtu

PROGRAM = os.path.abspath(shutil.which(os.environ.get("ORTHODYN_EXECUTABLE", "orthodyn")) or "orthodyn")
SIZE, CELLS = np.array([0.06, 0.06, 0.03]), np.array([5, 5, 3])
YOUNG = 1.5e6
K1, K2, DIRECTION = 0.5e6, 5.0, np.array([np.sqrt(3) / 2, 0, 0.5])  # of the fibres
EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]  # of C3D10, in its order


def mesh():
    """Nodes at half cells, and six tetrahedra per cell, all about the cell's diagonal."""
    counts = 2 * CELLS + 1
    grid = np.array(list(itertools.product(*(range(n) for n in counts))))
    number = {tuple(place): k for k, place in enumerate(grid)}
    tets = []
    for cell in itertools.product(*(range(n) for n in CELLS)):
        for order in itertools.permutations(range(3)):
            corners = [2 * np.array(cell)]
            for axis in order:
                corners.append(corners[-1] + 2 * np.eye(3, dtype=int)[axis])
            if np.linalg.det(np.array(corners[1:]) - corners[0]) < 0:
                corners[1], corners[2] = corners[2], corners[1]
            middles = [(corners[i] + corners[j]) // 2 for i, j in EDGES]
            tets.append([number[tuple(p)] for p in corners + middles])
    used = sorted({k for tet in tets for k in tet})
    new = {k: i for i, k in enumerate(used)}
    return grid[used] / (2 * CELLS) * SIZE, [[new[k] for k in tet] for tet in tets]


def write_mesh(path, nodes, tets):
    lines = ["*NODE, NSET=ALL"] + [f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for k, (x, y, z) in enumerate(nodes)]
    lines += ["*ELEMENT, TYPE=C3D10, ELSET=BODY"]
    lines += [f"{k + 1}, " + ", ".join(str(n + 1) for n in tet) for k, tet in enumerate(tets)]
    for name, height in (("BOTTOM", 0), ("TOP", SIZE[2])):
        lines += [f"*NSET, NSET={name}"] + [f"{k + 1}," for k in np.flatnonzero(np.isclose(nodes[:, 2], height))]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def calculix(folder, material, shift):
    """Displacements of the nodes (m), and the force on the plate (N), by CalculiX."""
    deck = f"""*INCLUDE, INPUT=mesh.inp
{material}
*SOLID SECTION, ELSET=BODY, MATERIAL={material.split("NAME=")[1].split()[0]}
*STEP, NLGEOM, INC=1000
*STATIC
0.01, 1, 1e-4, 0.01
*CONTROLS, PARAMETERS=FIELD
1e-9, 1e-9
*BOUNDARY
BOTTOM, 1, 3
TOP, 1, 1, {shift[0]}
TOP, 2, 2, {shift[1]}
TOP, 3, 3, {shift[2]}
*NODE PRINT, NSET=ALL, FREQUENCY=10000
U
*NODE PRINT, NSET=TOP, FREQUENCY=10000
RF
*END STEP
"""
    (folder / "deck.inp").write_text(deck, encoding="utf-8")
    done = subprocess.run(["ccx", "-i", "deck"], cwd=folder, capture_output=True, text=True)
    if "Job finished" not in done.stdout:
        raise SystemExit(done.stdout[-2000:])
    tables = {}
    for line in (folder / "deck.dat").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and words[0] in ("displacements", "forces"):
            rows = tables[words[0]] = {}  # of the last increment
        elif len(words) == 4:
            rows[int(words[0])] = [float(w) for w in words[1:]]
    u = np.array([row for _, row in sorted(tables["displacements"].items())])
    return u, np.sum(list(tables["forces"].values()), axis=0)


def orthodyn(folder, nu, has_fibres, shift):
    """The same, by orthodyn."""
    fibres = f"fibres: {{passive: {{type: exponential, k1: {K1}, k2: {K2}}}}}" if has_fibres else ""
    (folder / "scene.yaml").write_text(f"""analysis: static
mesh: {{type: file, file: mesh.inp}}
materials:
  rubber:
    type: isotropic
    density: 1000
    young: {YOUNG}
    nu: {nu}
    {fibres}
regions:
  all: {{material: rubber, law: neo_hookean, axes: {{first: {DIRECTION.tolist()}, second: [0, 1, 0]}}}}
clamps: [{{nodes: BOTTOM}}]
motions: [{{nodes: TOP, name: plate, displacement: {list(shift)}}}]
statics: {{solver: {{type: kinsol, rtol: 1e-11}}}}
output: {{reactions: true, fields: [displacement]}}
""", encoding="utf-8")
    command = [PROGRAM, "run", "scene.yaml", "--out", "out", "--force"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    frame = read_vtu(sorted((folder / "out" / "frames").glob("*.vtu"))[-1])
    with open(folder / "out" / "probes.csv", encoding="utf-8") as lines:
        last = list(csv.DictReader(lines))[-1]
    return frame.node_fields["displacement"], np.array([float(last[f"reaction.plate.{axis} [N]"]) for axis in "xyz"])


def material_lines(nu, law):
    """CalculiX' material that has the moduli of the scene at small strain."""
    mu, bulk = YOUNG / (2 * (1 + nu)), YOUNG / (3 * (1 - 2 * nu))
    if law == "Ciarlet":  # mu/2 (tr C - 3) - mu ln J + lambda/4 (J^2 - 1) - lambda/2 ln J
        return f"*MATERIAL, NAME=CIARLET_EL\n*USER MATERIAL, CONSTANTS=2\n{YOUNG:.12g}, {nu:.12g}"
    if law == "neo-Hooke":  # mu/2 (J^(-2/3) tr C - 3) + K/2 (J - 1)^2
        return f"*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n{mu / 2:.12g}, {2 / bulk:.12g}"
    # neo-Hooke, and k1/(2 k2) (exp(k2 E^2) - 1) with E = J^(-2/3) lambda^2 - 1, for E > 0
    fibre = f"{DIRECTION[0]:.12g}, {DIRECTION[1]:.12g}, {K1:.12g}, {K2:.12g}"
    return f"*MATERIAL, NAME=ELASTIC_FIBER\n*USER MATERIAL, CONSTANTS=6\n{mu / 2:.12g}, {2 / bulk:.12g}, {fibre}"


def main():
    nodes, tets = mesh()
    print(f"{3 * len(nodes)} displacements, {len(tets)} elements")
    for law, shift, ratios in (("Ciarlet", (0.012, 0, -0.009), (0, 0.3, 0.45)),
                               ("neo-Hooke", (0.012, 0, -0.009), (0.3, 0.45, 0.49, 0.499, 0.4999)),
                               ("fibres", (0.012, 0, -0.0045), (0.3, 0.45, 0.49, 0.499, 0.4999))):
        for nu in ratios:
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                write_mesh(folder / "mesh.inp", nodes, tets)
                theirs, their_force = calculix(folder, material_lines(nu, law), shift)
                ours, our_force = orthodyn(folder, nu, law == "fibres", shift)
            moved = np.abs(ours - theirs).max() / np.abs(theirs).max()
            force = np.linalg.norm(our_force - their_force) / np.linalg.norm(their_force)
            print(f"{law:10} nu {nu:<6} displacements {moved:.1e}  force {force:.1e}  CalculiX {their_force} N")


if __name__ == "__main__":
    main()
