"""The surface that meshes are drawn back to: nearest points, and values between its vertices."""
import numpy as np

from .surface import doubled_normals, dot, unit


def polydata(points, triangles):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    at = vtkPoints()
    at.SetDataTypeToDouble()
    at.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(len(triangles) + 1, dtype=np.int64) * 3, deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, dtype=np.int64).reshape(-1), deep=True))
    data = vtkPolyData()
    data.SetPoints(at)
    data.SetPolys(cells)
    return data


class Target:
    """Nearest points by VTK's tree of cells, which does not mind triangles of any shape."""

    def __init__(self, surface):
        from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
        self.points, self.triangles = surface.points, surface.triangles
        self.normals = unit(doubled_normals(self.points, self.triangles))
        self._data = polydata(self.points, self.triangles)
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(self._data)
        self._locator.BuildLocator()

    def nearest(self, points):
        """(points on the surface, their triangles)"""
        from vtkmodules.vtkCommonCore import mutable
        from vtkmodules.vtkCommonDataModel import vtkGenericCell
        found, cells = np.empty_like(points), np.empty(len(points), dtype=np.int64)
        at, cell, number, part, square = [0.0] * 3, vtkGenericCell(), mutable(0), mutable(0), mutable(0.0)
        find = self._locator.FindClosestPoint
        for i, point in enumerate(points.tolist()):
            find(point, at, cell, number, part, square)
            found[i], cells[i] = at, number.get()
        return found, cells

    def interpolate(self, values, points, cells):
        """Of values at the vertices, at points in these triangles."""
        corners = self.triangles[cells]
        a, b, c = (self.points[corners[:, i]] for i in range(3))
        normal = np.cross(b - a, c - a)
        square = np.maximum(dot(normal, normal), np.finfo(float).tiny)
        weights = np.stack([dot(np.cross(c - b, points - b), normal), dot(np.cross(a - c, points - c), normal),
                            dot(np.cross(b - a, points - a), normal)], axis=1) / square[:, None]
        weights = np.clip(weights, 0.0, 1.0)
        weights /= np.maximum(weights.sum(axis=1, keepdims=True), np.finfo(float).tiny)
        of_corners = values[corners]
        return (weights * of_corners).sum(axis=1)
