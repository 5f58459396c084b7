"""Draws scenes by VTK: vtk_pictures.py FOLDER

A process of its own, as VTK ends the one it is in where it has no display. In the folder lie jobs.json, a list of
{"scene", "picture", "axes", "box", "width", "height"}, and for each scene a file of arrays.
"""
import importlib
import json
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkArrowSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

for name in ("vtkInteractionStyle", "vtkRenderingOpenGL2"):  # what VTK draws by, once they are there
    importlib.import_module(f"vtkmodules.{name}")


def poly_data(points, triangles=None):
    data, place = vtkPolyData(), vtkPoints()
    place.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    data.SetPoints(place)
    if triangles is not None:
        cells = vtkCellArray()
        flat = np.hstack([np.full((len(triangles), 1), 3), triangles]).astype(np.int64).reshape(-1)
        cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(flat, deep=1))
        data.SetPolys(cells)
    return data


def surface(points, triangles, colours):
    data = poly_data(points, triangles)
    rgb = numpy_to_vtk(np.ascontiguousarray((255 * np.clip(colours, 0, 1)).astype(np.uint8)), deep=1)
    rgb.SetName("colour")
    data.GetPointData().SetScalars(rgb)
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetFeatureAngle(35)
    normals.ConsistencyOff()
    return actor(normals)


def arrows(begins, vectors):
    data = poly_data(begins)
    direction = numpy_to_vtk(np.ascontiguousarray(vectors), deep=1)
    direction.SetName("arrow")
    data.GetPointData().SetVectors(direction)
    source = vtkArrowSource()
    source.SetTipRadius(0.14)
    source.SetTipLength(0.38)
    source.SetShaftRadius(0.045)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(source.GetOutputPort())
    glyphs.SetVectorModeToUseVector()
    glyphs.SetScaleModeToScaleByVector()
    glyphs.OrientOn()
    drawn = actor(glyphs)
    drawn.GetMapper().ScalarVisibilityOff()
    drawn.GetProperty().SetColor(0.12, 0.12, 0.12)
    return drawn


def actor(source):
    mapper, drawn = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputConnection(source.GetOutputPort())
    drawn.SetMapper(mapper)
    drawn.GetProperty().SetAmbient(0.35)
    drawn.GetProperty().SetDiffuse(0.7)
    drawn.GetProperty().SetSpecular(0.08)
    return drawn


def renderer_of(arrays):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for k in range(int(arrays["count"])):
        renderer.AddActor(surface(*(arrays[f"{name}{k}"] for name in ("points", "triangles", "colours"))))
    if len(arrays["begins"]):
        renderer.AddActor(arrows(arrays["begins"], arrays["vectors"]))
    return renderer


def look(renderer, axes, box):
    """Parallel projection of the box (left, right, bottom, top) in the plane of the first two axes."""
    camera = renderer.GetActiveCamera()
    bounds = np.array(renderer.ComputeVisiblePropBounds()).reshape(3, 2)
    size = np.linalg.norm(bounds[:, 1] - bounds[:, 0])
    depth = bounds.mean(axis=1) @ axes[2]
    centre = (box[0] + box[1]) / 2 * axes[0] + (box[2] + box[3]) / 2 * axes[1] + depth * axes[2]
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(centre + 2 * size * axes[2]))
    camera.SetViewUp(*axes[1])
    camera.SetParallelScale((box[3] - box[2]) / 2)
    renderer.ResetCameraClippingRange()


def draw(job, folder):
    renderer = renderer_of(np.load(os.path.join(folder, job["scene"])))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(2 * job["width"], 2 * job["height"])  # Matplotlib smooths what is too large
    window.AddRenderer(renderer)
    look(renderer, np.array(job["axes"]), job["box"])
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(os.path.join(folder, job["picture"]))
    writer.Write()
    window.Finalize()


if __name__ == "__main__":
    with open(os.path.join(sys.argv[1], "jobs.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            draw(entry, sys.argv[1])
