"""Writes the mesh, and beside it what other programs ask of a lumen."""
import json
import os

import numpy as np

from importer import tunica_file
from importer.raw import BadMesh, Raw, Tags

WALL, REGION = "lumen_wall", "fluid"
ORIGIN = "origin"  # group of the file: the surface that the mesh was drawn to


def remember(surface, path):
    """In the file of a mesh: a further one is drawn to the same surface."""
    import h5py
    with h5py.File(path, "r+") as file:
        group = file.require_group(ORIGIN)
        for name, values, kind in (("points", surface.points, "f4"), ("triangles", surface.triangles, "i4")):
            group.create_dataset(name, data=values.astype(kind), compression="gzip", track_times=False)


def write(mesh, rims, path, wall=WALL, region=REGION):
    """Triangles with normals outward; the wall first, then the openings."""
    triangles = np.concatenate([mesh.wall] + mesh.caps)
    of = np.repeat(np.arange(len(rims) + 1), [len(mesh.wall)] + [len(cap) for cap in mesh.caps])
    names = [wall] + [rim.name for rim in rims]
    raw = Raw(path, mesh.points, mesh.tets, Tags(np.zeros(len(mesh.tets), dtype=np.int64), [1], [region]), triangles,
              Tags(of, list(range(1, len(names) + 1)), names))
    if path.endswith(".msh"):
        write_gmsh(raw, path)
    else:
        tunica_file.write(raw, path)


def write_gmsh(raw, path):
    """Text of version 2.2, which all programs read."""
    temporary = path + ".part"
    try:
        with open(temporary, "w", encoding="utf-8") as file:
            gmsh_lines(raw, file)
        os.replace(temporary, path)
    except OSError as error:
        raise BadMesh(f"{path}: cannot be written: {error}") from error


def gmsh_lines(raw, file):
    surfaces = raw.surface.names
    file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n" % (len(surfaces) + 1))
    for number, name in enumerate(surfaces, 1):
        file.write('2 %d "%s"\n' % (number, name))
    file.write('3 %d "%s"\n$EndPhysicalNames\n$Nodes\n%d\n' % (len(surfaces) + 1, REGION, len(raw.points)))
    numbered = np.column_stack([np.arange(1, len(raw.points) + 1), raw.points])
    np.savetxt(file, numbered, fmt="%d %.16g %.16g %.16g")
    m, n = len(raw.triangles), len(raw.tets)
    file.write("$EndNodes\n$Elements\n%d\n" % (m + n))
    tag = raw.surface.of + 1
    np.savetxt(file, np.column_stack([np.arange(1, m + 1), np.full(m, 2), np.full(m, 2), tag, tag, raw.triangles + 1]),
               fmt="%d")
    tag = np.full(n, len(surfaces) + 1)
    np.savetxt(file, np.column_stack([np.arange(m + 1, m + n + 1), np.full(n, 4), np.full(n, 2), tag, tag, raw.tets + 1]),
               fmt="%d")
    file.write("$EndElements\n")


def rounded(values):
    return np.round(np.asarray(values, dtype=float), 6).tolist()


def write_json(table, rims, branches, warnings, path):
    """Openings and centrelines, mm."""
    content = {
        "openings": [{"name": rim.name, "centre": rounded(rim.centre), "normal": rounded(rim.normal),
                      "area": round(rim.area, 6), "radius": round(rim.radius, 6)} for rim in rims],
        "branches": [{"points": rounded(b.points), "radii": rounded(b.radii), "start": b.start, "end": b.end}
                     for b in branches],
        "volume": round(table["volume"], 6), "tetrahedra": table["tetrahedra"], "vertices": table["vertices"],
        "warnings": warnings}
    try:
        with open(path, "w", encoding="utf-8") as file:
            json.dump(content, file, ensure_ascii=False, indent=1)
            file.write("\n")
    except OSError as error:
        raise BadMesh(f"{path}: cannot be written: {error}") from error
