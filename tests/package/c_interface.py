"""The component c is a header and a library that a C program, Python and PETSc use without anything else of ours.

Usage: c_interface.py SOURCE BUILD CMAKE
"""
import pathlib
import shutil
import sys
import tempfile

from installation import SOURCE, Run, Verdict, build_against, install_and_move, mentions
from pages import ENVIRONMENT
from runs import command


def lines_with(text, word):
    return [line for line in text.splitlines() if word in line]


def run_the_c_program(verdict, prefix, example, scratch):
    build_against(prefix, example, scratch / "build", scratch)
    for cells, ranks in ((40, 1), (40, 2), (16, 2)):
        run = Run(command(scratch / "build" / "stokes", [str(cells)], ranks), scratch)
        print(run.out + run.err)
        verdict.claim(run.status == 0 and lines_with(run.out, "half the velocity"),
                      f"{cells} x {cells} cells are solved twice on {ranks} rank(s)")
        verdict.claim("scalars at place 1 of the 3 unknowns of each node" in run.out, "the order is found")


def run_python(verdict, library, example):
    # Debian's package of the bindings alone leaves them where Python does not look.
    petsc = next(pathlib.Path("/usr/lib/petscdir").glob("*/*-real/lib/python3/dist-packages"), pathlib.Path())
    where = {**ENVIRONMENT, "TUNICA_LIBRARY": str(library), "PYTHONPATH": str(petsc)}
    for script, ranks in (("stokes.py", 1), ("stokes_petsc.py", 1), ("stokes_petsc.py", 2)):
        run = Run(command("/usr/bin/python3", [str(example / script), "40"], ranks), example, where)
        print(run.out + run.err)
        verdict.claim(run.status == 0 and not run.err, f"{script} is solved on {ranks} rank(s)")


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-c-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("c", scratch)
        library = next(prefix.rglob("libtunica_c.so"))
        verdict.claim(not mentions(library.parent, str(scratch / "staged")), "nothing names the place of installation")
        headers = [str(path.relative_to(prefix / "include")) for path in (prefix / "include").rglob("*.h*")]
        verdict.claim(headers == ["tunica/tunica.h"], f"one header: {headers}")
        example = scratch / "example"
        shutil.copytree(SOURCE / "examples" / "anywhere", example)
        run_the_c_program(verdict, prefix, example, scratch)
        run_python(verdict, library, example)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
