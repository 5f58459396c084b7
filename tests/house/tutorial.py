#!/usr/bin/python3
"""The commands that docs/first-case.md marks with "run: tutorial" (marked.py), in their order, on the case that the README
prints. They refuse what the page says they refuse, in its words.

Usage: tutorial.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from marked import fenced

INLET = '<Parameter name="pressure" type="double" value="0.5"/>'


def write_cases(root, page, scratch):
    """my-case.xml of the README, and my-pulse.xml with the amplitude of the tutorial."""
    case = next(block.text for language, block in fenced(root, "README.md") if language == "xml")
    amplitude = next(block.text for block in page if '"Amplitude"' in block.text)
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
    page = [block for _, block in fenced(root, "docs/first-case.md")]
    write_cases(root, page, scratch)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    faults = 0
    for block, shown in zip(page, [block.text for block in page[1:]] + [""]):
        if (block.kind, block.name) != ("run", "tutorial"):
            continue
        text = block.text
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
