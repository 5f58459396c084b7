"""Curves along the vessel and over time. Functions are as those of section_figures.py."""
import re

import numpy as np
from matplotlib import pyplot as plt

from report import centreline
from report.canvas import COLOUR, Figure, readable
from report.case_tables import FLOW
from report.run_data import spread
from report.surfaces import area_vectors, numbers_by_place

BOOKKEEPING = ("step", "time", "converged", "coupling_iterations", "interface_residual", "step_size", "rejected",
               "error_estimate", "seconds")
PRESSURE = re.compile(r"mean_pressure_(.+)_kPa$")
PROBES = {"wall displacement": re.compile(r"wall_displacement_(.+)_mm$"),
          "radial displacement": re.compile(r"radial_displacement_(.+)_mm$"),
          "fluid pressure": re.compile(r"fluid_pressure_(?!min_kPa|max_kPa)(.+)_kPa$"),
          "fluid velocity": re.compile(r"fluid_velocity_(.+)_mm_per_ms$")}
UNITS = {"fluid pressure": "kPa", "fluid velocity": "mm/ms"}  # mm of the others


# --- radial displacement --------------------------------------------------------------------

def interface_points(run):
    """Wall points shared with the fluid; without a fluid those near the axis."""
    points, _ = run.mesh("wall")
    if "fluid" in run.grids():
        wall, fluid = numbers_by_place(points, run.mesh("fluid")[0])
        shared = np.isin(wall, fluid)
        if shared.any():
            return np.flatnonzero(shared)
    _, _, away = (line := centreline.straight(points)).locate(points)
    radius = np.einsum("ij,ij->i", points - line.centres[0], away)
    return np.flatnonzero(radius <= radius.min() + 0.2 * np.ptp(radius) + 1e-12)


def inflows(run, ends):
    """Through each cap, −Σ ∫ v·n over a score of outputs; none where there are no velocities."""
    total = np.zeros(len(ends))
    normals = [area_vectors(end.points, end.triangles) for end in ends]
    for _, group in spread(run.outputs, 20):
        velocity = run.nodal(group, "fluid", "velocity")
        if velocity is None:
            return ()
        for k, end in enumerate(ends):
            total[k] -= np.einsum("ij,ij", velocity[end.nodes][end.triangles].mean(axis=1), normals[k])
    return total


def line_of(run, surfaces):
    """The centreline; straight where there is no lumen with two ends."""
    if len(surfaces.ends) > 1:
        return centreline.of_lumen(*run.mesh("fluid"), surfaces.ends, inflows(run, surfaces.ends))
    return centreline.straight(run.mesh(run.grids()[-1])[0])


