"""How far a beat is from that of shorter steps and of finer meshes: the runs and tables of `reproduce accuracy`. Needs
python3-gmsh, python3-vtk9 and python3-h5py."""
import os
import sys

import h5py
import numpy as np

from flat_elements import SCRIPTS, make
from pages import MODULES, columns_of, command, commits_of, has_ended, record_of, table_text, write_commit

sys.path.append(MODULES)

BEAT, BEATS_BEFORE = 800.0, 2  # ms
STEPS = (10.0, 5.0, 2.5, 1.0, 0.5, 0.1)  # ms, on the mesh that ships
OF_MESHES = 5.0  # ms, the step on other meshes
# elements across the lumen -> through media and adventitia
MESHES = {6: (2, 1), 9: (3, 2), 13: (4, 2), 18: (6, 3)}
OPENINGS = {"inlet": (0, 0, 0), "outlet_left": (-4.02, 0, 12.73), "outlet_right": (4.02, 0, 12.73)}  # centres [mm]
SAMPLED = 20.0  # ms, between the fields that are compared
# quantity -> permitted error [%], by which the defaults are chosen
BOUNDS = {"displacement": 2, "flow": 2, "pressure": 2, "WSS": 5, "TAWSS": 5, "stress": 10}


# 1. Meshes: one smooth surface, filled with more and more elements.

def write_surface(path, mesh):
    """The lumen's surface as binary STL."""
    with h5py.File(mesh, "r") as file:
        corners = file["vertices"][:][file["triangles"][:]].astype("<f4")
    record = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    record["corners"] = corners
    with open(path, "wb") as file:
        file.write(b"bifurcation".ljust(80) + np.uint32(len(corners)).tobytes() + record.tobytes())


def surface_of(folder, tool):
    path = os.path.join(folder, "bifurcation.stl")
    if not os.path.exists(path):
        lumen, mesh = (os.path.join(folder, "bifurcation-fine" + end) for end in (".msh", ".h5"))
        make("/usr/bin/python3", os.path.join(SCRIPTS, "make_bifurcation.py"), lumen, 0.2)
        make(tool, "convert", lumen, mesh, "--overwrite", "on")
        write_surface(path, mesh)
    return path


def mesh_of(wanted, across):
    folder = os.path.join(os.path.abspath(wanted.output), "meshes")
    path = os.path.join(folder, f"bifurcation-{across}.h5")
    if os.path.exists(path):
        return path
    os.makedirs(folder, exist_ok=True)
    tool, lumen, names = (os.path.join(wanted.programs, "tunica-mesh"), os.path.join(folder, f"lumen-{across}.h5"),
                          os.path.join(folder, "openings.csv"))
    with open(names, "w", encoding="utf-8") as file:
        file.writelines(f"{name},{x},{y},{z}\n" for name, (x, y, z) in OPENINGS.items())
    make(tool, "lumen", surface_of(folder, tool), lumen, "--across", across, "--names", names, "--overwrite")
    media, adventitia = MESHES[across]
    make(tool, "wall", lumen, path, "--surfaces", "lumen_wall", "--layers", f"media=0.3:{media},adventitia=0.15:{adventitia}")
    return path


# 2. Runs: two beats, and from their end a third one whose fields are kept.

def run(wanted, name, settings):
    folder = os.path.join(wanted.output, "accuracy", name)
    if has_ended(folder):
        return folder
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    print(f"{name} ...", flush=True)
    make(*command(os.path.join(wanted.programs, "tunica-fsi"),
                  [os.path.join(os.path.dirname(__file__), "bifurcation.xml"), "--output", folder, "--overwrite"], settings))
    write_commit(folder)
    return folder


def run_beat(wanted, name, step, before, settings):
    run(wanted, name, [f"Time/step size={step}", f"Time/steps={round(BEAT / step)}", f"Time/initial state={os.path.abspath(before)}",
                       f"Output/fields every={round(SAMPLED / step)}", *settings])


def run_before(wanted, name, settings):
    """Beats in steps of 5 ms, whose end is where those that are compared begin."""
    steps = round(BEATS_BEFORE * BEAT / 5)
    return run(wanted, name, ["Time/step size=5", f"Time/steps={steps}", f"Output/fields every={steps}", *settings])


def run_all(wanted):
    start = run_before(wanted, "before", [])
    for step in STEPS:
        run_beat(wanted, f"step-{step:g}", step, start, [])
    for across in MESHES:
        mesh = [f"Mesh/file={mesh_of(wanted, across)}"]
        run_beat(wanted, f"across-{across}", OF_MESHES, run_before(wanted, f"before-{across}", mesh), mesh)


