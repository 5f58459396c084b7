"""A run that begins with the fields of another one goes on as that did: on the same mesh, on a finer one, on two ranks,
after a restart; its windkessels begin with the pressures that were stored; and what is not there is named.

Usage: initial_state.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys
import xml.etree.ElementTree as xml

from runs import MONOLITHIC, ROOT, Run, Verdict, command, exactly_same_steps, fresh, table

PULSE, BIFURCATION = ROOT / "xml" / "pulse-tiny.xml", ROOT / "xml" / "vessels" / "bifurcation.xml"
# One step of it needs no more than the state before.
EULER = [*MONOLITHIC, *(word for field in ("Fluid", "Wall") for word in ("--set", f"{field}/time scheme=implicit euler"))]
UNLOADED = ["--set", "Fluid/Surfaces/inlet/traction={0, 0, 0}"]  # the pulse ends with step 8


def march(programs, folder, name, words, ranks=1):
    return Run(command(programs / "tunica-fsi", [*words, "--output", folder / name], ranks), folder)


def worst_difference(later, begun, first, columns=("fluid_kinetic_energy_kPa_mm3", "max_displacement_wall_mm")):
    """Of the rows of a run that began with another one's state after step `first`, in parts of each column's largest."""
    worst, where = 0.0, "none"
    for column in columns:
        expected, found = later[column][first:], begun[column]
        difference = max(abs(a - b) for a, b in zip(expected, found)) / max(abs(value) for value in later[column])
        if difference > worst:
            worst, where = difference, column
    return worst, where


def check_same_mesh(verdict, programs, folder):
    march(programs, folder, "whole", [PULSE, *EULER])
    start = ["--set", f"Time/initial state={folder / 'whole'}:1"]
    words = [PULSE, *EULER, *UNLOADED, "--steps", 8]
    begun = march(programs, folder, "begun", [*words, *start])
    verdict.claim(begun.status == 0 and "no node lies outside" in begun.out, f"it begins at 1 ms {begun.err}")
    march(programs, folder, "rest", words)
    later = table(folder / "whole" / "steps.csv")
    worst, where = worst_difference(later, table(folder / "begun" / "steps.csv"), 8)
    # Subscales, which are large on so coarse a mesh, begin anew: they are in no file of fields.
    verdict.claim(worst < 0.1, f"eight steps are those of the whole run to {worst:.1e} of the largest ({where})")
    rest, _ = worst_difference(later, table(folder / "rest" / "steps.csv"), 8)
    verdict.claim(rest > 0.3, f"from rest they are not: {rest:.1e}")
    two = march(programs, folder, "two", [*words, *start], 2)
    worst, where = worst_difference(table(folder / "begun" / "steps.csv"), table(folder / "two" / "steps.csv"), 0)
    verdict.claim(two.status == 0 and worst < 1e-5, f"on two ranks it is the same to {worst:.1e} ({where})")
    march(programs, folder, "part", [*words[:-1], 4, *start])
    on = march(programs, folder, "part", [*words, *start, "--restart"])
    verdict.claim(on.status == 0 and "initial state" not in on.out, "a restart takes its own state")
    exactly_same_steps(verdict, "restart", folder / "part", folder / "begun")


def check_finer_mesh(verdict, programs, folder):
    words = [PULSE, *EULER, *UNLOADED, "--steps", 4, "--set", f"Mesh/file={ROOT / 'meshes' / 'tube-coarse.h5'}",
             "--set", "Coupling/Linear Solver/method=gcr"]
    finer = march(programs, folder, "finer", [*words, "--set", f"Time/initial state={folder / 'whole'}:1"])
    verdict.claim(finer.status == 0, f"a finer mesh begins with a coarser one's fields {finer.err}")
    told = [line for line in finer.out.splitlines() if "lie outside of its mesh" in line]
    verdict.claim(len(told) == 2, f"and says of fluid and wall how far they lie outside: {told}")
    worst, where = worst_difference(table(folder / "whole" / "steps.csv"), table(folder / "finer" / "steps.csv"), 8)
    verdict.claim(worst < 0.25, f"its steps are those of the coarser mesh to {worst:.2f} of the largest ({where})")


def check_windkessels(verdict, programs, folder):
    march(programs, folder, "beat", [BIFURCATION, "--steps", 1])
    stored = {name: table(folder / "beat" / "steps.csv")[f"stored_pressure_{name}_kPa"][-1]
              for name in ("outlet_left", "outlet_right")}
    on = march(programs, folder, "on", [BIFURCATION, "--steps", 1, "--set", f"Time/initial state={folder / 'beat'}"])
    root = xml.parse(folder / "on" / "case.xml").getroot()
    for name, pressure in stored.items():
        given = root.find(f".//ParameterList[@name='{name}']/Parameter[@name='initial pressure']")
        verdict.claim(on.status == 0 and abs(float(given.get("value")) - pressure) < 1e-9 * pressure,
                      f"{name} begins with {pressure:.4f} kPa")
    row = table(folder / "on" / "steps.csv")
    last = table(folder / "beat" / "steps.csv")["stored_pressure_outlet_left_kPa"][-1]
    verdict.claim(abs(row["stored_pressure_outlet_left_kPa"][0] - last) < 0.02 * last, "and goes on from there")


def check_complaints(verdict, programs, folder):
    for start, sentence in ((f"{folder / 'whole'}:0.3", "no fields at 0.3 ms, but at 0.125, 0.25"),
                            (folder / "nowhere", "nowhere/fields.h5")):
        words = [PULSE, "--dry-run", "--set", f"Time/initial state={start}"]
        run = march(programs, folder, "none", words)
        verdict.claim(run.status == 1 and sentence in run.err and run.err.count("\n") == 1,
                      f"one sentence: {run.err.strip()}")


def main():
    programs, folder = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    verdict = Verdict()
    check_same_mesh(verdict, programs, folder)
    check_finer_mesh(verdict, programs, folder)
    check_windkessels(verdict, programs, folder)
    check_complaints(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
