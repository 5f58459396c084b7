"""Cuts handles a few triangles wide, as noise of a segmentation makes them: no smoothing takes them away."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, dijkstra, minimum_spanning_tree

from . import repair, rims
from . import surface as base
from .surface import Edges, show

SMALL = 16   # edges around: a handle; longer ones are a ring of vessels
ROOTS = 40   # from which a shorter way around is sought
STRIDE = 3   # along a way around: each such vertex becomes a root


def cut(surface, path, say):
    """A handle is cut where it is thinnest."""
    places = []
    for _ in range(200):
        loop = shortest(surface)
        if loop is None:
            break
        if len(loop) > SMALL:
            say(f"branches meet again: a ring, {len(loop)} edges around near {show(surface.points[loop].mean(axis=0))}")
            break
        places.append(surface.points[loop].mean(axis=0))
        surface = without_stubs(repair.apart(surface, path, cut=pairs_of(loop)), places[-1])
    if places:
        say(f"{len(places):,} small handles cut, the first at {show(places[0])}")
    return surface


def without_stubs(surface, place):
    """Both ends of a cut handle closed: they would pass for thin vessels."""
    there = [loop for loop in base.loops(surface.triangles)
             if np.allclose(surface.points[loop].mean(axis=0), place, rtol=0.0, atol=1e-9 * np.ptp(surface.points))]
    return rims.filled(surface, there, lambda text: None)


def pairs_of(loop):
    return np.sort(np.stack([loop, np.roll(loop, -1)], axis=1), axis=1)


def shortest(surface):
    """A curve along edges that does not divide the surface, the shortest that is found; None on a sphere with holes."""
    count = len(surface.points)
    _, triangles = base.closed(surface)
    edges = Edges(triangles)
    vertices = int(triangles.max()) + 1
    if vertices - len(edges.count) + len(triangles) >= 2:
        return None
    best, roots, tried = None, [int(triangles[0, 0])], set()
    while roots and len(tried) < ROOTS:
        root = roots.pop(0)
        tried.add(root)
        for loop in generators(triangles, edges, (vertices, count), root):
            if max(loop) < count and (best is None or len(loop) < len(best)):
                best = loop
            roots += [v for v in loop[::STRIDE] if v < count and v not in tried and v not in roots]
    return None if best is None else np.array(best)


def generators(triangles, edges, counts, root):
    """Two for each handle: edges that are neither in a tree of vertices nor crossed by one of triangles, which prefers edges
    far from the root: so those that are left close short curves.

    counts: of vertices, and of those that are not middles of openings, through which no way leads.
    """
    a, b = edges.ends.T
    vertices, own = counts
    _, first = np.unique(b, return_index=True)
    serves = b < own
    serves[first] = True
    graph = graph_of(vertices, a[serves], b[serves])
    _, before = breadth_first_order(graph, root, directed=False)
    depth = dijkstra(graph, directed=False, indices=root, unweighted=True)
    free = np.flatnonzero((before[a] != b) & (before[b] != a))
    left, right = edges.sides[free].T
    weight = -(depth[a[free]] + depth[b[free]] + 1.0)
    tree = minimum_spanning_tree(coo_matrix((weight, (left, right)), shape=2 * (len(triangles),))).tocoo()
    crossed = set(zip(tree.row.tolist(), tree.col.tolist()))
    for k, pair in zip(free.tolist(), zip(left.tolist(), right.tolist())):
        if pair not in crossed:
            p, q = edges.ends[k].tolist()
            yield joined(way_to_root(before, p), way_to_root(before, q))


def graph_of(count, a, b):
    return coo_matrix((np.ones(len(a), dtype=np.int8), (a, b)), shape=(count, count)).tocsr()


def way_to_root(before, vertex):
    way = [vertex]
    while before[way[-1]] >= 0:
        way.append(int(before[way[-1]]))
    return way


def joined(one, other):
    """Both ways up to where they meet, as a closed curve."""
    while len(one) > 1 and len(other) > 1 and one[-2] == other[-2]:
        one, other = one[:-1], other[:-1]
    return one + other[-2::-1]
