"""The branches of a lumen from its mesh alone, where no lumen.json describes them.

Distances from the inlet along the edges cut the lumen into slabs. The pieces of the slabs that hang together form a graph,
in which every outlet has a way back to the inlet. Where these ways meet is a junction. A piece has the area that its
volume and the distance of its neighbours give. Loops are opened: of two ways to an outlet the one with more contact remains.
"""
import heapq

import numpy as np

from .mesh_file import FACES


def distances(mesh, seeds):
    """Of every vertex from the seeds, along edges (Dijkstra)."""
    pairs = np.vstack([mesh.tets[:, [i, j]] for i in range(4) for j in range(i)])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    length = np.linalg.norm(mesh.vertices[pairs[:, 0]] - mesh.vertices[pairs[:, 1]], axis=1)
    order = np.argsort(np.concatenate([pairs[:, 0], pairs[:, 1]]), kind="stable")
    head = np.concatenate([pairs[:, 1], pairs[:, 0]])[order]
    cost = np.concatenate([length, length])[order]
    first = np.searchsorted(np.concatenate([pairs[:, 0], pairs[:, 1]])[order], np.arange(len(mesh.vertices) + 1))
    found = np.full(len(mesh.vertices), np.inf)
    queue = [(0.0, int(seed)) for seed in seeds]
    found[seeds] = 0.0
    while queue:
        at, vertex = heapq.heappop(queue)
        if at > found[vertex]:
            continue
        for k in range(first[vertex], first[vertex + 1]):
            to = at + cost[k]
            if to < found[head[k]]:
                found[head[k]] = to
                heapq.heappush(queue, (to, int(head[k])))
    return found


def neighbours(tets):
    """Pairs of tetrahedra with a common face."""
    rows = np.sort(tets[:, FACES].reshape(-1, 3), axis=1)
    order = np.lexsort(rows.T[::-1])
    is_same = (rows[order[1:]] == rows[order[:-1]]).all(axis=1)
    return np.stack([order[:-1][is_same] // 4, order[1:][is_same] // 4], axis=1)


def components(count, pairs):
    """A label for each of so many things, the same for those that pairs connect."""
    label = np.arange(count)
    while len(pairs):
        least = label.copy()
        np.minimum.at(least, pairs[:, 0], label[pairs[:, 1]])
        np.minimum.at(least, pairs[:, 1], label[pairs[:, 0]])
        least = least[least]  # halves the way to the least of all
        if (least == label).all():
            break
        label = least
    return np.unique(label, return_inverse=True)[1]


class Pieces:
    """Connected pieces of slabs: slab, volume, centre of each, and its neighbour towards the inlet."""

    def __init__(self, mesh, inlet):
        seeds = np.unique(mesh.triangles_of(inlet))
        far = distances(mesh, seeds)[mesh.tets].mean(axis=1)
        width = 1.5 * mesh.mean_edge(mesh.tets[:, :3])
        slab = np.floor(far / width).astype(int)
        pairs = neighbours(mesh.tets)
        self.of_tet = components(len(mesh.tets), pairs[slab[pairs[:, 0]] == slab[pairs[:, 1]]])
        count = self.of_tet.max() + 1
        self.slab = np.zeros(count, dtype=int)
        self.slab[self.of_tet] = slab
        size = np.abs(mesh.volume(mesh.tets))
        self.volume = np.bincount(self.of_tet, size, count)
        middle = mesh.vertices[mesh.tets].mean(axis=1)
        self.centre = np.stack([np.bincount(self.of_tet, size * middle[:, k], count) for k in range(3)], axis=1)
        self.centre /= self.volume[:, None]
        self.parent = self._parents(self.of_tet[pairs], count)

    def _parents(self, contacts, count):
        """For each piece that of a nearer slab with most common faces, -1 at the inlet."""
        contacts = np.vstack([contacts, contacts[:, ::-1]])
        contacts = contacts[self.slab[contacts[:, 0]] > self.slab[contacts[:, 1]]]
        ways, faces = np.unique(contacts, axis=0, return_counts=True)
        parent = np.full(count, -1)
        for (piece, towards), _ in sorted(zip(map(tuple, ways), faces), key=lambda way: way[1]):
            parent[piece] = towards
        return parent

    def way(self, mesh, opening):
        """Pieces from the inlet to an opening."""
        is_near = np.zeros(len(mesh.vertices), dtype=bool)
        is_near[mesh.triangles_of(opening)] = True
        at = np.bincount(self.of_tet[is_near[mesh.tets].any(axis=1)]).argmax()
        pieces = [int(at)]
        while self.parent[pieces[-1]] >= 0:
            pieces.append(int(self.parent[pieces[-1]]))
        return pieces[::-1]


def chains(ways, inlet):
    """Cuts the tree of the ways at its junctions: (start, end, pieces) of each branch."""
    children = {}
    for pieces in ways.values():
        for above, below in zip(pieces[:-1], pieces[1:]):
            children.setdefault(above, set()).add(below)
    ends = {pieces[-1]: name for name, pieces in ways.items()}
    root = next(iter(ways.values()))[0]
    found, names, todo = [], {}, [(inlet, [root])]
    while todo:
        start, pieces = todo.pop()
        while len(children.get(pieces[-1], ())) == 1 and pieces[-1] not in ends:
            pieces = pieces + list(children[pieces[-1]])
        last = pieces[-1]
        below = sorted(children.get(last, ()))
        end = ends[last] if not below else names.setdefault(last, f"junction-{len(names) + 1}")
        found.append((start, end, pieces))
        if below and last in ends:  # an outlet at a junction: a branch of no length would have no resistance
            found.append((end, ends[last], [last]))
        todo += [(end, [last, piece]) for piece in below]
    return found


def radii_of(pieces, chosen, points):
    """Of sections whose pieces of so many volumes lie between the middles of the points."""
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = np.concatenate([step[:1], 0.5 * (step[1:] + step[:-1]), step[-1:]])
    return np.sqrt(pieces.volume[chosen] / (np.pi * np.maximum(length, 1e-9)))


def branch_of(pieces, chain, openings):
    """One branch as lumen.json has it; radii at its openings are those of the openings."""
    start, end, chosen = chain
    by_name = {opening["name"]: opening for opening in openings}
    points = pieces.centre[chosen]
    is_open = [start in by_name, end in by_name]
    inner = slice(1 if is_open[0] else 0, len(points) - 1 if is_open[1] else len(points))
    radii = radii_of(pieces, chosen, points) if len(points) > 1 else np.array([])
    points, radii = points[inner], radii[inner]
    for at, name in ((0, start), (1, end)):
        if is_open[at]:
            new = [by_name[name]["centre"]], [by_name[name]["radius"]]
            points = np.vstack([points, new[0]][::1 if at else -1])
            radii = np.concatenate([radii, new[1]][::1 if at else -1])
    if len(radii) > 2:  # the ends of slabs are cut by openings and junctions: a median of three calms them
        radii[1:-1] = np.median([radii[:-2], radii[1:-1], radii[2:]], axis=0)
    if len(points) == 1:
        points, radii = np.vstack([pieces.centre[chosen[:1]], points]), np.repeat(radii, 2)
    return {"points": points.tolist(), "radii": radii.tolist(), "start": start, "end": end}


def find(mesh, openings, inlet):
    """The branches between openings and junctions, from the inlet on."""
    pieces = Pieces(mesh, inlet)
    ways = {opening["name"]: pieces.way(mesh, opening["name"]) for opening in openings if opening["name"] != inlet}
    return [branch_of(pieces, chain, openings) for chain in chains(ways, inlet)]
