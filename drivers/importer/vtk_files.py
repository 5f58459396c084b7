"""Meshes by VTK's own readers: VTU, VTP, legacy VTK, Exodus."""
import contextlib
import os
import re
import sys

import numpy as np

from . import arrays
from .raw import BadMesh, Raw, Tags, check_shapes

SHAPES = {0: "empty", 1: "vertex", 2: "vertex", 3: "line", 4: "line", 5: "triangle", 6: "strip", 7: "polygon",
          8: "pixel", 9: "quadrilateral", 10: "tetra", 11: "voxel", 12: "hexahedron", 13: "prism", 14: "pyramid",
          21: "line", 22: "triangle6", 24: "tetra10", 35: "line", 42: "polyhedron", 68: "line",
          69: "triangle (Lagrange)", 71: "tetra (Lagrange)", 76: "triangle (Bezier)", 78: "tetra (Bezier)"}
TETRA, TRIANGLE = 10, 5
LEGEND = re.compile(r"(region|surface) (\d+) (.*?)(?= (?:region|surface) \d+ |$)")


def vtk(module):
    """Loaded when needed: --help and other formats do without VTK."""
    try:
        return __import__("vtkmodules." + module, fromlist=["vtk"])
    except ImportError as error:
        raise BadMesh(f"this format needs VTK for Python, in Debian the package python3-vtk9 ({error})") from error


@contextlib.contextmanager
def quiet():
    """VTK's logger and its Exodus library write to the stream itself, behind Python's back."""
    sys.stderr.flush()
    before = os.dup(2)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(before, 2)
        os.close(before)


def updated(reader, path):
    """The output of a reader; what it complains of, which VTK only prints, is an error."""
    core = vtk("vtkCommonCore")
    if not os.path.isfile(path):
        raise BadMesh(f"{path}: there is no such file")
    log, before = core.vtkStringOutputWindow(), core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(log)
    try:
        with quiet():
            reader.SetFileName(path)
            reader.Update()
    finally:
        core.vtkOutputWindow.SetInstance(before)
    complaints = re.findall(r"ERROR:.*?\n(.*?)\n\s*\n", log.GetOutput() + "\n\n", re.S)
    output = reader.GetOutput()
    if complaints or output is None:
        said = re.sub(r"^.*?\(0x[0-9a-f]+\): ", "", " ".join((complaints or ["nothing is in it"])[0].split()))
        raise BadMesh(f"{path}: VTK cannot read it, so it is damaged or of another format: {said}")
    return output


def to_numpy(values):
    return vtk("util.numpy_support").vtk_to_numpy(values)


def points_of(dataset, path):
    if not dataset.GetNumberOfPoints():
        raise BadMesh(f"{path}: holds no points, expected the vertices of a mesh")
    return to_numpy(dataset.GetPoints().GetData()).astype(float)


def data_of(attributes):
    """Name -> values of the numeric arrays."""
    found = (attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays()))
    return {a.GetName(): to_numpy(a) for a in found if a is not None and a.GetName()}


def connectivity_of(cells, chosen, corners):
    """Vertices of the chosen cells, each of which has so many corners."""
    offsets = to_numpy(cells.GetOffsetsArray())[chosen]
    connectivity = to_numpy(cells.GetConnectivityArray())
    if len(offsets) and (offsets.min() < 0 or offsets.max() + corners > len(connectivity)):
        raise BadMesh("offsets of cells point beyond their connectivity: the file is damaged")
    return connectivity[offsets[:, None] + np.arange(corners)].astype(np.int64).reshape(-1, corners)


def count_shapes(types):
    counts = {}
    for kind, n in zip(*np.unique(types, return_counts=True)):
        shape = SHAPES.get(int(kind), f"cells of VTK's type {int(kind)}")
        counts[shape] = counts.get(shape, 0) + int(n)
    return counts


def cell_types(grid):
    return to_numpy(grid.GetCellTypesArray()) if grid.GetNumberOfCells() else np.zeros(0, dtype=np.uint8)


def read_grid(path):
    """A vtkUnstructuredGrid, whatever the file's encoding."""
    if path.lower().endswith(".vtk"):
        return updated(vtk("vtkIOLegacy").vtkUnstructuredGridReader(), path)
    return updated(vtk("vtkIOXML").vtkXMLUnstructuredGridReader(), path)


def legend_of(path):
    """Names by number that tunica-mesh writes into a comment: VTU has no place for them."""
    with open(path, "rb") as file:
        comment = re.search(r"<!-- (.*?) -->", file.read(1 << 16).decode("utf-8", "replace"), re.S)
    names = {"region": {}, "surface": {}}
    for kind, number, name in LEGEND.findall(comment[1] if comment else ""):
        names[kind][int(number)] = name
    return names


