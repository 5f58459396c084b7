#!/usr/bin/python3
"""Writes the mesh of a vessel that divides into two: make_bifurcation.py OUT.msh [SIZE]

Wants Debian's python3-gmsh. A trunk of radius 1.5 mm along z and two branches of radius 1.1 mm, 35 degrees to
either side of it in the plane y = 0, with a wall of media (0.3 mm) and adventitia (0.15 mm). SIZE [mm] of the
elements, 0.6 if not given. Regions fluid, media, adventitia; surfaces inlet, outlet_left, outlet_right,
interface, struct_in, struct_left, struct_right, outer, layer. Gmsh 2.2.
"""
import math
import sys

import gmsh

TRUNK, BRANCH, ANGLE = 1.5, 1.1, math.radians(35.0)  # mm, mm
THICKNESS = [0.0, 0.3, 0.45]                         # of the wall up to each surface around it, mm
REGIONS = ["fluid", "media", "adventitia"]
FORK, TRUNK_END, BRANCH_LENGTH = 7.0, 8.0, 7.0       # mm along z, z and the branches


def tree(thickness):
    """The volume within a surface around the lumen."""
    occ = gmsh.model.occ
    trunk = occ.addCylinder(0, 0, 0, 0, 0, TRUNK_END, TRUNK + thickness)
    others = [occ.addSphere(0, 0, FORK + 0.2, 0.98 * (TRUNK + thickness))]
    for side in (-1, 1):
        x, z = side * math.sin(ANGLE), math.cos(ANGLE)
        others.append(occ.addCylinder(0, 0, FORK, BRANCH_LENGTH * x, 0, BRANCH_LENGTH * z, BRANCH + thickness))
    return occ.fuse([(3, trunk)], [(3, other) for other in others])[0]


def sides_of(volumes):
    return {tag for _, tag in gmsh.model.getBoundary([(3, v) for v in volumes], oriented=False, combined=True)}


def name_of(surface, owners):
    """A surface by the regions that it bounds, and where it lies."""
    if len(owners) == 2:
        return "interface" if 0 in owners else "layer"
    x, _, z = gmsh.model.occ.getCenterOfMass(2, surface)
    is_cap = gmsh.model.getType(2, surface) == "Plane"
    if not is_cap:
        return "outer"
    of_fluid = 0 in owners
    if abs(z) < 1e-6:
        return "inlet" if of_fluid else "struct_in"
    return ("outlet_" if of_fluid else "struct_") + ("left" if x < 0 else "right")


def main(path, size):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    trees = [tree(thickness) for thickness in THICKNESS]
    _, pieces = gmsh.model.occ.fragment(trees[-1], trees[0] + trees[1])
    gmsh.model.occ.synchronize()
    outermost, *within = [{tag for _, tag in piece} for piece in pieces]
    volumes = [within[0], within[1] - within[0], outermost - within[1]]
    owners = {}
    for region, tags in enumerate(volumes):
        group = gmsh.model.addPhysicalGroup(3, sorted(tags))
        gmsh.model.setPhysicalName(3, group, REGIONS[region])
        for surface in sides_of(tags):
            owners.setdefault(surface, set()).add(region)
    surfaces = {}
    for surface, regions in owners.items():
        surfaces.setdefault(name_of(surface, regions), []).append(surface)
    for name in sorted(surfaces):
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, surfaces[name]), name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5 * size)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.model.mesh.generate(3)
    gmsh.write(path)
    gmsh.finalize()


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) == 3 else 0.6)
