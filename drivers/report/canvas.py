"""What all figures share: their look, how they are saved, words and scales for axes. Units: mm, ms, kPa."""
import os
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib import pyplot as plt

COLOUR = {"fluid": "#1f6fb4", "wall": "#c0392b", "system": "#2e7d32", "": "#333333"}
DPI = 150
STYLE = {
    "font.size": 11, "axes.titlesize": 12, "axes.labelsize": 11, "legend.fontsize": 9.5,
    "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "lines.linewidth": 1.8, "lines.markersize": 5,
}


@dataclass
class Figure:
    file: str
    title: str
    text: str


def save(jobs, folder):
    """Draws, saves and returns the figures of those jobs that have something to show."""
    figures = []
    with matplotlib.rc_context(STYLE):
        for job in jobs:
            drawn = job()
            if drawn is None:
                continue
            canvas, figure = drawn
            canvas.savefig(os.path.join(folder, figure.file), dpi=DPI, bbox_inches="tight")
            plt.close(canvas)
            figures.append(figure)
    return figures


def positive(values):
    """What a logarithmic axis can show."""
    v = np.array(values, dtype=float)
    return np.where(v > 0, v, np.nan)


def colour_scale(values):
    """From the least to the greatest value, without single peaks, which would darken the rest."""
    values = values[np.isfinite(values)]
    low, high = (np.percentile(values, (0.2, 99.8))) if len(values) else (0.0, 1.0)
    if low >= 0 and low < 0.3 * high:
        low = 0.0
    if high - low < 1e-12 * max(abs(high), abs(low), 1e-300):
        low, high = low - 0.5, high + 0.5
    return matplotlib.colors.Normalize(low, high)


def readable(column):
    """"inflow_mm3_per_ms" becomes "inflow [mm³/ms]"."""
    units = {"mm": "mm", "mm2": "mm²", "mm3": "mm³", "ms": "ms", "kPa": "kPa", "mg": "mg", "mN": "mN", "uJ": "µJ"}
    words = column.split("_")
    if len(words) > 3 and words[-2] == "per" and words[-1] in units and words[-3] in units:
        return " ".join(words[:-3]) + f" [{units[words[-3]]}/{units[words[-1]]}]"
    if len(words) > 1 and words[-1] in units:
        return " ".join(words[:-1]) + f" [{units[words[-1]]}]"
    return " ".join(words)
