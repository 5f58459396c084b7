"""Takes the steps of voxels out of a surface and keeps its volume."""
import numpy as np

from . import surface as base
from .surface import Surface
from .target import Target

ITERATIONS = 40
VOXEL_OVER_EDGE = 1.0   # contours of voxels have sides of a half to one and a half
TOO_FAR = 0.22          # voxels, mean distance: a gentler pass follows
VOLUME = 1e-4           # kept to this part


def voxel_of(surface):
    """As wide as most sides are."""
    return VOXEL_OVER_EDGE * float(np.median(base.edge_lengths(surface.points, surface.triangles)))


def smoothed(surface, rims, voxel, say):
    """Less smooth where that leads away from the surface, the volume kept."""
    edge = float(np.median(base.edge_lengths(surface.points, surface.triangles)))
    old, wanted = Target(surface), base.volume(*base.closed(surface))
    band = pass_band(0.7 * min(rim.radius for rim in rims) / edge)
    while True:
        found = with_volume(filtered(surface, band), wanted)
        distance = np.linalg.norm(old.nearest(found.points)[0] - found.points, axis=1)
        if distance.mean() < TOO_FAR * voxel or band > 1.0:
            break
        band *= 2.0
    worst = int(distance.argmax())
    say(f"smoothed; points move {distance.mean():.3g} mm off the surface in the mean, {distance.max():.3g} mm at most, "
        f"at {base.show(found.points[worst])} (a voxel is some {voxel:.2g} mm)")
    return found


def pass_band(radius_in_edges):
    """Of the filter: waves as long as the narrowest branch is round pass, or it would shrink."""
    return float(np.clip(1.0 - np.cos(2.0 * np.pi / max(2.0 * np.pi * radius_in_edges, 4.0)), 0.02, 0.5))


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
