"""The parts of tunica-mesh adapt, on functions that are known: test_parts.py SOURCE PROGRAMS SCRATCH"""
import sys
import types
import unittest

import numpy as np
from scipy.spatial import Delaunay

from adapt import columns, errors, origin, recovery, sizes
from lumen import layers, surface as base, volume
from report.surfaces import boundary
from tubes import pipe

ORDERS = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]


def block(cells, size=1.0, shake=0.0):
    """A cube, each cell of six tetrahedra; inner points are moved at random by a part of a cell."""
    n = cells + 1
    points = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    corner = np.flatnonzero((points < cells).all(axis=1))
    step = np.array([n * n, n, 1])
    tets = [np.stack([corner, corner + step[i], corner + step[i] + step[j], corner + step.sum()], axis=1) for i, j, _ in ORDERS]
    tets = np.concatenate(tets)
    inner = ((points > 0) & (points < cells)).all(axis=1)
    points[inner] += shake * np.random.default_rng(1).uniform(-1.0, 1.0, (int(inner.sum()), 3))
    turned = np.linalg.det(points[tets][:, 1:] - points[tets][:, :1]) < 0.0
    tets[turned] = tets[turned][:, [0, 1, 3, 2]]
    return points * size / cells, tets


class Recovery(unittest.TestCase):
    def test_derivatives_of_a_quadratic_are_exact_on_any_mesh(self):
        points, tets = block(4, shake=0.2)
        points *= [1.0, 1.0, 0.02]  # flat elements too
        x, y, z = points.T
        values = np.stack([1 + 2 * x - 3 * y + 5 * z, x * x - 2 * x * y + 3 * y * z - z * z], axis=1)
        own = recovery.recovery(points, tets)
        gradient = own.gradient(values)
        self.assertLess(np.abs(gradient[:, 0] - [2, -3, 5]).max(), 1e-8)
        expected = np.stack([2 * x - 2 * y, -2 * x + 3 * z, 3 * y - 2 * z], axis=1)
        self.assertLess(np.abs(gradient[:, 1] - expected).max(), 1e-8)

    def test_a_mesh_of_few_vertices_still_has_the_gradient_of_a_linear_function(self):
        points, tets = block(1)
        gradient = recovery.recovery(points, tets).gradient(points @ np.array([[1.0], [2.0], [-4.0]]))
        self.assertLess(np.abs(gradient[:, 0] - [1, 2, -4]).max(), 1e-8)

    def test_the_estimate_of_a_quadratic_is_its_error(self):
        """The error of the gradient on halved cells is half of it, and the estimate is the error itself."""
        found = []
        for cells in (6, 12):
            points, tets = block(cells)
            u = points[:, :1] ** 2
            volumes, slopes = recovery.shape_gradients(points, tets)
            own = np.einsum("maj,mac->mcj", slopes, u[tets])
            squares, whole = errors.of_elements(recovery.recovery(points, tets).gradient(u), own, volumes, tets)
            apart = 2.0 * points[tets][:, :, 0] - own[:, None, 0, 0]  # of du/dx = 2 x, linear
            exact = volumes / 20.0 * ((apart ** 2).sum(axis=1) + apart.sum(axis=1) ** 2)
            other = (volumes * (own[:, 0, 1:] ** 2).sum(axis=1))
            self.assertLess(np.abs(squares - exact - other).max(), 1e-12)
            self.assertAlmostEqual(whole, 4.0 / 3.0, delta=0.1)
            found.append(np.sqrt(squares.sum()))
        self.assertAlmostEqual(found[0] / found[1], 2.0, delta=1e-6)


class Columns(unittest.TestCase):
    def test_layers_that_were_grown_are_found_with_their_heights(self):
        tube = pipe()
        layering = volume.Layering(layers=3, growth=1.5)
        rims = [types.SimpleNamespace(loop=loop, normal=np.array([0.0, 0.0, 1.0])) for loop in base.loops(tube.triangles)]
        grown = layers.grow(tube, rims, np.full(len(tube.points), 0.04), np.ones(len(tube.points)), layering, lambda text: None)
        found = columns.peeled(grown.points, grown.tets, tube.triangles)
        self.assertEqual(len(found.heights), 3)
        self.assertTrue(found.is_layer.all())
        self.assertLess(np.abs(np.array(found.heights) / [0.04, 0.06, 0.09] - 1.0).max(), 0.03)

    def test_a_mesh_without_layers_has_none(self):
        points = np.vstack([block(3)[0], np.random.default_rng(2).uniform(0.1, 0.9, (60, 3))])
        tets = Delaunay(points + 1e-9 * np.random.default_rng(3).standard_normal(points.shape)).simplices
        sides = boundary(points, tets)[0]
        top = sides[(points[sides][:, :, 2] > 0.999).all(axis=1)]
        self.assertEqual(columns.peeled(points, tets, top).heights, [])


