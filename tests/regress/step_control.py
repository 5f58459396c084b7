"""Steps that fail are cut and repeated as if the short ones had been chosen at once; adaptive steps
go on after a restart; both in a coupled run, and on two ranks as on one.

Usage: step_control.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import json
import pathlib
import sys

from runs import LONG, ROOT, TIGHT, Run, Verdict, command, exactly_same_steps, fresh, table, two_at_a_time

CASE = ROOT / "xml" / "pulse-tiny.xml"
WELL_SOLVED = ["Output/fields every=0"] + [f"{field}/Newton/linear tolerance=1e-10" for field in ("Fluid", "Wall")]
# The first step of this size takes 8 iterations, the second 15, halves of it 11 and 9.
HARD = ["Time/step size=0.5", "Fluid/Surfaces/inlet/traction={0, 0, 4}", "Coupling/tolerance=1e-4",
        "Coupling/max iterations=11"]
ADAPTIVE = ["Time/step control=adaptive", "Time/end time=0.2", "Time/tolerance=0.05",
            "Time/displacement scale=0.005", "Time/velocity scale=0.2", "Output/fields interval=0.08"]


def run_case(programs, folder, output, settings, more=(), ranks=1):
    words = [CASE, "--output", output, *more]
    for setting in WELL_SOLVED + settings:
        words += ["--set", setting]
    return Run(command(programs / "tunica-fsi", words, ranks), folder), folder / output


def alike(verdict, name, one, other, tolerance, rejected=None):
    """Two histories have the same steps, and values that agree."""
    one, other = table(one / "steps.csv"), table(other / "steps.csv")
    verdict.claim(other["rejected"] == (rejected or one["rejected"]), f"{name}: the same steps are repeated {other['rejected']}")
    for column in ("time", "max_displacement_wall_mm", "elastic_energy_kPa_mm3", "max_speed_mm_per_ms"):
        scale = max(abs(value) for value in one[column])
        worst = max(abs(a - b) for a, b in zip(one[column], other[column])) / scale
        verdict.claim(len(one[column]) == len(other[column]) and worst < tolerance,
                      f"{name}: {column} agrees to {worst:.1e}")


def cuts(verdict, programs, folder):
    (run, results), (_, chosen) = two_at_a_time([
        lambda: run_case(programs, folder, "cut", HARD + ["Time/cuts=2"], ["--steps", 2]),
        lambda: run_case(programs, folder, "chosen", HARD + ["Output/fields at={0.75}"], ["--steps", 2])])
    verdict.claim(run.status == 0, f"cut: exit status {run.status} is 0")
    verdict.claim("step 2 is repeated with 0.25 ms: time 1 ms: the interface residual" in run.out,
                  "cut: the log says what is repeated, with what and why")
    rows = table(results / "steps.csv")
    verdict.claim(rows["time"] == [0.5, 0.75, 1.0] and rows["rejected"] == [0.0, 1.0, 0.0] and
                  rows["step_size"] == [0.5, 0.25, 0.25], "cut: steps.csv shows where")
    counts = json.loads((results / "run.json").read_text())["steps"]
    verdict.claim(counts["accepted"] == 3 and counts["failed and repeated"] == 1,
                  f"cut: run.json counts {counts}")
    coupling = table(results / "coupling.csv")
    attempts = {(step, attempt) for step, attempt in zip(coupling["step"], coupling["attempt"])}
    verdict.claim(attempts == {(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (3.0, 1.0)},
                  "cut: coupling.csv has both attempts")
    exactly_same_steps(verdict, "cut", results, chosen, ("seconds", "rejected"))
    if LONG:
        run, both = run_case(programs, folder, "cut-2", HARD + ["Time/cuts=2"], ["--steps", 2], 2)
        verdict.claim(run.status == 0, f"cut on two ranks: exit status {run.status} is 0")
        alike(verdict, "cut on two ranks", results, both, 1e-9)


def goes_on(verdict, programs, folder):
    """With partitioned coupling."""
    (run, straight), _ = two_at_a_time([
        lambda: run_case(programs, folder, "straight", ADAPTIVE, ["--steps", 9]),
        lambda: run_case(programs, folder, "broken", ADAPTIVE, ["--steps", 5])])
    verdict.claim(run.status == 0, f"straight: exit status {run.status} is 0")
    rows = table(straight / "steps.csv")
    verdict.claim(rows["rejected"][0] > 0 and max(rows["error_estimate"]) <= 1.0 and
                  max(rows["step_size"]) > 2 * rows["step_size"][0],
                  f"straight: steps grow from {rows['step_size'][0]:.4f} to "
                  f"{max(rows['step_size']):.4f} ms within the tolerance")
    verdict.claim(0.08 in rows["time"] and 0.16 in rows["time"], "straight: asked times are hit")
    run, both = run_case(programs, folder, "straight-2", ADAPTIVE, ["--steps", 9], 2)
    verdict.claim(run.status == 0, f"straight on two ranks: exit status {run.status} is 0")
    alike(verdict, "straight on two ranks", straight, both, 1e-9)
    run, broken = run_case(programs, folder, "broken", ADAPTIVE, ["--steps", 9, "--restart"])
    verdict.claim(run.status == 0 and "restart after step 5" in run.out,
                  "broken: goes on after its fifth step")
    exactly_same_steps(verdict, "broken", broken, straight)
    run, _ = run_case(programs, folder, "broken", [], ["--steps", 20, "--restart"])
    verdict.claim(run.status == 1 and 'was made with "step control" = "adaptive"' in run.err,
                  "broken: does not go on with fixed steps")


def one_newton_for_all(verdict, programs, folder):
    """Repeated steps bring back what monolithic coupling keeps of earlier ones: states, mesh, rules."""
    def run_whole(output, steps, ranks=1, more=()):
        words = [CASE, "--output", output, "--steps", steps, *TIGHT, *more]
        for setting in ADAPTIVE:
            words += ["--set", setting]
        return Run(command(programs / "tunica-fsi", words, ranks), folder), folder / output
    (run, straight), _ = two_at_a_time([lambda: run_whole("whole", 9), lambda: run_whole("whole-broken", 4)])
    rows = table(straight / "steps.csv")
    verdict.claim(run.status == 0 and rows["rejected"][0] > 0 and max(rows["error_estimate"]) <= 1.0,
                  f"monolithic: the first step is repeated {rows['rejected'][0]:.0f} times {run.err}")
    size = rows["step_size"][0]
    verdict.claim(max(rows["step_size"]) > 2 * size, f"monolithic: steps grow from {size:.4f} to {max(rows['step_size']):.4f} ms")
    verdict.claim(0.08 in rows["time"] and 0.16 in rows["time"], "monolithic: asked times are hit")
    run, chosen = run_whole("whole-chosen", 9, more=["--set", f"Time/step size={size!r}"])
    verdict.claim(run.status == 0, "monolithic: so does a run that begins with that step")
    alike(verdict, "monolithic, chosen", straight, chosen, 1e-9, [0.0] * len(rows["step"]))
    run, both = run_whole("whole-2", 9, 2)
    verdict.claim(run.status == 0, f"monolithic on two ranks: exit status {run.status} is 0")
    alike(verdict, "monolithic on two ranks", straight, both, 1e-9)
    run, broken = run_whole("whole-broken", 9, more=["--restart"])
    verdict.claim(run.status == 0 and "restart after step 4" in run.out, "monolithic: goes on after its fourth step")
    exactly_same_steps(verdict, "monolithic, broken", straight, broken)
    run = Run(command(programs / "tunica-fsi", [CASE, "--output", "whole-broken", "--steps", 20, "--restart", *TIGHT]), folder)
    verdict.claim(run.status == 1 and 'was made with "step control" = "adaptive"' in run.err,
                  "monolithic: does not go on with fixed steps")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for part in (cuts, one_newton_for_all) + ((goes_on,) if LONG else ()):
        part(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
