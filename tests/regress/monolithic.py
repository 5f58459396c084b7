"""One Newton's method for fluid and wall makes the history of the partitioned iterations, for both
materials, at second order with shape derivatives, and goes on where it was interrupted.

Usage: monolithic.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import shutil
import sys

from runs import LONG, ROOT, Run, Verdict, command, exactly_same_steps, fresh, table

STEPS = 4 if LONG else 3
# Both solved further than the difference that is permitted.
SCHEMES = {
    "partitioned": ["Coupling/tolerance=1e-10"],
    "monolithic": ["Coupling/scheme=monolithic", "Coupling/Newton/absolute increment=1e-11"],
    "newton": ["Coupling/scheme=monolithic", "Coupling/geometry=newton",
               "Coupling/product tolerance=1e-10", "Coupling/Newton/linear tolerance=1e-10",
               "Coupling/Newton/jacobian cost=0", "Coupling/Newton/stop at=increment",
               "Coupling/Newton/absolute increment=1e-8"],
    "extrapolated": ["Coupling/scheme=monolithic", "Coupling/geometry=extrapolated"],
    "default": ["Coupling/scheme=monolithic"],
}
SCHEMES["trapezoidal"] = SCHEMES["default"] + ["Fluid/time scheme=trapezoidal", "Wall/time scheme=trapezoidal",
                                            "Fluid/convection=skew-symmetric"]


def run(verdict, programs, folder, case, scheme, more, output):
    words = [ROOT / "xml" / f"{case}.xml", "--output", output, "--set", "Output/fields every=0"]
    for setting in SCHEMES[scheme]:
        words += ["--set", setting]
    done = Run(command(programs / "tunica-fsi", words + more), folder)
    verdict.claim(done.status == 0, f"{output}: ends with 0 ({done.seconds:.1f} s)")
    if done.status != 0:
        print(done.out + done.err)
    return folder / output


def largest(results, name):
    return max(abs(value) for value in table(results / "steps.csv")[name])


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for case in ("pulse-tiny", "artery-tiny"):
        results = {scheme: run(verdict, programs, folder, case, scheme, ["--steps", STEPS],
                               f"{case}-{scheme}")
                   for scheme in ("partitioned", "monolithic", "newton", "extrapolated")}
        # The tables count the work of other fields.
        both = [table(results[scheme] / "steps.csv") for scheme in ("partitioned", "monolithic")]
        for name in ("max_displacement_wall_mm", "max_speed_mm_per_ms", "fluid_pressure_max_kPa",
                     "wall_pressure_max_kPa", "wall_pressure_min_kPa", "elastic_energy_kPa_mm3",
                     "inflow_inlet_mm3_per_ms", "fluid_volume_mm3", "max_det_F"):
            scale = max(map(abs, both[0][name]))
            error = max(abs(a - b) for a, b in zip(both[0][name], both[1][name])) / scale
            verdict.claim(error < 1e-6, f"{case}: {name} differs by {error:.1e} of {scale:.4g}")
        exact = table(results["newton"] / "newton.csv")
        name = "max_displacement_wall_mm"
        near = largest(results["newton"], name) / largest(results["monolithic"], name) - 1.0
        verdict.claim(abs(near) < 1e-6, f"{case}: with shape derivatives it is {near:.1e} off")
        # The first step starts from rest, the others from a guess. Fibres that begin to carry load
        # bend the artery's equations.
        count = {step: exact["step"].count(step) for step in range(1, STEPS + 1)}
        most = {"pulse-tiny": 3, "artery-tiny": 4}[case]
        verdict.claim(count[1] <= 4 and max(count[k] for k in range(2, STEPS + 1)) <= most,
                      f"{case}: {list(count.values())} steps of Newton's method, at most {most}")
        if case == "pulse-tiny":
            orders = [order for order in exact["exponent"] if order != 0.0]
            verdict.claim(min(orders) > 1.6, f"{case}: of order {min(orders):.2f} at least")
        # A domain that is a step behind in its curvature is near, and not the same.
        near = largest(results["extrapolated"], name) / largest(results["monolithic"], name) - 1.0
        verdict.claim(1e-6 < abs(near) < 0.05, f"{case}: extrapolated geometry is {near:.1e} off")

    hurried = ["--set", "Coupling/Newton/max iterations=1", "--steps", STEPS]
    for wish, status in (("stop", 2), ("accept", 4)):
        words = [ROOT / "xml" / "pulse-tiny.xml", "--output", wish, *hurried,
                 "--set", f"Coupling/when not converged={wish}", "--set", "Coupling/scheme=monolithic",
                 "--set", "Coupling/Newton/absolute increment=1e-30"]
        done = Run(command(programs / "tunica-fsi", words), folder)
        made = len(table(folder / wish / "steps.csv")["step"])
        verdict.claim(done.status == status and made == (STEPS if wish == "accept" else 1),
                      f"one Newton step and four with care are not enough: {wish} ends with {done.status} after {made}")

    # Nothing that only saves work outlives a step; the vessel's resistances couple whole surfaces.
    cases = [("pulse-tiny", "trapezoidal"), ("artery-tiny", "default"), ("vessels/bifurcation", "default")]
    for case, scheme in cases + ([("pulse-tiny", "default")] if LONG else []):
        name = f"{case.replace('/', '-')}-{scheme}"
        straight = run(verdict, programs, folder, case, scheme, ["--steps", STEPS, "--set", "Output/checkpoint every=1"], name)
        broken = folder / f"{name}-broken"
        shutil.copytree(straight, broken)
        (broken / f"checkpoint-{STEPS:06}.h5").unlink()
        run(verdict, programs, folder, case, scheme, ["--steps", STEPS, "--restart", "--set", "Output/checkpoint every=1"],
            broken.name)
        exactly_same_steps(verdict, f"{name}, in two parts", broken, straight)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
