"""What the stages read from a mesh in Tunica's HDF5: names, openings, areas, elements across."""
import h5py
import numpy as np

from .errors import BadInput, nearest

FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # of a tetrahedron, normals outward


class Mesh:
    """vertices (n, 3), tets (m, 4), region (m), triangles (k, 3), surface (k), and the names of both."""

    def __init__(self, path):
        self.path = path
        try:
            with h5py.File(path) as file:
                self.vertices, self.tets = file["vertices"][:], file["tets"][:].astype(np.int64)
                self.region = file["tet_region"][:]
                self.triangles, self.surface = file["triangles"][:].astype(np.int64), file["triangle_surface"][:]
                self.regions = [name.decode() for name in file["region_names"][:]]
                self.surfaces = [name.decode() for name in file["surface_names"][:]]
        except (OSError, KeyError) as error:
            raise BadInput(f"{path}: is no mesh in Tunica's HDF5: {error}") from None

    def triangles_of(self, name):
        if name not in self.surfaces:
            raise BadInput(f"{self.path}: has no surface \"{name}\". {nearest(name, self.surfaces)}")
        return self.triangles[self.surface == self.surfaces.index(name)]

    def tets_of(self, name):
        return self.tets[self.region == self.regions.index(name)]

    def volume(self, tets):
        x = self.vertices[tets]
        return np.linalg.det(x[:, 1:] - x[:, :1]) / 6.0

    def area_vectors(self, triangles):
        a, b, c = (self.vertices[triangles[:, i]] for i in range(3))
        return 0.5 * np.cross(b - a, c - a)

    def mean_edge(self, triangles):
        x = self.vertices[triangles]
        return float(np.mean([np.linalg.norm(x[:, i] - x[:, i - 1], axis=1) for i in range(3)]))


def opening_of(mesh, name):
    """Centre, outward normal, area and radius of an opening, as lumen.json has them."""
    triangles = mesh.triangles_of(name)
    vectors = mesh.area_vectors(triangles)
    sizes = np.linalg.norm(vectors, axis=1)
    centre = (mesh.vertices[triangles].mean(axis=1) * sizes[:, None]).sum(axis=0) / sizes.sum()
    normal = vectors.sum(axis=0)
    inside = mesh.vertices[tets_at(mesh, triangles)].mean(axis=(0, 1)) - centre
    normal *= -np.sign(normal @ inside) / np.linalg.norm(normal)
    area = float(sizes.sum())
    return {"name": name, "centre": centre.tolist(), "normal": normal.tolist(), "area": area,
            "radius": float(np.sqrt(area / np.pi))}


def tets_at(mesh, triangles):
    """Tetrahedra that share a vertex with these triangles."""
    is_near = np.zeros(len(mesh.vertices), dtype=bool)
    is_near[triangles] = True
    return mesh.tets[is_near[mesh.tets].any(axis=1)]
