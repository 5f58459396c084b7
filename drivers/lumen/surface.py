"""Triangles in space, and what the other modules ask of them. No loop runs over triangles."""
import dataclasses

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components



@dataclasses.dataclass
class Surface:
    """points (n, 3), triangles (m, 3) with normals outward; face: a number per triangle, or None."""
    points: np.ndarray
    triangles: np.ndarray
    face: np.ndarray = None
    names: dict = dataclasses.field(default_factory=dict)  # number of a face -> its name

    def take(self, chosen):
        """Of some triangles; points that none of them uses go."""
        face = None if self.face is None else self.face[chosen]
        points, triangles = compact(self.points, self.triangles[chosen])
        return Surface(points, triangles, face, self.names)


def compact(points, triangles):
    used = np.zeros(len(points), dtype=bool)
    used[triangles] = True
    position = np.cumsum(used) - 1
    return points[used], position[triangles]


def show(point):
    return "(" + ", ".join(f"{c:.4g}" for c in point) + ")"


def dot(a, b):
    return np.einsum("...i,...i->...", a, b)


def unit(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0.0, length, 1.0)


def doubled_normals(points, triangles):
    """Twice the area long."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def areas(points, triangles):
    return 0.5 * np.linalg.norm(doubled_normals(points, triangles), axis=1)


def vertex_normals(points, triangles):
    """Weighted by angles: triangles that are slivers, or many on a side, do not pull them aside."""
    normal = unit(doubled_normals(points, triangles))
    total = np.zeros_like(points)
    for i in range(3):
        a, b, c = (points[triangles[:, (i + k) % 3]] for k in range(3))
        angle = np.arccos(np.clip(dot(unit(b - a), unit(c - a)), -1.0, 1.0))
        for k in range(3):
            total[:, k] += np.bincount(triangles[:, i], weights=angle * normal[:, k], minlength=len(points))
    return unit(total)


def gammas(points, triangles):
    """Quality, 1 for a regular triangle, 0 for a flat one: twice the inscribed over the circumscribed radius."""
    lengths = edge_lengths(points, triangles)
    product = np.maximum(lengths.prod(axis=1) * lengths.sum(axis=1), np.finfo(float).tiny)
    return 16.0 * areas(points, triangles) ** 2 / product


def edge_lengths(points, triangles):
    """Of the sides (0, 1), (1, 2), (2, 0)."""
    corners = points[triangles]
    return np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)


class Edges:
    """Every edge once.

    ends   (e, 2)  its vertices, the smaller first
    of     (m, 3)  the edges (0, 1), (1, 2), (2, 0) of each triangle
    count  (e,)    triangles at it
    sides  (e, 2)  two of them, -1 where there is none
    """

    def __init__(self, triangles):
        directed = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
        low, high = directed.min(axis=1), directed.max(axis=1)
        self.stride = int(triangles.max(initial=0)) + 1
        key = low * self.stride + high
        self.keys, of, self.count = np.unique(key, return_inverse=True, return_counts=True)
        self.of = of.reshape(-1, 3)
        self.ends = np.stack([self.keys // self.stride, self.keys % self.stride], axis=1)
        order = np.argsort(of, kind="stable")
        first = np.concatenate([[0], np.cumsum(self.count)[:-1]]).astype(np.int64)
        self.sides = np.full((len(self.keys), 2), -1)
        self.sides[:, 0] = order[first] // 3
        has_two = self.count > 1
        self.sides[has_two, 1] = order[first[has_two] + 1] // 3
        self.is_boundary = self.count == 1
        self._directed, self._order, self._first = directed, order, first

    def boundary(self):
        """Directed as in their triangle: the surface lies to the left."""
        return self._directed[self._order[self._first[self.is_boundary]]]

    def number(self, a, b):
        """Of the edge between these vertices, if there is one."""
        key = np.minimum(a, b) * self.stride + np.maximum(a, b)
        return np.minimum(np.searchsorted(self.keys, key), len(self.keys) - 1)

    def has(self, a, b):
        """Whether there is an edge between these vertices."""
        return (self.ends[self.number(a, b)] == np.sort(np.stack([a, b], axis=1), axis=1)).all(axis=1)


class Around:
    """The edges at each vertex; every vertex has one."""

    def __init__(self, edges):
        a, other = np.concatenate([edges.ends, edges.ends[:, ::-1]]).T
        order = np.argsort(a, kind="stable")
        self.edge, self.other = np.concatenate([np.arange(len(edges.ends))] * 2)[order], other[order]
        self._first = np.searchsorted(a[order], np.arange(int(a.max()) + 1))

    def least(self, values):
        """Of the values along the edges of each vertex, in the order of .edge and .other."""
        return np.minimum.reduceat(values, self._first)


def parts(count, a, b):
    """A number per item, the same where pairs connect them, and how many there are."""
    graph = coo_matrix((np.ones(len(a), dtype=np.int8), (a, b)), shape=(count, count))
    number, label = connected_components(graph, directed=False)
    return label.astype(np.int64), number  # not 32 bits: numbers of edges are products


def pieces(triangles):
    """The connected piece of each triangle, by edges."""
    edges = Edges(triangles)
    two = edges.sides[:, 1] >= 0
    return parts(len(triangles), edges.sides[two, 0], edges.sides[two, 1])


def loops(triangles):
    """Closed curves of vertices around the holes, the surface to their left. Asks for manifold rims."""
    rim = Edges(triangles).boundary()
    after = dict(zip(rim[:, 0].tolist(), rim[:, 1].tolist()))
    found = []
    while after:
        start, at = after.popitem()
        loop = [start]
        while at != start:
            loop.append(at)
            at = after.pop(at)
        found.append(np.array(loop))
    return sorted(found, key=lambda loop: int(loop.min()))


def vector_area(points, loop):
    """Of the surface that a closed curve spans, whichever it is."""
    curve = points[loop] - points[loop].mean(axis=0)
    return 0.5 * np.cross(curve, np.roll(curve, -1, axis=0)).sum(axis=0)


def fan(points, loop):
    """Closes a curve by triangles to a new point in its middle, normals away from a surface on its left."""
    curve = points[loop]
    weight = np.linalg.norm(np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0), axis=1)
    centre = (weight[:, None] * curve).sum(axis=0) / max(weight.sum(), np.finfo(float).tiny)
    number = np.full(len(loop), len(points))
    return np.vstack([points, centre]), np.stack([np.roll(loop, -1), loop, number], axis=1)


def closed(surface):
    """With a fan in each hole, for volumes."""
    points, triangles = surface.points, surface.triangles
    for loop in loops(triangles):
        points, more = fan(points, loop)
        triangles = np.vstack([triangles, more])
    return points, triangles


def volume(points, triangles):
    """Inside a closed surface; positive with normals outward."""
    x = points - points.mean(axis=0)
    a, b, c = (x[triangles[:, i]] for i in range(3))
    return float(dot(a, np.cross(b, c)).sum() / 6.0)
