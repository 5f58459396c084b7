"""Curves of the last beat in the units of the clinic. Functions are as those of section_figures.py."""
from functools import partial

import numpy as np
from matplotlib import pyplot as plt

from report.canvas import Figure
from vessel.units import mmhg


def jobs(beat, told):
    return [partial(pressures, beat, told), partial(flows, beat)]


def _before(beat, column):
    """Times and values of the beat before; None where the run has it not."""
    times, values = beat.of("time", whole=True), beat.of(column, whole=True)
    if values is None or times[0] > beat.start - 0.9 * beat.period:
        return None
    kept = (times >= beat.start - beat.period * (1 + 1e-6)) & (times <= beat.start * (1 + 1e-9))
    return times[kept] - beat.start + beat.period, values[kept]


def pressures(beat, told):
    canvas, axes = plt.subplots(figsize=(9.5, 4.6), layout="constrained")
    for number, name in enumerate(beat.openings()):
        if beat.pressures[name] is None:
            continue
        axes.plot(beat.times - beat.start, mmhg(beat.pressures[name]), color=f"C{number}", label=name)
        before = _before(beat, beat.pressure_column(name))
        if before is not None:
            axes.plot(before[0], mmhg(before[1]), ":", color=f"C{number}", linewidth=1)
    for goal in told.get("goal", {}).values():
        axes.axhline(mmhg(goal), color="0.6", linewidth=0.8, linestyle="--")
    axes.set(xlabel="time in the beat [ms]", ylabel="pressure [mmHg]", title="Pressure at the openings")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return canvas, Figure("beat_pressures.png", "Pressures of the last beat", "Dotted: the beat before; dashed: the goal at the inlet.")


def flows(beat):
    canvas, axes = plt.subplots(figsize=(9.5, 4.6), layout="constrained")
    for number, name in enumerate(beat.openings()):
        sign = 1 if name == beat.inlet else -1
        axes.plot(beat.times - beat.start, sign * beat.flows[name], color=f"C{number}", label=name + (" (in)" if sign > 0 else ""))
    axes.axhline(0, color="0.6", linewidth=0.8)
    axes.set(xlabel="time in the beat [ms]", ylabel="flow [ml/s]", title="Flow through the openings")
    litres = axes.secondary_yaxis("right", functions=(lambda q: np.asarray(q) * 0.06, lambda q: np.asarray(q) / 0.06))
    litres.set_ylabel("l/min")
    axes.legend(loc="upper left", bbox_to_anchor=(1.12, 1.0))
    return canvas, Figure("beat_flows.png", "Flows of the last beat", "Into the vessel at the inlet, out of it at the outlets.")
