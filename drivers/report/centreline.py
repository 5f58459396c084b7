"""The centreline of a vessel, and what is measured from it.

u is harmonic in the lumen, 0 on the cap where it begins and 1 on the others: its level sets are cross-sections,
flat at the caps, one for each branch. Their centres, linked each to the nearest one of the level before,
are a tree. In a straight tube u is linear and the centres lie on the axis.
"""
import numpy as np

from report.section import LevelCut, section_axes
from report.surfaces import pieces, weighted_centre


def harmonic(points, tets, zero, one):
    """P1 solution of Laplace's equation with u = 0 and 1 at those nodes: conjugate gradients with the diagonal."""
    rows, columns, entries = _stiffness(points, tets)
    count = len(points)
    free = np.bincount(tets.reshape(-1), minlength=count) > 0
    free[zero] = free[one] = False
    u = np.zeros(count)
    u[one] = 1.0
    product = lambda x: np.bincount(rows, entries * x[columns], count)  # noqa: E731
    diagonal = np.bincount(rows[rows == columns], entries[rows == columns], count)
    scale = np.where(free, 1.0 / np.where(diagonal > 0, diagonal, 1.0), 0.0)
    r = np.where(free, -product(u), 0.0)
    z = scale * r
    p, rz = z, r @ z
    target = 1e-24 * rz
    for _ in range(3000):
        if rz <= target or rz == 0.0:
            break
        q = np.where(free, product(p), 0.0)
        step = rz / (p @ q)
        u, r = u + step * p, r - step * q
        z = scale * r
        rz, before = r @ z, rz
        p = z + (rz / before) * p
    return u


def _stiffness(points, tets):
    x = points[tets]
    edges = x[:, 1:] - x[:, :1]
    volume = np.linalg.det(edges)
    good = abs(volume) > 1e-12 * np.abs(edges).max(axis=(1, 2)) ** 3
    tets, edges, volume = tets[good], edges[good], abs(volume[good]) / 6
    gradients = np.zeros((len(tets), 4, 3))
    gradients[:, 1:] = np.transpose(np.linalg.inv(edges), (0, 2, 1))
    gradients[:, 0] = -gradients[:, 1:].sum(axis=1)
    local = np.einsum("eik,ejk,e->eij", gradients, gradients, volume)
    key = (np.repeat(tets, 4, axis=1) * np.int64(len(points)) + np.tile(tets, (1, 4))).reshape(-1)
    unique, index = np.unique(key, return_inverse=True)
    return unique // len(points), unique % len(points), np.bincount(index.reshape(-1), local.reshape(-1))


