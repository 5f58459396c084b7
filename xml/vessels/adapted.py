"""What adaptation is worth: the wall shear stress of a steady flow through the rigid arch on meshes whose sizes follow the radius and
on those made anew of their errors: the runs and the table of `reproduce adapt`. Needs python3-gmsh, python3-vtk9, python3-h5py."""
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

import arch_beat
from flat_elements import make
from pages import BUILT, IS_INSTALLED, ROOT, command, commits_of, has_ended, record_of, table_text, write_commit

sys.path.append(os.path.join(BUILT, "bin") if IS_INSTALLED else os.path.join(ROOT, "drivers"))

MEAN = 83.3333  # ml/s, 5 l/min
# name -> options of tunica-mesh lumen, or the run of whose errors the mesh is made and options of tunica-mesh adapt
BY_RADIUS = {"coarse": arch_beat.MESHES["coarse"][0],
             "across-8": ["--across", "8", "--layers", "1", "--first", "0.2"],
             "layered": ["--across", "4", "--layers", "3", "--first", "0.08", "--growth", "1.8"],
             "reference": ["--across", "12", "--layers", "4", "--growth", "1.5"]}
ADAPTED = {"adapted": ("coarse", []), "adapted-again": ("adapted", []), "adapted-double": ("adapted", ["--factor", "2"])}
TEXTS = {"coarse": "by radius, as `arch.xml`", "across-8": "by radius, `--across 8`",
         "layered": "by radius, three layers chosen by hand", "adapted": "adapted to the run on the first",
         "adapted-again": "adapted to the run on that", "adapted-double": "the same, `--factor 2`",
         "reference": "by radius, the reference"}
REFERENCE = "reference"


# 1. The case: arch.xml with rigid walls and its mean flow.

def put(parent, name, kind, value):
    ElementTree.SubElement(parent, "Parameter", name=name, type=kind, value=str(value))


def resistance_of(surface):
    """Of a Windkessel in a steady flow."""
    return sum(float(surface.find(f"./Parameter[@name='{end} resistance']").get("value")) for end in ("proximal", "distal"))


def write_case(path):
    arch = ElementTree.parse(os.path.join(os.path.dirname(os.path.abspath(__file__)), "arch.xml")).getroot()
    case = ElementTree.Element("ParameterList", name="Case")
    lists = {name: ElementTree.SubElement(case, "ParameterList", name=name) for name in ("Mesh", "Time", "Fluid", "Output")}
    put(lists["Mesh"], "file", "string", "none.h5")
    put(lists["Time"], "step control", "string", "steady")
    put(lists["Time"], "step size", "double", 20)
    put(lists["Time"], "tolerance", "double", 1e-5)
    put(lists["Output"], "folder", "string", "results")
    old = arch.find("./ParameterList[@name='Fluid']")
    lists["Fluid"].extend(old.findall("./Parameter"))
    surfaces = ElementTree.SubElement(lists["Fluid"], "ParameterList", name="Surfaces")
    for surface in old.find("./ParameterList[@name='Surfaces']"):
        name = surface.get("name")
        new = ElementTree.SubElement(surfaces, "ParameterList", name="lumen_wall" if name == "interface" else name)
        kind = {"inlet": "flow rate", "interface": "no slip"}.get(name, "resistance")
        put(new, "condition", "string", kind)
        if kind == "flow rate":
            put(new, "flow rate", "double", MEAN)
            put(new, "profile", "string", "parabolic")
        elif kind == "resistance":
            put(new, "resistance", "double", resistance_of(surface))
    with open(path, "w", encoding="utf-8") as file:
        file.write(ElementTree.tostring(case, encoding="unicode") + "\n")


# 2. Meshes and runs.

def folder_of(wanted, name):
    return os.path.join(os.path.abspath(wanted.output), "adapt", name)


