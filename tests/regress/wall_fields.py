"""What fields.h5 says of the wall's elements, worked out again from displacement and stress by NumPy.

Usage: wall_fields.py FOLDER_OF_PROGRAMS SCRATCH
"""
import math
import pathlib
import sys

import h5py
import numpy as np

from runs import MONOLITHIC, ROOT, Run, Verdict, command, fresh

CASE = ROOT / "xml" / "artery-tiny.xml"
ANGLES = {"media": 29.0, "adventitia": 62.0}  # of the fibres, degrees


def gradients(points, displacement, tets):
    """F of each element."""
    X = points[tets[:, 1:]] - points[tets[:, :1]]
    x = X + displacement[tets[:, 1:]] - displacement[tets[:, :1]]
    return np.linalg.solve(X, x).transpose(0, 2, 1)  # rows of X are edges: F X_i = x_i


def agree(verdict, found, expected, what):
    off = np.abs(found - expected).max() / np.abs(expected).max()
    verdict.claim(off < 1e-12, f"{what}: {off:.1e}")


def tensor(columns):
    """From the order of XDMF."""
    xx, xy, zx, yy, yz, zz = columns.T
    return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)


def recovered(points, tets, values):
    """At the points, by a weighted linear fit to values at the centroids: those of elements with a neighbour b of the
    point a count as often as elements have both a and b."""
    around = np.zeros((len(points), len(tets)))
    around[tets.T, np.arange(len(tets))] = 1.0
    weight = around @ around.T @ around
    weight /= weight.sum(1, keepdims=True)
    centroids = points[tets].mean(1)
    found = np.empty((len(points), values.shape[1]))
    for a, (w, x) in enumerate(zip(weight, points)):
        y, v = centroids - w @ centroids, values - w @ values
        variance, axes = np.linalg.eigh(np.einsum("e,ei,ej->ij", w, y, y))
        step = axes.T @ (x - w @ centroids)
        limit = 3.0 * np.sqrt(variance)
        found[a] = w @ values + (np.clip(step, -limit, limit) / variance) @ axes.T @ np.einsum("e,ei,ek->ik", w, y, v)
    return found


def compare_recovered(verdict, wall, step):
    points, tets, cells = wall["points"][:], wall["tets"][:], step["cauchy_stress"][:]
    nodal = step["recovered_stress"][:]
    agree(verdict, nodal, recovered(points, tets, cells), "recovered stress")
    sigma = tensor(nodal)
    agree(verdict, step["recovered_principal_stress"][:], np.linalg.eigvalsh(sigma)[:, ::-1], "its principal values")
    deviator = sigma - np.trace(sigma, axis1=1, axis2=2)[:, None, None] / 3.0 * np.eye(3)
    agree(verdict, step["recovered_von_mises"][:].ravel(), np.sqrt(1.5 * (deviator ** 2).sum((1, 2))), "its von Mises stress")
    a, b = (5.0 + 3.0 * math.sqrt(5.0)) / 20.0, (5.0 - math.sqrt(5.0)) / 20.0  # points of quadrature
    square = sum((((tensor(b * nodal[tets].sum(1) + (a - b) * nodal[tets[:, k]] - cells)) ** 2).sum((1, 2))) / 4.0
                 for k in range(4))
    agree(verdict, step["stress_error"][:].ravel(), np.sqrt(square), "stress_error")
    for f in (1, 2):
        fibre = step[f"fibre_{f}"][:]
        unit = fibre / np.linalg.norm(fibre, axis=1, keepdims=True)
        dyads = np.einsum("ei,ej->eij", unit, unit).reshape(-1, 9)
        direction = np.linalg.eigh(recovered(points, tets, dyads).reshape(-1, 3, 3))[1][:, :, -1]
        agree(verdict, step[f"recovered_fibre_stress_{f}"][:].ravel(),
              np.einsum("ni,nij,nj->n", direction, sigma, direction), f"recovered_fibre_stress_{f}")


def compare(verdict, file, regions):
    wall, step = file["wall"], file["step_000002/wall"]
    F = gradients(wall["points"][:], step["displacement"][:], wall["tets"][:])
    sigma = tensor(step["cauchy_stress"][:])
    compare_recovered(verdict, wall, step)
    agree(verdict, step["principal_stress"][:], np.linalg.eigvalsh(sigma)[:, ::-1], "principal stresses")
    agree(verdict, step["principal_stretch"][:], np.linalg.svd(F, compute_uv=False), "principal stretches")
    angle = np.radians(np.array([ANGLES.get(regions[r], math.nan) for r in wall["region"][:]]))[:, None]
    for name, side in (("fibre_1", 1.0), ("fibre_2", -1.0)):
        fibre = np.cos(angle) * step["circumferential"][:] + side * np.sin(angle) * step["axial"][:]
        deformed = np.einsum("eij,ej->ei", F, fibre)
        agree(verdict, step[name][:], deformed, name)
        unit = deformed / np.linalg.norm(deformed, axis=1, keepdims=True)
        stress = name.replace("fibre", "fibre_stress")
        agree(verdict, step[stress][:], np.einsum("ei,eij,ej->e", unit, sigma, unit), stress)
    stretch = np.linalg.norm(step["fibre_1"][:], axis=1)
    verdict.claim(stretch.max() > 1.0001, f"fibres are stretched by up to {stretch.max():.5f}")


def main(programs, scratch):
    programs, folder, verdict = pathlib.Path(programs).resolve(), fresh(scratch), Verdict()
    for output, more in (("all", []), ("stress", ["--set", "Output/wall arrays={stress}"])):
        done = Run(command(programs / "tunica-fsi", [CASE, "--output", output, "--steps", 2, *MONOLITHIC, *more], 2), folder)
        verdict.claim(done.status == 0, f"{output}: ends with 0 {done.err}")
    with h5py.File(folder / "all" / "fields.h5") as file:
        compare(verdict, file, ["fluid", "media", "adventitia"])
    with h5py.File(folder / "stress" / "fields.h5") as file:
        names = sorted(file["step_000002/wall"])
        verdict.claim(names == ["cauchy_stress", "displacement", "pressure", "recovered_stress", "recovered_von_mises",
                                "stress_error", "velocity", "von_mises"],
                      f"what is wanted alone is written: {', '.join(names)}")
    refused = Run(command(programs / "tunica-check", [CASE, "--set", "Output/wall arrays={stresses}"]), folder)
    verdict.claim(refused.status == 1 and "stress, principal or fibres" in refused.err, refused.err.strip())
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
