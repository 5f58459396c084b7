"""Layers, openings and core together: the mesh of a lumen."""
import dataclasses

import numpy as np

from importer.faces import Faces
from importer.raw import BadMesh

from . import core, layers, quality
from . import surface as base
from .faults import BadSurface

LESS = 0.7       # thickness of layers over that before, where Gmsh could not fill the core
ATTEMPTS = 3
ENOUGH = 10.0    # degrees, least angle in the core


@dataclasses.dataclass
class Mesh:
    """tets: those of layers first. caps: triangles of each opening, normals outward."""
    points: np.ndarray
    tets: np.ndarray
    in_layers: int
    wall: np.ndarray
    caps: list


def fill(wall, rims, wish, radii, options, progress):
    """Thinner layers, at last none, where the core cannot be filled."""
    part = 1.0
    for attempt in range(ATTEMPTS + 1):
        own = Layering(options.layers if attempt < ATTEMPTS else 0, options.growth)
        mesh = filled(wall, rims, Wish(part * wish.first, wish.inside), radii, own, progress)
        if mesh is not None:
            return mesh
        if not own.layers:
            break
        part *= LESS
        progress.warn("Gmsh cannot fill what the boundary layers leave; once more with "
                      + (f"layers of {part:.2g} of their thickness" if attempt + 1 < ATTEMPTS else "no layers"))
    raise BadSurface(f"{options.surface}: Gmsh cannot fill the surface with tetrahedra, though it is closed and does not "
                     "cross itself. Another --across or --size may do", wall)


@dataclasses.dataclass
class Wish:
    """first: thickness of the layer at the wall, at each vertex [mm]. inside: sizes in the core, or None: those of the triangles."""
    first: np.ndarray
    inside: core.Sizes = None


@dataclasses.dataclass
class Layering:
    layers: int
    growth: float


def filled(wall, rims, wish, radii, layering, progress):
    count = len(wall.points)
    if layering.layers:
        progress.stage(f"{layering.layers} boundary layers")
        grown = layers.grow(wall, rims, wish.first, radii, layering, progress.note)
    else:
        grown = layers.Layers(wall.points, np.zeros((0, 4), dtype=np.int64), 0)
    points, caps, closing = grown.points, [], [grown.inner(wall.triangles)]
    for rim in rims:
        more, disc = core.disc(points, grown.inner(rim.loop), rim.normal)
        points = np.vstack([points, more])
        caps.append(np.concatenate([layers.strips(rim.loop, count, layering.layers), disc]))
        closing.append(disc)
    progress.stage("filling the core")
    found = best_core(points, np.concatenate(closing), wish.inside)
    if found is None:
        return None
    points, tets = found
    tets = np.concatenate([grown.tets, tets])
    mesh = tidy(Mesh(points, layers.positive(points, tets), len(grown.tets), wall.triangles, caps))
    return mesh if is_sound(mesh) else None


def best_core(points, triangles, sizes):
    """By HXT, or by Delaunay where that fails or is better."""
    best, angle = None, -1.0
    for algorithm in (core.HXT, core.DELAUNAY):
        found = core.fill(points, triangles, algorithm, sizes)
        if found is None or not is_whole(found, points, triangles):
            continue
        least = quality.least_dihedral(*found).min()
        if least > angle:
            best, angle = found, least
        if angle >= ENOUGH:
            break
    return best


def is_whole(found, points, triangles):
    """Positive tetrahedra, which fill all."""
    volumes = np.abs(quality.six_volumes(*found)) / 6.0
    return volumes.min() > 0.0 and abs(volumes.sum() / base.volume(points, triangles) - 1.0) < 1e-6


def is_sound(mesh):
    """No element inverted or laid over another, and the outside is the wall and the openings."""
    triangles = np.concatenate([mesh.wall] + mesh.caps)
    try:
        faces = Faces("", mesh.points, mesh.tets)
    except BadMesh:
        return False
    at = faces.find(triangles)
    return bool(quality.six_volumes(mesh.points, mesh.tets).min() > 0.0 and (at >= 0).all() and faces.is_outer[at].all()
                and int(faces.is_outer.sum()) == len(triangles))


def tidy(mesh):
    """Without points that nothing uses."""
    used = np.zeros(len(mesh.points), dtype=bool)
    used[mesh.tets] = True
    number = np.cumsum(used) - 1
    return Mesh(mesh.points[used], number[mesh.tets], mesh.in_layers, number[mesh.wall], [number[c] for c in mesh.caps])
