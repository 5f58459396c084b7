"""The inflow over a beat: built-in shapes, or the curve of a file. Flow in mm^3/ms (ml/s), time in ms.

The built-in shapes are drawn after the usual curves of W. W. Nichols and M. F. O'Rourke, "McDonald's Blood Flow in
Arteries" (2005): in the ascending aorta systole of a third of the beat and a short backflow when the valve closes; in
the carotid flow at all times with a second wave; in the left coronary artery most flow in diastole. They are of no one.
"""
import re

import numpy as np

from .errors import BadInput
from .units import L_PER_MIN

SAMPLES = 200  # of a beat in the file of the case
# Part of the beat -> flow, of any scale.
SHAPES = {
    "aorta": ((0, 0.0), (0.02, 0.05), (0.06, 0.45), (0.1, 0.88), (0.14, 1.0), (0.18, 0.95), (0.24, 0.7), (0.3, 0.38),
              (0.35, 0.1), (0.38, -0.06), (0.41, -0.02), (0.46, 0.01), (0.55, 0.01), (0.75, 0.0), (0.9, 0.0)),
    "carotid": ((0, 0.28), (0.03, 0.3), (0.08, 0.75), (0.12, 1.0), (0.17, 0.85), (0.23, 0.62), (0.3, 0.55), (0.36, 0.4),
                (0.4, 0.34), (0.45, 0.45), (0.52, 0.42), (0.65, 0.36), (0.8, 0.31), (0.92, 0.28)),
    "coronary": ((0, 0.5), (0.04, 0.35), (0.08, 0.25), (0.14, 0.42), (0.22, 0.48), (0.3, 0.4), (0.36, 0.38), (0.42, 0.7),
                 (0.48, 1.0), (0.55, 0.98), (0.68, 0.85), (0.82, 0.7), (0.94, 0.56)),
    "cerebral": ((0, 0.55), (0.03, 0.57), (0.08, 0.82), (0.13, 1.0), (0.18, 0.94), (0.25, 0.8), (0.32, 0.74), (0.38, 0.68),
                 (0.45, 0.7), (0.52, 0.68), (0.65, 0.63), (0.8, 0.58), (0.92, 0.555)),
}
TIME_UNITS = {"ms": 1.0, "s": 1000.0}
FLOW_UNITS = {"ml/s": 1.0, "mm3/ms": 1.0, "mm^3/ms": 1.0, "cm3/s": 1.0, "cm^3/s": 1.0, "l/min": L_PER_MIN, "ml/min": 1 / 60.0}


def periodic_spline(t, y, period, at):
    """The cubic through (t, y) with continuous second derivatives, also from the end of a period to its beginning."""
    n = len(t)
    h = np.diff(np.append(t, t[0] + period))
    slope = (np.roll(y, -1) - y) / h
    A = np.zeros((n, n))
    for i in range(n):
        A[i, i - 1] += h[i - 1]
        A[i, i] += 2 * (h[i - 1] + h[i])
        A[i, (i + 1) % n] += h[i]
    M = np.linalg.solve(A, 6 * (slope - np.roll(slope, 1)))
    at = (np.asarray(at) - t[0]) % period + t[0]
    k = np.searchsorted(t, at, side="right") - 1
    s = at - t[k]
    next_M = np.roll(M, -1)[k]
    first = slope[k] - h[k] * (2 * M[k] + next_M) / 6
    return y[k] + s * (first + s * (M[k] / 2 + s * (next_M - M[k]) / (6 * h[k])))


def built_in(shape, mean, period):
    t, y = np.array(SHAPES[shape]).T
    samples = periodic_spline(t, y, 1.0, np.arange(SAMPLES) / SAMPLES)
    return samples * mean / samples.mean(), period


