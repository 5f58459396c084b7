"""The figures of a report. Each function draws one and returns a Figure, or None if the run has
nothing to show in it. Units: mm, ms, kPa."""
import os
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

from report.run_data import rows_where
from report.section import Section, name_of_axis, norm_of, plane_through, section_axes, von_mises

COLOUR = {"fluid": "#1f6fb4", "wall": "#c0392b", "system": "#2e7d32", "": "#333333"}
DPI = 150
STYLE = {
    "font.size": 11, "axes.titlesize": 12, "axes.labelsize": 11, "legend.fontsize": 9.5,
    "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "lines.linewidth": 1.8, "lines.markersize": 5,
}
BOOKKEEPING = ("step", "time", "converged", "coupling_iterations", "interface_residual", "step_size", "rejected",
               "error_estimate", "seconds")


@dataclass
class Figure:
    file: str
    title: str
    text: str


def draw_all(run, folder, outputs, step, magnify):
    """Draws what the run permits; returns the figures in the order of the page."""
    jobs = []
    if outputs:
        factor = magnify if magnify is not None else default_magnification(run, outputs)
        shown = ("velocity", "pressure") if "fluid" in run.grids() else ("wall",)
        jobs += [lambda q=q: section(run, outputs, q, factor) for q in shown]
        jobs.append(lambda: bulge(run, outputs))
    jobs += [lambda: coupling_history(run, step), lambda: counts(run),
             lambda: newton_history(run, step), lambda: observables(run)]
    return save(jobs, folder)


def save(jobs, folder):
    """Draws, saves and returns the figures of those jobs that have something to show."""
    figures = []
    with matplotlib.rc_context(STYLE):
        for job in jobs:
            drawn = job()
            if drawn is None:
                continue
            canvas, figure = drawn
            canvas.savefig(os.path.join(folder, figure.file), dpi=DPI, bbox_inches="tight")
            plt.close(canvas)
            figures.append(figure)
    return figures


# --- sections -------------------------------------------------------------------------------

def default_magnification(run, outputs):
    """Round factor that lets the largest displacement be a quarter of the radius, 1 to 100."""
    largest, radius = 0.0, 0.0
    for grid in run.grids():
        points, _ = run.geometry(grid)
        radius = max(radius, np.ptp(points[:, 1]) / 2)
        largest = max([largest] + [norm_of(run.displacement(g, grid)).max() for _, g in outputs])
    if largest <= 0 or not np.isfinite(largest):
        return 1.0
    wanted = 0.25 * radius / largest
    if wanted <= 1:
        return 1.0
    power = 10 ** np.floor(np.log10(wanted))
    return float(min(100, power * max(d for d in (1, 2, 5) if d * power <= wanted * (1 + 1e-9))))


def _quantity(run, group, grid, quantity):
    """Values to colour by, at points or cells."""
    if grid == "wall":
        stress = run.field(group, grid, "von_mises")
        if stress is None:
            tensor = run.field(group, grid, "cauchy_stress")
            stress = None if tensor is None else von_mises(tensor)
        return norm_of(run.displacement(group, grid)) if stress is None else stress
    values = run.field(group, grid, quantity)
    if values is None:
        return None
    return norm_of(values) if quantity == "velocity" else values.reshape(len(values))


def _cuts(run, outputs, quantity, factor):
    """Per output a dictionary grid -> (section, (colours, whether they are at corners)); and the axes."""
    meshes = {grid: run.geometry(grid) for grid in run.grids()}
    all_points = np.concatenate([points for points, _ in meshes.values()])
    turn = section_axes(all_points).T
    plane = plane_through(all_points @ turn)
    result = []
    for _, group in outputs:
        row = {}
        for grid, (points, tets) in meshes.items():
            cut = Section(points @ turn, tets, plane, factor * run.displacement(group, grid) @ turn)
            values = _quantity(run, group, grid, quantity)
            if values is None or cut.is_empty():
                continue
            at_points = len(values) == len(points)
            colours = cut.at_corners(values) if at_points else values[cut.parents]
            row[grid] = (cut, (colours, at_points))
        result.append(row)
    return result, (name_of_axis(turn[:, 1], "across"), name_of_axis(turn[:, 2], "along"))


def _norm(cuts, grid):
    """One colour scale for all times; single peaks do not darken the rest."""
    values = np.concatenate([row[grid][1][0] for row in cuts if grid in row])
    values = values[np.isfinite(values)]
    low, high = (np.percentile(values, (0.2, 99.8))) if len(values) else (0.0, 1.0)
    if low >= 0 and low < 0.3 * high:
        low = 0.0
    if high - low < 1e-12 * max(abs(high), abs(low), 1e-300):
        low, high = low - 0.5, high + 0.5
    return matplotlib.colors.Normalize(low, high)


