"""A prestress that a signal ends, in a load or behind one, goes on with the loads that it would have taken, and ends
with the same wall; a wall that is free to move as a whole is refused, by the name of the motion.

Usage: prestress.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import signal
import sys

from runs import ROOT, Run, Verdict, command, fresh, remove_results, same_steps, table
from stops import STOPPED, status_when_told

CASE = ROOT / "xml" / "pulse-tiny.xml"
# The wall alone, imaged under 0.5 kPa, then under 0.6: what it does depends on its prestress.
SETTINGS = ["Wall/analysis=static", "Wall/Surfaces/interface/condition=pressure", "Wall/Surfaces/interface/pressure=0.6",
            "Wall/Prestress/pressure=0.5", "Wall/Prestress/load steps=40", "Wall/Prestress/tolerance=1e-10",
            "Wall/Prestress/linear tolerance=1e-12", "Output/fields every=0"]
# Without a preconditioner and with a basis of two vectors no solve comes to an end.
STUCK = [f"Wall/Linear Solver/{setting}" for setting in
         ("method=gcr", "preconditioner=none", "fallbacks={}", "restart=2", "max iterations=1000000")]
STUCK += ["Output/progress every=0"]
SLIDING = [f"Wall/Surfaces/{end}/{setting}" for end in ("struct_in", "struct_out")
           for setting in ("condition=held", "components={normal}")]


def words(program, output, settings=(), *more, ranks=1):
    sets = [word for setting in [*SETTINGS, *settings] for word in ("--set", setting)]
    return command(program, [CASE, "--output", output, "--steps", 1, *sets, *more], ranks)


def check_stop(verdict, folder, name, status, message):
    record = json.loads((folder / "broken" / "run.json").read_text())
    verdict.claim(status == STOPPED and record["status"] == "stopped", f"{name}: exit status {status} is {STOPPED}")
    verdict.claim(message in record["message"] and record["message"] in (folder / f"{name}.txt").read_text(),
                  f"{name}: it says \"{record['message']}\"")


def goes_on(verdict, program, folder):
    results = folder / "broken"
    # Told in the set-up, it ends behind a load; how many it has borne by then is left open.
    status = status_when_told(words(program, "broken"), folder / "behind.txt",
                              lambda: (results / ".tunica-lock").exists(), signal.SIGUSR1)
    loads = table(results / "prestress.csv")["load"]
    verdict.claim(0 < loads[-1] < 1, f"it has borne {loads[-1]:.3f} of the load")
    check_stop(verdict, folder, "behind", status, f"with {loads[-1]:.3g} of the load borne. Continue with --restart.")

    before = (results / "prestress.h5").read_bytes()
    rows = (results / "prestress.csv").read_text()
    log = folder / "within.txt"
    status = status_when_told(words(program, "broken", STUCK, "--restart", "--allow-changes", ranks=2), log,
                              lambda: "GCR iteration 100" in log.read_text(), signal.SIGTERM)
    check_stop(verdict, folder, "within", status, f"with {loads[-1]:.3g} of the load borne. Continue with --restart.")
    verdict.claim((results / "prestress.h5").read_bytes() == before, "within: the file of the load before is untouched")
    verdict.claim((results / "prestress.csv").read_text() == rows, "within: so are the rows of prestress.csv")

    more = Run(words(program, "broken", [], "--restart", "--allow-changes"), folder)
    straight = Run(words(program, "straight"), folder)
    verdict.claim([more.status, straight.status] == [0, 0], f"it goes on: {more.status} {more.err.strip()}")
    one, other = (table(folder / name / "prestress.csv") for name in ("broken", "straight"))
    for column in ("load_step", "iteration", "load"):
        verdict.claim(one[column] == other[column], f"{column} is the same in all {len(other[column])} rows")
    moved = table(folder / "straight" / "steps.csv")["max_displacement_wall_mm"][-1]
    verdict.claim(moved > 1e-3, f"the wall moves by {moved:.2e} mm from where it was imaged")
    same_steps(verdict, "stopped and gone on", results, folder / "straight", 1e-8)


def refuses_free_walls(verdict, programs, folder):
    """Static, or dynamic behind a prestress; a tube along z whose ends are held along it alone."""
    for program, settings in (("tunica-solid", SETTINGS), ("tunica-fsi", ["Wall/Prestress/pressure=0.5"])):
        sets = [word for setting in [*settings, *SLIDING] for word in ("--set", setting)]
        done = Run(command(programs / program, [CASE, "--output", program, "--steps", 1, *sets]), folder)
        verdict.claim(done.status == 1 and "against sliding in x and y, and turning about z" in done.err,
                      f"{program}: {done.status} {done.err.strip()}")


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    goes_on(verdict, programs / "tunica-solid", folder)
    refuses_free_walls(verdict, programs, folder)
    remove_results(folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
