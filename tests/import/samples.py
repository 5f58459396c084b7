"""Small meshes of known volumes and areas, and the files of other programs that hold them."""
import itertools
import os

import h5py
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

SIDES = ("x_low", "x_high", "y_low", "y_high")


class Column:
    """1 x 1 x 2 of cells of six tetrahedra each: region 1 below z = 1, region 2 above.

    Volume 1 each, area 10 outside and 1 between them.
    """

    def __init__(self, cells=3):
        n = np.array([cells, cells, 2 * cells])
        grid = np.stack(np.meshgrid(*[np.arange(m + 1) for m in n], indexing="ij"), axis=-1).reshape(-1, 3)
        self.points = grid / cells
        corner = grid[(grid < n).all(axis=1)]
        tets = []
        for order in itertools.permutations(range(3)):  # the way from one corner of a cell to the opposite one
            way = np.cumsum([np.zeros(3, dtype=int)] + [np.eye(3, dtype=int)[k] for k in order], axis=0)
            is_even = np.linalg.det(np.eye(3)[list(order)]) > 0
            way = way if is_even else way[[0, 1, 3, 2]]
            tets.append(np.stack([self.number(corner + step, n) for step in way], axis=1))
        self.tets = np.concatenate(tets)
        self.region = 1 + (self.points[self.tets].mean(axis=1)[:, 2] > 1)

    @staticmethod
    def number(at, n):
        return (at[:, 0] * (n[1] + 1) + at[:, 1]) * (n[2] + 1) + at[:, 2]

    def part(self, region):
        """(points, tets) of a region alone."""
        used, tets = np.unique(self.tets[self.region == region], return_inverse=True)
        return self.points[used], tets.reshape(-1, 4)


def flat_faces(points, tets):
    """Name -> triangles of the faces on planes of the box about the points."""
    low, high = points.min(axis=0), points.max(axis=0)
    faces = np.concatenate([tets[:, list(c)] for c in itertools.combinations(range(4), 3)])
    found = {}
    for axis, letter in enumerate("xyz"):
        for name, value in ((letter + "_low", low[axis]), (letter + "_high", high[axis])):
            found[name] = faces[(np.abs(points[faces][:, :, axis] - value) < 1e-12).all(axis=1)]
    return found


def cells_of(elements):
    """vtkCellArray of elements of one kind or several."""
    array = vtkCellArray()
    sizes = np.concatenate([np.full(len(e), e.shape[1]) for e in elements])
    flat = np.concatenate([np.ravel(e) for e in elements])
    array.SetData(numpy_to_vtkIdTypeArray(np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64), deep=1),
                  numpy_to_vtkIdTypeArray(flat.astype(np.int64), deep=1))
    return array


def add(data, points, of_points, of_cells):
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    data.SetPoints(places)
    for attributes, arrays in ((data.GetPointData(), of_points), (data.GetCellData(), of_cells)):
        for name, values in (arrays or {}).items():
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
            array.SetName(name)
            attributes.AddArray(array)


def grid_of(points, elements, of_points=None, of_cells=None):
    """vtkUnstructuredGrid. elements: (VTK's type, vertices) each."""
    grid = vtkUnstructuredGrid()
    types = np.concatenate([np.full(len(e), kind) for kind, e in elements]).astype(np.uint8)
    add(grid, points, of_points, of_cells)
    grid.SetCells(numpy_to_vtk(types, deep=1), cells_of([e for _, e in elements]))
    return grid


def write_vtu(path, *content, mode="appended zlib", **arrays):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(content[0] if len(content) == 1 else grid_of(*content, **arrays))
    return write(writer, path, mode)


def write_vtp(path, points, triangles, of_points=None, of_cells=None):
    data = vtkPolyData()
    add(data, points, of_points, of_cells)
    data.SetPolys(cells_of([triangles]))
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    return write(writer, path, "appended zlib")


def write(writer, path, mode):
    encoding, compressor = mode.split()
    writer.SetFileName(str(path))
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary,
     "appended": writer.SetDataModeToAppended}[encoding]()
    if compressor == "zlib":
        writer.SetCompressorTypeToZLib()
    else:
        writer.SetCompressorTypeToNone()
    writer.Write()
    return str(path)


