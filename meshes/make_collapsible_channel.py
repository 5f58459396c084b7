#!/usr/bin/python3
"""Writes the mesh of a channel with an elastic part in its upper wall: make_collapsible_channel.py OUT.msh [M]

A slice of one layer of elements, in mm: the channel is 25000 long and 1000 high, the wall lies on it from 5000 to 15000
and is 50 thick. M: 1, 1.5, 2 ... times as many cells along each axis. Cells of the wall are half as long as those of the
fluid, and cut into four by their diagonals: with two triangles each, bent elements would be stiffer eight times as much.
Regions fluid and wall; surfaces inlet, outlet, rigid (of the fluid, also beside the wall), interface, outer (of the
wall), clamp (its ends), fluid_sides and wall_sides (the planes of the slice).
"""
import sys

import numpy as np

import extruded

LENGTH, HEIGHT, THICKNESS = 25000.0, 1000.0, 50.0
ENDS = (5000.0, 15000.0)  # of the elastic wall


def alternating(index, i, j):
    """Two triangles of each cell of a grid of vertex numbers; diagonals of neighbours meet."""
    a, b, c, d = index[i, j], index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]
    is_even = ((i + j) % 2 == 0)[:, None]
    one = np.where(is_even, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    two = np.where(is_even, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return np.concatenate([one, two])


def plane(m):
    """Vertices and triangles."""
    columns, rows, layers = round(80 * m), 2 * round(6 * m), round(2 * m)
    upstream, downstream = round(20 * m), round(40 * m)
    x = extruded.graded([0.0, *ENDS, LENGTH], [upstream, columns, downstream], [0.33, 1.0, 3.0])
    y = extruded.graded([HEIGHT, 0.5 * HEIGHT, 0.0], [rows // 2, rows // 2], [4.0, 0.25])
    points = [np.stack(np.meshgrid(x, y, indexing="ij"), 2).reshape(-1, 2)]
    fluid = np.arange(len(points[0])).reshape(len(x), len(y))

    def add(x, y):
        begin = sum(map(len, points))
        points.append(np.stack(np.meshgrid(x, y, indexing="ij"), 2).reshape(-1, 2))
        return begin + np.arange(len(x) * len(y)).reshape(len(x), len(y))

    i, j = (index.ravel() for index in np.meshgrid(np.arange(len(x) - 1), np.arange(len(y) - 1), indexing="ij"))
    at_wall = (j == 0) & (i >= upstream) & (i < upstream + columns)
    triangles = [alternating(fluid, i[~at_wall], j[~at_wall])]
    on = fluid[upstream:upstream + columns + 1, 0]
    below = fluid[upstream:upstream + columns + 1, 1]
    long = np.linspace(*ENDS, 2 * columns + 1)  # ends of the wall's cells
    half = add(long[1::2], [HEIGHT])[:, 0]
    triangles += [np.stack(t, 1) for t in ((on[:-1], half, below[:-1]), (half, on[1:], below[1:]),
                                           (half, below[1:], below[:-1]))]
    wall = np.empty((len(long), layers + 1), dtype=int)
    wall[::2, 0], wall[1::2, 0] = on, half
    levels = HEIGHT + THICKNESS * np.arange(layers + 1) / layers
    wall[:, 1:] = add(long, levels[1:])
    centre = add(0.5 * (long[1:] + long[:-1]), 0.5 * (levels[1:] + levels[:-1])).ravel()
    corners = [part.ravel() for part in (wall[:-1, :-1], wall[1:, :-1], wall[1:, 1:], wall[:-1, 1:])]
    triangles += [np.stack([a, b, centre], 1) for a, b in zip(corners, corners[1:] + corners[:1])]
    return np.concatenate(points), np.concatenate(triangles)


def main(path, m):
    flat, triangles = plane(m)
    depth = 62.5 / m
    points = np.concatenate([np.column_stack([flat, np.full(len(flat), z)]) for z in (0.0, depth)])

    def region_of(c):
        return np.where(c[:, 1] > HEIGHT, "wall", "fluid")

    def surface_of(x, y, z, region):
        if z < 1e-9 or z > depth - 1e-9:
            return region + "_sides"
        if region == "wall":
            return "outer" if y > HEIGHT + THICKNESS - 1e-9 else "clamp"
        if x < 1e-9 or x > LENGTH - 1e-9:
            return "inlet" if x < 1e-9 else "outlet"
        return "rigid"

    extruded.write(path, points, extruded.tetrahedra(triangles, len(flat), 2), region_of, surface_of)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1)
