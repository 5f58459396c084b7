"""tunica-vessel killed at twenty random moments, alone or with all that it has started, ends with the same result; and surfaces
that are none of one vessel end with a sentence and a picture of the place: test_kills.py ROOT FOLDER_OF_PROGRAMS SCRATCH [SEED]
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

import numpy as np

from scratch import fresh
from test_pipeline import OPTIONS, claim, make_lumen, numbers_in
from tubes import pipe

KILLS, SAME = 20, 1e-6
STAGES = ("lumen.json", "wall.json", "windkessels.json", "inflow.txt", "case.xml")


def run(programs, words, folder, after=None, with_all=False):
    """Status and text; killed after so many seconds, if it still runs then."""
    command = [str(programs / "tunica-vessel"), *words, "--programs", str(programs)]
    child = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                             start_new_session=True)
    try:
        text, _ = child.communicate(timeout=after)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL) if with_all else child.kill()
        text, _ = child.communicate()
    return child.returncode, text


def result_of(folder):
    """Contents of the stages' files, and all numbers of the beats."""
    texts = [(folder / name).read_text(encoding="utf-8") for name in STAGES]
    return texts, list(numbers_in(json.loads((folder / "beats.json").read_text(encoding="utf-8"))["beats"]))


def compare(expected, found, kills):
    claim(found[0] == expected[0], f"killed {kills} times: the stages have made the same files")
    claim(len(found[1]) == len(expected[1]), "and as many beats", (expected[1], found[1]))
    worst = max(abs(a - b) / max(abs(a), abs(b), 1.0) for a, b in zip(expected[1], found[1]))
    claim(worst < SAME, f"that differ by {worst:.1e}")


def survives(programs, folder, seed):
    """One folder after another, each killed until it is done."""
    words, chance = ["lumen.h5", *OPTIONS, "--to", "run", "--output"], random.Random(seed)
    start = time.time()
    status, text = run(programs, [*words, "whole"], folder)
    whole, expected = time.time() - start, result_of(folder / "whole")
    claim(status == 0, f"a run that nothing kills takes {whole:.0f} s and {len(expected[1])} numbers", text)
    kills, case = 0, 0
    while kills < KILLS:
        case, mine, status = case + 1, 0, -signal.SIGKILL
        while status == -signal.SIGKILL:
            after = chance.uniform(0.02, 0.5) * whole if kills < KILLS else None
            status, text = run(programs, [*words, f"killed-{case}"], folder, after, with_all=kills % 2 == 1)
            mine, kills = mine + (status == -signal.SIGKILL), kills + (status == -signal.SIGKILL)
        claim(status == 0, f"killed {mine} times, the same command still ends", text)
        compare(expected, result_of(folder / f"killed-{case}"), mine)


def write_stl(path, points, triangles):
    """As text."""
    lines = ["solid surface"]
    for corners in points[triangles]:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in corners), "endloop",
                  "endfacet"]
    path.write_text("\n".join([*lines, "endsolid surface"]) + "\n", encoding="utf-8")


def refuses(programs, folder):
    tube = pipe(24, 48, 3.0, 30.0)
    points, triangles = tube.points, tube.triangles
    middle = points[triangles].mean(axis=1)
    is_torn = (middle[:, 0] > 1.5) & (np.abs(middle[:, 2] - 15.0) < 5.0)
    pushed = points.copy()
    pushed[(np.abs(points[:, 2] - 15.0) < 2.0) & (points[:, 0] > 0.0), 0] -= 7.0
    two = np.vstack([points, points + [20.0, 0, 0]]), np.vstack([triangles, triangles + len(points)])
    for name, surface, reason in (("torn", (points, triangles[~is_torn]), "torn open at"), ("two", two, "2 pieces"),
                                  ("crossing", (pushed, triangles), "crosses itself")):
        write_stl(folder / f"{name}.stl", *surface)
        status, text = run(programs, [f"{name}.stl", "--wall", "carotid", "--output", name], folder)
        left = sorted(path.name for path in (folder / name).iterdir())
        claim(status == 1 and reason in text and "refused.png" in text, f"{name}: {text.strip().splitlines()[-1][:110]}", text)
        claim(left == ["programs.log", "refused.png"], "leaves its picture and what was printed", left)
    write_stl(folder / "cm.stl", 0.1 * points, triangles)
    status, text = run(programs, ["cm.stl", "--wall", "carotid", "--output", "cm"], folder)
    claim(status == 1 and "--scale 10 converts" in text, f"in cm: {text.strip().splitlines()[-1][:110]}", text)


def main():
    programs, folder = pathlib.Path(sys.argv[2]).resolve(), fresh(sys.argv[3])
    refuses(programs, folder)
    make_lumen(programs, folder)
    survives(programs, folder, int(sys.argv[4]) if len(sys.argv) > 4 else 1)


if __name__ == "__main__":
    main()
