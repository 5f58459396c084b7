"""Averages of the wall shear stress over time, against those of the wall shear stress that the fields of each
step hold; across a restart on another number of ranks, too.

Usage: wall_shear.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import shutil
import sys

import h5py
import numpy as np
from runs import ROOT, Run, Verdict, command, fresh, table

CASE = ROOT / "xml" / "windkessel.xml"
AVERAGES = {"time_averaged_wss", "oscillatory_shear_index", "relative_residence_time"}
STEPS, STEP, FROM = 60, 5.0, 152.0  # [ms]; the averages begin within a step


def run(verdict, programs, folder, name, ranks=1, words=(), begin=FROM):
    done = Run(command(programs / "tunica-fluid",
                       [CASE, "--output", name, "--set", f"Output/averages from={begin}", *words], ranks), folder)
    verdict.claim(done.status == 0, f"{name}: ends with 0 {done.err}")
    return folder / name


def by_vertex(results, step, name):
    with h5py.File(results / "fields.h5", "r") as file:
        values = file[f"step_{step:06}/fluid/{name}"][()]
        return values[np.argsort(file["fluid/vertices"][()])]


def arrays_of(results, step):
    with h5py.File(results / "fields.h5", "r") as file:
        return set(file[f"step_{step:06}/fluid"])


def weights_from(begin):
    """Of the steps, how much of them is averaged [ms]."""
    return {step: min(STEP, STEP * step - begin) for step in range(1, STEPS + 1) if STEP * step > begin}


def check_averages(verdict, results):
    weights = weights_from(FROM)
    stresses = {step: by_vertex(results, step, "wall_shear_stress") for step in weights}
    total = sum(weights.values())
    size = sum(weights[k] * np.linalg.norm(stresses[k], axis=1) for k in weights)
    along = np.linalg.norm(sum(weights[k] * stresses[k] for k in weights), axis=1)
    on_wall = size > 0.0
    verdict.claim(0.1 < on_wall.mean() < 0.9, f"{on_wall.mean():.2f} of the vertices have a wall shear stress")
    expected = {"time_averaged_wss": size / total,
                "oscillatory_shear_index": np.where(on_wall, 0.5 * (1 - along / np.where(on_wall, size, 1)), 0),
                "relative_residence_time": np.where(on_wall, total / np.where(on_wall, along, 1), 0)}
    for name, values in expected.items():
        found = by_vertex(results, STEPS, name)
        error = np.abs(found - values).max() / np.abs(values).max()
        verdict.claim(error < 1e-6, f"{name} is that of {len(weights)} steps to {error:.1e}")
    osi = expected["oscillatory_shear_index"]
    verdict.claim(osi.max() > 0.01 and osi.max() <= 0.5, f"the flow turns back somewhere: OSI to {osi.max():.3f}")
    peaks = table(results / "steps.csv")["max_wall_shear_stress_kPa"]
    worst = max(abs(np.linalg.norm(stresses[k], axis=1).max() - peaks[k - 1]) for k in weights)
    verdict.claim(worst < 1e-6 * max(peaks), f"steps.csv has the largest to {worst:.1e} kPa")
    for step in range(1, STEPS + 1):
        found = AVERAGES & arrays_of(results, step)
        verdict.claim(found == (AVERAGES if step in weights else set()),
                      f"step {step} has {len(found)} averages, which begin at {FROM} ms")


def check_steady(verdict, programs, folder):
    """On the way to a steady flow steps are no times: the averages are those of a flow that stays as it is."""
    done = Run(command(programs / "tunica-fluid",
                       [ROOT / "xml" / "poiseuille.xml", "--output", "steady", "--set", "Time/step control=steady",
                        "--set", "Time/step size=10", "--steps", 200]), folder)
    verdict.claim(done.status == 0, f"steady: ends with 0 {done.err}")
    last = len(table(folder / "steady" / "steps.csv")["step"])
    stress = np.linalg.norm(by_vertex(folder / "steady", last, "wall_shear_stress"), axis=1)
    on_wall = stress > 0.0
    expected = {"time_averaged_wss": stress, "oscillatory_shear_index": 0 * stress,
                "relative_residence_time": np.where(on_wall, 1 / np.where(on_wall, stress, 1), 0)}
    verdict.claim(0.1 < on_wall.mean() < 0.9, f"steady: {on_wall.mean():.2f} of the vertices have a wall shear stress")
    for name, values in expected.items():
        error = np.abs(by_vertex(folder / "steady", last, name) - values).max()
        verdict.claim(error <= 1e-12 * np.abs(values).max(), f"steady: {name} is that of the wall shear stress")


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    straight = run(verdict, programs, folder, "straight", words=["--steps", STEPS])
    check_averages(verdict, straight)
    check_steady(verdict, programs, folder)
    run(verdict, programs, folder, "broken", words=["--steps", 45])
    shutil.copytree(folder / "broken", folder / "later")
    broken = run(verdict, programs, folder, "broken", 2, ["--steps", STEPS, "--restart"])
    for name in ("time_averaged_wss", "oscillatory_shear_index"):
        one, other = by_vertex(straight, STEPS, name), by_vertex(broken, STEPS, name)
        error = np.abs(one - other).max() / np.abs(one).max()
        verdict.claim(error < 1e-5, f"{name} of a run that went on on two ranks is the same to {error:.1e}")
    weights = weights_from(252.0)
    later = run(verdict, programs, folder, "later", words=["--steps", STEPS, "--restart"], begin=252.0)
    expected = sum(w * np.linalg.norm(by_vertex(straight, k, "wall_shear_stress"), axis=1) for k, w in weights.items())
    error = np.abs(by_vertex(later, STEPS, "time_averaged_wss") - expected / sum(weights.values())).max()
    verdict.claim(error < 1e-5 * expected.max(), f"averages from another time on begin anew: {error:.1e} kPa")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
