#!/usr/bin/python3
"""Writes the mesh of half of a chamber with a silicone flap: make_silicone_flap.py OUT.msh [M]

Phase I of A. Hessenthaler et al., Int. J. Numer. Methods Biomed. Eng. 33 (2017) e2848, in mm: a flap of 11 x 2 x 65, fixed at z = 0,
between two inlets of diameter 21.9 about y = 27.15 and -27.15 at z = -29.5 and one outlet of diameter 76.2, at z = 339.5. The
surface of the real chamber has been published as data; here each inlet widens as an oblique cone to a disc of radius 17.5 about
y = 19.5 or -19.5 in the plane z = 0, where the wide pipe begins. Half of it, cut at the plane of symmetry x = 0.
M: 1, 2, 3 ... times as many cells along each axis, or half as many; the flap has 4 M through its thickness.
Regions fluid and flap; surfaces upper and lower, the inlets at y > 0 and y < 0, outlet, walls, interface, base, where the flap is
fixed, symmetry of the fluid, and flap_symmetry.
"""
import sys

import gmsh

LENGTH, THICKNESS, HALF_WIDTH = 65.0, 2.0, 5.5
INLET, INLET_RADIUS, INLET_Y = -29.5, 10.95, 27.15
OPENING_RADIUS, OPENING_Y = 17.5, 19.5  # where an inlet meets the wide pipe
OUTLET, OUTLET_RADIUS = 339.5, 38.1
CELLS = (10, 4, 100)                    # of the flap along x, y and z
NEAR, WIDE, FAR = 1.0, 4.0, 9.0         # sizes of elements at the flap, in the chamber, and downstream


def draw():
    """Half of the chamber without the flap, and half of the flap; returns the flap's and the fluid's volume."""
    occ = gmsh.model.occ
    chamber = [(3, occ.addCylinder(0, 0, 0, 0, 0, OUTLET, OUTLET_RADIUS))]
    for side in (1, -1):
        rims = [occ.addCurveLoop([occ.addCircle(0, side * y, z, r)])
                for y, z, r in ((INLET_Y, INLET, INLET_RADIUS), (OPENING_Y, 0.0, OPENING_RADIUS))]
        chamber += occ.addThruSections(rims, makeSolid=True, makeRuled=True)
    whole, _ = occ.fuse(chamber[:1], chamber[1:])
    size = 2 * OUTLET
    half, _ = occ.intersect(whole, [(3, occ.addBox(0, -size / 2, -size / 2, size, size, 2 * size))])
    flap = occ.addBox(0, -THICKNESS / 2, 0, HALF_WIDTH, THICKNESS, LENGTH)
    parts, _ = occ.fragment(half, [(3, flap)])
    occ.synchronize()
    volumes = sorted((tag for dim, tag in parts if dim == 3), key=lambda tag: occ.getMass(3, tag))
    assert len(volumes) == 2, "the chamber falls apart"
    return volumes


def name_surfaces(flap, fluid):
    """Physical groups by place."""
    def faces(volume):
        return {abs(tag) for _, tag in gmsh.model.getBoundary([(3, volume)], oriented=False)}
    of_flap, of_fluid = faces(flap), faces(fluid)
    groups = {"interface": of_flap & of_fluid}
    for tag in of_flap ^ of_fluid:
        x0, y0, z0, x1, y1, z1 = gmsh.model.getBoundingBox(2, tag)
        if x1 - x0 < 1e-3 and abs(x0) < 1e-3:
            name = "symmetry" if tag in of_fluid else "flap_symmetry"
        elif z1 - z0 > 1e-3:
            name = "walls"
        elif tag in of_flap:
            name = "base"
        elif abs(z0 - INLET) < 1e-3:
            name = "upper" if y0 + y1 > 0 else "lower"
        else:
            name = "outlet" if abs(z0 - OUTLET) < 1e-3 else "walls"
        groups.setdefault(name, set()).add(tag)
    for name, tags in sorted(groups.items()):
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, sorted(tags)), name)
    for name, tag in (("fluid", fluid), ("flap", flap)):
        gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, [tag]), name)


def divide_flap(flap, m):
    """Its edges, faces and cells along the axes."""
    for _, curve in gmsh.model.getBoundary(gmsh.model.getBoundary([(3, flap)], oriented=False), combined=False, oriented=False):
        x0, y0, z0, x1, y1, z1 = gmsh.model.getBoundingBox(1, curve)
        axis = max(range(3), key=lambda i: (x1 - x0, y1 - y0, z1 - z0)[i])
        gmsh.model.mesh.setTransfiniteCurve(curve, round(CELLS[axis] * m) + 1)
    for _, face in gmsh.model.getBoundary([(3, flap)], oriented=False):
        gmsh.model.mesh.setTransfiniteSurface(face)
    gmsh.model.mesh.setTransfiniteVolume(flap)


def grade(m):
    """Small elements at the flap, larger ones with the distance; in the inlets 10 M across."""
    field = gmsh.model.mesh.field
    beyond = (f"Max(x - {HALF_WIDTH}, 0)", f"Max(Fabs(y) - {THICKNESS / 2}, 0)", f"Max(z - {LENGTH}, 0)")
    near = f"{NEAR} + 0.12 * Sqrt({' + '.join(f'{d}^2' for d in beyond)})"
    upstream = f"{2 * INLET_RADIUS / 10} + 0.06 * Max(z + 10, 0)"
    downstream = f"{WIDE} + {FAR - WIDE} * Min(Max((z - 90) / 100, 0), 1)"
    size = field.add("MathEval")
    field.setString(size, "F", f"Min({near}, Min({upstream}, {downstream})) / {m}")
    field.setAsBackgroundMesh(size)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber("Mesh." + option, 0)


def main(path, m):
    gmsh.initialize(["", "-v", "2"])
    flap, fluid = draw()
    name_surfaces(flap, fluid)
    divide_flap(flap, m)
    grade(m)
    gmsh.option.setNumber("Mesh.Optimize", 1)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.optimize("")
    gmsh.write(path)
    gmsh.finalize()


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1)
