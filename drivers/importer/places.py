"""Points that stand at the same place."""
import itertools

import numpy as np

from .faces import components
from .raw import BadMesh

TWINS = 1e-9  # of the extent: written with nine digits or more, these are the same


def extent(points):
    return np.ptp(points, axis=0) if len(points) else np.zeros(3)


def hashed(cells):
    """One number per cell of a grid. Cells may collide: distances are looked at afterwards."""
    factors = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
    return (cells.astype(np.int64).view(np.uint64) * factors).sum(axis=1, dtype=np.uint64)


def pairs_within(a, b, tolerance):
    """Positions (i, j) of a[i] and b[j] that are no further apart, each pair once."""
    size = 4.0 * tolerance  # a ball of that radius then meets at most two cells along each axis
    in_cell = hashed(np.floor(b / size))
    order = np.argsort(in_cell, kind="stable")
    in_cell = in_cell[order]
    found = [np.zeros((0, 2), dtype=np.int64)]
    for signs in itertools.product((-1.0, 1.0), repeat=3):
        wanted = hashed(np.floor((a + np.multiply(signs, tolerance)) / size))
        start, end = np.searchsorted(in_cell, wanted, "left"), np.searchsorted(in_cell, wanted, "right")
        for k in range(int((end - start).max(initial=0))):
            i = np.flatnonzero(start + k < end)
            j = order[start[i] + k]
            near = np.einsum("ij,ij->i", a[i] - b[j], a[i] - b[j]) <= tolerance ** 2
            found.append(np.stack([i[near], j[near]], axis=1))
    return np.unique(np.concatenate(found), axis=0)


def twins(points, tolerance=None):
    """Pairs (i, j), i < j, of points at the same place."""
    tolerance = tolerance or max(TWINS * extent(points).max(), np.finfo(float).tiny)
    pairs = pairs_within(points, points, tolerance)
    return pairs[pairs[:, 0] < pairs[:, 1]]


def nearest(a, b, most=2000):
    """The least distance found between two clouds, of which some points are looked at."""
    a = a[:: max(1, len(a) // most)]
    return min(float(np.sqrt(((b[None] - part[:, None]) ** 2).sum(axis=2).min()))
               for part in np.array_split(a, max(1, len(a) * len(b) // 4_000_000)) if len(part))


def merge(raw, tolerance=None):
    """Makes one of vertices at the same place."""
    pairs = twins(raw.points, tolerance)
    label = components(len(raw.points), pairs[:, 0], pairs[:, 1])
    raw.tets, raw.triangles = label[raw.tets], label[raw.triangles]
    for what, elements in (("tetrahedra", raw.tets), ("triangles", raw.triangles)):
        lost = int((np.diff(np.sort(elements, axis=1), axis=1) == 0).any(axis=1).sum())
        if lost:
            raise BadMesh(f"{raw.path}: with this --tolerance {lost:,} {what} would lose a vertex, expected less than "
                          "their edges")
    joined = int((label != np.arange(len(label))).sum())
    raw.note(f"{joined:,} vertices joined with another at the same place")


def report_twins(raw):
    used = np.unique(raw.tets)
    count = len(np.unique(twins(raw.points[used])[:, 1]))
    if count:
        raw.note(f"{count:,} vertices stand at the place of another: parts that only touch are not connected. "
                 "--merge joins them")
