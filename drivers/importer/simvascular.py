"""The folder that SimVascular exports: a volume and a file of triangles for each face of the model."""
import glob
import os

import numpy as np

from . import vtk_files
from .raw import BadMesh, Tags

EXPECTED = "expected mesh-complete.mesh.vtu and a folder mesh-surfaces with a .vtp for each face"


def volume_file(folder):
    """mesh-complete/mesh-complete.mesh.vtu, in the folder or in its mesh-complete."""
    for inner in (folder, os.path.join(folder, "mesh-complete")):
        named = sorted(glob.glob(os.path.join(inner, "*.mesh.vtu"))) or sorted(glob.glob(os.path.join(inner, "*.vtu")))
        if len(named) > 1:
            raise BadMesh(f"{inner}: {len(named)} volumes ({', '.join(map(os.path.basename, named))}), {EXPECTED}")
        if named:
            return named[0]
    raise BadMesh(f"{folder}: no volume mesh, {EXPECTED}")


def node_numbers(dataset, path):
    """What SimVascular calls a point, in the volume and in the faces alike."""
    numbers = vtk_files.data_of(dataset.GetPointData()).get("GlobalNodeID")
    if numbers is None:
        raise BadMesh(f"{path}: no point array GlobalNodeID, expected that of SimVascular's export "
                      "(mesh-complete), which says which points of the volume these are")
    return numbers.astype(np.int64)


def positions(path, numbers, of_volume, order):
    """Where in the volume the points with these numbers stand."""
    at = np.searchsorted(of_volume, numbers, sorter=order)
    found = order[np.minimum(at, len(order) - 1)]
    missing = of_volume[found] != numbers
    if missing.any():
        raise BadMesh(f"{path}: point {int(np.flatnonzero(missing)[0])} has the GlobalNodeID "
                      f"{int(numbers[missing][0])}, which no point of the volume has. Is the face of another mesh?")
    return found


def check_places(path, points, data, at):
    """A face of an older mesh has numbers that exist, but at other places."""
    away = np.linalg.norm(vtk_files.points_of(data, path) - points[at], axis=1)
    if away.max() > 1e-4 * np.ptp(points, axis=0).max():
        raise BadMesh(f"{path}: the point with GlobalNodeID {int(node_numbers(data, path)[away.argmax()])} is "
                      f"{away.max():.3g} away from that of the volume. Is the face of another mesh?")


def read(folder, region_array=None, surface_array=None):
    """The volume; a surface for each file of mesh-surfaces, with the file's name."""
    path = volume_file(folder)
    faces = sorted(glob.glob(os.path.join(os.path.dirname(path), "mesh-surfaces", "*.vtp")))
    if surface_array:
        raise BadMesh(f"{folder}: --surface-array does not fit a SimVascular folder, whose files name the surfaces")
    if not faces:
        raise BadMesh(f"{os.path.dirname(path)}: no mesh-surfaces/*.vtp, {EXPECTED}")
    raw, grid = vtk_files.read_volume(path, region_array)
    of_volume = node_numbers(grid, path)
    order = np.argsort(of_volume, kind="stable")
    triangles = []
    for face in faces:
        data, own = vtk_files.read_surface(face)
        at = positions(face, node_numbers(data, face), of_volume, order)
        check_places(face, raw.points, data, at)
        triangles.append(at[own])
    names = [os.path.splitext(os.path.basename(face))[0] for face in faces]
    raw.triangles = np.concatenate(triangles)
    raw.surface = Tags(np.repeat(np.arange(len(faces)), [len(t) for t in triangles]),
                       list(range(1, len(faces) + 1)), names)
    raw.path, raw.program = folder, "SimVascular"
    return raw
