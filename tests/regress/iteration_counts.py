"""A case of xml/ needs as many iterations as recorded.

Usage: iteration_counts.py FOLDER_OF_PROGRAMS SCRATCH [CASE]        CASE: pulse-tiny, artery-tiny
"""
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table


def main(programs, scratch, case="pulse-tiny"):
    verdict = Verdict()
    folder = fresh(scratch)
    expected = table(ROOT / "tests" / "data" / f"fsi-{case}-iterations.csv")
    count = len(expected["step"])
    run = Run(command(programs / "tunica-fsi",
                      [ROOT / "xml" / f"{case}.xml", "--steps", count, "--output", "results",
                       "--set", "Output/fields every=0"]), folder)
    if not verdict.claim(run.status == 0, f"the run ends with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return verdict.status()
    steps = table(folder / "results" / "steps.csv")
    for name in ("coupling_iterations", "fluid_newton", "wall_newton", "fluid_linear",
                 "wall_linear"):
        for k in range(count):
            least, most = expected[f"{name}_least"][k], expected[f"{name}_most"][k]
            verdict.claim(least <= steps[name][k] <= most,
                          f"step {k + 1}: {name} is {steps[name][k]:.0f}, "
                          f"expected {least:.0f} to {most:.0f}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]),
                  *sys.argv[3:]))
