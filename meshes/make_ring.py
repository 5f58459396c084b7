#!/usr/bin/python3
"""Writes the mesh of an elastic ring in a fluid with a rigid wall around it: make_ring.py OUT.msh [M]

A quarter of a slice of one layer of elements, in mm: ring 950 to 1050, fluid to 1500; planes of symmetry at x = 0 and
y = 0. M: 1, 2, 3 ... times as many cells around, and through the ring. Layers of the fluid are thin at both walls, where
it sticks but is to slip.
Regions ring and fluid; surfaces interface, rim (of the fluid), inner_x and inner_y (the ring's inside, the half
near that axis), ring_x, ring_y, fluid_x, fluid_y (the planes of symmetry with that normal), ring_ends and fluid_ends.
"""
import sys

import numpy as np

import extruded


def main(path, m):
    around, layers = 36 * m, 3 * m
    fluid = extruded.graded([1050.0, 1275.0, 1500.0], [8, 8], [100.0, 0.01])
    r = np.concatenate([np.linspace(950.0, 1050.0, layers + 1), fluid[1:]])
    angle = np.linspace(0.0, 0.5 * np.pi, around + 1)
    plane = np.array([(a * np.cos(t), a * np.sin(t)) for t in angle for a in r])
    plane[np.abs(plane) < 1e-9] = 0.0
    thickness = 100.0 / layers
    points = np.array([(a, b, c) for c in (0.0, thickness) for a, b in plane])
    tets = extruded.tetrahedra(extruded.grid_triangles(around + 1, len(r)), len(plane), 2)
    limit = 1050.0 * np.cos(0.25 * np.pi / around)  # of centroids, which lie within the polygon

    def region_of(c):
        return np.where(np.hypot(c[:, 0], c[:, 1]) < limit, "ring", "fluid")

    def surface_of(x, y, z, region):
        if z < 1e-9 or z > thickness - 1e-9:
            return region + "_ends"
        if x < 1e-9 or y < 1e-9:
            return region + ("_x" if x < 1e-9 else "_y")
        if region == "fluid":
            return "rim"
        return "inner_x" if x > y else "inner_y"

    extruded.write(path, points, tets, region_of, surface_of)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1)
