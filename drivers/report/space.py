"""Scenes: coloured surfaces in space and arrows, and how they are seen."""
from dataclasses import dataclass, field

import numpy as np

from report.section import Section, norm_of


@dataclass
class Piece:
    """Triangles with a colour at each point, red, green and blue from 0 to 1."""
    points: np.ndarray
    triangles: np.ndarray
    colours: np.ndarray


@dataclass
class Scene:
    pieces: list = field(default_factory=list)
    arrows: tuple = (np.zeros((0, 3)), np.zeros((0, 3)))  # where they begin, from there to the tip

    def points(self):
        return np.concatenate([p.points for p in self.pieces])


@dataclass
class View:
    """Right, up and towards the eye, of unit length: rows of axes."""
    axes: np.ndarray

    def box(self, scenes):
        """(left, right, bottom, top) around all of them, with a margin."""
        seen = np.concatenate([s.points() for s in scenes]) @ self.axes.T
        low, high = seen.min(axis=0)[:2], seen.max(axis=0)[:2]
        pad = 0.03 * (high - low).max()
        return low[0] - pad, high[0] + pad, low[1] - pad, high[1] + pad


def views(plane):
    """Onto the plane of the sections, so that a fork is seen as one; and aslant, turned about its length and a
    little from ahead. The vessel lies from left to right in both."""
    normal, up, along = plane.axes
    if np.dot(np.cross(along, up), normal) < 0:
        normal = -normal
    first = np.array([along, up, normal])
    turn, ahead = np.radians(38), np.radians(-22)
    about = np.array([[1, 0, 0], [0, np.cos(turn), -np.sin(turn)], [0, np.sin(turn), np.cos(turn)]])
    aside = np.array([[np.cos(ahead), 0, np.sin(ahead)], [0, 1, 0], [-np.sin(ahead), 0, np.cos(ahead)]])
    return View(first), View(aside @ about @ first)


def kept_half(level, triangles):
    """The part of triangles where level <= 0, in terms of edges: new triangles, and of each corner the two nodes
    that it lies between and the weight of the second."""
    level = np.where(abs(level) < 1e-9 * np.ptp(level), 0.0, level)
    above = level > 0
    count = above[triangles].sum(axis=1)
    corners = [np.repeat(triangles[count == 0].reshape(-1, 3, 1), 2, axis=2)]
    for wanted in (1, 2):
        some = triangles[count == wanted]
        lone = above[some].argmax(axis=1) if wanted == 1 else (~above[some]).argmax(axis=1)
        rows = np.arange(len(some))
        a, b, c = (some[rows, (lone + k) % 3] for k in range(3))
        edge = lambda i, j: np.stack([i, j], axis=1)  # noqa: E731
        if wanted == 1:
            corners += [np.stack([edge(a, b), edge(b, b), edge(c, c)], axis=1),
                        np.stack([edge(a, b), edge(c, c), edge(a, c)], axis=1)]
        else:
            corners.append(np.stack([edge(a, a), edge(a, b), edge(a, c)], axis=1))
    corners = np.concatenate(corners).reshape(-1, 2)
    edges, index = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True)
    la, lb = level[edges[:, 0]], level[edges[:, 1]]
    weight = la / np.where(la == lb, 1.0, la - lb)
    return index.reshape(-1, 3), edges, np.where(edges[:, 0] == edges[:, 1], 0.0, weight)


class Stage:
    """The vessel at one time, deformed by factor times the displacement, and cut by the plane of the sections."""

    def __init__(self, run, group, factor, plane):
        self.run, self.group, self.factor = run, group, factor
        self.views = views(plane)
        self.normal = self.views[0].axes[2]
        self.level = plane.level * (self.normal @ plane.axes[0])  # the eye may be on either side

    def moved(self, grid):
        return self.run.mesh(grid)[0] + self.factor * self.run.displacement(self.group, grid)

    def surface(self, grid, part, colours):
        """colours: at all points of the grid."""
        return Piece(self.moved(grid)[part.nodes], part.triangles, colours[part.nodes])

    def half(self, grid, part, colours):
        """What lies behind the plane."""
        nodes = part.nodes
        triangles, edges, weight = kept_half(self.run.mesh(grid)[0][nodes] @ self.normal - self.level, part.triangles)
        a, b, w = nodes[edges[:, 0]], nodes[edges[:, 1]], weight[:, None]
        moved = self.moved(grid)
        return Piece((1 - w) * moved[a] + w * moved[b], triangles, (1 - w) * colours[a] + w * colours[b])

    def cut(self, grid, colours):
        points, tets = self.run.mesh(grid)
        section = Section((points @ self.normal)[:, None].repeat(3, axis=1), tets, self.level, 0.0)
        return Piece(section.at_corners(self.moved(grid)), section.triangles, section.at_corners(colours))

    def arrows(self):
        """Velocities in the cut, about 30 along the vessel, the longest a little longer than their distance."""
        points, tets = self.run.mesh("fluid")
        velocity = self.run.nodal(self.group, "fluid", "velocity")
        section = Section((points @ self.normal)[:, None].repeat(3, axis=1), tets, self.level, 0.0)
        if section.is_empty():
            return Scene().arrows
        place, arrow = section.at_corners(self.moved("fluid")), section.at_corners(velocity)
        flat = place @ self.views[0].axes[:2].T
        cell = np.ptp(flat, axis=0).max() / 30
        _, chosen = np.unique(np.floor(flat / cell).astype(int), axis=0, return_index=True)
        speed = norm_of(arrow)
        chosen = chosen[speed[chosen] > 0.02 * max(speed.max(), 1e-300)]
        lift = 0.2 * cell * self.normal  # before the cut, not in it
        return place[chosen] + lift, 1.6 * cell / max(speed.max(), 1e-300) * arrow[chosen]
