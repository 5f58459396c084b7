"""A run goes on with the case that it began with: what has changed since the checkpoint is named, what changes
the solution needs --allow-changes, and every set of parameters is kept.

Usage: restart_changes.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import shutil
import sys

from runs import ROOT, Run, Verdict, command, fresh

PULSE, ARTERY = ROOT / "xml" / "pulse-tiny.xml", ROOT / "xml" / "artery-tiny.xml"


def run(programs, folder, case, steps, *more, ranks=1):
    words = [case, "--output", "results", "--steps", steps, "--set", "Output/fields every=0", *more]
    return Run(command(programs / "tunica-fsi", words, ranks), folder)


def snapshot(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def refuses(verdict, programs, folder):
    before = snapshot(folder / "results")
    for name, case, more, ranks, parts in (
            ("another case", ARTERY, [], 1, ["Wall / Layers / media / law: mooney-rivlin -> holzapfel"]),
            ("another viscosity", PULSE, ["--set", "Fluid/viscosity=0.007"], 2,
             ["Fluid / viscosity: 0.0035 -> 0.007", "checkpoint-000002.h5"]),
            ("a default", PULSE, ["--set", "Fluid/stabilisation=inertial"], 1,
             ["Fluid / stabilisation: tracked -> inertial"])):
        done = run(programs, folder, case, 4, "--restart", *more, ranks=ranks)
        said = [line for line in done.err.splitlines() if line.startswith("tunica-fsi: ")]
        verdict.claim(done.status == 1 and len(said) == 1, f"{name}: one error, exit status {done.status} is 1")
        for part in parts + ["--allow-changes"]:
            verdict.claim(part in done.err, f"{name}: the message holds: {part} {'' if part in done.err else done.err}")
        verdict.claim("Time / steps" not in done.err, f"{name}: and nothing that may change")
    verdict.claim(snapshot(folder / "results") == before, "refusals leave all as it was")
    alone = Run(command(programs / "tunica-fsi", [PULSE, "--output", "results", "--allow-changes"]), folder)
    verdict.claim(alone.status == 1 and "is for --restart" in alone.err, "--allow-changes alone is refused")


def history(folder):
    return json.loads((folder / "results" / "run.json").read_text())["history"]


def goes_on(verdict, programs, folder):
    results = folder / "results"
    first = (results / "case.xml").read_bytes()
    same = run(programs, folder, PULSE, 2, "--restart")
    verdict.claim(same.status == 0 and "changed" not in same.out and len(history(folder)) == 1,
                  "with nothing to do nothing changes")
    free = run(programs, folder, PULSE, 3, "--restart", "--set", "Coupling/tolerance=1e-6")
    verdict.claim(free.status == 0 and "Coupling / tolerance: 1e-08 -> 1e-06" in free.out and
                  "Time / steps: 2 -> 3" in free.out, f"what may change is told {free.err}")
    second = (results / "case-2.xml").read_bytes()
    verdict.claim(b'name="tolerance" type="double" value="1e-06"' in second, "case-2.xml has what is used now")
    changed = run(programs, folder, PULSE, 4, "--restart", "--allow-changes", "--set", "Coupling/tolerance=1e-6",
                  "--set", "Fluid/viscosity=0.007", ranks=2)
    verdict.claim(changed.status == 0 and "Fluid / viscosity: 0.0035 -> 0.007" in changed.out,
                  f"--allow-changes goes on, and tells {changed.err}")
    verdict.claim(b'value="0.007"' in (results / "case-3.xml").read_bytes() and
                  (results / "case.xml").read_bytes() == first and
                  (results / "case-2.xml").read_bytes() == second, "every set of parameters is kept")
    legs = history(folder)
    verdict.claim([leg["after step"] for leg in legs] == [0, 2, 3] and
                  [leg["parameters"] for leg in legs] == ["case.xml", "case-2.xml", "case-3.xml"] and
                  legs[2]["ranks"] == 2, "run.json has the history")
    verdict.claim({"key": "Fluid / viscosity", "before": "0.0035", "now": "0.007"} in legs[2]["changes"] and
                  "changes" not in legs[0], "with what each restart has changed")
    back = run(programs, folder, PULSE, 5, "--restart", "--set", "Coupling/tolerance=1e-6")
    verdict.claim(back.status == 1 and "Fluid / viscosity: 0.007 -> 0.0035" in back.err,
                  "the next restart is compared with the last one")
    # The checkpoint knows, whatever became of the files beside it.
    edited = results / "case-3.xml"
    edited.write_text(edited.read_text().replace('value="0.007"', 'value="0.005"'))
    hidden = run(programs, folder, edited, 5, "--restart")
    verdict.claim(hidden.status == 1 and "Fluid / viscosity: 0.007 -> 0.005" in hidden.err,
                  "a case that was edited in the folder does not pass for the old one")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    done = run(programs, folder, PULSE, 2)
    verdict.claim(done.status == 0, f"the first two steps end with 0 ({done.seconds:.1f} s)")
    for part in (refuses, goes_on):
        part(verdict, programs, folder)
    shutil.rmtree(folder / "results")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
