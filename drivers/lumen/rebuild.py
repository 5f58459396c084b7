"""Draws a rough surface anew, through voxels that are blurred: no folds, pimples or thin bridges are left."""
import numpy as np

from . import ends, repair, smooth
from . import rims as of_rims
from . import surface as base
from .faults import BadSurface
from .surface import Surface
from .target import polydata

PER_RADIUS = 5.0   # voxels in the narrowest end's radius, at least
BLUR = 0.7         # voxels of the surface given, standard deviation
NARROW = 0.35      # of the narrowest end's radius: the most of it
MARGIN = 0.05      # radii by which the ends are cut behind the rims
MOST = 3.0e7       # voxels


def rebuilt(surface, rims, voxel, path, say):
    """The surface and its rims, in the same order."""
    narrowest = min(rim.radius for rim in rims)
    size, blur = min(voxel, narrowest / PER_RADIUS), min(BLUR * voxel, NARROW * narrowest)
    longer, _ = ends.extended(surface, rims, 3.0 * blur / narrowest + 0.2)  # the blur of the ends is cut off again
    points, triangles = base.closed(longer)
    extent = np.ptp(points, axis=0) + 8.0 * size
    size = max(size, float((extent.prod() / MOST) ** (1.0 / 3.0)))
    new = contour(points, triangles, size, blur)
    new = repair.mended(new, path, lambda text: None)
    for rim in rims:
        new = opened(new, rim, path)
    new, found = of_rims.openings(new, path, say)
    if len(found) != len(rims):
        raise BadSurface(f"{path}: the surface is too rough to be smoothed, and of {len(rims)} openings {len(found)} are left "
                         "when it is drawn anew: smooth it where it was made, or leave thin branches out", surface,
                         rims[-1].centre)
    lost = sum(MARGIN * rim.radius * rim.area for rim in rims)
    new = smooth.with_volume(new, base.volume(*base.closed(surface)) - lost, rims=found)
    say(f"the surface is rough: drawn anew through voxels of {size:.2g} mm")
    return new, [min(found, key=lambda other: np.linalg.norm(other.centre - rim.centre)) for rim in rims]


def contour(points, triangles, size, blur):
    from scipy.ndimage import gaussian_filter
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
    origin = points.min(axis=0) - 4.0 * size
    count = np.ceil((np.ptp(points, axis=0) + 8.0 * size) / size).astype(int) + 1
    inside = mask(points, triangles, (origin, count, size))
    values = gaussian_filter(inside.astype(np.float32), blur / size, mode="constant")
    image = vtkImageData()
    image.SetDimensions(*map(int, count))
    image.SetOrigin(*origin)
    image.SetSpacing(size, size, size)
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    flying = vtkFlyingEdges3D()
    flying.SetInputData(image)
    flying.SetValue(0, 0.5)
    flying.ComputeNormalsOff()
    flying.Update()
    data = flying.GetOutput()
    cells = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64)
    return largest(Surface(vtk_to_numpy(data.GetPoints().GetData()).astype(float), cells))


def largest(surface):
    """What the blur has parted from the vessel goes."""
    label, _ = base.pieces(surface.triangles)
    return surface.take(label == np.bincount(label).argmax())


def mask(points, triangles, grid):
    """Which points of a grid (origin, counts, spacing) lie inside; indices z, y, x."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil
    origin, count, size = grid
    stencil, image = vtkPolyDataToImageStencil(), vtkImageStencilToImage()
    stencil.SetInputData(polydata(points, triangles))
    stencil.SetOutputOrigin(*origin)
    stencil.SetOutputSpacing(size, size, size)
    stencil.SetOutputWholeExtent(0, int(count[0]) - 1, 0, int(count[1]) - 1, 0, int(count[2]) - 1)
    image.SetInputConnection(stencil.GetOutputPort())
    image.SetInsideValue(1)
    image.SetOutsideValue(0)
    image.SetOutputScalarTypeToUnsignedChar()
    image.Update()
    return vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(tuple(count[::-1]))


def opened(surface, rim, path):
    """Cut where the rim was: what lies beyond, about it, goes."""
    offset = surface.points - rim.centre
    height = offset @ rim.normal + MARGIN * rim.radius
    aside = np.linalg.norm(offset - np.outer(offset @ rim.normal, rim.normal), axis=1)
    start = np.flatnonzero((aside < 1.5 * rim.radius) & (height > 0.0) & (height < rim.radius))
    return ends.clipped(surface, rim, rim.normal, rim.centre @ rim.normal - MARGIN * rim.radius, path, start)
