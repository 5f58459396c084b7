"""The surface that a new mesh of the lumen is drawn to: the one that the first mesh was made of, where it is known."""
import os

import numpy as np

from importer.raw import BadMesh
from lumen import edits, rims as of_rims, smooth, surface_files
from lumen import surface as base
from lumen.result import ORIGIN
from lumen.surface import Edges, Surface, show
from lumen.target import Target

BESIDE = "lumen.h5"    # where tunica-vessel keeps the mesh of the lumen
HALVINGS = 2           # of the run's own triangles
BULGE = 0.15           # of a side: how far its middle moves at most
NEAR = 0.25            # radii from the opening of the run: a rim belongs to it
OFF = 0.2              # radii, mean distance of the run's wall: another vessel


def of(run, path, say):
    """(surface, its rims in the order of the run's openings)"""
    surface, text = found(run, path)
    rims = rims_of(surface, run, text)
    off = np.linalg.norm(Target(surface).nearest(run.points[np.unique(run.wall)])[0] - run.points[np.unique(run.wall)], axis=1)
    if off.mean() > OFF * min(opening.radius for opening in run.openings):
        raise BadMesh(f"{text} is {off.mean():.3g} mm away from the wall of the run in the mean, expected the same vessel, in mm")
    say(f"drawn to {text}, {len(surface.triangles):,} triangles; the wall of the run is {off.mean():.2g} mm from it in the mean, "
        f"{off.max():.2g} mm at most")
    return surface, rims


def found(run, path):
    if path is not None:
        return given(path), path
    beside = os.path.join(os.path.dirname(run.mesh_file), BESIDE)
    for file in (run.mesh_file, beside):
        surface = read(file)
        if surface is not None:
            return surface, f"the surface that {file} was made of"
    return curved(run), "the run's own surface, which is taken as smooth"


def given(path):
    surface = read(path) if path.endswith(".h5") else surface_files.read(path, None)
    if surface is None:
        raise BadMesh(f"{path}: holds no surface: expected .stl, .vtp, .ply, .obj or .vtk, or a mesh of tunica-mesh lumen")
    if not len(base.loops(surface.triangles)):
        raise BadMesh(f"{path}: the surface is closed, expected one that is open at the ends of the vessel")
    return surface


def read(path):
    """The surface that a file of a mesh remembers, or None."""
    import h5py
    if not os.path.exists(path):
        return None
    try:
        with h5py.File(path, "r") as file:
            if ORIGIN not in file:
                return None
            return Surface(file[f"{ORIGIN}/points"][:].astype(float), file[f"{ORIGIN}/triangles"][:].astype(np.int64))
    except (OSError, KeyError) as error:
        raise BadMesh(f"{path}: not a readable HDF5 file: {error}") from None


def curved(run):
    """The triangles of the run halved, the middles of their sides where a smooth surface would have them.

    A cubic curve from a to b that is normal to n_a and n_b at its ends has its middle at
    (a + b)/2 - ((b - a).n_a n_a + (a - b).n_b n_b)/8: A. Vlachos and others, Symp. Interactive 3D Graphics (2001).
    """
    points, triangles = base.compact(run.points, run.wall)
    wanted = base.volume(*base.closed(Surface(points, triangles)))
    for _ in range(HALVINGS):
        points, triangles = halved(points, triangles, run.openings)
    surface = Surface(points, triangles)
    return smooth.with_volume(surface, wanted, None, rims_of(surface, run, "the run's surface"))


def halved(points, triangles, openings):
    edges = Edges(triangles)
    normals = base.vertex_normals(points, triangles)
    ends = edges.ends
    way = points[ends[:, 1]] - points[ends[:, 0]]
    move = np.zeros_like(way)
    for k, sign in ((0, 1.0), (1, -1.0)):
        normal = normals[ends[:, k]].copy()
        for opening in openings:  # sides on an opening stay in its plane
            on = edges.is_boundary & (np.abs((points[ends] - opening.centre) @ opening.normal).max(axis=1) < 0.1 * opening.radius) \
                & (np.linalg.norm(points[ends[:, 0]] - opening.centre, axis=1) < 2.0 * opening.radius)
            normal[on] = base.unit(normal[on] - np.outer(normal[on] @ opening.normal, opening.normal))
        move -= 0.125 * sign * base.dot(way, normal)[:, None] * normal
    length = np.linalg.norm(way, axis=1)
    far = np.linalg.norm(move, axis=1) / np.maximum(BULGE * length, 1e-300)
    move /= np.maximum(far, 1.0)[:, None]
    before = len(points)
    points, triangles, _ = edits.split(points, triangles, np.full(before, 1e-3 * length.min()), 1.0)
    points[before:] += move
    return points, triangles


def rims_of(surface, run, text):
    """The rim at each opening of the run."""
    loops = base.loops(surface.triangles)
    rims = []
    for opening in run.openings:
        ways = [np.linalg.norm(surface.points[loop].mean(axis=0) - opening.centre) for loop in loops]
        best = int(np.argmin(ways)) if ways else -1
        if not ways or ways[best] > NEAR * opening.radius or len(loops) != len(run.openings):
            raise BadMesh(f"{text} has {len(loops)} open ends, the nearest to the opening \"{opening.name}\" "
                          f"{min(ways, default=np.nan):.3g} mm away from its centre at {show(opening.centre)}: expected the surface of "
                          "the same vessel, cut at the same ends")
        rim = of_rims.measured(surface.points, loops[best], opening.normal)
        rim.name = opening.name
        rims.append(rim)
    return rims
