"""Gradients and second derivatives at the vertices of what is linear in tetrahedra.

At each vertex a quadratic polynomial is fitted to the values at the vertices around, by least squares; its derivatives are
the recovered ones: exact for a quadratic function on any mesh. Source: Z. Zhang, A. Naga, SIAM J. Sci. Comput. 26 (2005).
Beside the gradient in an element they give the estimate of its error of O. Zienkiewicz, J. Zhu, Int. J. Numer. Meth. Eng. 33
(1992). Deviation: coordinates are scaled by the spread of the vertices around, so that flat elements do no harm, and near
vertices count more.
"""
import dataclasses

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

from lumen.quality import six_volumes

MOST_RINGS = 4             # of vertices around; two, where they suffice
WORST = 1e-9               # least over largest eigenvalue of a fit that is taken
CHUNK = 4000               # vertices at a time
SECOND = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


def neighbours(count, tets):
    """Whether two vertices share a tetrahedron, or are one."""
    pairs = [(tets[:, i], tets[:, j]) for i in range(4) for j in range(4)]
    a, b = (np.concatenate([pair[k] for pair in pairs]) for k in (0, 1))
    return csr_matrix(coo_matrix((np.ones(len(a), dtype=bool), (a, b)), shape=(count, count)))


@dataclasses.dataclass
class Recovery:
    """first: three matrices, second: six in the order of SECOND; from values at vertices to derivatives there."""
    first: list
    second: list

    def gradient(self, values):
        """(n, c, 3) of values (n, c)."""
        return np.stack([matrix @ values for matrix in self.first], axis=-1)

    def hessian(self, values):
        """(n, c, 3, 3)"""
        found = np.empty((len(values), values.shape[1], 3, 3))
        for (i, j), matrix in zip(SECOND, self.second):
            found[:, :, i, j] = found[:, :, j, i] = matrix @ values
        return found


def recovery(points, tets):
    """Of a mesh all of whose points are used."""
    near = neighbours(len(points), tets)
    around, missing, parts = near, np.arange(len(points)), []
    for rings in range(2, MOST_RINGS + 1):
        around = around @ near
        *found, good = fitted(points, around, missing, rings == MOST_RINGS)
        parts.append([part[good[found[0]]] for part in found])
        missing = missing[~good[missing]]
        if not len(missing):
            break
    rows, columns, weights = (np.concatenate([part[k] for part in parts]) for k in range(3))
    matrices = [csr_matrix((weights[:, k], (rows, columns)), shape=near.shape) for k in range(9)]
    return Recovery(matrices[:3], matrices[3:])


def fitted(points, around, vertices, is_last):
    """Rows, columns and nine weights of the fits at these vertices, and whether a vertex has a fit that is taken."""
    good, parts = np.ones(len(points), dtype=bool), []
    order = vertices[np.argsort(np.diff(around.indptr)[vertices], kind="stable")]
    for some in np.array_split(order, -(-len(order) // CHUNK)):
        parts.append(fit(points, around, some, is_last, good))
    return [np.concatenate([part[k] for part in parts]) for k in range(3)] + [good]


def fit(points, around, vertices, is_last, good):
    """The same of some vertices that have about as many around; marks what is not good."""
    count = np.diff(around.indptr)[vertices]
    place = np.arange(count.max())
    is_there = place < count[:, None]
    at = around.indices[np.minimum(around.indptr[vertices][:, None] + place, len(around.indices) - 1)]
    offset = np.where(is_there[..., None], points[at] - points[vertices][:, None], 0.0)
    spread = np.einsum("vki,vkj->vij", offset, offset) / count[:, None, None]
    lengths, axes = np.linalg.eigh(spread)
    lengths = np.sqrt(np.maximum(lengths, 1e-12 * lengths[:, 2:]))
    x = np.einsum("vki,vij->vkj", offset, axes) / lengths[:, None]
    weight = np.where(is_there, 1.0 / (0.3 + (x * x).sum(axis=2) / 3.0), 0.0)
    columns = [np.ones_like(weight), *np.moveaxis(x, 2, 0), *(x[..., i] * x[..., j] for i, j in SECOND)]
    basis = np.stack(columns, axis=2)
    inverse, is_good = inverted(np.einsum("vki,vk,vkj->vij", basis, weight, basis))
    if is_last and not is_good.all():  # a mesh of a few vertices: the linear part alone
        bad = ~is_good
        basis[bad, :, 4:] = 0.0
        inverse[bad] = np.linalg.pinv(np.einsum("vki,vk,vkj->vij", basis[bad], weight[bad], basis[bad]), hermitian=True)
    else:
        good[vertices[~is_good]] = False
    derivatives = np.einsum("vij,vkj,vk->vki", inverse, basis, weight)
    return np.repeat(vertices, count), at[is_there], unscaled(derivatives, axes, lengths)[is_there]


def inverted(matrices):
    values, vectors = np.linalg.eigh(matrices)
    is_good = values[:, 0] > WORST * values[:, -1]
    part = np.where(is_good[:, None], 1.0 / np.maximum(values, 1e-300), 0.0)
    return np.einsum("vij,vj,vkj->vik", vectors, part, vectors), is_good


def unscaled(coefficients, axes, lengths):
    """From coefficients of the polynomial in scaled coordinates to the derivatives along x, y and z."""
    turn = axes / lengths[:, None]  # x_scaled = turnᵀ x
    gradient = np.einsum("vki,vji->vkj", coefficients[..., 1:4], turn)
    second = np.zeros(coefficients.shape[:2] + (3, 3))
    for (i, j), c in zip(SECOND, np.moveaxis(coefficients[..., 4:], 2, 0)):
        second[..., i, j] += c
        second[..., j, i] += c
    second = np.einsum("vai,vkij,vbj->vkab", turn, second, turn)
    return np.concatenate([gradient, np.stack([second[..., i, j] for i, j in SECOND], axis=2)], axis=2)


def volumes(points, tets):
    return np.abs(six_volumes(points, tets)) / 6.0


def shape_gradients(points, tets):
    """Volumes (m,) and gradients (m, 4, 3) of the linear functions that are one at a corner."""
    x = points[tets]
    rest = np.linalg.inv(x[:, 1:] - x[:, :1]).transpose(0, 2, 1)
    return volumes(points, tets), np.concatenate([-rest.sum(axis=1, keepdims=True), rest], axis=1)
