"""How long sides of elements are to be, at each vertex of a surface."""
import numpy as np

from . import surface as base
from .surface import Around, Edges

GRADING = 0.25       # growth of the size per length
PER_TURN = 18.0      # elements around a full circle of the surface's curvature
LEAST_PART = 0.4     # of the size by radius, however curved


def wanted(surface, radii, options):
    """By radius and curvature, or fixed; graded."""
    edges = Edges(surface.triangles)
    if options.size:
        size = np.full(len(surface.points), options.size)
    else:
        by_radius = 2.0 * averaged(edges, radii, 3) / options.across
        bend = averaged(edges, curvature(surface, edges), 4)
        by_curvature = 2.0 * np.pi / PER_TURN / np.maximum(bend, 1e-12)
        size = np.clip(by_curvature, LEAST_PART * by_radius, by_radius)
    if options.thinnest:
        size = np.minimum(size, options.flatness * options.thinnest)
    return graded(surface, edges, size)


def averaged(edges, values, passes):
    for _ in range(passes):
        total, count = values.copy(), np.ones(len(values))
        for a, b in (edges.ends.T, edges.ends.T[::-1]):
            total += np.bincount(a, weights=values[b], minlength=len(values))
            count += np.bincount(a, minlength=len(values))
        values = total / count
    return values


def curvature(surface, edges):
    """How much the normal turns per length: the largest of the edges at a vertex."""
    normals = base.vertex_normals(surface.points, surface.triangles)
    for k in range(3):
        normals[:, k] = averaged(edges, normals[:, k], 3)
    normals = base.unit(normals)
    a, b = edges.ends.T
    length = np.maximum(np.linalg.norm(surface.points[a] - surface.points[b], axis=1), 1e-300)
    length = np.maximum(length, 0.3 * np.median(length))
    turn = np.linalg.norm(normals[a] - normals[b], axis=1) / length
    largest = np.zeros(len(surface.points))
    np.maximum.at(largest, a, turn)
    np.maximum.at(largest, b, turn)
    return largest


def graded(surface, edges, size):
    """No size is larger than a near one and the way to it allow."""
    a, b = edges.ends.T
    around = Around(edges)
    room = GRADING * np.linalg.norm(surface.points[a] - surface.points[b], axis=1)[around.edge]
    while True:
        fresh = np.minimum(size, around.least(size[around.other] + room))
        if (size - fresh).max() < 1e-3 * fresh.min():
            return fresh
        size = fresh
