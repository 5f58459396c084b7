"""The shipped arch on its coarse mesh, a beat in long steps: it begins in the beat that repeats itself, has the pressures that
its Windkessels were tuned for, and its mean pressures and flows are those that their resistances alone give.

Usage: arch.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

from runs import ROOT, Run, Verdict, command, fresh, table

CASE = ROOT / "xml" / "vessels" / "arch.xml"
STEPS, STEP = 40, 20.0  # ms
MMHG = 0.133322  # kPa


def resistances():
    """Outlet -> whole resistance [kPa ms/mm^3]."""
    found = {}
    for surface in ElementTree.parse(CASE).getroot().iter("ParameterList"):
        keys = {entry.get("name"): entry.get("value") for entry in surface.findall("Parameter")}
        if keys.get("condition") == "windkessel":
            found[surface.get("name")] = float(keys["proximal resistance"]) + float(keys["distal resistance"])
    return found


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    run = Run(command(programs / "tunica-fsi", [CASE, "--output", folder / "results", "--steps", STEPS, "--set", f"Time/step size={STEP}",
                                                "--set", "Output/fields every=0"]), folder)
    if not verdict.claim(run.status == 0, "a beat is computed"):
        print(run.out[-800:], run.err[-800:])
        return verdict.status()
    columns, whole = table(folder / "results" / "steps.csv"), resistances()
    mean = {name: sum(values) / STEPS for name, values in columns.items()}
    pressure = columns["mean_pressure_inlet_kPa"]

    def close(text, value, wanted, part):
        verdict.claim(abs(value / wanted - 1) < part, f"{text}: {value:.4g} for {wanted:.4g}, within {100 * part:g} %")

    close("systolic pressure [kPa]", max(pressure), 120 * MMHG, 0.05)
    close("diastolic pressure [kPa]", min(pressure), 80 * MMHG, 0.05)
    conductance, inflow = sum(1 / r for r in whole.values()), mean["inflow_inlet_mm3_per_ms"]
    outflow = {name: -mean[f"inflow_{name}_mm3_per_ms"] for name in whole}
    close("blood that leaves [ml/s]", sum(outflow.values()), inflow, 0.02)
    for name, r in whole.items():
        close(f"share of {name}", outflow[name] / sum(outflow.values()), 1 / r / conductance, 0.02)
        close(f"mean pressure of {name} [kPa]", mean[f"pressure_{name}_kPa"], inflow / conductance, 0.03)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
