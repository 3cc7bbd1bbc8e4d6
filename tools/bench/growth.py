#!/usr/bin/env python3
"""Plots the growth of times and memory with the number of elements, from a file of `orthodyn_bench --growth --json`.
The time of a whole step needs results of runs of one scene on at least three meshes:
    tools/bench/growth.py growth.json growth.svg [RESULT/run.json ...]"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TIMES = ["force", "tangent", "solve", "symbolic analysis", "factorisation"]


def read(file):
    """For each measurement, rows of elements, seconds and bytes."""
    found = {}
    for result in json.load(open(file))["results"]:
        elements = result["elements"]
        seconds = 1e-9 * result["nanoseconds_per_element"] * elements
        found.setdefault(result["name"].split("/")[0], []).append((elements, seconds, result["bytes"]))
    return {name: np.array(sorted(rows)) for name, rows in found.items()}


def read_steps(files):
    """For each run, the elements and the seconds per step, without the time of outputs."""
    rows = []
    for file in files:
        run = json.load(open(file))
        seconds = run["wall_seconds"] - run["statistics"]["observation"]["seconds"]
        rows.append((run["model"]["elements"], seconds / run["statistics"]["steps"]))
    return np.array(sorted(rows))


def slope(x, y):
    """Slope through the three largest sizes on logarithmic axes."""
    return np.polyfit(np.log(x[-3:]), np.log(y[-3:]), 1)[0]


def draw(axes, rows, column, name, label_at=(6, 0)):
    x, y = rows[:, 0], rows[:, column]
    line, = axes.loglog(x, y, marker="o", markersize=3)
    axes.annotate(f"{name}, slope {slope(x, y):.2f}", (x[-1], y[-1]), xytext=label_at, textcoords="offset points",
                  va="center", fontsize=8, color=line.get_color())


def main(source, target, *runs):
    found = read(source)
    missing = [name for name in TIMES if len(found.get(name, [])) < 3]
    if missing:
        sys.exit(f"{source}: fewer than three sizes of {missing[0]}; "
                 "it must come from `orthodyn_bench --growth --json FILE`")
    if runs and len(runs) < 3:
        sys.exit("a slope needs runs on three meshes")
    figure, (times, memory) = plt.subplots(1, 2, figsize=(11, 4.2), width_ratios=(3, 2))
    for name in TIMES:
        draw(times, found[name], 1, name)
    if runs:
        draw(times, read_steps(runs), 1, "a step", label_at=(6, 8))
    draw(memory, found["factorisation"], 2, "factor")
    times.set_ylabel("s, one thread")
    memory.set_ylabel("bytes")
    for axes in (times, memory):
        axes.set_xlabel("tetrahedra")
        axes.set_xlim(right=1.2e8 if axes is times else 3e7)
        axes.set_xticks([1e3, 1e4, 1e5, 1e6])
        axes.minorticks_off()
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(target)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
