"""tools/draw/stability: end states are sorted into clusters and drawn.

Run with  /usr/bin/python3 -m unittest tests/draw/test_end_states.py
"""
import sys
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.stability.clusters import (  # noqa: E402
    about_middle, are_apart, as_they_are, extent, same_states, turned_back)
from draw.stability.end_states import EndStates  # noqa: E402
from draw.stability.page import page  # noqa: E402
from draw.stability.reading import read_matrix  # noqa: E402
from report_page import OfAComparison, Page  # noqa: E402
from synthetic_matrix import matrix, write_end_state, write_matrix  # noqa: E402
from tiny_result import POINTS  # noqa: E402


class Clusters(unittest.TestCase):
    def test_states_within_the_distance_are_one_and_the_most_common_comes_first(self):
        rest, other = POINTS, POINTS + [0.1, 0, 0]
        found = same_states([other, rest, rest + [0, 0.01, 0], rest - [0, 0.01, 0]], 0.02)
        self.assertEqual([set(members) for members in found], [{1, 2, 3}, {0}])

    def test_one_node_is_enough_to_differ(self):
        moved = POINTS.copy()
        moved[3, 2] += 0.021
        self.assertEqual(len(same_states([POINTS, moved], 0.02)), 2)
        self.assertEqual(len(same_states([POINTS, moved], 0.022)), 1)

    def test_the_first_of_a_cluster_is_its_middle(self):
        line = [POINTS + [x, 0, 0] for x in (0.0, 0.015, 0.03)]
        self.assertEqual(same_states(line, 0.02), [[1, 0, 2]])

    def test_bodies_are_apart_when_the_gap_is_wider_than_they_are(self):
        size = extent(POINTS)
        self.assertFalse(are_apart([POINTS, POINTS + 0.5], size))
        self.assertTrue(are_apart([POINTS, POINTS + 10.0], size))


    def test_a_body_is_turned_back_but_its_mirror_image_is_not(self):
        angle = np.radians(100)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        np.testing.assert_allclose(turned_back(POINTS, POINTS @ turn.T + 7), POINTS, atol=1e-12)
        uneven = POINTS * [1, 2, 3]
        self.assertGreater(np.abs(turned_back(uneven, uneven @ turn * [1, 1, -1]) - uneven).max(), 0.1)


class OfACase(OfAComparison):
    """End states of the variant `mirrored`; in `exact` alpha and beta pass, gamma is degraded."""

    def setUp(self):
        super().setUp()
        self.content = matrix()
        write_matrix(self.folder, self.content)

    def ends(self, positions, integrator, variant="exact", **options):
        trial = next(t for t in self.content["trials"] if (t["case"], t["variant"], t["integrator"]) ==
                     ("mirrored", variant, integrator))
        write_end_state(self.folder, trial, positions, **options)

    def states(self):
        read = read_matrix(self.folder)
        return EndStates(read, self.folder, read.cases[0])

    def names(self, trials):
        return [t.integrator for t in trials]

    def test_the_same_end_shares_a_picture_in_each_variant(self):
        self.ends(POINTS, "alpha")
        self.ends(POINTS + 0.001, "beta")
        self.ends(1.3 * POINTS, "gamma", det_f=(-1.0, 2.0))
        self.ends(POINTS, "alpha", "warped")
        states = self.states()
        self.assertEqual([self.names(c.trials) for c in states.clusters["exact"]], [["alpha", "beta"], ["gamma"]])
        self.assertEqual([c.leader.inverted for c in states.clusters["exact"]], [0, 1])
        self.assertEqual([self.names(c.trials) for c in states.clusters["warped"]], [["alpha"]])
        self.assertEqual(self.names(states.absent["warped"]), ["beta", "gamma"])
        self.assertIs(states.place, as_they_are)

    def test_what_exploded_is_told_in_words_and_does_not_shrink_the_others(self):
        self.ends(POINTS, "alpha")
        self.ends(1e6 * POINTS, "beta")
        states = self.states()
        self.assertEqual([(t.integrator, round(ratio)) for t, ratio in states.exploded["exact"]], [("beta", 10 ** 6)])
        self.assertLess(states.scene([0]).window.size.max(), 3)
        text = Page(page(read_matrix(self.folder), self.folder)).text
        self.assertIn("Exploded, 1e6 times as large as those that did well: beta (pass).", text)

    def test_bodies_far_from_each_other_are_drawn_about_their_middles(self):
        self.ends(POINTS, "alpha")
        self.ends(POINTS + [1000.0, 0, 0], "beta")
        states = self.states()
        self.assertIs(states.place, about_middle)
        self.assertEqual([self.names(c.trials) for c in states.clusters["exact"]], [["alpha", "beta"]])
        self.assertLess(states.scene([0]).window.size.max(), 3)

    def test_a_state_in_one_point_is_drawn(self):
        for name in ("alpha", "beta", "gamma"):
            self.ends(np.zeros_like(POINTS), name, det_f=(0.0, 0.0))
        html = page(read_matrix(self.folder), self.folder)
        self.assertEqual(html.count('src="data:image/png'), 1)
        self.assertIn("shrunk to a point", html)

    def test_what_is_damaged_or_not_finite_has_no_picture(self):
        self.ends(POINTS, "alpha")
        self.ends(np.full_like(POINTS, np.nan), "beta")
        self.ends(POINTS, "gamma")
        (self.folder / "trials" / "mirroredexactgamma" / "end.vtu").write_bytes(b"<VTKFile>")
        self.assertEqual(self.names(self.states().absent["exact"]), ["beta", "gamma"])

    def test_without_any_end_state_the_page_says_so(self):
        html = page(read_matrix(self.folder), self.folder)
        self.assertNotIn("<img", html)
        self.assertIn("No end state: alpha (pass), beta (pass), gamma (degraded).", Page(html).text)

    def ends_of_eight(self, positions):
        """One variant with eight integrators; the k-th ends at positions(k)."""
        self.content = matrix(integrators=[f"i{k}" for k in range(8)], variants=["exact"])
        self.content["trials"] = [{**self.content["trials"][0], "integrator": f"i{k}", "folder": f"trials/{k}"}
                                  for k in range(8)]
        write_matrix(self.folder, self.content)
        for k, trial in enumerate(self.content["trials"]):
            write_end_state(self.folder, trial, positions(k))

    def test_bodies_that_only_turned_share_a_picture(self):
        def turned(k):
            c, s = np.cos(k), np.sin(k)
            return POINTS @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        self.ends_of_eight(turned)
        states = self.states()
        self.assertIs(states.place, turned_back)
        self.assertEqual([len(c.trials) for c in states.clusters["exact"]], [8])

    def test_more_than_five_states_are_counted(self):
        self.ends_of_eight(lambda k: (1 + 0.1 * k) * POINTS)
        html = page(read_matrix(self.folder), self.folder)
        self.assertEqual(html.count('src="data:image/png'), 5)
        self.assertIn("3 more end states: i5; i6; i7.", Page(html).text)


if __name__ == "__main__":
    unittest.main()
