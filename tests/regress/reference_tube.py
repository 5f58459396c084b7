"""xml/reference-tube.xml agrees with an independent prototype: tests/data/fsi-tube-small*.csv.

Every physical column of steps.csv, to 1e-5 of its largest magnitude over the reference's 64 steps,
or 1e-6 where one Newton's method solves for all.

Usage: reference_tube.py FOLDER_OF_PROGRAMS SCRATCH [--steps N] [--accelerator iqn-ils|aitken]
                         [--variant inertial|dynamic|bdf2] [--scheme monolithic
                         [--geometry quasi|newton]]
"""
import argparse
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table

TOLERANCE = 1e-5
OURS = {"inflow_mm3_per_ms": "inflow_inlet_mm3_per_ms"}  # other columns have the same names
NOT_COMPARED = {"step", "time_ms", "inlet_traction_kPa"}
# What each accelerator is run with, and the coupling iterations of each step.
SETTINGS = {"iqn-ils": [], "aitken": ["preconditioner=none", "first factor=0.1"]}
BACKFLOW = ["Fluid/Surfaces/inlet/backflow stabilisation=0.2",
            "Fluid/Surfaces/outlet/condition=traction", "Fluid/Surfaces/outlet/traction={0,0,0}",
            "Fluid/Surfaces/outlet/backflow stabilisation=0.2"]
# The reference of each variant, how many more coupling iterations it takes at most, and what it
# differs in from the case.
VARIANTS = {
    "inertial": ("fsi-tube-small.csv", 0, []),
    "dynamic": ("fsi-tube-small-dynamic.csv", 0,
                ["Fluid/stabilisation=dynamic", "Wall/stabilisation=dynamic"] + BACKFLOW),
    "bdf2": ("fsi-tube-small-bdf2.csv", 5,
             ["Fluid/stabilisation=dynamic", "Wall/stabilisation=dynamic",
              "Fluid/time scheme=bdf2", "Wall/time scheme=bdf2",
              # its pressures see an interface residual r as rho r/dt_e^2
              "Coupling/tolerance=1e-9"] + BACKFLOW),
}
ITERATIONS = {"iqn-ils": (5, 13), "aitken": (40, 70)}
MONOLITHIC = ["scheme=monolithic", "Newton/stop at=increment", "Newton/absolute increment=1e-8",
              "Newton/jacobian cost=0", "Newton/linear tolerance=1e-8"]


def compare(verdict, reference, steps, tolerance):
    count = len(steps["step"])
    for name, expected in reference.items():
        if name in NOT_COMPARED:
            continue
        scale = max(abs(value) for value in expected)
        errors = [abs(a - b) / scale for a, b in zip(steps[OURS.get(name, name)], expected)]
        verdict.claim(max(errors) < tolerance,
                      f"{name}: {max(errors):.1e} of {scale:.4g} in {count} steps")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=4, help="1 .. 64")
    parser.add_argument("--accelerator", default="iqn-ils", choices=sorted(ITERATIONS))
    parser.add_argument("--variant", default="inertial", choices=sorted(VARIANTS))
    parser.add_argument("--geometry", default="quasi", choices=("quasi", "newton"))
    parser.add_argument("--scheme", default="dirichlet-neumann",
                        choices=("dirichlet-neumann", "monolithic"))
    wanted = parser.parse_args()
    is_monolithic = wanted.scheme == "monolithic"
    reference, more, variant = VARIANTS[wanted.variant]
    verdict = Verdict()
    folder = fresh(wanted.scratch)
    words = [ROOT / "xml" / "reference-tube.xml", "--steps", wanted.steps, "--output", "results",
             "--set", "Output/fields every=0"]
    coupling = (MONOLITHIC + [f"geometry={wanted.geometry}"] if is_monolithic else
                [f"accelerator={wanted.accelerator}"] + SETTINGS[wanted.accelerator])
    if is_monolithic:
        variant = [setting for setting in variant if not setting.startswith("Coupling/")]
    for setting in [f"Coupling/{s}" for s in coupling] + variant:
        words += ["--set", setting]
    run = Run(command(wanted.programs.resolve() / "tunica-fsi", words), folder)
    if not verdict.claim(run.status == 0, f"the run ends with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return verdict.status()
    steps = table(folder / "results" / "steps.csv")
    verdict.claim(len(steps["step"]) == wanted.steps, f"{wanted.steps} steps were made")
    compare(verdict, table(ROOT / "tests" / "data" / reference), steps,
            1e-6 if is_monolithic else TOLERANCE)
    if is_monolithic:
        used = steps["system_newton"]
        most = {"quasi": 5, "newton": 4}[wanted.geometry]
        verdict.claim(max(used) <= most,
                      f"{min(used):.0f} to {max(used):.0f} Newton steps, at most {most}")
        return verdict.status()
    least, most = ITERATIONS[wanted.accelerator]
    most += more
    used = steps["coupling_iterations"]
    verdict.claim(least <= min(used) and max(used) <= most,
                  f"{min(used):.0f} to {max(used):.0f} coupling iterations, "
                  f"expected {least} to {most}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
