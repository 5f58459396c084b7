"""1, 2 and 4 ranks make the same displacement history; on 2 ranks and more the direct solvers need
the repaired KLU2.

Usage: ranks_agree.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys
import xml.etree.ElementTree as xml

from runs import ROOT, Run, Verdict, command, fresh, table

TOLERANCE = 1e-6  # relative; the coupling stops at 1e-8 mm of some 1e-2 mm
STEPS = 2
PROBE = "wall_displacement_middle_mm"
COLUMNS = [PROBE, "max_displacement_wall_mm", "max_displacement_interface_mm",
           "max_speed_mm_per_ms", "inflow_inlet_mm3_per_ms", "fluid_volume_mm3", "elastic_energy_kPa_mm3"]


def sublist(parent, name):
    """The list of that name, made where it is missing."""
    found = parent.find(f"ParameterList[@name='{name}']")
    return xml.SubElement(parent, "ParameterList", name=name) if found is None else found


def put(parent, name, kind, value):
    for old in parent.findall(f"Parameter[@name='{name}']"):
        parent.remove(old)
    xml.SubElement(parent, "Parameter", name=name, type=kind, value=value)


def case():
    """xml/pulse-tiny.xml with direct solvers, a probe on the interface at half the tube's length,
    and the coupling solved further than usual so that round-off is all that may differ."""
    root = xml.parse(ROOT / "xml" / "pulse-tiny.xml").getroot()
    put(sublist(root, "Mesh"), "file", "string", str(ROOT / "meshes" / "tube-tiny.h5"))
    for field in ("Fluid", "Wall"):
        solver = sublist(sublist(root, field), "Linear Solver")
        for entry in list(solver):
            solver.remove(entry)
        put(solver, "method", "string", "direct")
    probe = sublist(sublist(root, "Probes"), "middle")
    put(probe, "quantity", "string", "wall displacement")
    put(probe, "position", "Array(double)", "{1.43, 0, 9}")
    put(sublist(root, "Coupling"), "tolerance", "double", "1e-11")
    return xml.tostring(root, encoding="unicode")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    (folder / "case.xml").write_text(case())
    histories = {}
    for ranks in (1, 2, 4):
        words = ["case.xml", "--steps", STEPS, "--output", f"ranks-{ranks}",
                 "--set", "Output/fields every=0"]
        run = Run(command(programs / "tunica-fsi", words, ranks), folder)
        if not verdict.claim(run.status == 0, f"{ranks} ranks end with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return verdict.status()
        histories[ranks] = table(folder / f"ranks-{ranks}" / "steps.csv")
    for ranks in (2, 4):
        for name in COLUMNS:
            one, many = histories[1][name], histories[ranks][name]
            scale = max(abs(value) for value in one)
            error = max(abs(a - b) for a, b in zip(one, many)) / scale
            verdict.claim(len(one) == len(many) == STEPS and scale > 0.0 and error < TOLERANCE,
                          f"{ranks} ranks: {name} differs by {error:.1e} of {scale:.3g}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
