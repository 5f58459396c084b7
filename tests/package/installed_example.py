"""examples/smoothers needs the component multigrid and nothing of the source tree; the smoothers by
themselves need no multigrid, no mesh and no file format.

Usage: installed_example.py SOURCE BUILD CMAKE
"""
import pathlib
import shutil
import sys
import tempfile

from installation import CMAKE, SOURCE, Run, Verdict, build_against, install_and_move, mentions, must
from runs import command

HERE = pathlib.Path(__file__).resolve().parent
LISTS = ["vanka.xml", "node-ilu.xml", "braess-sarazin.xml"]
ASK = """cmake_minimum_required(VERSION 3.21)
project(ask LANGUAGES CXX)
find_package(Tunica {} REQUIRED COMPONENTS {})
"""
OTHER_TRILINOS = """set(Trilinos_VERSION 99.1)
set(Trilinos_FOUND TRUE)
"""


def solve_the_example(verdict, prefix, scratch):
    example, build = scratch / "example", scratch / "build"
    shutil.copytree(SOURCE / "examples" / "smoothers", example)
    build_against(prefix, example, build, scratch)
    rules = (build / "build.ninja").read_text()
    verdict.claim(f"-I{SOURCE}" not in rules and str(SOURCE / "build") not in rules,
                  "nothing of the source tree is compiled or linked")
    verdict.claim("-Werror" not in rules, "our warnings are not the user's")
    counts = []
    for ranks in (1, 2):
        run = Run(command(build / "smoothers", LISTS, ranks), example)
        print(run.out + run.err)
        verdict.claim(run.status == 0, f"all lists converge on {ranks} rank(s)")
        counts.append({words[0]: int(words[1]) for words in map(str.split, run.out.splitlines())
                       if len(words) == 3 and words[0] in LISTS})
        verdict.claim(len(counts[-1]) == len(LISTS), f"each has its line on {ranks} rank(s)")
    # No part of it hangs on the ranks, if only KLU2 is right on two: else 6 and 9.
    one, two = (count.get("braess-sarazin.xml") for count in counts)
    verdict.claim(one == two, f"Braess-Sarazin with direct solvers: {one} iterations on one rank, {two} on two; "
                              "the executable carries the repair of KLU2")


def use_the_smoothers_alone(verdict, scratch):
    """The least component: its prefix has no other, and its programs need none of their libraries."""
    scratch = scratch / "alone"
    scratch.mkdir()
    prefix = install_and_move("smoothers", scratch)
    build = scratch / "build"
    build_against(prefix, HERE / "smoothers_alone", build, scratch, f"-DCMAKE_CXX_FLAGS=-I{SOURCE / 'examples' / 'smoothers'}")
    needed = must(["readelf", "--dynamic", build / "alone"], scratch).lower()
    libraries = [line.split("[")[1].rstrip("]") for line in needed.splitlines() if "(needed)" in line]
    beyond = [name for name in libraries for part in ("muelu", "hdf5", "metis", "nox", "teko", "zoltan")
              if part in name]
    verdict.claim(not beyond, f"the smoothers alone need {len(libraries)} libraries, none of others' {beyond}")
    for ranks in (1, 2):
        run = Run(command(build / "alone", [], ranks), scratch)
        print(run.out + run.err)
        reductions = {words[0]: float(words[1]) for words in map(str.split, run.out.splitlines())}
        verdict.claim(run.status == 0 and sorted(reductions) == ["braess-sarazin", "node-ilu", "vanka"]
                      and max(reductions.values()) < 0.1,
                      f"20 sweeps of each reduce the residual on {ranks} rank(s)")


def refusal(scratch, name, ask, options):
    folder = scratch / name
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(ask)
    run = Run([CMAKE, "-S", str(folder), "-B", str(folder / "build"), "-G", "Ninja", *options], scratch)
    return " ".join(run.err.split()) if run.status else "not refused"


def refuse_what_does_not_fit(verdict, prefix, scratch):
    other = scratch / "other"
    other.mkdir()
    (other / "TrilinosConfig.cmake").write_text(OTHER_TRILINOS)
    here = f"-DCMAKE_PREFIX_PATH={prefix}"
    for name, version, component, options, expected in (
            ("absent", "0.2", "fsi", [], "The component fsi of Tunica is not installed"),
            ("unknown", "0.2", "mesh", [], 'Tunica has no component "mesh"'),
            ("newer", "0.3", "multigrid", [], 'compatible with requested version "0.3"'),
            ("trilinos", "0.2", "multigrid", [f"-DTrilinos_ROOT={other}"], "found 99.1 in")):
        text = refusal(scratch, name, ASK.format(version, component), [here, *options])
        if not verdict.claim(expected in text, f"{name}: the message says: {expected}"):
            print(text)


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-package-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("multigrid", scratch)
        found = mentions(prefix / "lib" if (prefix / "lib").exists() else prefix, str(scratch / "staged"))
        verdict.claim(not found, f"no file names the place of installation {found}")
        solve_the_example(verdict, prefix, scratch)
        refuse_what_does_not_fit(verdict, prefix, scratch)
        use_the_smoothers_alone(verdict, scratch)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
