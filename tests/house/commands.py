#!/usr/bin/python3
"""The commands that pages mark with "run: commands" (marked.py), as a reader would type them: one shell for each page, in a
copy of the tree whose build folder holds the programs, and with a home folder of its own.

Usage: commands.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import os
import pathlib
import subprocess
import sys

from marked import blocks_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from scratch import fresh  # noqa: E402

# The folder in which a reader of each page is.
PAGES = {"docs/first-case.md": "tunica", "docs/choosing.md": "tunica"}
NOT_COPIED = {"build", "results", ".git"}
BEGIN = "=== block at line "


def prepare(root, programs, scratch):
    """The tree as links, and the programs where a build leaves them."""
    tree = scratch / "tunica"
    (tree / "build" / "release").mkdir(parents=True)
    (tree / "build" / "release" / "bin").symlink_to(programs)
    for path in root.iterdir():
        if path.name not in NOT_COPIED:
            (tree / path.name).symlink_to(path)


def run_page(page, blocks, folder, environment):
    """The number of blocks that did not come to their end; the shell stops at the first command that fails."""
    script = "set -eo pipefail\n" + "".join(f"echo '{BEGIN}{block.line}'\n{block.text}" for block in blocks)
    run = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    parts = run.stdout.split(BEGIN)[1:]
    for block, shown in zip(blocks, parts):
        is_last = block is blocks[len(parts) - 1]
        print(f"{'FAIL ' if is_last and run.returncode else 'ok   '} {page}:{block.line}\n{block.text.rstrip()}")
        if is_last and run.returncode:
            print(f"status {run.returncode}\n{shown[-3000:]}")
    return len(blocks) - len(parts) + (run.returncode != 0)


def main(root, programs, scratch):
    fresh(scratch)
    prepare(root, programs, scratch)
    home = os.environ.get("HOME", "/")
    environment = dict(os.environ, HOME=str(scratch / "home"), PATH=f"{programs}:{os.environ['PATH']}")
    environment.setdefault("XDG_CACHE_HOME", f"{home}/.cache")  # Matplotlib lists all fonts where it finds no list
    faults = 0
    for page, folder in PAGES.items():
        blocks = blocks_of(root, page, "commands")
        if not blocks:
            print(f"FAIL  {page} marks no commands for this test")
        faults += run_page(page, blocks, scratch / folder, environment) if blocks else 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(path).resolve() for path in sys.argv[1:4])))
