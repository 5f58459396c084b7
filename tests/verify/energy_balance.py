"""The energies of steps.csv balance.

    drift = sum dt (traction + kinetic inflow + divergence - viscous - backflow - stabilisation)
            - (kinetic energy of fluid and wall + elastic + volumetric energy)

xml/pulse-tiny.xml until the end of its pulse, in steps of 1/8, 1/16 and 1/32 ms: drift is what the
first-order schemes of time (and PSPG in the wall) take out: positive, half as much at half the step,
nothing in the limit, which any term that is missing or has a wrong factor would spoil. Only the
volumetric energy is too small here to be seen: test_wall_energy.cpp has it.

xml/reference-tube.xml, 64 steps of 1/8 ms, with subscales in time: the trapezoidal rule takes out
nothing, BDF2 a few per cent, with either form of convection.

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
               "Wall/time scheme=newmark", "Wall/stabilisation=inertial", "Coupling/scheme=monolithic")
SECOND_ORDER = ("Fluid/stabilisation=dynamic", "Wall/stabilisation=dynamic",
                "Fluid/stabilisation residual=viscous", "Fluid/stabilisation velocity=predicted",
                "Coupling/scheme=monolithic")
TAKEN = ("viscous_power", "backflow_power", "stabilisation_power")
GIVEN = ("traction_power", "kinetic_inflow")
EITHER = ("divergence_power",)  # given or taken
STORED = ("fluid_kinetic_energy", "wall_kinetic_energy", "elastic_energy", "volumetric_energy")


def terms(steps, taken=TAKEN, by_trapezoids=False):
    """Work by name, and the energies at the end [kPa mm^3]."""
    dt = steps["time"][-1] / len(steps["step"])
    found = {}
    for name in GIVEN + EITHER + taken:
        power = steps[name + "_kPa_mm3_per_ms"]  # nothing before the first step: the fluid is at rest
        found[name] = dt * (sum(power) - (0.5 * power[-1] if by_trapezoids else 0.0))
    found.update({name: steps[name + "_kPa_mm3"][-1] for name in STORED})
    return found


def drift(found, taken=TAKEN):
    return sum(found[name] for name in GIVEN + EITHER) - sum(found[name] for name in taken + STORED)


def second_order(programs, folder, verdict):
    taken = TAKEN + ("wall_stabilisation_power",)
    for scheme, convection, most in (("trapezoidal", "advective", 0.005),
                                     ("trapezoidal", "skew-symmetric", 0.005),
                                     ("bdf2", "advective", 0.05)):
        name = f"{scheme}-{convection}"
        words = [ROOT / "xml" / "reference-tube.xml", "--output", name]
        for setting in SECOND_ORDER + (f"Fluid/time scheme={scheme}", f"Wall/time scheme={scheme}",
                                       f"Fluid/convection={convection}", "Output/fields every=0"):
            words += ["--set", setting]
        run = Run(command(programs / "tunica-fsi", words), folder)
        if not verdict.claim(run.status == 0, f"{name} ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return
        found = terms(table(folder / name / "steps.csv"), taken, by_trapezoids=True)
        work = sum(found[name] for name in GIVEN)
        lost = drift(found, taken) / work
        verdict.claim(abs(lost) < most, f"it loses {lost:.2%} of the work put in")
        given = found["divergence_power"] / work
        if convection == "advective":
            verdict.claim(given < -0.1, f"divergence takes out {-given:.1%}")
        else:
            verdict.claim(given == 0.0, "divergence takes out nothing")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    second_order(programs, folder, verdict)
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
