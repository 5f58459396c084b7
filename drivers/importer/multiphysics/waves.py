"""Values that depend on time: files of times and values, of which svMultiPhysics keeps so many Fourier coefficients, and
files of such coefficients.

  q(t) = q_0 + s τ + Σ_k r_k cos(2πkτ/T) − i_k sin(2πkτ/T),   τ = (t − t_0) mod T,   k = 0 .. n − 1

  q_0, s   first value, and slope from the first to the last one: zero where the curve closes
  r_k, i_k coefficients of the rest, of the piecewise linear curve through the points
"""
import dataclasses

import numpy as np

from ..case_writer import Sublist
from ..raw import BadMesh

CLOSED = 1e-6   # jump between last and first value, over the range of the curve, that is none
POINTS = 16     # of a table for each harmonic, at least 200 in all


@dataclasses.dataclass
class Wave:
    """In the units of their case."""
    start: float
    period: float
    first: float
    slope: float
    real: np.ndarray
    imaginary: np.ndarray
    is_ramp: bool = False

    def at(self, times):
        """Of times since the start, within the period."""
        k = np.arange(len(self.real))
        angle = 2.0 * np.pi * np.outer(times, k) / self.period
        return self.first + self.slope * times + np.cos(angle) @ self.real - np.sin(angle) @ self.imaginary

    def closes(self):
        return abs(self.slope * self.period) <= CLOSED * max(np.abs(self.real).sum() + abs(self.first), 1e-300)

    def entries(self, time):
        """The list Amplitude. time: theirs in ms."""
        if self.is_ramp:
            return Sublist([("kind", "table"), ("times", [time * self.start, time * (self.start + self.period)]),
                            ("values", [self.first, self.first + self.slope * self.period])])
        if self.closes():
            return self.fourier(time)
        times = np.linspace(0.0, self.period, max(200, POINTS * len(self.real)) + 1)
        return Sublist([("kind", "table"), ("period", time * self.period),
                        ("times", (time * (self.start + times)).tolist()), ("values", self.at(times).tolist())])

    def fourier(self, time):
        """cos(w(t − t_0)) and sin(w(t − t_0)) are turned into those of t."""
        k = np.arange(1, len(self.real))
        angle = 2.0 * np.pi * k * self.start / self.period
        r, i = self.real[1:], self.imaginary[1:]
        cosines = r * np.cos(angle) + i * np.sin(angle)
        sines = r * np.sin(angle) - i * np.cos(angle)
        entries = [("kind", "fourier"), ("period", time * self.period, "ms"), ("mean", float(self.first + self.real[0]))]
        if len(k):
            entries += [("cosines", cosines.tolist()), ("sines", sines.tolist())]
        return Sublist(entries)


def rows_of(path):
    """(number of the line, its numbers)."""
    try:
        with open(path, encoding="utf-8-sig") as file:
            lines = file.read().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise BadMesh(f"{path}: cannot be read as a file of values: {error}") from error
    rows = []
    for number, line in enumerate(lines, 1):
        try:
            values = [float(word) for word in line.split()]
        except ValueError:
            raise BadMesh(f'{path}:{number}: "{line.strip()}", expected numbers') from None
        if values:
            rows.append((number, values))
    if not rows:
        raise BadMesh(f"{path}: holds no values")
    return rows


def of_points(path, is_ramp):
    """A first line with the number of points and that of coefficients, then a time and a value on each."""
    (_, head), *rows = rows_of(path)
    if len(head) != 2 or head[0] < 2 or head[1] < 1:
        raise BadMesh(f"{path}:1: expected the number of points, at least 2, and that of Fourier coefficients, at least 1")
    for number, values in rows:
        if len(values) != 2:
            raise BadMesh(f"{path}:{number}: {len(values)} numbers, expected a time and a value")
    count = int(head[0])
    if len(rows) < count:
        raise BadMesh(f"{path}: {len(rows)} points, while its first line says {count}")
    t, q = np.array([values for _, values in rows[:count]]).T
    if (np.diff(t) <= 0.0).any():
        raise BadMesh(f"{path}:{rows[int(np.flatnonzero(np.diff(t) <= 0.0)[0]) + 1][0]}: the time does not increase")
    return through(t, q, 1 if is_ramp else int(head[1]), is_ramp)


def through(t, q, count, is_ramp=False):
    """Coefficients of the piecewise linear curve; exact integrals over each piece."""
    period = t[-1] - t[0]
    tau, slope = t - t[0], (q[-1] - q[0]) / period
    rest = q - q[0] - slope * tau
    k = np.arange(1, count)[:, None]
    angle = 2.0 * np.pi * k * tau / period
    steep = np.diff(rest) / np.diff(tau)
    factor = period / (2.0 * np.pi ** 2 * k[:, 0] ** 2)
    mean = (0.5 * np.diff(tau) * (rest[1:] + rest[:-1])).sum() / period
    real = factor * (steep * np.diff(np.cos(angle), axis=1)).sum(axis=1)
    imaginary = -factor * (steep * np.diff(np.sin(angle), axis=1)).sum(axis=1)
    return Wave(float(t[0]), float(period), float(q[0]), float(slope), np.concatenate([[mean], real]),
                np.concatenate([[0.0], imaginary]), is_ramp)


def of_coefficients(path):
    """Start and period; first value and slope; the number of coefficients; real and imaginary part of each."""
    values = [row for _, row in rows_of(path)]
    flat = [len(row) for row in values]
    if len(values) < 3 or flat[:2] != [2, 2] or flat[2] != 1 or len(values) < 3 + values[2][0] or set(flat[3:]) - {2}:
        raise BadMesh(f"{path}: expected lines with start and period, first value and slope, the number of coefficients, and "
                      "two numbers for each")
    (start, period), (first, slope), (count,) = values[:3]
    if period <= 0.0:
        raise BadMesh(f"{path}:1: the period is {period:g}, expected more than 0")
    real, imaginary = np.array(values[3:3 + int(count)]).T
    return Wave(start, period, first, slope, real, imaginary)