def _paint(axes, cut, values, norm, cmap):
    """values is (numbers, True at corners or False at triangles)."""
    numbers, at_corners = values
    visible = cut.visible()
    if at_corners:
        axes.tripcolor(cut.z, cut.y, cut.triangles[visible], numbers, shading="gouraud", norm=norm, cmap=cmap)
    else:
        axes.tripcolor(cut.z, cut.y, cut.triangles[visible], facecolors=numbers[visible], norm=norm, cmap=cmap)
    axes.add_collection(LineCollection(cut.outline(), colors="#222222", linewidths=0.6))


def _scales(run, outputs, quantity):
    """Grid -> (label, colour map)."""
    stress = any(f"{group}/wall/{name}" in run.fields for _, group in outputs
                 for name in ("von_mises", "cauchy_stress"))
    return {"fluid": ("velocity [mm/ms]", "viridis") if quantity == "velocity"
            else ("pressure [kPa]", "cividis"),
            "wall": ("von Mises stress [kPa]" if stress else "displacement [mm]", "YlOrRd")}


def section(run, outputs, quantity, factor):
    cuts, names = _cuts(run, outputs, quantity, factor)
    scales = _scales(run, outputs, quantity)
    present = [g for g in ("fluid", "wall") if any(g in row for row in cuts)]
    if not present or (quantity != "wall" and "fluid" not in present):
        return None
    norms = {g: _norm(cuts, g) for g in present}
    canvas, rows = _section_rows(cuts, len(present), names)
    for axes, row, (time, _) in zip(rows, cuts, outputs):
        for grid, (cut, values) in row.items():
            _paint(axes, cut, values, norms[grid], scales[grid][1])
        axes.set_title(f"t = {time:g} ms", loc="left", fontsize=11, pad=3)
    for grid in reversed(present):
        canvas.colorbar(matplotlib.cm.ScalarMappable(norms[grid], scales[grid][1]), ax=rows,
                        location="right", pad=0.015, aspect=28, fraction=0.035,
                        extend="max" if norms[grid].vmin == 0 else "both",
                        label=f"{grid} {scales[grid][0]}")
    title = "Longitudinal section: " + " and ".join(f"{g} {scales[g][0].split(' [')[0]}" for g in present)
    drawn = "displacement true to scale" if factor == 1 else f"displacement magnified {factor:g} times"
    canvas.suptitle(f"{title} ({drawn})", fontsize=13)
    return canvas, Figure(f"section_{quantity}.png", title,
                          f"Cut through the deformed configuration, {drawn}; the same colours at all times.")


def _section_rows(cuts, bars, names):
    """A figure with one row per cut, all with the same limits and true proportions; names: of its axes."""
    z = np.concatenate([c.z for row in cuts for c, _ in row.values()])
    y = np.concatenate([c.y for row in cuts for c, _ in row.values()])
    pad_z, pad_y = 0.02 * np.ptp(z), 0.06 * np.ptp(y)
    width = 11.0
    height = np.clip((width - 0.7 - 1.0 * bars) * np.ptp(y) / np.ptp(z), 0.6, 7.0)
    canvas, rows = plt.subplots(len(cuts), 1, sharex=True, squeeze=False, layout="constrained",
                                figsize=(width, len(cuts) * (height + 0.35) + 1.1))
    for axes in rows[:, 0]:
        axes.grid(False)
        axes.set(xlim=(z.min() - pad_z, z.max() + pad_z), ylim=(y.min() - pad_y, y.max() + pad_y),
                 ylabel=f"{names[0]} [mm]", aspect="equal")
        axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
    rows[-1, 0].set_xlabel(f"{names[1]} [mm]")
    return canvas, list(rows[:, 0])


# --- travelling bulge -----------------------------------------------------------------------

def _interface_points(run):
    """Wall points shared with the fluid; without a fluid those near the smallest radius."""
    points, _ = run.geometry("wall")
    if "fluid" in run.grids():
        fluid = {tuple(p) for p in run.geometry("fluid")[0].tolist()}
        shared = np.array([tuple(p) in fluid for p in points.tolist()])
        if shared.any():
            return np.flatnonzero(shared)
    radius = np.hypot(points[:, 0], points[:, 1])
    return np.flatnonzero(radius <= radius.min() + 0.2 * np.ptp(radius) + 1e-12)