def _profile(way, values):
    """Mean, least and greatest value in slices along the line."""
    stations = np.unique(np.round(way / max(np.ptp(way), 1e-300), 4))
    slices = len(stations) if len(stations) <= 80 else min(80, max(8, len(way) // 16))  # scattered ones: enough in each
    which = np.minimum((slices * (way - way.min()) / max(np.ptp(way), 1e-300)).astype(int), slices - 1)
    used = np.unique(which)
    take = lambda f, v: np.array([f(v[which == s]) for s in used])  # noqa: E731
    return take(np.mean, way), take(np.mean, values), take(np.min, values), take(np.max, values)


def bulge(run, outputs, line):
    """Radial displacement along the centreline, a panel for each way through the vessel."""
    if "wall" not in run.grids():
        return None
    nodes = interface_points(run)
    segment, way, away = line.locate(run.mesh("wall")[0][nodes])
    paths = [p for p in line.paths() if np.isin(segment, p).sum() > 2][:4]
    canvas, panels = plt.subplots(len(paths), 1, sharex=True, sharey=True, squeeze=False, layout="constrained",
                                  figsize=(9.5, 4.6 if len(paths) == 1 else 1.0 + 2.9 * len(paths)))
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.85, max(len(outputs), 2)))
    for (time, group), colour in zip(outputs, colours):
        radial = np.einsum("ij,ij->i", run.displacement(group, "wall")[nodes], away)
        for axes, path in zip(panels[:, 0], paths):
            on_path = np.isin(segment, path)
            s, mean, low, high = _profile(way[on_path], radial[on_path])
            axes.plot(s, mean, color=colour, label=f"{time:g} ms")
            axes.fill_between(s, low, high, color=colour, alpha=0.15, linewidth=0)
    for axes, path in zip(panels[:, 0], paths):
        axes.axhline(0, color="#888888", linewidth=0.8)
        axes.set_ylabel("radial displacement [mm]")
        if len(paths) > 1:
            x, y, z = line.centres[path[-1]]
            axes.set_title(f"to the end at ({x:.1f}, {y:.1f}, {z:.1f}) mm", loc="left", fontsize=11)
    panels[-1, 0].set_xlabel("way along the centreline [mm] (reference)")
    panels[0, 0].legend(title="time", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    canvas.suptitle("Radial displacement of the interface", fontsize=13)
    return canvas, Figure("radial_displacement.png", "Radial displacement of the interface",
                          "Away from the centreline of the lumen. Mean over the circumference; the bands reach "
                          "from the least to the greatest value.")


# --- over time ------------------------------------------------------------------------------

def _matching(run, pattern):
    """(name, values) of the columns that match; the name is what stands in brackets."""
    return [(m.group(1).replace("_", " "), run.steps[c]) for c in run.steps
            if (m := pattern.match(c)) and all(isinstance(v, float) for v in run.steps[c])
            and np.isfinite(run.steps[c]).any()]


def curves(run):
    """Flow and pressure of each surface, and probes."""
    panels = [("Flow into the fluid", "flow [mm³/ms]", _matching(run, FLOW)),
              ("Mean pressure", "pressure [kPa]", _matching(run, PRESSURE))]
    panels += [(f"Probes: {name}", f"{name} [{UNITS.get(name, 'mm')}]", _matching(run, pattern))
               for name, pattern in PROBES.items()]
    panels = [p for p in panels if p[2]]
    if not panels:
        return None
    canvas, rows = plt.subplots(len(panels), 1, sharex=True, squeeze=False, layout="constrained",
                                figsize=(9.5, 2.7 * len(panels) + 0.5))
    for axes, (title, label, columns) in zip(rows[:, 0], panels):
        for i, (name, values) in enumerate(columns):
            axes.plot(_times(run), values, color=plt.get_cmap("tab10")(i % 10), linestyle=("-", "--", ":")[i // 10 % 3],
                      label=name)
        axes.set(title=title, ylabel=label)
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    rows[-1, 0].set_xlabel(_time_label(run))
    return canvas, Figure("curves.png", "Flow, pressure and probes", "At the end of each step, by surface or probe.")


def _times(run):
    return run.steps.get("time", run.steps["step"])


def _time_label(run):
    return "time [ms]" if "time" in run.steps else "step"


def observables(run):
    """The columns of steps.csv behind the fixed ones that curves() does not show, at most six."""
    shown = (FLOW, PRESSURE, *PROBES.values())
    names = [c for c in run.steps if c not in BOOKKEEPING and not c.endswith(("_newton", "_linear"))]
    names = [c for c in names if not any(p.match(c) for p in shown)]
    names = [c for c in names if all(isinstance(v, float) for v in run.steps[c])]
    names = [c for c in names if np.isfinite(run.steps[c]).any()][:6]
    if not names:
        return None
    across = 1 if len(names) == 1 else 2
    down = -(-len(names) // across)
    canvas, grid = plt.subplots(down, across, sharex=True, squeeze=False, layout="constrained",
                                figsize=(5.2 * across, 2.7 * down + 0.4))
    for axes, name in zip(grid.flat, names):
        axes.plot(_times(run), run.steps[name], color=COLOUR["fluid"])
        axes.set_title(readable(name))
        axes.ticklabel_format(axis="y", scilimits=(-3, 4))
    for axes in list(grid.flat)[len(names):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel(_time_label(run))
    return canvas, Figure("observables.png", "Observables", "Physical quantities at the end of each step.")
