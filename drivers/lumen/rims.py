"""The curves at which a surface ends: openings of the vessel, small holes to be filled, tears."""
import dataclasses

import numpy as np

from . import surface as base
from .faults import BadSurface
from .subdivide import short_side
from .surface import Edges, Surface, show, unit

COHERENT = 0.6   # length of the mean direction out of the surface: 1 at the end of a tube, 0 around a hole in a wall
SMALL_HOLE = 20  # in short edges, around: filled
LEAST_RIM = 5.0  # in short edges, around: an end of a vessel, if it looks like one


@dataclasses.dataclass
class Rim:
    """An end of the vessel. normal: outward, along the vessel."""
    loop: np.ndarray
    centre: np.ndarray
    normal: np.ndarray
    area: float
    name: str = ""
    added: float = 0.0  # mm, straight length that the surface given does not have

    @property
    def radius(self):
        return float(np.sqrt(self.area / np.pi))


def measured(points, loop, outward):
    area = base.vector_area(points, loop)
    curve = points[loop]
    weight = np.linalg.norm(np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0), axis=1)
    centre = (weight[:, None] * curve).sum(axis=0) / weight.sum()
    normal = unit(area if np.dot(area, outward) > 0.0 else -area)
    return Rim(loop, centre, normal, float(np.linalg.norm(area)))


def directions(surface, edges=None):
    """Along the surface and out of it, at each boundary edge: (vertices, vectors as long as the edge)."""
    edges = edges or Edges(surface.triangles)
    rim = edges.boundary()
    triangle = edges.sides[edges.is_boundary, 0]
    along = surface.points[rim[:, 1]] - surface.points[rim[:, 0]]
    normal = unit(base.doubled_normals(surface.points, surface.triangles[triangle]))
    return rim, np.cross(along, normal)


def openings(surface, path, say):
    """The surface with its small holes filled, and its rims. An opening's vectors out of it agree."""
    rim, out = directions(surface)
    at = {int(a): v for (a, _), v in zip(rim, out)}
    edge = short_side(surface)
    found, holes = [], []
    for loop in base.loops(surface.triangles):
        vectors = np.array([at[int(v)] for v in loop])
        length = np.linalg.norm(vectors, axis=1).sum()
        coherence = np.linalg.norm(vectors.sum(axis=0)) / max(length, np.finfo(float).tiny)
        if coherence >= COHERENT and len(loop) > 5 and length > LEAST_RIM * edge:
            found.append(measured(surface.points, loop, vectors.sum(axis=0)))
        elif length <= SMALL_HOLE * edge:
            holes.append(loop)
        else:
            refuse_tear(surface, path, loop, length)
    return filled(surface, holes, say), found


def refuse_tear(surface, path, loop, length):
    place = surface.points[loop].mean(axis=0)
    raise BadSurface(f"{path}: the surface is torn open at {show(place)}: a hole {length:.3g} mm around in the wall, "
                     "not at an end of the vessel. Close it where the surface was made (fill holes in the "
                     "segmentation, or in MeshLab)", surface, place)


def filled(surface, holes, say):
    if not holes:
        return surface
    points, triangles, face = surface.points, surface.triangles, surface.face
    for loop in holes:
        points, more = base.fan(points, loop)
        triangles = np.vstack([triangles, more])
        if face is not None:
            wall = np.bincount(face - face.min()).argmax() + face.min()
            face = np.concatenate([face, np.full(len(more), wall)])
    say(f"{len(holes):,} small holes filled, the first at {show(surface.points[holes[0]].mean(axis=0))}")
    return Surface(points, triangles, face, surface.names)
