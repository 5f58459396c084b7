"""The error of a number from what it is at several sizes of a mesh, of a time step or of the tolerances.

At size h (1 for the case itself, 1/2 with twice as many elements along each axis) a number is

  f(h) = f + c h^p,    so that with two sizes h1 > h2    f - f(h2) = (f(h2) - f(h1)) h2^p/(h1^p - h2^p)

and three sizes give p. The error of the case is its known distance from the finest f(h), and what remains there. The
remainder is what is uncertain. Safety factors are those of Roache's grid convergence index [Ro94]:

  |f(1) - f| <= G |f(1) - f(h_n)| + F |f(h_n) - f(h_n-1)| h_n^p/(h_n-1^p - h_n^p)

  G = 1.25   p observed, otherwise 1: there the second part is large
  F = 1.25   p observed, and as theory has it
  F = 3      p observed, but far from theory; or no p, neither observed nor of theory: then p = 1 stands for it
  F = 1      two sizes, and a p of theory: not that itself but the least that is plausible, which gives more
From four sizes on, f, c and p are those of least squares, and what is off the fit is added [EH14].
"""
from dataclasses import dataclass

import numpy as np

LEAST_ORDER, MORE = 0.5, 1.0            # what counts as an order: from the first one up to that of theory and so much
UNKNOWN = 2.0                           # stands for the order of theory there, where it has none
USUAL, CAREFUL = 1.25, 3.0              # safety factors
FAR = 0.5                               # from the order of theory
OBSERVED, ASSUMED, NO_ORDER, MISSING, EXACT = "observed", "assumed", "no order", "not estimated", "none"
OBSERVED_DECAY = "settles"


@dataclass
class Theory:
    """order: of theory; least: that is plausible where none can be observed."""
    order: float
    least: float


@dataclass
class Part:
    """What one cause does to a number: error (of the case, with its sign), a bound of it, and how both are known."""
    error: float
    band: float
    order: float = float("nan")
    how: str = OBSERVED

    def text(self):
        """The order in a word."""
        if self.how == OBSERVED:
            return f"{self.order:.1f}"
        return f"({self.order:.0f})" if self.how == ASSUMED else self.how


def missing():
    return Part(0.0, float("nan"), how=MISSING)


def exact():
    return Part(0.0, 0.0, how=EXACT)


def ratio_of(p, sizes):
    """(f1 - f2)/(f2 - f3) of an order."""
    a, b, c = sizes
    return (a ** p - b ** p) / (b ** p - c ** p)


def greatest_order(theory):
    return (theory.order if theory else UNKNOWN) + MORE


def order_of_ratio(ratio, sizes, theory):
    """The order with this ratio of the differences at three sizes, coarse first; nan where it is none. An order far beyond theory is no
    good news: the last difference is small by chance."""
    low, high = LEAST_ORDER, greatest_order(theory)
    if not ratio_of(low, sizes) < ratio < ratio_of(high, sizes):
        return float("nan")
    for _ in range(60):
        p = 0.5 * (low + high)
        low, high = (p, high) if ratio_of(p, sizes) < ratio else (low, p)
    return 0.5 * (low + high)


def remainder(p, sizes):
    """f - f(finest) in parts of the last difference."""
    coarser, finest = sizes[-2:]
    return finest ** p / (coarser ** p - finest ** p)


def safety(p, theory):
    return USUAL if theory and abs(p - theory.order) <= FAR else CAREFUL


def fitted(sizes, values, theory):
    """f, p and the standard deviation of the fit f + c h^p; the order is nan where none of those that count fits best."""
    best = (np.inf, 0.0, float("nan"))
    orders = np.linspace(LEAST_ORDER, greatest_order(theory), 251)
    for p in orders:
        parts = np.stack([np.ones(len(sizes)), sizes ** p], 1)
        answer = np.linalg.lstsq(parts, values, rcond=None)[0]
        best = min(best, (float(np.square(parts @ answer - values).sum()), float(answer[0]), float(p)))
    at_end = best[2] in (orders[0], orders[-1])
    return best[1], float("nan") if at_end else best[2], np.sqrt(best[0] / (len(sizes) - 3))


