"""The errors of whole fields at the end of the run, at the vertices that all meshes share.

A refined mesh has the vertices of the mesh before it with their numbers, and behind them those in the middle of its edges.
"""
import numpy as np

from report.run_data import BadRun, Run
from vessel.errors import BadInput, nearest

from . import richardson
from .plan import STEP
from .result import CAUSES, Row
from .richardson import Budget

DEFAULT = ("velocity", "pressure", "displacement", "wall_shear_stress", "recovered_von_mises")
OF_FIELD = "root mean square"
SAME_PLACE = 1e-9  # of the extent of the mesh
LEAST_SHARED = 0.5  # of the vertices


def arrays_of(run):
    """(grid, name) of all arrays at the vertices in the last output."""
    if not run.outputs:
        return []
    group = run.outputs[-1][1]
    return [(grid, name) for grid in run.grids() for name in run.fields[f"{group}/{grid}"]
            if len(run.fields[f"{group}/{grid}/{name}"]) == len(run.fields[f"{grid}/points"])]


def chosen(run, text):
    there = arrays_of(run)
    names = {name for _, name in there}
    if text is None:
        return [(grid, name) for grid, name in there if name in DEFAULT]
    wanted = [word.strip() for word in text.split(",") if word.strip() and word.strip() != "none"]
    for name in wanted:
        if name not in names:
            raise BadInput(f"--fields {name}: the run has no such array at its vertices. {nearest(name, sorted(names))}")
    return [(grid, name) for grid, name in there if name in wanted]


def _ordered(run, grid, name):
    """Places and values by the numbers that the vertices have in the mesh."""
    numbers = run.fields[f"{grid}/vertices"][:].reshape(-1)
    order = np.argsort(numbers)
    values = run.fields[f"{run.outputs[-1][1]}/{grid}/{name}"][:]
    return numbers[order], run.fields[f"{grid}/points"][:][order], values.reshape(len(values), -1)[order]


def on_common(runs, grid, name):
    """Values of each run at the vertices of the coarsest mesh; None where the meshes do not share them. Numbers beyond those of the
    vertices are copies of some, one for each layer that meets there; they are left out."""
    tables = [_ordered(run, grid, name) for run in runs]
    numbers, points, _ = min(tables, key=lambda table: len(table[0]))
    extent = np.ptp(points, axis=0).max()
    found, is_shared = [], np.ones(len(numbers), dtype=bool)
    for its_numbers, its_points, values in tables:
        place = np.minimum(np.searchsorted(its_numbers, numbers), len(its_numbers) - 1)
        is_shared &= np.abs(its_points[place] - points).max(axis=1) <= SAME_PLACE * extent
        found.append(values[place])
    return np.array(found)[:, is_shared] if is_shared.mean() > LEAST_SHARED else None


def rows_of(results, folder_of, text):
    """A row for each field: its root mean square, and those of the errors."""
    if text == "none":
        return []
    try:
        runs = {job: Run(folder_of(job)) for job in results.jobs}
    except BadRun as error:
        raise BadInput(str(error)) from None
    rows = []
    for grid, name in chosen(runs[results.base], text):
        parts = {cause: _part(results, runs, cause, grid, name) for cause in CAUSES}
        size = rms(_ordered(runs[results.base], grid, name)[2])
        rows.append(Row(f"{grid}: {name}", OF_FIELD, Budget(size, parts), size))
    return rows


def rms(vectors):
    return float(np.sqrt(np.square(vectors).sum(axis=1).mean()))


def _part(results, runs, cause, grid, name):
    """The root mean square of the errors over the vertices, which is not the error of the root mean square. Only outputs of the same
    time, and meshes that share vertices, are compared."""
    if results.is_exact(cause):
        return richardson.exact()
    levels = [job for job in results.levels(cause) if runs[job].outputs and _is_same_time(runs[job], runs[results.base])]
    values = on_common([runs[job] for job in levels], grid, name) if len(levels) > 1 and results.base in levels else None
    if values is None:
        return richardson.missing()
    theory = results.case.time_theory() if cause == STEP else results.theory(cause, name)
    error, band, part = richardson.of_curves([job.size for job in levels], values.reshape(len(levels), -1), theory)
    shape = values.shape[1:]
    return richardson.Part(rms(error.reshape(shape)), rms(band.reshape(shape)), part.order, part.how)


def _is_same_time(run, other):
    one, two = run.outputs[-1][0], other.outputs[-1][0]
    return run is other or abs(one - two) <= 1e-6 * max(abs(two), 1e-300)
