#!/usr/bin/python3
"""Writes the plane mesh of the Turek-Hron benchmarks: make_turek_hron.py OUT.msh [M]

A channel of 2500 x 410 mm with a cylinder of radius 50 about (200, 200) and an elastic beam of 350 x 20 behind it,
as in S. Turek, J. Hron, Fluid-Structure Interaction, LNCSE 53 (2006) 371-385. Triangles for "tunica-mesh slab".
M: 1, 2, 3 ... times as many cells along each axis, or half as many; they are finer near cylinder and beam, 5/M mm, of
which the beam has 4 M through its thickness.
Regions fluid and beam; curves inlet, outlet, walls, cylinder, interface, and base, where the beam is fixed.
"""
import math
import sys

import gmsh

LENGTH, HEIGHT, RADIUS, HALF = 2500.0, 410.0, 50.0, 10.0
CENTRE, END = (200.0, 200.0), 600.0
FINE = 5.0  # of the first level, at cylinder and beam


def draw(size):
    """Points, curves and the two surfaces; returns the curves by name."""
    geo = gmsh.model.geo
    point = lambda x, y, h: geo.addPoint(x, y, 0.0, h)
    root = CENTRE[0] + math.sqrt(RADIUS ** 2 - HALF ** 2)
    centre = point(*CENTRE, size)
    low, high = point(root, CENTRE[1] - HALF, size), point(root, CENTRE[1] + HALF, size)
    tip = [point(END, CENTRE[1] + s * HALF, size) for s in (-1, 1)]
    ring = [high, point(CENTRE[0], CENTRE[1] + RADIUS, size), point(CENTRE[0] - RADIUS, CENTRE[1], size),
            point(CENTRE[0], CENTRE[1] - RADIUS, size), low]
    corner = [point(x, y, size) for x, y in ((0, 0), (LENGTH, 0), (LENGTH, HEIGHT), (0, HEIGHT))]
    sides = [geo.addLine(corner[k], corner[(k + 1) % 4]) for k in range(4)]
    cylinder = [geo.addCircleArc(a, centre, b) for a, b in zip(ring, ring[1:])]
    base = geo.addCircleArc(low, centre, high)
    beam = [geo.addLine(low, tip[0]), geo.addLine(*tip), geo.addLine(tip[1], high)]
    body = geo.addCurveLoop([*beam, *cylinder])
    fluid = geo.addPlaneSurface([geo.addCurveLoop(sides), body])
    inside = geo.addPlaneSurface([geo.addCurveLoop([*beam, -base])])
    return {"inlet": [sides[3]], "outlet": [sides[1]], "walls": [sides[0], sides[2]], "cylinder": cylinder,
            "interface": beam, "base": [base]}, {"fluid": fluid, "beam": inside}


def grade(near, size):
    """Elements of that size at the curves; larger ones with the distance, less so in the wake."""
    field = gmsh.model.mesh.field
    distance = field.add("Distance")
    field.setNumbers(distance, "CurvesList", near)
    field.setNumber(distance, "NumPointsPerCurve", 400)
    grown = field.add("MathEval")
    field.setString(grown, "F", f"{size} + 0.1 * Max(F{distance} - {2 * FINE}, 0)")
    limit = field.add("MathEval")  # 20 mm across the channel beside them, 40 far downstream
    field.setString(limit, "F", f"{size / FINE} * (20 + 20 * Max(Min((x - 900) / 800, 1), 0))")
    least = field.add("Min")
    field.setNumbers(least, "FieldsList", [grown, limit])
    field.setAsBackgroundMesh(least)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber("Mesh." + option, 0)


def main(path, m):
    gmsh.initialize(["", "-v", "2"])
    curves, surfaces = draw(FINE / m)
    geo = gmsh.model.geo
    bottom, tip, top = curves["interface"]
    for curve, cells in ((bottom, 70), (top, 70), (tip, 4), (curves["base"][0], 4)):
        geo.mesh.setTransfiniteCurve(curve, round(cells * m) + 1)
    geo.mesh.setTransfiniteSurface(surfaces["beam"], "AlternateLeft")
    geo.synchronize()
    for name, tags in curves.items():
        gmsh.model.setPhysicalName(1, gmsh.model.addPhysicalGroup(1, tags), name)
    for name, tag in surfaces.items():
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, [tag]), name)
    grade([*curves["cylinder"], *curves["interface"]], FINE / m)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.model.mesh.generate(2)
    gmsh.write(path)
    gmsh.finalize()


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1)
