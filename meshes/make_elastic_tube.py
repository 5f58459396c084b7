#!/usr/bin/python3
"""Writes the mesh of a quarter of an elastic tube: make_elastic_tube.py OUT.msh [M]

In mm: inner radius 1000, wall 100, length 15000 along z; planes of symmetry at x = 0 and y = 0. M: 1, 2, 3 ... times
as many cells in the section and along the axis.
Regions fluid and wall; surfaces inlet, outlet, interface, outer, wall_inlet, wall_outlet, and fluid_x, fluid_y,
wall_x, wall_y, the planes of symmetry with that normal.
"""
import sys

import numpy as np

import extruded

RADIUS, THICKNESS, LENGTH = 1000.0, 100.0, 15000.0


def section(m):
    """Vertices of a quarter of the section and its triangles: a core of 3m x 3m cells, rings around it, the wall."""
    n = 3 * m
    corners = np.array([[0.0, 0.0], [0.55, 0.0], [0.42, 0.42], [0.0, 0.55]]) * RADIUS
    s, t = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n, indexing="ij")
    weights = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t]
    core = sum(w[..., None] * c for w, c in zip(weights, corners)).reshape(-1, 2)
    number = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    rim = np.concatenate([number[n, :], number[-2::-1, n]])       # from the x axis to the y axis
    angle = np.linspace(0.0, 0.5 * np.pi, 2 * n + 1)
    circle = np.stack([np.cos(angle), np.sin(angle)], 1)
    rings = extruded.graded([0.0, 1.0], [5 * m], [0.4])[1:]
    points, numbers = [core], [rim]
    for part in rings:
        points.append((1 - part) * core[rim] + part * RADIUS * circle)
    for layer in range(1, 2 * m + 1):
        points.append((RADIUS + THICKNESS * layer / (2 * m)) * circle)
    first = len(core)
    for _ in points[1:]:
        numbers.append(np.arange(first, first + 2 * n + 1))
        first += 2 * n + 1
    around = np.stack(numbers)                                    # ring by angle
    flat = extruded.grid_triangles(len(numbers), 2 * n + 1)
    triangles = np.concatenate([extruded.grid_triangles(n + 1, n + 1), around.ravel()[flat]])
    plane = np.concatenate(points)
    plane[np.abs(plane) < 1e-9] = 0.0
    return plane, triangles


def main(path, m):
    plane, triangles = section(m)
    levels = np.linspace(0.0, LENGTH, 16 * m + 1)
    points = np.array([(a, b, c) for c in levels for a, b in plane])
    tets = extruded.tetrahedra(triangles, len(plane), len(levels))
    limit = RADIUS * np.cos(0.25 * np.pi / (6 * m))  # of centroids, which lie within the polygon

    def region_of(c):
        return np.where(np.hypot(c[:, 0], c[:, 1]) < limit, "fluid", "wall")

    def surface_of(x, y, z, region):
        if z < 1e-9 or z > LENGTH - 1e-9:
            end = "inlet" if z < 1e-9 else "outlet"
            return end if region == "fluid" else "wall_" + end
        if x < 1e-9 or y < 1e-9:
            return region + ("_x" if x < 1e-9 else "_y")
        return "outer"

    extruded.write(path, points, tets, region_of, surface_of)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1)
