"""The figures of the paper's numerical section from the runs of xml/paper/reproduce."""
import os

from matplotlib import pyplot as plt

from report import centreline, section_figures, solver_figures
from report.canvas import Figure, positive, save
from report.paper_runs import ACCELERATORS, MATERIALS, MESHES
from report.run_data import rows_where

MESH_STYLE = {"coarse": "o-", "fine": "s--"}
SOLVERS = {"krylov-fluid": "fluid", "krylov-mooney-rivlin": "wall", "krylov-artery": "wall",
           "amg-fluid": "fluid", "amg-mooney-rivlin": "wall", "amg-artery": "wall"}


def draw_all(runs, folder):
    """The figures by name of their file, of those runs that are there."""
    jobs = [lambda m=m: coupling_history(runs, m) for m in MATERIALS]
    jobs.append(lambda: coupling_counts(runs))
    jobs += [lambda m=m: state(runs, m) for m in MATERIALS]
    for item, field in SOLVERS.items():
        jobs += [lambda i=item, f=field: newton_history(runs, i, f), lambda i=item, f=field: solver_counts(runs, i, f)]
    os.makedirs(folder, exist_ok=True)
    return {figure.file: figure for figure in save(jobs, folder)}


def coupling_history(runs, material):
    """Factors and residuals at the second time step."""
    canvas, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.0), layout="constrained")
    for mesh in MESHES:
        run = runs.march(mesh, f"pulse-{material}-aitken")
        rows = rows_where(run.coupling, step=2.0) if run else {}
        if not rows.get("iteration"):
            continue
        left.semilogy(rows["iteration"], positive(rows["relaxation"]), MESH_STYLE[mesh], markersize=4, label=mesh)
        right.semilogy(rows["iteration"], positive(rows["interface_residual"]), MESH_STYLE[mesh], markersize=4,
                       label=mesh)
    if not left.lines:
        plt.close(canvas)
        return None
    left.set(title="Aitken's factor", xlabel="coupling iteration")
    right.set(title="Interface residual [mm]", xlabel="coupling iteration")
    left.legend()
    title = f"Coupling in the second time step: {MATERIALS[material]}"
    canvas.suptitle(title, fontsize=13)
    return canvas, Figure(f"coupling-{material}.png", title, "")


def coupling_counts(runs):
    """Coupling iterations over the time steps; one panel per mesh."""
    found = {(mesh, material, accelerator): runs.march(mesh, f"pulse-{material}-{accelerator}")
             for mesh in MESHES for material in MATERIALS for accelerator in ACCELERATORS}
    found = {key: run for key, run in found.items() if run}
    meshes = [mesh for mesh in MESHES if any(key[0] == mesh for key in found)]
    if not meshes:
        return None
    canvas, panels = plt.subplots(1, len(meshes), sharey=True, squeeze=False, figsize=(1 + 5.2 * len(meshes), 4.2),
                                  layout="constrained")
    for (mesh, material, accelerator), run in found.items():
        is_first = material == next(iter(MATERIALS))
        steps = rows_where(run.steps, converged=1.0)
        panels[0, meshes.index(mesh)].plot(
            steps["step"], steps["coupling_iterations"], ("+" if is_first else "x") + "-", markersize=4,
            linewidth=0.8, color=plt.get_cmap("tab10")(list(ACCELERATORS).index(accelerator)),
            alpha=0.9 if is_first else 0.6, label=f"{MATERIALS[material]}, {ACCELERATORS[accelerator]}")
    for axes, mesh in zip(panels[0], meshes):
        axes.set(title=f"{mesh} mesh", xlabel="time step")
    handles = {label: handle for axes in panels[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    canvas.legend(handles.values(), handles.keys(), loc="lower center", ncols=3, fontsize=8)
    room = 0.02 + 0.04 * -(-len(handles) // 3)  # the legend's below
    canvas.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    panels[0, 0].set(ylabel="coupling iterations", yscale="log")
    panels[0, 0].yaxis.set_major_formatter("{x:g}")
    panels[0, 0].yaxis.set_minor_formatter("{x:g}")
    return canvas, Figure("coupling-counts.png", "Coupling iterations over the time steps", "")


def state(runs, material):
    """Section through the tube at 8 ms, on the finest mesh that got there."""
    for mesh in reversed(MESHES):
        for accelerator in ("iqn-ils", "aitken"):
            run = runs.march(mesh, f"pulse-{material}-{accelerator}", with_fields=True)
            shown = [output for output in run.outputs if abs(output[0] - 8.0) < 1e-9] if run else []
            if not shown:
                continue
            plane = section_figures.plane_of(run, centreline.straight(run.mesh("wall")[0]))
            factor = section_figures.default_magnification(run, shown, plane)
            canvas, figure = section_figures.section(run, shown, "velocity", factor, plane)
            return canvas, Figure(f"state-{material}.png", f"{MATERIALS[material]} at 8 ms, {mesh} mesh", figure.text)
    return None


def _both_meshes(runs, item):
    return [run for run in (runs.solvers(mesh, item) for mesh in MESHES) if run]


def newton_history(runs, item, field):
    found = _both_meshes(runs, item)
    if not found:
        return None
    for run in found:  # the fluid comes along in the cases of the wall
        run.solvers = rows_where(run.solvers, field=field)
    canvas, figure = solver_figures.newton_history(found)
    return canvas, Figure(f"newton-{item}.png", f"{figure.title}: {item}", figure.text)


def solver_counts(runs, item, field):
    found = _both_meshes(runs, item)
    if not found:
        return None
    canvas, figure = solver_figures.krylov_counts(found, field)
    return canvas, Figure(f"{item}.png", f"{item}: {figure.title}", figure.text)
