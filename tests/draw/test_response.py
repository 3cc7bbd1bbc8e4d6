"""Drawing the response of a harmonic analysis, and spectra of probes."""
import unittest
from pathlib import Path

import numpy as np

from folder_test import InAFolder

from draw.spectrum import amplitude_spectrum  # noqa: E402

HEADER = "frequency [Hz],tip.velocity.x [m/s],tip.velocity.x.phase [deg],tip.velocity.z [m/s],tip.velocity.z.phase [deg]\n"


class Drawn(InAFolder):
    def draws(self, *arguments):
        """The paths of the pictures."""
        code, out, err = self.run_draw(*arguments)
        self.assertEqual((code, err), (0, []))
        return [Path(line) for line in out]


class Response(Drawn):
    def setUp(self):
        super().setUp()
        self.result = self.folder / "r"
        self.result.mkdir()
        (self.result / "run.json").write_text('{"analysis": "harmonic"}')

    def test_is_drawn_with_the_natural_frequencies(self):
        (self.result / "response.csv").write_text(HEADER + "10,1,0,2,90\n20,3,-90,1,0\n200,1,180,1,0\n")
        (self.result / "modes.csv").write_text("mode,frequency [Hz],damping_ratio,mesh_error\n1,15,0.01,0\n2,900,0.01,0\n")
        picture, = self.draws("response", self.result)
        self.assertGreater(picture.stat().st_size, 10000)

    def test_of_one_frequency_is_drawn(self):
        (self.result / "response.csv").write_text(HEADER + "10,1,0,2,90\n")
        self.draws("response", self.result)

    def test_failures_name_the_file_or_the_command(self):
        self.fails_with("response.csv: missing", "response", self.result)
        (self.result / "response.csv").write_text(HEADER + "10,0,0,0,0\n20,0,0,0,0\n")
        self.fails_with("tip.velocity: the amplitude is zero", "response", self.result)
        self.fails_with("draw response", "energy", self.result)


class Spectrum(Drawn):
    def test_a_sine_has_its_amplitude_at_its_frequency(self):
        times = np.arange(1000) / 1000
        frequencies, amplitudes = amplitude_spectrum(times, 5 + 3 * np.sin(2 * np.pi * 100 * times))
        peak = amplitudes.argmax()
        self.assertAlmostEqual(frequencies[peak], 100, delta=0.01)
        self.assertAlmostEqual(amplitudes[peak], 3, delta=0.01)
        self.assertLess(amplitudes[frequencies < 80].max(), 1e-3)

    def test_is_drawn_from_even_rows_only(self):
        result = self.folder / "r"
        result.mkdir()
        header = "t [s],tip.displacement.x [m],tip.displacement.y [m]\n"
        (result / "probes.csv").write_text(header + "".join(f"{0.1 * k},{k % 2},0\n" for k in range(20)))
        self.draws("spectrum", result)
        (result / "probes.csv").write_text(header + "".join(f"{0.1 * k ** 2},{k % 2},0\n" for k in range(20)))
        self.fails_with("rows at equal intervals", "spectrum", result)
        (result / "probes.csv").write_text(header + "0,0,0\n1,1,0\n")
        self.fails_with("too few for a spectrum", "spectrum", result)


if __name__ == "__main__":
    unittest.main()
