"""tools/draw: units, time labels, and labels of curves.

Run with  /usr/bin/python3 -m unittest tests/draw/test_units.py  (Debian's numpy, matplotlib, PIL).
"""
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

import folder_test  # noqa: E402,F401  (finds the package draw)

from draw.chart import spread  # noqa: E402
from draw.units import length_label, prefix, round_length, time_labels  # noqa: E402


class Units(unittest.TestCase):
    def test_prefixes_and_lengths_are_round(self):
        self.assertEqual(prefix("Pa", 2.5e6), (1e6, "MPa"))
        self.assertEqual(prefix("s", 5000), (1.0, "s"))
        self.assertEqual(prefix("kg m/s", 5000), (1.0, "kg m/s"))
        self.assertEqual([round_length(x) for x in (0.9, 1.0, 3.4, 70)], [0.5, 1, 2, 50])
        self.assertEqual([length_label(x) for x in (0.02, 0.5, 2, 5000)], ["20 mm", "50 cm", "2 m", "5 km"])

    def test_times_can_be_told_apart(self):
        self.assertEqual(time_labels([0, 0.5, 1]), ["t = 0.0 s", "t = 0.5 s", "t = 1.0 s"])
        self.assertEqual(time_labels([0, 1e-3, 2.25e-3]), ["t = 0.00 ms", "t = 1.00 ms", "t = 2.25 ms"])
        labels = time_labels(list(np.linspace(0, 1, 61)))
        self.assertEqual(len(set(labels)), 61)
        self.assertTrue(all(re.fullmatch(r"t = \d\.\d{3,4} s", label) for label in labels))

    def test_names_of_curves_are_moved_apart_and_keep_their_order(self):
        np.testing.assert_allclose(spread([0.5, 0.5, 0.9], 0.1), [0.45, 0.55, 0.9])
        placed = spread(np.array([0.3, 0.1, 0.32, 0.31]), 0.1)
        self.assertTrue((np.diff(np.sort(placed)) > 0.1 - 1e-12).all())
        self.assertEqual(np.argsort(placed).tolist(), [1, 0, 3, 2])
