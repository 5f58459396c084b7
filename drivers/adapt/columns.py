"""Layers of flat prisms on a surface, found again in a mesh of tetrahedra: how many, and how thick.

Of the three tetrahedra of a prism one has three vertices on the surface, one two and one one, so that beside a layer as many
tetrahedra of each kind as there are triangles touch the surface, and no others. The face opposite to the one vertex is the
triangle on the next surface.
"""
import dataclasses

import numpy as np


@dataclasses.dataclass
class Columns:
    """heights and tets: mean and tetrahedra of each layer, the farthest last; far: triangles on the other side of that."""
    heights: list
    tets: list
    is_layer: np.ndarray
    far: np.ndarray

    @property
    def count(self):
        return len(self.heights)


def peeled(points, tets, triangles, most=40):
    """Layers on the triangles, one after the other, until what follows is none."""
    heights, layers, is_layer = [], [], np.zeros(len(tets), dtype=bool)
    area = areas(points, triangles).sum()
    while len(heights) < most:
        found = next_layer(len(points), tets, triangles, is_layer)
        if found is None:
            break
        chosen, further = found
        volume = six_volumes(points, tets[chosen]).sum() / 6.0
        other = areas(points, further).sum()
        heights.append(2.0 * volume / (area + other))
        layers.append(chosen)
        is_layer[chosen], triangles, area = True, further, other
    return Columns(heights, layers, is_layer, triangles)


def next_layer(count, tets, triangles, is_taken):
    """(tetrahedra of the layer, triangles on its other side), or None."""
    is_on = np.zeros(count, dtype=bool)
    is_on[triangles] = True
    rest = np.flatnonzero(~is_taken)
    on = is_on[tets[rest]]
    kind = on.sum(axis=1)
    if any((kind == k).sum() != len(triangles) for k in (1, 2, 3)) or (kind == 4).any():
        return None
    single = rest[kind == 1]
    corners = tets[single]
    return rest[kind > 0], corners[~is_on[corners]].reshape(-1, 3)


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def six_volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.abs(np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)))
