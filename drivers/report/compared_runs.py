"""Several ordinary runs side by side: their curves, what they end with, how far they are apart, and in which parameters
they differ."""
import os
from itertools import zip_longest

import numpy as np
from matplotlib import pyplot as plt

from report.canvas import Figure, readable, save
from report.case_tables import FLOW, parameters, read_case
from report.curve_figures import BOOKKEEPING, PRESSURE, PROBES
from report.run_data import BadRun

MOST_PANELS = 16


class ComparedRuns:
    """names: of the folders, as short as tells them apart."""

    def __init__(self, runs):
        self.runs = runs
        for run in runs:
            if not run.steps.get("time"):
                raise BadRun(f"{run.folder} has no finished step in steps.csv; there are no curves to compare")
        ends = [os.path.basename(os.path.abspath(run.folder)) for run in runs]
        self.names = ends if len(set(ends)) == len(ends) else [run.folder for run in runs]
        self.begin, self.end = max(r.steps["time"][0] for r in runs), min(r.steps["time"][-1] for r in runs)
        self.columns = self._columns()
        if not self.columns:
            raise BadRun(f"{runs[0].folder} and {runs[1].folder} have no physical column of steps.csv in common")

    def _columns(self):
        """Physical quantities of all runs; flows, pressures and probes first."""
        def is_curve(run, name):
            values = run.steps.get(name, [])
            return all(isinstance(v, float) for v in values) and np.isfinite(values).any()

        first = (FLOW, PRESSURE, *PROBES.values())
        rank = lambda name: next((i for i, p in enumerate(first) if p.match(name)), len(first))  # noqa: E731
        names = [n for n in self.runs[0].steps if n not in BOOKKEEPING and not n.endswith(("_newton", "_linear"))]
        return sorted((n for n in names if all(is_curve(run, n) for run in self.runs)), key=rank)

    def at(self, run, name, times):
        """Between its steps a curve is a straight line."""
        return np.interp(times, run.steps["time"], run.steps[name])

    def apart(self, run, name):
        """The largest distance from the first run while both last, over the range of the first run."""
        times = np.array(self.runs[0].steps["time"])
        times = times[(times >= self.begin) & (times <= self.end)]
        values, others = (self.at(one, name, times) for one in (self.runs[0], run))
        known = np.isfinite(values) & np.isfinite(others)
        if not known.any():
            return float("nan")
        distance = np.abs(others - values)[known].max()
        extent = max(np.ptp(values[known]), 1e-9 * np.abs(values[known]).max())  # round-off alone is no range
        return 100 * distance / extent if extent > 0 else 0.0 if distance == 0 else float("nan")

    def table(self):
        """Heading, and a row for each column."""
        heading = [f"at {self.end:g} ms"] + self.names + [f"{name}: apart, %" for name in self.names[1:]]
        rows = [[readable(n)] + [float(self.at(run, n, self.end)) for run in self.runs]
                + [self.apart(run, n) for run in self.runs[1:]] for n in self.columns]
        return heading, rows

    def other_parameters(self):
        """Rows of list and key with the value of each run, where they are not all the same."""
        cases = [{(heading, key): value for heading, rows in parameters(read_case(run.folder)) for key, value in rows}
                 for run in self.runs]
        keys = dict.fromkeys(key for case in cases for key in case)
        values = {key: [case.get(key, "–") for case in cases] for key in keys}
        return [[" / ".join(key)] + found for key, found in values.items() if len(set(found)) > 1]


def curves(compared):
    """A panel for each quantity, a curve for each run."""
    names = compared.columns[:MOST_PANELS]
    across = 1 if len(names) == 1 else 2
    canvas, grid = plt.subplots(-(-len(names) // across), across, sharex=True, squeeze=False, layout="constrained",
                                figsize=(5.2 * across, 2.5 * -(-len(names) // across) + 0.8))
    for axes, name in zip_longest(grid.flat, names):
        if name is None:
            axes.set_visible(False)
            continue
        for i, (run, label) in enumerate(zip(compared.runs, compared.names)):
            axes.plot(run.steps["time"], run.steps[name], color=plt.get_cmap("tab10")(i % 10),
                      linestyle=("-", "--", ":", "-.")[i % 4], label=label)
        axes.set_title(readable(name))
        axes.ticklabel_format(axis="y", scilimits=(-3, 4))
    for axes in grid[-1]:
        axes.set_xlabel("time [ms]")
    grid[0, 0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.12), ncol=min(4, len(compared.names)))
    left_out = len(compared.columns) - len(names)
    return canvas, Figure("curves.png", "Curves of all runs", "What all runs have in steps.csv, at the end of each step."
                          + (f" {left_out} more are in the table below." if left_out else ""))


def draw_all(compared, folder):
    return save([lambda: curves(compared)], folder)