def mesh_of(wanted, name):
    path = os.path.join(os.path.abspath(wanted.output), "adapt", name + ".h5")
    if os.path.exists(path):
        return path
    tool = os.path.join(wanted.programs, "tunica-mesh")
    if name in BY_RADIUS:
        surface, openings = arch_beat.surface_of(wanted)
        make(tool, "lumen", surface, path, *BY_RADIUS[name], "--names", openings, "--overwrite")
    else:
        origin, options = ADAPTED[name]
        count = record_of(folder_of(wanted, "coarse"))["sizes"]["fluid tetrahedra"]
        make(tool, "adapt", folder_of(wanted, origin), path, "--tetrahedra", count, *options, "--overwrite")
    return path


def run_all(wanted):
    os.makedirs(os.path.join(wanted.output, "adapt"), exist_ok=True)
    case = os.path.join(os.path.abspath(wanted.output), "adapt", "steady.xml")
    write_case(case)
    for name in [*BY_RADIUS, *ADAPTED]:
        folder = folder_of(wanted, name)
        if has_ended(folder):
            continue
        start = [] if name == "coarse" else [f"Time/initial state={folder_of(wanted, 'coarse')}"]
        print(f"adapt: {name} ...", flush=True)
        make(*command(os.path.join(wanted.programs, "tunica-fluid"), [case, "--output", folder, "--overwrite"],
                      [f"Mesh/file={mesh_of(wanted, name)}", *start]))
        write_commit(folder)


# 3. The table.

class Shear:
    """The wall of a run and the shear stress there [kPa]."""

    def __init__(self, folder):
        from lumen.surface import areas
        from report.surfaces import boundary
        with h5py.File(os.path.join(folder, "fields.h5"), "r") as file:
            last = max((name for name in file if name.startswith("step_")), key=lambda name: int(name[5:]))
            self.points, tets = file["fluid/points"][:], file["fluid/tets"][:].astype(np.int64)
            self.stress = file[f"{last}/fluid/wall_shear_stress"][:]
        sides = boundary(self.points, tets)[0]
        on = (self.stress != 0.0).any(axis=1)
        self.triangles = sides[on[sides].all(axis=1)]
        self.area = np.bincount(self.triangles.reshape(-1), np.repeat(areas(self.points, self.triangles) / 3.0, 3), len(self.points))

    def at(self, points):
        """At the nearest places on this wall."""
        from lumen.surface import Surface
        from lumen.target import Target
        target = Target(Surface(self.points, self.triangles))
        places = target.nearest(points)
        return np.stack([target.interpolate(self.stress[:, k], *places) for k in range(3)], axis=1)


def error(found, reference):
    """Root of the integral of the square of the difference over the reference's wall, over that of the reference."""
    on = reference.area > 0.0
    area, exact = reference.area[on], reference.stress[on]
    apart = found.at(reference.points[on]) - exact
    return float(np.sqrt((area * (apart ** 2).sum(axis=1)).sum() / (area * (exact ** 2).sum(axis=1)).sum()))


def section(wanted):
    if not has_ended(folder_of(wanted, REFERENCE)):
        return []
    reference, rows, first = Shear(folder_of(wanted, REFERENCE)), [], None
    for name in TEXTS:
        folder = folder_of(wanted, name)
        if not has_ended(folder):
            continue
        sizes = record_of(folder)["sizes"]
        row = [TEXTS[name], f"{sizes['fluid tetrahedra']:,}", f"{sizes['fluid unknowns']:,}"]
        value = None if name == REFERENCE else error(Shear(folder), reference)
        first = first or value
        rows.append(row + (["–", "–"] if value is None else [f"{100 * value:.1f} %", f"{first / value:.2f}"]))
    commits = ", ".join(commits_of(os.path.join(wanted.output, "adapt")))
    return ["## Meshes made anew of their errors", "",
            "The arch of `arch.xml` with rigid walls and its mean flow of 5 l/min, steady (Re 1100 at the inlet): `tunica-mesh adapt` "
            "against `tunica-mesh lumen`, whose sizes follow the radius and the curvature. Error: of the wall shear stress, a vector, "
            "interpolated to the wall of the reference, root mean square over the area and over that of the stress itself. All meshes "
            f"are drawn to one surface. One rank; commit {commits}.", "",
            *table_text(["mesh", "tetrahedra", "unknowns", "error", "better by"], rows).splitlines(), ""]
