#!/usr/bin/python3
"""Writes the lumen of a bent vessel: make_bend.py OUT.msh [SIZE [DEGREES]]

Wants Debian's python3-gmsh. Radius 1.5 mm; 3 mm straight along z, a bend towards x whose axis has a radius of
5 mm, 3 mm straight again. SIZE [mm] of the elements, 0.7 if not given; DEGREES of the bend, 90 to 180, 120 if
not given. Region fluid; surfaces inlet, outlet, lumen_wall. Gmsh 2.2. tunica-mesh wall grows the wall.
"""
import math
import sys

import gmsh

import lumens

RADIUS, BEND, STRAIGHT = 1.5, 5.0, 3.0  # mm


def sweep(angle):
    """Discs along the axis; the volumes share them."""
    occ = gmsh.model.occ
    inlet = occ.addDisk(0, 0, -STRAIGHT, RADIUS, RADIUS)
    first = occ.extrude([(2, inlet)], 0, 0, STRAIGHT)
    bend = occ.revolve([first[0]], BEND, 0, 0, 0, 1, 0, angle)
    last = occ.extrude([bend[0]], STRAIGHT * math.sin(angle), 0, STRAIGHT * math.cos(angle))
    occ.synchronize()
    return [tag for dim, tag in first + bend + last if dim == 3], inlet, last[0][1]


def main(path, size, degrees):
    lumens.begin()
    volumes, inlet, outlet = sweep(math.radians(degrees))
    lumens.write(path, size, volumes, lambda surface: {inlet: "inlet", outlet: "outlet"}.get(surface, "lumen_wall"))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    numbers = [float(word) for word in sys.argv[2:]]
    main(sys.argv[1], *(numbers + [0.7, 120.0][len(numbers):]))
