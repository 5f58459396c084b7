"""A step that does not converge: exit status 2 and a diagnosis, or a warning where the case
accepts it.

Usage: not_converged.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import math
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table

CASE = ROOT / "xml" / "pulse-tiny.xml"


def run_case(programs, folder, output, settings, steps=2, more=()):
    words = [CASE, "--steps", steps, "--output", output, *more, "--set", "Output/fields every=0"]
    for setting in settings:
        words += ["--set", setting]
    return Run(command(programs / "tunica-fsi", words), folder), folder / output


def stops(verdict, programs, folder):
    run, results = run_case(programs, folder, "stop", ["Coupling/max iterations=2"])
    verdict.claim(run.status == 2, f"stop: exit status {run.status} is 2")
    message = run.err.strip()
    for part in ("tunica-fsi: time 0.125 ms", "interface residual is", "after 2 coupling iterations",
                 "expected less than 1e-08 mm"):
        verdict.claim(part in message, f"stop: the diagnosis holds: {part}")
    verdict.claim(len(message.splitlines()) == 1, "stop: the diagnosis is one line")
    record = json.loads((results / "run.json").read_text())
    verdict.claim(record["status"] == "not converged" and record["message"] in message,
                  f"stop: run.json says \"{record['status']}\" and why")
    steps = table(results / "steps.csv")
    verdict.claim(steps["converged"] == [0.0] and steps["coupling_iterations"] == [2.0],
                  "stop: steps.csv ends with the step that did not converge")
    verdict.claim(len(table(results / "coupling.csv")["iteration"]) == 2,
                  "stop: coupling.csv shows both iterations")


def accepts(verdict, programs, folder):
    # The first step needs 20 iterations, the second one 15.
    slow = ["Coupling/preconditioner=none", "Coupling/first factor=0.05"]
    run, results = run_case(programs, folder, "accept", slow + [
        "Coupling/max iterations=17", "Coupling/when not converged=accept"])
    verdict.claim(run.status == 4, f"accept: exit status {run.status} is 4")
    verdict.claim((run.out + run.err).count("NOT CONVERGED") == 1,
                  "accept: the log warns of the first step")
    steps = table(results / "steps.csv")
    verdict.claim(steps["converged"] == [0.0, 1.0], "accept: steps.csv has both, the first marked")
    record = json.loads((results / "run.json").read_text())
    verdict.claim(record["status"] == "done" and record["steps"]["accepted unconverged"] == 1 and
                  "1 step was accepted without convergence" in record["message"] and
                  record["message"] in run.err,
                  f"accept: run.json says \"{record['status']}\" and counts, the log as well")
    run, _ = run_case(programs, folder, "accept", slow + ["Coupling/max iterations=30"], 3, ["--restart"])
    verdict.claim(run.status == 4, "accept: a restart does not forget it")


def newton_fails(verdict, programs, folder):
    run, results = run_case(programs, folder, "newton", ["Wall/Newton/max iterations=1"])
    verdict.claim(run.status == 2, f"newton: exit status {run.status} is 2")
    for part in ("time 0.125 ms, coupling iteration 1", "the wall's Newton method",
                 "after 1 iterations"):
        verdict.claim(part in run.err, f"newton: the diagnosis holds: {part}")
    verdict.claim(table(results / "steps.csv")["converged"] == [0.0],
                  "newton: steps.csv ends with the failed step")


def goes_back(verdict, programs, folder):
    """An update five times too large: the wall cannot follow it."""
    update = ["Coupling/preconditioner=none", "Coupling/accelerator=aitken", "Coupling/first factor=1"]
    run, _ = run_case(programs, folder, "far", update + ["Coupling/halvings=0"], 1)
    verdict.claim(run.status == 2 and "coupling iteration 2: the wall's Newton method" in run.err,
                  "far: without halvings the step fails in the second iteration")
    for choice in ("stop", "accept"):
        ends = ["Coupling/max iterations=2", f"Coupling/when not converged={choice}"]
        run, _ = run_case(programs, folder, f"far-{choice}", update + ends, 1)
        verdict.claim(run.status == 2 and "the wall's Newton method" in run.err,
                      f"far-{choice}: a field that fails in the last iteration is never accepted")
    run, results = run_case(programs, folder, "back", update, 1)
    verdict.claim(run.status == 0, f"back: exit status {run.status} is 0")
    residuals = table(results / "coupling.csv")["interface_residual"]
    verdict.claim(math.isnan(residuals[1]) and residuals[-1] < 1e-8,
                  f"back: the second of {len(residuals)} iterations fails, the last converges")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for part in (stops, accepts, newton_fails, goes_back):
        part(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