class Centreline:
    """centres, the parent of each (-1 at the begin), and length, the way along the line to each [mm]."""

    def __init__(self, centres, parents):
        self.centres, self.parents = np.array(centres), np.array(parents)
        self.length = np.zeros(len(centres))
        for i, parent in enumerate(self.parents):
            if parent >= 0:
                self.length[i] = self.length[parent] + np.linalg.norm(self.centres[i] - self.centres[parent])

    def paths(self):
        """Centres on the way to each end."""
        found = []
        for end in np.setdiff1d(np.arange(len(self.parents)), self.parents):
            path = [end]
            while self.parents[path[-1]] >= 0:
                path.append(self.parents[path[-1]])
            found.append(path[::-1])
        return found

    def _segments(self):
        """Their ends and begins, and how far each reaches before its begin. What links a branch to the trunk runs
        across: instead the branch goes on straight, backwards."""
        children = np.bincount(self.parents[self.parents >= 0], minlength=len(self.parents))
        is_link = (self.parents >= 0) & (children[self.parents] > 1)
        ends = np.flatnonzero((self.parents >= 0) & (~is_link | (children == 0)))
        begins = self.parents[ends]
        gap = np.where(is_link[begins], self.length[begins] - self.length[self.parents[begins]], 0.0)
        return ends, begins, gap

    def locate(self, points):
        """For each point the nearest segment (the number of its end), the way along the line, and the unit
        vector away from it. The line goes on straight by a segment or two at its ends, no farther: in a bent vessel
        that leads to other parts of it."""
        ends, begins, before = self._segments()
        a, direction = self.centres[begins], self.centres[ends] - self.centres[begins]
        size = np.linalg.norm(direction, axis=1)
        direction = direction / size[:, None]
        low = np.where(self.parents[begins] < 0, -size, -before)
        high = np.where(~np.isin(ends, self.parents), 3 * size, size)
        segment, way, away = np.empty(len(points), int), np.empty(len(points)), np.empty((len(points), 3))
        for chunk in np.array_split(np.arange(len(points)), max(1, len(points) * len(ends) // 2_000_000)):
            t = np.einsum("pk,sk->ps", points[chunk], direction) - np.einsum("sk,sk->s", a, direction)
            t = np.clip(t, low, high)
            offset = points[chunk][:, None] - a - t[:, :, None] * direction
            nearest = np.linalg.norm(offset, axis=2).argmin(axis=1)
            rows = np.arange(len(chunk))
            segment[chunk], t = ends[nearest], t[rows, nearest]
            way[chunk] = self.length[begins[nearest]] + t
            along = direction[nearest]
            radial = points[chunk] - a[nearest]
            radial = radial - np.einsum("ij,ij->i", radial, along)[:, None] * along
            away[chunk] = radial / np.maximum(np.linalg.norm(radial, axis=1), 1e-300)[:, None]
        return segment, way, away


def beginning(points, ends, inflows):
    """Number of the cap where most flows in; of the largest, where nothing does.

    ends: VesselSurfaces.ends, inflows: through each, summed over outputs."""
    if len(inflows) and max(inflows) > 0:
        return int(np.argmax(inflows))
    along = section_axes(points)[2]
    centres = [weighted_centre(end.points, end.triangles) for end in ends]
    largest = max(area for _, area in centres)
    return min((k for k, (_, area) in enumerate(centres) if area > 0.99 * largest),
               key=lambda k: centres[k][0] @ along)


def of_lumen(points, tets, ends, inflows=()):
    """From the cap where the flow comes from to the others."""
    start = beginning(points, ends, inflows)
    centre, _ = weighted_centre(ends[start].points, ends[start].triangles)
    others = np.concatenate([end.nodes for k, end in enumerate(ends) if k != start])
    u = harmonic(points, tets, ends[start].nodes, others)
    return _linked(_slices(points, tets, u, *_levels(points, tets)), centre)


def _levels(points, tets):
    """As many as there are elements along the box, 8 to 100."""
    edge = np.linalg.norm(points[tets[:, 0]] - points[tets[:, 1]], axis=1).mean()
    return (np.linspace(0, 1, int(np.clip(np.linalg.norm(np.ptp(points, axis=0)) / edge, 8, 100)) + 1)[1:-1],)


def _slices(points, tets, u, levels):
    """Per level the centres of its pieces; crumbs, as where a level touches a side, are left out."""
    for level in levels:
        cut = LevelCut(u - level, tets)
        if cut.is_empty():
            continue
        corners, piece = cut.at_corners(points), pieces(cut.triangles)
        found = [weighted_centre(corners, cut.triangles[piece == k]) for k in range(piece.max() + 1)]
        most = max(area for _, area in found)
        yield [centre for centre, area in found if area > 0.05 * most]


def _linked(slices, start):
    centres, parents, before = [start], [-1], [0]
    for level in slices:
        now = []
        for centre in level:
            parents.append(min(before, key=lambda k: np.linalg.norm(centres[k] - centre)))
            now.append(len(centres))
            centres.append(centre)
        before = now
    return Centreline(centres, parents)


def straight(points):
    """For a wall without a lumen: the axis along which it spreads most."""
    centre, along = points.mean(axis=0), section_axes(points)[2]
    low, high = ((points - centre) @ along).min(), ((points - centre) @ along).max()
    return Centreline([centre + low * along, centre + high * along], [-1, 0])
