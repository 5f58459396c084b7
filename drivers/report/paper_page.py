"""RESULTS.md: the paper's numerical section and ours side by side."""
import os

import numpy as np

from report import paper_numbers
from report.paper_runs import ACCELERATORS, FORCINGS, MATERIALS, MESHES, second_iteration
from report.run_data import rows_where


def write(runs, folder, figures, prefix):
    """prefix: path from folder to the figures."""
    parts = [_head(), _meshes(runs), _coupling(runs, figures, prefix), _states(figures, prefix),
             _solvers(runs, figures, prefix, "krylov", "Krylov methods"),
             _solvers(runs, figures, prefix, "amg", "Multigrid"), _adaptive(runs), _forcing(runs), _speed(runs),
             _differences(), _origins(runs)]
    path = os.path.join(folder, "RESULTS.md")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(part for part in parts if part))
    return path


def _table(heading, rows):
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def _image(figures, file, prefix):
    figure = figures.get(file)
    return f"![{figure.title}]({prefix}{file})\n\n{figure.text}\n" if figure else ""


def _head():
    return ("# The numerical section of Langer and Yang, run again\n\n"
            "Made by `tunica-report --paper`; do not edit. `xml/paper/reproduce --list` names every item, what it "
            "shows and how long it takes; `xml/paper/reproduce ITEM` runs one, `xml/paper/reproduce` those on the "
            "coarse mesh, with `--fine` those on the fine one. Stopped runs go on where they were.\n")


def _sizes(runs, mesh):
    for item in runs.items.get(mesh, []):
        if runs.has(mesh, item, "run.json"):
            run = runs.march(mesh, item) or runs.solvers(mesh, item)
            if run and "wall vertices" in run.record.get("sizes", {}):
                return run.record["sizes"]
    return None


def _meshes(runs):
    theirs = {"coarse": (2259, 8120, 6524, 30472), "fine": (14249, 64960, 46356, 243776)}
    keys = ("fluid vertices", "fluid tetrahedra", "wall vertices", "wall tetrahedra")
    rows = []
    for mesh in MESHES:
        sizes = _sizes(runs, mesh)
        rows.append([mesh] + [f"{n:,}" + (f" / {sizes[k]:,}" if sizes else "") for n, k in zip(theirs[mesh], keys)])
    return "## Meshes\n\nTheirs / ours. The fine mesh is the coarse one refined once.\n\n" + _table(["mesh", *keys], rows)


# --- coupling -------------------------------------------------------------------------------

def _coupling(runs, figures, prefix):
    rows = []
    for material in MATERIALS:
        for accelerator, name in ACCELERATORS.items():
            for mesh in MESHES:
                run = runs.march(mesh, f"pulse-{material}-{accelerator}")
                if run:
                    rows.append([MATERIALS[material], name, mesh] + _count_cells(run))
    if not rows:
        return ""
    text = ("## Coupling iterations\n\nThe paper's figures show that the iterations stay in one range from step to "
            "step and from mesh to mesh; it prints no number.\n\n")
    text += _table(["wall", "method", "mesh", "steps", "fewest", "median", "most", "most / fewest",
                    "most / fewest from step 2", "second step", "its factors", "hours"], rows)
    text += "\n" + _image(figures, "coupling-counts.png", prefix)
    for material in MATERIALS:
        text += "\n" + _image(figures, f"coupling-{material}.png", prefix)
    return text


def _count_cells(run):
    n = np.array(rows_where(run.steps, converged=1.0)["coupling_iterations"])
    if len(n) == 0:
        return ["0 of 72"] + 8 * ["–"]
    second = rows_where(run.coupling, step=2.0)
    factors = [f for f in second.get("relaxation", []) if f > 0]
    is_relaxed = not any(c > 0 for c in second.get("columns", []))
    return [f"{len(n)} of 72", f"{n.min():g}", f"{np.median(n):g}", f"{n.max():g}", f"{n.max() / n.min():.2f}",
            f"{n[1:].max() / n[1:].min():.2f}" if len(n) > 1 else "–", f"{len(second.get('iteration', []))}",
            f"{min(factors):.3f} … {max(factors):.3f}" if factors and is_relaxed else "–",
            f"{np.nansum(run.steps['seconds']) / 3600:.2f}"]


