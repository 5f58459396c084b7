#!/usr/bin/python3
"""Makes a boundary layer of the lumen out of what tunica-mesh wall has grown: join_layer.py GROWN.h5 OUT.h5

All regions become fluid, outer becomes lumen_wall, wall_CAP a part of CAP; interface and what lies between layers are
dropped. Needs Debian's python3-h5py. Two flat layers of 0.04 mm in a lumen that becomes wider by them:

  tunica-mesh wall lumen.msh grown.h5 --layers inner=0.04:1,next=0.04:1
  meshes/join_layer.py grown.h5 layered.h5
  tunica-mesh wall layered.h5 vessel.h5 --layers media=0.3:1,adventitia=0.15:1
"""
import os
import sys

import h5py
import numpy as np

ARRAYS = ("vertices", "tets", "triangles")


def renamed(name, caps):
    """None where the surface lies within the lumen."""
    if name == "outer":
        return "lumen_wall"
    if name in caps:
        return name
    return name[len("wall_"):] if name.startswith("wall_") and name[len("wall_"):] in caps else None


def main(source, target):
    if os.path.exists(target):
        sys.exit(f"join_layer.py: {target} is there; remove it first.")
    with h5py.File(source, "r") as file:
        values = {name: file[name][:] for name in ARRAYS}
        names = [name.decode() for name in file["surface_names"][:]]
        surface = file["triangle_surface"][:]
    if "outer" not in names:
        sys.exit(f"join_layer.py: {source} has the surfaces {', '.join(names)}, and no outer; expected a mesh of tunica-mesh wall.")
    caps = [name for name in names if "wall_" + name in names]
    result = ["lumen_wall", *caps]
    number = np.array([result.index(new) if (new := renamed(name, caps)) else -1 for name in names], dtype="i4")
    is_kept = number[surface] >= 0
    values["triangles"] = values["triangles"][is_kept]
    with h5py.File(target, "w") as file:
        file.attrs["format"] = np.bytes_("tunica-mesh 1")
        for name, array in values.items():
            file[name] = array
        file["tet_region"] = np.zeros(len(values["tets"]), dtype="i4")
        file["triangle_surface"] = number[surface][is_kept]
        for kind, of_kind in (("region", ["fluid"]), ("surface", result)):
            file[kind + "_ids"] = np.arange(1, len(of_kind) + 1, dtype="i4")
            file[kind + "_names"] = np.array(of_kind, dtype="S32")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
