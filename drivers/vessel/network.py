"""A linear network of the vessel and of what lies behind it, and its state in a beat that repeats itself.

  nodes     C dp/dt = sum of the flows into the node (+ Q(t) at the inlet)
  branches  L dq/dt = p_start - p_end - R q
  outlets   q = (p - p_c)/R_p,   C dp_c/dt = q - (p_c - p_d)/R_d        (three-element Windkessel)

together  E dx/dt + K x = f(t),  x = (p of nodes, q of branches, p_c of outlets).

The network is linear and Q periodic: each harmonic of Q has its own solution (i w E + K) x = f, so that the periodic state is
exact up to the harmonics left out. Nothing is marched. Units: kPa, mm^3/ms, ms.
"""
import dataclasses

import numpy as np

HARMONICS = 48
LEAST_PROXIMAL = 1e-7  # kPa ms/mm^3, so that q remains defined without a proximal resistance
SUBSTEPS = 16  # of a transient, between two values of the inflow
HALVINGS = 14  # a beat in 2^14 implicit steps


@dataclasses.dataclass
class Windkessel:
    """Resistances in kPa ms/mm^3, capacitance in mm^3/kPa, the pressure behind both in kPa."""
    proximal: float
    capacitance: float
    distal: float
    distal_pressure: float = 0.0


@dataclasses.dataclass
class Branch:
    """A piece of vessel between two nodes. Half of its compliance lies at each."""
    start: str
    end: str
    resistance: float  # kPa ms/mm^3
    inertance: float  # kPa ms^2/mm^3
    compliance: float  # mm^3/kPa


class Network:
    """branches, the node of the inlet, and a Windkessel for each outlet, by its node."""

    def __init__(self, branches, inlet, windkessels):
        self.branches, self.inlet, self.outlets = branches, inlet, list(windkessels)
        self.nodes = sorted({inlet, *self.outlets, *(b.start for b in branches), *(b.end for b in branches)})
        self.node = {name: k for k, name in enumerate(self.nodes)}
        self.set_windkessels(windkessels)

    def set_windkessels(self, windkessels):
        n, m, k = len(self.nodes), len(self.branches), len(self.outlets)
        self.windkessels = dict(windkessels)
        self.E, self.K, self.constant = np.zeros((n + m + k,) * 2), np.zeros((n + m + k,) * 2), np.zeros(n + m + k)
        for j, branch in enumerate(self.branches, n):
            self._add_branch(j, branch)
        for j, name in enumerate(self.outlets, n + m):
            self._add_windkessel(j, self.node[name], self.windkessels[name])

    def _add_branch(self, j, branch):
        start, end = self.node[branch.start], self.node[branch.end]
        self.E[start, start] += 0.5 * branch.compliance
        self.E[end, end] += 0.5 * branch.compliance
        self.K[start, j], self.K[end, j] = 1.0, -1.0  # q leaves the start
        self.E[j, j], self.K[j, j] = branch.inertance, branch.resistance
        self.K[j, start], self.K[j, end] = -1.0, 1.0

    def _add_windkessel(self, j, node, w):
        into = 1.0 / max(w.proximal, LEAST_PROXIMAL)
        self.K[node, node] += into
        self.K[node, j] -= into
        self.K[j, node], self.K[j, j] = -into, into + 1.0 / w.distal
        self.E[j, j], self.constant[j] = w.capacitance, w.distal_pressure / w.distal

    def circuits(self):
        """Places of p_c in x."""
        return slice(len(self.nodes) + len(self.branches), None)

    def flow_rows(self):
        """q of each outlet = rows @ x."""
        rows = np.zeros((len(self.outlets), len(self.K)))
        for i, name in enumerate(self.outlets):
            into = 1.0 / max(self.windkessels[name].proximal, LEAST_PROXIMAL)
            rows[i, self.node[name]], rows[i, len(self.nodes) + len(self.branches) + i] = into, -into
        return rows

    def periodic(self, inflow, period):
        """x at as many times of the beat as inflow has values, in rows."""
        Q = np.fft.rfft(inflow)
        count = min(HARMONICS + 1, len(Q))
        omega = 2j * np.pi * np.arange(count) / period
        drive = np.zeros((count, len(self.K)), dtype=complex)
        drive[:, self.node[self.inlet]] = Q[:count]
        drive[0] += self.constant * len(inflow)
        x = np.zeros((len(Q), len(self.K)), dtype=complex)
        x[:count] = np.linalg.solve(omega[:, None, None] * self.E + self.K, drive[..., None])[..., 0]
        return np.fft.irfft(x, len(inflow), axis=0)

    def monodromy(self, time):
        """What is left of a deviation from the periodic state after this time: by implicit Euler, which damps the stiff part, with
        2^14 steps multiplied by repeated squaring."""
        step = np.linalg.solve(self.E + time / 2 ** HALVINGS * self.K, self.E)
        return np.linalg.matrix_power(step, 2 ** HALVINGS)

    def settle(self, circuits):
        """x with these deviations of p_c to which the vessel has settled: no compliance, no inertance in it."""
        at = self.circuits().start
        x = np.zeros(len(self.K))
        x[at:] = circuits
        x[:at] = np.linalg.solve(self.K[:at, :at], -self.K[:at, at:] @ x[at:])
        return x

    def deviation(self, circuits, period, count):
        """x over a beat that begins with these deviations of p_c, at `count` times, and at its end: rows."""
        step = self.monodromy(period / count)
        x = [self.settle(circuits)]
        for _ in range(count):
            x.append(step @ x[-1])
        return np.array(x)

    def transient(self, x, period, source):
        """x over a beat from this deviation on, with deviations of the inflow: rows as of deviation(). By implicit Euler, in
        SUBSTEPS steps between two values of the source."""
        count = len(source)
        h = period / (count * SUBSTEPS)
        step, push = np.linalg.solve(self.E + h * self.K, self.E), np.zeros(len(self.K))
        push[self.node[self.inlet]] = h
        push = np.linalg.solve(self.E + h * self.K, push)
        closed, rows = np.append(source, 0.0), [x]
        for k in range(count):
            for part in np.arange(1, SUBSTEPS + 1) / SUBSTEPS:
                x = step @ x + push * ((1 - part) * closed[k] + part * closed[k + 1])
            rows.append(x)
        return np.array(rows)


@dataclasses.dataclass
class Beat:
    """What a beat is judged by: pressures at the inlet [kPa], share of the mean flow by outlet, p_c at both ends [kPa]."""
    systolic: float
    diastolic: float
    splits: dict
    circuits: dict
    circuits_end: dict


def beat_of(network, x, last=None):
    """From the rows of a beat; last is the state at its end, that of the beginning where it repeats itself."""
    p = x[:, network.node[network.inlet]]
    flow = (x @ network.flow_rows().T).mean(axis=0)
    end = x[0] if last is None else last
    return Beat(float(p.max()), float(p.min()), dict(zip(network.outlets, (flow / flow.sum()).tolist())),
                dict(zip(network.outlets, x[0, network.circuits()].tolist())),
                dict(zip(network.outlets, end[network.circuits()].tolist())))
