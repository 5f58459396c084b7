"""Puts a surface in order: what is harmless is mended and said, what is not ends with its place."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order
from scipy.spatial import cKDTree

from . import surface as base
from .faults import BadSurface
from .surface import Edges, Surface, show

SAME = 1e-5     # of the median edge: two points at one place
SHORT = 0.02    # of the median edge: a side that is contracted
SLIVER = 1e-3   # quality of a triangle that is reported
SPECK = 0.03    # of the whole area: a piece that is dropped


def mended(surface, path, say):
    """One piece, manifold, its normals outward. Rims may be left."""
    surface = without_repeats(surface, path, say)
    surface = without_slivers(surface, say)
    surface = oriented(apart(surface, path), say)
    surface = apart(largest_piece(surface, path, say), path)
    return outward(surface, path, say)


def median_edge(surface):
    return float(np.median(base.edge_lengths(surface.points, surface.triangles)))


def relabelled(surface, label):
    """Points of one label become one, at their mean; triangles that lose a side, or are there twice, go."""
    count = int(label.max()) + 1
    size = np.bincount(label, minlength=count)
    points = np.stack([np.bincount(label, weights=surface.points[:, k], minlength=count) for k in range(3)], axis=1)
    triangles = label[surface.triangles]
    ordered = np.sort(triangles, axis=1)
    kept = (np.diff(ordered, axis=1) > 0).all(axis=1)
    _, first = np.unique(ordered, axis=0, return_index=True)
    is_first = np.zeros(len(triangles), dtype=bool)
    is_first[first] = True
    repeated = int((kept & ~is_first).sum())
    moved = Surface(points / size[:, None], triangles, surface.face, surface.names)
    return moved.take(kept & is_first), repeated


def without_repeats(surface, path, say):
    extent = float(np.ptp(surface.points, axis=0).max())
    if not extent > 0.0:
        raise BadSurface(f"{path}: all points stand at one place, expected the surface of a lumen")
    near = min(SAME * max(median_edge(surface), 1e-9 * extent), 1e-4 * extent)
    pairs = cKDTree(surface.points).query_pairs(near, output_type="ndarray")
    label, _ = base.parts(len(surface.points), pairs[:, 0], pairs[:, 1])
    known = len(surface.triangles)
    surface, repeated = relabelled(surface, label)
    flat = known - len(surface.triangles) - repeated
    if repeated or flat:
        say(f"{repeated:,} triangles that are there twice and {flat:,} without an area dropped")
    if len(surface.triangles) < 20:
        raise BadSurface(f"{path}: {len(surface.triangles)} triangles, expected the surface of a lumen", surface)
    return surface


def without_slivers(surface, say):
    """Contracts sides that are far shorter than others, as where a plane has cut a voxel's corner."""
    slivers = base.gammas(surface.points, surface.triangles) < SLIVER
    edges = Edges(surface.triangles)
    length = np.linalg.norm(np.diff(surface.points[edges.ends], axis=1)[:, 0], axis=1)
    short = length < SHORT * np.median(length)
    if not short.any() and not slivers.any():
        return surface
    worst = int(base.gammas(surface.points, surface.triangles).argmin())
    place = show(surface.points[surface.triangles[worst]].mean(axis=0))
    a, b = edges.ends[short].T
    label, _ = base.parts(len(surface.points), a, b)
    say((f"{int(slivers.sum()):,} sliver triangles, the worst at {place}; " if slivers.any() else "")
        + f"{int(short.sum()):,} sides shorter than {SHORT:g} of the median contracted")
    return relabelled(surface, label)[0]


def apart(surface, path, cut=None):
    """Where rims or sheets meet in a vertex or an edge only, each gets vertices of its own. cut: edges that join no more."""
    triangles = surface.triangles
    edges = Edges(triangles)
    crowded = int((edges.count > 2).sum())
    if crowded > 0.02 * len(edges.count):
        at = surface.points[edges.ends[edges.count > 2]].mean(axis=(0, 1))
        raise BadSurface(f"{path}: at {crowded:,} edges more than two triangles meet, as near {show(at)}: sheets that "
                         "touch, or the surface is there twice. Save its outer side alone", surface, at)
    joins = edges.count == 2
    if cut is not None:
        joins[edges.number(cut[:, 0], cut[:, 1])] = False
    inner = np.flatnonzero(joins)
    first, second = corners_at(triangles, edges, inner, 0), corners_at(triangles, edges, inner, 1)
    label, _ = base.parts(3 * len(triangles), first.reshape(-1), second.reshape(-1))
    origin = np.zeros(int(label.max()) + 1, dtype=np.int64)
    origin[label] = triangles.reshape(-1)
    return Surface(surface.points[origin], label.reshape(-1, 3), surface.face, surface.names)


