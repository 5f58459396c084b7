"""The last beat of a vessel: its openings, and what flowed through them under which pressure, from steps.csv."""
import numpy as np

from report import case_tables

WHOLE = 1 - 1e-6  # part of a period that counts as one


class Beat:
    """period and times [ms], and by opening flow into the fluid [mm^3/ms] and pressure [kPa], None where it is not known.
    Arrays begin with the end of the beat before, where the run has it."""

    def __init__(self, steps, period):
        self.steps, self.period = steps, period
        times = np.array(steps["time"], dtype=float)
        self.end = float(times[-1])
        self.start = max(self.end - period, 0.0)
        self._kept = times >= self.start - 1e-6 * period
        self.times = times[self._kept]
        self.flows = {name: self.of(column) for name, column in _columns(steps).items()}
        self.pressures = {name: self.of(self.pressure_column(name)) for name in self.flows}
        mean = {name: self.mean(flow) for name, flow in self.flows.items()}
        self.inlet = max(mean, key=mean.get, default=None)
        self.outlets = [name for name in mean if name != self.inlet]

    def of(self, column, whole=False):
        """A column of steps.csv in this beat, or in the whole run; None without it."""
        values = self.steps.get(column)
        if values is None or not all(isinstance(v, float) for v in values):
            return None
        values = np.array(values)
        return values if whole else values[self._kept]

    def pressure_column(self, name):
        """Of an opening: behind a Windkessel that which it gives, else the mean over the opening, which may be missing."""
        given = f"pressure_{name}_kPa"
        return f"mean_{given}" if self.of(given, whole=True) is None else given

    def is_whole(self):
        return self.times[-1] - self.times[0] > WHOLE * self.period - self.longest_step()

    def longest_step(self):
        return float(np.diff(self.times).max())

    def mean(self, values):
        return float(case_tables.integral(values, self.times) / np.ptp(self.times))

    def openings(self):
        return [self.inlet, *self.outlets]


def _columns(steps):
    """Columns of flow by opening."""
    return {m.group(1): column for column in steps if (m := case_tables.FLOW.match(column))
            and all(isinstance(v, float) for v in steps[column])}


def of_run(run, case, told):
    """None where the run is no vessel with a beat: no load has a period, or no flow has a pressure. The first beat of
    tunica-vessel has a curve of its own, with another period than it tells."""
    period = told.get("period") or case_tables.period(case)
    if period is None or len(run.steps.get("time", [])) < 4 or len(_columns(run.steps)) < 2:
        return None
    beat = Beat(run.steps, period)
    if len(beat.times) < 4 or beat.mean(beat.flows[beat.inlet]) <= 0 or beat.pressures[beat.inlet] is None:
        return None
    return beat


def foot(times, values, since):
    """When a pulse arrives [ms]: where the tangent at its steepest rise from `since` on meets the least value of half a
    period before. times may begin earlier."""
    from scipy.interpolate import CubicSpline
    curve = CubicSpline(times, values)
    fine = np.linspace(times[0], times[-1], 20 * len(times))
    slope = np.where(fine >= since, curve(fine, 1), -np.inf)
    steepest = int(slope.argmax())
    half = 0.5 * (times[-1] - since)
    before = (fine <= fine[steepest]) & (fine >= fine[steepest] - half)
    return float(fine[steepest] - (curve(fine[steepest]) - curve(fine[before]).min()) / slope[steepest])


def arrivals(beat):
    """The foot of the pressure at each opening [ms]; half a beat before it is looked at, where the run has it."""
    times = beat.of("time", whole=True)
    kept = times >= beat.start - 0.5 * beat.period
    found = {}
    for name in beat.openings():
        values = beat.of(beat.pressure_column(name), whole=True)
        found[name] = None if values is None or np.ptp(values[kept]) == 0 else foot(times[kept], values[kept], beat.start)
    return found