def read_curve(path, heart_rate):
    """Samples over one period, and the period. The last row closes the beat and has the flow of the first."""
    rows, units = read_rows(path)
    if len(rows) < 5:
        raise BadInput(f"{path}: has {len(rows)} rows with a time and a flow, expected five or more over one beat")
    t, y = np.array(rows, dtype=float).T
    t, y = (t - t[0]) * units[0], y * units[1]
    if (np.diff(t) <= 0).any():
        raise BadInput(f"{path}: row {int(np.argmax(np.diff(t) <= 0)) + 2}: times must grow")
    if t[-1] < 50:
        raise BadInput(f"{path}: spans {t[-1]:g} ms. Are these seconds? Begin the file with a line: time s, flow ml/s")
    period = t[-1]
    if abs(y[-1] - y[0]) > 0.05 * np.ptp(y):
        if not heart_rate:
            raise BadInput(f"{path}: the last row has the flow {y[-1]:.4g}, the first {y[0]:.4g} ml/s. The last row closes "
                           "the beat: repeat the first flow there, or give --heart-rate")
        period = 60000.0 / heart_rate
        if period <= t[-1]:
            raise BadInput(f"{path}: spans {t[-1]:g} ms, more than a beat of {period:g} ms by --heart-rate")
    else:
        t, y = t[:-1], y[:-1]
    if y.mean() <= 0:
        raise BadInput(f"{path}: the mean flow is not positive; flow into the vessel counts as positive")
    samples = periodic_spline(t, y, period, np.arange(SAMPLES) * period / SAMPLES)
    return (samples, 60000.0 / heart_rate) if heart_rate else (samples, period)


def read_rows(path):
    """Pairs of numbers, and the factors to ms and ml/s that a heading names."""
    rows, units = [], [1.0, 1.0]
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            words = [word for word in re.split(r"[,;\s]+", line.split("#")[0].strip()) if word]
            if not words:
                continue
            try:
                rows.append((float(words[0]), float(words[1])))
            except (ValueError, IndexError):
                if rows:
                    raise BadInput(f"{path}: line {number}: \"{line.strip()}\", expected a time and a flow") from None
                units = units_in(path, line)
    return rows, units


def units_in(path, heading):
    """Units in a heading such as "time [s], flow [ml/s]" or "t_ms,q_ml/s"."""
    words = re.split(r"[\s,;_()\[\]]+", heading.lower().lstrip("\ufeff"))
    time = [TIME_UNITS[word] for word in words if word in TIME_UNITS]
    flow = [FLOW_UNITS[word] for word in words if word in FLOW_UNITS]
    if len(time) > 1 or len(flow) > 1:
        raise BadInput(f"{path}: its heading \"{heading.strip()}\" names several units")
    return [time[0] if time else 1.0, flow[0] if flow else 1.0]


def foot_first(samples):
    """The curve from the end of diastole on, the foot of its largest wave, where the flow is least before it rises: the
    run starts there from rest."""
    peak = int(np.argmax(samples))
    low, k = samples.min() + 0.3 * np.ptp(samples), peak
    while samples[k] > low or samples[k - 1] < samples[k]:
        k -= 1
        if peak - k > len(samples):
            break
    return np.roll(samples, -k)


def inflow(options, wall):
    """Samples [ml/s] over a beat from the end of diastole on, the period [ms], and where they come from."""
    period = 60000.0 / (options.heart_rate or 75.0)
    try:
        mean = wall["flow"] if options.flow is None else float(options.flow)
    except ValueError:
        samples, period = read_curve(options.flow, options.heart_rate)
        told = f"the curve of {options.flow}"
        if options.mean_flow:
            samples = samples * options.mean_flow * L_PER_MIN / samples.mean()
            told += f", scaled to {options.mean_flow:g} l/min"
        return foot_first(samples), period, told
    samples, period = built_in(wall["shape"], mean * L_PER_MIN, period)
    told = f"built-in shape \"{wall['shape']}\" with a mean of {mean:g} l/min"
    return foot_first(samples), period, told + (", assumed" if options.flow is None else "")
