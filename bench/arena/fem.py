"""Finite elements in a few lines: boxes of simplices or quadrilaterals, shape functions, assembly into scipy matrices.

A Space has one scalar unknown for each of its functions; vectors are as many copies of it as there are dimensions,
component after component. Integrals are arrays with the axes (quadrature point, cell, ...).
"""
import itertools
import math

import numpy
import scipy.sparse as sparse


def grid(shape, lengths, origin=None):
    """Points of a regular grid, the first coordinate fastest."""
    origin = origin or [0.0] * len(shape)
    axes = [o + numpy.linspace(0.0, length, n + 1) for n, length, o in zip(shape, lengths, origin)]
    return numpy.stack([a.ravel() for a in numpy.meshgrid(*axes[::-1], indexing="ij")][::-1], axis=1)


def corners(shape):
    """Numbers of the 2^d corners of each cell of a grid, the first coordinate fastest."""
    strides = numpy.concatenate([[1], numpy.cumprod([n + 1 for n in shape[:-1]])])
    index = numpy.meshgrid(*[numpy.arange(n) for n in shape[::-1]], indexing="ij")[::-1]
    first = sum(i.ravel() * s for i, s in zip(index, strides))
    shifts = [sum(s for s, bit in zip(strides, bits[::-1]) if bit)
              for bits in itertools.product((0, 1), repeat=len(shape))]
    return first[:, None] + numpy.array(shifts)[None, :]


def simplices(shape):
    """Kuhn's d! simplices in each cell of a grid."""
    d, cells = len(shape), corners(shape)
    paths = []
    for order in itertools.permutations(range(d)):
        paths.append([sum(1 << axis for axis in order[:k]) for k in range(d + 1)])
    return cells[:, numpy.array(paths)].reshape(-1, d + 1)


def gauss(n):
    x, w = numpy.polynomial.legendre.leggauss(n)
    return (x + 1) / 2, w / 2


