#!/usr/bin/python3
"""Writes meshes of sections in plane strain, one slice of elements: make_bending.py tube OUT.msh N [A B], or cook OUT.msh N

tube: a quarter of an oval tube with inner semi-axes A and B along x and y (1.8 and 1.1 mm), 0.39 mm thick along its normal
everywhere, N elements over the thickness and 6 N around. Region wall; surfaces inner, outer, sym_x, sym_y (the planes of
symmetry with that normal), ends.
cook: Cook's membrane, the quadrilateral (0, 0), (48, 44), (48, 60), (0, 44) mm, N elements along each side. Region wall;
surfaces clamped (x = 0), loaded (x = 48), free, ends.
"""
import sys

import numpy as np

import extruded

THICKNESS = 0.39


def write(path, plane, shape, slice_thickness, surface_at):
    """shape: columns and rows of the grid; surface_at(x, y) of faces that do not lie in the ends."""
    points = np.array([(x, y, z) for z in (0.0, slice_thickness) for x, y in plane])
    tets = extruded.tetrahedra(extruded.grid_triangles(*shape), len(plane), 2)

    def surface_of(x, y, z, _):
        return "ends" if min(z, slice_thickness - z) < 1e-9 * slice_thickness else surface_at(x, y)

    extruded.write(path, points, tets, lambda c: np.full(len(c), "wall"), surface_of)


def tube(path, n, a=1.8, b=1.1):
    angle = np.linspace(0.0, 0.5 * np.pi, 6 * n + 1)
    inner = np.stack([a * np.cos(angle), b * np.sin(angle)], 1)
    normal = np.stack([b * np.cos(angle), a * np.sin(angle)], 1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    depth = np.linspace(0.0, THICKNESS, n + 1)
    plane = (inner[:, None] + depth[:, None] * normal[:, None]).reshape(-1, 2)
    plane[abs(plane) < 1e-12] = 0.0

    def surface_at(x, y):
        if min(x, y) < 1e-9:
            return "sym_x" if x < 1e-9 else "sym_y"
        return "inner" if np.hypot(inner[:, 0] - x, inner[:, 1] - y).min() < 0.6 * THICKNESS else "outer"

    write(path, plane, (6 * n + 1, n + 1), THICKNESS / n, surface_at)


def cook(path, n):
    along, up = np.meshgrid(np.linspace(0.0, 1.0, n + 1), np.linspace(0.0, 1.0, n + 1), indexing="ij")
    plane = np.stack([48.0 * along, 44.0 * along + up * (44.0 - 28.0 * along)], 2).reshape(-1, 2)

    def surface_at(x, _):
        return "clamped" if x < 1e-9 else "loaded" if x > 48.0 - 1e-9 else "free"

    write(path, plane, (n + 1, n + 1), 48.0 / n, surface_at)


if __name__ == "__main__":
    {"tube": tube, "cook": cook}[sys.argv[1]](sys.argv[2], int(sys.argv[3]), *map(float, sys.argv[4:]))
