"""The plane that shows most of a vessel, and the cut of a tetrahedral mesh by it, x = const in axes of its own."""
from dataclasses import dataclass

import numpy as np

_EDGES = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])


def _patterns():
    """For each sign pattern of the four vertices the triangles of the cut, as edge numbers."""
    table = []
    for code in range(16):
        above = [v for v in range(4) if code >> v & 1]
        below = [v for v in range(4) if not code >> v & 1]
        edge = {(a, b): i for i, (a, b) in enumerate(map(tuple, _EDGES))}
        number = lambda a, b: edge[min(a, b), max(a, b)]  # noqa: E731
        if len(above) in (1, 3):
            apex, base = (above, below) if len(above) == 1 else (below, above)
            table.append([tuple(number(apex[0], b) for b in base)])
        elif len(above) == 2:
            (a, b), (c, d) = above, below
            q = [number(a, c), number(a, d), number(b, d), number(b, c)]  # around the quadrangle
            table.append([(q[0], q[1], q[2]), (q[0], q[2], q[3])])
        else:
            table.append([])
    return table


_PATTERNS = _patterns()


class LevelCut:
    """Triangles where a nodal function of a tetrahedral mesh is zero.

    A corner lies on an edge of the mesh, or is a vertex where the function is zero but for round-off:
    all edges that end there share it, and what is left of their triangles has an area. Such a vertex counts as
    above, so that a face in the level is taken once and the cut is watertight.
    """

    def __init__(self, level, tets):
        level = np.where(abs(level) < 1e-5 * np.ptp(level), 0.0, level)
        if not (level[tets] < 0).any():  # the level bounds the mesh from below
            level = -level
        code = ((level >= 0)[tets] * (1, 2, 4, 8)).sum(axis=1)
        corners, parents = [np.zeros((0, 3, 2), dtype=np.int64)], [np.zeros(0, dtype=np.int64)]
        for pattern, triangles in enumerate(_PATTERNS):
            cut = np.flatnonzero(code == pattern)
            for triangle in triangles:
                corners.append(np.sort(tets[cut][:, _EDGES[list(triangle)]], axis=2))
                parents.append(cut)
        corners = np.concatenate(corners).reshape(-1, 2)
        is_zero = level[corners] == 0.0
        corners[is_zero[:, 0]] = corners[is_zero[:, 0]][:, [0, 0]]
        corners[is_zero[:, 1]] = corners[is_zero[:, 1]][:, [1, 1]]
        edges, index = np.unique(corners, axis=0, return_inverse=True)
        self.triangles, self.parents = index.reshape(-1, 3), np.concatenate(parents)
        t = self.triangles
        has_area = (t[:, 0] != t[:, 1]) & (t[:, 1] != t[:, 2]) & (t[:, 2] != t[:, 0])
        self.triangles, self.parents = t[has_area], self.parents[has_area]
        self._a, self._b = edges[:, 0], edges[:, 1]
        la, lb = level[self._a], level[self._b]
        self._weight = la / np.where(la == lb, 1.0, la - lb)

    def is_empty(self):
        return len(self.triangles) == 0

    def at_corners(self, values):
        w = self._weight.reshape((-1,) + (1,) * (values.ndim - 1))
        return (1 - w) * values[self._a] + w * values[self._b]


class Section(LevelCut):
    """The cut by the plane x = const, its outline, and the means to bring values onto it.

    The undeformed mesh is cut and the cut moves with the material, so that all times show the
    same triangles.
    """

    def __init__(self, points, tets, plane, displacement):
        super().__init__(points[:, 0] - plane, tets)
        position = self.at_corners(points + displacement)
        self.y, self.z = position[:, 1], position[:, 2]

    def area(self):
        y, z = self.y[self.triangles], self.z[self.triangles]
        return 0.5 * abs((y[:, 1] - y[:, 0]) * (z[:, 2] - z[:, 0]) - (y[:, 2] - y[:, 0]) * (z[:, 1] - z[:, 0])).sum()

    def outline(self):
        """Segments (z, y) that belong to one triangle only."""
        sides = np.sort(self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        sides, count = np.unique(sides, axis=0, return_counts=True)
        sides = sides[count == 1]
        return np.stack([self.z[sides], self.y[sides]], axis=2)


def apart_by_region(tets, region):
    """The mesh with a copy of each point for each region that it belongs to: the new tets, and the point
    that each copy is of. What jumps between layers is smooth on either side."""
    keys, index = np.unique(np.stack([np.repeat(region, 4), tets.reshape(-1)], axis=1), axis=0, return_inverse=True)
    return index.reshape(-1, 4), keys[:, 1]


def nodal_means(points, tets, values):
    """Values at the points from those in the tets, weighted by volumes."""
    x = points[tets]
    volume = abs(np.einsum("ij,ij->i", x[:, 1] - x[:, 0], np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 0])))
    nodes, count = tets.reshape(-1), len(points)
    weight = np.bincount(nodes, np.repeat(volume, 4), count)
    return np.bincount(nodes, np.repeat(volume * values, 4), count) / np.maximum(weight, 1e-300)


