"""The branches of a vessel between its openings and forks, and what is measured over the lumen and along them."""
import numpy as np

from report.surfaces import Surface, VesselSurfaces, area_vectors, boundary, edges_of, pieces, weighted_centre
from vessel import branches as tree

SMOOTHING = 20  # passes over a way along edges of the mesh
MIDDLE = 0.5  # part of a branch, in its middle, that stands for it


class MeshOfLumen:
    """The lumen's grid as vessel/branches.py reads it."""

    def __init__(self, points, tets, ends):
        self.vertices, self.tets, self.ends = points, tets.astype(np.int64), ends

    def triangles_of(self, name):
        end = self.ends[name]
        return end.nodes[end.triangles]

    def mean_edge(self, triangles):
        x = self.vertices[triangles]
        return float(np.mean([np.linalg.norm(x[:, i] - x[:, i - 1], axis=1) for i in range(3)]))

    def volume(self, tets):
        x = self.vertices[tets]
        return np.linalg.det(x[:, 1:] - x[:, :1]) / 6.0


def name_ends(run, ends, beat):
    """Name -> cap: that whose area, mean pressure and flow are those of steps.csv at the outputs; {} where none are known."""
    from scipy.optimize import linear_sum_assignment
    names, times = beat.openings(), np.array(beat.steps["time"])
    seen = [(int(np.argmin(abs(times - time))), group) for time, group in run.outputs if (abs(times - time) < 1e-6 * beat.period).any()]
    if not seen or len(names) != len(ends):
        return {}
    cost = np.zeros((len(names), len(ends)))
    for column, of_cap in (("area_{}_mm2", _area), ("mean_pressure_{}_kPa", _pressure), ("inflow_{}_mm3_per_ms", _flow)):
        told = [beat.steps.get(column.format(name)) for name in names]
        if any(values is None for values in told):
            continue
        told = np.array([[values[row] for row, _ in seen] for values in told], dtype=float)
        found = np.array([[of_cap(run, end, group) for _, group in seen] for end in ends])
        size = max(np.abs(told).max(), 1e-300)
        cost += (np.abs(told[:, None] - found[None]) / size).mean(axis=2)
    chosen = linear_sum_assignment(cost)
    return {names[i]: ends[j] for i, j in zip(*chosen)}


def moved_vectors(run, end, group):
    """Of the triangles of a cap where they are at an output."""
    moved = run.mesh("fluid")[0] + run.displacement(group, "fluid")
    return area_vectors(moved[end.nodes], end.triangles)


def _area(run, end, group):
    return np.linalg.norm(moved_vectors(run, end, group), axis=1).sum()


def _pressure(run, end, group):
    weights = np.linalg.norm(moved_vectors(run, end, group), axis=1)
    return np.average(run.nodal(group, "fluid", "pressure").reshape(-1)[end.nodes][end.triangles].mean(axis=1), weights=weights)


def _flow(run, end, group):
    velocity = run.nodal(group, "fluid", "velocity")[end.nodes][end.triangles].mean(axis=1)
    return -np.einsum("ij,ij", velocity, moved_vectors(run, end, group))


def without_caps(run, boundary_of_all):
    """The rigid wall of a fluid alone, and its caps: in their inside there is no shear stress at any time."""
    stress = run.nodal(run.outputs[-1][1], "fluid", "time_averaged_wss")
    if stress is None:
        return boundary_of_all, []
    faces = boundary_of_all.nodes[boundary_of_all.triangles]
    is_wall = (stress.reshape(-1) > 0)[faces].all(axis=1)
    if is_wall.all() or not is_wall.any():
        return boundary_of_all, []
    piece = pieces(faces[~is_wall])
    return (Surface(run.mesh("fluid")[0], faces[is_wall]),
            [Surface(run.mesh("fluid")[0], faces[~is_wall][piece == k]) for k in range(piece.max() + 1)])


def way_lengths(points, tets, lumen, centres):
    """From the first of the named centres to the others, along the edges that keep away from the wall, smoothed [mm]."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import dijkstra
    from scipy.spatial import cKDTree
    a, b = edges_of(tets).T
    clearance = cKDTree(lumen.points).query(points)[0]
    step = np.linalg.norm(points[a] - points[b], axis=1)
    cost = step / (0.5 * (clearance[a] + clearance[b]) + 0.05 * clearance.max()) ** 2  # narrow ways are dear, as for blood
    graph = coo_matrix((cost, (a, b)), shape=(len(points), len(points))).tocsr()
    used = np.unique(tets)
    nearest = [used[np.linalg.norm(points[used] - place, axis=1).argmin()] for place in centres.values()]
    before = dijkstra(graph, directed=False, indices=nearest[0], return_predecessors=True)[1]
    start, found = next(iter(centres)), {}
    for name, node in list(zip(centres, nearest))[1:]:
        way = [node]
        while before[way[-1]] >= 0:
            way.append(before[way[-1]])
        found[name] = _length(smoothed(np.vstack([centres[start], points[way[-2:0:-1]], centres[name]])))
    return found


def smoothed(line):
    """Points at even steps as short as those of the line are in the mean, each moved to the middle of its neighbours many times."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.linspace(0.0, along[-1], max(len(line), 5))
    line = np.stack([np.interp(at, along, line[:, k]) for k in range(3)], axis=1)
    for _ in range(SMOOTHING):
        line[1:-1] = 0.25 * line[:-2] + 0.5 * line[1:-1] + 0.25 * line[2:]
    return line


