"""The balls that fit into a lumen: vertices of the Voronoi diagram of its surface, inside of it."""
import dataclasses

import numpy as np
from scipy.sparse import coo_matrix
from scipy.spatial import Delaunay, cKDTree

from . import ends, subdivide
from . import surface as base
from .surface import dot

BEYOND = 2.5   # radii by which open ends are lengthened meanwhile, or the largest balls there were outside
FINE = 0.4     # of the narrowest end's radius: the longest sides
NEARLY = 1.12  # radii from its centre: a ball touches
SPREAD = 12    # from neighbour to neighbour


@dataclasses.dataclass
class Medial:
    """centres (n, 3) and radii (n,) of balls; graph: steps between neighbouring ones, as long as they are.

    of_vertex: the radius of the largest ball that touches each vertex of the surface.
    """
    centres: np.ndarray
    radii: np.ndarray
    graph: object
    of_vertex: np.ndarray


def balls(surface, rims):
    """Of a surface that is sampled more finely than it is wide: for that, sides are halved or contracted first."""
    narrowest = min(rim.radius for rim in rims)
    sampled, own = subdivide.sampling(surface, rims, FINE * narrowest)
    found = balls_of(sampled, own)
    _, nearest = cKDTree(sampled.points).query(surface.points)
    return dataclasses.replace(found, of_vertex=found.of_vertex[nearest])


def balls_of(surface, rims):
    longer, _ = ends.extended(surface, rims, BEYOND)
    points, normals = longer.points, base.vertex_normals(longer.points, longer.triangles)
    extent = np.ptp(points, axis=0).max()
    shifted = points + 1e-7 * extent * np.random.default_rng(1).standard_normal(points.shape)  # no five on one ball
    cells = Delaunay(shifted)
    centres, radii = circumscribed(shifted[cells.simplices])
    inward = dot(centres[:, None] - points[cells.simplices], normals[cells.simplices]) < 0.0
    inside = (inward.sum(axis=1) >= 3) & (radii < extent) & np.isfinite(radii)
    inside &= ((centres > points.min(axis=0)) & (centres < points.max(axis=0))).all(axis=1)
    return Medial(centres[inside], radii[inside], neighbours(cells, inside, centres),
                  touching(cells.simplices[inside], centres[inside], radii[inside], surface))


def circumscribed(corners):
    a = corners[:, 0]
    b, c, d = (corners[:, i] - a for i in (1, 2, 3))
    bc, cd, db = np.cross(b, c), np.cross(c, d), np.cross(d, b)
    six = dot(b, cd)
    with np.errstate(divide="ignore", invalid="ignore"):
        offset = (dot(b, b)[:, None] * cd + dot(c, c)[:, None] * db + dot(d, d)[:, None] * bc) / (2.0 * six)[:, None]
    return a + offset, np.linalg.norm(offset, axis=1)


def neighbours(cells, inside, centres):
    """Steps from ball to ball through common faces."""
    number = np.cumsum(inside) - 1
    a = np.repeat(np.arange(len(inside)), 4)
    b = cells.neighbors.reshape(-1)
    both = (b >= 0) & inside[a] & inside[b]
    a, b = a[both], b[both]
    step = np.linalg.norm(centres[a] - centres[b], axis=1)
    count = int(inside.sum())
    return coo_matrix((np.maximum(step, 1e-12), (number[a], number[b])), shape=(count, count)).tocsr()


def touching(simplices, centres, radii, surface):
    """The radius of the largest ball that nearly touches each vertex: begins with one that does, takes those of neighbours.

    A ball that only touches would know the last roughness of a surface.
    """
    points = surface.points
    ball = np.full(max(int(simplices.max()) + 1, len(points)), -1)
    order = np.argsort(radii, kind="stable")
    ball[simplices[order].reshape(-1)] = np.repeat(order, 4)  # of several the last is kept, the largest
    ball = ball[:len(points)]
    a, b = (np.concatenate(pair) for pair in zip(base.Edges(surface.triangles).ends.T,
                                                 base.Edges(surface.triangles).ends.T[::-1]))
    own = np.where(ball < 0, 0.0, radii[ball])
    for _ in range(SPREAD):
        other = ball[b]
        reach = np.linalg.norm(points[a] - centres[other], axis=1)
        better = (other >= 0) & (own[b] > own[a]) & ((reach < NEARLY * own[b]) | (ball[a] < 0))
        if not better.any():
            break
        chosen = np.flatnonzero(better)
        chosen = chosen[np.argsort(own[b[chosen]], kind="stable")]
        ball[a[chosen]] = other[chosen]
        own = np.where(ball < 0, 0.0, radii[ball])
    return own
