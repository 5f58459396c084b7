"""Cuts, centrelines and cycles of tunica-report in closed form: test_geometry.py PROGRAM"""
import os
import sys
import unittest

import numpy as np

from synthetic_run import AROUND, INNER, LENGTH, tube

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[1])))  # as the program does
from report import centreline, wall_stress  # noqa: E402
from report.case_tables import changes_per_cycle  # noqa: E402
from report.curve_figures import inflows  # noqa: E402
from report.section import Section, apart_by_region, nodal_means  # noqa: E402
from report.section_figures import painted  # noqa: E402
from report.space import kept_half  # noqa: E402
from report.surfaces import Surface, area_vectors, boundary, pieces  # noqa: E402

RADIUS = 30.0  # of the bend


def height(x):
    """Of the tube's polygon at x, from its corners on one side."""
    corners = np.pi * np.arange(AROUND // 2 + 1) / (AROUND // 2)
    return np.interp(-x, -INNER * np.cos(corners), INNER * np.sin(corners))


def caps(points, tets, z):
    """Surfaces at both ends; z: of the straight tube."""
    faces, _ = boundary(points, tets)
    return [Surface(points, faces[(abs(z[faces] - end) < 1e-9).all(axis=1)]) for end in (0.0, LENGTH)]


class Cut(unittest.TestCase):
    def setUp(self):
        self.points, self.tets = tube([1.7, 3.4, INNER], True)

    def test_area_is_that_of_the_cut_prism(self):
        for plane in (0.0, 1.3, -2.7, 4.9):
            cut = Section(self.points, self.tets, plane, 0 * self.points)
            self.assertAlmostEqual(cut.area() / (2 * height(plane) * LENGTH), 1.0, places=9)

    def test_round_off_leaves_no_slivers(self):
        exact = Section(self.points, self.tets, 0.0, 0 * self.points)
        noise = 1e-10 * np.random.default_rng(1).standard_normal(self.points.shape)
        rough = Section(self.points + noise, self.tets, 0.0, 0 * self.points)
        self.assertEqual(len(rough.triangles), len(exact.triangles))
        self.assertAlmostEqual(rough.area(), 2 * INNER * LENGTH, places=6)
        self.assertAlmostEqual(np.linalg.norm(np.diff(rough.outline(), axis=1), axis=2).sum(), 2 * (2 * INNER + LENGTH),
                               places=6)

    def test_cut_along_the_boundary_is_the_boundary(self):
        half = self.tets[(self.points[self.tets, 0] > -1e-9).all(axis=1)]
        cut = Section(self.points, half, 0.0, 0 * self.points)
        self.assertAlmostEqual(cut.area() / (2 * INNER * LENGTH), 1.0, places=9)

    def test_image_has_the_values_of_the_triangles(self):
        x, y = np.array([0.0, 4.0, 4.0, 0.0]), np.array([0.0, 0.0, 2.0, 2.0])
        image, extent = painted(x, y, np.array([[0, 1, 2], [0, 2, 3]]), 3 * x + y, pixels=400)
        place = np.linspace(extent[0], extent[1], image.shape[1], endpoint=False) + 0.005
        inside = ~np.isnan(image)
        self.assertGreater(inside[:-1, :-1].mean(), 0.99)
        row = np.linspace(extent[2], extent[3], image.shape[0], endpoint=False) + 0.005
        expected = 3 * place[None, :] + row[:, None]
        self.assertLess(abs(image - expected)[inside].max(), 1e-9)

    def test_half_of_a_surface_has_half_of_its_area(self):
        faces, _ = boundary(self.points, self.tets)
        triangles, edges, weight = kept_half(self.points[:, 0], faces)
        corners = (1 - weight)[:, None] * self.points[edges[:, 0]] + weight[:, None] * self.points[edges[:, 1]]
        area = lambda p, t: np.linalg.norm(area_vectors(p, t), axis=1).sum()  # noqa: E731
        self.assertAlmostEqual(area(corners, triangles) / area(self.points, faces), 0.5, places=9)
        self.assertLess(corners[:, 0].max(), 1e-9)

    def test_means_at_points_keep_a_jump_between_layers(self):
        inner = np.linalg.norm(self.points[self.tets].mean(axis=1)[:, :2], axis=1) < 3.3
        tets, origin = apart_by_region(self.tets, inner.astype(int))
        means = nodal_means(self.points[origin], tets, np.where(inner, 1.0, 7.0))
        self.assertEqual(set(np.round(means, 9)), {1.0, 7.0})
        self.assertTrue(np.array_equal(origin[tets], self.tets))


class Line(unittest.TestCase):
    def setUp(self):
        self.straight, self.tets = tube([1.7, 3.4, INNER], True)
        self.side = np.hypot(self.straight[:, 0], self.straight[:, 1]) > INNER - 1e-9

    def test_straight_tube_has_its_axis(self):
        line = centreline.of_lumen(self.straight, self.tets, caps(self.straight, self.tets, self.straight[:, 2]))
        self.assertLess(abs(line.centres[:, :2]).max(), 1e-8)
        points = self.straight[self.side]
        _, way, away = line.locate(points)
        radius = np.hypot(points[:, 0], points[:, 1])
        self.assertLess(abs(way - points[:, 2]).max(), 1e-8)
        self.assertLess(abs(away[:, :2] - points[:, :2] / radius[:, None]).max(), 1e-8)
        self.assertEqual(len(line.paths()), 1)

    def test_begins_where_the_flow_comes_from(self):
        class Run:
            outputs = [(1.0, "first"), (2.0, "second")]
            direction = 1.0

            def nodal(self, group, grid, name):
                v = np.zeros_like(points)
                v[:, 2] = {"first": -0.1, "second": 1.0}[group] * self.direction  # some flows back at first
                return v

        points, tets = self.straight, self.tets.copy()
        a, b, c, d = (points[tets[:, k]] for k in range(4))
        inverted = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
        tets[inverted] = tets[inverted][:, [0, 2, 1, 3]]  # the caps are to be seen from outside
        ends = caps(points, tets, points[:, 2])
        for direction in (1.0, -1.0):
            run = Run()
            run.direction = direction
            flows = inflows(run, ends)
            area = sum(np.linalg.norm(area_vectors(ends[0].points, ends[0].triangles), axis=1))
            self.assertAlmostEqual(max(flows), 0.9 * area, places=9)
            self.assertAlmostEqual(sum(flows), 0.0, places=9)
            _, way, _ = centreline.of_lumen(points, tets, ends, flows).locate(points[self.side])
            z = points[self.side, 2]
            self.assertLess(abs(way - (z if direction > 0 else LENGTH - z)).max(), 1e-8)

    def test_bent_tube_has_that_of_the_torus(self):
        angle = self.straight[:, 2] / RADIUS
        out = RADIUS + self.straight[:, 0]
        bent = np.column_stack([out * np.cos(angle), self.straight[:, 1], out * np.sin(angle)])
        line = centreline.of_lumen(bent, self.tets, caps(bent, self.tets, self.straight[:, 2]))
        self.assertLess(abs(np.hypot(line.centres[:, 0], line.centres[:, 2]) - RADIUS).max(), 0.02)
        self.assertLess(abs(line.centres[:, 1]).max(), 1e-4)
        _, way, away = line.locate(bent[self.side])
        turn = angle[self.side]
        x, y = self.straight[self.side, 0] / INNER, self.straight[self.side, 1] / INNER
        exact = np.column_stack([x * np.cos(turn), y, x * np.sin(turn)])
        begins_at_zero = abs(line.centres[0, 2]) < 1.0  # either cap is the largest
        self.assertLess(abs(way - (RADIUS * turn if begins_at_zero else LENGTH - RADIUS * turn)).max(),
                        0.4)  # at corners of the line, 5 mm away
        self.assertGreater(np.einsum("ij,ij->i", away, exact).min(), 0.998)

    def test_pieces_are_those_that_hang_together(self):
        ends = caps(self.straight, self.tets, self.straight[:, 2])
        both = np.concatenate([end.nodes[end.triangles] for end in ends])
        self.assertEqual(np.bincount(pieces(both)).tolist(), [len(end.triangles) for end in ends])


class Cycles(unittest.TestCase):
    def test_change_is_relative_to_the_last_cycle(self):
        times = np.linspace(0.01, 3, 300)
        wave = np.where(times > 2, 1.0, 0.9) * np.sin(2 * np.pi * times)
        rows = changes_per_cycle({"time": times.tolist(), "inflow_a_mm3_per_ms": wave.tolist(), "step": times.tolist(),
                                  "mean_pressure_a_kPa": np.sin(2 * np.pi * times).tolist()}, 1.0)
        self.assertEqual([name for name, _ in rows], ["inflow_a_mm3_per_ms", "mean_pressure_a_kPa"])
        self.assertAlmostEqual(rows[0][1], 0.1, places=3)
        self.assertAlmostEqual(rows[1][1], 0.0, places=9)

    def test_less_than_two_cycles_tell_nothing(self):
        self.assertIsNone(changes_per_cycle({"time": [0.5, 1.0, 1.5, 1.9], "inflow_a": [1.0] * 4}, 1.0))


class StressOfLayers(unittest.TestCase):
    def test_quantile_counts_by_weight(self):
        values = np.array([3.0, 1.0, 2.0])
        self.assertEqual(wall_stress.quantile(values, np.array([1.0, 90.0, 9.5]), 0.99), 2.0)
        self.assertEqual(wall_stress.quantile(values, np.array([2.0, 90.0, 8.0]), 0.99), 3.0)

    def test_square_of_a_linear_tensor_is_exact(self):
        # x on the reference tetrahedron: mean of x² is 1/10; off the diagonal a tensor has it twice
        corners = np.array([0.0, 1.0, 0.0, 0.0])
        tets = np.array([[0, 1, 2, 3]])
        self.assertAlmostEqual(wall_stress.squares(np.outer(corners, [1.0, 0, 0, 0, 0, 0]), tets)[0], 0.1)
        self.assertAlmostEqual(wall_stress.squares(np.outer(corners, [0, 0, 3.0, 0, 0, 0]), tets)[0], 1.8)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
