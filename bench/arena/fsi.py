"""Jacobians of fluid-structure interaction, exported by tunica-solvers from the pulse in a tube."""
import os
import pathlib
import subprocess
import tempfile

import numpy
import scipy.io
import scipy.sparse as sparse

from pages import ENVIRONMENT, PROGRAMS, ROOT, command, refine
from system import System

# Meshes by size: a file of the tree, and how often it is refined.
MESHES = {"small": ("tube-tiny", 0), "medium": ("tube-coarse", 0), "large": ("tube-coarse", 1)}


def mesh_of(size, folder):
    name, times = MESHES[size]
    path = os.path.join(ROOT, "meshes", name + ".h5")
    for k in range(times):
        finer = os.path.join(folder, f"{name}-{k + 1}.h5")
        refine(os.path.join(PROGRAMS, "tunica-mesh"), path, finer, subprocess.DEVNULL)
        path = finer
    return path


def exported(size, field, scheme, folder):
    """Folder with the blocks of the first Newton step of the first time step."""
    solver = ["method=gcr", "preconditioner=multigrid"]
    settings = ["Mesh/file=" + mesh_of(size, folder), "Coupling/scheme=" + scheme, "Solvers/newton step=1",
                "Time/steps=1"]
    if scheme == "monolithic":
        settings += ["Coupling/geometry=quasi"] + ["Coupling/Linear Solver/" + word for word in solver]
    else:
        settings += ["Solvers/field=" + field, "Coupling/preconditioner=none", "Coupling/first factor=0.05"]
        settings += [f"{part}/Linear Solver/{word}" for part in ("Fluid", "Wall") for word in solver]
    words = [os.path.join(ROOT, "xml", "pulse-tiny.xml"), "--output", os.path.join(folder, "run"),
             "--export", os.path.join(folder, "systems")]
    done = subprocess.run(command(os.path.join(PROGRAMS, "tunica-solvers"), words, settings), env=ENVIRONMENT,
                          capture_output=True, text=True, check=False)
    found = sorted(pathlib.Path(folder, "systems").glob(f"{field}-newton-*"))
    if not found:
        raise RuntimeError(f"tunica-solvers exports no system: {done.stderr.strip() or done.stdout.strip()}")
    return found[0]


def jacobian(size, field, scheme):
    with tempfile.TemporaryDirectory() as folder:
        path = exported(size, field, scheme, folder)
        if (path / "W.mtx").exists():
            raise RuntimeError("the system has parts that are no matrix")
        A, B1T, B2, C = (sparse.csr_matrix(scipy.io.mmread(path / f"{name}.mtx")) for name in ("A", "B1T", "B2", "C"))
        b = numpy.asarray(scipy.io.mmread(path / "rhs.mtx")).ravel()
        modes = numpy.asarray(scipy.io.mmread(path / "nullspace.mtx"))
        places = numpy.asarray(scipy.io.mmread(path / "coordinates.mtx"))
    n, m = A.shape[0], C.shape[0]
    K = sparse.bmat([[A, B1T], [B2, -C]], format="csr")
    names = ("velocity", "pressure") if field != "wall" else ("displacement", "pressure")
    return System(K, b, {names[0]: numpy.arange(n), names[1]: numpy.arange(n, n + m)}, 3, True,
                  places=places if field == "wall" else None, rigid=modes if modes.shape[0] == n else None)


def fluid(size):
    return jacobian(size, "fluid", "dirichlet-neumann")


def wall(size):
    return jacobian(size, "wall", "dirichlet-neumann")


def monolithic(size):
    return jacobian(size, "system", "monolithic")
