"""Meshes of triangles in the plane, drawn out along z, for scripts that write meshes of the Gmsh format.

A prism over a triangle is cut into three tetrahedra by the numbers of its vertices, so that all faces conform.
"""
import numpy as np


def grid_triangles(columns, rows):
    """Triangles of a grid with that many vertices each way, vertex (i, j) being i * rows + j."""
    i, j = np.meshgrid(np.arange(columns - 1), np.arange(rows - 1), indexing="ij")
    a = (i * rows + j).ravel()
    b, c, d = a + rows, a + rows + 1, a + 1
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def graded(points, counts, ratios):
    """The corners of cells between each pair of points: how many, and the last one's length over the first's."""
    corners = [points[0]]
    for a, b, n, ratio in zip(points, points[1:], counts, ratios):
        lengths = ratio ** (np.arange(n) / max(n - 1, 1))
        corners += list(a + (b - a) * np.cumsum(lengths) / lengths.sum())
    return np.array(corners)


def tetrahedra(triangles, n_plane, n_levels):
    """Three for each triangle and slice; vertex v of the plane is v + k n_plane on level k."""
    a, b, c = np.sort(triangles, axis=1).T
    tets = []
    for k in range(n_levels - 1):
        low, high = k * n_plane, (k + 1) * n_plane
        tets += [np.stack(t, 1) for t in ((a + low, b + low, c + low, c + high),
                                          (a + low, b + low, b + high, c + high),
                                          (a + low, a + high, b + high, c + high))]
    return np.concatenate(tets)


def upright(points, tets):
    """With positive volumes."""
    x = points[tets]
    volume = np.einsum("ij,ij->i", np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 3] - x[:, 0])
    tets = tets.copy()
    tets[volume < 0, 2:] = tets[volume < 0, :1:-1]
    return tets


def write(path, points, tets, region_of, surface_of):
    """Gmsh 2.2. region_of(centroids) gives the name of each tetrahedron's region, surface_of(x, y, z, region) that of a
    face at the boundary by its centroid; faces between regions are the interface."""
    tets = upright(points, tets)
    region = np.asarray(region_of(points[tets].mean(1)))
    corners = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    faces = tets[:, corners].reshape(-1, 3)
    owner = np.repeat(np.arange(len(tets)), 4)
    order = np.lexsort(np.sort(faces, axis=1).T)
    sorted_faces = np.sort(faces, axis=1)[order]
    is_twin = np.append((sorted_faces[1:] == sorted_faces[:-1]).all(1), False)
    is_second = np.append(False, is_twin[:-1])
    first = order[~is_second]
    other = np.full(len(first), "", dtype=region.dtype)
    has_twin = is_twin[~is_second]
    other[has_twin] = region[owner[order[is_second]]]
    mine = region[owner[first]]
    shown = mine != other
    first, mine, other = first[shown], mine[shown], other[shown]
    faces = faces[first]
    names = ["interface" if neighbour else surface_of(*centroid, its)
             for centroid, its, neighbour in zip(points[faces].mean(1), mine, other)]
    surfaces, regions = sorted(set(names)), sorted(set(region))
    tags = {name: k + 1 for k, name in enumerate(surfaces + regions)}
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(tags)}\n")
        for name, tag in tags.items():
            out.write(f'{2 if tag <= len(surfaces) else 3} {tag} "{name}"\n')
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(points)}\n")
        rows = np.column_stack([np.arange(1, len(points) + 1), points])
        np.savetxt(out, rows, fmt="%d %.15g %.15g %.15g")
        out.write(f"$EndNodes\n$Elements\n{len(faces) + len(tets)}\n")
        for kind, cells, at, begin in ((2, faces, names, 1), (4, tets, region, 1 + len(faces))):
            tag = np.array([tags[name] for name in at], dtype=int)
            head = np.column_stack([np.arange(begin, begin + len(cells)), np.full(len(cells), kind),
                                    np.full(len(cells), 2), tag, tag])
            np.savetxt(out, np.column_stack([head, cells + 1]), fmt="%d")
        out.write("$EndElements\n")
