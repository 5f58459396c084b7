#!/usr/bin/python3
"""Writes the mesh of half a channel around a cylinder, and what flows into it: make_cylinder.py OUT.msh INLET.csv [M]

The steady benchmark 3D-1Z of M. Schaefer, S. Turek, Notes Numer. Fluid Mech. 52 (1996) 547-566, in mm: a channel of 2500 x 410 x 410
with a cylinder of radius 50 along z about (500, 200); half of it, cut at the plane of symmetry z = 205. Lift is a thousandth of drag, so
what meshes do to it must cancel: the plane mesh is its own mirror image about y = 200, also in the diagonals of its cells, but
that above y = 300 it is stretched by a tenth.
M: 1, 2, 3 ... times as many cells along each axis, or half as many; they are finer near the cylinder.
Region fluid; surfaces inlet, outlet, walls, cylinder, symmetry. INLET.csv holds the velocity of the inlet at its vertices, mm/ms.
"""
import math
import sys

import numpy as np

import extruded

LENGTH, HEIGHT, RADIUS, HALF = 2500.0, 410.0, 50.0, 100.0  # the last one is of a square of rings about the cylinder
X, Y = 500.0, 200.0
SPEED = 0.45


def lower_half(m):
    """Vertices and triangles of y <= 200; where two parts meet, vertices are double."""
    cells = lambda n: max(round(n * m), 1)  # noqa: E731
    turns = np.linspace(-math.pi, 0.0, 4 * cells(6) + 1)
    rim = np.stack([np.cos(turns), np.sin(turns)], 1)
    square = HALF * rim / abs(rim).max(1)[:, None]
    parts = extruded.graded([0.0, 1.0], [cells(6)], [6.0])
    rings = np.vstack([RADIUS * rim + part * (square - RADIUS * rim) for part in parts]) + (X, Y)
    quarter = len(turns) // 4
    x = np.concatenate([extruded.graded([0.0, X - HALF], [cells(6)], [0.3])[:-1], X + square[quarter:-quarter, 0],
                        extruded.graded([X + HALF, LENGTH], [cells(18)], [10.0])[1:]])
    y = np.concatenate([extruded.graded([0.0, Y - HALF], [cells(4)], [1.0])[:-1], Y + square[quarter::-1, 1]])
    grid = np.array([(a, b) for a in x for b in y])
    outside = extruded.grid_triangles(len(x), len(y))
    centre = grid[outside].mean(1) - (X, Y)
    outside = outside[abs(centre).max(1) > HALF]
    return np.vstack([grid, rings]), np.vstack([outside, extruded.grid_triangles(len(parts), len(turns)) + len(grid)])


def plane(m):
    """The whole section. An image has the number after that of its vertex: prisms are cut by these numbers."""
    lower, triangles = lower_half(m)
    points = np.vstack([lower, np.column_stack([lower[:, 0], 2 * Y - lower[:, 1]])])
    keys = np.round(np.column_stack([abs(points[:, 1] - Y), points[:, 0], np.sign(np.round(points[:, 1] - Y, 6))]), 6)
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    points = points[first]
    above = points[:, 1] > Y + HALF
    points[above, 1] = Y + HALF + (points[above, 1] - Y - HALF) * (HEIGHT - Y - HALF) / (Y - HALF)
    return points, number.ravel()[np.vstack([triangles, triangles + len(lower)])]


def main(path, inlet_path, m):
    section, triangles = plane(m)
    z = extruded.graded([0.0, HEIGHT / 2], [max(round(5 * m), 2)], [3.0])
    points = np.vstack([np.column_stack([section, np.full(len(section), at)]) for at in z])
    tets = extruded.tetrahedra(triangles, len(section), len(z))

    def surface_of(a, b, c, _):
        if c > HEIGHT / 2 - 1e-9:
            return "symmetry"
        if math.hypot(a - X, b - Y) < 1.01 * RADIUS and c > 1e-9:
            return "cylinder"
        return "inlet" if a < 1e-9 else "outlet" if a > LENGTH - 1e-9 else "walls"

    extruded.write(path, points, tets, lambda centroids: np.full(len(centroids), "fluid"), surface_of)
    with open(inlet_path, "w", encoding="utf-8") as out:
        out.write("x,y,z,u,v,w\n")
        for b in np.sort(section[section[:, 0] < 1e-9, 1]):
            for c in z:
                u = 16 * SPEED * b * c * (HEIGHT - b) * (HEIGHT - c) / HEIGHT ** 4
                out.write(f"0,{b:.15g},{c:.15g},{u:.15g},0,0\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) > 3 else 1)
