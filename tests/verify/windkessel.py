"""Windkessels behind an outlet. xml/windkessel.xml prescribes what flows in, so that the outlet's
pressure is known in advance, on any ranks and across a restart; then one behind the vessel of
xml/pulse-tiny.xml, and what tunica-solvers makes of its systems. That the pressure is that of the scheme of time is
tested to the last digits; that the scheme's is of its order by the scheme, and at night also by the program.

Usage: windkessel.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import json
import math
import pathlib
import shutil
import sys
import xml.etree.ElementTree as ElementTree

from runs import LONG, ROOT, Run, Verdict, checkpoints, command, entry, fresh, same_steps, table, two_at_a_time

CASE = ROOT / "xml" / "windkessel.xml"
R_P, C, R_D, P_D, P_0 = 1.0, 10.0, 16.0, 1.0, 10.0
LENGTH, AT_REST = 400.0, 250.0  # of the run; all that flows in has done so after 200 [ms]
EXACT = ["Fluid/Linear Solver/method=direct"]  # which has no memory of earlier steps


def run(verdict, programs, folder, name, settings=(), ranks=1, words=()):
    arguments = [CASE, "--output", name, *words]
    for setting in settings:
        arguments += ["--set", setting]
    done = Run(command(programs / "tunica-fluid", arguments, ranks), folder)
    if not verdict.claim(done.status == 0, f"{name}: ends with 0 ({done.seconds:.1f} s)"):
        print(done.out + done.err)
    return table(folder / name / "steps.csv")


def stored_pressures(flows, dt, scheme, initial, capacitance, distal, behind):
    """C dp/dt = Q - (p - behind)/R by implicit Euler, or by BDF2 behind one such step."""
    p, before, pressures = initial, None, []
    for flow in flows:
        rate, past = 1.0 / dt, p
        if scheme == "bdf2" and before is not None:
            rate, past = 1.5 / dt, (4.0 * p - before) / 3.0
        new = (capacitance * rate * past + flow + behind / distal) / (capacitance * rate + 1.0 / distal)
        p, before = new, p
        pressures.append(p)
    return pressures


def stepped(flows, dt, scheme):
    """Pressures of the outlet."""
    stored = stored_pressures(flows, dt, scheme, P_0, C, R_D, P_D)
    return [R_P * flow + p for flow, p in zip(flows, stored)]


RAMPS = ((1 / 50, 0), (-1 / 50, 50), (-1 / 100, 100), (1 / 100, 200))  # of the case's inflow: slopes and beginnings


def inflow(time):
    """In parts of its peak."""
    return sum(slope * max(time - start, 0.0) for slope, start in RAMPS)


def closed_form(peak, time):
    """The pressure without steps in time."""
    decay = R_D * C
    stored = P_D + (P_0 - P_D) * math.exp(-time / decay)
    for slope, start in RAMPS:
        t = max(time - start, 0.0)
        stored += peak * slope * R_D * (t - decay * (1.0 - math.exp(-t / decay)))
    return R_P * peak * inflow(time) + stored


def worst(found, expected):
    return max(abs(a - b) for a, b in zip(found, expected)) / max(map(abs, expected))


def has_its_order(verdict, scheme, peak, expected):
    """The scheme itself, of the inflow at the ends of its steps."""
    errors = []
    for dt in (5.0, 2.5):
        times = [dt * k for k in range(1, int(LENGTH / dt) + 1)]
        exact = [closed_form(peak, time) for time in times]
        errors.append(worst(stepped([peak * inflow(time) for time in times], dt, scheme), exact))
    order = math.log2(errors[0] / errors[1])
    verdict.claim(errors[0] < 0.02 and abs(order - expected) < 0.15,
                  f"{scheme}: errors to the closed form {errors[0]:.1e}, {errors[1]:.1e}: order {order:.2f}")


def check_pressures(verdict, programs, folder):
    def march(name, dt, ranks, scheme, length):
        return name, dt, scheme, run(verdict, programs, folder, name,
                                     [f"Time/step size={dt}", f"Fluid/time scheme={scheme}"], ranks,
                                     ["--steps", int(length / dt)])
    long = LENGTH if LONG else AT_REST
    marches = two_at_a_time([
        lambda: march("one", 5.0, 1, "bdf2", long),
        lambda: march("euler", 5.0, 1, "implicit euler", long if LONG else 100.0)] + ([
            lambda: march("half", 2.5, 1, "bdf2", long),
            lambda: march("euler-half", 2.5, 1, "implicit euler", long)] if LONG else []))
    marches.append(march("two", 5.0, 2, "bdf2", 75.0))
    peak = max(marches[0][3]["inflow_inlet_mm3_per_ms"])
    errors = {}
    for name, dt, scheme, steps in marches:
        flows, pressures = steps["inflow_inlet_mm3_per_ms"], steps["pressure_outlet_kPa"]
        error = worst(flows, [peak * inflow(time) for time in steps["time"]])
        verdict.claim(error < 1e-6, f"{name}: what flows in is that of the case to {error:.1e}")
        error = worst(pressures, stepped(flows, dt, scheme))
        verdict.claim(error < 1e-9, f"{name}: the pressure is that of {scheme} to {error:.1e}")
        error = worst(steps["inflow_outlet_mm3_per_ms"], [-flow for flow in flows])
        verdict.claim(error < 1e-6, f"{name}: what flows in flows out to {error:.1e}")
        errors[name] = worst(pressures, [closed_form(peak, time) for time in steps["time"]])
        verdict.claim(errors[name] < 0.02, f"{name}: it is {errors[name]:.1e} off the closed form")
        if steps["time"][-1] >= AT_REST:
            # The outlet holds the fluid's pressure, and its beginning little more.
            lowest = steps["fluid_pressure_min_kPa"][-1]
            verdict.claim(abs(lowest - pressures[-1]) < 1e-3 * pressures[-1],
                          f"{name}: the fluid at rest has {lowest:.6f} kPa, the outlet {pressures[-1]:.6f}")
    for scheme, one, half, expected in (("bdf2", "one", "half", 2.0), ("implicit euler", "euler", "euler-half", 1.0)):
        has_its_order(verdict, scheme, peak, expected)
        if LONG:
            order = math.log2(errors[one] / errors[half])
            verdict.claim(abs(order - expected) < 0.15, f"{one}, {half}: order {order:.2f}")
    same_steps(verdict, "two ranks", folder / "two", folder / "one", first=15)


def check_resistance(verdict, programs, folder):
    steps = run(verdict, programs, folder, "resistance",
                ["Fluid/Surfaces/outlet/capacitance=0"], words=["--steps", 12])
    expected = [P_D + (R_P + R_D) * flow for flow in steps["inflow_inlet_mm3_per_ms"]]
    error = worst(steps["pressure_outlet_kPa"], expected)
    verdict.claim(error < 1e-9, f"without capacitance the pressure is p_d + (R_p + R_d) Q to {error:.1e}")


def same_file(verdict, what, one, other):
    rows = [table(path) for path in (one, other)]
    for columns in rows:
        columns.pop("seconds")
    verdict.claim(rows[0] == rows[1], f"{what}: every digit of {one.name} is the same")


def check_restart(verdict, programs, folder):
    two_at_a_time([
        lambda: run(verdict, programs, folder, "straight", EXACT, words=["--steps", 6]),
        lambda: run(verdict, programs, folder, "broken", EXACT, words=["--steps", 3])])
    verdict.claim(max(checkpoints(folder / "broken")) == 3, "the broken run has a checkpoint")
    shutil.copytree(folder / "broken", folder / "more-ranks")
    run(verdict, programs, folder, "broken", EXACT, words=["--steps", 6, "--restart"])
    same_file(verdict, "restart", folder / "broken" / "steps.csv", folder / "straight" / "steps.csv")
    run(verdict, programs, folder, "more-ranks", EXACT, 2, ["--steps", 6, "--restart"])
    same_steps(verdict, "restart on two ranks", folder / "more-ranks", folder / "straight")


def behind_the_vessel(case, path):
    """The case of a coupled problem with a windkessel at its outlet."""
    tree = ElementTree.parse(case)
    root = tree.getroot()
    mesh = entry(entry(root, "Mesh"), "file")
    mesh.set("value", str((case.parent / mesh.get("value")).resolve()))
    outlet = entry(entry(entry(root, "Fluid"), "Surfaces"), "outlet")
    for child in list(outlet):
        outlet.remove(child)
    values = {"proximal resistance": 0.3, "capacitance": 2.0, "distal resistance": 2.0,
              "initial pressure": 0.3, "backflow stabilisation": 0.2}
    ElementTree.SubElement(outlet, "Parameter", name="condition", type="string", value="windkessel")
    for name, value in values.items():
        ElementTree.SubElement(outlet, "Parameter", name=name, type="double", value=str(value))
    tree.write(path)
    return values


def check_coupled(verdict, programs, folder):
    values = behind_the_vessel(ROOT / "xml" / "pulse-tiny.xml", folder / "coupled.xml")
    for name, ranks, words in (("coupled", 1, ["--steps", 5]), ("again", 1, ["--steps", 3]),
                               ("again", 2, ["--steps", 5, "--restart"])):
        done = Run(command(programs / "tunica-fsi", ["coupled.xml", "--output", name, *words], ranks),
                   folder)
        if not verdict.claim(done.status == 0, f"{name}: ends with 0 ({done.seconds:.1f} s)"):
            print(done.out[-2000:] + done.err)
    steps = table(folder / "coupled" / "steps.csv")
    verdict.claim(max(steps["coupling_iterations"]) <= 20,
                  f"coupling iterations {[int(n) for n in steps['coupling_iterations']]}")
    expected = stored_pressures([-flow for flow in steps["inflow_outlet_mm3_per_ms"]], 0.125, "bdf2",
                                values["initial pressure"], values["capacitance"],
                                values["distal resistance"], 0.0)
    worst_error = max(abs(p - found) for p, found in zip(expected, steps["stored_pressure_outlet_kPa"]))
    largest = max(abs(value) for value in steps["pressure_outlet_kPa"])
    verdict.claim(largest > 1e-3 and worst_error < 1e-9 * largest,
                  f"the stored pressure is that of the flow to {worst_error:.1e} of {largest:.3f} kPa")
    same_steps(verdict, "coupled, restarted on two ranks", folder / "again", folder / "coupled")


def check_solvers(verdict, programs, folder):
    behind_the_vessel(ROOT / "xml" / "solvers-tiny.xml", folder / "solvers.xml")
    done = Run(command(programs / "tunica-solvers",
                       ["solvers.xml", "--output", "solvers", "--export", "systems",
                        "--set", "Solvers/field=fluid", "--set", "Solvers/newton step=1"]), folder)
    verdict.claim(done.status == 0, f"tunica-solvers: ends with 0 ({done.seconds:.1f} s)")
    rows = table(folder / "solvers" / "solvers.csv")
    solved = [d for d, text in zip(rows["difference"], rows["verdict"]) if text == "converged"]
    verdict.claim(len(solved) >= 3 and max(solved) < 1e-4,
                  f"{len(solved)} settings find the same solution, {max(solved):.1e} apart")
    system = folder / "systems" / "fluid-newton-1"
    state = json.loads((system / "state.json").read_text())
    verdict.claim("W VT" in state.get("low rank", ""), "the exported system tells of its part of low rank")
    sizes = [(system / f"{name}.mtx").read_text().split("\n") for name in ("W", "V", "rhs")]
    heads = [next(line for line in lines if not line.startswith("%")).split() for lines in sizes]
    verdict.claim(heads[0] == heads[1] == heads[2] and heads[0][1] == "1",
                  f"W and V have a column as long as the right-hand side: {heads}")


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    check_pressures(verdict, programs, folder)
    check_resistance(verdict, programs, folder)
    check_restart(verdict, programs, folder)
    check_coupled(verdict, programs, folder)
    check_solvers(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