def simplex_rule(d, degree):
    """Barycentric coordinates and weights (of volume 1): a product rule on a collapsed cube."""
    if degree <= 1:
        return numpy.full((1, d + 1), 1 / (d + 1)), numpy.ones(1)
    if degree <= 2:  # a point near each corner
        a = (d + 2 - math.sqrt(d + 2)) / ((d + 1) * (d + 2))
        return numpy.full((d + 1, d + 1), a) + numpy.eye(d + 1) * (1 - (d + 1) * a), numpy.full(d + 1, 1 / (d + 1))
    x, w = gauss((degree + d) // 2 + 1)
    points, weights = [], []
    for k in itertools.product(range(len(x)), repeat=d):
        rest, weight, point = 1.0, 1.0, []
        for depth, i in enumerate(k):
            point.append(rest * x[i])
            weight *= w[i] * (1 - x[i]) ** (d - 1 - depth)
            rest *= 1 - x[i]
        points.append([rest] + point)
        weights.append(weight)
    return numpy.array(points), numpy.array(weights) / sum(weights)


class Simplices:
    """Geometry of a mesh of triangles or tetrahedra with a quadrature rule."""

    def __init__(self, points, cells, degree):
        self.points, self.cells, self.d = points, cells, points.shape[1]
        edges = points[cells[:, 1:]] - points[cells[:, :1]]
        inverse = numpy.linalg.inv(edges)
        gradients = numpy.swapaxes(inverse, 1, 2)
        self.gradients = numpy.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
        self.volumes = numpy.abs(numpy.linalg.det(edges)) / math.factorial(self.d)
        self.places, weights = simplex_rule(self.d, degree)
        self.weights = weights[:, None] * self.volumes[None, :]
        self.size = self.volumes ** (1 / self.d)

    def at_points(self):
        """Coordinates of the quadrature points."""
        return numpy.einsum("qk,mkd->qmd", self.places, self.points[self.cells])

    def linear(self):
        phi = numpy.broadcast_to(self.places[:, None, :], (len(self.places), len(self.cells), self.d + 1))
        dphi = numpy.broadcast_to(self.gradients, (len(self.places),) + self.gradients.shape)
        return Space(self, self.cells, self.points, phi, dphi)

    def quadratic(self):
        pairs = list(itertools.combinations(range(self.d + 1), 2))
        ends = numpy.sort(self.cells[:, pairs], axis=2)
        unique, number = numpy.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
        n = len(self.points)
        dofs = numpy.hstack([self.cells, n + number.reshape(len(self.cells), -1)])
        places = numpy.vstack([self.points, self.points[unique].mean(axis=1)])
        l, g = self.places, self.gradients
        phi = numpy.hstack([l * (2 * l - 1)] + [4 * l[:, [a]] * l[:, [b]] for a, b in pairs])
        dphi = numpy.concatenate(
            [(4 * l - 1)[:, None, :, None] * g[None]]
            + [4 * (l[:, a, None, None, None] * g[None, :, [b]] + l[:, b, None, None, None] * g[None, :, [a]])
               for a, b in pairs], axis=2)
        return Space(self, dofs, places, numpy.broadcast_to(phi[:, None], dphi.shape[:3]), dphi)

    def with_bubbles(self):
        """The linear functions, and behind them one bubble for each cell."""
        one, l = self.linear(), self.places
        factor = (self.d + 1) ** (self.d + 1)
        bubble = factor * l.prod(axis=1)
        slope = factor * numpy.stack([numpy.delete(l, k, axis=1).prod(axis=1) for k in range(self.d + 1)], axis=1)
        n, m = len(self.points), len(self.cells)
        dofs = numpy.hstack([self.cells, n + numpy.arange(m)[:, None]])
        phi = numpy.concatenate([one.phi, numpy.broadcast_to(bubble[:, None, None], (len(l), m, 1))], axis=2)
        dphi = numpy.concatenate([one.dphi, numpy.einsum("qk,mkd->qmd", slope, self.gradients)[:, :, None]], axis=2)
        return Space(self, dofs, numpy.vstack([self.points, self.points[self.cells].mean(axis=1)]), phi, dphi)

    def facets(self):
        """The facet opposite to each corner of each cell, and the sign of its flux out of the cell."""
        ends = numpy.stack([numpy.delete(self.cells, k, axis=1) for k in range(self.d + 1)], axis=1)
        unique, first, number = numpy.unique(numpy.sort(ends, axis=2).reshape(-1, self.d), axis=0, return_index=True,
                                             return_inverse=True)
        sign = numpy.full(number.shape, -1.0)
        sign[first] = 1.0
        return unique, number.reshape(ends.shape[:2]), sign.reshape(ends.shape[:2])


class Boxes:
    """Geometry of a regular grid of rectangles or bricks with two Gauss points for each direction."""

    def __init__(self, shape, lengths, origin=None):
        self.points, self.cells, self.d = grid(shape, lengths, origin), corners(shape), len(shape)
        h = [length / n for length, n in zip(lengths, shape)]
        x, w = gauss(2)
        rule = list(itertools.product(range(2), repeat=self.d))
        bits = numpy.array([b[::-1] for b in itertools.product((0, 1), repeat=self.d)])
        phi, dphi = [], []
        for k in rule:
            parts = [numpy.where(bits[:, i] == 1, x[k[i]], 1 - x[k[i]]) for i in range(self.d)]
            slopes = [numpy.where(bits[:, i] == 1, 1.0, -1.0) / h[i] for i in range(self.d)]
            phi.append(numpy.prod(parts, axis=0))
            dphi.append(numpy.stack([numpy.prod(parts[:i] + [slopes[i]] + parts[i + 1:], axis=0)
                                     for i in range(self.d)], axis=1))
        m = len(self.cells)
        self.volumes = numpy.full(m, math.prod(h))
        self.weights = numpy.array([math.prod(w[i] for i in k) for k in rule])[:, None] * self.volumes[None]
        self.size = self.volumes ** (1 / self.d)
        self._phi = numpy.broadcast_to(numpy.array(phi)[:, None], (len(rule), m, 2 ** self.d))
        self._dphi = numpy.broadcast_to(numpy.array(dphi)[:, None], (len(rule), m, 2 ** self.d, self.d))

    def at_points(self):
        return numpy.einsum("qmk,mkd->qmd", self._phi, self.points[self.cells])

    def linear(self):
        return Space(self, self.cells, self.points, self._phi, self._dphi)

    def constant(self):
        m = len(self.cells)
        return Space(self, numpy.arange(m)[:, None], self.points[self.cells].mean(axis=1),
                     numpy.ones(self.weights.shape + (1,)), numpy.zeros(self.weights.shape + (1, self.d)))


class Space:
    """Scalar functions on a mesh: their numbers in each cell, places, values and gradients at quadrature points."""

    def __init__(self, mesh, dofs, places, phi, dphi):
        self.mesh, self.dofs, self.places, self.phi, self.dphi = mesh, dofs, places, phi, dphi
        self.n = len(places)

    def matrix(self, local, columns=None):
        """Sum of the local matrices (cell, i, j); columns: the space of j."""
        columns = columns or self
        i = numpy.broadcast_to(self.dofs[:, :, None], local.shape).ravel()
        j = numpy.broadcast_to(columns.dofs[:, None, :], local.shape).ravel()
        return sparse.csr_matrix((local.ravel(), (i, j)), shape=(self.n, columns.n))

    def weight(self, factor):
        """Quadrature weights times a number, one for each cell, or one for each point and cell."""
        return self.mesh.weights * factor

    def mass(self, factor=1.0):
        return self.matrix(numpy.einsum("qm,qmi,qmj->mij", self.weight(factor), self.phi, self.phi, optimize=True))

    def stiffness(self, factor=1.0):
        return self.matrix(numpy.einsum("qm,qmid,qmjd->mij", self.weight(factor), self.dphi, self.dphi, optimize=True))

    def derivatives(self, test, i, j, factor=1.0):
        """Integral of the derivative i of the test function times the derivative j of ours."""
        return test.matrix(numpy.einsum("qm,qmi,qmj->mij", self.weight(factor), test.dphi[..., i], self.dphi[..., j],
                                        optimize=True), self)

    def gradient(self, test, k, factor=1.0):
        """Integral of the test function times the derivative k of ours."""
        return test.matrix(numpy.einsum("qm,qmi,qmj->mij", self.weight(factor), test.phi, self.dphi[..., k],
                                        optimize=True), self)

    def convection(self, wind, factor=1.0):
        """wind: (point, cell, d)."""
        slope = numpy.einsum("qmd,qmjd->qmj", wind, self.dphi)
        return self.matrix(numpy.einsum("qm,qmi,qmj->mij", self.weight(factor), self.phi, slope, optimize=True))

    def load(self, values):
        """values: (point, cell)"""
        local = numpy.einsum("qm,qmi->mi", self.weight(values), self.phi)
        return numpy.bincount(self.dofs.ravel(), local.ravel(), self.n)


def on_boundary(places, sides):
    """Which places lie on sides of their box, "0-" for the least first coordinate, "1+" for the largest second."""
    low, high = places.min(axis=0), places.max(axis=0)
    found = numpy.zeros(len(places), bool)
    for side in sides:
        axis = int(side[0])
        found |= numpy.abs(places[:, axis] - (low if side[1] == "-" else high)[axis]) < 1e-10
    return found


def all_sides(d):
    return [f"{axis}{end}" for axis in range(d) for end in "-+"]


def elasticity(space, shear, lame=0.0):
    """2 mu eps(u) : eps(v) + lambda div u div v, component after component."""
    d = space.mesh.d
    laplace = space.stiffness(shear)
    blocks = [[space.derivatives(space, j, i, shear) + space.derivatives(space, i, j, lame) for j in range(d)]
              for i in range(d)]
    for i in range(d):
        blocks[i][i] = blocks[i][i] + laplace
    return sparse.bmat(blocks, format="csr")


def divergence(velocity, pressure, factor=1.0):
    """-q div u, velocities component after component."""
    return sparse.hstack([-velocity.gradient(pressure, k, factor) for k in range(velocity.mesh.d)], format="csr")


def repeated(matrix, d):
    return sparse.block_diag([matrix] * d, format="csr")


def rigid_motions(places):
    """Columns: translations and rotations, component after component."""
    n, d = places.shape
    modes = []
    for i in range(d):
        mode = numpy.zeros((d, n))
        mode[i] = 1.0
        modes.append(mode.ravel())
    for i, j in itertools.combinations(range(d), 2):
        mode = numpy.zeros((d, n))
        mode[i], mode[j] = -places[:, j], places[:, i]
        modes.append(mode.ravel())
    return numpy.array(modes).T
