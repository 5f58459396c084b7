"""How many beats it takes until a beat repeats itself, by tunica-vessel and by marching the same case on, both from the mean
pressure in all Windkessels, and whether both end in the same beat: test_periodicity.py ROOT FOLDER_OF_PROGRAMS SCRATCH [VESSEL ...]
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

import numpy as np

from lumens import lumen_of
from scratch import fresh
from test_pipeline import make_lumen
from vessel import beats, run
from vessel.programs import MPI

COMMON = ["--wall", "aorta", "--wall-elements", "2", "--step"]
OPTIONS = {"tube": [*COMMON, "40", "--flow", "0.4"], "bifurcation": [*COMMON, "10", "--flow", "0.05"], "arch": [*COMMON, "10"]}
MOST, FEW, SAME = 10, 3, 0.005  # beats by marching on; beats of tunica-vessel; difference of the answers


def claim(holds, text):
    print(("ok    " if holds else "FAIL  ") + text, flush=True)
    return bool(holds)


def must(command, folder, log):
    with open(folder / log, "a", encoding="utf-8") as file:
        subprocess.run([str(word) for word in command], cwd=folder, stdout=file, stderr=subprocess.STDOUT, env={**os.environ, **MPI}, check=True)


def beats_of(results, tuned, count):
    """Curves of the beats, and for each from the second on the changes of the pressures and of the wall shear stress."""
    table = beats.read_steps(results / "steps.csv")
    curves = [beats.curves_of(table, k, tuned["period"], tuned["inlet"], list(tuned["outlets"])) for k in range(1, count + 1)]
    changes = [(beats.change(curves[k], curves[k - 1], tuned["inlet"]),
                beats.shear_change(results / "fields.h5", table, k + 1, tuned["period"])) for k in range(1, count)]
    return curves, changes


def first_periodic(changes):
    """The number of the first beat that repeats the one before it."""
    return next((k for k, pair in enumerate(changes, 2) if max(pair) < run.PERIODIC), None)


def mean_pressure(tuned):
    """With which a case by hand may begin [kPa]."""
    return 0.5 * (tuned["goal"]["diastolic"] + tuned["goal"]["systolic"])


def begin_with(case, pressure):
    """In place of the pressures of the network."""
    path = case / "case.xml"
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub('(name="initial pressure" type="double" value=)"[^"]*"', rf'\1"{pressure!r}"', text), encoding="utf-8")


def march_on(programs, case, tuned):
    """The tuned case by tunica-fsi alone."""
    words = [word for name in tuned["outlets"]
             for word in ("--set", f"Fluid/Surfaces/{name}/initial pressure={mean_pressure(tuned)!r}")]
    steps = MOST * round(tuned["period"] / run.time_step(argparse.Namespace(file=lambda name: str(case / name)), tuned["period"]))
    must([programs / "tunica-fsi", "case-tuned.xml", "--output", "plain", "--steps", steps, "--overwrite", *words], case, "plain.log")
    return beats_of(case / "plain", tuned, MOST)


def difference(one, other, inlet):
    """Of two beats: of the pressures, as a part of the pulse, and of the mean flows, as a part of the largest."""
    flows = [np.array(list(beats.mean_flows(curves).values())) for curves in (one, other)]
    return beats.change(one, other, inlet), float(np.abs(flows[0] - flows[1]).max() / flows[0].max())


def lumen(root, programs, folder, name):
    if name != "tube":
        return lumen_of(root / "meshes" / f"{name}.h5", folder / f"{name}.h5")
    make_lumen(programs, folder)
    return os.rename(folder / "lumen.h5", folder / "tube.h5")


def shear_of(results, period, number):
    """Wall shear stress of a beat by the time in it."""
    table = beats.read_steps(results / "steps.csv")
    chosen = beats.rows_of(table, number, period)
    time = {int(step): at for step, at in zip(table["step"][chosen], table["time"][chosen])}
    return {round(time[step] - (number - 1) * period, 3): values
            for step, values in beats.shear_at(results / "fields.h5", time).items()}


def shear_difference(one, other):
    both = [(one[at], other[at]) for at in one if at in other]
    return max(np.linalg.norm(a - b) for a, b in both) / max(np.linalg.norm(a) for a, _ in both)


def try_one(root, programs, folder, name):
    lumen(root, programs, folder, name)
    command, case = [programs / "tunica-vessel", f"{name}.h5", *OPTIONS[name], "--programs", programs, "--output", name], folder / name
    must([*command, "--to", "case"], folder, f"{name}.log")
    tuned = json.loads((case / "windkessels.json").read_text(encoding="utf-8"))
    begin_with(case, mean_pressure(tuned))
    must([*command, "--to", "run"], folder, f"{name}.log")
    count = len(json.loads((case / "beats.json").read_text(encoding="utf-8"))["beats"])
    curves, changes = beats_of(case / "results", tuned, count)
    plain, plain_changes = march_on(programs, case, tuned)
    for told, found in (("tunica-vessel", changes), ("marching on", plain_changes)):
        print(f"{name}, {told}: change of pressure and wall shear stress, %, from beat 2 on: "
              + ", ".join(f"{100 * p:.2g} and {100 * s:.2g}" for p, s in found))
    needed, pressure_and_flow = first_periodic(plain_changes), difference(curves[-1], plain[-1], tuned["inlet"])
    shear = shear_difference(shear_of(case / "results", tuned["period"], count), shear_of(case / "plain", tuned["period"], MOST))
    return all((claim(first_periodic(changes) == count <= FEW, f"{name}: tunica-vessel needs {count} beats"),
                claim(needed is None or needed > count, f"{name}: marching on needs {needed or f'more than {MOST}'}"),
                claim(max(*pressure_and_flow, shear) < SAME, f"{name}: both differ by {100 * pressure_and_flow[0]:.2g} % of the pulse, "
                      f"{100 * pressure_and_flow[1]:.2g} % of a mean flow and {100 * shear:.2g} % of the wall shear stress")))


def main():
    root, programs, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), fresh(sys.argv[3])
    sys.exit(0 if all([try_one(root, programs, folder, name) for name in sys.argv[4:] or OPTIONS]) else 1)


if __name__ == "__main__":
    main()
