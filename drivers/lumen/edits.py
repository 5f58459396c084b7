"""Changes of a triangulation, many at once: sides are split, contracted and turned.

Those of one pass do not touch one another, so no order among them matters. No loop runs over triangles.
"""
import numpy as np

from . import surface as base
from .surface import Edges, dot, unit

ROUNDS = 8            # of contractions in a pass
STEEPEST = 0.5        # cosine between the normals before and after
NO_SLIVER = 0.08      # quality below which a contraction may not bring a triangle


def lengths_of(points, ends, size):
    """Of sides, in units of the wanted size."""
    wanted = 0.5 * (size[ends[:, 0]] + size[ends[:, 1]])
    return np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1) / wanted


def split(points, triangles, size, longest):
    """Halves all sides that are longer."""
    edges = Edges(triangles)
    marked = lengths_of(points, edges.ends, size) > longest
    if not marked.any():
        return points, triangles, size
    number = np.full(len(marked), -1)
    number[marked] = len(points) + np.arange(int(marked.sum()))
    ends = edges.ends[marked]
    points = np.vstack([points, points[ends].mean(axis=1)])
    size = np.concatenate([size, size[ends].mean(axis=1)])
    middle = number[edges.of]
    count = (middle >= 0).sum(axis=1)
    parts = [triangles[count == 0]]
    for how, n in ((one_halved, 1), (two_halved, 2), (three_halved, 3)):
        chosen = count == n
        turned = turn_to(triangles[chosen], middle[chosen], n)
        parts.append(how(points, *turned))
    return points, np.concatenate(parts), size


