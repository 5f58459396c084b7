"""How wrong a run is where: estimates of the errors of the velocity's gradient, of the shear at the wall and of its stress."""
import dataclasses

import numpy as np
from scipy.spatial import cKDTree

from lumen import surface as base
from lumen.sizes import averaged
from lumen.surface import Edges

from . import columns, recovery

OF_TETRAHEDRON = 0.25   # volume of a tetrahedron over the cube of the size that was asked for, as Gmsh fills
OF_TRIANGLE = 0.48      # area of a triangle over its square, as drivers/lumen/remesh.py makes them
FEWEST = 0.02           # of the mean square: what is less counts as if it were so much
SHEAR = "shear at the wall"
DEPTHS = (0.1, 0.25, 0.5, 1.0)   # of the radius: where the speed beside the wall is looked for


@dataclasses.dataclass
class Errors:
    """Squares, over the outputs of a beat.

    of_tets    integral of |G(grad u) - grad u|^2 over each tetrahedron of the blood, and `whole` that of |grad u|^2 over all
    along      what is to be resolved along the wall: (squares of its variation in each triangle, integral of its square)
    speed      |u|^2 near each vertex of the wall, and `slope` |du/dn|^2 there
    """
    of_tets: np.ndarray
    whole: float
    along: dict
    speed: np.ndarray
    slope: np.ndarray
    layers: columns.Columns


class Sum:
    """Of squares over the outputs: their mean, or the largest of each."""

    def __init__(self, over):
        self.over, self.value, self.count = over, 0.0, 0

    def add(self, squares):
        self.value = np.maximum(self.value, squares) if self.over == "max" else self.value + squares
        self.count += 1

    def result(self):
        return self.value if self.over == "max" else self.value / max(self.count, 1)


def estimate(run, radii, over, beat):
    """Of an OldRun; radii: of the lumen, at its vertices."""
    own = recovery.recovery(run.points, run.tets)
    volumes, slopes = recovery.shape_gradients(run.points, run.tets)
    on, normals = np.unique(run.wall), base.vertex_normals(run.points, run.wall)
    inside = beneath(run, on, normals, radii)
    sums = {name: Sum(over) for name in ("tets", "whole", "speed", "slope")}
    along = {SHEAR: Along(run, "fluid", "wall_shear_stress", over), "wall's stress": Along(run, "wall", "recovered_stress", over)}
    for output in run.outputs:
        beat(f"errors at {run.run.fields[output].attrs['time']:g} ms")
        u = run.field(output, "fluid", "velocity")
        gradient = own.gradient(u)
        squares, whole = of_elements(gradient, np.einsum("maj,mac->mcj", slopes, u[run.tets]), volumes, run.tets)
        slope = np.einsum("vci,vi->vc", gradient[on], normals[on])
        for name, value in (("tets", squares), ("whole", whole), ("slope", (slope ** 2).sum(axis=1)),
                            ("speed", (u[inside] ** 2).sum(axis=2).max(axis=0))):
            sums[name].add(value)
        for each in along.values():
            each.add(output)
    found = {name: total.result() for name, total in sums.items()}
    there = {name: each.result() for name, each in along.items() if each.is_there}
    return Errors(found["tets"], found["whole"], there, found["speed"], found["slope"],
                  columns.peeled(run.points, run.tets, run.wall))


def beneath(run, on, normals, radii):
    """Vertices near to lines from the wall's vertices inwards, as deep as the radius: a row for each depth."""
    tree = cKDTree(run.points)
    return np.stack([tree.query(run.points[on] - depth * radii[on, None] * normals[on])[1] for depth in DEPTHS])


def of_elements(recovered, slopes, volumes, tets):
    """Integrals over tetrahedra of |G - g|^2, G linear with these values at vertices, and of |g|^2 over all of them."""
    apart = recovered[tets] - slopes[:, None]
    square = lambda a: (a * a).sum(axis=(-1, -2))  # noqa: E731
    # integral of |sum N_a d_a|^2 = |T|/20 (sum |d_a|^2 + |sum d_a|^2)
    return (volumes / 20.0 * (square(apart).sum(axis=1) + square(apart.sum(axis=1))), float((volumes * square(slopes)).sum()))


