#!/usr/bin/python3
"""README.md, docs/*.md and the messages of the programs are in plain English: without phrases that are the dialect of this
project, and no document with more than a few long sentences.

Usage: plain_english.py ROOT
"""
import ast
import math
import pathlib
import re
import sys

from documents import FENCE, split

# What is found, and what to write; a blank stands for any, line breaks among them.
HABITS = ((r"\bwants?\b", "needs, requires, expects"),
          (r"\b(?:is|are|was|were) told\b", "is reported, is given"),
          (r"\bwhat is there stays\b", "existing files are kept"),
          (r"\bthat are there stay\b", "existing files are kept"),
          (r"\blets? expect\b", "predicts, extrapolates"),
          (r"\bin the place of\b", "instead of, in place of"),
          (r"\bknows? how\b", "has, accounts for, includes"))
HABIT = re.compile("|".join(f"({pattern})" for pattern, _ in HABITS).replace(" ", r"\s+"), re.I)

QUANTILE, MOST_WORDS = 0.9, 40
PROGRAMS = ("tunica_adapt", "tunica_certify", "tunica_import", "tunica_lumen", "tunica_report", "tunica_vessel")

ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s+")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
CODE = re.compile(r"`[^`]*`")
END_OF_SENTENCE = re.compile(r"(?<!\be\.g)(?<!\bi\.e)(?<!\bcf)[.!?][)\"*”]*(?=\s|$)")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"(?:\s*"((?:[^"\\\n]|\\.)*)")*')


def prose(text):
    """(first line, text, whether it is prose) of each paragraph, item, heading and row of a table; without
    fenced and indented code."""
    first, lines = 0, []
    for number, is_code, line in split(text + "\n"):
        fence = FENCE.match(line)
        is_alone = bool(re.match(r"\s*\||#", line))
        if fence or is_code or is_alone or not line.strip() or ITEM.match(line):
            if lines:
                yield first, "\n".join(lines), True
            lines = []
        if fence or is_code:
            continue
        if is_alone:
            yield number, line, False
        elif line.strip() and (lines or not line.startswith("    ")):
            first = first if lines else number
            lines.append(ITEM.sub("", line))


def sentences(text):
    """(offset, words) of each sentence."""
    start = 0
    for end in [found.end() for found in END_OF_SENTENCE.finditer(text)] + [len(text)]:
        words = sum(bool(re.search(r"\w", word)) for word in text[start:end].split())
        if words > 0:
            yield start, words
        start = end


def habits(where, first, text):
    for found in HABIT.finditer(text):
        line = first + text[:found.start()].count("\n")
        phrase = re.sub(r"\s+", " ", found[0])
        yield f'{where}:{line}: "{phrase}": {HABITS[found.lastindex - 1][1]}'


def faults_of_document(path, where):
    lengths = []
    for first, text, is_prose in prose(path.read_text(encoding="utf-8")):
        yield from habits(where, first, CODE.sub("x", text))
        text = CODE.sub("x", LINK.sub(r"\1", text))
        if is_prose:
            lengths += [(words, first + text[:offset].count("\n")) for offset, words in sentences(text)]
    lengths.sort()
    if lengths and (words := lengths[math.ceil(QUANTILE * len(lengths)) - 1][0]) > MOST_WORDS:
        longest, line = lengths[-1]
        yield (f"{where}:{line}: a tenth of the sentences has {words} words or more, at most {MOST_WORDS} are "
               f"permitted; the longest, here, has {longest}")


def faults_of_cpp(path, where):
    text = re.sub(r"(?m)(?<!:)//.*$", lambda found: " " * len(found[0]), path.read_text(encoding="utf-8"))
    for found in LITERAL.finditer(text):
        # Neighbours are one text, with its line breaks where they were.
        yield from habits(where, text[:found.start()].count("\n") + 1, re.sub(r'"(\s*)"', r"\1", found[0]))


def faults_of_python(path, where):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documentation = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documentation:
            for fault in habits(where, 0, re.sub(r"\s+", " ", node.value)):
                yield re.sub(r":\d+:", f":{node.lineno}:", fault, count=1)


def faults(root):
    for path in [root / "README.md", *sorted((root / "docs").glob("*.md"))]:
        yield from faults_of_document(path, path.relative_to(root))
    for folder in ("src", "drivers"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp"):
                yield from faults_of_cpp(path, path.relative_to(root))
            elif path.suffix == ".py" or path.name in PROGRAMS:
                if path.is_file():
                    yield from faults_of_python(path, path.relative_to(root))


if __name__ == "__main__":
    found_faults = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found_faults + [f"{len(found_faults)} fault(s)"]))
    sys.exit(1 if found_faults else 0)
