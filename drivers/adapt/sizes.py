"""Sizes of elements by the errors of a run, as many elements as are wanted."""
import dataclasses

import numpy as np

from lumen import layers
from lumen import sizes as of_lumen
from lumen import surface as base
from lumen.surface import Edges
from report.surfaces import edges_of

from .errors import OF_TETRAHEDRON, OF_TRIANGLE
from .recovery import volumes

GRADING = 0.3              # growth of the size per length
FEWEST_ACROSS = 3.0        # elements across the lumen
FEWEST_AROUND = 12.0       # around a full circle of the surface's curvature
SMALLEST = 1.0 / 30.0      # of the local radius
THINNEST, THICKEST = 0.02, 0.3   # of the size: the layer at the wall
ALL = 0.6                  # of the size: all layers
GROWTH = 1.8               # of layers, where none is asked for
ONE_SIDED = 0.5            # what the shear at the wall feels of an error on its one side, beside that along it
MOST_LAYERS = 8
ROUGH = 2.0                # of each error: layers are not worth that


def bounds(target, radii):
    """Of sizes at the vertices of a surface: (least, largest)."""
    edges = Edges(target.triangles)
    by_radius = 2.0 * of_lumen.averaged(edges, radii, 3) / FEWEST_ACROSS
    bend = of_lumen.averaged(edges, of_lumen.curvature(target, edges), 4)
    return SMALLEST * radii, np.clip(2.0 * np.pi / FEWEST_AROUND / np.maximum(bend, 1e-12), 0.4 * by_radius, by_radius)


def graded(count, edges, lengths, size):
    """The largest sizes that are nowhere above these, nor above that of a neighbour and what the way to it permits."""
    ends = np.concatenate([edges, edges[:, ::-1]])
    order = np.argsort(ends[:, 0], kind="stable")
    ends, room = ends[order], GRADING * np.concatenate([lengths, lengths])[order]
    first = np.searchsorted(ends[:, 0], np.arange(count))
    while True:
        fresh = np.minimum(size, np.minimum.reduceat(size[ends[:, 1]] + room, first))
        if np.isfinite(fresh).all() and (np.isfinite(size).all() and (size - fresh).max() < 1e-3 * fresh.min()):
            return fresh
        size = fresh


@dataclasses.dataclass
class Plan:
    """size: at the vertices of the run's blood. first: thickness of the layer at the wall, there."""
    size: np.ndarray
    first: np.ndarray
    layers: int
    growth: float


class Planner:
    """The run's mesh, and what its errors ask for; through: elements through the wall."""

    def __init__(self, run, wish, limits, through, options):
        self.wish, self.through, self.options = wish, through, options
        self.points, self.tets, self.wall = run.points, run.tets, run.wall
        self.limits, self.most = limits, MOST_LAYERS
        self.volumes = volumes(run.points, run.tets)
        self.areas = base.areas(run.points, run.wall)
        self.edges = edges_of(run.tets)
        self.lengths = np.linalg.norm(run.points[self.edges[:, 0]] - run.points[self.edges[:, 1]], axis=1)
        self.on = np.unique(run.wall)

    def plan(self, e):
        """For errors of this part of the whole."""
        size = np.minimum(self.wish.core * e ** 0.4, self.wish.wall * e ** 0.5)
        size = np.clip(size, self.limits.least, self.limits.largest)
        size = graded(len(size), self.edges, self.lengths, size)
        first = self.first(size)
        count, growth = self.layering(first, size)
        return Plan(size, np.minimum(first, self.limits.room / max((growth ** np.arange(count)).sum(), 1.0)), count, growth)

    def first(self, size):
        """Thickness of the layer at the wall. There the slope of a parabola changes by first/reach of itself, and the shear along
        the wall within a triangle by its variation, which grows with the triangle."""
        on, wish = self.on, self.wish
        area = np.bincount(self.wall.reshape(-1), np.repeat(self.areas, 3), len(size))[on]
        wider = np.sqrt((area * (size[on] / wish.side[on]) ** 2).sum() / area.sum())
        thickness = np.ones(len(size))
        thickness[on] = np.clip(ONE_SIDED * wish.variation * wider * wish.reach[on], THINNEST * size[on], THICKEST * size[on])
        return thickness

    def layering(self, first, size):
        """As few layers as reach through the boundary layer, but for where the core's elements are as thin."""
        on, growth = self.on, self.options.growth or GROWTH
        wanted = self.options.layers
        if wanted is None:
            far = np.minimum(np.minimum(self.wish.reach[on], ALL * size[on]), self.limits.room[on])
            far = float(np.median(far / first[on]))
            count = far if abs(growth - 1.0) < 1e-6 else np.log(max(1.0 + far * (growth - 1.0), 1e-9)) / np.log(growth)
            wanted = int(np.clip(np.ceil(count - 0.05), 1, self.most))
        return wanted, growth

    def count(self, plan):
        """Tetrahedra of the blood in the layers and in the core, and of the wall."""
        of_triangle = plan.size[self.wall].mean(axis=1)
        triangles = (self.areas / (OF_TRIANGLE * of_triangle ** 2)).sum()
        thickness = plan.first * (plan.growth ** np.arange(plan.layers)).sum() if plan.layers else 0.0 * plan.first
        lost = (self.areas * (thickness / plan.size ** 3)[self.wall].mean(axis=1)).sum()
        core = (self.volumes / (plan.size[self.tets] ** 3).mean(axis=1)).sum()
        core = max(core - lost, 0.2 * core) / OF_TETRAHEDRON
        return np.array([3.0 * plan.layers * triangles, core, 3.0 * self.through * triangles])

    def with_count(self, wanted):
        """The plan with this number of tetrahedra, and e. Fewer layers where they would leave nothing for the core."""
        self.most = MOST_LAYERS
        while True:
            plan, e = self.bisected(wanted)
            if e < ROUGH or plan.layers <= 1 or self.options.layers is not None:
                return plan, e
            self.most = plan.layers - 1

    def bisected(self, wanted):
        low, high = 1e-4, 1e3
        while high / low > 1.002:
            e = np.sqrt(low * high)
            if self.count(self.plan(e)).sum() > wanted:
                low = e
            else:
                high = e
        return self.plan(high), high


@dataclasses.dataclass
class Limits:
    """At the vertices of the run's blood: bounds of sizes, largest but at the wall infinite, and of the layers' thickness."""
    least: np.ndarray
    largest: np.ndarray
    room: np.ndarray


def limits_at(run, near, bounds, radii):
    """Those of the nearest vertex of the surface."""
    on = np.zeros(len(run.points), dtype=bool)
    on[run.wall] = True
    return Limits(bounds[0][near], np.where(on, bounds[1][near], np.inf), layers.THICKEST * radii[near])
