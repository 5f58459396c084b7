"""Surfaces of vessels as a segmentation gives them. Needs Debian's python3-vtk9.

The mask of the voxels within a shape becomes a surface by flying edges, with steps like stairs, and is smoothed by a
windowed sinc filter, which leaves some of them. At each end a plane cuts the surface, not quite squarely.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkImplicitBoolean, vtkPlane, vtkSphere
from vtkmodules.vtkFiltersCore import (vtkCleanPolyData, vtkClipPolyData, vtkFlyingEdges3D, vtkPolyDataConnectivityFilter,
                                       vtkTriangleFilter, vtkWindowedSincPolyDataFilter)

from vessel_shapes import plane_of, sample

PASSES, BAND = 30, 0.04  # of the filter, and the frequencies that it lets through


def contour(inside, low, voxel):
    """The surface of the mask, with its steps."""
    image = vtkImageData()
    image.SetDimensions(*inside.shape)
    image.SetOrigin(*low)
    image.SetSpacing(voxel, voxel, voxel)
    image.GetPointData().SetScalars(numpy_to_vtk(inside.astype(np.float32).ravel(order="F"), deep=True))
    edges = vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0.5)
    edges.ComputeNormalsOff()
    edges.ComputeScalarsOff()
    edges.Update()
    return edges.GetOutput()


def smooth(surface, passes, band):
    filtered = vtkWindowedSincPolyDataFilter()
    filtered.SetInputData(surface)
    filtered.SetNumberOfIterations(passes)
    filtered.SetPassBand(band)
    filtered.NormalizeCoordinatesOn()
    filtered.FeatureEdgeSmoothingOff()
    filtered.Update()
    return filtered.GetOutput()


def cut(surface, centre, normal, radius):
    """Without what lies beyond the plane, near the end."""
    plane, ball, beyond, clip = vtkPlane(), vtkSphere(), vtkImplicitBoolean(), vtkClipPolyData()
    plane.SetOrigin(*centre)
    plane.SetNormal(*(-normal))
    ball.SetCenter(*centre)
    ball.SetRadius(2.5 * radius)
    beyond.SetOperationTypeToIntersection()
    beyond.AddFunction(plane)
    beyond.AddFunction(ball)
    clip.SetInputData(surface)
    clip.SetClipFunction(beyond)
    clip.Update()
    return clip.GetOutput()


def whole(surface, voxel):
    """Its largest part, of triangles, without the shortest edges."""
    clean, triangles, largest = vtkCleanPolyData(), vtkTriangleFilter(), vtkPolyDataConnectivityFilter()
    clean.SetInputData(surface)
    clean.ToleranceIsAbsoluteOn()
    clean.SetAbsoluteTolerance(0.02 * voxel)
    triangles.SetInputConnection(clean.GetOutputPort())
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    largest.SetInputConnection(triangles.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    largest.Update()
    return largest.GetOutput()


def open_surface(shape, voxel, passes=PASSES, band=BAND):
    """Points and triangles of the smoothed surface, open at the ends; passes = 0 leaves all steps."""
    distance, low = sample(shape, voxel)
    surface = contour(distance < 0, low, voxel)
    if passes:
        surface = smooth(surface, passes, band)
    for end in shape.ends:
        surface = cut(surface, *plane_of(shape, end))
    surface = whole(surface, voxel)
    cells = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    used, number = np.unique(cells, return_inverse=True)
    return points[used], number.reshape(-1, 3)


def write_stl(path, points, triangles):
    """Binary."""
    x = points[triangles]
    normals = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    records = np.zeros(len(x), dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    records["numbers"] = np.concatenate([normals[:, None], x], axis=1)
    with open(path, "wb") as file:
        file.write(b"a vessel as a segmentation gives it".ljust(80) + np.uint32(len(x)).astype("<u4").tobytes())
        file.write(records.tobytes())
