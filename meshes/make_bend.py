#!/usr/bin/python3
"""Writes the lumen of a bent vessel: make_bend.py OUT.msh [SIZE [DEGREES]]

Wants Debian's python3-gmsh. Radius 1.5 mm; 3 mm straight along z, a bend towards x whose axis has a radius of
5 mm, 3 mm straight again. SIZE [mm] of the elements, 0.7 if not given; DEGREES of the bend, 90 to 180, 120 if
not given. Region fluid; surfaces inlet, outlet, lumen_wall. Gmsh 2.2. tunica-mesh wall grows the wall.
"""
import math
import sys

import gmsh

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
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    volumes, inlet, outlet = sweep(math.radians(degrees))
    gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, volumes), "fluid")
    sides = gmsh.model.getBoundary([(3, v) for v in volumes], oriented=False)
    wall = sorted({tag for _, tag in sides} - {inlet, outlet})
    for name, tags in (("inlet", [inlet]), ("outlet", [outlet]), ("lumen_wall", wall)):
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, tags), name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5 * size)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.model.mesh.generate(3)
    gmsh.write(path)
    gmsh.finalize()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    numbers = [float(word) for word in sys.argv[2:]]
    main(sys.argv[1], *(numbers + [0.7, 120.0][len(numbers):]))
