"""Curves of the case with their bands."""
from itertools import zip_longest

import numpy as np
from matplotlib import pyplot as plt

from report.canvas import COLOUR, Figure, readable, save

PANELS = 8  # of a figure


def shown(curves, scales):
    """Curves that are more than round-off of their kind."""
    return [c for c in curves if len(c.times) > 1 and np.ptp(c.values) > 1e-9 * scales[c.name]]


def _figure(number, curves):
    canvas, grid = plt.subplots(-(-len(curves) // 2), 2, squeeze=False, layout="constrained",
                                figsize=(10.4, 2.6 * -(-len(curves) // 2) + 0.6))
    for axes, curve in zip_longest(grid.flat, curves):
        if curve is None:
            axes.set_visible(False)
            continue
        axes.fill_between(curve.times, curve.values - curve.band, curve.values + curve.band, color=COLOUR["fluid"], alpha=0.25,
                          linewidth=0, label="band")
        axes.plot(curve.times, curve.values, color=COLOUR["fluid"], label="the case")
        axes.plot(curve.times, curve.values - curve.error, color=COLOUR["wall"], linestyle="--", linewidth=1.2, label="extrapolated")
        axes.set_title(readable(curve.name))
        axes.set_xlabel("time [ms]")
        axes.ticklabel_format(axis="y", scilimits=(-3, 4))
    grid[0, 0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.15), ncol=3)
    title = "Curves with their bands" if number == 1 else f"More curves ({number})"
    return canvas, Figure(f"curves-{number}.png", title, "The band is the sum of the bounds of all errors that were estimated; the "
                          "dashed curve is the case without those errors.")


def draw_all(results, folder):
    curves = shown(results.curves, results.scales)
    parts = [curves[i:i + PANELS] for i in range(0, len(curves), PANELS)]
    return save([lambda n=n, part=part: _figure(n, part) for n, part in enumerate(parts, 1)], folder)