def _states(figures, prefix):
    images = [_image(figures, f"state-{material}.png", prefix) for material in MATERIALS]
    return "## Deformation and velocity at 8 ms\n\n" + "\n".join(images) if any(images) else ""


# --- linear solvers -------------------------------------------------------------------------

def _solvers(runs, figures, prefix, kind, title):
    text = ""
    for subject, field in (("fluid", "fluid"), ("mooney-rivlin", "wall"), ("artery", "wall")):
        item = f"{kind}-{subject}"
        found = {mesh: runs.solvers(mesh, item) for mesh in MESHES}
        found = {mesh: run for mesh, run in found.items() if run and field in run.fields()}
        if not found:
            continue
        name = "fluid" if field == "fluid" else f"{MATERIALS[subject]} wall"
        text += f"\n### {title}: {name}\n\nIterations at each Newton step, residuals reduced by 1e-8.\n\n"
        settings = list(dict.fromkeys(s for run in found.values() for s in run.settings(field)))
        text += _table(["setting", *found], [[s] + [_counts(run, field, s) for run in found.values()] for s in settings])
        text += _levels(found, field) if kind == "amg" else ""
        text += "\n" + _image(figures, f"newton-{item}.png", prefix) + "\n" + _image(figures, f"{item}.png", prefix)
    return f"## {title}\n{text}" if text else ""


def _counts(run, field, setting):
    rows = rows_where(run.solvers, field=field, setting=setting)
    if not rows.get("iterations"):
        return "–"
    return " ".join(f"{n:g}" + ("" if v == "converged" else f" ({v})")
                    for n, v in zip(rows["iterations"], rows["verdict"]))


def _levels(found, field):
    lines = []
    for mesh, run in found.items():
        ours = next((str(l) for l in run.solvers.get("levels", []) if len(str(l).split()) > 1), None)
        if ours:
            theirs = " ".join(f"{n}" for n in paper_numbers.LEVELS[field, mesh])
            lines.append(f"Unknowns per level, {mesh} mesh: theirs {theirs}; ours {ours}.")
    return "\n" + "  \n".join(lines) + "\n" if lines else ""


# --- Newton's method ------------------------------------------------------------------------

def _adaptive(runs):
    text = ""
    for subject in ("fluid", "mooney-rivlin", "artery"):
        for mesh in MESHES:
            run = runs.march(mesh, f"newton-{'mooney-rivlin' if subject == 'fluid' else subject}-increment")
            rows = second_iteration(run, "fluid" if subject == "fluid" else "wall") if run else {}
            if rows.get("iteration"):
                text += _adaptive_table(subject, mesh, rows)
    if not text:
        return ""
    return ("## Adaptive control of inner and outer errors\n\nTheirs | ours: ε₂ the mass norm of Newton's increment, "
            "ε₁ the reduction of the linear residual that was reached, and the cycles for it. Newton's method stops "
            "at ε₂ ≤ 1e-6.\n" + text)


def _adaptive_table(subject, mesh, rows):
    theirs = paper_numbers.ADAPTIVE[subject, mesh]
    ours = list(zip(rows["increment"], rows["linear_residual"], rows["linear_iterations"]))
    cells = []
    for k in range(max(len(theirs), len(ours))):
        left = [f"{theirs[k][0]:.1e}", f"{theirs[k][1]:.1e}", theirs[k][2]] if k < len(theirs) else ["", "", ""]
        right = [f"{ours[k][0]:.1e}", f"{ours[k][1]:.1e}", f"{ours[k][2]:g}"] if k < len(ours) else ["", "", ""]
        cells.append([k + 1, *left, *right])
    cells.append(["**total**", "", "", f"**{sum(t[2] for t in theirs)}**", "", "", f"**{sum(o[2] for o in ours):g}**"])
    name = "fluid" if subject == "fluid" else f"{MATERIALS[subject]} wall"
    return f"\n{name}, {mesh} mesh\n\n" + _table(
        ["Newton step", "theirs: ε₂", "ε₁", "cycles", "ours: ε₂", "ε₁", "cycles"], cells)


