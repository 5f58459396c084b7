"""The figures that compare runs of tunica-solvers, in the manner of section_figures.py."""
import os

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import FixedLocator, MaxNLocator, NullLocator, ScalarFormatter

from report.canvas import Figure, positive, save
from report.run_data import rows_where

MARKERS = "osD^vP*X"


def draw_all(runs, folder):
    jobs = [lambda: newton_history(runs)] if all(run.newton for run in runs) else []
    jobs += [lambda f=f: krylov_counts([run for run in runs if f in run.fields()], f) for f in fields_of(runs)]
    return save(jobs, folder)


def fields_of(runs):
    return list(dict.fromkeys(f for run in runs for f in run.fields()))


def label(run, runs, field):
    """The number of unknowns tells meshes apart; the folder, runs on the same mesh."""
    text = f"{run.unknowns(field):,} unknowns"
    same = [r for r in runs if field in r.fields() and r.unknowns(field) == run.unknowns(field)]
    return text if len(same) == 1 else f"{text} ({os.path.basename(os.path.abspath(run.folder))})"


def newton_history(runs):
    fields = fields_of(runs)
    canvas, panels = plt.subplots(1, len(fields), squeeze=False, sharey=True, layout="constrained",
                                  figsize=(5.2 * len(fields) + 0.6, 4.2))
    for axes, field in zip(panels[0], fields):
        shown = [run for run in runs if field in run.fields()]
        for run, colour, marker in zip(shown, _colours(len(shown)), MARKERS * len(shown)):
            rows = rows_where(run.newton, field=field)
            axes.semilogy(rows["iteration"], positive(rows["relative_increment"]), marker + "-",
                          color=colour, label=label(run, runs, field))
        axes.set(title=field, xlabel="Newton step")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.legend()
    panels[0, 0].set_ylabel("increment / first increment")
    canvas.suptitle(f"Newton's method in {runs[0].place()}", fontsize=13)
    return canvas, Figure("newton.png", f"Newton's method in {runs[0].place()}",
                          "Mass norm of the increments, as the solvers of the case itself make them.")


def krylov_counts(runs, field):
    """One panel per run, a setting in the same colour in all."""
    settings = list(dict.fromkeys(s for run in runs for s in run.settings(field)))
    canvas, panels = plt.subplots(1, len(runs), sharey=True, squeeze=False, layout="constrained",
                                  figsize=(3.8 * len(runs) + 3.4, max(4.2, 1.0 + 0.27 * len(settings))))
    for axes, run in zip(panels[0], runs):
        _count_panel(axes, run, field, settings)
        axes.set(title=label(run, runs, field), xlabel="Newton step" if run.newton else "")
        if not run.newton:
            axes.set_xticks([])
    panels[0, 0].set_ylabel("iterations")
    _scale_counts(panels[0, 0], [n for run in runs for n in rows_where(run.solvers, field=field)["iterations"]])
    _legend(panels[0, -1], runs[-1], field, settings)
    title = f"iterations for the {field} in {runs[0].place()}"
    canvas.suptitle(title, fontsize=13)
    return canvas, Figure(f"krylov_{field}.png", title,
                          "Markers stand a little aside of their Newton step, so that equal counts are seen; "
                          "a red cross marks a solve that did not converge.")


def _colours(count):
    return plt.get_cmap("viridis")(np.linspace(0, 0.75, max(count, 2)))


def _style(i):
    """Ten colours; from the eleventh setting on dashed."""
    return {"color": plt.get_cmap("tab10")(i % 10), "marker": MARKERS[i % len(MARKERS)],
            "linestyle": "-" if i < 10 else "--", "linewidth": 1.2}


def _count_panel(axes, run, field, settings):
    newton_steps = set()
    for i, setting in enumerate(settings):
        rows = rows_where(run.solvers, field=field, setting=setting)
        aside = 0.3 * ((i + 0.5) / len(settings) - 0.5)
        x = np.array(rows["newton_step"]) + aside
        axes.plot(x, rows["iterations"], **_style(i))
        failed = [j for j, verdict in enumerate(rows["verdict"]) if verdict != "converged"]
        axes.plot(x[failed], [rows["iterations"][j] for j in failed], "x", color="red", markersize=9)
        newton_steps.update(rows["newton_step"])
    axes.set_xticks(sorted(newton_steps))
    axes.grid(axis="x", visible=False)


def _scale_counts(axes, counts):
    """Linear from 0, or logarithmic where a few settings would squeeze the others."""
    low, high = min(counts), max(counts)
    if high <= 6 * max(low, 1):
        axes.set_ylim(0, 1.06 * high)
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        return
    ticks = [n * 10**k for k in range(7) for n in (1, 2, 3, 5, 7)]
    axes.set_yscale("log")
    axes.set_ylim(0.9 * max(low, 1), 1.1 * high)
    axes.yaxis.set_major_locator(FixedLocator(ticks))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(ScalarFormatter())


def _legend(axes, run, field, settings):
    """In the order of the lines beside it."""
    table = {s: rows_where(run.solvers, field=field, setting=s).get("iterations") for s in settings}
    order = sorted(range(len(settings)), key=lambda i: -np.mean(table[settings[i]] or [0]))
    lines = [plt.Line2D([], [], **_style(i)) for i in order]
    axes.legend(lines, [settings[i] for i in order], loc="center left", bbox_to_anchor=(1.02, 0.5))
