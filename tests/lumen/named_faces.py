"""A closed tube whose faces have numbers, as CAD and SimVascular have it: 1 the wall, 2 and 3 the caps at z = 0 and 30."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from lumen.target import polydata


def triangles(n=24):
    """(points, triangles of each face): triangles as long as the vessel."""
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.stack([3.0 * np.cos(angle), 3.0 * np.sin(angle), np.zeros(n)], 1)
    i, j = np.arange(n), (np.arange(n) + 1) % n
    parts = [[(i, j, i + n), (j, j + n, i + n)], [(j, i, 0 * i + 2 * n)], [(i + n, j + n, 0 * i + 2 * n + 1)]]
    return (np.vstack([ring, ring + [0, 0, 30.0], [[0, 0, 0], [0, 0, 30.0]]]),
            [np.concatenate([np.stack(part, axis=1) for part in face]) for face in parts])


def write(path, faces=(0, 1, 2), array="ModelFaceID", numbers=(1, 2, 3), texts=()):
    points, parts = triangles()
    data = polydata(points, np.concatenate([parts[k] for k in faces]))
    of_cells = numpy_to_vtk(np.repeat([numbers[k] for k in faces], [len(parts[k]) for k in faces]), deep=True)
    of_cells.SetName(array)
    data.GetCellData().AddArray(of_cells)
    if texts:
        names = vtkStringArray()
        names.SetName("ModelFaceNames")
        for text in texts:
            names.InsertNextValue(text)
        data.GetFieldData().AddArray(names)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.Write()
    return path


def write_model(path, names):
    """As SimVascular writes it, with two outermost elements."""
    faces = "".join(f'      <face id="{k}" name="{name}" type="cap" visible="true" />\n' for k, name in names.items())
    with open(path, "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0" encoding="UTF-8" ?>\n<format version="1.0" />\n<model type="PolyData">\n'
                   f'  <timestep id="0">\n    <faces>\n{faces}    </faces>\n  </timestep>\n</model>\n')
    return path