def _forcing(runs):
    rows = []
    for material in MATERIALS:
        for mesh in MESHES:
            for forcing, name in FORCINGS.items():
                run = runs.march(mesh, f"newton-{material}-{forcing}")
                if run:
                    rows.append([MATERIALS[material], mesh, name] + _forcing_cells(run))
    if not rows:
        return ""
    return ("## Forcing terms\n\nThe first two coupling iterations together, the same cycles for all: Newton steps, "
            "linear iterations and seconds in linear solves (set-up and iterations).\n\n"
            + _table(["wall", "mesh", "linear tolerance", "fluid: Newton", "cycles", "s", "wall: Newton", "cycles", "s"],
                     rows))


def _forcing_cells(run):
    cells = []
    for field in ("fluid", "wall"):
        rows = rows_where(run.linear, field=field)
        seconds = sum(rows["setup_seconds"]) + sum(rows["solve_seconds"])
        cells += [len(rows["iterations"]), f"{sum(rows['iterations']):g}", f"{seconds:.1f}"]
    return cells


# --- time -----------------------------------------------------------------------------------

def _speed(runs):
    rows = []
    for mesh, theirs in (("coarse", 5.3), ("fine", 67.0)):
        run = runs.march(mesh, "speed")
        if run and run.coupling.get("fluid_seconds"):
            rows.append([mesh] + _speed_cells(run) + [f"{theirs:g}"])
    if not rows:
        return ""
    return ("## Seconds per time step\n\nThe pulse through the Mooney–Rivlin wall on one core, implicit coupling to "
            "1e-8 mm by IQN-ILS with the added mass taken out (\"update\") and backflow stabilised, mean of the steps. "
            "The last column is another vascular code on a like machine and problem, with a tolerance of 1e-6.\n\n"
            + _table(["mesh", "steps", "coupling iterations per step", "s per step", "update", "mesh motion",
                      "fluid: Jacobians", "set-up", "solve", "rest", "wall: Jacobians", "set-up", "solve", "rest",
                      "another code"], rows))


def _speed_cells(run):
    steps = len(run.steps["step"])
    update, motion = (sum(run.coupling.get(f"{part}_seconds", [float("nan")])) for part in ("update", "motion"))
    cells = [steps, f"{np.mean(run.steps['coupling_iterations']):.1f}", f"**{sum(run.steps['seconds']) / steps:.2f}**",
             f"{update / steps:.2f}", f"{motion / steps:.2f}"]
    for field in ("fluid", "wall"):
        rows = rows_where(run.linear, field=field)
        parts = [run.record["timings"].get(f"assembly of {field} Jacobians", float("nan")),
                 sum(rows["setup_seconds"]), sum(rows["solve_seconds"])]
        rest = sum(run.coupling[f"{field}_seconds"]) - sum(parts)
        cells += [f"{t / steps:.2f}" for t in (*parts, rest)]
    return cells


# --- text and origins -----------------------------------------------------------------------

def _differences():
    """What the numbers mean: written by hand, next to this file."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "paper_differences.md")
    with open(path, encoding="utf-8") as file:
        return file.read()


def _origins(runs):
    rows = []
    for mesh, item, record, origin in runs.origins():
        timings = record.get("timings", {})
        seconds = timings.get("set-up", 0.0) + timings.get("march from the first step", timings.get("march", 0.0))
        rows.append([item, mesh, record.get("status", "?"), record.get("ranks", "?"), f"{seconds:,.0f}",
                     record.get("started", "?")[:10], " ".join(c[:10] for c in origin.get("commit", "?").split()), origin.get("processor", "?")])
    if not rows:
        return ""
    return "## Where the numbers come from\n\n" + _table(
        ["item", "mesh", "status", "ranks", "seconds", "date", "commit", "processor"], rows)
