"""Solvers on flat elements: the meshes, the runs and the table of `reproduce solvers`. Needs python3-h5py, and for the
arch and the carotid python3-gmsh."""
import json
import os
import signal
import subprocess
import time

import h5py
import numpy as np

from pages import ENVIRONMENT, ROOT, command, commits_of, keep_results, record_of, rows_of, table_text, write_commit

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(ROOT, "meshes")
WIDTH, RADIUS, LENGTH = 1.0, 7.64, 90  # mm, of a tube: 48 triangles around
EXACT = ["Coupling/Newton/linear tolerance=1e-8"]
STEPS = {"wall": None, "coupled": 2, "march": 3}  # None: as the case says

# ratio -> options of tunica-mesh tube: the outer layer is thin, the inner one twice as thick.
TUBES = {ratio: ["--radius", str(RADIUS), "--length", str(LENGTH), "--around", "48", "--axial", str(LENGTH), "--media",
                 f"{2 * WIDTH / ratio:.4g}", "--adventitia", f"{WIDTH / ratio:.4g}", "--media-layers", "1", "--adventitia-layers", "1"]
         for ratio in (2, 6, 12, 25)}
# name -> shape, size [mm], share of the radius, elements through media and adventitia, thickness [mm] of two layers in the lumen
VESSELS = {"arch": ("arch", 1.7, 0.15, (1, 1), None), "arch-thin": ("arch", 1.7, 0.08, (1, 1), None),
           "arch-0.1": ("arch", 1.7, 0.1, (1, 1), None), "carotid": ("carotid", 0.62, 0.2, (2, 1), None),
           "carotid-0.1": ("carotid", 0.62, 0.1, (2, 1), None), "carotid-0.15": ("carotid", 0.62, 0.15, (2, 1), None),
           "carotid-deep": ("carotid", 1.0, 0.2, (3, 3), None), "carotid-layer": ("carotid", 0.8, 0.2, (1, 1), 0.03)}
# row -> case, mesh, text
ROWS = {
    "arch-wall": ("arch-wall", "arch", "arch, wall of 1 + 1 elements"),
    "arch-thin-wall": ("arch-wall", "arch-thin", "arch, thin wall of 1 + 1 elements"),
    "carotid-wall": ("carotid-wall", "carotid", "carotid, wall of 2 + 1 elements"),
    "carotid-deep-wall": ("carotid-wall", "carotid-deep", "carotid, wall of 3 + 3 elements"),
    **{f"tube-{ratio}-wall": ("tube-wall", f"tube-{ratio}", f"tube of {ratio} : 1, wall") for ratio in TUBES},
    "bend-25-wall": ("tube-wall", "bend-25", "tube of 25 : 1, bent by 120°, wall"),
    "arch-coupled": ("arch-coupled", "arch", "arch, coupled"),
    "carotid-coupled": ("carotid-coupled", "carotid", "carotid, coupled"),
    "carotid-layer-coupled": ("carotid-coupled", "carotid-layer", "carotid, coupled, flat layers in the lumen"),
    **{f"tube-{ratio}-coupled": ("tube-coupled", f"tube-{ratio}", f"tube of {ratio} : 1, coupled") for ratio in TUBES},
    "arch-march": ("arch-coupled", "arch", "arch, coupled, as by default"),
    "carotid-march": ("carotid-coupled", "carotid", "carotid, coupled, as by default"),
}


def kind_of(row):
    return row.rsplit("-", 1)[1]


# 1. Meshes.

def make(*words):
    """Runs a program that says on its own what is wrong."""
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=ENVIRONMENT, check=False)
    if done.returncode != 0:
        raise SystemExit(f"reproduce: {' '.join(map(str, words))} ends with {done.returncode}: {done.stdout.strip()}")


def make_vessel(tool, folder, name):
    """A lumen, layers in it where they are asked for, and the wall."""
    shape, size, share, (media, adventitia), layer = VESSELS[name]
    lumen = os.path.join(folder, f"{name}-lumen.msh")
    make(os.path.join(SCRIPTS, "make_vessel.py"), shape, lumen, "--size", size)
    if layer:
        grown, layered = (os.path.join(folder, f"{name}-{step}.h5") for step in ("grown", "layered"))
        make(tool, "wall", lumen, grown, "--layers", f"inner={layer}:1,next={layer}:1", "--overwrite", "on")
        if os.path.exists(layered):
            os.remove(layered)
        make(os.path.join(SCRIPTS, "join_layer.py"), grown, layered)
        lumen = layered
    make(tool, "wall", lumen, os.path.join(folder, name + ".h5"), "--layers", f"media=0.66:{media},adventitia=0.34:{adventitia}",
         "--thickness-fraction", share)


