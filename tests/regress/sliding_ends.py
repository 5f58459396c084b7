"""Ends of a wall that slide in their planes: a tube that lies across the axes and is held along the normals of
its ends behaves as the same tube along an axis, whose ends are held by components; monolithic, partitioned,
prestressed and on two ranks. Its ends stay in their planes, and move in them.

Usage: sliding_ends.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import shutil
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

from runs import LONG, ROOT, Run, Verdict, command, fresh, table

STEPS = 3 if LONG else 2
ENDS = ("struct_in", "struct_out")
# Columns that do not know how the tube lies.
COLUMNS = ("max_displacement_wall_mm", "max_speed_mm_per_ms", "fluid_pressure_max_kPa", "fluid_pressure_min_kPa",
           "wall_pressure_max_kPa", "wall_pressure_min_kPa", "elastic_energy_kPa_mm3", "inflow_inlet_mm3_per_ms",
           "fluid_volume_mm3", "max_det_F", "min_det_F")
# Orthogonal, of determinant 1; its last column is where the axis of the tube points.
ROTATION = np.array([[2.0, 1.0, 2.0], [-2.0, 2.0, 1.0], [-1.0, -2.0, 2.0]]) / 3.0
LOADS = {"plain": (0.0, 1.332), "prestressed": (0.3, 0.5)}  # prestress, pressure at the inlet [kPa]


def parameter(parent, name, kind, value):
    for old in parent.findall(f"Parameter[@name='{name}']"):
        parent.remove(old)
    ElementTree.SubElement(parent, "Parameter", name=name, type=kind, value=value)


def sublist(root, *names):
    for name in names:
        found = root.find(f"ParameterList[@name='{name}']")
        root = found if found is not None else ElementTree.SubElement(root, "ParameterList", name=name)
    return root


def write_case(path, mesh, components, load):
    """The pulse with pressures, which turn with the tube, in place of tractions."""
    root = ElementTree.parse(ROOT / "xml" / "pulse-tiny.xml").getroot()
    parameter(sublist(root, "Mesh"), "file", "string", str(mesh))
    prestress, at_inlet = LOADS[load]
    for end, pressure in (("inlet", at_inlet), ("outlet", prestress)):
        surface = sublist(root, "Fluid", "Surfaces", end)
        for child in list(surface):
            surface.remove(child)
        parameter(surface, "condition", "string", "pressure")
        parameter(surface, "pressure", "double", str(pressure))
        parameter(surface, "backflow stabilisation", "double", "0.2")
    for end in ENDS:
        surface = sublist(root, "Wall", "Surfaces", end)
        parameter(surface, "condition", "string", "held")
        parameter(surface, "components", "Array(string)", components)
    if prestress:
        parameter(sublist(root, "Wall", "Prestress"), "pressure", "double", str(prestress))
        # Something must hold the tube across its axis while its shape without stress is sought.
        support = sublist(root, "Wall", "Surfaces", "outer")
        parameter(support, "condition", "string", "support")
        parameter(support, "stiffness", "double", "0.5")
    ElementTree.ElementTree(root).write(path)


def turned(mesh, target):
    shutil.copy(mesh, target)
    with h5py.File(target, "r+") as file:
        file["vertices"][:] = file["vertices"][:] @ ROTATION.T


def run(verdict, programs, folder, name, case, more, ranks=1):
    words = [case, "--output", name, "--steps", STEPS]
    for setting in more + ["Coupling/Newton/absolute increment=1e-11"] * ("Coupling/scheme=monolithic" in more):
        words += ["--set", setting]
    done = Run(command(programs / "tunica-fsi", words, ranks), folder)
    verdict.claim(done.status == 0, f"{name}: ends with 0 ({done.seconds:.1f} s) {done.err.strip()[-300:]}")
    return table(folder / name / "steps.csv") if done.status == 0 else None


def compare(verdict, name, found, expected, tolerance):
    if found is None or expected is None:
        return
    for column in COLUMNS:
        off = max(abs(a - b) for a, b in zip(found[column], expected[column])) / max(map(abs, expected[column]))
        verdict.claim(off < tolerance, f"{name}: {column} differs by {off:.1e}")


def look_at_ends(verdict, folder, name):
    axis = ROTATION[:, 2]
    with h5py.File(folder / name / "fields.h5") as file:
        wall, step = file["wall"], file[f"step_{STEPS:06d}/wall"]
        along = wall["points"][:] @ axis
        d = step["displacement"][:]
        for end, place in zip(ENDS, (along.min(), along.max())):
            at = np.abs(along - place) < 1e-9
            normal, size = np.abs(d[at] @ axis).max(), np.abs(d).max()
            # An iterative solver knows the plane as well as it solves; each step begins in it again.
            verdict.claim(normal < 1e-7 * size, f"{name}: {end} leaves its plane by {normal:.1e} mm")
            if end == "struct_in":
                verdict.claim(np.abs(d[at]).max() > 0.05 * size, f"{name}: {end} moves in it by {np.abs(d[at]).max():.1e} mm")


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    straight = ROOT / "meshes" / "tube-tiny.h5"
    across = folder / "across.h5"
    turned(straight, across)
    for load in LOADS:
        write_case(folder / f"straight-{load}.xml", straight, "{z}", load)
        write_case(folder / f"across-{load}.xml", across, "{normal}", load)
    for load, scheme, more, tolerance in (
            ("plain", "monolithic", ["Coupling/scheme=monolithic"], 1e-7),
            ("plain", "newton", ["Coupling/scheme=monolithic", "Coupling/geometry=newton",
                                 "Coupling/Newton/jacobian cost=0"], 1e-7),
            ("plain", "partitioned", ["Coupling/tolerance=1e-10"], 1e-6),
            ("plain", "elastic", ["Coupling/scheme=monolithic", "Mesh Motion/law=elastic", "Mesh Motion/stiffening=1",
                                  "Mesh Motion/poisson ratio=0.2"], 1e-7),
            ("prestressed", "monolithic", ["Coupling/scheme=monolithic"], 1e-6)):
        name = f"{load}-{scheme}"
        expected = run(verdict, programs, folder, f"straight-{name}", f"straight-{load}.xml", more)
        found = run(verdict, programs, folder, f"across-{name}", f"across-{load}.xml", more)
        compare(verdict, name, found, expected, tolerance)
        if name == "plain-newton" and found is not None and expected is not None:
            counts = [steps["system_newton"] for steps in (found, expected)]
            verdict.claim(counts[0] == counts[1] and max(counts[0]) <= 5,
                          f"{name}: {counts[0]} steps of Newton's method, along an axis {counts[1]}")
        if found is not None:
            look_at_ends(verdict, folder, f"across-{name}")
        if name == "plain-monolithic":
            ranks = run(verdict, programs, folder, "across-ranks", "across-plain.xml", more, 2)
            compare(verdict, "2 ranks", ranks, found, 1e-8)

    done = Run(command(programs / "tunica-fsi",
                       ["across-plain.xml", "--output", "bent", "--set", "Wall/Surfaces/outer/condition=held",
                        "--set", "Wall/Surfaces/outer/components={normal}"]), folder)
    verdict.claim(done.status == 1 and "is not a plane" in done.err, f"a surface that is bent: {done.err.strip()}")
    mixed = Run(command(programs / "tunica-check",
                        ["across-plain.xml", "--set", "Wall/Surfaces/struct_in/components={normal, x}"]), folder)
    verdict.claim(mixed.status == 1 and "alone" in mixed.err, f"the normal beside a component: {mixed.err.strip()}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