# 3. What is compared.

def histories(folder):
    """Quantity -> histories of steps.csv at the times that all runs have."""
    columns = columns_of(folder)
    keep = [i for i, time in enumerate(columns["time"]) if abs(time / SAMPLED - round(time / SAMPLED)) < 1e-6]
    pick = lambda names: np.array([[columns[name][i] for i in keep] for name in names])  # noqa: E731
    outflows = [name for name in columns if name.startswith("inflow_outlet")]
    return {"displacement": pick(["max_displacement_wall_mm"]), "pressure": pick(["mean_pressure_inlet_kPa"]), "flow": pick(outflows),
            "WSS": pick(["max_wall_shear_stress_kPa"])}


def scalars(folder):
    """Quantity -> number of the beat: the mean of the TAWSS over the lumen's wall [Pa], the greatest 99 % quantile of the
    stress in a layer [kPa]."""
    from report import wall_stress
    from report.run_data import Run
    found = Run(folder)
    peaks, _ = wall_stress.tables(found, found.outputs)
    return {"TAWSS": mean_tawss(found), "stress": max(row[2] for row in peaks if row[1].startswith("largest principal"))}


def mean_tawss(found):
    """Mean of the time-averaged wall shear stress over the nodes of the wall [Pa]."""
    values = 1e3 * np.asarray(found.field(found.outputs[-1][1], "fluid", "time_averaged_wss")).reshape(-1)
    return float(values[values > 0].mean())


def errors(folder, reference):
    """Quantity -> distance from the reference [%]: of histories the largest over the largest value."""
    one, best = histories(folder), histories(reference)
    found = {name: 100 * abs(one[name] - best[name]).max() / abs(best[name]).max() for name in one}
    here, there = scalars(folder), scalars(reference)
    found.update({name: 100 * abs(here[name] / there[name] - 1) for name in here})
    return {name: found[name] for name in BOUNDS}


def cells(found):
    return [f"{value:.2g}" + ("" if value <= BOUNDS[name] else " (!)") for name, value in found.items()]


def done_in(wanted, names):
    """Name -> folder of the runs that have ended."""
    folders = {name: os.path.join(wanted.output, "accuracy", name) for name in names}
    return {name: folder for name, folder in folders.items() if has_ended(folder)}


def step_rows(wanted):
    *runs, reference = list(done_in(wanted, [f"step-{step:g}" for step in STEPS]).items()) or [None]
    rows = [[name.split("-")[1], *cells(errors(folder, reference[1]))] for name, folder in runs]
    return rows + [[reference[0].split("-")[1], *["–"] * len(BOUNDS)]] if rows else []


def mesh_rows(wanted):
    *runs, reference = list(done_in(wanted, [f"across-{across}" for across in MESHES]).items()) or [None]
    rows = []
    for name, folder in [*runs, reference] if runs else []:
        across, sizes = name.split("-")[1], record_of(folder)["sizes"]
        media, adventitia = MESHES[int(across)]
        rows.append([across, f"{media} + {adventitia}", f"{sizes['fluid tetrahedra']:,} + {sizes['wall tetrahedra']:,}",
                     *(["–"] * len(BOUNDS) if folder == reference[1] else cells(errors(folder, reference[1])))])
    return rows


def section(wanted):
    steps, meshes = step_rows(wanted), mesh_rows(wanted)
    if not steps and not meshes:
        return []
    head = [f"{name} [%]" for name in BOUNDS]
    commits = ", ".join(commits_of(os.path.join(wanted.output, "accuracy")))
    lines = ["## Steps and meshes of a beat", "",
             f"How far the third beat of `bifurcation.xml` is from that of the last row; commit {commits}. Displacement (its largest), "
             "flow (through the outlets), pressure (at the inlet) and WSS (the largest on the wall): the largest difference within the "
             "beat over the largest value. TAWSS: its mean over the wall. Stress: the greatest 99 % quantile of the largest principal "
             "stress in a layer. (!) marks what exceeds " + ", ".join(f"{bound} % in {name}" for name, bound in BOUNDS.items()) +
             ". The two beats before are in steps of 5 ms.", ""]
    if steps:
        lines += ["Steps, on the mesh that ships:", "", *table_text(["step [ms]", *head], steps).splitlines(), ""]
    if meshes:
        lines += [f"Meshes of one smooth surface by `tunica-mesh lumen --across`, in steps of {OF_MESHES:g} ms:", "",
                  *table_text(["across", "through the wall", "tetrahedra", *head], meshes).splitlines(), ""]
    return lines
