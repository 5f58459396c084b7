"""Surfaces of a few large triangles get vertices to work with, those of too many lose some."""
import dataclasses

import numpy as np

from . import edits
from . import surface as base
from .surface import Surface
from .target import Target

MOST = 60000   # triangles, about
UNEVEN = 6.0   # the long sides over the short ones: halved before ends are looked for


def short_side(surface):
    """The length of what is fine in a surface: that of the sides around the end of a tube drawn by CAD, too."""
    return float(np.percentile(base.edge_lengths(surface.points, surface.triangles), 20))


def halved(surface, longest):
    """Sides halved until none is longer, but for about as many triangles as are of use. Faces keep their numbers."""
    points, triangles = surface.points, surface.triangles
    least = np.sqrt(2.3 * base.areas(points, triangles).sum() / MOST)
    for _ in range(12):
        before = len(points)
        points, triangles, _ = edits.split(points, triangles, np.full(len(points), max(longest, least)), 1.0)
        if len(points) == before:
            break
    face = surface.face
    if face is not None and len(triangles) > len(surface.triangles):
        face = face[Target(surface).nearest(points[triangles].mean(axis=1))[1]]
    return Surface(points, triangles, face, surface.names)


def evened(surface):
    """Before ends are looked for: long triangles have their middles far from them."""
    sides, fine = base.edge_lengths(surface.points, surface.triangles), short_side(surface)
    return halved(surface, 3.0 * fine) if np.percentile(sides, 90) > UNEVEN * fine else surface


def thinned(surface):
    """Sides contracted until there are about as many triangles as are of use."""
    points, triangles = surface.points, surface.triangles
    for _ in range(6):
        if len(triangles) <= MOST:
            break
        size = np.full(len(points), np.sqrt(2.3 * base.areas(points, triangles).sum() / MOST))
        points, triangles, _ = edits.contract(points, triangles, size, 0.9, np.random.default_rng(3))
    return Surface(points, triangles)


def sampling(surface, rims, longest):
    """Sides halved or contracted, and the rims anew."""
    even = thinned(halved(surface, longest))
    loops = base.loops(even.triangles)
    centres = np.array([even.points[loop].mean(axis=0) for loop in loops])
    return even, [dataclasses.replace(rim, loop=loops[int(np.linalg.norm(centres - rim.centre, axis=1).argmin())])
                  for rim in rims]
