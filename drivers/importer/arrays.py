"""Which of a file's cell arrays says to what region and surface an element belongs."""
import numpy as np

from .raw import BadMesh, Tags, hint

# Tunica, SimVascular, VMTK, then what meshio calls the tags of other formats.
OF_REGIONS = ("region", "ModelRegionID", "CellEntityIds", "gmsh:physical", "gmsh:geometrical", "medit:ref",
              "tetgen:ref", "netgen:index", "nastran:ref", "avsucd:material", "flac3d:group", "su2:tag",
              "cell_tags", "ObjectId")
OF_SURFACES = ("surface", "ModelFaceID") + OF_REGIONS[2:]


def chosen(path, arrays, wanted, known, option):
    """The name of the array, or None. arrays: name -> values per cell."""
    if wanted is None:
        return next((name for name in known if name in arrays and is_number(arrays[name])), None)
    if wanted not in arrays:
        there = "It has " + (", ".join(sorted(arrays)) or "none") + "."
        raise BadMesh(f'{path}: no cell array "{wanted}", as {option} asks for. {hint(wanted, arrays, there)}')
    if not is_number(arrays[wanted]):
        raise BadMesh(f'{path}: the cell array "{wanted}" of {option} does not hold one whole number per cell')
    return wanted


def is_number(values):
    """One whole number per cell; as floating point, too."""
    values = np.asarray(values)
    if values.ndim == 2 and values.shape[1] == 1:
        values = values[:, 0]
    return values.ndim == 1 and values.dtype.kind in "iuf" and bool(
        np.isfinite(values).all() and (values == np.round(values)).all())


def tags_of(arrays, name, elements, names=None, untagged=None):
    """Tags by the numbers of an array at these cells; none where there is no array."""
    if name is None or not len(elements):
        return Tags.none(len(elements))
    return Tags.of_numbers(np.asarray(arrays[name]).reshape(-1)[elements], names, untagged)


def vectors_of(arrays, tets):
    """What has three real components in each tetrahedron: directions of fibres."""
    found = {}
    for name, values in arrays.items():
        values = np.asarray(values)
        if values.ndim == 2 and values.shape[1] == 3 and values.dtype.kind == "f" and len(tets):
            of_tets = values[tets].astype(float)
            if np.isfinite(of_tets).all() and of_tets.any() and not set('"<>&\n') & set(name):
                found[name] = of_tets
    return found
