"""The report as report.pdf: the summary, the tables of a beat, the figures; pages of A4."""
import os
import textwrap

import matplotlib
from matplotlib import image
from matplotlib import pyplot as plt
from matplotlib.backends.backend_pdf import PdfPages

from report.page import title_of
from report.tables import text_of

NAME = "report.pdf"
PAGE = (8.27, 11.69)  # inches
MARGIN, LINE, SIZE = 0.06, 0.0135, 8.0  # parts of the width; of the height; points
LETTERS = 104  # in a line of that size
LEAST_SIZE = 4.5  # points


class Sheets:
    """Lines of text from the top of a page to its bottom, then on the next one."""

    def __init__(self, book):
        self.book, self.canvas, self.at = book, None, 0.0

    def room(self, lines):
        if self.canvas is None or self.at - lines * LINE < MARGIN:
            self.finish()
            self.canvas, self.at = plt.figure(figsize=PAGE), 1 - MARGIN

    def line(self, words, size=SIZE, weight="normal", family="sans-serif"):
        self.room(1)
        self.canvas.text(MARGIN, self.at, words, size=size, weight=weight, family=family, va="top", parse_math=False)
        self.at -= LINE * max(size / SIZE, 0.8)

    def skip(self):
        self.at -= LINE

    def finish(self):
        if self.canvas is not None:
            self.book.savefig(self.canvas)
            plt.close(self.canvas)
            self.canvas = None


def columns(rows):
    """Rows as lines of one width, the first column to the left, the others to the right."""
    width = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join(cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, width))) for row in rows]


def broken(heading, rows):
    """Words of the heading below each other, so that no column is wider than its longest word or value."""
    width = [max([len(row[k]) for row in rows] + [len(word) for word in heading[k].split()]) for k in range(len(heading))]
    parts = [textwrap.wrap(words, w) or [""] for words, w in zip(heading, width)]
    deep = max(map(len, parts))
    return [[part[k - deep + len(part)] if k >= deep - len(part) else "" for part in parts] for k in range(deep)]


def put_table(sheets, table):
    sheets.skip()
    sheets.room(4)
    sheets.line(table.title, size=10, weight="bold")
    for line in textwrap.wrap(table.note, LETTERS):
        sheets.line(line)
    if not table.heading:
        for row in table.rows:
            for k, line in enumerate(textwrap.wrap(row, LETTERS - 2)):
                sheets.line(("• " if k == 0 else "   ") + line)
        return
    rows = [[text_of(cell) for cell in row] for row in table.rows]
    lines = columns(broken(table.heading, rows) + rows)
    size = max(LEAST_SIZE, min(7.0, 7.0 * 112 / len(lines[0])))
    for line in lines:
        sheets.line(line, size=size, family="monospace")


def put_figure(book, folder, figure):
    picture = image.imread(os.path.join(folder, figure.file))
    is_wide = picture.shape[1] > 1.3 * picture.shape[0]
    canvas = plt.figure(figsize=PAGE[::-1] if is_wide else PAGE)
    axes = canvas.add_axes([0.04, 0.08, 0.92, 0.84])
    axes.imshow(picture, interpolation="antialiased")
    axes.axis("off")
    canvas.text(0.05, 0.95, figure.title, size=12, weight="bold", parse_math=False)
    canvas.text(0.05, 0.03, "\n".join(textwrap.wrap(figure.text, 120)), size=SIZE, parse_math=False)
    book.savefig(canvas)
    plt.close(canvas)


def write(run, clinic, folder, figures):
    with matplotlib.rc_context({"savefig.dpi": 150}), PdfPages(os.path.join(folder, NAME)) as book:
        sheets = Sheets(book)
        sheets.line(title_of(run), size=14, weight="bold")
        sheets.skip()
        told = [f"status: {run.record.get('status', 'unknown')}, {len(run.steps.get('step', []))} steps", *run.remarks]
        for line in (part for text in told for part in textwrap.wrap(text, LETTERS)):
            sheets.line(line)
        for table in clinic.tables if clinic else ():
            put_table(sheets, table)
        sheets.finish()
        for figure in figures:
            put_figure(book, folder, figure)
