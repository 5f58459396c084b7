"""Faces of tetrahedra, their edges and the patches they form. No loop runs over elements."""
import numpy as np

from .raw import BadMesh

OF_TET = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # normals outward, face i opposite vertex i


def show(point):
    return "(" + ", ".join(f"{c:.6g}" for c in point) + ")"


def six_volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a))


def normals(points, triangles):
    """Twice the area long."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def group_rows(rows):
    """A number per row, the same for equal rows, and how many there are."""
    if not len(rows):
        return np.zeros(0, dtype=np.int64), 0
    order = np.lexsort(rows.T[::-1])
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(axis=1)
    group = np.empty(len(rows), dtype=np.int64)
    group[order] = np.cumsum(is_new) - 1
    return group, int(is_new.sum())


def parity(rows):
    """+1 where the three numbers stand in even order, -1 where in odd."""
    a, b, c = rows.T
    return np.sign(b - a) * np.sign(c - a) * np.sign(c - b)


class Faces:
    """Every face of positive tetrahedra once, sorted by vertices.

    outward  (n, 3)  vertices, normal out of the first tetrahedron
    tets     (n, 2)  the tetrahedra on its sides, the second -1 at the outer boundary
    """

    def __init__(self, path, points, tets):
        rows = tets[:, OF_TET].reshape(-1, 3)
        group, self.count = group_rows(np.sort(rows, axis=1))
        self._check(path, points, rows, group)
        first = np.full(self.count, len(rows))
        last = np.zeros(self.count, dtype=np.int64)
        numbers = np.arange(len(rows))
        last[group] = numbers  # of equal ones the last is kept
        first[group[::-1]] = numbers[::-1]
        self.outward = rows[first]
        self.sorted = np.sort(self.outward, axis=1)
        self.tets = np.stack([first // 4, np.where(last == first, -1, last // 4)], axis=1)
        self.is_outer = self.tets[:, 1] < 0

    def _check(self, path, points, rows, group):
        sides = np.bincount(group, minlength=self.count)
        if (sides > 2).any():
            face = rows[np.flatnonzero(sides[group] > 2)[0]]
            raise BadMesh(f"{path}: {int((sides > 2).sum()):,} faces have three tetrahedra or more, the first at "
                          f"{show(points[face].mean(axis=0))}: tetrahedra are there twice or overlap")
        balance = np.bincount(group, weights=parity(rows), minlength=self.count)
        folded = (sides == 2) & (balance != 0)
        if folded.any():
            face = rows[np.flatnonzero(folded[group])[0]]
            raise BadMesh(f"{path}: at {int(folded.sum()):,} faces both tetrahedra lie on the same side, the first at "
                          f"{show(points[face].mean(axis=0))}: the mesh is folded there. Mesh it anew")

    def find(self, triangles):
        """The face of each triangle, -1 where it is none."""
        group, count = group_rows(np.concatenate([self.sorted, np.sort(triangles, axis=1)]))
        face_of_group = np.full(count, -1)
        face_of_group[group[:self.count]] = np.arange(self.count)
        return face_of_group[group[self.count:]]


def components(count, a, b):
    """A number per item, the same where pairs (a, b) connect them: the smallest item of each part."""
    label = np.arange(count)
    while True:
        before = label.copy()
        low = np.minimum(label[a], label[b])
        np.minimum.at(label, label[a], low)  # roots hang below the smaller ones
        np.minimum.at(label, label[b], low)
        while (label != label[label]).any():
            label = label[label]
        if (label == before).all():
            return label


def neighbours(triangles):
    """Pairs of triangles with a common edge."""
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    group, _ = group_rows(edges)
    order = np.argsort(group, kind="stable")
    sorted_group, owner = group[order], order // 3
    pairs = []
    for shift in (1, 2, 3):  # four outer faces meet where parts touch in an edge
        same = sorted_group[shift:] == sorted_group[:-shift]
        pairs.append(np.stack([owner[:-shift][same], owner[shift:][same]], axis=1))
    return np.concatenate(pairs)


def patches(points, triangles, part, degrees):
    """Splits outward triangles where they meet at more than the angle, or belong to different parts.

    Returns a number per triangle: 0 for the patch of the largest area, then on.
    """
    normal = normals(points, triangles)
    area = np.linalg.norm(normal, axis=1)
    normal = normal / np.maximum(area, np.finfo(float).tiny)[:, None]
    a, b = neighbours(triangles).T
    is_smooth = np.einsum("ij,ij->i", normal[a], normal[b]) >= np.cos(np.radians(degrees))
    is_joined = is_smooth & (part[a] == part[b])
    label = components(len(triangles), a[is_joined], b[is_joined])
    roots, patch = np.unique(label, return_inverse=True)
    size = np.bincount(patch, weights=area)
    # Equal caps differ in their last digits only: then the first triangle decides.
    order = np.lexsort((roots, -np.round(size / size.max(), 6)))
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return rank[patch]
