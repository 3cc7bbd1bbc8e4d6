"""User-defined models: integrators on Python functions, against scipy and exact solutions."""
import gc
import sys
import unittest
import weakref
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
import scipy.sparse  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402

import orthodyn  # noqa: E402
from orthodyn import _core  # noqa: E402


def pendulum(t, q, v):
    return -9.81 * np.sin(q)


# Methods for models of any kind, with options that make them comparable.
METHODS = {"cvode_bdf": {}, "cvode_adams": {}, "ida_bdf": {}, "arkode_dirk": {}, "arkode_erk": {}, "tr_bdf2": {}, "sdirk": {},
           "bathe": {}, "newmark": {}, "hht_alpha": {}, "generalized_alpha": {}, "rosenbrock": {}, "backward_euler": {},
           "auto": {}}


STIFFNESS = np.array([[2.0, -1.0], [-1.0, 2.0]])  # frequencies 1 and sqrt(3)
EXACT = 0.5 * np.array([np.cos(1) + np.cos(np.sqrt(3)), np.cos(1) - np.cos(np.sqrt(3))])  # at t = 1, from (1, 0)


class AProblem(unittest.TestCase):
    def test_has_the_solution_that_scipy_finds_with_every_adaptive_method(self):
        times = np.linspace(0.5, 3, 6)
        expected = solve_ivp(lambda t, y: [y[1], -9.81 * np.sin(y[0])], (0, 3), [1, 0], rtol=1e-11, atol=1e-12, t_eval=times).y
        for method, options in METHODS.items():
            with self.subTest(method):
                errors = []
                for rtol in (1e-4, 1e-6):
                    found = orthodyn.Problem([1.0], pendulum).solve((0, 3), [1.0], integrator=method, rtol=rtol, times=times,
                                                                     **options)
                    errors.append(np.abs(found.q[1:, 0] - expected[0]).max())
                self.assertLess(errors[1], 0.25 if method == "backward_euler" else 2e-3)
                self.assertLess(errors[1], 0.5 * errors[0])

    def test_is_solved_by_what_suits_it_where_nothing_is_said(self):
        for matrix in ({}, {"stiffness": [[100.0]], "symmetric": True, "linear": True}):
            found = orthodyn.Problem([1.0], lambda t, q, v: -100 * q, **matrix).solve((0, 10), [1.0], rtol=1e-4)  # 16 periods
            self.assertIn("because", found.decisions)
            self.assertLess(np.abs(found.q[:, 0] - np.cos(10 * found.t)).max(), 20e-4)

    def test_whose_matrices_lack_what_its_force_has_is_solved_by_its_force(self):
        problem = orthodyn.Problem([1.0], lambda t, q, v: -q - 0.2 * v, [[1.0]], symmetric=True, linear=True)
        found = problem.solve((0, 200), [1.0], rtol=1e-6)
        self.assertLess(abs(found.q[-1, 0]), 1e-3)  # exp(-20) of the start

    def test_with_a_force_that_raises_where_auto_looks_raises_it(self):
        def force(t, q, v):
            if not q.any():
                raise KeyError("rest")
            return -q
        with self.assertRaises(KeyError):
            orthodyn.Problem([1.0], force, [[1.0]], symmetric=True, linear=True).solve((0, 1), [1.0])

    def test_with_a_fixed_step_has_the_order_of_its_method(self):
        exact = np.cos(2.0)
        problem = orthodyn.Problem([1.0], lambda t, q, v: -q, [[1.0]], symmetric=True, linear=True)
        for method, order in (("newmark", 2), ("central_differences", 2), ("backward_euler", 1), ("semi_implicit_euler", 1)):
            errors = [abs(problem.solve((0, 2), [1.0], integrator=method, step=h, times=1).q[-1, 0] - exact)
                      for h in (0.02, 0.01)]
            self.assertAlmostEqual(np.log2(errors[0] / errors[1]), order, delta=0.25, msg=method)

    def test_takes_matrices_dense_or_sparse_symmetric_or_not(self):
        n, k = 20, 40.0
        stiffness = k * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
        start = np.sin(np.pi * np.arange(1, n + 1) / (n + 1))
        omega = 2 * np.sqrt(k) * np.sin(np.pi / (2 * (n + 1)))
        for matrix in (stiffness, scipy.sparse.csr_matrix(stiffness), lambda t, q, v: stiffness):
            for symmetric in (False, True):
                problem = orthodyn.Problem(np.ones(n), lambda t, q, v: -stiffness @ q, matrix, symmetric=symmetric)
                found = problem.solve((0, 2 * np.pi / omega), start, integrator="arkode_dirk", rtol=1e-7, times=4)
                np.testing.assert_allclose(found.q[-1], start, atol=1e-5)
                np.testing.assert_allclose(found.q[2], -start, atol=1e-5)

    def test_with_damping_is_that_of_the_damped_oscillator(self):
        c, t = 0.3, 4.0
        omega = np.sqrt(1 - c * c / 4)
        exact = np.exp(-c * t / 2) * (np.cos(omega * t) + c / (2 * omega) * np.sin(omega * t))
        problem = orthodyn.Problem([1.0], lambda t, q, v: -q - c * v, [[1.0]], [[c]], symmetric=True, linear=True)
        found = problem.solve((0, t), [1.0], integrator="tr_bdf2", rtol=1e-6)
        self.assertAlmostEqual(found.q[-1, 0], exact, delta=1e-4)

    def test_gives_the_states_that_are_asked_for(self):
        found = orthodyn.Problem([1.0], pendulum).solve((1, 2), [0.1], times=[1.25, 1.5])
        np.testing.assert_allclose(found.t, [1, 1.25, 1.5, 2])
        self.assertEqual((found.q.shape, found.v.shape), ((4, 1), (4, 1)))
        self.assertGreater(found.statistics["force"]["count"], 5)

    def test_whose_force_raises_ends_with_that(self):
        def broken(t, q, v):
            if t > 0.5:
                raise KeyError("mine")
            return -q
        for method in ("cvode_bdf", "newmark", "arkode_erk"):
            with self.subTest(method), self.assertRaisesRegex(KeyError, "mine"):
                orthodyn.Problem([1.0], broken).solve((0, 1), [1.0], integrator=method)

    def test_whose_force_asks_for_smaller_steps_gets_them(self):
        refused = []

        def wall(t, q, v):
            if t > 1 and len(refused) < 3:
                refused.append(t)
                raise orthodyn.RecoverableError("not there")
            return -q
        found = orthodyn.Problem([1.0], wall).solve((0, 6), [1.0], integrator="tr_bdf2", rtol=1e-5)
        self.assertEqual(len(refused), 3)
        self.assertAlmostEqual(found.q[-1, 0], np.cos(6), delta=2e-3)

    def test_whose_force_gives_something_else_says_what(self):
        for given, error, at_once, later in (
                ([1, 2, 3], ValueError, "shape \\(3,\\), expected \\(1,\\)", "the force has 3 numbers, expected 1"),
                ("x", TypeError, "not an array of numbers", "the force is not an array of numbers"),
                (None, TypeError, "not an array of numbers", "the force is not an array of numbers")):
            for begin, text in ((0, at_once), (0.5, later)):
                with self.subTest(text), self.assertRaisesRegex(error, text):
                    orthodyn.Problem([1.0], lambda t, q, v: given if t >= begin else -q).solve((0, 1), [1.0])

    def test_tells_what_is_wrong_with_a_tangent_by_the_kind_of_error(self):
        from orthodyn import _core
        for given, error, text in ((None, TypeError, "not a pair"), ((), TypeError, "not a pair"), (1.0, TypeError, "not a pair"),
                                   ((np.ones(1),), TypeError, "not a pair"),
                                   ((None, None), TypeError, "the stiffness is not an array of numbers"),
                                   (("x", None), TypeError, "the stiffness is not an array of numbers"),
                                   ((np.ones(2), None), ValueError, "the stiffness has 2 numbers, expected 1")):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                problem = orthodyn.Problem([1.0], lambda t, q, v: -q)
                problem._core = lambda *_, given=given: _core.PythonModel(
                    np.ones(1), lambda t, q, v: -q, lambda t, q, v: given, [0, 1], [0], True, False, False, False)
                problem.solve((0, 1), [1.0])

    def test_says_what_it_needs(self):
        problem = orthodyn.Problem([1.0], lambda t, q, v: 1 - q)
        for call, text in ((lambda: problem.solve((0, 1), [0.0]), "position_scale and velocity_scale"),
                           (lambda: problem.solve((0, 1), [0.0, 1.0]), r"q0: has the shape \(2,\), expected \(1,\)"),
                           (lambda: problem.solve((0, 1), [np.nan]), "q0: has values that are not finite"),
                           (lambda: problem.solve((1, 0), [1.0]), "start before the end"),
                           (lambda: orthodyn.Problem([[2.0, 1], [1, 2]], pendulum), r"mass: has the shape \(2, 2\)"),
                           (lambda: orthodyn.Problem([1.0], pendulum, np.eye(3)).solve((0, 1), [1.0]), "stiffness: has the shape"),
                           (lambda: problem.solve((0, 1), [1.0], times=[0.5, 0.2]), "ascending"),
                           (lambda: problem.solve((0, 1), [1.0], rtoll=1), "unknown key; did you mean 'rtol'"),
                           (lambda: problem.solve((0, 1), [1.0], integrator="cvode"), "cvode"),
                           (lambda: orthodyn.Problem([1.0, 0.0], pendulum), "positive"),
                           (lambda: orthodyn.Problem([1.0], pendulum, damping=[[1.0]]), "damping without stiffness")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                call()

    def test_that_could_not_go_on_gives_what_it_computed(self):
        with self.assertRaises(orthodyn.RunError) as caught:
            orthodyn.Problem([1.0], pendulum).solve((0, 100), [1.0], integrator="tr_bdf2", max_steps=20, times=10000)
        self.assertGreater(len(caught.exception.result.t), 1)

    def test_thrown_from_the_origin_knows_its_size(self):
        found = orthodyn.Problem([2.0], lambda t, q, v: -8 * q).solve((0, 1), [0.0], [3.0], integrator="arkode_dirk", rtol=1e-7)
        self.assertAlmostEqual(found.q[-1, 0], 1.5 * np.sin(2.0), delta=1e-5)

    def test_without_a_stiffness_takes_every_method_whatever_is_said_of_symmetry(self):
        for method in ("cvode_bdf", "arkode_dirk", "newmark"):
            orthodyn.Problem([1.0], lambda t, q, v: -q, symmetric=True).solve((0, 1), [1.0], integrator=method)

    def test_reads_entries_that_are_zero_at_the_start(self):
        def force(t, q, v):
            return np.array([-q[0] - q[0] * q[1] ** 2, -q[1] - q[1] * q[0] ** 2])

        def stiffness(t, q, v):
            return np.array([[1 + q[1] ** 2, 2 * q[0] * q[1]], [2 * q[0] * q[1], 1 + q[0] ** 2]])
        given = orthodyn.Problem([1.0, 1.0], force, stiffness).solve((0, 10), [1.0, 0.0], [0, 0.5], integrator="rosenbrock", rtol=1e-5)
        found = orthodyn.Problem([1.0, 1.0], force).solve((0, 10), [1.0, 0.0], [0, 0.5], integrator="rosenbrock", rtol=1e-5)
        self.assertLess(abs(given.statistics["steps"] - found.statistics["steps"]), 3)

    def test_is_let_go(self):
        class Force:
            def __call__(self, t, q, v):
                return -q
        force = Force()
        seen = weakref.ref(force)
        orthodyn.Problem([1.0], force).solve((0, 1), [1.0])
        del force
        gc.collect()
        self.assertIsNone(seen())

    def test_takes_every_integrator_or_is_told_what_it_lacks(self):
        linear = orthodyn.Problem([1.0, 1.0], lambda t, q, v: -STIFFNESS @ q, STIFFNESS, symmetric=True, linear=True)
        options = {"modal": {"modes": 2}, "central_differences": {"step": 0.01}, "semi_implicit_euler": {"step": 0.01}}
        refused = {}
        for method in _core.integrators():
            with self.subTest(method):
                try:
                    found = linear.solve((0, 1), [1.0, 0.0], integrator=method, **options.get(method, {"rtol": 1e-5}))
                except ValueError as error:
                    refused[method] = str(error)
                    continue
                self.assertLess(np.abs(found.q[-1] - EXACT).max(), 0.05)
        self.assertEqual(set(refused), {"arkode_imex", "energy_momentum"})
        self.assertIn("parts", refused["arkode_imex"])
        self.assertIn("energy", refused["energy_momentum"])


if __name__ == "__main__":
    unittest.main()
