"""Cuts handles a few triangles wide, as noise of a segmentation makes them: no smoothing takes them away."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order

from . import repair
from . import surface as base
from .surface import Edges, show

SMALL = 16   # edges around: a handle; longer ones are a ring of vessels
ROOTS = 4    # from which a shorter way around is sought


def cut(surface, path, say):
    """A cut leaves two small holes, which are filled with the others."""
    places = []
    for _ in range(200):
        loop = shortest(surface)
        if loop is None:
            break
        if len(loop) > SMALL:
            say(f"branches meet again: a ring, {len(loop)} edges around near {show(surface.points[loop].mean(axis=0))}")
            break
        places.append(surface.points[loop].mean(axis=0))
        surface = repair.apart(surface, path, cut=pairs_of(loop))
    if places:
        say(f"{len(places):,} small handles cut, the first at {show(places[0])}")
    return surface


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
    best, root = None, int(triangles[0, 0])
    for _ in range(ROOTS):
        found = [loop for loop in generators(triangles, edges, vertices, root) if max(loop) < count]
        if not found:
            break
        shorter = min(found, key=len)
        if best is not None and len(shorter) >= len(best):
            break
        best, root = shorter, shorter[0]
    return None if best is None else np.array(best)


def generators(triangles, edges, vertices, root):
    """Two for each handle: edges that are neither in a tree of vertices nor crossed by one of triangles."""
    a, b = edges.ends.T
    _, before = breadth_first_order(graph_of(vertices, a, b), root, directed=False)
    is_free = (before[a] != b) & (before[b] != a)
    left, right = edges.sides[is_free].T
    _, across = breadth_first_order(graph_of(len(triangles), left, right), 0, directed=False)
    rest = np.flatnonzero(is_free)[(across[left] != right) & (across[right] != left)]
    for p, q in edges.ends[rest].tolist():
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
