"""Takes the steps of voxels out of a surface and keeps its volume."""
import dataclasses

import numpy as np

from . import medial, sizes
from . import surface as base
from .surface import Surface
from .target import Target

ITERATIONS = 40
VOXEL_OVER_EDGE = 1.0   # contours of voxels have sides of a half to one and a half
TOO_FAR = 0.22          # voxels, mean distance: a gentler pass follows
STRONGEST = 0.02        # least pass band
VOLUME = 1e-4           # kept to this part


def voxel_of(surface):
    """As wide as most sides are."""
    return VOXEL_OVER_EDGE * float(np.median(base.edge_lengths(surface.points, surface.triangles)))


def smoothed(surface, rims, voxel, say):
    """Wide parts more than narrow ones, which the same filter would shrink; less where that leads away from the surface."""
    edge = float(np.median(base.edge_lengths(surface.points, surface.triangles)))
    old, wanted = Target(surface), base.volume(*base.closed(surface))
    band = pass_band(0.7 * min(rim.radius for rim in rims) / edge)
    bands = np.full(len(surface.points), band)
    if band > 1.5 * STRONGEST:
        bands = pass_band(0.7 * local_radii(filtered(surface, band), rims, surface) / edge)
    while True:
        found = with_volume(mixed(surface, bands), wanted)
        distance = np.linalg.norm(old.nearest(found.points)[0] - found.points, axis=1)
        if distance.mean() < TOO_FAR * voxel or bands.min() > 1.0:
            break
        bands = 2.0 * bands
    worst = int(distance.argmax())
    say(f"smoothed; points move {distance.mean():.3g} mm off the surface in the mean, {distance.max():.3g} mm at most, "
        f"at {base.show(found.points[worst])} (a voxel is some {voxel:.2g} mm)")
    return found


def local_radii(roughly, rims, surface):
    """Averaged: the bands change gradually along a branch."""
    own = [dataclasses.replace(rim) for rim in rims]
    radii = medial.balls(roughly, own).of_vertex
    return sizes.averaged(base.Edges(surface.triangles), radii, 12)


def pass_band(radius_in_edges):
    """Of the filter: waves as long as a branch of this radius is round pass, or it would shrink."""
    around = np.maximum(2.0 * np.pi * np.asarray(radius_in_edges), 4.0)
    return np.clip(1.0 - np.cos(2.0 * np.pi / around), STRONGEST, 0.5)


def mixed(surface, bands):
    """Filters of a few bands; each vertex between the two next to its own."""
    low, high = float(bands.min()), float(bands.max())
    count = max(int(np.ceil(np.log2(high / low))) + 1, 1)
    if count == 1:
        return filtered(surface, low)
    levels = np.geomspace(low, high, count)
    place = np.log(bands / low) / np.log(high / low) * (count - 1)
    points = np.zeros_like(surface.points)
    for k, level in enumerate(levels):
        points += np.clip(1.0 - np.abs(place - k), 0.0, 1.0)[:, None] * filtered(surface, float(level)).points
    return Surface(points, surface.triangles, surface.face, surface.names)


def filtered(surface, band):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from .target import polydata
    sinc = vtkWindowedSincPolyDataFilter()
    sinc.SetInputData(polydata(surface.points, surface.triangles))
    sinc.SetNumberOfIterations(ITERATIONS)
    sinc.SetPassBand(band)
    sinc.BoundarySmoothingOn()
    sinc.FeatureEdgeSmoothingOff()
    sinc.NonManifoldSmoothingOff()
    sinc.NormalizeCoordinatesOn()
    sinc.Update()
    points = vtk_to_numpy(sinc.GetOutput().GetPoints().GetData()).astype(float)
    return Surface(points, surface.triangles, surface.face, surface.names)


def with_volume(surface, wanted, weight=None, rims=()):
    """Moved along its normals, by a length or by parts of a weight, until it encloses what is wanted.

    The rims stay in their planes.
    """
    weight = np.ones(len(surface.points)) if weight is None else weight
    moved = surface
    for _ in range(6):
        missing = wanted - base.volume(*base.closed(moved))
        if abs(missing) < VOLUME * abs(wanted):
            break
        normals = base.vertex_normals(moved.points, moved.triangles)
        for rim in rims:
            normals[rim.loop] = base.unit(normals[rim.loop] - np.outer(normals[rim.loop] @ rim.normal, rim.normal))
        gain = (base.areas(moved.points, moved.triangles) * weight[moved.triangles].mean(axis=1)).sum()
        points = moved.points + (missing / gain * weight)[:, None] * normals
        moved = Surface(points, moved.triangles, moved.face, moved.names)
    return moved
