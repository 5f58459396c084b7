"""The table "What to touch" of CONTRIBUTING.md against the tree: what it names is there, every
registry holds each of its names once, every source beside it is built, and what a user adds most
costs no more than two new files, one line of a registry, one of a CMakeLists.txt, and a test.

Usage: what_to_touch.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

FEWEST_REGISTRIES = 8
CHEAP = ("a wall law", "a fluid law", "a boundary condition", "a time scheme", "an accelerator", "a preconditioner",
         "a smoother", "a field of the wall's elements")
PATH = r"`([\w./*{},-]+/[\w./*{},-]*)`"


def rows(text):
    table = text.split("## What to touch")[1].split("\n## ")[0]
    return [line for line in table.splitlines() if line.startswith("| ")][1:]


def missing_files(root, row):
    """Paths of the row that are not there; "x" stands for what will be added, "*" for any."""
    for path in re.findall(PATH, row):
        if not is_new(path) and not any(root.glob(path.rstrip("/"))):
            yield f"{path} is named in CONTRIBUTING.md and is not there"


def is_new(path):
    return re.search(r"(^|[/_])x(\.|/|_)", path)


def faults_of_cost(kind, row):
    """What goes beyond the files, lines and the test; said behind a semicolon is what one may do."""
    paths = [path for path in re.findall(PATH, row.split(";")[0]) if not path.startswith("tests/")]
    new = sum(len(re.findall(r"hpp|cpp", path)) or 99 for path in paths if is_new(path))
    lines = [path for path in paths if not is_new(path)]
    if new > 2:
        yield f"{kind} takes {new} new files"
    if len([path for path in lines if path.endswith("CMakeLists.txt")]) > 1 or len(lines) > 2:
        yield f"{kind} takes lines in {', '.join(lines)}"
    if "one line" not in row or "test" not in row:
        yield f"{kind} has no registry or no test"


def entries(code):
    """The names in a registry's table, one per line: quoted, otherwise the function that gives the
    entry."""
    tables = re.findall(r"all = \{\n(.*?)\n  \};", code, re.S)
    lines = tables[0].splitlines() if len(tables) == 1 else []
    return [re.search(r'\{"[^"]+"|\{\w+::\w+|\b\w+\(', line) for line in lines]


def faults_of_registry(root, registry):
    code = re.sub(r"^#include.*|//.*", "", (root / registry).read_text(), flags=re.M)
    found = entries(code)
    if len(found) < 2:
        yield f"{registry} has no table of at least two entries"
    for name in found:
        if name is None or code.count(name[0]) != 1:
            yield f"{registry}: {name and name[0]} is not there exactly once, in a line of its own"


def faults_of_build(root, registry, cmake):
    text = (root / cmake).read_text()
    folder = (root / registry).parent
    for source in sorted(folder.rglob("*.cpp")):
        name = str(source.relative_to((root / cmake).parent))
        if len(re.findall(rf"(?<![\w/]){re.escape(name)}\b", text)) < 1:
            yield f"{cmake} does not build {name}"


def faults(root):
    registries = 0
    table = rows((root / "CONTRIBUTING.md").read_text())
    kinds = {row.split("|")[1].strip(): row for row in table}
    for kind in CHEAP:
        if kind in kinds:
            yield from faults_of_cost(kind, kinds[kind])
        else:
            yield f'"{kind}" has no row in the table of CONTRIBUTING.md'
    for row in table:
        yield from missing_files(root, row)
        alone = re.search(r"one line in `([^`]+)`", row)
        if alone:
            registries += 1
            yield from faults_of_registry(root, alone[1])
        pair = re.search(r"one line each in `([^`]+)` and `([^`]+)`", row)
        if pair:
            registries += 1
            absent = [name for name in pair.groups() if not (root / name).is_file()]
            yield from (f"{name} is named in CONTRIBUTING.md and is not there" for name in absent)
            if not absent:
                yield from faults_of_registry(root, pair[1])
                yield from faults_of_build(root, pair[1], pair[2])
    if registries < FEWEST_REGISTRIES:
        yield f"the table of CONTRIBUTING.md names {registries} registries, at least {FEWEST_REGISTRIES} are known"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "the table fits the tree")
    sys.exit(1 if found else 0)
