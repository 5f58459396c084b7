"""Writes a case as XML, with comments behind its parameters."""
import dataclasses
import re
from xml.sax.saxutils import escape

QUOTE = {'"': "&quot;"}


def comment(text):
    """XML permits no two hyphens in a comment, and none before its end."""
    return "<!-- " + re.sub("--+", "", text).rstrip("-") + " -->"


@dataclasses.dataclass
class Sublist:
    """A list within a list: entries are (name, value) or (name, value, comment), a value may be a Sublist."""
    entries: list


class Writer:
    """Lines of parameters, indented, with comments behind them."""

    def __init__(self, *head):
        self.lines, self.depth = [comment(text) for text in head], 0
        self.begin("Case")

    def line(self, text, why=""):
        self.lines.append("  " * self.depth + text + ("  " + comment(why) if why else ""))

    def begin(self, name, why=""):
        self.line(f'<ParameterList name="{escape(name, QUOTE)}">', why)
        self.depth += 1

    def end(self):
        self.depth -= 1
        self.line("</ParameterList>")

    def put(self, name, value, why=""):
        kind, text = typed(value)
        self.line(f'<Parameter name="{name}" type="{kind}" value="{escape(text, QUOTE)}"/>', why)

    def put_all(self, entries):
        for name, value, *why in entries:
            if isinstance(value, Sublist):
                self.begin(name)
                self.put_all(value.entries)
                self.end()
            else:
                self.put(name, value, *why)

    def text(self):
        while self.depth:
            self.end()
        return "\n".join(self.lines) + "\n"


def typed(value):
    """The name of its type, and the value as text."""
    if isinstance(value, list) and value and not isinstance(value[0], str):
        return "Array(double)", "{" + ", ".join(f"{number:.10g}" for number in value) + "}"
    if isinstance(value, list):
        return "Array(string)", "{" + ", ".join(value) + "}"
    if isinstance(value, float):
        return "double", f"{value:.10g}"
    kind = next(name for of, name in ((bool, "bool"), (int, "int"), (str, "string")) if isinstance(value, of))
    return kind, str(value).lower() if kind == "bool" else str(value)
