"""Which reader a file or folder is for."""
import os

from . import meshio_files, simvascular, tunica_file, vtk_files
from .raw import BadMesh, check_arrays

BY_VTK = {".vtu": vtk_files.read_vtu, ".vtk": vtk_files.read_vtu}
EXODUS = (".e", ".exo", ".ex2", ".exii")


def read(path, region_array=None, surface_array=None):
    """A Raw mesh, in the file's unit; its numbers make sense."""
    raw = read_any(path, region_array, surface_array)
    check_arrays(raw)
    return raw


def read_any(path, region_array, surface_array):
    if os.path.isdir(path):
        return simvascular.read(path.rstrip("/") or path, region_array, surface_array)
    if not os.path.isfile(path):
        raise BadMesh(f"{path}: there is no such file or folder")
    ending = os.path.splitext(path)[1].lower()
    if ending in BY_VTK:
        return BY_VTK[ending](path, region_array, surface_array)
    if ending in EXODUS:
        return vtk_files.read_exodus(path)
    if ending == ".vtp":
        vtk_files.read_surface(path)  # says what is wrong with it, if something is
        raise BadMesh(f"{path}: a surface without a volume, expected the .vtu of the volume, or the folder that has "
                      "both (SimVascular)")
    if ending == ".h5":
        return tunica_file.read(path)
    return meshio_files.read(path, region_array, surface_array)
