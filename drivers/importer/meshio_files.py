"""Meshes by meshio: Gmsh in all its forms, Medit, Abaqus, Nastran, MED and what else it reads."""
import contextlib
import io
import re

import numpy as np

from . import abaqus, arrays
from .raw import BadMesh, Raw, Tags, check_shapes

GMSH_START = b"$MeshFormat"
EXPECTED = ("its ending is that of no format that is read, expected .vtu, .vtk, .exo, .msh, .mesh, .inp, .h5, another "
            "one that meshio knows, or a folder of SimVascular")


def families_of(groups):
    """Names of the groups of each family of a MED file, in UTF-8 as Salome writes them; meshio takes ASCII."""
    def text_of(letters):
        text = bytes(int(letter) & 0xFF for letter in letters).rstrip(b"\0 ")
        try:
            return text.decode("utf-8").strip()
        except UnicodeDecodeError:
            return text.decode("latin-1").strip()
    return {family.attrs["NUM"]: [text_of(name) for name in family["GRO"]["NOM"][()]] if "GRO" in family else []
            for family in groups.values()}


def mend(meshio):
    """What its readers take wrongly. What another version has otherwise stays as it is."""
    kinds = getattr(getattr(meshio.abaqus, "_abaqus", None), "abaqus_to_meshio_type", {})
    if kinds.get("C3D4H") == "tetra4":  # the hybrid element of incompressible walls, a kind that meshio has not
        kinds["C3D4H"] = "tetra"
    med = getattr(meshio.med, "_med", None)
    if hasattr(med, "_read_families"):
        med._read_families = families_of


def in_words(error, said):
    """What meshio says; where it stumbles, what that may mean."""
    if isinstance(error, SystemExit):
        return " ".join(said.split()) or "SystemExit"
    reason = " ".join(str(error).split())
    if type(error).__module__.startswith("meshio") and reason:
        return reason
    return (f"it stumbles ({type(error).__name__}{': ' if reason else ''}{reason}). The file is damaged, or has parts "
            "that meshio does not know: leave them out, or save it as Gmsh or VTU")


def read_raw(path, file_format):
    """meshio's mesh. It prints what is wrong and leaves the program: both are caught."""
    try:
        import meshio
    except ImportError as error:
        raise BadMesh(f"{path}: this format needs meshio, in Debian the package python3-meshio ({error})") from error
    mend(meshio)
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(path, file_format)
    except (Exception, SystemExit) as error:  # whatever its readers stumble over in a damaged file
        reason = in_words(error, said.getvalue())
        if "gmsh:physical" in reason:
            reason = ("some elements have a physical group and others have none. Give all volumes and surfaces "
                      "one, or save without \"Save all elements\"")
        if "deduce" in reason:
            raise BadMesh(f"{path}: {EXPECTED}") from error
        raise BadMesh(f"{path}: meshio cannot read it{f' as {file_format}' if file_format else ''}: "
                      f"{reason}") from error


def check_end(path):
    """meshio would look for the end of a Nastran file for ever."""
    if not path.lower().endswith((".bdf", ".fem", ".nas")):
        return
    with open(path, "rb") as file:
        if not any(line.lstrip().upper().startswith(b"ENDDATA") for line in file):
            raise BadMesh(f"{path}: ends before ENDDATA, expected a whole Nastran file")


def is_gmsh(path):
    with open(path, "rb") as file:
        return file.read(256).lstrip().startswith((GMSH_START, b"$Comments"))


# How meshes of others begin that have an ending in common with one that is read: their points bound faces, or stand
# in another order.
FOREIGN = ((rb"\(\s*\d+[\s(\"]", "a mesh of Fluent (ANSYS)",
            "Export it from there for Abaqus or Nastran, or open it in ParaView and save it as VTU"),
           (rb"FoamFile|/\*-+\*- C\+\+", "of OpenFOAM", "Run foamToVTK, and import the .vtu of the volume"),
           (rb"MFEM mesh", "a mesh of MFEM", "Save it as VTU, by MFEM's ParaViewDataCollection"),
           (rb"\d+[ \t]+\d+[ \t]+\d+[ \t]*\r?\n[-+.\d]", "a mesh of FreeFem",
            "Save it there by savemesh as Medit's .mesh"))


def check_foreign(path):
    with open(path, "rb") as file:
        head = file.read(512).removeprefix(b"\xef\xbb\xbf").lstrip()
    for start, what, cure in FOREIGN:
        if re.match(start, head):
            raise BadMesh(f"{path}: {what}, which is not read. {cure}")