def read_volume(path, region_array=None, surface_array=None):
    """A grid of tetrahedra, with triangles or without."""
    grid = read_grid(path)
    types = cell_types(grid)
    check_shapes(path, count_shapes(types))
    tets, triangles = (np.flatnonzero(types == kind) for kind in (TETRA, TRIANGLE))
    cell_data, names = data_of(grid.GetCellData()), legend_of(path)
    of_region = arrays.chosen(path, cell_data, region_array, arrays.OF_REGIONS, "--region-array")
    of_surface = arrays.chosen(path, cell_data, surface_array, arrays.OF_SURFACES, "--surface-array")
    return Raw(path, points_of(grid, path),
               connectivity_of(grid.GetCells(), tets, 4), arrays.tags_of(cell_data, of_region, tets, names["region"]),
               connectivity_of(grid.GetCells(), triangles, 3),
               arrays.tags_of(cell_data, of_surface, triangles, names["surface"]),
               arrays.vectors_of(cell_data, tets)), grid


def read_vtu(path, region_array=None, surface_array=None):
    return read_volume(path, region_array, surface_array)[0]


def read_surface(path):
    """Triangles of a VTP: the polydata and their vertices, in its own numbers."""
    data = updated(vtk("vtkIOXML").vtkXMLPolyDataReader(), path)
    polygons = data.GetPolys()
    sizes = np.diff(to_numpy(polygons.GetOffsetsArray())) if polygons.GetNumberOfCells() else np.zeros(0)
    wrong = int((sizes != 3).sum()) + data.GetNumberOfStrips()
    if wrong or not len(sizes):
        raise BadMesh(f"{path}: {wrong:,} polygons or strips that are no triangles, {len(sizes) - wrong:,} triangles; "
                      "expected the triangles of a face, and these alone")
    return data, connectivity_of(polygons, np.arange(len(sizes)), 3)


def read_exodus(path):
    """Element blocks are regions, side sets are surfaces; both have names there."""
    exodus = vtk("vtkIOExodus").vtkExodusIIReader
    reader = exodus()
    reader.SetFileName(path)
    with quiet():
        is_readable = os.path.isfile(path) and reader.CanReadFile(path)
        if is_readable:
            reader.UpdateInformation()
    if not is_readable:
        raise BadMesh(f"{path}: not an Exodus file that VTK can read")
    reader.SetSqueezePoints(False)  # so that blocks and side sets count the same points
    for k in range(reader.GetNumberOfSideSetArrays()):
        reader.SetSideSetArrayStatus(reader.GetSideSetArrayName(k), 1)
    parts = updated(reader, path)
    blocks = exodus_parts(reader, parts, exodus.ELEM_BLOCK, 0)
    sides = exodus_parts(reader, parts, exodus.SIDE_SET, 4)
    counts = {}
    for _, _, grid in blocks:
        for shape, n in count_shapes(cell_types(grid)).items():
            counts[shape] = counts.get(shape, 0) + n
    check_shapes(path, counts)
    tets, region = stacked(blocks, TETRA, 4)
    triangles, surface = stacked(sides, TRIANGLE, 3)
    return Raw(path, points_of(blocks[0][2], path), tets, region, triangles, surface)


def exodus_parts(reader, parts, kind, position):
    """(number, name or None, grid) of each block or side set that holds cells."""
    branch, found = parts.GetBlock(position), []
    for i in range(branch.GetNumberOfBlocks() if branch else 0):
        grid = branch.GetBlock(i)
        if grid is not None and grid.GetNumberOfCells():
            name = reader.GetObjectName(kind, i).split(" Size: ")[0]
            found.append((reader.GetObjectId(kind, i), None if name.startswith("Unnamed") else name, grid))
    return found


def stacked(parts, kind, corners):
    """The cells of a kind of all parts, and of which part each is."""
    cells, numbers = [np.zeros((0, corners), dtype=np.int64)], [np.zeros(0, dtype=np.int64)]
    for number, _, grid in parts:
        chosen = np.flatnonzero(cell_types(grid) == kind)
        if len(chosen):
            cells.append(connectivity_of(grid.GetCells(), chosen, corners))
            numbers.append(np.full(len(chosen), number))
    names = {number: name for number, name, _ in parts if name}
    return np.concatenate(cells), Tags.of_numbers(np.concatenate(numbers), names)
