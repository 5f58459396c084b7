"""The HDF5 file that Tunica's programs read, "tunica-mesh 1"; docs/meshes.md describes it."""
import contextlib
import os
import tempfile

import numpy as np

from .raw import BadMesh, Raw, Tags

FORMAT = "tunica-mesh 1"


def read(path):
    """To be renamed, scaled, joined with another."""
    import h5py
    try:
        with h5py.File(path, "r") as file:
            found = file.attrs.get("format", b"none")
            found = found.decode("utf-8", "replace") if isinstance(found, bytes) else str(found)
            if found != FORMAT:
                raise BadMesh(f'{path}: the attribute "format" is "{found}", expected "{FORMAT}"')
            return Raw(path, file["vertices"][:].astype(float), file["tets"][:].astype(np.int64),
                       tags(file, "region", "tet_region"), file["triangles"][:].astype(np.int64),
                       tags(file, "surface", "triangle_surface"), vectors(file))
    except (OSError, KeyError, ValueError) as error:
        raise BadMesh(f"{path}: not a readable HDF5 file of the form {FORMAT}: {error}") from error


def tags(file, kind, of):
    names = [name.decode("utf-8") for name in file[kind + "_names"][:]]
    return Tags(file[of][:].astype(np.int64), file[kind + "_ids"][:].tolist(), names)


def vectors(file):
    if "tet_vectors" not in file:
        return {}
    names = [name.decode("utf-8") for name in file["tet_vector_names"][:]]
    return dict(zip(names, file["tet_vectors"][:].reshape(len(names), -1, 3)))


def fill(file, raw):
    file.attrs["format"] = np.bytes_(FORMAT)
    file["vertices"] = np.ascontiguousarray(raw.points, dtype="f8")
    for name, values in (("tets", raw.tets), ("tet_region", raw.region.of), ("triangles", raw.triangles),
                         ("triangle_surface", raw.surface.of)):
        file[name] = np.ascontiguousarray(values, dtype="i4")
    for kind, tags in (("region", raw.region), ("surface", raw.surface)):
        file[kind + "_ids"] = np.array(tags.ids, dtype="i4")
        file[kind + "_names"] = np.array([name.encode("utf-8") for name in tags.names], dtype="S")
    if raw.vectors:
        file["tet_vector_names"] = np.array([name.encode("utf-8") for name in raw.vectors], dtype="S")
        file["tet_vectors"] = np.concatenate(list(raw.vectors.values())).astype("f8")


def write(raw, path):
    """Under another name first: no one finds half a file."""
    import h5py
    folder = os.path.dirname(os.path.abspath(path))
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(prefix=os.path.basename(path) + ".", suffix=".part", dir=folder)
        os.close(handle)
        with h5py.File(temporary, "w") as file:
            fill(file, raw)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp's is for its owner alone
        os.replace(temporary, path)
    except BaseException as error:  # an interrupt, too, leaves nothing behind
        if temporary:
            with contextlib.suppress(OSError):
                os.remove(temporary)
        if not isinstance(error, OSError):
            raise
        raise BadMesh(f"{path}: cannot be written: {error}") from error


def check_target(path, may_overwrite):
    """Before the long work."""
    if not path.endswith(".h5"):
        raise BadMesh(f"{path}: expected a name that ends in .h5, Tunica's own format. "
                      "tunica-mesh convert writes others")
    if os.path.isdir(path) or not os.path.isdir(os.path.dirname(os.path.abspath(path))):
        raise BadMesh(f"{path}: cannot be written: there is no such folder, or a folder has this name")
    if os.path.exists(path) and not may_overwrite:
        raise BadMesh(f"{path}: is there already. --overwrite replaces it")
