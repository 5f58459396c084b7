"""The line through the middle of a vessel: from the largest end to each other one through the widest balls."""
import dataclasses

import numpy as np
from scipy.sparse.csgraph import dijkstra

from .faults import BadSurface
from .surface import show

STEP = 0.25      # radii between the points of a branch
APART = 0.8      # radii by which two lines differ that have parted
TOGETHER = 0.3   # the same where the branch begins
PASSES = 12      # of smoothing
NEAR = 3         # points: branches that begin so near to one another begin at one junction


@dataclasses.dataclass
class Branch:
    """From a name to a name, of an opening or junction-k."""
    points: np.ndarray
    radii: np.ndarray
    start: str
    end: str


def branches(medial, rims, path):
    """Of a tree with its root at the first rim."""
    if len(rims) < 2:
        return []
    graph = medial.graph.copy()
    a, b = graph.nonzero()
    graph.data = graph.data / np.minimum(medial.radii[a], medial.radii[b]) ** 2
    ends = [widest_at(medial, rim) for rim in rims]
    length, before = dijkstra(graph, directed=False, indices=ends[0], return_predecessors=True)
    lines = []
    for rim, end in zip(rims[1:], ends[1:]):
        if not np.isfinite(length[end]):
            raise BadSurface(f"{path}: no way leads from the opening at {show(rims[0].centre)} to that at "
                             f"{show(rim.centre)} inside the surface: is the vessel closed between them, or much "
                             "narrower than the voxels?", place=rim.centre)
        lines.append(evened(walk(medial, before, end), rims[0], rim))
    return tree(lines, rims)


def widest_at(medial, rim):
    """The ball in the middle of an opening."""
    offset = np.linalg.norm(medial.centres - rim.centre, axis=1)
    return int((offset - 0.5 * np.minimum(medial.radii, rim.radius)).argmin())


def walk(medial, before, end):
    """Balls from the root to an end."""
    order = [end]
    while before[order[-1]] >= 0:
        order.append(before[order[-1]])
    order = order[::-1]
    return np.column_stack([medial.centres[order], medial.radii[order]])


def evened(line, first, last):
    """Ends at the openings' centres, points at even steps, smoothed."""
    line = line[in_front(line, first) & in_front(line, last)]
    line = np.vstack([[*first.centre, first.radius], line, [*last.centre, last.radius]])
    along = arc_length(line)
    step = STEP * min(first.radius, last.radius)
    at = np.linspace(0.0, along[-1], max(int(np.ceil(along[-1] / step)) + 1, 5))
    line = np.stack([np.interp(at, along, line[:, k]) for k in range(4)], axis=1)
    for _ in range(PASSES):
        line[1:-1] = 0.25 * line[:-2] + 0.5 * line[1:-1] + 0.25 * line[2:]
    return line


def in_front(line, rim):
    """What stands before an opening, not at its plane or behind."""
    offset = rim.centre - line[:, :3]
    return (offset @ rim.normal > 0.4 * rim.radius) | (np.linalg.norm(offset, axis=1) > 2.0 * rim.radius)


def arc_length(line):
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line[:, :3], axis=0), axis=1))])


class Node:
    """A part that several lines have in common, and what begins at its end."""

    def __init__(self, line, members):
        self.line, self.members = line, members


def tree(lines, rims):
    """Cuts lines where they part: the common piece once, then each by itself."""
    found, number = [], [0]

    def grow(members, start, name):
        if len(members) == 1:
            line = lines[members[0]][start[members[0]]:]
            found.append(Branch(line[:, :3], line[:, 3], name, rims[members[0] + 1].name))
            return
        first, groups, ends = parting(lines, members, start)
        number[0] += 1
        junction = f"junction-{number[0]}"
        line = lines[first][start[first]:ends[first] + 1]
        found.append(Branch(line[:, :3], line[:, 3], name, junction))
        for group in groups:
            for member in group:  # all go on from where the trunk ends
                begin_at(line[-1, :3], lines[member][ends[member]:])
            grow(group, ends, junction)

    grow(list(range(len(lines))), {k: 0 for k in range(len(lines))}, rims[0].name)
    return found


def begin_at(place, line):
    """Moves the first point of a line; the points that follow within three of its radii go with it, less and less."""
    along = arc_length(line)
    part = np.minimum(along / min(3.0 * line[0, 3], along[-1]), 1.0)
    line[:, :3] += 0.5 * (1.0 + np.cos(np.pi * part))[:, None] * (place - line[0, :3])


def parting(lines, members, start):
    """Where the first of the lines leaves the others: (a line that stays, groups, last common point of each)."""
    reference = members[0]
    leaves = {}
    for other in members[1:]:
        leaves[other] = leaving(lines[reference][start[reference]:], lines[other][start[other]:])
    earliest = min(leaves.values())
    stay = [reference] + [k for k in members[1:] if leaves[k] > earliest + NEAR]
    leave = [k for k in members[1:] if leaves[k] <= earliest + NEAR]
    ways = [lines[k][start[k]:] for k in (reference, *leave)]
    begin = min(last_together(ways[0][:earliest + 1], way) for way in ways[1:])
    cut = start[reference] + min(max(begin, 1), len(ways[0]) - 2)
    ends = {reference: cut}
    for k in members[1:]:
        offset = np.linalg.norm(lines[k][start[k]:, :3] - lines[reference][cut, :3], axis=1)
        ends[k] = start[k] + min(max(int(offset.argmin()), 1), len(lines[k]) - start[k] - 2)
    return reference, [stay] + together(lines, leave, ends), ends


def together(lines, leave, ends):
    """Those that leave at one junction, and go the same way on, are one group."""
    groups = []
    for k in leave:
        for group in groups:
            if leaving(lines[group[0]][ends[group[0]]:], lines[k][ends[k]:]) > 2 * NEAR:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def leaving(a, b):
    """The point of the first line from which on the second is apart from it, by a part of its radius."""
    apart = distance_of(a, b) > APART
    return int(apart.argmax()) if apart.any() else len(a) - 2


def last_together(a, b):
    """The last point of the first line that the second is still near."""
    near = np.flatnonzero(distance_of(a, b) < TOGETHER)
    return int(near[-1]) if len(near) else len(a) - 1


def distance_of(a, b):
    """Of each point of the first line from the points of the second, in radii of the thinner vessel."""
    distance = np.array([np.linalg.norm(b[:, :3] - p[:3], axis=1).min() for p in a])
    return distance / np.minimum(a[:, 3], np.median(b[:, 3]))