def mesh_of(wanted, name):
    """The file of a mesh, made where it is missing."""
    folder = os.path.join(os.path.abspath(wanted.output), "meshes")  # a case has it in another folder
    path = os.path.join(folder, name + ".h5")
    if os.path.exists(path):
        return path
    os.makedirs(folder, exist_ok=True)
    tool = os.path.join(wanted.programs, "tunica-mesh")
    kind, _, ratio = name.partition("-")
    if name in VESSELS:
        make_vessel(tool, folder, name)
    elif kind == "bend":
        make(os.path.join(SCRIPTS, "bend_tube.py"), mesh_of(wanted, f"tube-{ratio}"), path)
    else:
        make(tool, "tube", path, *TUBES[int(ratio)])
    return path


def least_angle(x):
    """Between two faces of tetrahedra with the corners x (n, 4, 3), degrees."""
    least = 180.0
    for a, b, c, d in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)):
        edge = x[:, b] - x[:, a]
        normals = [np.cross(edge, x[:, k] - x[:, a]) for k in (c, d)]
        cosine = np.einsum("ij,ij->i", *normals) / np.prod([np.linalg.norm(n, axis=1) for n in normals], axis=0)
        least = min(least, float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).min()))
    return least


def flatness(vertices, tets, triangles):
    """Width over height of the tetrahedra on triangles: root of twice a triangle's area, over the height of the corner
    that is not in it. In a layer of prisms that is its triangles' width over its thickness."""
    wanted = {tuple(sorted(triangle)): k for k, triangle in enumerate(triangles.tolist())}
    is_near = np.isin(tets, triangles).sum(axis=1) >= 3
    ratios = []
    for tet in tets[is_near].tolist():
        for apex in tet:
            face = tuple(sorted(set(tet) - {apex}))
            if face in wanted:
                a, b, c = vertices[list(face)]
                normal = np.cross(b - a, c - a)
                twice_area = np.linalg.norm(normal)
                ratios.append(twice_area ** 1.5 / abs(normal @ (vertices[apex] - a)))
    return float(np.mean(ratios))


def shape_of(path, kind):
    """Greatest of the flatness at the sides of the wall's layers and of the lumen, tetrahedra, least angle; of what is solved
    for."""
    with h5py.File(path, "r") as file:
        vertices, tets, triangles = (file[name][:] for name in ("vertices", "tets", "triangles"))
        region, surface = file["tet_region"][:], file["triangle_surface"][:]
        regions, surfaces = ([name.decode() for name in file[kind + "_names"][:]] for kind in ("region", "surface"))
    solved = [name for name in regions if kind != "wall" or name != "fluid"]
    ratios = []
    for name in solved:
        for side in {"fluid": ["interface"], "media": ["interface"], "adventitia": ["outer"]}[name]:
            ratios.append(flatness(vertices, tets[region == regions.index(name)], triangles[surface == surfaces.index(side)]))
    tets = tets[np.isin(region, [regions.index(name) for name in solved])]
    return {"tetrahedra": len(tets), "flatness": max(ratios), "angle": least_angle(vertices[tets])}


# 2. Runs.

def runs_of(wanted):
    return [(row, ranks) for row in wanted.rows for ranks in wanted.ranks]


def folder_of(wanted, row, ranks, label=None):
    return os.path.join(wanted.output, "solvers", label or wanted.label, f"{row}-{ranks}")


