"""Walls that tunica-mesh grows on a fork, a bend, a bulge, and on these with the noise of a segmentation: by NumPy no element
is turned inside out, elements meet face to face, and the least angle is the one that is told; without noise it is the
wall of the shipped mesh.

Usage: grown_walls.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import re
import sys

import h5py
import numpy as np

from runs import ROOT, Run, Verdict, command, fresh

LAYERS = {"media": (0.3, 2), "adventitia": (0.15, 1)}  # mm, elements through it
WANTED = ",".join(f"{name}={thickness}:{count}" for name, (thickness, count) in LAYERS.items())
ARRAYS = ("vertices", "tets", "tet_region", "triangles", "triangle_surface")
NOISE = 0.03  # mm, of the lumen's wall
FACES = np.array([(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)])


class Mesh:
    def __init__(self, path):
        with h5py.File(path) as file:
            for name in ARRAYS:
                setattr(self, name, file[name][:])
            self.regions, self.surfaces = ([n.decode() for n in file[f"{kind}_names"][:]] for kind in ("region", "surface"))

    def of_region(self, name):
        return self.tets[self.tet_region == self.regions.index(name)]

    def of_surface(self, name):
        return self.triangles[self.triangle_surface == self.surfaces.index(name)]

    def volumes(self, tets):
        x = self.vertices[tets]
        return np.linalg.det(x[:, 1:] - x[:, :1]) / 6.0

    def least_angle(self, tets):
        """Between two faces of an element, degrees."""
        x = self.vertices[tets]
        normals = []
        for apex, face in enumerate(FACES):
            a, b, c = (x[:, k] for k in face)
            n = np.cross(b - a, c - a)
            inwards = np.einsum("ij,ij->i", n, x[:, apex] - a) > 0
            normals.append(np.where(inwards[:, None], -n, n) / np.linalg.norm(n, axis=1)[:, None])
        cosines = [np.einsum("ij,ij->i", normals[i], normals[j]) for i in range(4) for j in range(i)]
        return np.degrees(np.pi - np.arccos(np.clip(np.min(cosines), -1, 1)))


def write_lumen(path, mesh, vertices):
    """The fluid of a mesh with a wall, as before the wall grew on it."""
    tets = mesh.of_region("fluid")
    used, index = np.unique(tets, return_inverse=True)
    tets = index.reshape(-1, 4)
    number = np.full(len(mesh.vertices), -1)
    number[used] = np.arange(len(used))
    is_its = (number[mesh.triangles] >= 0).all(axis=1)
    names = [n for n in mesh.surfaces if n not in ("layer", "outer") and not n.startswith("wall_")]
    keep = is_its & np.isin(mesh.triangle_surface, [mesh.surfaces.index(n) for n in names])
    surface = [names.index(mesh.surfaces[s]) for s in mesh.triangle_surface[keep]]
    with h5py.File(path, "w") as out:
        out.attrs["format"] = np.bytes_("tunica-mesh 1")
        for name, values in (("vertices", vertices[used]), ("tets", tets), ("tet_region", np.zeros(len(tets))),
                             ("triangles", number[mesh.triangles[keep]]), ("triangle_surface", surface)):
            out[name] = np.asarray(values, dtype="f8" if name == "vertices" else "i4")
        for kind, some in (("region", ["fluid"]), ("surface", names)):
            out[kind + "_ids"] = np.arange(1, len(some) + 1, dtype="i4")
            out[kind + "_names"] = np.array(some, dtype="S32")


def with_noise(mesh):
    """The inside of its wall is rough, as a segmentation leaves it."""
    vertices = mesh.vertices.copy()
    inside = np.unique(mesh.of_surface("interface"))
    rims = np.unique(np.concatenate([mesh.of_surface(n) for n in mesh.surfaces if n.startswith(("inlet", "outlet"))]))
    some = np.setdiff1d(inside, rims)  # openings stay plane
    vertices[some] += NOISE * np.random.default_rng(7).uniform(-1, 1, (len(some), 3))
    return vertices


def check(verdict, name, done, path):
    if not verdict.claim(done.status == 0, f"{name}: ends with 0 {done.err}"):
        return None
    mesh = Mesh(path)
    least = min(mesh.volumes(mesh.of_region(layer)).min() for layer in LAYERS)
    verdict.claim(least > 0.0, f"{name}: the least element of the wall has {least:.1e} mm^3")
    faces, count = np.unique(np.sort(mesh.tets[:, FACES].reshape(-1, 3), axis=1), axis=0, return_counts=True)
    outside = {tuple(face) for face in faces[count == 1]}
    inner = {mesh.surfaces.index(n) for n in ("interface", "layer")}
    tagged = {tuple(sorted(t)) for t, s in zip(mesh.triangles, mesh.triangle_surface) if s not in inner}
    verdict.claim(count.max() == 2 and outside == tagged, f"{name}: elements meet face to face, and all outer faces have a name")
    angle = min(mesh.least_angle(mesh.of_region(layer)) for layer in LAYERS)
    told = re.findall(r"least angle\D*([\d.]+)", done.out)
    verdict.claim(bool(told) and abs(float(told[0]) - angle) < 0.06, f"{name}: the least angle is {angle:.2f} degrees, told {told}")
    return mesh


def main(programs, scratch):
    programs, folder, verdict = pathlib.Path(programs).resolve(), fresh(scratch), Verdict()
    for name in ("bifurcation", "bend", "bulge"):
        shipped = Mesh(ROOT / "meshes" / f"{name}.h5")
        for kind, vertices in (("smooth", shipped.vertices), ("rough", with_noise(shipped))):
            lumen, grown = folder / f"{name}-{kind}.h5", folder / f"{name}-{kind}-wall.h5"
            write_lumen(lumen, shipped, vertices)
            done = Run(command(programs / "tunica-mesh", ["wall", lumen, grown, "--surfaces", "interface", "--layers", WANTED]),
                       folder)
            mesh = check(verdict, f"{name}, {kind}", done, grown)
            if mesh is None or kind == "rough":
                continue
            for layer in LAYERS:
                ours, theirs = (m.volumes(m.of_region(layer)).sum() for m in (mesh, shipped))
                verdict.claim(abs(ours / theirs - 1.0) < 1e-9 and len(mesh.of_region(layer)) == len(shipped.of_region(layer)),
                              f"{name}: {layer} is that of the shipped mesh, {ours:.3f} mm^3")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
