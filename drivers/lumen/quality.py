"""What the program reports of the elements of a mesh."""
import numpy as np

from .surface import dot, unit

OPPOSITE = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def six_volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return dot(b - a, np.cross(c - a, d - a))


def least_dihedral(points, tets):
    """The least of the six angles between faces of each tetrahedron, degrees."""
    corners = points[tets]
    normals = [unit(np.cross(corners[:, j] - corners[:, i], corners[:, k] - corners[:, i])) for i, j, k in OPPOSITE]
    least = np.full(len(tets), 180.0)
    for i in range(4):
        for j in range(i):
            cosine = np.clip(-dot(normals[i], normals[j]), -1.0, 1.0)
            np.minimum(least, np.degrees(np.arccos(cosine)), out=least)
    return least
