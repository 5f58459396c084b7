#!/usr/bin/python3
"""Writes the mesh of a quarter of a nozzle with a sudden expansion: make_nozzle.py OUT.msh [M]

The benchmark nozzle of the FDA, in mm: a tube of radius 6 narrows along 22.685 mm to a throat of radius 2 and length 40, which ends
at z = 0 in a tube of radius 6 again. A disc of triangles is drawn out along z with the radius; from z = 0 on, a ring around it, too.
M: 1, 2, 3 ... times as many cells along each axis, or half as many. They are thinner towards walls, where the
throat ends, and in the shear layer behind it.
Region fluid; surfaces inlet, outlet, walls, throat, which are the walls from z = -22 to -18, and the planes of symmetry symmetry_x and
symmetry_y.
"""
import math
import sys

import numpy as np

import extruded

INLET, CONE, CONTRACTED, OUTLET = -110.0, -62.685, -40.0, 160.0
WIDE, NARROW = 6.0, 2.0
STRIP = (-22.0, -18.0)  # the surface "throat"


def disc(sides, rings, beyond):
    """A quarter of the unit disc, of squares in the middle and rings around them, and rings as far as radius WIDE/NARROW beyond.
    Vertices, and the triangles of the disc and beyond it."""
    s, t = (axis.ravel() for axis in np.meshgrid(*2 * [np.linspace(0.0, 1.0, sides + 1)], indexing="ij"))
    # Between a square and a disc: a corner of 90 degrees would leave flat cells beside it in the rings.
    shrink = 0.26 * (1 + np.maximum(s, t) / np.maximum(np.hypot(s, t), 1e-30))
    vertices = [np.stack([s, t], 1) * shrink[:, None]]
    number = np.arange((sides + 1) ** 2).reshape(sides + 1, sides + 1)
    edge = np.concatenate([number[-1], number[-2::-1, -1]])
    turns = np.linspace(0.0, math.pi / 2, len(edge))
    rim = np.stack([np.cos(turns), np.sin(turns)], 1) * math.sqrt(turns[1] / math.sin(turns[1]))  # a polygon of the disc's area
    inner = vertices[0][edge]
    parts = extruded.graded([0.0, 1.0], [rings], [0.3])[1:]
    radii = extruded.graded([1.0, WIDE / NARROW], [beyond], [6.0])[1:]
    vertices += [inner + part * (rim - inner) for part in parts] + [radius * rim for radius in radii]
    rows = np.vstack([edge, len(number.ravel()) + np.arange((rings + beyond) * len(edge)).reshape(-1, len(edge))])
    within = extruded.grid_triangles(sides + 1, sides + 1)
    around = extruded.grid_triangles(len(rows), len(edge))
    is_beyond = around.max(1) >= (rings + 1) * len(edge)
    around = rows.ravel()[around]
    return np.concatenate(vertices), np.concatenate([within, around[~is_beyond]]), around[is_beyond]


def radius(z):
    """Of walls, or of the disc in the wider tube behind the throat."""
    return np.interp(z, [CONE, CONTRACTED], [WIDE, NARROW])


def levels(m):
    """z of the slices before the end of the throat, and after it."""
    cells = lambda n: max(round(n * m), 1)  # noqa: E731
    before = extruded.graded([INLET, CONE, CONTRACTED, STRIP[0], STRIP[1], 0.0],
                             [cells(7), cells(10), cells(7), cells(2), cells(10)], [0.4, 0.35, 3.0, 1.0, 0.15])
    after = extruded.graded([0.0, 60.0, OUTLET], [cells(26), cells(10)], [10.0, 3.5])
    return before, after


def main(path, m):
    vertices, within, beyond = disc(round(4 * m), round(4 * m), round(6 * m))
    before, after = levels(m)
    z = np.concatenate([before, after[1:]])
    points = np.vstack([np.column_stack([radius(at) * vertices, np.full(len(vertices), at)]) for at in z])
    end = (len(before) - 1) * len(vertices)
    tets = np.concatenate([extruded.tetrahedra(within, len(vertices), len(before)),
                           extruded.tetrahedra(np.concatenate([within, beyond]), len(vertices), len(after)) + end])
    used, tets = np.unique(tets, return_inverse=True)  # not those of the ring before the expansion
    points, tets = points[used], tets.reshape(-1, 4)

    def surface_of(x, y, at, _):
        if abs(at - INLET) < 1e-9 or abs(at - OUTLET) < 1e-9:
            return "inlet" if at < 0 else "outlet"
        if min(x, y) < 1e-9:
            return "symmetry_x" if x < y else "symmetry_y"
        return "throat" if STRIP[0] < at < STRIP[1] else "walls"

    extruded.write(path, points, tets, lambda centroids: np.full(len(centroids), "fluid"), surface_of)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1)
