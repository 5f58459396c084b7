"""The folder that SimVascular exports: a volume and a file of triangles for each face of the model."""
import glob
import os

import numpy as np

from . import places, vtk_files
from .faces import show
from .raw import BadMesh, Tags

NEAR = 1e-5  # of the extent: points of face and volume at the same place, in single precision or six digits
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


def face_files(path):
    """(name, file) of each face of the model, in the folder mesh-surfaces beside a file."""
    files = sorted(glob.glob(os.path.join(os.path.dirname(path), "mesh-surfaces", "*.vtp")))
    return [(os.path.splitext(os.path.basename(file))[0], file) for file in files]


def node_numbers(dataset):
    """What SimVascular calls a point, in the volume and in the faces alike; None where the file does not say."""
    numbers = vtk_files.data_of(dataset.GetPointData()).get("GlobalNodeID")
    return None if numbers is None else numbers.astype(np.int64)


class Volume:
    """Where the points of a face are among those of the volume."""

    def __init__(self, points, numbers):
        self.points, self.numbers = points, numbers
        self.order = None if numbers is None else np.argsort(numbers, kind="stable")
        self.near = NEAR * np.ptp(points, axis=0).max()
        self.by_place = []  # faces whose numbers are of no use, and why

    def by_numbers(self, numbers, points):
        """None with the reason where they are not those of the volume, of points at the same places."""
        if numbers is None or self.numbers is None:
            return None, "no GlobalNodeID"
        at = np.searchsorted(self.numbers, numbers, sorter=self.order)
        found = self.order[np.minimum(at, len(self.order) - 1)]
        if (self.numbers[found] != numbers).any():
            return None, "a GlobalNodeID that no point of the volume has"
        if np.linalg.norm(points - self.points[found], axis=1).max() > self.near:
            return None, "a GlobalNodeID of a point elsewhere"
        return found, ""

    def at(self, path, numbers, points):
        found, reason = self.by_numbers(numbers, points)
        if found is not None and len(np.unique(found)) == len(found):
            return found
        pairs = places.pairs_within(points, self.points, self.near)
        of_face, at = np.unique(pairs[:, 0]), np.full(len(points), -1)
        if len(of_face) < len(points):
            away = int(np.setdiff1d(np.arange(len(points)), of_face)[0])
            distance = np.linalg.norm(self.points - points[away], axis=1).min()
            raise BadMesh(f"{path}: point {away}, at {show(points[away])}, is {distance:.3g} away from all of the "
                          f"volume, and the file has {reason or 'points twice'}. Is the face of another mesh? Export "
                          "both at once")
        nearest = np.lexsort((np.linalg.norm(points[pairs[:, 0]] - self.points[pairs[:, 1]], axis=1), pairs[:, 0]))
        first = np.unique(pairs[nearest, 0], return_index=True)[1]
        at[pairs[nearest][first, 0]] = pairs[nearest][first, 1]
        self.by_place.append((os.path.basename(path), reason or "points twice"))
        return at


def check_corners(path, triangles):
    again = np.flatnonzero((np.diff(np.sort(triangles, axis=1), axis=1) == 0).any(axis=1))
    if len(again):
        raise BadMesh(f"{path}: triangle {int(again[0])} has a vertex more than once, expected three. Does it hold "
                      "points twice at the same place, or triangles without an area? Clean it, or mesh anew")


def read(folder, region_array=None, surface_array=None):
    """The volume; a surface for each file of mesh-surfaces, with the file's name."""
    path = volume_file(folder)
    faces = face_files(path)
    if surface_array:
        raise BadMesh(f"{folder}: --surface-array does not fit a SimVascular folder, whose files name the surfaces")
    if not faces:
        raise BadMesh(f"{os.path.dirname(path)}: no mesh-surfaces/*.vtp, {EXPECTED}")
    raw = read_files(path, faces, region_array)
    raw.path = folder
    return raw


def read_files(path, faces, region_array=None):
    """The volume; a surface for each of the faces, (name, file)."""
    raw, grid = vtk_files.read_volume(path, region_array)
    volume = Volume(raw.points, node_numbers(grid))
    triangles = [np.zeros((0, 3), dtype=np.int64)]
    for _, file in faces:
        data, own = vtk_files.read_surface(file)
        at = volume.at(file, node_numbers(data), vtk_files.points_of(data, file))
        triangles.append(at[own])
        check_corners(file, triangles[-1])
    if volume.by_place:
        raw.note("the points of " + ", ".join(name for name, _ in volume.by_place) + " were found by their places: "
                 f"the file has {volume.by_place[0][1]}")
    raw.triangles = np.concatenate(triangles)
    raw.surface = Tags(np.repeat(np.arange(len(faces)), [len(t) for t in triangles[1:]]),
                       list(range(1, len(faces) + 1)), [name for name, _ in faces])
    raw.program = "SimVascular"
    return raw
