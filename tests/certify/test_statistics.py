"""Errors and bands of numbers whose limits are known, and what else of tunica-certify needs no run:
test_statistics.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import os
import subprocess
import sys
import tempfile
import types
import unittest

import h5py
import numpy as np

from certify import case, meshes, options, plan, quantities, richardson, rounding
from certify.richardson import ASSUMED, EXACT, MISSING, NO_ORDER, OBSERVED, Theory, estimate
from vessel.errors import BadInput
from vessel.mesh_file import Mesh

ROOT, PROGRAMS = sys.argv[1:3]
SECOND, FIRST = Theory(2, 1), Theory(1, 0.75)
LIMIT = 3.0


def numbers(sizes, order, factor=0.4, more=0.0):
    """f(h) = LIMIT + factor h^order + more h^(order + 1)."""
    h = np.array(sizes)
    return LIMIT + factor * h ** order + more * h ** (order + 1)


class Orders(unittest.TestCase):
    def test_three_sizes_show_their_order_and_limit(self):
        for sizes in ([1, 0.5, 0.25], [1.7, 1, 0.5], [2.2, 1.5, 1]):
            for order, theory in ((2, SECOND), (1, FIRST), (1.5, SECOND)):
                part = estimate(sizes, numbers(sizes, order), theory)
                self.assertEqual(part.how, OBSERVED)
                self.assertAlmostEqual(part.order, order, places=6)
                self.assertAlmostEqual(part.error, 0.4, places=9)
                self.assertGreaterEqual(part.band, 0.4)
                self.assertLess(part.band, 3 * 0.4)

    def test_two_sizes_hold_all_orders_from_the_least_one_on(self):
        for theory in (SECOND, FIRST):
            for order in np.linspace(theory.least, theory.order, 9):
                for sizes in ([1, 0.5], [2, 1]):
                    part = estimate(sizes, numbers(sizes, order, -0.4), theory)
                    self.assertEqual(part.how, ASSUMED)
                    self.assertGreaterEqual(part.band, 0.4 * (1 - 1e-12))
                    self.assertLess(part.band, 3.01 * 0.4)
        self.assertAlmostEqual(estimate([1, 0.5], numbers([1, 0.5], 2), SECOND).error, 0.4)

    def test_numbers_without_order_say_so(self):
        for values in ([1.1, 0.9, 1.0], [1.0, 1.1, 1.3], [1.1, 1.0, 0.9999]):
            part = estimate([1, 0.5, 0.25], values, SECOND)
            self.assertEqual(part.how, NO_ORDER)
            self.assertEqual(part.text(), "no order")
            self.assertAlmostEqual(part.error, values[0] - values[-1])
            self.assertGreaterEqual(part.band, np.ptp(values))
        self.assertEqual(estimate([1, 0.5], [1.1, 1.0], None).how, NO_ORDER)

    def test_differences_within_noise_have_no_order(self):
        self.assertEqual(estimate([1, 0.5, 0.25], [1.04, 1.01, 1.0025], SECOND, noise=0.02).how, NO_ORDER)
        self.assertEqual(estimate([1, 0.5], [1.0, 1.0 + 1e-15], SECOND, noise=1e-12).how, EXACT)
        self.assertEqual(estimate([1], [1.0], SECOND).how, MISSING)
        self.assertEqual(estimate([1, 0.5], [1.0, float("nan")], SECOND).how, MISSING)

    def test_four_sizes_are_fitted(self):
        sizes = [2, 1, 0.5, 0.25]
        noise = 1e-3 * np.array([1, -1, 1, -1])
        part = estimate(sizes, numbers(sizes, 2) + noise, SECOND)
        self.assertEqual(part.how, OBSERVED)
        self.assertAlmostEqual(part.order, 2, delta=0.1)
        self.assertAlmostEqual(part.error, 0.4, delta=0.01)
        self.assertGreaterEqual(part.band, 0.399)

    def test_bands_hold_nearly_all_of_many_and_are_narrow(self):
        random = np.random.default_rng(7)
        for sizes, most in (([1, 0.5], 3), ([1, 0.5, 0.25], 5)):
            held, ratios = 0, []
            for _ in range(1000):
                order, sign = random.uniform(1.2, 2.2), random.choice([-1, 1])
                values = numbers(sizes, order, 0.4 * sign, random.uniform(-0.1, 0.1)) + 0.002 * random.standard_normal(len(sizes))
                part, error = estimate(sizes, values, SECOND), values[0] - LIMIT
                held += part.band >= abs(error)
                ratios.append(part.band / abs(error))
            self.assertGreater(held, 950, sizes)
            self.assertLess(np.quantile(ratios, 0.99), most, sizes)

    def test_parts_add_up(self):
        parts = {"mesh": richardson.Part(0.3, 0.5), "step": richardson.Part(-0.1, 0.2), "solver": richardson.missing()}
        budget = richardson.Budget(2.0, parts)
        self.assertAlmostEqual(budget.band(), 0.7)
        self.assertAlmostEqual(budget.extrapolated(), 1.8)
        self.assertEqual(budget.lacks(), ["solver"])


class CurvesTest(unittest.TestCase):
    t = np.linspace(0, 10, 201)

    def test_order_is_that_of_the_curve_where_single_times_have_none(self):
        curves = [np.sin(self.t) + h ** 2 * 0.1 * np.cos(self.t) + h ** 3 * 0.02 for h in (1, 0.5, 0.25)]
        error, band, part = richardson.of_curves([1, 0.5, 0.25], curves, SECOND)
        self.assertAlmostEqual(part.order, 2, delta=0.15)
        true = curves[0] - np.sin(self.t)
        np.testing.assert_allclose(error, true, atol=0.006)
        self.assertTrue((richardson.around(band) >= abs(true)).all())
        self.assertLess(richardson.around(band).max(), 1.5 * abs(true).max())

    def test_unlike_differences_have_no_order(self):
        curves = [np.sin(self.t), np.sin(self.t) + 0.1 * np.cos(self.t), np.sin(self.t) + 0.1 * np.sin(3 * self.t)]
        self.assertEqual(richardson.of_curves([1, 0.5, 0.25], curves, SECOND)[2].how, NO_ORDER)

    def run_of(self, step, f):
        times = np.arange(1, round(10 / step) + 1) * step
        curves = quantities.Curves.__new__(quantities.Curves)
        curves.times, curves.columns = times, {"f": f(times)}
        return curves

    def test_smooth_peaks_between_steps_are_found_and_kinks_not_overshot(self):
        smooth, kink = lambda t: np.sin(t - 0.33), lambda t: -abs(t - 2.0)  # noqa: E731
        for f, greatest, precision in ((smooth, 1.0, 2e-4), (kink, 0.0, 1e-12)):
            coarse, fine = self.run_of(0.5, f), self.run_of(0.25, f)
            seen = coarse.columns["f"].max()
            missed = quantities.between_steps(quantities.GREATEST, fine, "f", coarse.times, None)
            self.assertAlmostEqual(seen + missed, greatest, delta=precision)

    def test_quantities_suit_the_curve(self):
        t = np.arange(1.0, 41.0)
        chosen = lambda name, values, period=None: quantities.wanted(name, t, values, period, 1.0)  # noqa: E731
        self.assertEqual(chosen("inflow_a_mm3_per_ms", np.sin(t), 20.0), ["last", "greatest", "least", "mean"])
        self.assertEqual(chosen("volume", t), ["last"])
        self.assertEqual(chosen("fluid_pressure_max_kPa", np.sin(t / 10)), ["last", "greatest"])
        self.assertEqual(chosen("area_mm2", np.ones(40), 20.0), ["last"])

    def test_values_at_other_times_are_those_of_a_parabola(self):
        one = self.run_of(0.5, lambda t: 1 + t - 0.3 * t * t)
        at = np.array([0.7, 3.0, 9.9])
        np.testing.assert_allclose(one.at("f", at), 1 + at - 0.3 * at * at, atol=1e-12)


class Meshes(unittest.TestCase):
    def test_cylinders_are_told_from_other_shapes(self):
        tube = meshes.Surfaces(Mesh(os.path.join(ROOT, "meshes", "tube-tiny.h5")))
        self.assertEqual(set(tube.cylinders), {"interface", "outer", "layer"})
        self.assertEqual(set(tube.flat), {"inlet", "outlet", "struct_in", "struct_out"})
        fork = meshes.Surfaces(Mesh(os.path.join(ROOT, "meshes", "bifurcation.h5")))
        self.assertEqual(fork.cylinders, [])
        self.assertIn("interface", fork.others)

    def test_smooth_surfaces_are_rounded(self):
        """A tube along x, of which nobody says that it is a cylinder; and its ends stay in their planes."""
        with tempfile.TemporaryDirectory() as where:
            coarse, fine = os.path.join(where, "coarse.h5"), os.path.join(where, "fine.h5")
            tool = os.path.join(PROGRAMS, "tunica-mesh")
            subprocess.run([tool, "tube", coarse, "--around", "16", "--axial", "8", "--length", "4"], check=True, stdout=subprocess.DEVNULL)
            with h5py.File(coarse, "r+") as file:
                file["vertices"][:] = file["vertices"][:][:, [2, 0, 1]]
            subprocess.run([tool, "refine", coarse, fine], check=True, stdout=subprocess.DEVNULL)
            off = lambda mesh, name, radius: abs(  # noqa: E731
                np.hypot(*mesh.vertices[np.unique(mesh.triangles_of(name))][:, 1:].T) - radius).max()
            names = ["interface", "outer", "layer"]
            facets = off(Mesh(fine), "interface", 1.43)
            self.assertEqual(rounding.rounded(coarse, fine, names, ["inlet", "outlet", "struct_in", "struct_out"]), 0)
            mesh = Mesh(fine)
            self.assertLess(off(mesh, "interface", 1.43), 0.12 * facets)
            self.assertLess(off(mesh, "outer", 1.82), 0.15 * facets)
            self.assertLess(abs(mesh.vertices[np.unique(mesh.triangles_of("inlet"))][:, 0]).max(), 1e-12)
            self.assertGreater(mesh.volume(mesh.tets).min(), 0)

    def test_creases_stay(self):
        mesh = Mesh(os.path.join(ROOT, "meshes", "block.h5"))
        corners = rounding.Patch(mesh, mesh.triangles)
        self.assertTrue(corners.creases.any())
        self.assertLess(abs(corners.moves()).max(), 1e-9)

    def test_sizes_follow_from_the_numbers_of_tetrahedra(self):
        path = os.path.join(ROOT, "meshes", "{}.h5")
        ratio = meshes.relative_size(path.format("tube-tiny"), path.format("tube-coarse"))
        self.assertTrue(1.2 < ratio < 3, ratio)
        with self.assertRaisesRegex(BadInput, 'lacks the region "adventitia"'):
            meshes.check_same_names(path.format("block"), path.format("tube-tiny"))


def planned(**given):
    case = types.SimpleNamespace(control="fixed", steps=lambda: 100, varies_in_time=lambda: True, output_at_end=lambda: [],
                                 with_tolerances=lambda factor: [f"x={factor}"], finer_step=lambda factor: [f"n={factor}"])
    wanted = {"ranks": 1, "cores": 1, "levels": None, "steps": None, "coarser": None, "finer": None, "smooth": None, "budget": None, **given}
    return plan.Plan(case, types.SimpleNamespace(**wanted), os.path.join(ROOT, "meshes", "tube-tiny.h5"), "never-made")


class Plans(unittest.TestCase):
    def names(self, **given):
        return [job.name for job in planned(**given).choose()]

    def test_runs_are_those_asked_for(self):
        self.assertEqual(self.names(), ["case", "solver", "step-2", "mesh-2", "step-4"])
        self.assertEqual(self.names(levels=3, steps=1), ["case", "solver", "mesh-2", "mesh-4"])
        self.assertEqual(self.names(levels=1, steps=2), ["case", "solver", "step-2"])

    def test_meshes_of_the_user_take_the_place_of_refined_ones(self):
        finer = os.path.join(ROOT, "meshes", "tube-coarse.h5")
        found = [(job.name[:10], job.size < 1) for job in planned(finer=finer, steps=1).choose()]
        self.assertEqual(found, [("case", False), ("solver", True), ("mesh-finer", True)])
        with self.assertRaisesRegex(BadInput, "--coarser .*expected at least 1.2"):
            planned(coarser=finer)

    def test_budget_chooses_what_fits_and_says_what_does_not(self):
        hours = planned().case_seconds / 3600
        one = planned(budget=5 * hours)
        self.assertEqual([job.name for job in one.choose()], ["case", "solver", "step-2"])
        self.assertTrue(any(remark.startswith("mesh-2") for remark in one.remarks), one.remarks)
        self.assertTrue(any("--coarser" in remark for remark in one.remarks), one.remarks)
        self.assertEqual(self.names(budget=1000 * hours)[-1], "mesh-4")
        self.assertEqual(self.names(budget=1e-9), ["case"])

    def test_several_cores_need_less_time(self):
        self.assertLess(planned(cores=4).duration(planned(cores=4).choose()), planned().duration(planned().choose()))


class Tolerances(unittest.TestCase):
    def test_a_tenth_is_less_and_never_more(self):
        for path, value, factor, expected in (("Fluid/Newton/absolute increment", 1e-18, 0.1, 1e-19), ("Coupling/tolerance", 1e-8, 0.1, 1e-9),
                                              ("Fluid/Newton/linear tolerance", 5e-14, 0.1, 1e-14),
                                              ("Fluid/Newton/linear tolerance", 1e-15, 0.1, 1e-15),
                                              ("Coupling/Newton/linear tolerance", 0.1, 10, 0.5)):
            self.assertAlmostEqual(case.scaled(path, value, factor) / expected, 1, msg=path)


class Beats(unittest.TestCase):
    def test_what_is_left_of_a_transient_is_summed(self):
        part = richardson.settling([2.0 + 0.3 * 0.5 ** k for k in range(3)])
        self.assertAlmostEqual(part.error, 0.3 * 0.25)
        self.assertGreaterEqual(part.band, 0.3 * 0.25)
        self.assertEqual(richardson.settling([1.0, 1.1]).how, NO_ORDER)
        self.assertEqual(richardson.settling([1.0, 1.1, 1.3]).how, NO_ORDER)
        self.assertEqual(richardson.settling([1.0]).how, MISSING)


class Options(unittest.TestCase):
    def test_bad_options_are_refused_with_the_nearest_name(self):
        case = os.path.join(ROOT, "xml", "pulse-tiny.xml")
        for text, words in (('Did you mean "--budget"', ["--budgte", "2"]), ("expected more than 0", ["--budget", "0"]),
                            ("at most --cores", ["--cores", "2", "--ranks", "3"]), ("there is no such file", ["--coarser", "none.h5"]),
                            ("List/key=value", ["--set", "viscosity"])):
            with self.assertRaisesRegex(BadInput, text):
                options.read("about", [case, *words])
        with self.assertRaisesRegex(BadInput, "never.xml: there is no such file"):
            options.read("about", ["never.xml"])


if __name__ == "__main__":
    unittest.main(argv=["test_statistics"])
