"""What fields.h5 says of the wall's elements, worked out again from displacement and stress by NumPy.

Usage: wall_fields.py FOLDER_OF_PROGRAMS SCRATCH
"""
import math
import pathlib
import sys

import h5py
import numpy as np

from runs import ROOT, Run, Verdict, command, fresh

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


def compare(verdict, file, regions):
    wall, step = file["wall"], file["step_000002/wall"]
    F = gradients(wall["points"][:], step["displacement"][:], wall["tets"][:])
    xx, xy, zx, yy, yz, zz = step["cauchy_stress"][:].T  # the order of XDMF
    sigma = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]).transpose(2, 0, 1)
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
        done = Run(command(programs / "tunica-fsi", [CASE, "--output", output, "--steps", 2, *more], 2), folder)
        verdict.claim(done.status == 0, f"{output}: ends with 0 {done.err}")
    with h5py.File(folder / "all" / "fields.h5") as file:
        compare(verdict, file, ["fluid", "media", "adventitia"])
    with h5py.File(folder / "stress" / "fields.h5") as file:
        names = sorted(file["step_000002/wall"])
        verdict.claim(names == ["cauchy_stress", "displacement", "pressure", "velocity", "von_mises"],
                      f"what is wanted alone is written: {', '.join(names)}")
    refused = Run(command(programs / "tunica-check", [CASE, "--set", "Output/wall arrays={stresses}"]), folder)
    verdict.claim(refused.status == 1 and "stress, principal or fibres" in refused.err, refused.err.strip())
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