def _profile(z, values):
    """Mean, least and greatest value in slices along z."""
    stations = np.unique(np.round(z / max(np.ptp(z), 1e-300), 4))
    slices = min(80, len(stations))
    which = np.minimum((slices * (z - z.min()) / max(np.ptp(z), 1e-300)).astype(int), slices - 1)
    used = np.unique(which)
    take = lambda f, v: np.array([f(v[which == s]) for s in used])  # noqa: E731
    return take(np.mean, z), take(np.mean, values), take(np.min, values), take(np.max, values)


def bulge(run, outputs):
    if "wall" not in run.grids():
        return None
    nodes = _interface_points(run)
    points = run.geometry("wall")[0][nodes]
    radius = np.maximum(np.hypot(points[:, 0], points[:, 1]), 1e-300)
    canvas, axes = plt.subplots(figsize=(9.5, 4.6), layout="constrained")
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.85, max(len(outputs), 2)))
    for (time, group), colour in zip(outputs, colours):
        moved = run.displacement(group, "wall")[nodes]
        radial = (moved[:, :2] * points[:, :2]).sum(axis=1) / radius
        z, mean, low, high = _profile(points[:, 2], radial)
        axes.plot(z, mean, color=colour, label=f"{time:g} ms")
        axes.fill_between(z, low, high, color=colour, alpha=0.15, linewidth=0)
    axes.axhline(0, color="#888888", linewidth=0.8)
    axes.set(xlabel="z [mm] (reference)", ylabel="radial displacement [mm]",
             title="Radial displacement of the interface")
    axes.legend(title="time", loc="center left", bbox_to_anchor=(1.0, 0.5))
    return canvas, Figure("radial_displacement.png", "Radial displacement of the interface",
                          "Mean over the circumference; the bands reach from the least to the greatest value.")


# --- iterations -----------------------------------------------------------------------------

def positive(values):
    """What a logarithmic axis can show."""
    v = np.array(values, dtype=float)
    return np.where(v > 0, v, np.nan)


def has_coupling_iterations(run):
    """Monolithic schemes have one per step, which tells nothing."""
    return max(run.coupling.get("iteration") or [0]) > 1


