"""Lumens for the tests of tunica-vessel, from the meshes that are shipped."""
import h5py
import numpy as np


def lumen_of(source, target):
    """The region fluid of a mesh with a wall, on its own."""
    with h5py.File(source) as file:
        regions, surfaces = ([name.decode() for name in file[key][:]] for key in ("region_names", "surface_names"))
        tets = file["tets"][:][file["tet_region"][:] == regions.index("fluid")]
        kept = [name for name in surfaces if name in ("inlet", "interface") or name.startswith("outlet")]
        triangles = file["triangles"][:]
        of = file["triangle_surface"][:]
        vertices = file["vertices"][:]
    used = np.unique(tets)
    number = np.full(len(vertices), -1)
    number[used] = np.arange(len(used))
    chosen = np.isin(of, [surfaces.index(name) for name in kept])
    with h5py.File(target, "w") as out:
        out.attrs["format"] = np.bytes_("tunica-mesh 1")
        out["vertices"], out["tets"] = vertices[used], number[tets].astype("i4")
        out["tet_region"] = np.zeros(len(tets), dtype="i4")
        out["triangles"] = number[triangles[chosen]].astype("i4")
        out["triangle_surface"] = np.array([kept.index(surfaces[k]) for k in of[chosen]], dtype="i4")
        for kind, names in (("region", ["fluid"]), ("surface", ["lumen_wall" if name == "interface" else name for name in kept])):
            out[kind + "_ids"] = np.arange(1, len(names) + 1, dtype="i4")
            out[kind + "_names"] = np.array(names, dtype="S32")
