"""Flat prisms along the wall, grown inward, each cut into three tetrahedra."""
import dataclasses

import numpy as np

from . import surface as base
from .quality import six_volumes
from .surface import Around, Edges, dot, show, unit

THICKEST = 0.35    # of the radius of the largest ball that fits: what is left between layers is a lumen
ROUNDS = 30        # of thinning where elements would be inverted
THINNER = 0.8
LEAST = 0.15       # volume of a tetrahedron over the mean of its prism


@dataclasses.dataclass
class Layers:
    """points: those of the wall, then each layer's, inward; tets: none inverted."""
    points: np.ndarray
    tets: np.ndarray
    count: int

    def inner(self, vertices):
        """The same vertices on the innermost surface."""
        return vertices + self.count * (len(self.points) // (self.count + 1))


def grow(wall, rims, first, radii, options, say):
    """Layers on a wall whose rims are plane. first: thickness of the one at the wall, at each vertex."""
    shares = options.growth ** np.arange(options.layers)
    wish = first * shares.sum()
    edges = Edges(wall.triangles)
    total = eased(edges, np.minimum(wish, THICKEST * radii), wish)
    inward = directions(wall, rims, edges)
    heights = np.concatenate([[0.0], np.cumsum(shares) / shares.sum()])
    tets = cut_prisms(wall.triangles, len(wall.points), options.layers)
    for _ in range(ROUNDS):
        points = np.concatenate([wall.points + (h * total)[:, None] * inward for h in heights])
        bad = inverted(points, tets, wall.triangles, total)
        if not bad.any():
            break
        total[np.unique(wall.triangles[bad])] *= THINNER
        total = eased(edges, total, wish)
    tell(wall, total, wish, say)
    return Layers(points, positive(points, tets), options.layers)


def tell(wall, total, wish, say):
    thin = total < 0.7 * wish
    if thin.any():
        worst = int((total / wish).argmin())
        say(f"the layers are thinner than wished for at {int(thin.sum()):,} of {len(total):,} vertices, where the lumen is "
            f"narrow or bends sharply: {total[worst]:.3g} mm for {wish[worst]:.3g} mm at {show(wall.points[worst])}")


def eased(edges, total, wish):
    """Falls off gradually about thin places: the part of the wish changes by a quarter from vertex to vertex."""
    part, around = total / wish, Around(edges)
    while True:
        fresh = np.minimum(part, 1.25 * around.least(part[around.other]))
        if (part - fresh).max() < 1e-3:
            return fresh * wish
        part = fresh


def directions(wall, rims, edges):
    """Into the lumen; of a rim's vertices in the plane of its opening."""
    inward = -base.vertex_normals(wall.points, wall.triangles)
    plane = {}
    for rim in rims:
        plane.update(dict.fromkeys(rim.loop.tolist(), rim.normal))
    at, normals = np.array(list(plane)), np.array(list(plane.values()))
    a, b = edges.ends.T
    for _ in range(3):
        total = 2.0 * inward
        for k in range(3):
            total[:, k] += np.bincount(a, inward[b, k], len(inward)) + np.bincount(b, inward[a, k], len(inward))
        inward = unit(total)
        inward[at] = unit(inward[at] - dot(inward[at], normals)[:, None] * normals)
    return inward


def cut_prisms(triangles, count, layers):
    """Three tetrahedra each. A quadrilateral between two prisms is cut from the foot of its vertex with the smaller number
    to the head of the other, whichever prism asks: so tetrahedra on both its sides have the same faces."""
    a, b, c = np.sort(triangles, axis=1).T
    tets = []
    for k in range(layers):
        low, high = k * count, (k + 1) * count
        tets += [np.stack([a + low, b + low, c + low, c + high], axis=1),
                 np.stack([a + low, b + low, c + high, b + high], axis=1),
                 np.stack([a + low, a + high, b + high, c + high], axis=1)]
    return np.concatenate(tets)


def inverted(points, tets, triangles, total):
    """Whether a prism of the triangle has a tetrahedron that is inverted or nearly flat."""
    layers = len(tets) // (3 * len(triangles))
    sign = parity(triangles)
    volume = six_volumes(points, tets).reshape(layers, 3, -1) * -sign
    height = total[triangles].mean(axis=1) / layers
    straight = 2.0 * base.areas(points, triangles) * height
    scale = np.array([volume[k].mean(axis=0) for k in range(layers)])
    return (volume < LEAST * np.maximum(scale, 0.1 * straight)[:, None]).any(axis=(0, 1))


def parity(triangles):
    """+1 where sorting is an even exchange."""
    a, b, c = triangles.T
    return np.sign((b - a) * (c - a) * (c - b))


def positive(points, tets):
    turned = six_volumes(points, tets) < 0.0
    tets = tets.copy()
    tets[turned] = tets[turned][:, [0, 1, 3, 2]]
    return tets


def strips(loop, count, layers):
    """Triangles of the layers at an opening; loop runs with the wall to its left. Normals away from the vessel."""
    a, b = loop, np.roll(loop, -1)
    found = []
    for k in range(layers):
        low, high = k * count, (k + 1) * count
        for chosen, diagonal in ((a < b, "a"), (a > b, "b")):
            p, q = a[chosen], b[chosen]
            if diagonal == "a":
                found += [np.stack([q + low, p + low, q + high], axis=1), np.stack([p + low, p + high, q + high], axis=1)]
            else:
                found += [np.stack([q + low, p + low, p + high], axis=1), np.stack([q + low, p + high, q + high], axis=1)]
    return np.concatenate(found) if found else np.zeros((0, 3), dtype=np.int64)
