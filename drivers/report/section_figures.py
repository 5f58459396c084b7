"""Sections of the deformed vessel, coloured. Each function draws one figure and returns it with its canvas, or
None if the run has nothing to show in it."""
import matplotlib
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

from report.canvas import Figure, colour_scale
from report.run_data import BadRun
from report.section import Section, chosen_plane, fitted_plane, name_of_axis, norm_of


def plane_of(run, line, wanted=None):
    """wanted: normal and level, see chosen_plane(), or None."""
    points = np.concatenate([run.mesh(grid)[0] for grid in run.grids()])
    if wanted is None:
        return fitted_plane(points, line.centres)
    plane = chosen_plane(points, line.centres, *wanted)
    low, high = (points @ plane.axes[0]).min(), (points @ plane.axes[0]).max()
    if not low <= plane.level <= high:
        raise BadRun(f"--plane: {plane.level:g} mm along its normal is beside the vessel, which reaches from {low:g} to "
                     f"{high:g} mm")
    return plane


def default_magnification(run, outputs, plane):
    """Round factor that lets the largest displacement be a quarter of the radius, 1 to 100."""
    points = np.concatenate([run.mesh(grid)[0] for grid in run.grids()])
    radius = np.ptp(points @ plane.axes.T, axis=0).min() / 2
    largest = max(norm_of(run.displacement(g, grid)).max() for grid in run.grids() for _, g in outputs)
    if largest <= 0 or not np.isfinite(largest):
        return 1.0
    wanted = 0.25 * radius / largest
    if wanted <= 1:
        return 1.0
    power = 10 ** np.floor(np.log10(wanted))
    return float(min(100, power * max(d for d in (1, 2, 5) if d * power <= wanted * (1 + 1e-9))))


def _quantity(run, group, grid, quantity):
    """Values to colour by."""
    if grid == "wall":
        stress = run.nodal(group, grid, "von_mises")
        return norm_of(run.displacement(group, grid)) if stress is None else stress
    values = run.nodal(group, grid, quantity)
    if values is None:
        return None
    return norm_of(values) if quantity == "velocity" else values.reshape(len(values))


def _cuts(run, outputs, quantity, factor, plane):
    """Per output a dictionary grid -> (section, colours at its corners); and the names of the axes."""
    meshes = {grid: run.mesh(grid) for grid in run.grids()}
    turn = plane.axes.T
    result = []
    for _, group in outputs:
        row = {}
        for grid, (points, tets) in meshes.items():
            values = _quantity(run, group, grid, quantity)
            if values is None:
                continue
            cut = Section(points @ turn, tets, plane.level, factor * run.displacement(group, grid) @ turn)
            if not cut.is_empty():
                row[grid] = (cut, cut.at_corners(values))
        result.append(row)
    return result, (name_of_axis(turn[:, 1], "across"), name_of_axis(turn[:, 2], "along"))


def _norm(cuts, grid):
    """One colour scale for all times."""
    return colour_scale(np.concatenate([row[grid][1] for row in cuts if grid in row]))


def _paint(axes, cut, values, norm, cmap):
    """As an image: Matplotlib's own shading gives thin triangles points that stand out."""
    image, extent = painted(cut.z, cut.y, cut.triangles, values)
    axes.imshow(image, extent=extent, origin="lower", norm=norm, cmap=cmap, interpolation="nearest")
    axes.add_collection(LineCollection(cut.outline(), colors="#222222", linewidths=0.6, capstyle="round"))


def painted(x, y, triangles, values, pixels=1400):
    """Values between those at the corners of triangles, as an image that is NaN elsewhere, and its extent."""
    left, bottom = x.min(), y.min()
    size = max(np.ptp(x), np.ptp(y), 1e-300) / pixels
    shape = int(np.ptp(y) / size) + 1, int(np.ptp(x) / size) + 1
    image = np.full(shape, np.nan)
    corners = np.stack([(x - left) / size - 0.5, (y - bottom) / size - 0.5], axis=1)[triangles]  # in pixels
    low = np.maximum(np.floor(corners.min(axis=1)).astype(int), 0)
    high = np.minimum(np.ceil(corners.max(axis=1)).astype(int), (shape[1] - 1, shape[0] - 1))
    span = np.maximum(high - low + 1, 0)
    total = np.cumsum(span.prod(axis=1))
    for some in np.split(np.arange(len(triangles)), np.searchsorted(total, np.arange(4_000_000, total[-1], 4_000_000))):
        _fill(image, corners[some], low[some], span[some], values[triangles[some]])
    return image, (left, left + shape[1] * size, bottom, bottom + shape[0] * size)


