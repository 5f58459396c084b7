"""Meshes with twice as many elements along each axis, and how coarse one is against another."""
import os

import numpy as np

from vessel.errors import BadInput, nearest
from vessel.folder import read_json, write_json
from vessel.mesh_file import Mesh

from .rounding import rounded

ROUND = 1e-5  # part of its radius by which a cylinder may differ from one
FLAT = 1e-9   # of the unit normals


class Surfaces:
    """Which surfaces of a mesh are cylinders about the z axis, which are flat, and which are neither."""

    def __init__(self, mesh):
        self.cylinders, self.flat, self.others = [], [], []
        for name in mesh.surfaces:
            triangles = mesh.triangles_of(name)
            if len(triangles):
                self._kind(mesh, triangles).append(name)

    def _kind(self, mesh, triangles):
        vectors = mesh.area_vectors(triangles)
        normals = vectors / np.linalg.norm(vectors, axis=1)[:, None]
        if np.abs(np.abs(normals @ normals[0]) - 1).max() < FLAT:
            return self.flat
        radii = np.hypot(*mesh.vertices[np.unique(triangles)][:, :2].T)
        return self.cylinders if np.ptp(radii) <= ROUND * radii.max() and abs(normals[:, 2]).max() < 0.5 else self.others


def as_hdf5(path, folder, programs, log):
    """The mesh in Tunica's own format, converted where it has another one."""
    if path.endswith(".h5"):
        return path
    converted = os.path.join(folder, "case.h5")
    if not os.path.exists(converted):
        programs.must(["tunica-mesh", "convert", path, converted], log)
    return converted


def refined(path, target, smooth, programs, log):
    """Makes the file target, once: every tetrahedron in eight, new vertices of cylinders on them, of smooth surfaces on paraboloids
    through the vertices. Returns remarks."""
    surfaces = Surfaces(Mesh(path))
    words = ["tunica-mesh", "refine", path, target + ".part.h5", "--overwrite", "on"]
    rounding = [name for name in surfaces.others if name in smooth]
    faceted = [name for name in surfaces.others if name not in smooth]
    told = target + ".json"  # outlives this process, as the mesh does
    if not os.path.exists(target):
        write_json(told, _refine(words, target, rounding, surfaces, programs, log))
        os.replace(target + ".part.h5", target)
    remarks = read_json(told)
    if faceted:
        remarks.append(f"No geometry is known of {', '.join(faceted)}: refined, they keep their facets. The error of the mesh is "
                       "that of the equations on this shape, without that of the shape itself. Where they are smooth, name them with --smooth.")
    return remarks


def count(path):
    return len(Mesh(path).tets)


def relative_size(path, of_case):
    """Of the elements against those of the case, from the numbers of tetrahedra; 2 is twice as coarse."""
    return (count(of_case) / count(path)) ** (1 / 3)


def _refine(words, target, rounding, surfaces, programs, log):
    remarks, path = [], words[2]
    cylinders = ["--project", ",".join(surfaces.cylinders)] if surfaces.cylinders else []
    if programs.run(words + cylinders, log) != 0:
        remarks.append(f"The cylinders {', '.join(surfaces.cylinders)} could not be rounded without inverted elements: the error of the "
                       "mesh lacks that of its shape.")
        programs.must(words, log)
    held = rounded(path, target + ".part.h5", rounding, surfaces.flat) if rounding else 0
    if held:
        remarks.append(f"{os.path.basename(target)}: {held} vertices stay near the facets: beyond, elements would be inverted.")
    return remarks


def smooth_names(text, mesh):
    """Those of --smooth, which the mesh has to have."""
    names, there = [word.strip() for word in (text or "").split(",") if word.strip()], Mesh(mesh).surfaces
    for name in names:
        if name not in there:
            raise BadInput(f"--smooth {name}: {mesh} has no such surface. {nearest(name, there)}")
    return names


def check_same_names(path, of_case):
    """A mesh that a user gives has the regions and surfaces of the case."""
    one, other = Mesh(path), Mesh(of_case)
    for what in ("regions", "surfaces"):
        lacking = set(getattr(other, what)) - set(getattr(one, what))
        if lacking:
            raise BadInput(f"{path}: lacks the {what[:-1]} \"{sorted(lacking)[0]}\" of {of_case}; it has "
                           + ", ".join(getattr(one, what)))
