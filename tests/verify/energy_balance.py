"""The energies of steps.csv balance: xml/pulse-tiny.xml until the end of its pulse, in steps of
1/8, 1/16 and 1/32 ms.

    drift = sum dt (traction + kinetic inflow - viscous - backflow - stabilisation)
            - (kinetic energy of fluid and wall + elastic + volumetric energy)

is what the first-order schemes of time (and PSPG in the wall) take out: positive, half as much at
half the step, nothing in the limit, which any term that is missing or has a wrong factor would
spoil. Only the volumetric energy is too small here to be seen: test_wall_energy.cpp has it.

The power of the fluid's SUPG and PSPG has to be among the terms. Where the mesh moves, the pressure
oscillates the more the weaker PSPG is, so that its power stays as tau tends to dt/2 [BGL07].

Usage: energy_balance.py FOLDER_OF_PROGRAMS SCRATCH
"""
import math
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table

END = 1.0  # ms
STEPS = (8, 16, 32)
FIRST_ORDER = ("Fluid/time scheme=implicit euler", "Fluid/stabilisation=inertial",
               "Wall/time scheme=newmark", "Wall/stabilisation=inertial")
TAKEN = ("viscous_power", "backflow_power", "stabilisation_power")  # the wall's is nothing here
GIVEN = ("traction_power", "kinetic_inflow")
STORED = ("fluid_kinetic_energy", "wall_kinetic_energy", "elastic_energy", "volumetric_energy")


def terms(steps):
    """Work by name, and the energies at the end [kPa mm^3]."""
    dt = END / len(steps["step"])
    found = {name: dt * sum(steps[name + "_kPa_mm3_per_ms"]) for name in GIVEN + TAKEN}
    found.update({name: steps[name + "_kPa_mm3"][-1] for name in STORED})
    return found


def drift(found):
    return sum(found[name] for name in GIVEN) - sum(found[name] for name in TAKEN + STORED)


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    drifts = []
    for count in STEPS:
        words = [ROOT / "xml" / "pulse-tiny.xml", "--steps", count, "--output", f"steps-{count}",
                 "--set", f"Time/step size={END / count}", "--set", "Output/fields every=0"]
        for setting in FIRST_ORDER:
            words += ["--set", setting]
        run = Run(command(programs / "tunica-fsi", words), folder)
        if not verdict.claim(run.status == 0, f"{count} steps end with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return verdict.status()
        found = terms(table(folder / f"steps-{count}" / "steps.csv"))
        print("      " + ", ".join(f"{name} {value:.4g}" for name, value in found.items()))
        for name in GIVEN + TAKEN + STORED:
            verdict.claim(found[name] > 0.0, f"{name} is positive")
        work = sum(found[name] for name in GIVEN)
        drifts.append(drift(found))
        verdict.claim(drifts[-1] > 0.0, f"drift {drifts[-1]:.4g}, {drifts[-1] / work:.2%} of the work")
    order = math.log2(drifts[-2] / drifts[-1])
    verdict.claim(abs(order - 1.0) < 0.1, f"the drift is of order {order:.2f} in the time step")
    limit = (2.0 * drifts[-1] - drifts[-2]) / work
    verdict.claim(abs(limit) < 0.002, f"its limit is {limit:.2%} of the work")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
