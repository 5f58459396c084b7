#!/usr/bin/python3
"""Writes the mesh of an elastic block in a channel, and what flows into it: make_obstacle.py OUT.msh INLET.csv [M]

T. Richter, Comput. Methods Appl. Mech. Engrg. 223-224 (2012) 28-42, section 7.2, in mm: a channel of 1500 x 400 x
800 with a block of 100 x 200 x 400 on its floor at x = 400; half of it, cut at the plane of symmetry z = 0.
M: 1, 2, 3 ... times as many cells along each axis; they are finer near the block.
Regions fluid and block; surfaces inlet, outlet, walls, symmetry, interface, base and block_symmetry. INLET.csv holds
the velocity of the inlet at its vertices, mm/ms.
"""
import sys

import numpy as np

import extruded


def main(path, inlet_path, m):
    x = extruded.graded([0.0, 400.0, 500.0, 1500.0], [8 * m, 4 * m, 12 * m],
                        [0.3 ** (1 - 0.5 / m), 1.0, 6.0])
    y = extruded.graded([0.0, 200.0, 400.0], [8 * m, 6 * m], [1.0, 2.0])
    z = extruded.graded([0.0, 200.0, 400.0], [8 * m, 6 * m], [1.0, 2.0])
    plane = np.array([(a, b) for a in x for b in y])
    points = np.array([(a, b, c) for c in z for a, b in plane])
    triangles = extruded.grid_triangles(len(x), len(y))
    tets = extruded.tetrahedra(triangles, len(plane), len(z))

    def region_of(c):
        is_block = (c[:, 0] > 400) & (c[:, 0] < 500) & (c[:, 1] < 200) & (c[:, 2] < 200)
        return np.where(is_block, "block", "fluid")

    def surface_of(a, b, d, region):
        if region == "block":
            return "base" if b < 1e-9 else "block_symmetry"
        if d < 1e-9:
            return "symmetry"
        return "inlet" if a < 1e-9 else "outlet" if a > 1500 - 1e-9 else "walls"

    extruded.write(path, points, tets, region_of, surface_of)
    with open(inlet_path, "w", encoding="utf-8") as out:
        out.write("x,y,z,u,v,w\n")
        for b in y:
            for c in z:
                u = 0.2 * b * (400 - b) * (400 ** 2 - c ** 2) / (200 ** 2 * 400 ** 2)
                out.write(f"0,{b:.15g},{c:.15g},{u:.15g},0,0\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 1)
