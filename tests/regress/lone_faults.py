"""A fault of one rank of two ends the run soon, with exit status 3 and one message that names the
place; the folder it leaves can be restarted: the next fault hits a run that goes on from there, and the last restart
meets none. At night a restart without a fault follows each.

Usage: lone_faults.py FOLDER_OF_PROGRAMS SCRATCH [PLACE ...] [--long]
"""
import pathlib
import shutil
import sys

from runs import ENVIRONMENT, LONG, ROOT, Run, Verdict, checkpoints, command, fresh, table

CASE = ROOT / "xml" / "pulse-tiny.xml"
SECONDS = 100.0  # a guard for busy machines; a quiet one needs less than ten
EVERY = ["--set", "Output/checkpoint every=1", "--set", "Output/fields every=1"]


def wall(preconditioner):
    return ["--set", f"Wall/Linear Solver/preconditioner={preconditioner}"]


# Places (tunica/base/fault_point.hpp), the kinds of faults there, and what leads the run there.
BEFORE_THE_CHECKPOINT_IS_READ = ("mesh reading", "field mesh")
PLACES = [("mesh reading", ["bad_alloc", "error"], []),
          ("field mesh", ["error"], []),
          ("jacobian", ["runtime"], []),
          ("block set-up", ["bad_alloc"], wall("block")),
          ("ilu set-up", ["bad_alloc"], wall("ilu")),
          ("multigrid set-up", ["bad_alloc", "runtime"], wall("multigrid")),
          ("direct set-up", ["bad_alloc"], []),
          ("krylov solve", ["bad_alloc"], []),
          ("mesh motion", ["runtime"], []),
          ("checkpoint", ["error"], []),
          ("field output", ["bad_alloc"], []),
          ("coupling update", ["error"], [])]


def run(programs, folder, output, words, fault=None):
    arguments = [CASE, "--output", output, *EVERY, *words]
    environment = dict(ENVIRONMENT, TUNICA_FAULT=fault) if fault else ENVIRONMENT
    return Run(command(programs / "tunica-fsi", arguments, 2), folder, environment)


def messages(run_):
    """Lines of the program; mpirun adds some of its own."""
    return [line for line in run_.err.splitlines() if line.startswith("tunica")]


def run_with_fault(programs, folder, words, fault):
    """A run in which MPI itself does not start, with no word of the program, shows nothing of it: one more."""
    hurt = run(programs, folder, "hurt", ["--restart", "--steps", 2, *words], fault)
    if hurt.status == 3 or hurt.out or messages(hurt):
        return hurt
    print(f"MPI did not start the program, after {hurt.seconds:.1f} s with status {hurt.status}:\n{hurt.err}")
    return run(programs, folder, "hurt", ["--restart", "--steps", 2, *words], fault)


def fails(verdict, name, hurt, place):
    told = messages(hurt)
    print(f"{name}: {hurt.seconds:.1f} s: {' | '.join(told)}")
    if hurt.status != 3 or len(told) != 1:
        print(f"{name}: out:\n{hurt.out}\nerr:\n{hurt.err}")
    verdict.claim(hurt.status == 3, f"{name}: exit status {hurt.status} is 3")
    verdict.claim(len(told) == 1 and place in told[0], f"{name}: one message names the place")
    verdict.claim(hurt.seconds < SECONDS, f"{name}: the run ends within {SECONDS:.0f} s")


def goes_on(verdict, name, programs, folder, output, words):
    again = run(programs, folder, output, ["--restart", "--steps", 2, *words])
    verdict.claim(again.status == 0, f"{name}: the restart ends with status {again.status}, 0 {again.err}")
    steps = table(folder / output / "steps.csv")
    verdict.claim(steps["step"] == [1.0, 2.0] and checkpoints(folder / output) == [1, 2],
                  f"{name}: the restarted run has both steps")


def main(programs, scratch, places):
    verdict = Verdict()
    folder = fresh(scratch)
    first = run(programs, folder, "hurt", ["--steps", 1])
    verdict.claim(first.status == 0, f"the first step succeeds {first.err}")
    for place, kinds, words in PLACES:
        for kind in kinds if not places or place in places else []:
            name = f"{place} ({kind})"
            hurt = run_with_fault(programs, folder, words, f"{place}:1:{kind}")
            fails(verdict, name, hurt, place)
            verdict.claim(place in BEFORE_THE_CHECKPOINT_IS_READ or "restart after step 1" in hurt.out,
                          f"{name}: it hits a run that goes on after step 1")
            verdict.claim(checkpoints(folder / "hurt") == [1], f"{name}: the checkpoint of step 1 is the last")
            if LONG:
                copy = name.translate(str.maketrans(" ", "-", "()"))
                shutil.copytree(folder / "hurt", folder / copy)
                goes_on(verdict, name, programs, folder, copy, words)
    goes_on(verdict, "after all faults", programs, folder, "hurt", [])
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), sys.argv[3:]))
