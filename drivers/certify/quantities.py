"""What is told of a column of steps.csv: its last value, its extrema, and where the loads have a period its mean over a beat."""
import re

import numpy as np

from report.case_tables import FLOW, integral
from report.curve_figures import BOOKKEEPING, PRESSURE, PROBES
from report.run_data import BadRun, read_table
from vessel.errors import BadInput

from .richardson import Theory

LAST, GREATEST, LEAST, MEAN = "last", "greatest", "least", "mean"
# Extrema in space, and what vanishes with the mesh: no theory has an order for them.
LOCAL = re.compile(r"^(?:max|min)_|pressure_(?:min|max)_kPa|stabilisation|divergence|backflow")
# Of first order in the mesh: what is made of derivatives. All else is of second, powers and energies, too, in which derivatives are
# squared.
DERIVED = re.compile(r"shear|stress|von_mises|viscous_force|wall_force|drag|lift")
SAME = 1e-6        # part of a step within which two times are one
FEW = 4            # steps that are no curve
SMOOTH = 3.0       # a smooth peak has 4 times as large second differences at twice the step, a kink has 2
ROUND_OFF = 1e-11  # of the largest value of a column's kind


def mesh_theory(column):
    if LOCAL.search(column):
        return None
    return Theory(1, 0.75) if DERIVED.search(column) else Theory(2, 1)


class Curves:
    """The columns of a run."""

    def __init__(self, folder):
        try:
            table = read_table(folder, "steps.csv")
        except BadRun as error:
            raise BadInput(str(error)) from None
        if not table.get("time"):
            raise BadInput(f"{folder}/steps.csv has no step")
        is_known = lambda values: all(isinstance(v, float) for v in values) and np.isfinite(values).all()  # noqa: E731
        self.times = np.array(table["time"])
        self.columns = {name: np.array(values) for name, values in table.items() if name not in BOOKKEEPING
                        and not name.endswith(("_newton", "_linear")) and is_known(values)}
        self.seconds = float(np.sum(table["seconds"]))

    def at(self, name, times):
        """At other times. Where a step ends there it is that value, otherwise that of a parabola through the three nearest."""
        values = self.columns[name]
        if len(self.times) < 3:
            return np.interp(times, self.times, values)
        nearest = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        nearest -= (times - self.times[nearest - 1]) < (self.times[nearest] - times)
        step = np.diff(self.times).min()
        middle = np.clip(nearest, 1, len(self.times) - 2)
        there = _parabola(self.times, values, middle, times)
        return np.where(abs(self.times[nearest] - times) < SAME * step, values[nearest], there)


def _parabola(x, y, i, at):
    """Lagrange's through points i - 1, i, i + 1."""
    a, b, c = x[i - 1], x[i], x[i + 1]
    return (y[i - 1] * (at - b) * (at - c) / ((a - b) * (a - c)) + y[i] * (at - a) * (at - c) / ((b - a) * (b - c))
            + y[i + 1] * (at - a) * (at - b) / ((c - a) * (c - b)))


def kind_of(column):
    """Columns that are alike share their round-off: components of a vector, all of one unit and first word."""
    words = column.split("_")
    unit = "kPa" if column.endswith("_kPa") else words[-1]
    return words[0], "force" in column, unit


def scales(curves):
    """Column -> the largest magnitude of its kind."""
    found = {}
    for name, values in curves.columns.items():
        found[kind_of(name)] = max(found.get(kind_of(name), 0.0), float(np.abs(values).max()))
    return {name: found[kind_of(name)] for name in curves.columns}


def rank(column):
    """Flows, pressures and probes come first."""
    first = (FLOW, PRESSURE, *PROBES.values())
    return next((i for i, pattern in enumerate(first) if pattern.match(column)), len(first))


def wanted(column, times, values, period, scale, is_history=True):
    """The quantities of a column, of its curve in the case; only the last one where its steps are no history but a way to the end."""
    found = [LAST]
    if not is_history or len(times) < FEW or np.ptp(values) <= ROUND_OFF * scale:
        return found
    kept = window(times, period)
    last = values[kept]
    # An extremum at the end of a run that has no period is its last value, and one at the first step no peak.
    is_inside = lambda i: period is not None or 0 < i < len(last) - 1  # noqa: E731
    found += [GREATEST] if is_inside(int(last.argmax())) and "_min_" not in column else []
    found += [LEAST] if is_inside(int(last.argmin())) and "_max_" not in column else []
    return found + ([MEAN] if period is not None else [])


def window(times, period, beats_ago=0):
    """The last period of a run, or one before; all of it where it has none or is shorter. At rest no step has ended."""
    if period is None:
        return np.ones(len(times), dtype=bool)
    end, slack = times[-1] - beats_ago * period, SAME * period
    return (times > end - period - slack) & (times < end + slack)


def value_of(quantity, times, values, period, beats_ago=0):
    if quantity == LAST:
        return float(values[-1] if beats_ago == 0 else np.interp(times[-1] - beats_ago * period, times, values))
    kept = window(times, period, beats_ago)
    if quantity == MEAN:
        return float(integral(values[kept], times[kept]) / np.ptp(times[kept]))
    return float(values[kept].max() if quantity == GREATEST else values[kept].min())


def beats(times, period):
    """How many whole periods a run has. The first one lacks its first step, that at rest."""
    return 0 if period is None else int((times[-1] - times[0]) / period + SAME) + (times[0] < period)


def between_steps(quantity, curves, name, times, period):
    """How far an extremum at the ends of the steps of the case misses that between them, by the run with the shortest steps.
    A smooth peak is that of a parabola; at a kink a parabola would overshoot."""
    if quantity not in (GREATEST, LEAST):
        return 0.0
    sign = 1.0 if quantity == GREATEST else -1.0
    kept = window(curves.times, period)
    fine = sign * curves.columns[name][kept]
    seen = (sign * curves.at(name, times))[window(times, period)].max()
    i = int(fine.argmax())
    peak = fine[i]
    if 1 < i < len(fine) - 2:
        second = fine[i - 1] - 2 * fine[i] + fine[i + 1]
        wide = fine[i - 2] - 2 * fine[i] + fine[i + 2]
        if second < 0 and wide / second > SMOOTH:
            slope = 0.5 * (fine[i + 1] - fine[i - 1])
            peak -= 0.5 * slope ** 2 / second
    return float(max(peak - seen, 0.0))
