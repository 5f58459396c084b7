"""The errors of all columns and fields, from the runs that have come to their end."""
from dataclasses import dataclass

import numpy as np

from . import quantities, richardson
from .plan import BEAT, MESH, SOLVER, STEP
from .quantities import Curves
from .richardson import Budget, Theory

CAUSES = (MESH, STEP, SOLVER)
OF_TOLERANCES = Theory(1, 0.5)
MOST_BEATS = 3  # at the end of the run


@dataclass
class Curve:
    """A column of the case with its band over time."""
    name: str
    times: np.ndarray
    values: np.ndarray
    error: np.ndarray
    band: np.ndarray
    orders: dict  # cause -> Part


@dataclass
class Row:
    """A quantity of a column, or a field."""
    name: str
    quantity: str
    budget: Budget
    scale: float


class Results:
    """jobs: those that are done; the first is the case."""

    def __init__(self, case, jobs, folder_of, period):
        self.case, self.period, self.base = case, period, jobs[0]
        self.curves_of = {job: Curves(folder_of(job)) for job in jobs}
        mine = self.curves_of[self.base]
        self.times = mine.times
        self.too_short = [job for job in jobs if not case.is_steady and self._ends_before(job)]
        self.jobs = [job for job in jobs if job not in self.too_short]
        if period is not None and period > mine.times[-1] * (1 + quantities.SAME):
            self.period = None  # the run is shorter than a beat
        self.scales = quantities.scales(mine)
        self.names = sorted((name for name in mine.columns if all(name in c.columns for c in self.curves_of.values())),
                            key=quantities.rank)
        self.curves, self.rows = [], []
        for name in self.names:
            self.curves.append(self._curve(name))
            self.rows += self._rows(name)

    def _ends_before(self, job):
        """Steps of their own may end a run elsewhere, where their number is bounded."""
        return self.curves_of[job].times[-1] < self.times[-1] * (1 - quantities.SAME)

    def levels(self, cause):
        """The jobs of a cause with the case, coarse first."""
        return sorted([self.base] + [job for job in self.jobs if job.cause == cause], key=lambda job: -job.size)

    def theory(self, cause, name):
        return {MESH: quantities.mesh_theory(name), STEP: self.case.time_theory(), SOLVER: OF_TOLERANCES}[cause]

    def is_exact(self, cause):
        return cause == STEP and not self.case.varies_in_time()

    def noise(self, name):
        """Of the solvers, beneath which differences say nothing of mesh or step."""
        levels = self.levels(SOLVER)
        floor = quantities.ROUND_OFF * self.scales[name]
        if len(levels) < 2:
            return floor
        values = [self._at(job, name) for job in levels]
        return floor + float(np.abs(values[0] - values[1]).max())

    def _on_base(self, cause, name):
        levels = self.levels(cause)
        return [job.size for job in levels], [self._at(job, name) for job in levels]

    def _at(self, job, name):
        """Where runs have steps of their own, as in pseudo-time, only their ends are comparable."""
        curves = self.curves_of[job]
        if self.case.is_steady:
            return curves.columns[name][-1:]
        return curves.at(name, self.times)

    def _curve(self, name):
        times, values = (self.times[-1:] if self.case.is_steady else self.times), self._at(self.base, name)
        error, band, orders = np.zeros(len(times)), np.full(len(times), quantities.ROUND_OFF * self.scales[name]), {}
        for cause in CAUSES:
            if self.is_exact(cause):
                orders[cause] = richardson.exact()
                continue
            sizes, curves = self._on_base(cause, name)
            of_cause = richardson.of_curves(sizes, curves, self.theory(cause, name))
            orders[cause] = of_cause[2]
            if of_cause[2].how != richardson.MISSING:
                error, band = error + of_cause[0], band + of_cause[1]
        if self.period is not None and quantities.beats(self.times, self.period) > 1:
            band = band + self._change_of_beat(name)
        return Curve(name, times, values, error, richardson.around(band), orders)

    def _change_of_beat(self, name):
        """Largest change of the curve since the beat before, in the last one; it bounds what settling still does there."""
        last = self.times[quantities.window(self.times, self.period)]
        last = last[last - self.period >= self.times[0]]
        mine = self.curves_of[self.base]
        change = np.abs(mine.at(name, last) - mine.at(name, last - self.period)).max()
        return np.where(self.times > self.times[-1] - self.period * (1 + quantities.SAME), change, 0.0)

    def _rows(self, name):
        mine = self._at(self.base, name)
        times = self.times[-len(mine):]
        found = []
        for quantity in quantities.wanted(name, times, mine, self.period, self.scales[name], self.case.varies_in_time()):
            parts = {cause: self._part(cause, name, quantity) for cause in CAUSES}
            if self.period is not None:
                parts[BEAT] = self._settling(name, quantity)
            value = quantities.value_of(quantity, times, mine, self.period)
            found.append(Row(name, quantity, Budget(value, parts, quantities.ROUND_OFF * self.scales[name]), self.scales[name]))
        return found

    def _part(self, cause, name, quantity):
        if self.is_exact(cause):
            return richardson.exact()
        levels = self.levels(cause)
        values = [self._value(job, name, quantity) for job in levels]
        noise = 0.0 if cause == SOLVER else self.noise(name)
        part = richardson.estimate([job.size for job in levels], values, self.theory(cause, name), noise)
        if cause == STEP and len(levels) > 1:
            missed = quantities.between_steps(quantity, self.curves_of[levels[-1]], name, self.times, self.period)
            part.band += missed
            part.error -= missed if quantity == quantities.GREATEST else -missed
        return part

    def _settling(self, name, quantity):
        """From the last beats of the case, three at most."""
        values = self._at(self.base, name)
        ago = range(min(quantities.beats(self.times, self.period), MOST_BEATS) - 1, -1, -1)
        part = richardson.settling([quantities.value_of(quantity, self.times, values, self.period, beats) for beats in ago])
        return part if part.band > quantities.ROUND_OFF * self.scales[name] or part.how == richardson.MISSING else richardson.exact()

    def causes(self):
        return CAUSES if self.period is None else (*CAUSES, BEAT)

    def _value(self, job, name, quantity):
        """Means take all steps of a run, extrema those at which the case has one."""
        curves = self.curves_of[job]
        if quantity == quantities.MEAN:
            return quantities.value_of(quantity, curves.times, curves.columns[name], self.period)
        values = self._at(job, name)
        return quantities.value_of(quantity, self.times[-len(values):], values, self.period)
