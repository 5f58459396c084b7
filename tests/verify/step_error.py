"""Adaptive steps keep the error of a run near the tolerance, under a smooth load and one that jumps,
for a fluid and for a wall; and they end where the load jumps and where fields are asked for.

The reference has the same scheme and mesh, and a tolerance ten times as small.

Usage: step_error.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import math
import pathlib
import sys

from runs import LONG, ROOT, Run, Verdict, command, fresh, table, xml

END, JUMP, ASKED = 2.0, 0.7, 1.1  # ms
COUNT = 200
SMOOTH = {"kind": "table", "times": [END * k / COUNT for k in range(COUNT + 1)],
          "values": [math.sin(math.pi * k / COUNT) ** 4 for k in range(COUNT + 1)]}
SUDDEN = {"kind": "table", "times": [0.0, JUMP], "values": [0.2, 1.0], "interpolation": "steps"}
OF_FLUID = ("inflow_inlet_mm3_per_ms", "fluid_kinetic_energy_kPa_mm3", "max_speed_mm_per_ms")
OF_WALL = ("max_displacement_wall_mm", "elastic_energy_kPa_mm3")


def common(mesh):
    return {"Mesh": {"file": str(ROOT / "meshes" / mesh)},
            "Time": {"step size": 0.05, "step control": "adaptive", "end time": END},
            "Output": {"fields every": 0, "checkpoint every": 0, "fields at": [ASKED]}}


def fluid(load):
    return "tunica-fluid", xml({"Case": dict(common("tube-tiny.h5"), Fluid={
        "density": 1.0, "viscosity": 3.5e-3,
        "Surfaces": {"inlet": {"condition": "pressure", "pressure": 1.0, "Amplitude": load},
                     "outlet": {"condition": "pressure", "pressure": 0.0},
                     "interface": {"condition": "no slip"}},
        "Linear Solver": {"method": "direct"}})})


def wall(load):
    held = {f"symmetry_{i}": {"condition": "held", "components": [i]} for i in "xy"}
    ends = {name: {"condition": "held", "components": ["z"]} for name in ("struct_in", "struct_out")}
    inside = {"condition": "pressure", "pressure": 0.3, "Amplitude": load}
    return "tunica-solid", xml({"Case": dict(common("quarter-tube.h5"), Wall={
        "Layers": {name: {"law": "mooney-rivlin"} for name in ("media", "adventitia")},
        "Surfaces": dict(held, **ends, interface=inside),
        "Linear Solver": {"method": "direct"}})})


def march(programs, folder, case, settings):
    program, text = case
    (folder / "case.xml").write_text(text)
    words = ["case.xml", "--output", "results", "--overwrite"]
    for setting in settings:
        words += ["--set", setting]
    run = Run(command(programs / program, words), folder)
    if run.status != 0:
        print(run.out + run.err)
    return table(folder / "results" / "steps.csv")


def error(rows, reference, columns):
    """The largest at the asked time and at the end, relative to the largest value there."""
    def at_times(rows, column):
        return [v for t, v in zip(rows["time"], rows[column]) if t in (ASKED, END)]
    errors = []
    for column in columns:
        one, other = at_times(rows, column), at_times(reference, column)
        errors += [abs(a - b) / max(map(abs, other)) for a, b in zip(one, other)]
    return max(errors)


def study(verdict, name, history, columns, bounds):
    """history(tolerance) are the rows; bounds: of error over tolerance."""
    tolerances = (0.016, 0.004)
    reference, steps = history(tolerances[-1] / 10.0), []
    for tolerance in tolerances:
        rows = history(tolerance)
        part = error(rows, reference, columns) / tolerance
        steps.append(len(rows["step"]))
        verdict.claim(bounds[0] < part < bounds[1],
                      f"{name}: at {tolerance} the error is {part:.2f} times that, {steps[-1]} steps")
        verdict.claim(ASKED in rows["time"] and rows["time"][-1] == END,
                      f"{name}: steps end at {ASKED} and at {END} ms")
        if "jump" in name:
            verdict.claim(JUMP in rows["time"], f"{name}: a step ends at the jump, {JUMP} ms")
            before = rows["time"].index(JUMP)
            sizes = rows["step_size"]
            verdict.claim(sizes[before + 1] < 0.5 * sizes[before] and rows["rejected"][before + 1] > 0,
                          f"{name}: {sizes[before]:.4f} ms before it, {sizes[before + 1]:.4f} behind")
    verdict.claim(steps[0] < steps[1] < len(reference["step"]), f"{name}: steps {steps}")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    smooth = ["Time/hit kinks=false"]  # those of the table are of no account

    def history(case, settings):
        return lambda tolerance: march(programs, folder, case, settings + [f"Time/tolerance={tolerance}"])
    study(verdict, "fluid, smooth", history(fluid(SMOOTH), smooth), OF_FLUID, (0.5, 4.0))
    study(verdict, "fluid, jump", history(fluid(SUDDEN), []), OF_FLUID, (0.0, 1.0))
    study(verdict, "wall, smooth", history(wall(SMOOTH), smooth), OF_WALL, (0.1, 4.0))
    newmark = ["Wall/time scheme=newmark", "Wall/Newmark/beta=0.25", "Wall/Newmark/gamma=0.5"]
    study(verdict, "wall, smooth, Newmark", history(wall(SMOOTH), smooth + newmark), OF_WALL, (0.1, 4.0))
    if LONG:  # it rings: thousands of steps
        study(verdict, "wall, jump", history(wall(SUDDEN), []), OF_WALL, (0.0, 4.0))
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
