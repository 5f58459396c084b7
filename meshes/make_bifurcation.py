#!/usr/bin/python3
"""Writes the lumen of a vessel that divides into two: make_bifurcation.py OUT.msh [SIZE]

Wants Debian's python3-gmsh. A trunk of radius 1.5 mm along z and two branches of radius 1.1 mm, 35 degrees to
either side of it in the plane y = 0. SIZE [mm] of the elements, 0.6 if not given. Region fluid; surfaces inlet,
outlet_left, outlet_right, interface. Gmsh 2.2. tunica-mesh wall grows the wall.
"""
import math
import sys

import gmsh

import lumens

TRUNK, BRANCH, ANGLE = 1.5, 1.1, math.radians(35.0)  # mm, mm
FORK, TRUNK_END, BRANCH_LENGTH = 7.0, 8.0, 7.0       # mm along z, z and the branches


def lumen():
    """The trunk, the branches, and a ball where they meet."""
    occ = gmsh.model.occ
    trunk = occ.addCylinder(0, 0, 0, 0, 0, TRUNK_END, TRUNK)
    others = [occ.addSphere(0, 0, FORK + 0.2, 0.98 * TRUNK)]
    for side in (-1, 1):
        x, z = side * math.sin(ANGLE), math.cos(ANGLE)
        others.append(occ.addCylinder(0, 0, FORK, BRANCH_LENGTH * x, 0, BRANCH_LENGTH * z, BRANCH))
    return occ.fuse([(3, trunk)], [(3, other) for other in others])[0]


def name_of(surface):
    x, _, z = gmsh.model.occ.getCenterOfMass(2, surface)
    if abs(z) < 1e-6:
        return "inlet"
    if abs(abs(x) - BRANCH_LENGTH * math.sin(ANGLE)) < 1e-6:
        return "outlet_left" if x < 0 else "outlet_right"
    return "interface"  # the trunk's end, too, looks out between the branches


def main(path, size):
    lumens.begin()
    lumens.write(path, size, [tag for _, tag in lumen()], name_of)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) == 3 else 0.6)