def coupling_history(run, step):
    if not has_coupling_iterations(run):
        return None
    chosen = rows_where(run.coupling, step=float(step))
    if not chosen or not chosen["step"]:
        return None
    canvas, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    others = [s for s in dict.fromkeys(run.coupling["step"]) if s != step]
    for i, other in enumerate(others[:: max(1, len(others) // 30)]):
        rows = rows_where(run.coupling, step=other)
        label = "other steps" if i == 0 else None
        left.semilogy(rows["iteration"], positive(rows["interface_residual"]), color="#d5d5d5",
                      linewidth=0.8, label=label, zorder=1)
        right.plot(rows["iteration"], positive(rows["relaxation"]), color="#d5d5d5",
                   linewidth=0.8, zorder=1)
    left.semilogy(chosen["iteration"], positive(chosen["interface_residual"]), "o-",
                  color=COLOUR["fluid"], label=f"step {step}")
    # The last iteration of a converged step makes no update: its factor is 0.
    right.plot(chosen["iteration"], positive(chosen["relaxation"]), "s-", color=COLOUR["wall"],
               label="factor")
    left.set(title="Interface residual", ylabel="residual [mm]")
    right.set(title="Relaxation factor", ylabel="factor", ylim=(0.0, None))
    left.legend()
    if max(chosen["columns"]) > 0:
        columns = right.twinx()
        columns.plot(chosen["iteration"], positive(chosen["columns"]), "^-",
                     color=COLOUR["fluid"], alpha=0.6)
        columns.set(ylabel="columns of the least-squares model (triangles)", ylim=(0.0, None))
        columns.yaxis.set_major_locator(MaxNLocator(integer=True))
    for axes in (left, right):
        axes.set_xlabel("coupling iteration")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    canvas.suptitle(f"Coupling in step {step} (t = {chosen['time'][0]:g} ms)", fontsize=13)
    return canvas, Figure("coupling.png", f"Coupling iterations of step {step}",
                          "Residual of the interface and relaxation factor at each iteration.")


def counts(run):
    def of_fields(ending):
        return [(c, c.removesuffix(ending)) for c in run.steps if c.endswith(ending)]

    panels = [("Coupling iterations", [("coupling_iterations", "")] if has_coupling_iterations(run) else []),
              ("Newton steps", of_fields("_newton")), ("Linear iterations", of_fields("_linear"))]
    shown = []
    for title, columns in panels:
        columns = [(c, f) for c, f in columns if np.nansum(np.array(run.steps.get(c, [0.0]), float)) > 0]
        if columns:
            shown.append((title, columns))
    if not shown:
        return None
    canvas, rows = plt.subplots(len(shown), 1, sharex=True, squeeze=False, layout="constrained",
                                figsize=(9.5, 2.3 * len(shown) + 0.5))
    failed = [i for i, c in enumerate(run.steps.get("converged", [])) if c in (0.0, "false", "False")]
    for axes, (title, columns) in zip(rows[:, 0], shown):
        top = 0.0
        for column, field in columns:
            axes.plot(run.steps["step"], run.steps[column], "s--" if field == "wall" else "o-", markersize=3.5, color=COLOUR[field],
                      label=field or None)
            axes.plot([run.steps["step"][i] for i in failed], [run.steps[column][i] for i in failed],
                      "x", color="red", markersize=9, label=None)
            top = max(top, np.nanmax(run.steps[column]))
        axes.set(title=title + " per step", ylim=(0, 1.12 * top))
        axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=5))
        if len(columns) > 1 or columns[0][1]:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    rows[-1, 0].set_xlabel("step")
    rows[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    return canvas, Figure("iterations.png", "Iterations per step",
                          "Sums over the coupling iterations of a step. A red cross marks a step that did not converge.")


def newton_history(run, step):
    chosen = rows_where(run.newton, step=float(step))
    fields = [f for f in ("fluid", "wall") if f in (chosen.get("field") or [])]
    if not fields:
        fields = list(dict.fromkeys(chosen.get("field") or []))
    if not fields:
        return None
    canvas, columns = plt.subplots(1, len(fields), squeeze=False, sharey=True, layout="constrained",
                                   figsize=(5.2 * len(fields) + 0.6, 4.2))
    for axes, field in zip(columns[0], fields):
        rows = rows_where(chosen, field=field)
        rounds = list(dict.fromkeys(rows["coupling_iteration"]))[:4]
        for number, colour in zip(rounds, plt.get_cmap("viridis")(np.linspace(0, 0.85, len(rounds)))):
            one = rows_where(rows, coupling_iteration=number)
            axes.semilogy(one["iteration"], positive(one["increment"]), "o-", color=colour,
                          label=f"coupling iteration {number:g}")
        axes.set(title=field, xlabel="Newton step")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        if len(rounds) > 1:
            axes.legend()
    columns[0, 0].set_ylabel("norm of the increment")
    canvas.suptitle(f"Newton's method in step {step}", fontsize=13)
    return canvas, Figure("newton.png", f"Newton's method in step {step}",
                          "Increments in the first coupling iterations. The table lists the exponents of convergence.")


def observables(run):
    """The columns of steps.csv behind the fixed ones, at most six."""
    names = [c for c in run.steps if c not in BOOKKEEPING and not c.endswith(("_newton", "_linear"))]
    names = [c for c in names if all(isinstance(v, float) for v in run.steps[c])]
    names = [c for c in names if np.isfinite(run.steps[c]).any()][:6]
    if not names:
        return None
    across = 1 if len(names) == 1 else 2
    down = -(-len(names) // across)
    canvas, grid = plt.subplots(down, across, sharex=True, squeeze=False, layout="constrained",
                                figsize=(5.2 * across, 2.7 * down + 0.4))
    for axes, name in zip(grid.flat, names):
        axes.plot(run.steps.get("time", run.steps["step"]), run.steps[name], color=COLOUR["fluid"])
        axes.set_title(readable(name))
        axes.ticklabel_format(axis="y", scilimits=(-3, 4))
    for axes in list(grid.flat)[len(names):]:
        axes.set_visible(False)
    for axes in grid[-1]:
        axes.set_xlabel("time [ms]" if "time" in run.steps else "step")
    return canvas, Figure("observables.png", "Observables", "Physical quantities at the end of each step.")


def readable(column):
    """"inflow_mm3_per_ms" becomes "inflow [mm³/ms]"."""
    units = {"mm": "mm", "mm2": "mm²", "mm3": "mm³", "ms": "ms", "kPa": "kPa", "mg": "mg", "mN": "mN", "uJ": "µJ"}
    words = column.split("_")
    if len(words) > 3 and words[-2] == "per" and words[-1] in units and words[-3] in units:
        return " ".join(words[:-3]) + f" [{units[words[-3]]}/{units[words[-1]]}]"
    if len(words) > 1 and words[-1] in units:
        return " ".join(words[:-1]) + f" [{units[words[-1]]}]"
    return " ".join(words)