def effort_of(folder):
    """What was written when a run was over, whichever way; nothing before."""
    try:
        with open(folder + ".json", encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def write_effort(folder, status, seconds, **more):
    with open(folder + ".json", "w", encoding="utf-8") as file:
        json.dump({"status": status, "cpu seconds": seconds, **more}, file)


def timed(words, log, most_seconds):
    """Exit status, or None where it was stopped after most_seconds, and seconds of all its processors."""
    process = subprocess.Popen(words, stdout=log, stderr=log, env=ENVIRONMENT, start_new_session=True)
    deadline = time.monotonic() + most_seconds
    is_stopped = False
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return None if is_stopped else process.returncode, usage.ru_utime + usage.ru_stime
        if time.monotonic() > deadline + (15 if is_stopped else 0):
            os.killpg(process.pid, signal.SIGKILL if is_stopped else signal.SIGTERM)
            is_stopped = True
        time.sleep(0.1)


def run(wanted, row, ranks):
    folder = folder_of(wanted, row, ranks)
    if effort_of(folder):
        return
    keep_results(folder, wanted.overwrite)
    case, mesh, _ = ROWS[row]
    kind = kind_of(row)
    mesh = mesh_of(wanted, mesh)
    shape = shape_of(mesh, kind)
    words = [os.path.join(HERE, "solvers", case + ".xml"), "--output", folder, "--overwrite"]
    words += ["--steps", str(STEPS[kind])] if STEPS[kind] else []
    program = os.path.join(wanted.programs, "tunica-solid" if kind == "wall" else "tunica-fsi")
    words = command(program, words, [f"Mesh/file={mesh}"] + (EXACT if kind == "coupled" else []) + wanted.set, ranks)
    print(f"{row}, ranks: {ranks} ...", end=" ", flush=True)
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    with open(folder + ".log", "w", encoding="utf-8") as log:
        status, seconds = timed(words, log, wanted.most_seconds)
    write_commit(folder)
    if status not in (0, 2, 4, None):  # bad input or a fault: no figures
        raise SystemExit(f"reproduce: {row} ends with {status}, see {log.name}")
    write_effort(folder, status, seconds, **shape)
    print(f"{seconds:.0f} s, {iterations_of(folder)}" + ("" if status == 0 else f"; ends with {status}, see {log.name}"), flush=True)


# 3. The table.

def iterations_of(folder):
    """Of each Newton step; those of time steps apart, and a star where the solver did not get there."""
    steps = {}
    for row in rows_of(os.path.join(folder, "linear.csv")):
        if row["field"] in ("wall", "system"):
            steps.setdefault((row["step"], row["attempt"]), []).append(row["iterations"] + ("" if row["converged"] == "1" else "*"))
    return " / ".join(" ".join(step) for step in steps.values()) or "none"


def newton_of(folder):
    rows = [row for row in rows_of(os.path.join(folder, "linear.csv")) if row["field"] in ("wall", "system")]
    steps = {(row["step"], row["attempt"]) for row in rows}
    return f"{len(rows) / len(steps):.1f}" if steps else "–"


def cells_of(folder):
    effort = effort_of(folder)
    if not effort:
        return ["–"] * 3
    ending = {0: "", 2: "fails, ", 4: "unconverged, ", None: "stopped, "}[effort["status"]]
    return [iterations_of(folder), newton_of(folder), f"{ending}{effort['cpu seconds']:.0f}"]


def labels_in(wanted):
    """Those of runs, "before" first and "now" last."""
    folder = os.path.join(wanted.output, "solvers")
    found = os.listdir(folder) if os.path.isdir(folder) else []
    return sorted((name for name in found if os.path.isdir(os.path.join(folder, name))),
                  key=lambda name: (name != "before", name == "now", name))


def rows_of_table(wanted, labels):
    lines = []
    for row, (_, _, text) in ROWS.items():
        for ranks in wanted.all_ranks:
            folders = [folder_of(wanted, row, ranks, label) for label in labels]
            found = [folder for folder in folders if effort_of(folder)]
            if not found:
                continue
            sizes = next((sizes for folder in found if (sizes := record_of(folder).get("sizes"))), {})
            unknowns = sum(value for name, value in sizes.items() if name.endswith(" unknowns"))
            effort = effort_of(found[0])
            lines.append([text, f"{unknowns:,}" if unknowns else "–", f"{effort['tetrahedra']:,}", f"{effort['flatness']:.1f}",
                          f"{effort['angle']:.1f}", str(ranks)] + [cell for folder in folders for cell in cells_of(folder)])
    return lines


def commits_text(wanted, is_of):
    """A sentence: of what commit the runs are whose names are, and which are of others."""
    runs = {}
    for label in labels_in(wanted):
        for commit, names in commits_of(os.path.join(wanted.output, "solvers", label)).items():
            runs.setdefault(commit, []).extend(name for name in names if is_of(name))
    runs = sorted(((commit, names) for commit, names in runs.items() if names), key=lambda run: -len(run[1]))
    return "Commit " + "; ".join([runs[0][0]] + [f"{commit}: {', '.join(names)}" for commit, names in runs[1:]]) + "." if runs else ""


def section(wanted):
    labels = labels_in(wanted)
    rows = rows_of_table(wanted, labels)
    if not rows:
        return []
    of_label = [f"{name}, {label}" for label in labels for name in ("iterations", "Newton steps a step", "CPU s")]
    return ["## Solvers on flat elements", "",
            "Made by `xml/vessels/reproduce solvers` from `xml/vessels/solvers/`, all solvers by default. Walls: one static load "
            "of 2.67 kPa. Coupled: two steps of 5 ms from rest, with `Coupling / Newton / linear tolerance` = 1e-8 in place of the "
            "default, so that iterations can be compared; \"as by default\" without it, three steps. Iterations of each Newton "
            "step to 1e-8, time steps between /, a star where the solver ended above its tolerance. Width over thickness: root of "
            "twice a triangle's area over the height of the element on it, mean of the flattest layer. CPU seconds: of all "
            "ranks, set-up included. " + commits_text(wanted, lambda name: name.rsplit("-", 1)[0] in ROWS), "",
            *table_text(["system", "unknowns", "tetrahedra", "width / thickness", "least angle", "ranks", *of_label], rows).splitlines(), ""]


def run_all(wanted):
    for row, ranks in runs_of(wanted):
        run(wanted, row, ranks)
