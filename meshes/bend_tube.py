#!/usr/bin/python3
"""Bends a tube of tunica-mesh: bend_tube.py TUBE.h5 OUT.h5 [DEGREES]

Its axis, along z, becomes an arc of DEGREES, 120 if not given, towards x. Names and connectivity stay. Needs Debian's
python3-h5py. What a thin wall does that bends, without Gmsh:

  tunica-mesh tube flat.h5 --radius 2.55 --media 0.04 --adventitia 0.02 --length 52 --around 16 --axial 52 \\
      --media-layers 1 --adventitia-layers 1 --lumen off
  meshes/bend_tube.py flat.h5 bent.h5
"""
import math
import os
import shutil
import sys

import h5py
import numpy as np


def bend(x, degrees):
    """(x, y, z) -> about an axis along y, at the distance of length/angle."""
    length = x[:, 2].max() - x[:, 2].min()
    radius = length / math.radians(degrees)
    widest = x[:, 0].max()
    if widest >= radius:
        sys.exit(f"bend_tube.py: {degrees:g} degrees over {length:g} mm bend about an axis at {radius:.3g} mm, which is within "
                 f"the tube of {widest:.3g} mm; bend it less, or take a longer one.")
    angle = (x[:, 2] - x[:, 2].min()) / radius
    arm = radius - x[:, 0]
    return np.stack([radius - arm * np.cos(angle), x[:, 1], arm * np.sin(angle)], axis=1)


def main(source, target, degrees):
    if os.path.exists(target):
        sys.exit(f"bend_tube.py: {target} is there; remove it first.")
    with h5py.File(source, "r") as file:
        vertices = bend(file["vertices"][:], degrees)
    shutil.copyfile(source, target)
    with h5py.File(target, "r+") as file:
        file["vertices"][:] = vertices


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) == 4 else 120.0)