def write_simvascular(folder, points, tets, faces, seed=1):
    """mesh-complete: points in another order, which only GlobalNodeID tells. faces: name -> triangles."""
    os.makedirs(os.path.join(folder, "mesh-complete", "mesh-surfaces"))
    shuffled = np.random.default_rng(seed).permutation(len(points))
    new = np.argsort(shuffled)
    write_vtu(os.path.join(folder, "mesh-complete", "mesh-complete.mesh.vtu"), points[shuffled],
              [(10, new[tets])], of_points={"GlobalNodeID": (shuffled + 1).astype(np.int32)},
              of_cells={"GlobalElementID": np.arange(1, len(tets) + 1, dtype=np.int32),
                        "ModelRegionID": np.ones(len(tets), dtype=np.int32)})
    for number, (name, triangles) in enumerate(faces.items(), 1):
        used, own = np.unique(triangles, return_inverse=True)
        write_vtp(os.path.join(folder, "mesh-complete", "mesh-surfaces", name + ".vtp"), points[used],
                  own.reshape(-1, 3), of_points={"GlobalNodeID": (used + 1).astype(np.int32)},
                  of_cells={"ModelFaceID": np.full(len(triangles), number, dtype=np.int32)})
    return str(folder)


def write_gmsh_41_binary(path, points, blocks):
    """As Gmsh writes it. blocks: (dimension, physical groups, name or None, vertices) each, an entity of its own."""
    def raw(*values):  # integers of C, as numbers; sizes, as lists
        return b"".join(np.array(v, dtype=np.uint64 if isinstance(v, list) else np.int32).tobytes() for v in values)

    entities = {d: b"" for d in (2, 3)}
    elements, last = b"", 0
    for k, (dimension, groups, _, cells) in enumerate(blocks, 1):
        entities[dimension] += raw(k) + np.zeros(6).tobytes() + raw([len(groups)], *groups, [0])
        numbered = np.column_stack([np.arange(last + 1, last + 1 + len(cells)), cells + 1])
        elements += raw(dimension, k, {2: 2, 3: 4}[dimension], [len(cells)]) + numbered.astype(np.uint64).tobytes()
        last += len(cells)
    sizes = [sum(b[0] == d for b in blocks) for d in range(4)]
    names = dict.fromkeys(f'{d} {groups[0]} "{name}"' for d, groups, name, _ in blocks if name)
    count = len(points)
    with open(path, "wb") as file:
        file.write(b"$MeshFormat\n4.1 1 8\n" + raw(1) + b"\n$EndMeshFormat\n")
        file.write("\n".join(["$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames", ""]).encode())
        file.write(b"$Entities\n" + raw(sizes) + entities[2] + entities[3] + b"\n$EndEntities\n")
        file.write(b"$Nodes\n" + raw([1, count, 1, count], 3, 1, 0, [count], list(range(1, count + 1))) +
                   np.ascontiguousarray(points).tobytes() + b"\n$EndNodes\n")
        file.write(b"$Elements\n" + raw([len(blocks), last, 1, last]) + elements + b"\n$EndElements\n")


class Mesh:
    """What tunica-import has written."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.vertices, self.tets, self.triangles = (file[n][:] for n in ("vertices", "tets", "triangles"))
            self.tet_region, self.triangle_surface = file["tet_region"][:], file["triangle_surface"][:]
            self.regions, self.surfaces = ([n.decode() for n in file[k + "_names"][:]] for k in ("region", "surface"))
            self.ids = file["region_ids"][:].tolist(), file["surface_ids"][:].tolist()
            self.vectors = file["tet_vectors"][:] if "tet_vectors" in file else None

    def volumes(self):
        a, b, c, d = (self.vertices[self.tets[:, i]] for i in range(4))
        each = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6
        assert each.min() > 0
        return {name: each[self.tet_region == k].sum() for k, name in enumerate(self.regions)}

    def areas(self):
        a, b, c = (self.vertices[self.triangles[:, i]] for i in range(3))
        each = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        return {name: each[self.triangle_surface == k].sum() for k, name in enumerate(self.surfaces)}
