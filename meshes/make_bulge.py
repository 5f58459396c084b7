#!/usr/bin/python3
"""Writes the lumen of a vessel with a bulge at its side, like an aneurysm: make_bulge.py OUT.msh [SIZE]

Wants Debian's python3-gmsh. A tube of radius 1.5 mm along z, 12 mm long, and a ball of radius 2 mm whose centre
is 2.2 mm beside the axis; where they meet the edge is rounded by 0.5 mm. SIZE [mm] of the elements, 0.65 if not
given. Region fluid; surfaces inlet, outlet, lumen_wall. Gmsh 2.2. tunica-mesh wall grows the wall.
"""
import sys

import gmsh

import lumens

RADIUS, LENGTH = 1.5, 12.0           # mm, of the tube
BALL, ASIDE, ROUNDING = 2.0, 2.2, 0.5  # mm


def lumen():
    occ = gmsh.model.occ
    tube = occ.addCylinder(0, 0, 0, 0, 0, LENGTH, RADIUS)
    ball = occ.addSphere(ASIDE, 0, 0.5 * LENGTH, BALL)
    volume = occ.fuse([(3, tube)], [(3, ball)])[0][0][1]
    occ.synchronize()
    return occ.fillet([volume], neck(volume), [ROUNDING])


def neck(volume):
    """The edges between tube and ball: curved, and away from the ends."""
    surfaces = gmsh.model.getBoundary([(3, volume)], oriented=False)
    edges = {tag for _, tag in gmsh.model.getBoundary(surfaces, combined=False, oriented=False)}
    sides = {}
    for _, surface in surfaces:
        for _, edge in gmsh.model.getBoundary([(2, surface)], oriented=False):
            sides.setdefault(edge, set()).add(gmsh.model.getType(2, surface))
    return sorted(edge for edge in edges if sides.get(edge) == {"Cylinder", "Sphere"})


def name_of(surface):
    z = gmsh.model.occ.getCenterOfMass(2, surface)[2]
    if gmsh.model.getType(2, surface) != "Plane":
        return "lumen_wall"
    return "inlet" if z < 0.5 * LENGTH else "outlet"


def main(path, size):
    lumens.begin()
    lumens.write(path, size, [tag for _, tag in lumen()], name_of)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) == 3 else 0.65)
