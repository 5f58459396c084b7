"""The table of errors: on the screen, in a file, in the page."""
import csv
import io

import numpy as np

from report.canvas import readable

from .fields import OF_FIELD
from .plan import BEAT
from .richardson import ASSUMED, MISSING, NO_ORDER, missing

FILE = "errors.csv"
NOTHING = 1e-4  # of the largest value of a kind
INCOMPLETE = "*"  # a band that lacks a part
NO_ORDER_NOTE = "no order: at least the difference; (2): order of theory, assumed"
LACKING_NOTE = "* without the parts that were not estimated"


def number(value):
    return f"{value:.5g}" if np.isfinite(value) else "–"


def short(value):
    return f"{value:.2g}" if np.isfinite(value) else "–"


def is_zero(row):
    """Nothing but round-off of its kind."""
    budget = row.budget
    return row.quantity != OF_FIELD and abs(budget.value) <= budget.band() <= NOTHING * row.scale


def part_text(part):
    if part.how == MISSING:
        return part.how
    return f"{part.error:+.2g} [{part.text()}]" if part.band > 0 else "0"


def percent(row):
    value = abs(row.budget.value)
    return f"{100 * row.budget.band() / value:.2g} %" if value > 0 else "–"


def extrapolated(row):
    """A field has none: its errors are those at the vertices."""
    return "–" if row.quantity == OF_FIELD else number(row.budget.extrapolated())


def heading(causes):
    return ["", "", "value", "±", "of the value", *(f"error of the {cause} [order]" if cause != BEAT else "not yet settled" for cause in causes), "extrapolated"]


def cells(row, causes):
    band = short(row.budget.band()) + (INCOMPLETE if row.budget.lacks() else "")
    return [readable(row.name), row.quantity, number(row.budget.value), band, percent(row),
            *(part_text(row.budget.parts[cause]) if cause in row.budget.parts else "" for cause in causes), extrapolated(row)]


def notes(rows):
    """What the marks in the cells mean, those that there are."""
    parts = [part.how for row in rows for part in row.budget.parts.values()]
    return ([NO_ORDER_NOTE] if NO_ORDER in parts or ASSUMED in parts else []) + ([LACKING_NOTE] if MISSING in parts else [])


def lines(rows, causes):
    """For the screen, in columns."""
    table = [heading(causes)] + [cells(row, causes) for row in rows]
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in table] + notes(rows)


def as_csv(rows, causes):
    """All digits, with a line for each quantity."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(["column", "quantity", "value", "band", "extrapolated"]
                 + [f"{cause}_{what}" for cause in causes for what in ("error", "band", "order", "how")])
    for row in rows:
        parts = [getattr(row.budget.parts.get(cause, missing()), what) for cause in causes for what in ("error", "band", "order", "how")]
        beyond = "" if row.quantity == OF_FIELD else row.budget.extrapolated()
        out.writerow([row.name, row.quantity, row.budget.value, row.budget.band(), beyond, *parts])
    return text.getvalue()


def curves_as_csv(curves):
    """The curves of the case, with error and band at each step."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(["time"] + [f"{curve.name}{end}" for curve in curves for end in ("", ":error", ":band")])
    columns = [column for curve in curves for column in (curve.values, curve.error, curve.band)]
    for i, time in enumerate(curves[0].times if curves else ()):
        out.writerow([time, *(column[i] for column in columns)])
    return text.getvalue()
