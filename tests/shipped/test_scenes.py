"""Every scene of configs/scenes completes at full length without a warning, because users run these scenes first. EXPECTED lists
the scenes that show a warning on purpose, with the reason. Likewise the fits of configs/fits, which also find the truth.

    ORTHODYN_EXECUTABLE=build/release/orthodyn ORTHODYN_LONG=1 /usr/bin/python3 -m unittest discover -s tests/shipped
"""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

SCENES = Path(__file__).resolve().parents[2] / "configs" / "scenes"
FITS = SCENES.parent / "fits"
PROGRAM = os.environ.get("ORTHODYN_EXECUTABLE", "orthodyn")

# Scene -> beginnings of its warnings.
EXPECTED = {
    "free_flight": ["the mesh is coarse for this motion"],  # shows conservation, which holds on any mesh
    "xylophone_bar": ["the mesh is coarse for this motion"],  # supports at lines and points are softer on finer meshes
}
# Run with ORTHODYN_LONG only: 3 s of CPU and more.
LONG = {"cantilever", "drop", "free_flight", "guitar_top", "laminate", "muscle", "stem", "tube_lrt", "tuning_fork", "twist", "xylophone_bar"}


# Fit -> the true values of its parameters, in the units of fit.json. Nobody knows the true constants of the measured
# plate, glass_epoxy_plate: its entries are typical constants of such plies.
TRUTH = {
    "spruce_plate": {"E1": 11, "E2": 0.9, "G12": 0.75, "nu12": 0.37},
    "off_axis_strip": {"angle": 25, "E1": 40, "E2": 10},
    "muscle_release": {"E1": 60, "damping": 8},
    "soundboard_damping": {"loss of E1": 0.008, "loss of E2": 0.02, "loss of G12": 0.014},
    "wood_five_tests": {"EL": 11.88, "ER": 0.9266, "ET": 0.5108, "nuLR": 0.372, "nuRT": 0.435, "nuLT": 0.467, "GLR": 0.7603,
                        "GRT": 0.03564, "GLT": 0.7247},
    "glass_epoxy_plate": {"E1": 60, "E2": 21, "G12": 10, "nu12": 0.28},
    "knotty_beam": {},
}
LONG_FITS = set(TRUTH) - {"off_axis_strip"}


def warnings_of(scene, folder):
    done = subprocess.run([PROGRAM, "run", str(scene), "--out", str(folder), "--quiet"], capture_output=True, text=True)
    return done.returncode, re.findall(r"^warning: (.*)$", done.stdout + done.stderr, re.MULTILINE), done.stderr


class ShippedScenes(unittest.TestCase):
    def test_each_ends_without_a_warning(self):
        is_long = bool(os.environ.get("ORTHODYN_LONG"))
        for scene in sorted(SCENES.glob("*.yaml")):
            if scene.stem in LONG and not is_long:
                continue
            with self.subTest(scene.stem), tempfile.TemporaryDirectory() as folder:
                code, found, text = warnings_of(scene, Path(folder) / "out")
                self.assertEqual(code, 0, text)
                expected = EXPECTED.get(scene.stem, [])
                self.assertEqual([], [w for w in found if not w.startswith(tuple(expected))])
                for begin in expected:
                    self.assertTrue(any(w.startswith(begin) for w in found), f"no warning '{begin}': take it off the list")

    def test_the_lists_name_scenes(self):
        names = {scene.stem for scene in SCENES.glob("*.yaml")}
        self.assertLessEqual({*EXPECTED, *LONG}, names)


class ShippedFits(unittest.TestCase):
    def test_each_finds_the_truth_without_a_warning(self):
        self.assertEqual(set(TRUTH), {fit.stem for fit in FITS.glob("*.yaml")})
        for name, truth in TRUTH.items():
            if name in LONG_FITS and not os.environ.get("ORTHODYN_LONG"):
                continue
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([PROGRAM, "fit", str(FITS / f"{name}.yaml"), "--out", folder, "--quiet", "--no-report"],
                                      capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                table = json.loads((Path(folder) / "fit.json").read_text(encoding="utf-8"))
                found = {one["name"]: one for one in table["parameters"]}
                for parameter, value in truth.items():
                    one = found[parameter]  # three times the 95 % interval about the value: misses once in 10^8
                    self.assertLess(abs(value - one["value"]), 1.5 * (one["high"] - one["low"]), parameter)
                if name == "knotty_beam":
                    self.check_knot(table["fields"][0])

    def check_knot(self, field):
        """The knot is 180 mm from the left end and 28 mm above the lower edge; the factors are those of cells of 8 x 10 mm."""
        factors, columns = field["factors"], field["grid"][0]
        softest = factors.index(min(factors))
        self.assertLess(abs(8 * (softest % columns + 0.5) - 180), 16)
        self.assertLess(abs(10 * (softest // columns + 0.5) - 28), 11)
        self.assertLess(min(factors), 0.7)
        far = [f for k, f in enumerate(factors) if abs(8 * (k % columns + 0.5) - 180) > 60]
        self.assertLess(max(abs(f - 1) for f in far), 0.25)


if __name__ == "__main__":
    unittest.main()
