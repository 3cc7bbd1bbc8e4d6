"""Building blocks of reports: number formats, scales, markup.

Run with  /usr/bin/python3 -m unittest tests/draw/test_report_pieces.py
"""
import math
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.report import measures, scale, theme, formatting  # noqa: E402
from draw.report.markup import Html, data_script, tag  # noqa: E402


class SmallPieces(unittest.TestCase):
    def test_numbers_read_well(self):
        self.assertEqual([formatting.exponent(x) for x in (1e-3, 3.2e-3, 0, math.nan, 9.99e-4)],
                         ["1e-3", "3.2e-3", "0", "–", "1e-3"])
        plain = [formatting.seconds(x).replace(formatting.THIN, " ")
                 for x in (0.24, 1.4, 12.3, 0.0031, 61, 4000, 2e-5, 9e3)]
        self.assertEqual(plain, ["0.24 s", "1.4 s", "12 s", "3.1 ms", "61 s", "67 min", "20 µs", "2.5 h"])
        self.assertEqual([formatting.percent(x).replace(formatting.THIN, " ") for x in (1e-3, 1e-5, 1e-9)],
                         ["0.1 %", "0.001 %", ""])
        self.assertEqual(formatting.power_of_ten(1e-12), "10⁻¹²")
        self.assertEqual(formatting.joined("abc"), "a, b and c")

    def test_ticks_are_few_and_at_least_two(self):
        for low, high in ((1e-8, 1), (0.03, 0.5), (2e-3, 9e-3), (1e-200, 1e200), (0.9, 1.3e3)):
            found = scale.ticks(low, high, 5)
            self.assertTrue(2 <= len(found) <= 8 and low <= found[0] and found[-1] <= high * 1.001, found)

    def test_measures_have_words_and_an_order(self):
        self.assertEqual(measures.label("probes.tip.max"), "probe tip, largest in time")
        keys = ["phase", "velocity.l2", "probes.a.final", "displacement.max", "displacement.l2"]
        self.assertEqual(sorted(keys, key=measures._rank),
                         ["displacement.l2", "displacement.max", "velocity.l2", "probes.a.final", "phase"])

    def test_text_is_escaped_once_and_html_stays(self):
        self.assertEqual(tag("p", "a<b", tag("b", "&"), title='"', hidden=True, id=None),
                         '<p title="&quot;" hidden>a&lt;b<b>&amp;</b></p>')
        self.assertNotIn("</script>", data_script("i", "</script>")[:-9])
        self.assertIsInstance(tag("p"), Html)

    def test_methods_differ_in_colour_or_dashes_and_all_in_marker(self):
        looks = {(theme.colour(k), str(theme.dashes(k))) for k in range(12)}
        self.assertEqual(len(looks), 12)
        self.assertEqual(len({theme.marker(k) for k in range(12)}), 12)

    def test_colours_stand_out_from_the_page_in_both_themes(self):
        def luminance(colour):
            parts = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
            parts = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
            return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]
        for colours in (theme.LIGHT, theme.DARK):
            for name, least in [(f"c{k}", 3.0) for k in range(1, 9)] + [("ink", 7.0), ("muted", 4.5)]:
                light, dark = sorted((luminance(colours[name]), luminance(colours["paper"])), reverse=True)
                self.assertGreater((light + 0.05) / (dark + 0.05), least, name)


if __name__ == "__main__":
    unittest.main()
