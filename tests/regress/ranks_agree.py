"""1 and 4 ranks, at night others, too, make the same history, whoever cuts the mesh, in every physical column of steps.csv,
components of a vector relative to all of it; on 2 ranks and more the fields' direct solvers need the repaired
KLU2.

Usage: ranks_agree.py FOLDER_OF_PROGRAMS SCRATCH [CASE [SCHEME]] [--long]
CASE: pulse-tiny, artery-tiny; SCHEME: dirichlet-neumann, monolithic
"""
import pathlib
import sys
import xml.etree.ElementTree as xml

from runs import EFFORT, LONG, ROOT, Run, Verdict, command, fresh, table

# Relative. Fixed-point iterations magnify what their solvers leave, Newton's method does not.
TOLERANCE = {"dirichlet-neumann": 1e-6, "monolithic": 1e-9}
RANKS = {"dirichlet-neumann": (1, 2, 4) if LONG else (1, 4), "monolithic": (1, 2, 4, 8) if LONG else (1, 2, 8)}
# By number of ranks; each gives parts of its own.
PARTITIONER = {1: "automatic", 2: "metis", 4: "geometric", 8: "metis"}
STEPS = {"pulse-tiny": 2 if LONG else 1, "artery-tiny": 1}
# How the solution was found may differ, and what is zero but for round-off has no relative size.
NOT_COMPARED = {"step", "time", "step_size", "rejected", "error_estimate", *EFFORT}


def sublist(parent, name):
    """The list of that name, made where it is missing."""
    found = parent.find(f"ParameterList[@name='{name}']")
    return xml.SubElement(parent, "ParameterList", name=name) if found is None else found


def put(parent, name, kind, value):
    for old in parent.findall(f"Parameter[@name='{name}']"):
        parent.remove(old)
    xml.SubElement(parent, "Parameter", name=name, type=kind, value=value)


def case(name, scheme):
    """A case of xml/ with direct solvers of the fields and the default one of both, a probe on the
    interface at half the tube's length, and the coupling solved further than usual so that
    round-off is all that may differ."""
    root = xml.parse(ROOT / "xml" / f"{name}.xml").getroot()
    put(sublist(root, "Mesh"), "file", "string", str(ROOT / "meshes" / "tube-tiny.h5"))
    for field in ("Fluid", "Wall"):
        solver = sublist(sublist(root, field), "Linear Solver")
        for entry in list(solver):
            solver.remove(entry)
        put(solver, "method", "string", "direct")
    probe = sublist(sublist(root, "Probes"), "middle")
    put(probe, "quantity", "string", "wall displacement")
    put(probe, "position", "Array(double)", "{1.43, 0, 9}")
    coupling = sublist(root, "Coupling")
    put(coupling, "scheme", "string", scheme)
    if scheme == "monolithic":
        put(sublist(coupling, "Newton"), "absolute increment", "double", "1e-13")
        put(sublist(coupling, "Newton"), "linear tolerance", "double", "1e-10")
        put(coupling, "mesh tolerance", "double", "1e-13")
    else:
        put(coupling, "tolerance", "double", "1e-11")
    return xml.tostring(root, encoding="unicode")


def vector_of(column):
    """That of which the column is a component, or the column itself."""
    words = column.split("_")
    return words[:-2] + words[-1:] if words[-2] in ("x", "y", "z") else words


def main(programs, scratch, name="pulse-tiny", scheme="dirichlet-neumann"):
    verdict = Verdict()
    folder = fresh(scratch)
    (folder / "case.xml").write_text(case(name, scheme))
    histories = {}
    for ranks in RANKS[scheme]:
        words = ["case.xml", "--steps", STEPS[name], "--output", f"ranks-{ranks}",
                 "--set", "Output/fields every=0",
                 "--set", f"Mesh/partitioner={PARTITIONER[ranks]}"]
        run = Run(command(programs / "tunica-fsi", words, ranks), folder)
        if not verdict.claim(run.status == 0, f"{ranks} ranks end with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return verdict.status()
        histories[ranks] = table(folder / f"ranks-{ranks}" / "steps.csv")
    physical = [column for column in histories[1] if column not in NOT_COMPARED]
    verdict.claim(len(physical) > 20, f"{len(physical)} physical columns")
    for ranks in RANKS[scheme][1:]:
        for column in physical:
            one, many = histories[1][column], histories[ranks][column]
            scale = max(abs(value) for other in physical if vector_of(other) == vector_of(column)
                        for value in histories[1][other])
            # Nothing, beside a load of 1 kPa: the pulse has not come to the outlet yet.
            scale = max(scale, 1e-6)
            error = max(abs(a - b) for a, b in zip(one, many)) / scale
            verdict.claim(len(one) == len(many) == STEPS[name] and error < TOLERANCE[scheme],
                          f"{ranks} ranks: {column} differs by {error:.1e} of {scale:.3g}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]),
                  *sys.argv[3:]))