def estimate(sizes, values, theory, noise=0.0):
    """sizes: coarse first, the case has 1; noise: differences up to this tell nothing."""
    sizes, values = np.asarray(sizes, dtype=float), np.asarray(values, dtype=float)
    if len(sizes) < 2 or not np.isfinite(values).all():
        return missing()
    mine = values[np.argmin(abs(sizes - 1.0))]
    known, last = mine - values[-1], values[-1] - values[-2]
    if np.ptp(values) <= noise:
        return Part(0.0, noise, how=EXACT)
    if len(sizes) == 2 and theory is None:
        return _without_order(known, values, sizes, noise)
    if len(sizes) == 2:
        limit = values[-1] + last * remainder(theory.order, sizes)
        return Part(mine - limit, abs(known) + abs(last) * remainder(theory.least, sizes), theory.order, ASSUMED)
    if len(sizes) > 3 and np.ptp(values) > 2 * noise:
        return _by_fit(sizes, values, mine, theory)
    three = sizes[-3:]
    before = values[-2] - values[-3]
    p = float("nan")
    if abs(before) > 2 * noise and abs(last) > 0:
        p = order_of_ratio(before / last, three, theory)
    if np.isnan(p):
        return _without_order(known, values, sizes, noise)
    used = min(p, theory.order) if theory else min(p, 1.0)
    rest = abs(last) * remainder(used, sizes)
    limit = values[-1] + np.sign(last) * rest
    return Part(mine - limit, USUAL * abs(known) + safety(p, theory) * rest, p, OBSERVED)


def _without_order(known, values, sizes, noise):
    change = np.abs(np.diff(values[-3:])).max()  # a last one that is small by chance says nothing
    return Part(known, abs(known) + CAREFUL * change * remainder(1.0, sizes) + noise, float("nan"), NO_ORDER)


def _by_fit(sizes, values, mine, theory):
    limit, p, spread = fitted(sizes, values, theory)
    known = mine - values[-1]
    if np.isnan(p) or spread > np.ptp(values) / (len(values) - 1):
        return _without_order(known, values, sizes, 0.0)
    rest = abs(values[-1] - limit)
    return Part(mine - limit, USUAL * abs(known) + safety(p, theory) * rest + spread, p, OBSERVED)


def of_curves(sizes, curves, theory):
    """The same of a whole curve: values at common times in columns. One order for all of it, from root mean squares of the
    differences, which do not vanish where two curves cross. Returns error and band at each time, and the order as a Part."""
    sizes, curves = np.asarray(sizes, dtype=float), np.asarray(curves, dtype=float)
    if len(sizes) < 2:
        return np.zeros(curves.shape[1]), np.full(curves.shape[1], np.nan), missing()
    mine = curves[np.argmin(abs(sizes - 1.0))]
    known, last = mine - curves[-1], curves[-1] - curves[-2]
    p, factor, most = float("nan"), CAREFUL, theory.order if theory else 1.0
    if len(sizes) > 2:
        p = _order_of_curves(sizes[-3:], curves[-3:], theory)
    if not np.isnan(p):
        how, used, least, factor = OBSERVED, min(p, most), min(p, most), safety(p, theory)
    elif len(sizes) == 2 and theory:
        p, how, used, least, factor = theory.order, ASSUMED, theory.order, theory.least, 1.0
    else:
        how, used, least = NO_ORDER, None, 1.0
    error = known if used is None else known - last * remainder(used, sizes)
    change = np.abs(last) if used is not None else np.abs(np.diff(curves[-3:], axis=0)).max(axis=0)
    band = (USUAL if how == OBSERVED else 1.0) * np.abs(known) + factor * change * remainder(least, sizes)
    worst = int(np.argmax(np.abs(error)))
    return error, band, Part(float(error[worst]), float(band.max()), p, how)


def _order_of_curves(sizes, curves, theory):
    before, last = curves[1] - curves[0], curves[2] - curves[1]
    norms = np.linalg.norm(before), np.linalg.norm(last)
    if min(norms) == 0 or before @ last < 0.5 * norms[0] * norms[1]:  # the curve does not go on in the same direction
        return float("nan")
    return order_of_ratio(norms[0] / norms[1], sizes, theory)


def around(band):
    """The greatest of a few neighbours: where errors change sign the band does not close."""
    reach = max(1, len(band) // 50)
    wide = np.pad(band, reach, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(wide, 2 * reach + 1).max(axis=1)


def settling(values):
    """Of a number in the last beats, the latest one last: how far it is from where it settles, if the changes from beat to beat fall by
    the same factor. Of two beats this factor is not known."""
    if len(values) < 2:
        return missing()
    change = values[-1] - values[-2]
    before = values[-2] - values[-3] if len(values) > 2 else float("nan")
    if len(values) > 2 and abs(change) < abs(before):
        left = change * (change / before) / (1 - change / before)
        return Part(-left, max(CAREFUL * abs(left), abs(change)), how=OBSERVED_DECAY)
    return Part(-change, CAREFUL * abs(change), how=NO_ORDER)


@dataclass
class Budget:
    """The parts of the error of one number, and what follows from all of them."""
    value: float
    parts: dict  # name -> Part
    floor: float = 0.0  # round-off

    def band(self):
        """The sum of the bounds; what could not be estimated is not in it."""
        return self.floor + sum(part.band for part in self.parts.values() if part.how != MISSING)

    def extrapolated(self):
        return self.value - sum(part.error for part in self.parts.values() if part.how != MISSING)

    def lacks(self):
        return [name for name, part in self.parts.items() if part.how == MISSING]
