#!/usr/bin/python3
"""Writes the lumen of an aortic arch or of a carotid bifurcation, as a segmentation gives it.

  meshes/make_vessel.py arch arch.msh                     the lumen in tetrahedra, Gmsh 2.2
  meshes/make_vessel.py carotid carotid.msh --size 0.8    in larger ones
  meshes/make_vessel.py carotid carotid.stl --raw on      the surface alone, open, with all steps of the voxels

Region fluid; surfaces lumen_wall, inlet, outlet_descending, outlet_brachiocephalic, outlet_carotid and
outlet_subclavian of the arch, inlet, outlet_internal and outlet_external of the carotid. tunica-mesh wall grows the
wall. The same options give the same mesh with the same versions of VTK and Gmsh. Needs Debian's python3-vtk9 and, but
for surfaces, python3-gmsh.
"""
import argparse
import math
import os
import sys
import tempfile

import numpy as np

import segmented


def gmsh_or_stop():
    try:
        import gmsh
    except ImportError:
        sys.exit("make_vessel.py: filling a lumen needs Gmsh's module for Python, on Debian in the package python3-gmsh: "
                 "apt install python3-gmsh; an .stl needs none.")
    return gmsh


def openings(gmsh, curves):
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


def name_of(gmsh, loop, shape):
    """Of the end whose plane goes through the loop: the nearest."""
    x = np.vstack([gmsh.model.mesh.getNodes(1, curve, includeBoundary=True)[1].reshape(-1, 3) for curve in loop])
    centre = x.mean(axis=0)
    return min(shape.ends, key=lambda end: np.linalg.norm(segmented.plane_of(shape, end)[0] - centre)).name


def cap(gmsh, shape, walls):
    """Plane surfaces on the openings: tag -> name."""
    count = {}
    for wall in walls:
        for _, curve in gmsh.model.getBoundary([(2, wall)], oriented=False):
            count[curve] = count.get(curve, 0) + 1
    caps = {}
    for loop in openings(gmsh, [curve for curve, n in count.items() if n == 1]):
        name = name_of(gmsh, loop, shape)
        caps[gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(loop, reorient=len(loop) > 1)])] = name
    if sorted(caps.values()) != sorted(end.name for end in shape.ends):
        sys.exit(f"make_vessel.py: found the openings {', '.join(sorted(caps.values()))}, expected one for each of "
                 f"{', '.join(end.name for end in shape.ends)}; --voxel {shape.voxel:g} mm may be too large.")
    return caps


def fill(gmsh, surface, path, shape, size):
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
    caps = cap(gmsh, shape, walls)
    volume = gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop(walls + list(caps))])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    for dimension, tags, name in [(3, [volume], "fluid"), (2, walls, "lumen_wall")] + [(2, [tag], caps[tag]) for tag in caps]:
        gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, tags), name)
    gmsh.write(path)
    print(f"{path}: {len(gmsh.model.mesh.getElementsByType(4)[0])} tetrahedra")
    gmsh.finalize()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shape", choices=sorted(segmented.SHAPES))
    parser.add_argument("out", help=".msh or .stl")
    parser.add_argument("--size", type=float, metavar="MM", help="of the elements; 1.7 for the arch, 0.62 for the carotid")
    parser.add_argument("--voxel", type=float, metavar="MM", help="edge of a voxel; 0.8 for the arch, 0.4 for the carotid")
    parser.add_argument("--raw", choices=("on", "off"), default="off", help="the surface is not smoothed")
    wanted = parser.parse_args()
    shape = segmented.SHAPES[wanted.shape]()
    shape.voxel = wanted.voxel or shape.voxel
    is_surface = wanted.out.endswith(".stl")
    gmsh = None if is_surface else gmsh_or_stop()
    points, triangles = segmented.open_surface(shape, shape.voxel, 0 if wanted.raw == "on" else 30)
    if is_surface:
        segmented.write_stl(wanted.out, points, triangles)
        print(f"{wanted.out}: {len(triangles)} triangles")
        return
    with tempfile.TemporaryDirectory() as folder:
        surface = os.path.join(folder, "surface.stl")
        segmented.write_stl(surface, points, triangles)
        fill(gmsh, surface, wanted.out, shape, wanted.size or shape.size)


if __name__ == "__main__":
    main()