class Branch:
    """Name, its tetrahedra, and those in its middle."""

    def __init__(self, start, end, tets, middle):
        self.name, self.tets, self.middle = f"{start} to {end}", tets, middle


class Parts:
    """Surfaces, named openings, branches, and ways [mm] from the inlet to each outlet."""

    def __init__(self, run, beat):
        self.surfaces = VesselSurfaces(run)
        self.points, self.tets = run.mesh("fluid")
        self.lumen, caps = self.surfaces.lumen, self.surfaces.ends
        if "wall" not in run.grids():
            self.lumen, caps = without_caps(run, self.lumen)
        self.ends = name_ends(run, caps, beat)
        self.branches, self.ways = [], {}
        if beat.inlet in self.ends and beat.outlets:
            self._divide(beat)
        of_tet = np.full(len(self.tets), -1)
        for k, branch in enumerate(self.branches):
            of_tet[branch.tets] = k
        self.of_node = np.full(len(self.points), -1)
        self.of_node[self.tets.reshape(-1)] = np.repeat(of_tet, 4)
        sides, parents = boundary(self.points, self.tets)
        key = {tuple(sorted(face)): tet for face, tet in zip(sides.tolist(), parents.tolist())}
        faces = self.lumen.nodes[self.lumen.triangles]
        self.of_triangle = of_tet[[key[tuple(sorted(face))] for face in faces.tolist()]]

    def _divide(self, beat):
        mesh = MeshOfLumen(self.points, self.tets, self.ends)
        slabs = tree.Pieces(mesh, beat.inlet)
        ways = {name: slabs.way(mesh, name) for name in beat.outlets}
        of_piece = np.full(len(slabs.parent), -1)
        chains = tree.chains(ways, beat.inlet)
        for k, (_, _, chosen) in enumerate(chains):
            of_piece[chosen[1 if k else 0:]] = k
        for piece in np.argsort(slabs.slab, kind="stable"):  # what no way leads through belongs to what it hangs on
            if of_piece[piece] < 0 and slabs.parent[piece] >= 0:
                of_piece[piece] = of_piece[slabs.parent[piece]]
        of_tet = of_piece[slabs.of_tet]
        for k, (start, end, chosen) in enumerate(chains):
            inner = np.array(chosen)[_inner(len(chosen))]
            self.branches.append(Branch(start, end, np.flatnonzero(of_tet == k), np.flatnonzero(np.isin(slabs.of_tet, inner))))
        places = {name: weighted_centre(self.ends[name].points, self.ends[name].triangles)[0] for name in beat.openings()}
        self.ways = way_lengths(self.points, self.tets, self.lumen, places)

    def branch_at(self, place):
        """Name of the branch whose lumen is nearest to a point, empty without branches."""
        if not self.branches:
            return ""
        nodes = np.flatnonzero(self.of_node >= 0)
        return self.branches[self.of_node[nodes[np.linalg.norm(self.points[nodes] - place, axis=1).argmin()]]].name


def _inner(count):
    """The middle of so many pieces."""
    away = int((1 - MIDDLE) / 2 * count)
    return slice(away, count - away)


def _length(points):
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def area_where(areas, corners, level, above):
    """Area of the triangles in which a linear function, given at their corners, is below a level, or above it."""
    low = np.sort(-corners if above else corners, axis=1)
    level = -level if above else level
    a, b, c = low.T
    size = np.maximum(c - a, 1e-300)
    # Up to the middle corner the part grows as a square, from there on what is missing shrinks as one.
    rising = np.clip(level - a, 0, None) ** 2 / np.maximum(size * (b - a), 1e-300)
    falling = 1 - np.clip(c - level, 0, None) ** 2 / np.maximum(size * (c - b), 1e-300)
    part = np.where(level <= a, 0.0, np.where(level >= c, 1.0, np.where(level <= b, rising, falling)))
    return float((areas * part).sum())