def read(path, region_array=None, surface_array=None):
    check_foreign(path)
    check_end(path)
    gmsh = path.lower().endswith(".msh") and is_gmsh(path)
    mesh = read_raw(path, "gmsh" if gmsh else None)
    counts = {}
    for block in mesh.cells:
        counts[block.type] = counts.get(block.type, 0) + len(block.data)
    check_shapes(path, counts)
    check_groups(path, mesh, gmsh)
    tets, triangles = (positions(mesh, kind) for kind in ("tetra", "triangle"))
    surfaces = None
    if path.lower().endswith(".inp"):
        surfaces = abaqus.Surfaces(path, mesh, cells(mesh, "tetra", 4))
        for name in [n for n in mesh.cell_sets if n.upper() in surfaces.sets]:
            del mesh.cell_sets[name]  # sides of their elements are meant, and no region
    region, surface = tags(path, mesh, (region_array, surface_array), gmsh)
    points = np.asarray(mesh.points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise BadMesh(f"{path}: points are not in space, expected three coordinates each")
    data = {name: np.concatenate(values) for name, values in mesh.cell_data.items() if is_whole(values)}
    raw = Raw(path, points, cells(mesh, "tetra", 4), region, cells(mesh, "triangle", 3), surface,
              arrays.vectors_of(data, tets))
    if surfaces:
        abaqus.add_surfaces(raw, surfaces)
    return raw


def check_groups(path, mesh, gmsh):
    """In Gmsh's format 4.1 meshio takes the first physical group of a volume or surface."""
    sets = {name: members for name, members in mesh.cell_sets.items() if name != "gmsh:bounding_entities"}
    for k, block in enumerate(mesh.cells if gmsh else []):
        groups = [name for name, members in sets.items() if members[k] is not None and len(members[k])]
        if block.type in ("tetra", "triangle") and len(groups) > 1:
            raise BadMesh(f"{path}: {len(block.data):,} elements ({block.type}) are in the physical groups "
                          f"{' and '.join(groups)}, expected one")


def positions(mesh, kind):
    """Numbers of the cells of a kind among all cells."""
    return np.flatnonzero(np.repeat([b.type == kind for b in mesh.cells], [len(b.data) for b in mesh.cells]))


def cells(mesh, kind, corners):
    found = [np.asarray(b.data, dtype=np.int64) for b in mesh.cells if b.type == kind and len(b.data)]
    return np.concatenate(found) if found else np.zeros((0, corners), dtype=np.int64)


def is_whole(values):
    return len({np.asarray(v).shape[1:] for v in values}) == 1


def tags(path, mesh, wanted, gmsh):
    """Regions and surfaces, from numbers of cells or else from named sets of cells."""
    data = {name: np.concatenate(values) for name, values in mesh.cell_data.items() if is_whole(values)}
    untagged = 0 if gmsh else None
    found = []
    for kind, dimension, known, asked, option in (
            ("tetra", 3, arrays.OF_REGIONS, wanted[0], "--region-array"),
            ("triangle", 2, arrays.OF_SURFACES, wanted[1], "--surface-array")):
        at = positions(mesh, kind)
        array = arrays.chosen(path, data, asked, known, option)
        if array is None:
            found.append(tags_of_sets(path, mesh, kind, len(at)))
        else:
            found.append(arrays.tags_of(data, array, at, names_of(path, mesh, dimension, gmsh), untagged))
    return found


def names_of(path, mesh, dimension, gmsh):
    """Names by number of what has this dimension."""
    if gmsh:
        return physical_names(path).get(dimension, {})
    of_families = {number: "_".join(names) for number, names in getattr(mesh, "cell_tags", {}).items() if names}
    named = {int(v[0]): name for name, v in (mesh.field_data or {}).items()
             if np.size(v) == 2 and int(v[1]) == dimension}
    return {**of_families, **named}


def physical_names(path):
    """$PhysicalNames, text in binary files too. meshio keeps one of a volume and a surface that have
    the same name."""
    names, is_inside = {}, False
    with open(path, "rb") as file:
        for line in file:
            line = line.strip()
            if line in (b"$Nodes", b"$Entities", b"$EndPhysicalNames"):
                return names
            match = re.match(r'(\d+) +(\d+) +"(.*)"$', line.decode("utf-8", "replace")) if is_inside else None
            if match:
                names.setdefault(int(match[1]), {})[int(match[2])] = match[3]
            is_inside = is_inside or line == b"$PhysicalNames"
    return names


def tags_of_sets(path, mesh, kind, count):
    """Named sets of cells, as Abaqus has them."""
    sets = element_sets(path, mesh) if path.lower().endswith(".inp") else mesh.cell_sets
    offsets = np.cumsum([0] + [len(b.data) if b.type == kind else 0 for b in mesh.cells])
    found = []
    for name, members in sets.items():
        chosen = [np.asarray(m, dtype=np.int64) + offsets[k] for k, m in enumerate(members)
                  if m is not None and k < len(mesh.cells) and mesh.cells[k].type == kind and len(m)]
        if chosen:
            found.append((name, np.unique(np.concatenate(chosen))))
    found.sort(key=lambda item: len(item[1]) == count)  # a set of all says the least
    of = np.full(count, -1)
    for k, (_, chosen) in enumerate(found):
        of[chosen[of[chosen] < 0]] = k
    return Tags(of, list(range(1, len(found) + 1)), [name for name, _ in found])


def element_sets(path, mesh):
    """ELSETs of Abaqus. meshio puts those of *ELEMENT lines at the wrong place where one line has none or
    two have the same, so these are read here: the k-th line is the k-th block."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line for line in file if re.match(r"\*ELEMENT *,", line, re.I)]
    if len(lines) != len(mesh.cells):
        raise BadMesh(f"{path}: {len(lines)} lines *ELEMENT and {len(mesh.cells)} blocks of elements; "
                      "expected one file without *INCLUDE")
    of_lines = [re.search(r"ELSET *= *([^,\s]+)", line, re.I) for line in lines]
    sets = {}
    for k, match in enumerate(of_lines):
        if match:
            sets.setdefault(match[1], [None] * len(lines))[k] = np.arange(len(mesh.cells[k].data))
    lists = {name: members for name, members in mesh.cell_sets.items()
             if name not in sets and all(np.ndim(m) == 1 and np.asarray(m).dtype.kind == "i" for m in members)}
    return {**lists, **sets}  # lists name groups, lines the parts of the geometry
