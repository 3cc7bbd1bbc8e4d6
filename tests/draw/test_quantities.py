"""tools/draw: quantities that colour a body, by name.

Run with  /usr/bin/python3 -m unittest tests/draw/test_quantities.py  (Debian's numpy, matplotlib, PIL).
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

from folder_test import InAFolder  # noqa: E402
from tiny_result import POINTS, write_result  # noqa: E402

from draw.colouring import Colouring  # noqa: E402
from draw.errors import DrawError  # noqa: E402
from draw.quantity import find_quantity, magnitude, von_mises  # noqa: E402
from draw.series import Series  # noqa: E402


class Quantities(InAFolder):
    def setUp(self):
        super().setUp()
        self.series = Series(write_result(self.folder / "r", [0.0, 1.0]))
        self.frame = self.series.frame(1)

    def test_von_mises_is_that_of_the_deviator_in_every_frame(self):
        s = np.random.default_rng(0).normal(size=(20, 6))
        full = np.stack([s[:, [0, 3, 5]], s[:, [3, 1, 4]], s[:, [5, 4, 2]]], axis=1)
        deviator = full - np.trace(full, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
        np.testing.assert_allclose(von_mises(s), np.sqrt(1.5 * (deviator ** 2).sum(axis=(1, 2))))
        np.testing.assert_allclose(magnitude(s), np.linalg.norm(full, axis=(1, 2)))
        np.testing.assert_allclose(von_mises(np.array([[3.0, 0, 0, 0, 0, 0], [0, 0, 0, 2, 0, 0], [5, 5, 5, 0, 0, 0]])),
                                   [3, 2 * np.sqrt(3), 0])

    def test_fields_at_nodes_are_named_and_preferred(self):
        frame = self.frame
        self.assertEqual(find_quantity(None, frame).field, "stress")
        frame.node_fields["nodal_stress"] = np.tile([3e6, 0, 0, 0, 0, 0], (5, 1))
        quantity = find_quantity(None, frame)
        self.assertEqual((quantity.field, quantity.kind, quantity.on_nodes), ("nodal_stress", "von_mises", True))
        self.assertEqual((quantity.label, quantity.unit), ("stress, von Mises", "Pa"))
        np.testing.assert_allclose(quantity.values(frame), 3e6)
        frame.node_fields["nodal_stress_material"] = frame.node_fields["nodal_stress"]
        self.assertEqual(find_quantity("nodal_stress_material.11", frame).kind, 0)

    def test_figures_of_the_stress_at_the_nodes_are_peaked_and_the_first_principal_value_stands_for_all(self):
        frame = self.frame
        frame.node_fields["principal_stress"] = np.tile([3e6, 0, -1e6], (5, 1))
        quantity = find_quantity("principal_stress", frame)
        self.assertEqual((quantity.kind, quantity.unit, quantity.peaked), (0, "Pa", True))
        np.testing.assert_allclose(find_quantity("principal_stress.3", frame).values(frame), -1e6)
        frame.node_fields["tsai_wu"] = np.full((5, 1), 0.5)
        self.assertTrue(find_quantity("tsai_wu", frame).peaked)
        self.assertEqual(find_quantity("tsai_wu", frame).label, "Tsai-Wu")
        frame.node_fields["nodal_det_f"] = np.full((5, 1), 8.0)
        self.assertEqual(find_quantity("nodal_det_f", frame).neutral, 1)
        frame.node_fields["von_mises"] = np.full((5, 1), 3e6)
        self.assertEqual(find_quantity(None, frame).field, "von_mises")

    def test_a_name_finds_its_component(self):
        for text, wanted in (("displacement.y", POINTS[:, 1]), ("displacement", np.linalg.norm(POINTS, axis=1)),
                             ("stress.xy", [0, 4e6]), ("stress", [6e6, 4e6 * np.sqrt(3)]), ("det_f", [8, 8]),
                             (None, [6e6, 4e6 * np.sqrt(3)])):
            with self.subTest(text=text):
                np.testing.assert_allclose(find_quantity(text, self.frame).values(self.frame), wanted)

    def test_an_unknown_name_lists_what_there_is_and_the_nearest(self):
        with self.assertRaisesRegex(DrawError, r"no field 'stres.xx'; did you mean 'stress'\? \(present: .*displacement"):
            find_quantity("stres.xx", self.frame)
        with self.assertRaisesRegex(DrawError, "component of stress 'yx'.*xx, yy, zz, xy, yz, zx, mag.*von_mises"):
            find_quantity("stress.yx", self.frame)

    def test_a_colour_range_is_symmetric_about_the_neutral_value(self):
        signed, ratio = find_quantity("stress.xx", self.frame), find_quantity("det_f", self.frame)
        norm = Colouring(signed, [np.array([-1e6, 3e6])]).norm
        self.assertAlmostEqual(norm.vmin, -norm.vmax)
        norm = Colouring(ratio, [np.array([0.5, 1.2])]).norm
        self.assertAlmostEqual(norm.vmin + norm.vmax, 2)

    def test_a_colour_range_leaves_out_peaks_of_stresses_alone(self):
        self.frame.node_fields["nodal_stress"] = np.zeros((5, 6))
        values = np.append(np.linspace(0, 1, 1000), 50)
        for name, high in (("stress", 1), ("nodal_stress", 1), ("displacement", 50)):
            with self.subTest(name=name):
                colouring = Colouring(find_quantity(name, self.frame), [values])
                self.assertAlmostEqual(colouring.norm.vmax * colouring.factor, high, delta=0.01)

    def test_cells_that_are_not_a_number_keep_their_own_colour(self):
        colouring = Colouring(find_quantity("stress", self.frame), [np.array([np.nan, 1e6, 2e6])])
        self.assertTrue(colouring.has_nan)
        red, green, blue = colouring(np.array([np.nan]))[0]
        self.assertTrue(red > 0.85 and green < 0.1 and blue < 0.6)
