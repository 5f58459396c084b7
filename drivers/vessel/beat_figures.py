"""Figures of the last beats: pressures against the goal, flows."""
import os

import matplotlib.pyplot as plt

from . import run, tune
from .units import mmhg


def draw(folder, tuned, beats):
    count = len(beats)
    curves = [run.curves_of(folder, number, tuned) for number in range(max(1, count - 1), count + 1)]
    last, before = curves[-1], curves[0] if len(curves) > 1 else None
    save(folder, "pressures.png", pressures(tuned, last, before))
    save(folder, "flows.png", flows(tune.read_inflow(folder, tuned["period"]), tuned, last))


def pressures(tuned, last, before):
    figure, axes = plt.subplots(figsize=(7, 4.5), constrained_layout=True)
    for colour, (name, values) in enumerate(last.pressure.items()):
        axes.plot(last.time, mmhg(values), color=f"C{colour}", label=name)
        if before is not None:
            axes.plot(before.time, mmhg(before.pressure[name]), ":", color=f"C{colour}", linewidth=1)
    for goal in tuned["goal"].values():
        axes.axhline(mmhg(goal), color="0.6", linewidth=0.8, linestyle="--")
    axes.set(xlabel="time in the beat, ms", ylabel="pressure, mmHg",
             title="last beat; dotted: the beat before; dashed: goal at the inlet")
    axes.legend(fontsize=8)
    return figure


def flows(inflow, tuned, last):
    figure, axes = plt.subplots(figsize=(7, 4.5), constrained_layout=True)
    axes.plot([k * tuned["period"] / len(inflow) for k in range(len(inflow))], inflow, color="0.4", label=f"{tuned['inlet']} (in)")
    for colour, (name, values) in enumerate(last.flow.items()):
        axes.plot(last.time, values, color=f"C{colour + 1}", label=name)
    axes.set(xlabel="time in the beat, ms", ylabel="flow, ml/s", title="last beat")
    axes.legend(fontsize=8)
    return figure


def save(folder, name, figure):
    draft = folder.file("draft-" + name)
    figure.savefig(draft, dpi=110)
    plt.close(figure)
    os.replace(draft, folder.file(name))
