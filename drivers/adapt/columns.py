"""Layers of flat prisms on a surface, found again in a mesh of tetrahedra: how many, and how thick.

Of the three tetrahedra of a prism one has three vertices on the surface, one two and one one, so that beside a layer as many
tetrahedra of each kind as there are triangles touch the surface, and no others. The face opposite to the one vertex is the
triangle on the next surface.
"""
import dataclasses

import numpy as np

from lumen.quality import six_volumes
from lumen.surface import areas


@dataclasses.dataclass
class Columns:
    """heights and tets: mean and tetrahedra of each layer, the farthest last; far: triangles on the other side of that."""
    heights: list
    tets: list
    is_layer: np.ndarray
    far: np.ndarray


def peeled(points, tets, triangles, most=40):
    """Layers on the triangles, one after the other, until what follows is none."""
    heights, layers, is_layer = [], [], np.zeros(len(tets), dtype=bool)
    area = areas(points, triangles).sum()
    while len(heights) < most:
        found = next_layer(len(points), tets, triangles, is_layer)
        if found is None:
            break
        chosen, further = found
        volume = np.abs(six_volumes(points, tets[chosen])).sum() / 6.0
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
    corners = tets[rest[kind == 1]]
    return rest[kind > 0], corners[~is_on[corners]].reshape(-1, 3)
