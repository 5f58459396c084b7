"""How coupling, Newton's method and linear solvers went. Functions are as those of section_figures.py."""
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import MaxNLocator

from report.canvas import COLOUR, Figure, positive
from report.run_data import rows_where


def has_coupling_iterations(run):
    """Monolithic schemes have one per step, which tells nothing."""
    return max(run.coupling.get("iteration") or [0]) > 1


def coupling_history(run, step):
    if step is None or not has_coupling_iterations(run):
        return None
    chosen = rows_where(run.coupling, step=float(step))
    if not chosen or not chosen["step"] or not max(run.coupling["relaxation"]) > 0:  # monolithic ones are not relaxed
        return None
    canvas, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    others = [s for s in dict.fromkeys(run.coupling["step"]) if s != step]
    for i, other in enumerate(others[:: max(1, len(others) // 30)]):
        rows = rows_where(run.coupling, step=other)
        label = "other steps" if i == 0 else None
        left.semilogy(rows["iteration"], positive(rows["interface_residual"]), color="#d5d5d5",
                      linewidth=0.8, label=label, zorder=1)
        right.plot(rows["iteration"], positive(rows["relaxation"]), color="#d5d5d5",
                   linewidth=0.8, zorder=1)
    left.semilogy(chosen["iteration"], positive(chosen["interface_residual"]), "o-",
                  color=COLOUR["fluid"], label=f"step {step}")
    # The last iteration of a converged step makes no update: its factor is 0.
    right.plot(chosen["iteration"], positive(chosen["relaxation"]), "s-", color=COLOUR["wall"],
               label="factor")
    left.set(title="Interface residual", ylabel="residual [mm]")
    right.set(title="Relaxation factor", ylabel="factor", ylim=(0.0, None))
    left.legend()
    if max(chosen["columns"]) > 0:
        columns = right.twinx()
        columns.plot(chosen["iteration"], positive(chosen["columns"]), "^-",
                     color=COLOUR["fluid"], alpha=0.6)
        columns.set(ylabel="columns of the least-squares model (triangles)", ylim=(0.0, None))
        columns.yaxis.set_major_locator(MaxNLocator(integer=True))
    for axes in (left, right):
        axes.set_xlabel("coupling iteration")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    canvas.suptitle(f"Coupling in step {step} (t = {chosen['time'][0]:g} ms)", fontsize=13)
    return canvas, Figure("coupling.png", f"Coupling iterations of step {step}",
                          "Residual of the interface and relaxation factor at each iteration.")


def counts(run):
    def of_fields(ending):
        return [(c, c.removesuffix(ending)) for c in run.steps if c.endswith(ending)]

    panels = [("Coupling iterations", [("coupling_iterations", "")] if has_coupling_iterations(run) else []),
              ("Newton steps", of_fields("_newton")), ("Linear iterations", of_fields("_linear"))]
    shown = []
    for title, columns in panels:
        columns = [(c, f) for c, f in columns if np.nansum(np.array(run.steps.get(c, [0.0]), float)) > 0]
        if columns:
            shown.append((title, columns))
    if not shown:
        return None
    canvas, rows = plt.subplots(len(shown), 1, sharex=True, squeeze=False, layout="constrained",
                                figsize=(9.5, 2.3 * len(shown) + 0.5))
    failed = [i for i, c in enumerate(run.steps.get("converged", [])) if c in (0.0, "false", "False")]
    for axes, (title, columns) in zip(rows[:, 0], shown):
        top = 0.0
        for column, field in columns:
            axes.plot(run.steps["step"], run.steps[column], "s--" if field == "wall" else "o-", markersize=3.5, color=COLOUR[field],
                      label=field or None)
            axes.plot([run.steps["step"][i] for i in failed], [run.steps[column][i] for i in failed],
                      "x", color="red", markersize=9, label=None)
            top = max(top, np.nanmax(run.steps[column]))
        axes.set(title=title + " per step", ylim=(0, 1.12 * top))
        axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=5))
        if len(columns) > 1 or columns[0][1]:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    rows[-1, 0].set_xlabel("step")
    rows[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    return canvas, Figure("iterations.png", "Iterations per step",
                          "Sums over the coupling iterations of a step. A red cross marks a step that did not converge.")


def newton_history(run, step):
    if step is None:
        return None
    chosen = rows_where(run.newton, step=float(step))
    fields = [f for f in ("fluid", "wall") if f in (chosen.get("field") or [])]
    if not fields:
        fields = list(dict.fromkeys(chosen.get("field") or []))
    if not fields:
        return None
    canvas, columns = plt.subplots(1, len(fields), squeeze=False, sharey=True, layout="constrained",
                                   figsize=(5.2 * len(fields) + 0.6, 4.2))
    for axes, field in zip(columns[0], fields):
        rows = rows_where(chosen, field=field)
        rounds = list(dict.fromkeys(rows["coupling_iteration"]))[:4]
        for number, colour in zip(rounds, plt.get_cmap("viridis")(np.linspace(0, 0.85, len(rounds)))):
            one = rows_where(rows, coupling_iteration=number)
            axes.semilogy(one["iteration"], positive(one["increment"]), "o-", color=colour,
                          label=f"coupling iteration {number:g}")
        axes.set(title=field, xlabel="Newton step")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        if len(rounds) > 1:
            axes.legend()
    columns[0, 0].set_ylabel("norm of the increment")
    canvas.suptitle(f"Newton's method in step {step}", fontsize=13)
    return canvas, Figure("newton.png", f"Newton's method in step {step}",
                          "Increments in the first coupling iterations. The table lists the exponents of convergence.")
