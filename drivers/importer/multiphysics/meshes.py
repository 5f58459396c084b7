"""The meshes of solver.xml as one: regions by their domains, surfaces by the names of their faces."""
import dataclasses
import os

import numpy as np

from .. import join, names, order, simvascular, vtk_files
from ..faces import normals
from ..raw import BadMesh, Raw, Tags, check_arrays
from ..summary import sums

FLAT = 0.999  # length of the mean normal of a plane face


@dataclasses.dataclass
class Face:
    """What a condition needs of a surface."""
    field: str     # fluid or wall
    normal: list   # mean, out of its field
    is_flat: bool


@dataclasses.dataclass
class Meshes:
    raw: Raw
    outer: object        # Faces
    fluid_names: list
    domains: dict        # name of the region -> number of the domain
    faces: dict          # name, in solver.xml and in the mesh -> Face, or None on the interface


def read(root, equation, units, notes, tolerance):
    """equation: that of the problem, which says what each domain is."""
    nodes = root.all("Add_mesh")
    parts = [read_one(node, equation, units, notes) for node in nodes]
    refuse_others(root, nodes, [field for _, field in parts])
    parts.sort(key=lambda part: part[1])  # the fluid first
    domains, own = {}, {}
    for raw, field in parts:
        order.settle(raw)
        numbers, own[field] = list(raw.region.ids), list(raw.surface.names)
        join.name_regions(raw, field)
        domains.update(zip(raw.region.names, numbers))
    if len(parts) == 2:
        raw, fluid_names = join.join(parts[0][0], parts[1][0], tolerance)
    else:
        names.settle(raw.region, "region")
        fluid_names = list(raw.region.names) if field == "fluid" else []
    outer = order.finish(raw, fluid_names, None)
    names.settle(raw.surface, "surface")
    return Meshes(raw, outer, fluid_names, domains, faces_of(raw, outer, own))


def refuse_others(root, nodes, fields):
    found = ", ".join(f'"{node.name()}" ({field})' for node, field in zip(nodes, fields)) or "none"
    if sorted(fields) not in (["fluid"], ["wall"], ["fluid", "wall"]):
        raise BadMesh(f"{root.file}: Add_mesh: {found}, expected one mesh of the fluid, one of the wall, or both. Join others "
                      "before, in SimVascular")
    seen = {}
    for node in nodes:
        for face in node.all("Add_face"):
            if face.name() in seen:
                raise BadMesh(f'{root.file}: {face.place}: the name "{face.name()}" is also that of a face of '
                              f"{seen[face.name()]}, expected one for each")
            seen[face.name()] = node.title


def read_one(node, equation, units, notes):
    """(mesh in mm, its field)"""
    faces = [(face.name(), face.path("Face_file_path")) for face in node.all("Add_face")]
    raw = simvascular.read_files(node.path("Mesh_file_path"), faces, None)
    check_arrays(raw)
    raw.points = raw.points * (units.length * node.number("Mesh_scale_factor", 1.0))
    raw.region = Tags.of_numbers(domain_numbers(node, raw))
    fields = {equation.field_of(number, node) for number in raw.region.ids}
    if len(fields) > 1:
        raise BadMesh(f"{node.file}: {node.place}: holds domains of the fluid and of the wall, expected a mesh for each")
    directions = fibres(node, raw)
    if directions:
        raw.vectors = {"fibre 1": directions[0], "fibre 2": directions[1]}
    return raw, fields.pop()


def domain_numbers(node, raw):
    if not node.has("Domain_file_path"):
        return np.full(len(raw.tets), node.count("Domain", 0))
    node.skip("Domain")
    path = node.path("Domain_file_path")
    if path.lower().endswith((".vtu", ".vtp", ".vtk")):
        numbers = cell_array(path, "DOMAIN_ID")
    else:
        try:
            numbers = np.loadtxt(path, dtype=float, ndmin=1).reshape(-1)
        except ValueError as error:
            raise BadMesh(f"{path}: cannot be read as a number for each element: {error}") from None
    if len(numbers) != len(raw.tets):
        raise BadMesh(f"{path}: {len(numbers):,} numbers of domains, expected one for each of the {len(raw.tets):,} tetrahedra of "
                      f"{os.path.basename(raw.path)}")
    return numbers


def cell_array(path, name):
    grid = vtk_files.read_grid(path)
    values = vtk_files.data_of(grid.GetCellData())
    if name not in values:
        raise BadMesh(f'{path}: no cell array "{name}", expected a value for each element')
    is_tet = vtk_files.cell_types(grid) == vtk_files.TETRA
    return values[name][is_tet]


def fibres(node, raw):
    """Two unit vectors for each tetrahedron, or none."""
    vectors = [np.tile(found.as_vector(), (len(raw.tets), 1)) for found in node.all("Fiber_direction")]
    vectors += [cell_array(found.as_path(), "FIB_DIR").astype(float) for found in node.all("Fiber_direction_file_path")]
    for values in vectors:
        length = np.linalg.norm(values, axis=1) if values.shape == (len(raw.tets), 3) else np.zeros(1)
        if not (length > 0.0).all():
            raise BadMesh(f"{node.file}: {node.place}: directions of fibres, expected three numbers, not all zero, for each of "
                          f"{len(raw.tets):,} tetrahedra")
    return [values / np.linalg.norm(values, axis=1)[:, None] for values in vectors[:2]] if len(vectors) >= 2 else []


def faces_of(raw, outer, own):
    """What is on the interface is gone. own: field -> names, of which none is another's, as refuse_others() sees to."""
    vectors = outward(raw, outer)
    found = {}
    for field, given in own.items():
        for name in given:
            if name in raw.surface.names:
                mean = vectors[raw.surface.names.index(name)]
                length = float(np.linalg.norm(mean))  # zero of a surface that closes upon itself, like a wall's outer side
                found[name] = Face(field, (mean / max(length, np.finfo(float).tiny)).tolist(), length > FLAT)
            else:
                found[name] = None
    return found


def outward(raw, outer):
    """Mean normal of each surface, its length 1 where it is plane."""
    corners = outer.outward[outer.find(raw.triangles)]
    vector = normals(raw.points, corners)
    *total, area = (sums(raw.surface.of, values, len(raw.surface.names)) for values in (*vector.T, np.linalg.norm(vector, axis=1)))
    return np.stack(total, axis=1) / area[:, None]