def turn_to(triangles, middle, n):
    """Corners and middles such that the first n sides are those that are halved."""
    has = middle >= 0
    start = np.zeros(len(triangles), dtype=np.int64) if n == 3 else has.argmax(axis=1) if n == 1 \
        else (np.argmin(has, axis=1) + 1) % 3
    at = (start[:, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles, at, axis=1).T, np.take_along_axis(middle, at, axis=1).T


def one_halved(_, corners, middle):
    (a, b, c), p = corners, middle[0]
    return np.concatenate([np.stack([a, p, c], axis=1), np.stack([p, b, c], axis=1)])


def two_halved(points, corners, middle):
    (a, b, c), p, q = corners, middle[0], middle[1]
    short = np.linalg.norm(points[a] - points[q], axis=1) < np.linalg.norm(points[p] - points[c], axis=1)
    s, t = short, ~short
    return np.concatenate([np.stack([p, b, q], axis=1),
                           np.stack([a[s], p[s], q[s]], axis=1), np.stack([a[s], q[s], c[s]], axis=1),
                           np.stack([a[t], p[t], c[t]], axis=1), np.stack([p[t], q[t], c[t]], axis=1)])


def three_halved(_, corners, middle):
    (a, b, c), (p, q, r) = corners, middle
    return np.concatenate([np.stack(t, axis=1) for t in ((a, p, r), (p, b, q), (r, q, c), (p, q, r))])


class Stars:
    """The triangles at each vertex."""

    def __init__(self, triangles, count):
        corner = triangles.reshape(-1)
        self.order = np.argsort(corner, kind="stable")
        self.size = np.bincount(corner, minlength=count)
        self.first = np.concatenate([[0], np.cumsum(self.size)])

    def rows(self, vertices):
        """(position in the list of vertices, triangle) for all of them."""
        size = self.size[vertices]
        owner = np.repeat(np.arange(len(vertices)), size)
        step = np.arange(len(owner)) - np.repeat(np.cumsum(size) - size, size)
        return owner, self.order[self.first[vertices][owner] + step] // 3


def contract(points, triangles, size, shortest, generator):
    """Draws both ends of short sides together."""
    points, banned = points.copy(), np.zeros(0, dtype=np.int64)
    for _ in range(ROUNDS):
        edges = Edges(triangles)
        is_rim = np.zeros(len(points), dtype=bool)
        is_rim[edges.ends[edges.is_boundary]] = True
        both = is_rim[edges.ends].all(axis=1) & ~edges.is_boundary
        short = (lengths_of(points, edges.ends, size) < shortest) & ~both
        key = edges.ends[:, 0] * len(points) + edges.ends[:, 1]
        short &= ~np.isin(key, banned)
        if not short.any():
            break
        chosen = winners(edges, short, len(points), generator)
        kept, gone, at = contraction(points, edges.ends[chosen], is_rim)
        allowed = may_contract(points, triangles, size, (kept, gone, at), edges.is_boundary[chosen])
        banned = np.concatenate([banned, key[chosen[~allowed]]])
        points[kept[allowed]] = at[allowed]
        number = np.arange(len(points))
        number[gone[allowed]] = kept[allowed]
        triangles = number[triangles]
        triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    used = np.unique(triangles)
    points, triangles = base.compact(points, triangles)
    return points, triangles, size[used]


def winners(edges, wanted, count, generator):
    """Edges of which no two have ends that are the same or neighbours: the smallest of a random order."""
    rank = np.full(len(edges.ends), len(edges.ends), dtype=np.int64)
    rank[wanted] = generator.permutation(int(wanted.sum()))
    a, b = edges.ends.T
    least = np.full(count, len(edges.ends), dtype=np.int64)
    np.minimum.at(least, a, rank)
    np.minimum.at(least, b, rank)
    near = least.copy()
    np.minimum.at(near, a, least[b])
    np.minimum.at(near, b, least[a])
    return np.flatnonzero(wanted & (near[a] == rank) & (near[b] == rank))


def contraction(points, ends, is_rim):
    """(vertex that stays, vertex that goes, where it is to be): a rim's vertex stays where it is."""
    a, b = ends.T
    swap = is_rim[b] & ~is_rim[a]
    kept, gone = np.where(swap, b, a), np.where(swap, a, b)
    at = np.where((is_rim[kept] & ~is_rim[gone])[:, None], points[kept], 0.5 * (points[a] + points[b]))
    return kept, gone, at


def may_contract(points, triangles, size, moves, on_rim):
    """The surface stays a surface, does not fold, and no side gets too long."""
    kept, gone, at = moves
    stars = Stars(triangles, len(points))
    allowed = common_neighbours(stars, triangles, kept, gone) == np.where(on_rim, 1, 2)
    for own, other in ((kept, gone), (gone, kept)):
        row, triangle = stars.rows(own)
        remains = ~(triangles[triangle] == other[row][:, None]).any(axis=1)
        row, corners = row[remains], triangles[triangle[remains]]
        is_own = corners == own[row][:, None]
        before = points[corners]
        after = np.where(is_own[:, :, None], at[row][:, None], before)
        cosine = dot(unit(np.cross(before[:, 1] - before[:, 0], before[:, 2] - before[:, 0])),
                     unit(np.cross(after[:, 1] - after[:, 0], after[:, 2] - after[:, 0])))
        side = np.linalg.norm(np.roll(after, -1, axis=1) - after, axis=2)
        quality = dot(*(2 * [np.cross(after[:, 1] - after[:, 0], after[:, 2] - after[:, 0])])) \
            / np.maximum(side.max(axis=1) ** 4, 1e-300)
        poor = (cosine < STEEPEST) & (base.gammas(before.reshape(-1, 3), np.arange(3 * len(row)).reshape(-1, 3)) > 0.01)
        long = side.max(axis=1) > 1.45 * size[corners].mean(axis=1)
        allowed[row[poor | long | (quality < NO_SLIVER)]] = False
    return allowed


def common_neighbours(stars, triangles, kept, gone):
    """How many vertices both ends have edges to."""
    count = int(triangles.max()) + 1
    found = []
    for own in (kept, gone):
        row, triangle = stars.rows(own)
        key = np.unique((row[:, None] * count + triangles[triangle]).reshape(-1))
        is_end = (key % count == kept[key // count]) | (key % count == gone[key // count])
        found.append(key[~is_end])
    both = np.intersect1d(*found, assume_unique=True)
    return np.bincount(both // count, minlength=len(kept))


def turn(points, triangles, passes=4):
    """Replaces the side between two triangles by their other diagonal where that widens the angles."""
    for _ in range(passes):
        edges = Edges(triangles)
        inner = np.flatnonzero(edges.count == 2)
        a, b = edges.ends[inner].T
        left, right = edges.sides[inner].T
        c, d = opposite(triangles, left, a, b), opposite(triangles, right, a, b)
        gain = angle(points, a, c, b) + angle(points, a, d, b) - np.pi
        wanted = (gain > 1e-3) & ~edges.has(c, d)
        wanted[wanted] &= keeps_sides(points, triangles, (left[wanted], right[wanted]),
                                      (a[wanted], b[wanted], c[wanted], d[wanted]))
        if not wanted.any():
            break
        chosen = separate(np.flatnonzero(wanted), gain, (left, right), (c, d), len(triangles))
        replace(triangles, left[chosen], b[chosen], d[chosen])
        replace(triangles, right[chosen], a[chosen], c[chosen])
    return triangles


def opposite(triangles, triangle, a, b):
    corners = triangles[triangle]
    return corners[np.arange(len(corners)), ((corners != a[:, None]) & (corners != b[:, None])).argmax(axis=1)]


def angle(points, a, at, b):
    return np.arccos(np.clip(dot(unit(points[a] - points[at]), unit(points[b] - points[at])), -1.0, 1.0))


def keeps_sides(points, triangles, both, corners):
    """Both new triangles look the way the old ones did."""
    a, b, c, d = (points[v] for v in corners)
    normal = sum(base.doubled_normals(points, triangles[t]) for t in both)
    first, second = np.cross(c - a, d - a), np.cross(d - b, c - b)
    sign = np.sign(dot(first, normal))
    length = np.linalg.norm(normal, axis=1)
    return (sign == np.sign(dot(second, normal))) & \
        (np.minimum(dot(first, normal) * sign / np.maximum(np.linalg.norm(first, axis=1) * length, 1e-300),
                    dot(second, normal) * sign / np.maximum(np.linalg.norm(second, axis=1) * length, 1e-300)) > 0.5)


def separate(wanted, gain, sides, corners, count):
    """Of wanted edges those with the largest gain in both their triangles; none twice between two vertices."""
    order = wanted[np.argsort(-gain[wanted], kind="stable")]
    rank = np.full(len(gain), len(gain), dtype=np.int64)
    rank[order] = np.arange(len(order))
    least = np.full(count, len(gain), dtype=np.int64)
    for side in sides:
        np.minimum.at(least, side[order], rank[order])
    won = order[(least[sides[0][order]] == rank[order]) & (least[sides[1][order]] == rank[order])]
    pair = np.sort(np.stack([corners[0][won], corners[1][won]], axis=1), axis=1)
    return won[np.unique(pair, axis=0, return_index=True)[1]]


def replace(triangles, chosen, old, new):
    corners = triangles[chosen]
    triangles[chosen] = np.where(corners == old[:, None], new[:, None], corners)
