"""Where a surface crosses itself."""
import numpy as np

from .surface import dot

TOUCH = 1e-6   # of a side's length: so near to a plane it lies in it


def crossing(points, triangles):
    """Pairs of triangles, without a common vertex, of which a side of one pierces the other; (n, 2)."""
    a, b = near_pairs(points, triangles)
    if not len(a):
        return np.zeros((0, 2), dtype=np.int64)
    hit = np.zeros(len(a), dtype=bool)
    for first, second in ((a, b), (b, a)):
        for k in range(3):
            hit |= pierces(points, triangles[first, k], triangles[first, (k + 1) % 3], triangles[second])
    return np.stack([a[hit], b[hit]], axis=1)


def near_pairs(points, triangles):
    """Pairs whose boxes overlap, found by the cells of a grid that they share."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    size = 1.5 * float(np.median((high - low).max(axis=1))) + 1e-300
    cells, owner = cells_of(np.floor((low - low.min(axis=0)) / size).astype(np.int64),
                            np.floor((high - low.min(axis=0)) / size).astype(np.int64))
    order = np.argsort(cells, kind="stable")
    cells, owner = cells[order], owner[order]
    found, shift = [], 1
    while True:
        same = np.flatnonzero(cells[shift:] == cells[:-shift]) if shift < len(cells) else ()
        if not len(same):
            break
        a, b = owner[same], owner[same + shift]
        overlap = (low[a] <= high[b]).all(axis=1) & (low[b] <= high[a]).all(axis=1)
        found.append(np.stack([a, b], axis=1)[overlap])
        shift += 1
    pairs = np.sort(np.concatenate(found), axis=1) if found else np.zeros((0, 2), dtype=np.int64)
    pairs = np.unique(pairs, axis=0)
    shared = (triangles[pairs[:, 0]][:, :, None] == triangles[pairs[:, 1]][:, None, :]).any(axis=(1, 2))
    return pairs[~shared].T


def cells_of(low, high):
    """The number of every grid cell that a box touches, and the box."""
    counts = high - low + 1
    total = counts.prod(axis=1)
    owner = np.repeat(np.arange(len(low)), total)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(total) - total, total)
    nx, ny = counts[owner, 0], counts[owner, 1]
    x, y, z = step % nx, (step // nx) % ny, step // (nx * ny)
    extent = high.max(axis=0) + 1
    at = low[owner] + np.stack([x, y, z], axis=1)
    return (at[:, 2] * extent[1] + at[:, 1]) * extent[0] + at[:, 0], owner


def pierces(points, start, end, triangles):
    """Whether the segment from start to end meets the inside of the triangle."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    p, q = points[start], points[end]
    above, below = six(a, b, c, p), six(a, b, c, q)
    touches = TOUCH * np.linalg.norm(np.cross(b - a, c - a), axis=1) * np.linalg.norm(q - p, axis=1)
    apart = (np.abs(above) > touches) & (np.abs(below) > touches)  # what lies in the plane does not pierce it
    sides = np.stack([six(p, q, a, b), six(p, q, b, c), six(p, q, c, a)])
    return apart & (above * below < 0.0) & ((sides > 0.0).all(axis=0) | (sides < 0.0).all(axis=0))


def six(a, b, c, d):
    """Six times the volume of tetrahedra."""
    return dot(np.cross(b - a, c - a), d - a)
