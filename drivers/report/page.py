"""The HTML page around the figures; images and page lie in one folder."""
import html
import os

import numpy as np

from report import budget_tables, wall_stress
from report.canvas import readable
from report.case_tables import changes_per_cycle, openings, parameters, period, read_case
from report.run_data import rows_where
from report.tables import as_html, as_markdown, html_table

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
img { max-width: 100%; height: auto; } p.note { color: #666; margin: .2rem 0 .6rem; }
table { border-collapse: collapse; font-size: .9rem; margin: .6rem 1.5rem .6rem 0; display: inline-block; vertical-align: top; }
td, th { padding: .15rem .7rem; text-align: right; border-bottom: 1px solid #e4e4e4; }
td:first-child, th:first-child { text-align: left; } th { color: #555; font-weight: 600; }
h3 { font-size: 1rem; margin: 1.4rem 0 0; } .beat { overflow-x: auto; }
.beat td { white-space: nowrap; } iframe { width: 100%; height: 34rem; border: 1px solid #ccc; }
.remark { background: #fff7e6; border-left: 4px solid #d9a406; padding: .4rem .8rem; }
.scroll { max-height: 24rem; overflow: auto; } summary { cursor: pointer; }
.done { color: #1a7f37; } .bad { color: #b42318; } .running { color: #9a6700; }
"""


def _sections(record):
    """One table per object of run.json."""
    return "".join(html_table([name, ""], [(k, "–" if v is None else v) for k, v in entries.items()])
                   for name, entries in record.items()
                   if isinstance(entries, dict) and entries and not name.startswith(budget_tables.TOTALS))


def _exponents(run, step):
    """Exponent of convergence of each Newton step: one row per solve."""
    if step is None:
        return ""
    chosen = rows_where(run.newton, step=float(step))
    if not chosen or not chosen["step"] or "exponent" not in chosen:
        return ""
    rows = []
    for number in dict.fromkeys(chosen["coupling_iteration"]):
        for field in dict.fromkeys(chosen["field"]):
            one = rows_where(chosen, coupling_iteration=number, field=field)
            if one["step"]:
                rows.append([f"{number:g}", field] + [_exponent(e) for e in one["exponent"]])
    width = max(len(row) for row in rows)
    rows = [row + [""] * (width - len(row)) for row in rows[:12]]
    return ("<h2>Exponents of convergence of Newton's method</h2>\n"
            f"<p class=\"note\">Step {step}, first coupling iterations; 2 is quadratic convergence.</p>\n"
            + html_table(["coupling iteration", "field"] + [f"step {i}" for i in range(1, width - 1)], rows))


def _exponent(value):
    return f"{value:.2f}" if isinstance(value, float) and np.isfinite(value) and value != 0 else "–"


def linear_solvers(run):
    """Linear solves summed up by field, method and preconditioner."""
    table = run.linear
    if not table.get("step"):
        return ""
    keys = [c for c in ("field", "method", "preconditioner") if c in table]  # runs of earlier versions lack one
    rows = []
    for kind in dict.fromkeys(zip(*(table[key] for key in keys))):
        one = rows_where(table, **dict(zip(keys, kind)))
        failed = sum(c in (0.0, "false", "False") for c in one["converged"])
        rows.append([*kind, len(one["step"]), float(np.mean(one["iterations"])),
                     float(np.max(one["iterations"])), float(np.sum(one["setup_seconds"])),
                     float(np.sum(one["solve_seconds"])), failed])
    return "<h2>Linear solvers</h2>\n" + html_table(
        [*keys, "solves", "mean iterations", "most", "set-up [s]", "solve [s]", "not converged"], rows)


def _status(record):
    status = str(record.get("status", "unknown"))
    mark = {"done": "done", "running": "running"}.get(status, "bad")
    return f"<b class=\"{mark}\">{html.escape(status)}</b>"


def _ranks(record):
    return f"{record['ranks']} rank" + ("s" if record["ranks"] != 1 else "")


def _message(record):
    return f"<p class=\"bad\">{html.escape(str(record['message']))}</p>\n" if record.get("message") else ""


def _summary(run):
    record, steps = run.record, run.steps
    parts = [_status(record), f"{len(steps.get('step', []))} steps"]
    if steps.get("time"):
        parts.append(f"t = {steps['time'][-1]:g} ms")
    if "ranks" in record:
        parts.append(_ranks(record))
    if steps.get("seconds"):
        parts.append(f"{np.nansum(steps['seconds']):.1f} s in steps")
    if record.get("started"):
        parts.append(f"started {html.escape(str(record['started']))}")
    remarks = "".join(f"<p class=\"remark\">{html.escape(r)}</p>\n" for r in run.remarks)
    alarm = budget_tables.alarm(record)
    loud = f"<p class=\"bad\"><b>{html.escape(alarm)}</b></p>\n" if alarm else ""
    return "<p>" + " · ".join(parts) + "</p>\n" + _message(record) + loud + remarks


def _case(case):
    tables = "".join(html_table([heading, ""], rows) for heading, rows in parameters(case))
    return f"<h2>The case</h2>\n<details open><summary>parameters</summary>\n{tables}</details>\n" if tables else ""


def _wall_stress(run):
    """What each layer of the wall bears."""
    peaks, errors = wall_stress.tables(run, run.outputs)
    if not peaks:
        return ""
    note = ("At the vertices, recovered from the elements around, each layer for itself, at the output in which the quantile "
            "is greatest. 99 % of the layer bear less than the quantile; the greatest value of all may be that of a corner, "
            "where it grows with each refinement. In elements: the greatest value of them.")
    table = html_table(wall_stress.HEADING, peaks)
    if errors:
        note += (" Estimated error: how far the stress of the elements is from that at the vertices, root mean square in parts "
                 "of the stress, at the last output.")
        table += html_table(["layer", "estimated error"], errors)
    return f"<h2>Stress in the wall</h2>\n<p class=\"note\">{note}</p>\n{table}"


def _flow_split(run, case):
    """What flows through each surface, and under which pressure."""
    found = openings(run.steps, period(case))
    if found is None:
        return ""
    begin, rows = found
    rows = [[name, float(flow), f"{100 * share:.1f} %" if share == share else "", *map(float, pressures)]
            for name, flow, share, *pressures in rows]
    heading = ["surface", "mean flow in [mm³/ms]", "of what leaves", "mean pressure [kPa]", "least", "greatest"]
    width = max(len(row) for row in rows)
    return ("<h2>Flow split</h2>\n<p class=\"note\">From "
            f"{begin:g} to {run.steps['time'][-1]:g} ms, through the surfaces of steps.csv.</p>\n"
            + html_table(heading[:width], [row + [""] * (width - len(row)) for row in rows]))


def _periodicity(run, case):
    """Whether the run has become periodic, where a load has a period."""
    length = period(case)
    if length is None:
        return ""
    rows = changes_per_cycle(run.steps, length)
    if rows is None:
        text, table = f"The loads have a period of {length:g} ms; the run is not two of them long.", ""
    else:
        text = (f"Relative L2 difference of the last cycle of {length:g} ms and the one before, greatest first; "
                "below 0.01 a quantity hardly changes any more.")
        rows = sorted(rows, key=lambda row: -np.nan_to_num(row[1]))
        table = html_table(["quantity", "change"], [(readable(c), float(v)) for c, v in rows])
    return f"<h2>Has it become periodic?</h2>\n<p class=\"note\">{text}</p>\n{table}"


def _effort(run):
    """Iterations of each step."""
    columns = [c for c in run.steps if c in ("step", "time", "coupling_iterations", "seconds")
               or c.endswith(("_newton", "_linear"))]
    columns = [c for c in columns if c in ("step", "time") or np.nansum(np.array(run.steps[c], float)) > 0]
    if not columns or not run.steps.get("step"):
        return ""
    heading = [{"time": "time [ms]", "seconds": "seconds"}.get(c, c.replace("_", " ")) for c in columns]
    rows = zip(*[run.steps[c] for c in columns])
    return (f"<details><summary>iterations of each step</summary><div class=\"scroll\">\n{html_table(heading, rows)}"
            "</div></details>\n")


def _images(figures):
    return "".join(f"<h2>{html.escape(f.title)}</h2>\n<p class=\"note\">{html.escape(f.text)}</p>\n"
                   f"<a href=\"{f.file}\"><img src=\"{f.file}\" alt=\"{html.escape(f.title)}\"></a>\n"
                   for f in figures)


def document(title, body):
    """A whole page."""
    return (f"<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">"
            f"<title>{html.escape(title)}</title>\n<style>{_STYLE}</style></head>\n<body>\n"
            f"<h1>{html.escape(title)}</h1>\n{body}</body>\n</html>\n")


def _save(folder, title, body):
    with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
        file.write(document(title, body))


SUMMARY = "summary.md"


def _clinical(clinic):
    """The tables of a vessel with a beat."""
    return "<h2>The beat, in the units of the clinic</h2>\n" + "".join(map(as_html, clinic.tables))


def _budget(tables):
    """Whether the run has kept mass, forces, energy and volume."""
    return "<h2>Is anything lost?</h2>\n" + "".join(map(as_html, tables)) if tables else ""


def write(run, folder, drawn, step, clinic):
    """drawn: figures, and the page with the vessel to be turned or None; clinic: None where there is no beat."""
    case, (figures, viewer) = read_case(run.folder), drawn
    title = title_of(run)
    in_motion = (f"<h2>The vessel in motion</h2>\n<p><a href=\"{viewer}\">alone, in the whole window</a></p>\n"
                 f"<iframe src=\"{viewer}\" title=\"the vessel in motion\"></iframe>\n") if viewer else ""
    budget = budget_tables.tables(run.record)
    if clinic:
        results = _clinical(clinic)
        with open(os.path.join(folder, SUMMARY), "w", encoding="utf-8") as file:
            file.write("\n".join([f"# {title}", "", *(line for table in clinic.tables + budget for line in as_markdown(table))]))
    else:
        results = f"{_wall_stress(run)}{_flow_split(run, case)}{_periodicity(run, case)}"
    _save(folder, title, f"{_summary(run)}{results if clinic else ''}{in_motion}{_images(figures)}{'' if clinic else results}"
                         f"{_budget(budget)}{_effort(run)}{_exponents(run, step)}{linear_solvers(run)}{_case(case)}<h2>The run</h2>\n"
                         f"{_sections(run.record)}")


def title_of(run):
    """Of a run in a folder "results" that of the folder around it."""
    above, name = os.path.split(os.path.abspath(run.folder))
    return f"{run.record.get('program', 'tunica')}: {os.path.basename(above) if name == 'results' else name}"


def write_compared(compared, folder, figures):
    """Ordinary runs side by side."""
    body = "".join(f"<h2>{html.escape(name)}</h2>\n<p class=\"note\">{html.escape(run.folder)}</p>\n{_summary(run)}"
                   for name, run in zip(compared.names, compared.runs))
    heading, rows = compared.table()
    note = (f"Apart: the largest distance from {compared.names[0]} while all runs last, in parts of the range of "
            "its curve; between the steps of a run a straight line.")
    body += f"{_images(figures)}<h2>At the end</h2>\n<p class=\"note\">{html.escape(note)}</p>\n{html_table(heading, rows)}"
    others = compared.other_parameters()
    body += "<h2>Parameters that differ</h2>\n"
    body += html_table(["", *compared.names], others) if others else "<p>None of those shown on the page of a run.</p>\n"
    _save(folder, "compared: " + ", ".join(compared.names), body)


# --- runs of tunica-solvers -----------------------------------------------------------------

def _setting_row(rows, newton_steps):
    """Iterations at each Newton step, with the verdict where it is not "converged"; seconds."""
    row = []
    for k in newton_steps:
        one = rows_where(rows, newton_step=k)
        solves = zip(one["iterations"], one["verdict"])
        row.append("".join(f"{n:g}" + ("" if v == "converged" else f" ({v})") for n, v in solves))
    return row + [float(np.sum(rows["setup_seconds"])), float(np.sum(rows["solve_seconds"]))]


def _comparison(run, field):
    table = rows_where(run.solvers, field=field)
    newton_steps = list(dict.fromkeys(table["newton_step"]))
    rows = [[s] + _setting_row(rows_where(table, setting=s), newton_steps) for s in run.settings(field)]
    heading = ["iterations at Newton step"] + [f"{k:g}" for k in newton_steps] + ["set-up [s]", "solve [s]"]
    return (f"<h2>{field}: {run.unknowns(field):,} unknowns, {_ranks(run.record)}</h2>\n"
            f"<p class=\"note\">{html.escape(run.folder)}: residuals reduced by "
            f"{run.choice['tolerance']:g}; seconds of all Newton steps.</p>\n{html_table(heading, rows)}")


def write_solvers(runs, folder, figures):
    """Folders of tunica-solvers side by side."""
    names = [os.path.basename(os.path.abspath(run.folder)) for run in runs]
    body = f"<p>{runs[0].place()}</p>\n"
    body += "".join(f"<p>{html.escape(run.folder)}: {_status(run.record)} · {_ranks(run.record)}</p>\n"
                    + _message(run.record) for run in runs)
    body += _images(figures)
    body += "".join(_comparison(run, field) for run in runs for field in run.fields())
    body += "".join(f"<h2>The run {html.escape(name)}</h2>\n{_sections(run.record)}"
                    for name, run in zip(names, runs))
    _save(folder, "tunica-solvers: " + ", ".join(names), body)
