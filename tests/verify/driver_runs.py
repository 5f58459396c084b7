"""Runs a case of xml/ as a user would and compares with exact values.

driver_runs.py inflation|inflation-artery|poiseuille DRIVER SOURCE_FOLDER SCRATCH_FOLDER
"""
import csv
import math
import os
import subprocess
import sys


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def run(case, driver, source, scratch):
    folder = os.path.join(scratch, case)
    case_file = os.path.join(source, "xml", case + ".xml")
    subprocess.run([driver, case_file, "--output", folder, "--overwrite"], check=True)
    return rows_of(os.path.join(folder, "steps.csv"))


def close(what, found, expected, tolerance):
    error = found / expected - 1.0
    print(f"{what}: {found:.6g}, exact {expected:.6g}, error {error:+.2e}, limit {tolerance:g}")
    return abs(error) < tolerance


def inflated(steps, source, law, pressures, tolerance):
    exact = {float(row["pressure_kPa"]): float(row["inner_radius_mm"])
             for row in rows_of(os.path.join(source, "tests/data/inflation.csv"))
             if row["law"] == law}
    results = [close(f"inner radius at {p} kPa",
                     1.43 + float(step["radial_displacement_inner_mm"]), exact[p], tolerance)
               for step, p in zip(steps, pressures) if p in exact]
    return len(steps) == len(pressures) and all(results)


def inflation(steps, source):
    return inflated(steps, source, "mooney-rivlin", [0.1, 0.2, 0.3, 0.4, 0.5], 2e-3)


def inflation_artery(steps, source):
    return inflated(steps, source, "two-layer-artery", [0.25, 0.5, 0.75, 1.0, 1.25, 1.5], 5e-3)


def poiseuille(steps, _):
    # The mesh overestimates the flow through open ends, see test_poiseuille.cpp.
    exact = math.pi * 1.43**4 * 1e-3 / (8 * 3.5e-3 * 18)
    flow = [float(row["inflow_inlet_mm3_per_ms"]) for row in steps]
    return (close("flow rate", flow[-1], exact, 0.15)
            and close("flow rate of the last step but one", flow[-2], flow[-1], 1e-3)
            and close("outflow", -float(steps[-1]["inflow_outlet_mm3_per_ms"]), flow[-1], 1e-6))


if __name__ == "__main__":
    name, program, root, results_folder = sys.argv[1:]
    check = {"inflation": inflation, "inflation-artery": inflation_artery, "poiseuille": poiseuille}[name]
    sys.exit(0 if check(run(name, program, root, results_folder), root) else 1)
