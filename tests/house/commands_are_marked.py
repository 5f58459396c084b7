#!/usr/bin/python3
"""Every command of every page is run by a test, or its page says why not (marked.py). A test that a mark names exists and
reads that page.

Usage: commands_are_marked.py ROOT BUILD_FOLDER CTEST
"""
import json
import pathlib
import re
import subprocess
import sys

from documents import documents
from marked import SHELLS, fenced

# What a command looks like in a block that does not say it is one; a message of a program has a colon behind the name.
COMMAND = re.compile(r"^(?:\$ |mpirun |(?:\S*/)?tunica-[a-z]+ (?!.*: ))", re.MULTILINE)
TEST = re.compile(r"\b(?:regress|nightly|package|verify|report|import)_\w+")


def tests_of(build, ctest):
    """The script of each test, "" where it is none of Python."""
    listed = subprocess.run([ctest, "--show-only=json-v1"], cwd=build, stdout=subprocess.PIPE, text=True, check=True)
    return {test["name"]: next((word for word in test.get("command", []) if word.endswith(".py")), "")
            for test in json.loads(listed.stdout)["tests"]}


def fault(language, block, tests):
    """What is wrong with a fenced block, or ""."""
    if language not in SHELLS:
        is_other = not block.kind and (language or not COMMAND.search(block.text))
        return "" if is_other else "a command or a mark, but no block of the language sh"
    if language != "sh":
        return f"write ```sh instead of ```{language}"
    if not block.kind:
        return "no mark says which test runs these commands: <!-- run: NAME --> or <!-- not run: REASON --> in the line above"
    named = [block.name] if block.kind == "run" else TEST.findall(block.name)
    unknown = [name for name in named if name not in tests]
    if unknown:
        return f"there is no test {unknown[0]}"
    if block.kind == "run" and block.page not in pathlib.Path(tests[block.name] or "/dev/null").read_text():
        return f"the test {block.name} does not read this page"
    return ""


def main(root, build, ctest):
    tests, counts, faults = tests_of(build, ctest), {}, 0
    for path in documents(root):
        page = str(path.relative_to(root))
        for language, block in fenced(root, page):
            text = fault(language, block, tests)
            if text:
                print(f"{page}:{block.line}: {text}")
                faults += 1
            elif language in SHELLS:
                name = block.name if block.kind == "run" else "not run"
                counts[name] = counts.get(name, 0) + 1
    print("blocks of commands: " + ", ".join(f"{counts[name]} {name}" for name in sorted(counts)))
    print(f"{faults} fault(s)")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), *sys.argv[2:4]))
