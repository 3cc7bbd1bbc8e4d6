"""The model of a scene as an object: derivatives, modes, a user-defined integrator."""
import sys
import unittest
import warnings
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
import scipy.sparse.linalg  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402

import orthodyn  # noqa: E402
from short_scene import beam  # noqa: E402


class AModel(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", orthodyn.OrthodynWarning)
        self.scene = orthodyn.Scene(beam())
        self.model = self.scene.model()
        self.random = np.random.default_rng(3)

    def state(self):
        return 0.01 * self.random.normal(size=self.model.n), 0.1 * self.random.normal(size=self.model.n)

    def test_has_the_derivatives_of_its_force_to_second_order(self):
        q, v = self.state()[0], np.zeros(self.model.n)  # K omits the dependence of damping on q
        K, D = self.model.tangent(0.1, q, v)
        for matrix, place in ((K, 0), (D, 1)):
            direction = self.random.normal(size=self.model.n)
            errors = []
            for h in (1e-3, 5e-4):
                ends = []
                for side in (1, -1):
                    at = [q.copy(), v.copy()]
                    at[place] += side * h * 0.01 * direction
                    ends.append(self.model.force(0.1, *at))
                errors.append(np.linalg.norm((ends[0] - ends[1]) / (0.02 * h) + matrix @ direction))
            # The force is linear in v: its difference quotient is exact.
            if place == 0:
                self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 2, delta=0.1)
            else:
                self.assertLess(errors[0], 1e-8 * np.linalg.norm(matrix @ direction))

    def test_tells_the_mass_of_the_body_that_is_free(self):
        total = self.model.mass.diagonal()[self.model.unknowns[:, 0][self.model.unknowns[:, 0] >= 0]].sum()
        self.assertLess(total, 5.0)  # 500 kg/m^3 times 0.01 m^3
        self.assertGreater(total, 4.5)
        x = self.random.normal(size=self.model.n)
        np.testing.assert_allclose(self.model.mass @ self.model.solve_mass(x), x, rtol=1e-13)

    def test_shows_frequencies_with_the_digits_that_the_mesh_lets_be_known(self):
        """Errors of 25 %, 2 % and 0; a rigid mode."""
        modes = orthodyn.Modes(np.array([0.0, 146.5551, 287.063, 1234.56]), np.zeros((4, 1)), np.array([0, 0.2515, 0.02, 0.0]))
        self.assertEqual(repr(modes), "Modes([0 150 287 1234.6] Hz, mesh errors [0 25 2.0 0] %)")
        many = orthodyn.Modes(np.arange(100.0), np.zeros((100, 1)), np.zeros(100))
        self.assertEqual(repr(many), "Modes([0 1 2 ... 97 98 99] Hz, mesh errors [0 0 0 ... 0 0 0] %)")

    def test_has_the_modes_that_scipy_finds(self):
        K, _ = self.model.tangent(0, np.zeros(self.model.n))
        found = self.model.modes(6)
        expected = scipy.sparse.linalg.eigsh(K, 6, self.model.mass, sigma=0, return_eigenvectors=False)
        np.testing.assert_allclose((2 * np.pi * found.frequencies) ** 2, np.sort(expected), rtol=1e-8)
        np.testing.assert_allclose(found.shapes @ (self.model.mass @ found.shapes.T), np.eye(6), atol=1e-10)

    def test_has_the_derivatives_of_modes(self):
        """Frequencies and shapes of unit modal mass are proportional to 1 / sqrt(density)."""
        path, density = "materials.wood.density", beam()["materials"]["wood"]["density"]
        found = self.model.modes(3, sensitivities=[path], shape_sensitivities=True)
        np.testing.assert_allclose(found.frequency_sensitivities[path], -found.frequencies / (2 * density), rtol=1e-6)
        np.testing.assert_allclose(found.shape_sensitivities[path], -found.shapes / (2 * density), rtol=0,
                                   atol=1e-6 * np.abs(found.shapes).max() / density)
        self.assertEqual(self.model.modes(3, sensitivities=path).shape_sensitivities, {})
        for wrong in ({"sensitivities": [path], "about_equilibrium": True}, {"shape_sensitivities": True}):
            with self.assertRaisesRegex(ValueError, "sensitivities: "):
                self.model.modes(3, **wrong)
        with self.assertRaisesRegex(orthodyn.ConfigError, "no key 'densty'"):
            self.model.modes(3, sensitivities=[path.replace("density", "densty")])

    def test_has_gradients_by_many_numbers(self):
        """Displacements of a linear motion are proportional to gravity."""
        scene = orthodyn.Scene(beam(elasticity={"kinematics": "linear"}, regions={
            "all": {"material": "wood", "stiffness_factors": {"grid": [3, 1, 1], "values": [1, 0.8, 1.2]}}}))
        factors = "regions.all.stiffness_factors"
        value, slopes = scene.model().gradient("tip.displacement.z", ["gravity.2", factors])
        self.assertLess(value, -0.01)
        self.assertEqual(list(slopes), ["gravity.2"] + [f"{factors}.values.{k}" for k in range(3)])
        self.assertAlmostEqual(-9.81 * slopes["gravity.2"] / value, 1, delta=1e-3)
        self.assertGreater(slopes[f"{factors}.values.0"], 10 * abs(slopes[f"{factors}.values.2"]))
        with self.assertRaisesRegex(orthodyn.ConfigError, "no such probe or gauge; it has tip"):
            scene.model().gradient("top.displacement.z", factors)

    def test_is_in_equilibrium_where_it_says(self):
        q = self.model.equilibrium()
        weight = np.linalg.norm(self.model.force(0.2, np.zeros(self.model.n)))
        self.assertLess(np.linalg.norm(self.model.force(0.2, q)), 1e-8 * weight)
        self.assertGreater(np.abs(q).max(), 1e-3)

    def test_puts_coordinates_on_nodes(self):
        q, _ = self.state()
        nodal = self.model.nodal(q)
        held = self.model.points[:, 0] == 0
        self.assertTrue((nodal[held] == 0).all() and (nodal[~held] != 0).all())
        np.testing.assert_array_equal(nodal, self.model.evaluate("displacement", 0, q))

    def test_evaluates_what_it_lists(self):
        q, v = self.state()
        self.assertIn("energy.elastic", self.model.outputs)
        kinetic = self.model.evaluate("energy.kinetic", 0, q, v)
        np.testing.assert_allclose(kinetic, [0.5 * v @ (self.model.mass @ v)], rtol=1e-12)
        with self.assertRaisesRegex(KeyError, "energy.elatsic'; did you mean 'energy.elastic'. There are .*energy.kinetic"):
            self.model.evaluate("energy.elatsic", 0, q)

    def test_refuses_vectors_of_another_length(self):
        for call in (lambda: self.model.force(0, np.zeros(3)), lambda: self.model.nodal(np.zeros(3)),
                     lambda: self.model.tangent(0, self.model.points)):
            with self.assertRaisesRegex(ValueError, rf"q: has the shape \(.*\), expected \({self.model.n},\)"):
                call()
        with self.assertRaisesRegex(TypeError, "q: expected real numbers"):
            self.model.force(0, np.zeros(self.model.n, complex))
        with self.assertRaisesRegex(ValueError, "count: -1"):
            self.model.modes(-1)

    def test_is_integrated_by_a_method_of_ones_own(self):
        """Symplectic Euler in ten lines; its error decreases with the step."""
        end = 0.05
        reference = self.scene.set("time.end", end).set("output.frames", 1).set(
            "integrator", {"type": "arkode_dirk", "rtol": 1e-9}).run()
        errors = []
        for steps in (400, 800):
            h, (t, q, v) = end / steps, self.model.initial
            for _ in range(steps):
                v = v + h * self.model.acceleration(t, q, v)
                q, t = q + h * v, t + h
            errors.append(np.abs(self.model.nodal(q) - reference.displacement[-1]).max())
        self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 1, delta=0.15)
        self.assertLess(errors[1], 0.02 * np.abs(reference.displacement[-1]).max())

    def test_moves_as_scipy_has_it(self):
        end, n = 0.05, self.model.n
        found = solve_ivp(lambda t, y: np.concatenate([y[n:], self.model.acceleration(t, y[:n], y[n:])]), (0, end),
                          np.zeros(2 * n), method="DOP853", rtol=1e-9, atol=1e-12)
        ours = self.scene.set("time.end", end).set("output.frames", 1).set("integrator", {"type": "arkode_dirk", "rtol": 1e-9}).run()
        moved = self.model.nodal(found.y[:n, -1])
        self.assertLess(np.abs(moved - ours.displacement[-1]).max(), 1e-6 * np.abs(moved).max())


if __name__ == "__main__":
    unittest.main()
