"""Surfaces of tetrahedral meshes: the boundary, and its parts by what lies there."""
import numpy as np

_FACES = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])  # outwards of a positively oriented tet


def boundary(points, tets):
    """Triangles that belong to one tet only, seen from outside anticlockwise, and their tets."""
    faces = tets[:, _FACES].reshape(-1, 3)
    key = np.sort(faces, axis=1)
    _, first, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    chosen = np.sort(first[count == 1])
    return faces[chosen], chosen // 4


def edges_of(tets):
    """Each edge of tetrahedra once, its smaller point first."""
    return np.unique(np.sort(np.vstack([tets[:, [i, j]] for i in range(4) for j in range(i)]), axis=1), axis=0)


def numbers_by_place(*clouds):
    """For each cloud of points numbers that are equal where the points are."""
    everything = np.concatenate(clouds)
    size = max(np.ptp(everything, axis=0).max(), 1e-300)
    _, numbers = np.unique(np.round(everything / (1e-7 * size)).astype(np.int64), axis=0, return_inverse=True)
    return np.split(numbers.reshape(-1), np.cumsum([len(c) for c in clouds])[:-1])


def pieces(triangles):
    """For each triangle the number of the connected piece it belongs to; triangles connect at their corners."""
    _, nodes = np.unique(triangles, return_inverse=True)
    nodes = nodes.reshape(triangles.shape)
    label = np.arange(nodes.max() + 1 if nodes.size else 0)
    while True:
        least = label[nodes].min(axis=1)
        new = label.copy()
        np.minimum.at(new, nodes, least[:, None])
        new = new[new]  # labels are nodes of the same piece: follow them
        if np.array_equal(new, label):
            break
        label = new
    return np.unique(label[nodes[:, 0]], return_inverse=True)[1] if nodes.size else np.zeros(0, dtype=int)


def area_vectors(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return 0.5 * np.cross(b - a, c - a)


def weighted_centre(points, triangles):
    weight = np.linalg.norm(area_vectors(points, triangles), axis=1)
    return np.average(points[triangles].mean(axis=1), axis=0, weights=weight), weight.sum()


def normals_of(points, triangles):
    """At the points, of unit length."""
    vectors = area_vectors(points, triangles)
    total = np.stack([np.bincount(triangles.reshape(-1), np.repeat(vectors[:, k], 3), len(points)) for k in range(3)],
                     axis=1)
    return total / np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]


class Surface:
    """Part of a grid's boundary with points of its own; nodes are those of the grid."""

    def __init__(self, points, triangles):
        self.nodes, index = np.unique(triangles, return_inverse=True)
        self.points, self.triangles = points[self.nodes], index.reshape(-1, 3)


class VesselSurfaces:
    """Parts of fluid and wall, any of them None if the run has it not:

      outer       wall, away from the fluid, without its ends
      wall        all of the wall's boundary
      lumen       fluid where the wall is; all of it without a wall
      ends        caps of the fluid, a list
    """

    def __init__(self, run):
        self.outer = self.wall = self.lumen = None
        self.ends = []
        meshes = {grid: run.mesh(grid) for grid in run.grids()}
        sides = {grid: boundary(*mesh)[0] for grid, mesh in meshes.items()}
        numbers = dict(zip(meshes, numbers_by_place(*[points for points, _ in meshes.values()])))
        if "wall" in meshes:  # layers are apart: what bounds two of them is inside
            key = np.sort(numbers["wall"][sides["wall"]], axis=1)
            _, index, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
            sides["wall"] = sides["wall"][count[index.reshape(-1)] == 1]
            self.wall = Surface(meshes["wall"][0], sides["wall"])
        if len(meshes) == 2:
            self._part(meshes, sides, numbers)
        elif "fluid" in meshes:
            self.lumen = Surface(meshes["fluid"][0], sides["fluid"])
        else:
            self.outer = self.wall

    def _part(self, meshes, sides, numbers):
        shared = {g: np.isin(numbers[g], numbers[other]) for g, other in (("fluid", "wall"), ("wall", "fluid"))}
        points, triangles = meshes["fluid"][0], sides["fluid"]
        inside = self._faces_of_both(sides, numbers)
        self.lumen = Surface(points, triangles[inside]) if inside.any() else Surface(points, triangles)
        caps = triangles[~inside]
        if inside.any() and len(caps):
            piece = pieces(caps)
            self.ends = [Surface(points, caps[piece == k]) for k in range(piece.max() + 1)]
        points, triangles = meshes["wall"][0], sides["wall"]
        free = ~np.isin(triangles, np.flatnonzero(shared["wall"])).any(axis=1)
        self.outer = Surface(points, self._sides_without_ends(points, triangles, free))

    @staticmethod
    def _faces_of_both(sides, numbers):
        """Which faces of the fluid are faces of the wall."""
        both = [np.sort(numbers[g][sides[g]], axis=1) for g in ("fluid", "wall")]
        _, index, = np.unique(np.concatenate(both), axis=0, return_inverse=True)
        index = index.reshape(-1)
        return np.isin(index[:len(both[0])], index[len(both[0]):])

    @staticmethod
    def _sides_without_ends(points, triangles, free):
        """Faces away from the fluid; the ends of the wall go from it to them and have an edge between."""
        if not free.any():
            return triangles
        vectors = area_vectors(points, triangles)
        normals = vectors / np.maximum(np.linalg.norm(vectors, axis=1), 1e-300)[:, None]
        at_edge = np.unique(triangles[~free])
        smooth = normals_of(points, triangles[free])
        is_end = np.isin(triangles, at_edge).any(axis=1)
        agrees = np.einsum("ij,ij->i", normals, smooth[triangles].sum(axis=1)) > 0.5 * np.linalg.norm(
            smooth[triangles].sum(axis=1), axis=1)
        return triangles[free & (~is_end | agrees)]
