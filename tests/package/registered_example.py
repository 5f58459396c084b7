"""examples/registered: a preconditioner factory for Stratimikos, and our factories in MueLu's interpreter.

Usage: registered_example.py SOURCE BUILD CMAKE
"""
import pathlib
import shutil
import sys
import tempfile

from installation import SOURCE, Run, Verdict, build_against, install_and_move
from runs import command


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-registered-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("multigrid", scratch)
        shutil.copytree(SOURCE / "examples", scratch / "examples")
        example, build = scratch / "examples" / "registered", scratch / "build"
        build_against(prefix, example, build, scratch)
        for ranks in (1, 2):
            run = Run(command(build / "registered", ["stratimikos.xml"], ranks), example)
            print(run.out + run.err)
            verdict.claim(run.status == 0 and "Stratimikos" in run.out, f"both converge on {ranks} rank(s)")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
