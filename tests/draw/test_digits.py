"""Numbers are rounded to their known digits.

Run with  /usr/bin/python3 -m unittest tests/draw/test_digits.py
"""
import math
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "tools")]

from draw.digits import known_digits  # noqa: E402
from draw.report.formatting import UNKNOWN, general  # noqa: E402


class KnownDigits(unittest.TestCase):
    def test_are_those_that_the_error_does_not_touch_and_one_more(self):
        for error, words in ((0.25, "320"), (0.02, "324"), (1e-3, "324.5"), (-1e-3, "324.5"), (5, "320")):
            self.assertEqual(known_digits(324.4871, error), words)
        self.assertEqual(known_digits(146.6, 0.25), "150")
        self.assertEqual(known_digits(1.0, 0.01), "1.00")

    def test_are_as_many_as_are_wanted_at_most(self):
        self.assertEqual(known_digits(324.4871, 1e-9, 4), "324.5")
        for error in (math.nan, math.inf, 0.0):
            self.assertEqual(known_digits(324.4871, error, 5), "324.49")

    def test_of_very_small_and_large_numbers_have_an_exponent(self):
        self.assertEqual([known_digits(x, 0.01) for x in (1.23456e-9, 1.23456e9, 0.0)], ["1.23e-09", "1.23e+09", "0.00"])

    def test_of_what_is_not_known_are_none(self):
        self.assertEqual([general(x, 4, 0.3) for x in (None, math.nan, math.inf)], 3 * [UNKNOWN])


if __name__ == "__main__":
    unittest.main()
