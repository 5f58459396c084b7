"""Made tests/data/mesh-column.exo; needs Debian's python3-netcdf4, which no test does.

Usage: make_exodus.py OUT
"""
import sys

import netCDF4
import numpy as np

from samples import Column, flat_faces


def write_exodus(path, column, faces):
    """Two element blocks and two side sets, each with a name."""
    ordered = np.argsort(column.region, kind="stable")
    tets, count = column.tets[ordered], (column.region == 1).sum()
    local = np.sort(np.array([[0, 1, 3], [1, 2, 3], [0, 2, 3], [0, 1, 2]]), axis=1)  # the sides as Exodus counts
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        file.setncatts({"api_version": np.float32(5.1), "version": np.float32(5.1), "file_size": np.int32(1),
                        "floating_point_word_size": np.int32(8), "title": "column"})
        for name, size in (("len_string", 33), ("len_name", 33), ("time_step", None), ("num_dim", 3),
                           ("num_nodes", len(column.points)), ("num_elem", len(tets)), ("num_el_blk", 2),
                           ("num_side_sets", 2)):
            file.createDimension(name, size)
        file.createVariable("time_whole", "f8", ("time_step",))
        for k, axis in enumerate("xyz"):
            file.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = column.points[:, k]
        put_names(file, "eb", "num_el_blk", ("fluid", "wall"))
        put_names(file, "ss", "num_side_sets", ("inlet", "outlet"))
        for k, block in enumerate((tets[:count], tets[count:]), 1):
            file.createDimension(f"num_el_in_blk{k}", len(block))
            file.createDimension(f"num_nod_per_el{k}", 4)
            connect = file.createVariable(f"connect{k}", "i4", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"))
            connect.elem_type = "TETRA4"
            connect[:] = block + 1
        for k, name in enumerate(("z_low", "z_high"), 1):
            wanted = {tuple(sorted(t)) for t in faces[name].tolist()}
            sides = [(e + 1, s + 1) for e, tet in enumerate(tets) for s, at in enumerate(local)
                     if tuple(sorted(tet[at])) in wanted]
            file.createDimension(f"num_side_ss{k}", len(sides))
            for variable, column_of in ((f"elem_ss{k}", 0), (f"side_ss{k}", 1)):
                file.createVariable(variable, "i4", (f"num_side_ss{k}",))[:] = [s[column_of] for s in sides]


def put_names(file, kind, dimension, names):
    text = file.createVariable(kind + "_names", "S1", (dimension, "len_name"))
    for k, name in enumerate(names):
        text[k] = np.array(list(name.ljust(33, "\0")), dtype="S1")
    number = file.createVariable({"eb": "eb_prop1", "ss": "ss_prop1"}[kind], "i4", (dimension,))
    number.setncattr("name", "ID")
    number[:] = [1, 2]
    file.createVariable({"eb": "eb_status", "ss": "ss_status"}[kind], "i4", (dimension,))[:] = [1, 1]


if __name__ == "__main__":
    small = Column(1)
    write_exodus(sys.argv[1], small, flat_faces(small.points, small.tets))
