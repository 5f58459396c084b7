"""A table of the report, and its forms: HTML and Markdown."""
import html
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Table:
    title: str
    note: str = ""
    heading: list = field(default_factory=list)
    rows: list = field(default_factory=list)


def text_of(value):
    if isinstance(value, float):
        return f"{value:.4g}" if np.isfinite(value) else "–"
    return "–" if value is None else str(value)


def html_table(heading, rows):
    head = "".join(f"<th>{html.escape(text_of(h))}</th>" for h in heading)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(text_of(v))}</td>" for v in row) + "</tr>\n" for row in rows)
    return f"<table>\n<tr>{head}</tr>\n{body}</table>\n"


def as_html(table):
    note = f"<p class=\"note\">{html.escape(table.note)}</p>\n" if table.note else ""
    if not table.heading:
        body = "<ul>" + "".join(f"<li>{html.escape(row)}</li>\n" for row in table.rows) + "</ul>\n"
    else:
        body = html_table(table.heading, table.rows)
    return f"<h3>{html.escape(table.title)}</h3>\n{note}<div class=\"beat\">{body}</div>\n"


def as_markdown(table):
    lines = [f"## {table.title}", ""] + ([table.note, ""] if table.note else [])
    if not table.heading:
        return lines + [f"- {row}" for row in table.rows] + [""]
    lines += ["| " + " | ".join(table.heading) + " |", "|" + "---|" * len(table.heading)]
    return lines + ["| " + " | ".join(map(text_of, row)) + " |" for row in table.rows] + [""]
