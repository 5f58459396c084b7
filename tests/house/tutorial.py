#!/usr/bin/python3
"""The commands that docs/first-case.md and then docs/running.md mark with "run: tutorial" (marked.py), in their order, on the
case that the README prints. Those of the first page refuse what it says they refuse, in its words; the commands of README.md
are among them, in the same order.

Usage: tutorial.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from marked import blocks, fenced

INLET = '<Parameter name="pressure" type="double" value="0.5"/>'


def write_cases(root, page, scratch):
    """my-case.xml of the README, and my-pulse.xml with the amplitude of the tutorial."""
    case = next(block.text for language, block in fenced(root, "README.md") if language == "xml")
    amplitude = next(block.text for block in page if '"Amplitude"' in block.text)
    assert case.count(INLET) == 1, "the README's case has one inlet pressure"
    (scratch / "my-case.xml").write_text(case)
    (scratch / "my-pulse.xml").write_text(case.replace(INLET, INLET + "\n" + amplitude))


def commands(text):
    """Lines without comments."""
    return [line for line in (re.sub(r"\s+#.*", "", line).strip() for line in text.splitlines()) if line]


def repeats_the_readme(root):
    """What the README has beyond the page is nobody's to run."""
    typed = [line for block in blocks(root, "docs/first-case.md") if block.kind == "run" for line in commands(block.text)]
    wanted = [line for block in blocks(root, "README.md") if block.name == "tutorial" for line in commands(block.text)]
    rest = iter(typed)
    missing = [line for line in wanted if line not in rest]
    print(f"{'FAIL ' if missing or not wanted else 'ok   '} the README has {len(wanted)} commands of the tutorial; not of it: {missing}")
    return bool(wanted) and not missing


def refusal(shown):
    """The first lines of an output that is a message of a program that has refused."""
    if not re.match(r"tunica-\w+: ", shown):
        return []
    return [part for line in shown.splitlines() for part in line.split("…") if part.strip()]


def main(root, programs, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    pages = [[block for _, block in fenced(root, page)] for page in ("docs/first-case.md", "docs/running.md")]
    write_cases(root, pages[0], scratch)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    faults = 0 if repeats_the_readme(root) else 1
    for block, shown in ((block, shown) for page in pages for block, shown in zip(page, [b.text for b in page[1:]] + [""])):
        if (block.kind, block.name) != ("run", "tutorial"):
            continue
        text = block.text
        run = subprocess.run(["bash", "-e", "-c", text], cwd=scratch, env=environment, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        told = refusal(shown) if block.page == "docs/first-case.md" else []
        missing = [part for part in told if part.strip() not in run.stdout]
        is_right = (run.returncode != 0) == bool(told) and not missing
        faults += not is_right
        print(f"{'ok   ' if is_right else 'FAIL '} {text.strip()}")
        if not is_right:
            print(f"status {run.returncode}, missing {missing}\n{run.stdout[-2000:]}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(path).resolve() for path in sys.argv[1:4])))
