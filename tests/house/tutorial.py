#!/usr/bin/python3
"""The commands of docs/first-case.md run in their order, on the case that the README prints, and refuse what the page says
they refuse, in its words.

Usage: tutorial.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
INLET = '<Parameter name="pressure" type="double" value="0.5"/>'


def blocks(path):
    return [(match[1], match[2]) for match in BLOCK.finditer(path.read_text())]


def write_cases(root, pages, scratch):
    """my-case.xml of the README, and my-pulse.xml with the amplitude of the tutorial."""
    case = next(text for kind, text in blocks(root / "README.md") if kind == "xml")
    amplitude = next(text for _, text in pages if '"Amplitude"' in text)
    assert case.count(INLET) == 1, "the README's case has one inlet pressure"
    (scratch / "my-case.xml").write_text(case)
    (scratch / "my-pulse.xml").write_text(case.replace(INLET, INLET + "\n" + amplitude))


def refusal(shown):
    """The first lines of an output that is a message of a program that has refused."""
    if not re.match(r"tunica-\w+: ", shown):
        return []
    return [part for line in shown.splitlines() for part in line.split("…") if part.strip()]


def main(root, programs, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    pages = blocks(root / "docs" / "first-case.md")
    write_cases(root, pages, scratch)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    faults = 0
    for (kind, text), (_, shown) in zip(pages, pages[1:] + [("", "")]):
        if kind != "sh" or text.startswith("export PATH"):
            continue
        run = subprocess.run(["bash", "-e", "-c", text], cwd=scratch, env=environment, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        told = refusal(shown)
        missing = [part for part in told if part.strip() not in run.stdout]
        is_right = (run.returncode != 0) == bool(told) and not missing
        faults += not is_right
        print(f"{'ok   ' if is_right else 'FAIL '} {text.strip()}")
        if not is_right:
            print(f"status {run.returncode}, missing {missing}\n{run.stdout[-2000:]}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(path).resolve() for path in sys.argv[1:4])))
