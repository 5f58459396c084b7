#!/usr/bin/python3
"""Fills the open surface of a vessel with tetrahedra: fill_vessel.py arch|carotid SURFACE.stl OUT.msh SIZE

Part of make_vessel.py, in a process of its own: Gmsh orders by addresses, and VTK's threads make these others each time.
Needs Debian's python3-gmsh. SIZE of the elements, mm.
"""
import math
import sys

import gmsh
import numpy as np

from vessel_shapes import SHAPES, plane_of


def openings(curves):
    """The loops of curves that bound a surface on one side only, as lists of tags."""
    ends = {}
    for curve in curves:
        points = [tag for _, tag in gmsh.model.getBoundary([(1, curve)], oriented=False)]
        ends[curve] = (points[0], points[-1]) if points else (None, None)
    loops = []
    while ends:
        curve = min(ends)
        first, last = ends.pop(curve)
        loop = [curve]
        while first != last:
            following = min(other for other, points in ends.items() if last in points)
            a, b = ends.pop(following)
            loop.append(following)
            last = b if a == last else a
        loops.append(loop)
    return loops


def name_of(loop, shape):
    """Of the end whose plane goes through the loop: the nearest."""
    x = np.vstack([gmsh.model.mesh.getNodes(1, curve, includeBoundary=True)[1].reshape(-1, 3) for curve in loop])
    centre = x.mean(axis=0)
    return min(shape.ends, key=lambda end: np.linalg.norm(plane_of(shape, end)[0] - centre)).name


def cap(shape, walls):
    """Plane surfaces on the openings: tag -> name."""
    count = {}
    for wall in walls:
        for _, curve in gmsh.model.getBoundary([(2, wall)], oriented=False):
            count[curve] = count.get(curve, 0) + 1
    caps = {}
    for loop in openings([curve for curve, n in count.items() if n == 1]):
        name = name_of(loop, shape)
        caps[gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(loop, reorient=len(loop) > 1)])] = name
    if sorted(caps.values()) != sorted(end.name for end in shape.ends):
        sys.exit(f"fill_vessel.py: found the openings {', '.join(sorted(caps.values()))}, expected one for each of "
                 f"{', '.join(end.name for end in shape.ends)}; the voxels may be too large.")
    return caps


def fill(surface, path, shape, size):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5 * size)
    gmsh.option.setNumber("Mesh.Algorithm3D", 10)  # HXT: fewer flat elements
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.merge(surface)
    gmsh.model.mesh.classifySurfaces(math.pi, True, True, math.pi)
    gmsh.model.mesh.createGeometry()
    walls = [tag for _, tag in gmsh.model.getEntities(2)]
    caps = cap(shape, walls)
    volume = gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop(walls + list(caps))])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    for dimension, tags, name in [(3, [volume], "fluid"), (2, walls, "lumen_wall")] + [(2, [tag], caps[tag]) for tag in caps]:
        gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, tags), name)
    gmsh.write(path)
    print(len(gmsh.model.mesh.getElementsByType(4)[0]), "tetrahedra")
    gmsh.finalize()


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    fill(sys.argv[2], sys.argv[3], SHAPES[sys.argv[1]](), float(sys.argv[4]))
