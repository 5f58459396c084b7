"""Moves the new vertices of a refined mesh onto smooth surfaces through the vertices of the mesh before it.

Around each vertex a paraboloid through it is fitted to the vertices nearby,

  z = a x^2 + b x y + c y^2 + d x + e y   in the frame of the normal there,

and the middle of an edge moves to the mean of what both ends say. On cylinders its distance from the surface falls with the
fourth power of the length of the edge, that of the middle itself with the square. Vertices at creases have no such surface.
"""
import h5py
import numpy as np
from scipy.spatial import cKDTree

from vessel.mesh_file import Mesh

CREASE = np.cos(np.radians(50.0))  # between the normals of two triangles
LEAST_NEIGHBOURS = 6
HALVINGS = 4


class Patch:
    """The triangles of one surface."""

    def __init__(self, mesh, triangles):
        self.x, self.triangles = mesh.vertices, triangles
        vectors = mesh.area_vectors(triangles)
        self.unit = vectors / np.linalg.norm(vectors, axis=1)[:, None]
        sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        self.edges, self.of_side = np.unique(sides, axis=0, return_inverse=True)
        self._orient(vectors)
        self.neighbours = {}
        for a, b in self.edges:
            self.neighbours.setdefault(int(a), set()).add(int(b))
            self.neighbours.setdefault(int(b), set()).add(int(a))
        self.sharp = set(self.edges[self.creases].ravel().tolist())

    def _orient(self, vectors):
        """Normals that look to one side, from triangle to triangle, sums of them at the vertices, and which edges are creases."""
        beside = {}
        for side, edge in enumerate(self.of_side.ravel()):
            beside.setdefault(int(edge), []).append(side // 3)
        pairs = {edge: both for edge, both in beside.items() if len(both) == 2}
        near = {}
        for one, other in pairs.values():
            near.setdefault(one, []).append(other)
            near.setdefault(other, []).append(one)
        sign = np.zeros(len(self.triangles))
        for start in range(len(sign)):
            heap = [start] if sign[start] == 0 else []
            sign[start] = sign[start] or 1.0
            while heap:
                one = heap.pop()
                for other in near.get(one, ()):
                    if sign[other] == 0:
                        sign[other] = sign[one] * self._same_side(one, other)
                        heap.append(other)
        self.unit = self.unit * sign[:, None]
        self.normals = np.zeros_like(self.x)
        np.add.at(self.normals, self.triangles.ravel(), np.repeat(vectors * sign[:, None], 3, axis=0))
        self.creases = np.array([edge in pairs and self.unit[pairs[edge][0]] @ self.unit[pairs[edge][1]] < CREASE
                                 for edge in range(len(self.edges))])

    def _same_side(self, one, other):
        """1 where both triangles go through their common edge in opposite directions, as on an oriented surface."""
        directed = lambda t: {(int(a), int(b)) for a, b in zip(t, np.roll(t, -1))}  # noqa: E731
        return -1.0 if directed(self.triangles[one]) & directed(self.triangles[other]) else 1.0

    def paraboloid(self, vertex):
        """Origin, axes and coefficients at a vertex; None at creases and where there are too few neighbours."""
        if vertex in self.sharp:
            return None
        ring = set(self.neighbours[vertex])
        for other in [v for v in ring if v not in self.sharp]:  # nothing behind a crease
            ring |= self.neighbours[other]
        ring.discard(vertex)
        if len(ring) < LEAST_NEIGHBOURS:
            return None
        normal = self.normals[vertex] / np.linalg.norm(self.normals[vertex])
        along = np.cross(normal, np.eye(3)[np.argmin(abs(normal))])
        along /= np.linalg.norm(along)
        axes = np.array([along, np.cross(normal, along), normal])
        local = (self.x[sorted(ring)] - self.x[vertex]) @ axes.T
        near = 1 / np.square(local).sum(axis=1)  # what is near counts more
        return axes, np.linalg.lstsq(_terms(local) * near[:, None], local[:, 2] * near, rcond=None)[0]

    def moves(self):
        """Of the middle of each edge."""
        fits = {vertex: self.paraboloid(vertex) for vertex in self.neighbours}
        found = np.zeros((len(self.edges), 3))
        for i, edge in enumerate(self.edges):
            middle, told = self.x[edge].mean(axis=0), []
            for vertex in map(int, edge):
                if fits[vertex] is not None:
                    axes, terms = fits[vertex]
                    local = axes @ (middle - self.x[vertex])
                    told.append((float(_terms(local[None])[0] @ terms) - local[2]) * axes[2])
            if told and not self.creases[i]:
                found[i] = np.mean(told, axis=0)
        return found


def _terms(local):
    x, y = local[:, 0], local[:, 1]
    return np.stack([x * x, x * y, y * y, x, y], axis=1)


def rounded(before, path, smooth, flat):
    """Moves the vertices of the refined mesh in the file path; smooth and flat are names of surfaces. Returns how many had to stay
    nearer to the facets, since elements would have been inverted."""
    coarse, fine = Mesh(before), Mesh(path)
    places, tree = np.zeros_like(fine.vertices), cKDTree(fine.vertices)
    for name in smooth:
        patch = Patch(coarse, coarse.triangles_of(name))
        _, vertex = tree.query(coarse.vertices[patch.edges].mean(axis=1))
        places[vertex] = patch.moves()
    for name in flat:  # a rim stays in its plane
        triangles = fine.triangles_of(name)
        normal = fine.area_vectors(triangles)[0]
        normal /= np.linalg.norm(normal)
        mine = np.unique(triangles)
        places[mine] -= np.outer(places[mine] @ normal, normal)
    held = _without_inversion(fine, places)
    with h5py.File(path, "r+") as file:
        file["vertices"][:] = fine.vertices + places
    return held


def _without_inversion(fine, places):
    held, signs = set(), np.sign(fine.volume(fine.tets))
    for attempt in range(HALVINGS + 1):
        x = (fine.vertices + places)[fine.tets]
        bad = np.sign(np.linalg.det(x[:, 1:] - x[:, :1])) != signs
        if not bad.any():
            break
        mine = np.unique(fine.tets[bad])
        mine = mine[np.abs(places[mine]).max(axis=1) > 0]
        held.update(mine.tolist())
        places[mine] *= 0.5 if attempt < HALVINGS - 1 else 0.0
    return len(held)