def _fill(image, corners, low, span, values):
    """Pixels of the triangles' boxes, one after the other, and of them those inside."""
    count = span.prod(axis=1)
    which = np.repeat(np.arange(len(corners)), count)
    number = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    px = low[which, 0] + number % span[which, 0]
    py = low[which, 1] + number // span[which, 0]
    a, b, c = (corners[:, k] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    part = lambda p, q: ((p[which, 0] - px) * (q[which, 1] - py)  # noqa: E731
                         - (p[which, 1] - py) * (q[which, 0] - px)) / np.where(area == 0, 1, area)[which]
    weights = np.stack([part(b, c), part(c, a), part(a, b)], axis=1)
    inside = (weights >= -1e-9).all(axis=1) & (area != 0)[which]
    image[py[inside], px[inside]] = np.einsum("ij,ij->i", weights[inside], values[which[inside]])


def _scales(run, outputs, quantity):
    """Grid -> (label, colour map)."""
    stress = any(f"{group}/wall/{name}" in run.fields for _, group in outputs
                 for name in ("von_mises", "cauchy_stress"))
    return {"fluid": ("velocity [mm/ms]", "viridis") if quantity == "velocity"
            else ("pressure [kPa]", "cividis"),
            "wall": ("von Mises stress [kPa]" if stress else "displacement [mm]", "YlOrRd")}


def section(run, outputs, quantity, factor, plane):
    cuts, names = _cuts(run, outputs, quantity, factor, plane)
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
    title = "Section: " + " and ".join(f"{g} {scales[g][0].split(' [')[0]}" for g in present)
    drawn = "displacement true to scale" if factor == 1 else f"displacement magnified {factor:g} times"
    canvas.suptitle(f"{title} ({drawn})", fontsize=13)
    return canvas, Figure(f"section_{quantity}.png", title,
                          f"Cut through the deformed configuration, {drawn}; the same colours at all times. "
                          f"The plane is that of {plane.option()}.")


def _section_rows(cuts, bars, names):
    """A figure with a panel for each cut, all with the same limits and true proportions: long vessels one
    below the other, others side by side too; names: of its axes."""
    z = np.concatenate([c.z for row in cuts for c, _ in row.values()])
    y = np.concatenate([c.y for row in cuts for c, _ in row.values()])
    pad_z, pad_y = 0.02 * np.ptp(z), 0.06 * np.ptp(y)
    slimness = np.ptp(y) / np.ptp(z)
    across = min(len(cuts), 1 if slimness < 0.35 else 2 if slimness < 0.6 else 3)
    down = -(-len(cuts) // across)
    width = 11.0
    height = np.clip((width - 0.7 - 1.0 * bars) / across * slimness, 0.6, 7.0)
    canvas, panels = plt.subplots(down, across, sharex=True, sharey=True, squeeze=False, layout="constrained",
                                  figsize=(width, down * (height + 0.35) + 1.1))
    for axes in panels.flat:
        axes.grid(False)
        axes.set(xlim=(z.min() - pad_z, z.max() + pad_z), ylim=(y.min() - pad_y, y.max() + pad_y), aspect="equal")
        axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
        axes.xaxis.set_major_locator(MaxNLocator(nbins=9 // across, steps=[1, 2, 2.5, 5, 10]))
    for axes in panels.flat[len(cuts):]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel(f"{names[0]} [mm]")
    for axes in panels[-1]:
        axes.set_xlabel(f"{names[1]} [mm]")
    return canvas, list(panels.flat)[:len(cuts)]
