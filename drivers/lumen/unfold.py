"""Takes folds out of a surface: triangles that look another way than the surface around their corners."""
import numpy as np

from . import surface as base
from .surface import Edges, Surface, dot, unit

AGREES = 0.2    # cosine between a triangle's normal and those at its corners
PASSES = 150


def unfolded(surface):
    """Vertices in and around folds go to the middle of their neighbours until there are no folds; those of rims stay.

    Returns the surface and how many vertices were moved.
    """
    edges = Edges(surface.triangles)
    is_fixed = np.zeros(len(surface.points), dtype=bool)
    is_fixed[edges.ends[edges.is_boundary]] = True
    points, touched = surface.points.copy(), np.zeros(len(surface.points), dtype=bool)
    for _ in range(PASSES):
        bad = folded(points, surface.triangles)
        if not bad.any():
            break
        near = np.zeros(len(points), dtype=bool)
        near[surface.triangles[bad]] = True
        near[surface.triangles[near[surface.triangles].any(axis=1)]] = True
        near &= ~is_fixed
        points[near] = 0.5 * (points + middles(points, edges.ends))[near]
        touched |= near
    return Surface(points, surface.triangles, surface.face, surface.names), int(touched.sum())


def folded(points, triangles, agrees=AGREES):
    normals = unit(base.doubled_normals(points, triangles))
    around = base.vertex_normals(points, triangles)
    return dot(around[triangles], normals[:, None]).min(axis=1) < agrees


def middles(points, pairs):
    """Of each vertex' neighbours."""
    total, count = np.zeros_like(points), np.zeros(len(points))
    for a, b in (pairs.T, pairs.T[::-1]):
        count += np.bincount(a, minlength=len(points))
        for k in range(3):
            total[:, k] += np.bincount(a, weights=points[b, k], minlength=len(points))
    return total / np.maximum(count, 1.0)[:, None]