class Along:
    """A field at points of the wall's inner side: how it varies within each triangle there."""

    def __init__(self, run, grid, name, over):
        self.run, self.grid, self.name = run, grid, name
        self.at = np.arange(len(run.points))
        self.is_there = grid in run.run.grids() and run.field(run.outputs[-1], grid, name) is not None
        if self.is_there and grid == "wall":
            self.at = cKDTree(run.run.fields["wall/points"][:]).query(run.points)[1]
        self.areas = base.areas(run.points, run.wall)
        self.squares, self.whole = Sum(over), Sum(over)

    def add(self, output):
        if not self.is_there:
            return
        values = self.run.field(output, self.grid, self.name)
        corners = values.reshape(len(values), -1)[self.at[self.run.wall]]
        middle = corners.mean(axis=1, keepdims=True)
        self.squares.add(self.areas * ((corners - middle) ** 2).sum(axis=(1, 2)) / 3.0)
        self.whole.add(float((self.areas * (middle ** 2).sum(axis=(1, 2))).sum()))

    def result(self):
        return self.squares.result(), self.whole.result()


def lines(errors):
    """Of the whole, in words."""
    yield f"the velocity's gradient is off by {np.sqrt(errors.of_tets.sum() / max(errors.whole, 1e-300)):.2f} of itself, by the estimate"
    for name, values in errors.along.items():
        yield f"the {name} varies within a triangle by {variation(*values):.2f} of itself"


def variation(squares, whole):
    return float(np.sqrt(squares.sum() / max(whole, 1e-300)))


@dataclasses.dataclass
class Wish:
    """At vertices, where each error is to be a part e of the whole: core times e^0.4 are sizes within, wall times e^0.5 those
    along the wall. variation: of the shear within triangles as they are, of itself. side: how wide these are, at vertices;
    reach: thickness of the boundary layer there."""
    core: np.ndarray
    wall: np.ndarray
    variation: float
    side: np.ndarray
    reach: np.ndarray


def wished(errors, run):
    """By errors e_T of elements that are to be the same everywhere: h (e/e_T)^(1/(1 + d/2))."""
    count = len(run.points)
    volumes = recovery.volumes(run.points, run.tets)
    size = np.cbrt(volumes / OF_TETRAHEDRON)
    core = np.where(errors.layers.is_layer, np.inf, size * relative(errors.of_tets, errors.whole) ** (-0.5 / 2.5))
    side = np.sqrt(base.areas(run.points, run.wall) / OF_TRIANGLE)
    edges = Edges(run.wall)
    wall = np.full(count, np.inf)
    for squares, whole in errors.along.values():
        wall = np.minimum(wall, smooth(edges, side * relative(squares, whole) ** (-0.5 / 2.0), run.wall, count))
    reach = np.full(count, np.inf)
    reach[np.unique(run.wall)] = layer_of(edges, errors, run)
    return Wish(to_nodes(core, volumes, run.tets, count), wall, variation(*errors.along[SHEAR]),
                smooth(edges, side, run.wall, count), reach)


def relative(squares, whole):
    """Over what each element would have if all had the same."""
    return np.maximum(squares, FEWEST * squares.mean()) / max(whole / len(squares), 1e-300)


def layer_of(edges, errors, run):
    """Thickness of the layer in which the velocity rises as a parabola, u (2 y/l - y^2/l^2): l = 2 u / (du/dn)."""
    on = np.unique(run.wall)
    square = np.full((2, edges.stride), 0.0)
    square[:, on] = errors.speed, errors.slope
    speed, slope = (averaged(edges, values, 3)[on] for values in square)
    return 2.0 * np.sqrt(speed / np.maximum(slope, 1e-300))


def smooth(edges, of_triangles, triangles, count):
    """At vertices, of values of triangles that differ by factors."""
    logs = np.log(of_triangles)
    total = np.bincount(triangles.reshape(-1), np.repeat(logs, 3), count)
    number = np.bincount(triangles.reshape(-1), minlength=count)
    found = np.full(count, np.inf)
    on = number > 0
    mean = np.where(on, total / np.maximum(number, 1), 0.0)
    found[:edges.stride] = np.exp(averaged(edges, mean[:edges.stride], 2))
    return np.where(on, found, np.inf)


def to_nodes(values, volumes, tets, count):
    """Means of the logarithms, weighted by volume; infinite where no tetrahedron about a vertex has a value."""
    has = np.isfinite(values)
    logs = np.where(has, np.log(np.where(has, values, 1.0)), 0.0)
    weight = np.where(has, volumes, 0.0)
    total, whole = (np.bincount(tets.reshape(-1), np.repeat(w, 4), count) for w in (weight * logs, weight))
    return np.where(whole > 0.0, np.exp(total / np.maximum(whole, 1e-300)), np.inf)
