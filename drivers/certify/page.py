"""The page of a certified case: one file that needs no other."""
import base64
import html
import os

from report.page import document
from report.tables import html_table
from vessel.folder import write_atomically

from . import figures, table
from .result import CAUSES

NAME = "index.html"
MEANING = ("A band bounds the error of the numbers of this case against the exact solution of its own equations, as far as its mesh, "
           "its time step and the tolerances of its solvers make it: the sum of what each of them makes. It says nothing about "
           "the model: material laws, loads, the shape of the vessel. Orders are observed from three sizes; in parentheses those of "
           "theory, where there are only two. Where the numbers show no order, the error is the known difference, and the "
           "band three times what the last refinement changed besides.")


def _image(folder, figure):
    with open(os.path.join(folder, figure.file), "rb") as file:
        data = base64.b64encode(file.read()).decode()
    os.remove(os.path.join(folder, figure.file))
    return (f"<h2>{html.escape(figure.title)}</h2>\n<p class=\"note\">{html.escape(figure.text)}</p>\n"
            f"<img src=\"data:image/png;base64,{data}\" alt=\"{html.escape(figure.title)}\">\n")


def _runs(results):
    rows = [[job.name, job.cause, f"{job.size:.3g}", job.tetrahedra, len(results.curves_of[job].times),
             float(results.curves_of[job].seconds)] for job in results.jobs]
    return ("<h2>Runs</h2>\n<p class=\"note\">Size: of elements, steps or tolerances against those of the case.</p>\n"
            + html_table(["run", "changed", "size", "tetrahedra", "steps", "seconds in steps"], rows))


def _rows(title, note, rows, causes):
    if not rows:
        return ""
    body = html_table(table.heading(causes), [table.cells(row, causes) for row in rows])
    note += "".join(f" {mark}." for mark in table.notes(rows))
    return f"<h2>{title}</h2>\n<p class=\"note\">{html.escape(note)}</p>\n<div class=\"beat\">{body}</div>\n"


def write(results, rows, fields, remarks, folder):
    """rows: those of columns; returns the path of the page."""
    os.makedirs(folder, exist_ok=True)
    drawn = figures.draw_all(results, folder)
    period = f", means and extrema over the last beat of {results.period:g} ms" if results.period else ""
    body = f"<p>{html.escape(results.case.path)}</p>\n<p>{MEANING}</p>\n"
    body += "".join(f"<p class=\"remark\">{html.escape(remark)}</p>\n" for remark in remarks)
    body += "".join(_image(folder, figure) for figure in drawn)
    body += _rows("Numbers", f"Errors have their sign: value minus extrapolated value{period}.", [r for r in rows if not table.is_zero(r)],
                  results.causes())
    body += _rows("Fields at the end", "Root mean squares over the vertices: of the field, and of its errors.", fields, CAUSES)
    zero = [row.name for row in rows if table.is_zero(row)]
    if zero:
        body += f"<p class=\"note\">Zero but for round-off: {html.escape(', '.join(dict.fromkeys(zero)))}.</p>\n"
    path = os.path.join(folder, NAME)
    write_atomically(path, document(f"tunica-certify: {os.path.basename(results.case.path)}", body + _runs(results)))
    return path