class Sizes(unittest.TestCase):
    def planner(self, core, wall=np.inf, cells=8):
        points, tets = block(cells)
        sides = boundary(points, tets)[0]
        top = sides[(points[sides][:, :, 2] > 0.999).all(axis=1)]
        run = types.SimpleNamespace(points=points, tets=tets, wall=top)
        wall = np.where(np.isin(np.arange(len(points)), top), wall, np.inf)
        wish = errors.Wish(core(points), wall, 0.1, np.full(len(points), 0.1), np.full(len(points), 0.2))
        options = types.SimpleNamespace(layers=0, growth=None)
        limits = sizes.Limits(*[np.full(len(points), value) for value in (1e-6, np.inf, 1.0)])
        return sizes.Planner(run, wish, limits, 0, options)

    def test_sizes_are_those_asked_for_where_they_grow_slowly(self):
        plan = self.planner(lambda x: 0.05 + 0.1 * x[:, 0]).plan(1.0)
        self.assertLess(np.abs(plan.size - (0.05 + 0.1 * self.planner(lambda x: x[:, 0]).points[:, 0])).max(), 1e-12)

    def test_growth_is_limited(self):
        planner = self.planner(lambda x: np.where(x[:, 0] < 1e-9, 0.01, 10.0))
        self.assertLess(np.abs(planner.plan(1.0).size - (0.01 + sizes.GRADING * planner.points[:, 0])).max(), 1e-9)

    def test_the_number_of_elements_is_that_of_the_integral_and_is_found_by_bisection(self):
        planner = self.planner(lambda x: 0.05 + 0.1 * x[:, 0])
        exact = (0.05 ** -2 - 0.15 ** -2) / 0.2 / errors.OF_TETRAHEDRON  # of the integral of 1/h^3 over the cube
        self.assertAlmostEqual(planner.count(planner.plan(1.0)).sum() / exact, 1.0, delta=0.03)
        plan, e = planner.with_count(exact / 4.0)
        self.assertAlmostEqual(planner.count(plan).sum() / (exact / 4.0), 1.0, delta=0.02)
        self.assertAlmostEqual(e ** 0.4, 4.0 ** (1.0 / 3.0), delta=0.05)

    def test_errors_are_the_same_everywhere(self):
        """Where the second derivative is eight times as large, elements are smaller by 8^(-2/5): h^(5/2) |u''| is the same."""
        points, tets = block(8)
        volumes = recovery.shape_gradients(points, tets)[0]
        is_left = points[tets][:, :, 0].mean(axis=1) < 0.5
        size = np.cbrt(volumes / errors.OF_TETRAHEDRON)
        squares = np.where(is_left, 1.0, 64.0) * volumes * size ** 2
        wanted = size * errors.relative(squares, 1.0) ** (-0.5 / 2.5)
        self.assertAlmostEqual(wanted[is_left][0] / wanted[~is_left][0], 8.0 ** 0.4, delta=1e-9)


class Origin(unittest.TestCase):
    def test_a_coarse_round_surface_is_taken_as_round(self):
        tube = pipe(10, 12, 1.0, 6.0)
        opening = lambda z: types.SimpleNamespace(centre=np.array([0.0, 0.0, z]), normal=np.array([0, 0, 1.0]), radius=1.0)  # noqa: E731
        points, triangles = tube.points, tube.triangles
        for _ in range(2):
            points, triangles = origin.halved(points, triangles, [opening(0.0), opening(6.0)])
        self.assertEqual(len(triangles), 16 * len(tube.triangles))
        radius = np.linalg.norm(points[:, :2], axis=1)
        self.assertLess(np.abs(radius - 1.0).max(), 0.01)  # chords of ten sides: 0.05
        rim = np.unique(np.concatenate(base.loops(triangles)))
        self.assertLess(np.minimum(np.abs(points[rim, 2]), np.abs(points[rim, 2] - 6.0)).max(), 1e-12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