def section_axes(points):
    """Rows: the normal of the plane that shows most of a vessel, and the directions up and along in it.

    Along is where the points spread most, the normal where they do least: a plane that follows all
    branches. Round vessels keep the normal x, or what is nearest to it. Axes nearly those of the mesh are
    these.
    """
    spread, directions = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))
    along = _snapped(directions[:, 2])
    if spread[1] < 1.2 * spread[0]:  # round
        x = _nearest_axis(along)
        normal = x - (x @ along) * along
    else:
        normal = _snapped(directions[:, 0])
        normal = normal - (normal @ along) * along
    normal = normal / np.linalg.norm(normal)
    return _with_up(normal, along)


def _nearest_axis(direction):
    """x, or y where the direction is nearly x."""
    return np.eye(3)[0 if abs(direction[0]) < 0.9 else 1]


def _with_up(normal, along):
    up = np.cross(along, normal)
    return np.array([normal, up if up[np.argmax(abs(up))] > 0 else -up, along])


def _snapped(direction):
    """Of unit length, its largest component positive; an axis where it is one within 3 degrees."""
    largest = np.argmax(abs(direction))
    direction = direction * np.sign(direction[largest])
    return np.eye(3)[largest] if direction[largest] > np.cos(np.radians(3.0)) else direction


def name_of_axis(direction, otherwise):
    largest = np.argmax(abs(direction))
    return "xyz"[largest] if abs(direction[largest]) > 1.0 - 1e-9 else otherwise


@dataclass
class Plane:
    axes: np.ndarray  # rows: its normal, and the directions up and along in it
    level: float      # its place along the normal [mm]

    def option(self):
        """What of the command line says the same."""
        return "--plane=" + ",".join(f"{part:.4g}" for part in self.axes[0] + 0.0) + f"={self.level:.4g}"


def fitted_plane(points, centres):
    """Through the centres of a vessel: along them where they bend by more than the vessel is wide, else along what
    the points show. Symmetric halves are cut where they end."""
    variances = lambda x: np.linalg.eigvalsh(np.cov(x.T))  # noqa: E731
    bends = len(centres) > 2 and variances(centres)[1] > variances(points)[0]
    axes = section_axes(centres if bends else points)
    return Plane(axes, _level(points, centres, axes))


def chosen_plane(points, centres, normal, level=None):
    """The same with a normal of any length, and where it is not None a level."""
    normal = normal / np.linalg.norm(normal)
    flat = points - np.outer(points @ normal, normal)
    spread, directions = np.linalg.eigh(np.cov(flat.T))
    along = _nearest_axis(normal) if spread[2] < 1.2 * spread[1] else _snapped(directions[:, 2])
    along = along - (along @ normal) * normal
    axes = _with_up(normal, along / np.linalg.norm(along))
    return Plane(axes, _level(points, centres, axes) if level is None else level)


def _level(points, centres, axes):
    """Of the centres; zero where that is but for noise. Where the mesh ends on one side in a plane along the vessel, that
    plane: it is one of symmetry."""
    across, up = points @ axes[0], points @ axes[1]
    low, high = across.min(), across.max()
    size = max(high - low, 1e-300)
    is_plane = lambda end: np.ptp(up[abs(across - end) < 1e-6 * size]) > 0.9 * np.ptp(up)  # noqa: E731
    planes = [end for end in (low, high) if is_plane(end)]
    if len(planes) == 1 and size < np.ptp(points @ axes[2]):
        return float(planes[0])
    middle = float(np.clip((centres @ axes[0]).mean(), low, high))
    return float(np.clip(0.0, low, high)) if abs(middle) < 0.01 * size else middle


def norm_of(values):
    return np.linalg.norm(values, axis=1) if values.ndim == 2 else np.abs(values)


def von_mises(stress):
    """From a symmetric tensor stored as xx, xy, xz, yy, yz, zz."""
    xx, xy, xz, yy, yz, zz = stress.T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2))
