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
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile

import segmented
from vessel_shapes import SHAPES

HERE = os.path.dirname(os.path.abspath(__file__))
KEPT = ("PYTHONPATH", "LD_LIBRARY_PATH")  # where Gmsh may be


def check_gmsh():
    if importlib.util.find_spec("gmsh") is None:
        sys.exit("make_vessel.py: filling a lumen needs Gmsh's module for Python, on Debian in the package python3-gmsh: "
                 "apt install python3-gmsh; an .stl needs none.")


def fill(surface, shape, size, out):
    """By Gmsh, which orders by addresses: in a process of its own, whose names and environment are always the same."""
    folder, name = os.path.split(surface)
    for script in ("fill_vessel.py", "vessel_shapes.py"):
        shutil.copy(os.path.join(HERE, script), folder)
    words = [sys.executable, "-B", "fill_vessel.py", shape, name, "lumen.msh", f"{size:.6f}"]
    environment = {"PYTHONHASHSEED": "0", "OMP_NUM_THREADS": "1", **{key: os.environ[key] for key in KEPT if key in os.environ}}
    done = subprocess.run(words, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"make_vessel.py: Gmsh has not filled the lumen (exit status {done.returncode}); see above.")
    shutil.move(os.path.join(folder, "lumen.msh"), out)
    print(f"{out}: {done.stdout.strip()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shape", choices=sorted(SHAPES))
    parser.add_argument("out", help=".msh or .stl")
    parser.add_argument("--size", type=float, metavar="MM", help="of the elements; 1.7 for the arch, 0.62 for the carotid")
    parser.add_argument("--voxel", type=float, metavar="MM", help="edge of a voxel; 0.8 for the arch, 0.4 for the carotid")
    parser.add_argument("--raw", choices=("on", "off"), default="off", help="the surface is not smoothed")
    wanted = parser.parse_args()
    shape = SHAPES[wanted.shape]()
    shape.voxel = wanted.voxel or shape.voxel
    is_surface = wanted.out.endswith(".stl")
    if not is_surface:
        check_gmsh()
    points, triangles = segmented.open_surface(shape, shape.voxel, 0 if wanted.raw == "on" else segmented.PASSES)
    with tempfile.TemporaryDirectory() as folder:
        surface = wanted.out if is_surface else os.path.join(folder, "surface.stl")
        segmented.write_stl(surface, points, triangles)
        if is_surface:
            print(f"{surface}: {len(triangles)} triangles")
        else:
            fill(surface, wanted.shape, wanted.size or shape.size, wanted.out)


if __name__ == "__main__":
    main()