def corners_at(triangles, edges, chosen, side):
    """Of the triangle on a side of edges: the corners (3 t + i) at both ends, in the order of the ends."""
    triangle = edges.sides[chosen, side]
    return np.stack([3 * triangle + (triangles[triangle] == edges.ends[chosen, k][:, None]).argmax(axis=1)
                     for k in range(2)], axis=1)


def oriented(surface, say):
    """Neighbours on the same side; each piece as most of its triangles."""
    triangles = surface.triangles.copy()
    edges = Edges(triangles)
    inner = np.flatnonzero(edges.count == 2)
    a, b = edges.sides[inner].T
    agrees = ~(runs_up(triangles, edges, inner, a) == runs_up(triangles, edges, inner, b))
    if agrees.all():
        return surface
    turned = signs(len(triangles), a, b, agrees) < 0
    label, count = base.pieces(triangles)
    mostly = np.bincount(label, weights=turned, minlength=count) > 0.5 * np.bincount(label, minlength=count)
    turned ^= mostly[label]
    triangles[turned] = triangles[turned][:, ::-1]
    say(f"{int(turned.sum()):,} of {len(triangles):,} triangles turned round, to be like their neighbours")
    return Surface(surface.points, triangles, surface.face, surface.names)


def runs_up(triangles, edges, chosen, triangle):
    """Whether the triangle runs along the edge from its smaller vertex to the larger one."""
    at = (edges.of[triangle] == chosen[:, None]).argmax(axis=1)
    return triangles[triangle, at] == edges.ends[chosen, 0]


def signs(count, a, b, agrees):
    """+1 or -1 per triangle, by a walk from neighbour to neighbour."""
    sign = np.ones(count)
    weight = np.where(agrees, 1.0, -1.0)
    graph = coo_matrix((np.concatenate([weight, weight]), (np.concatenate([a, b]), np.concatenate([b, a]))),
                       shape=(count, count)).tocsr()
    label, number = base.parts(count, a, b)
    for start in np.unique(label, return_index=True)[1]:
        order, before = breadth_first_order(graph, start)
        relation = np.asarray(graph[order[1:], before[order[1:]]]).reshape(-1)
        for triangle, parent, times in zip(order[1:].tolist(), before[order[1:]].tolist(), relation.tolist()):
            sign[triangle] = sign[parent] * times
    return sign


def largest_piece(surface, path, say):
    label, count = base.pieces(surface.triangles)
    if count == 1:
        return surface
    area = np.bincount(label, weights=base.areas(surface.points, surface.triangles), minlength=count)
    order = np.argsort(-area)
    place = [surface.points[surface.triangles[label == k]].mean(axis=(0, 1)) for k in order[:2]]
    if area[order[1]] > SPECK * area.sum():
        raise BadSurface(f"{path}: {count} pieces that do not hang together, of {area[order[0]]:.4g} mm² about "
                         f"{show(place[0])} and {area[order[1]]:.4g} mm² about {show(place[1])}. A lumen is one piece: "
                         "delete what does not belong to it, or mesh each vessel by itself", surface, place[1])
    say(f"{count - 1:,} pieces apart from the vessel dropped, the largest of {area[order[1]]:.3g} mm² about "
        f"{show(place[1])}")
    return surface.take(label == order[0])


def outward(surface, path, say):
    inside = base.volume(*base.closed(surface))
    extent = np.ptp(surface.points, axis=0).max()
    if abs(inside) < 1e-7 * extent ** 3:
        raise BadSurface(f"{path}: encloses no volume, expected the surface of a lumen: a tube, open or closed at "
                         "its ends", surface)
    if inside < 0.0:
        say("all normals turned outward")
        return Surface(surface.points, surface.triangles[:, ::-1], surface.face, surface.names)
    return surface
