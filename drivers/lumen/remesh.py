"""Triangles of even shape and wanted size on a smooth surface."""
import numpy as np

from . import edits, subdivide
from . import surface as base
from .surface import Edges, Surface, dot, unit
from .target import Target

LONGEST, SHORTEST = 4.0 / 3.0, 4.0 / 5.0   # of the wanted size
PASSES, LAST_PASSES = 20, 4                # with changes of sides' number, and without
ENOUGH = 0.02                              # contractions and splits per vertex: no further pass


class Rims:
    """The curves, each in its plane, on which boundary vertices stay."""

    def __init__(self, surface, rims):
        self.start = np.concatenate([surface.points[rim.loop] for rim in rims])
        self.end = np.concatenate([surface.points[np.roll(rim.loop, -1)] for rim in rims])

    def nearest(self, points):
        way = self.end - self.start
        square = np.maximum(dot(way, way), 1e-300)
        part = np.clip(np.einsum("psk,sk->ps", points[:, None] - self.start, way) / square, 0.0, 1.0)
        found = self.start + part[:, :, None] * way
        best = np.linalg.norm(found - points[:, None], axis=2).argmin(axis=1)
        return found[np.arange(len(points)), best]


class Remesher:
    """Draws everything back to the surface it began with."""

    def __init__(self, surface, rims, size):
        self.target, self.rims, self.size_there = Target(surface), Rims(surface, rims), size
        start = subdivide.thinned(surface)
        self.points, self.triangles = start.points, start.triangles.copy()
        self.size = self.target.interpolate(size, *self.target.nearest(self.points))
        self._random = np.random.default_rng(7)

    def run(self, beat):
        for k in range(PASSES):
            before = len(self.points)
            self.points, self.triangles, self.size = edits.split(self.points, self.triangles, self.size, LONGEST)
            grown = len(self.points) - before
            self.points, self.triangles, self.size = edits.contract(self.points, self.triangles, self.size, SHORTEST,
                                                                    self._random)
            changed = grown + before + grown - len(self.points)
            self.triangles = edits.turn(self.points, self.triangles)
            self.relax()
            beat(f"wall: {len(self.triangles):,} triangles")
            if k > 3 and changed < ENOUGH * len(self.points):
                break
        for _ in range(LAST_PASSES):
            self.triangles = edits.turn(self.points, self.triangles)
            self.relax()
            beat(f"wall: {len(self.triangles):,} triangles")
        self.triangles = edits.turn(self.points, self.triangles)
        return Surface(self.points, self.triangles)

    def relax(self):
        """Vertices to the middle of their neighbours, along the surface; back where triangles would fold."""
        edges = Edges(self.triangles)
        rim = edges.ends[edges.is_boundary]
        is_rim = np.zeros(len(self.points), dtype=bool)
        is_rim[rim] = True
        normals = base.vertex_normals(self.points, self.triangles)
        step = mean_of_neighbours(self.points, edges.ends, self.size) - self.points
        step -= dot(step, normals)[:, None] * normals
        step[is_rim] = 0.5 * (mean_of_neighbours(self.points, rim, self.size) - self.points)[is_rim]
        old = base.doubled_normals(self.points, self.triangles)
        moved, size = self.drawn_back(self.points + 0.7 * step, is_rim)
        for _ in range(4):
            new = base.doubled_normals(moved, self.triangles)
            folded = dot(unit(new), unit(old)) < 0.5
            if not folded.any():
                break
            back = np.unique(self.triangles[folded])
            moved[back], size[back] = self.points[back], self.size[back]
        self.points, self.size = moved, size

    def drawn_back(self, points, is_rim):
        points = points.copy()
        points[is_rim] = self.rims.nearest(points[is_rim])
        found, cells = self.target.nearest(points)
        points[~is_rim] = found[~is_rim]
        return points, self.target.interpolate(self.size_there, found, cells)


def mean_of_neighbours(points, pairs, size):
    """Weighted: where sizes grow, vertices would else drift to the smaller ones."""
    total, weight = np.zeros_like(points), np.zeros(len(points))
    for a, b in (pairs.T, pairs.T[::-1]):
        share = size[b]
        weight += np.bincount(a, weights=share, minlength=len(points))
        for k in range(3):
            total[:, k] += np.bincount(a, weights=share * points[b, k], minlength=len(points))
    return np.where(weight[:, None] > 0.0, total / np.maximum(weight, 1e-300)[:, None], points)
