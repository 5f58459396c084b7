"""Reads the surface of a lumen: STL, VTP, PLY, OBJ, legacy VTK."""
import os

import numpy as np

from importer import arrays
from importer.raw import BadMesh
from importer.vtk_files import data_of, legend_of, points_of, to_numpy, updated, vtk

from . import face_names
from .surface import Surface

READERS = {".stl": ("vtkIOGeometry", "vtkSTLReader"), ".obj": ("vtkIOGeometry", "vtkOBJReader"),
           ".ply": ("vtkIOPLY", "vtkPLYReader"), ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
           ".vtk": ("vtkIOLegacy", "vtkPolyDataReader")}
OF_FACES = ("ModelFaceID", "surface", "CellEntityIds", "CapID")


def read(path, of_faces=None):
    """Points of the file, triangles of its polygons. of_faces: names of its faces by their numbers, if not those of the file."""
    kind = os.path.splitext(path)[1].lower()
    if os.path.isdir(path) or not os.path.exists(path):
        raise BadMesh(f"{path}: there is no such file" + near_file(path))
    if kind not in READERS:
        raise BadMesh(f'{path}: the ending is "{kind}", expected {", ".join(sorted(READERS))}, a surface of '
                      "triangles")
    module, name = READERS[kind]
    data = updated(getattr(vtk(module), name)(), path)
    data.BuildCells()
    cells = to_numpy(data.GetPolys().GetConnectivityArray()).astype(np.int64)
    sizes = np.diff(to_numpy(data.GetPolys().GetOffsetsArray()).astype(np.int64))
    if not len(sizes):
        raise BadMesh(f"{path}: holds no triangles or other polygons, expected the surface of a lumen")
    triangles, owner = triangulated(cells, sizes)
    face, names = faces_of(data, path, owner)
    if of_faces and face is None:
        raise BadMesh(f"{path}: its faces have no numbers, expected a cell array {', '.join(OF_FACES[:-1])} or {OF_FACES[-1]}, to "
                      "which the names of --names belong")
    names = of_faces or names
    points = points_of(data, path)
    if not np.isfinite(points).all():
        first = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise BadMesh(f"{path}: point {first} has a coordinate that is not a finite number")
    return Surface(points, triangles, face, names)


def near_file(path):
    import difflib
    folder = os.path.dirname(path) or "."
    names = [name for name in os.listdir(folder) if name.lower().endswith(tuple(READERS))] if os.path.isdir(folder) else []
    near = difflib.get_close_matches(os.path.basename(path), names, 1)
    return f'. Did you mean "{os.path.join(os.path.dirname(path), near[0])}"?' if near else ""


def triangulated(cells, sizes):
    """Polygons cut from their first corner; the polygon of each triangle."""
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    owner = np.repeat(np.arange(len(sizes)), np.maximum(sizes - 2, 0))
    step = np.arange(len(owner)) - np.repeat(np.cumsum(np.maximum(sizes - 2, 0)) - np.maximum(sizes - 2, 0),
                                             np.maximum(sizes - 2, 0))
    at = first[owner]
    return np.stack([cells[at], cells[at + step + 1], cells[at + step + 2]], axis=1), owner


def faces_of(data, path, owner):
    """The number of the face at each triangle, and the names that the file, or another beside it, has for them."""
    values = data_of(data.GetCellData())
    name = next((n for n in OF_FACES if n in values and arrays.is_number(values[n])), None)
    if name is None:
        return None, {}
    before = data.GetNumberOfVerts() + data.GetNumberOfLines()  # cells of a polydata: these come first
    face = np.asarray(values[name]).reshape(-1)[before + owner].astype(np.int64)
    in_file = names_in(data, name) or (legend_of(path)["surface"] if path.endswith(".vtp") else {})
    return face, in_file or (face_names.beside(path) if name == "ModelFaceID" else {})


def names_in(data, name):
    """A text array beside the numbers: one text per cell, or in the field data one per number from 1 on."""
    cells, fields = data.GetCellData(), data.GetFieldData()
    for label in (name + "Names", "ModelFaceNames", "FaceNames", "surface_names"):
        texts = cells.GetAbstractArray(label)
        if texts is not None:
            numbers = to_numpy(cells.GetArray(name))
            return {int(numbers[i]): texts.GetValue(int(i)) for i in np.unique(numbers, return_index=True)[1]}
        texts = fields.GetAbstractArray(label)
        if texts is not None:
            return {i + 1: texts.GetValue(i) for i in range(texts.GetNumberOfValues())}
    return {}
