"""The systems of bench/arena are those of their checksums, symmetric where they say so, and tunica-solvers solves the small ones
without any list. The arena's judge rejects what is not solved, and a run that is cut goes on.

Usage: arena.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys

import numpy

from runs import ROOT, Run, Verdict, command, fresh

ARENA = ROOT / "bench" / "arena"
sys.path.insert(0, str(ARENA))
import catalogue  # noqa: E402
import page  # noqa: E402
import pages  # noqa: E402
import system as systems  # noqa: E402

LEFT_OUT = ("fsi-wall-3d", "fsi-monolithic-3d")  # as fsi-fluid-3d, and take longer


def check_made(verdict, scratch):
    """All from nothing; returns the folder of each."""
    recorded, folders = catalogue.known_checksums(), {}
    for name in catalogue.CATALOGUE:
        if name in LEFT_OUT:
            continue
        system = catalogue.make(name, "small")
        found = systems.checksum(system)
        verdict.claim(systems.agree(found, recorded[name, "small"], catalogue.rounding_of(name)),
                      f"{name} is the recorded system: {found}")
        skew = abs(system.K - system.K.T).max() / abs(system.K).max()
        verdict.claim((skew < 1e-12) == system.is_symmetric, f"{name}: K - K' is {skew:.1e} of K")
        rows = numpy.concatenate(list(system.fields.values()))
        verdict.claim(len(set(rows)) == system.n == len(rows), f"{name}: each unknown belongs to one field")
        folders[name] = scratch / name
        systems.write(system, folders[name])
    return folders


def solve(programs, folder):
    run = Run(command(programs / "tunica-solvers", [folder / "K.mtx", folder / "b.mtx", "--output", folder / "out"]), folder)
    path = folder / "out" / "solution.mtx"
    return run, systems.read_vector(path) if path.exists() else None


def order_of(name, system):
    """As tunica-solvers names it. The components of one body stand behind those of the other in contact-2d."""
    if system.components == 1 or name == "contact-2d":
        return "1 component"
    return f"{system.components} components, " + ("by node" if system.is_by_node else "by component")


def check_default(verdict, programs, folders):
    runs = [solve(programs, folder) for folder in folders.values()]
    for (name, folder), (run, x) in zip(folders.items(), runs):
        system = systems.read(folder)
        found = next((line for line in run.out.splitlines() if line.startswith("system: ")), "")
        verdict.claim(f" scalar unknowns, {order_of(name, system)}, " in found, f"{name}: the order is found: {found}")
        n_vectors = len(next(iter(system.fields.values())))
        # Where none is alone in its row: those may be of either field.
        verdict.claim(f" {n_vectors} vector and" in found or name == "darcy-3d", f"{name}: {n_vectors} are vectors")
        if not verdict.claim(run.status == 0 and x is not None, f"{name}: status {run.status} {run.err}"):
            continue
        whole, fields, backward = systems.residuals(system.K, system.b, x, system.fields)
        verdict.claim(systems.is_solved(system.K, system.b, x, system.fields),
                      f"{name}: residual {whole:.1e}, of fields {fields}, backward error {backward:.1e}")
        verdict.claim(not systems.is_solved(system.K, system.b, x * (1 + 1e-6), system.fields),
                      f"{name}: a solution that is off by 1e-6 is rejected")


def check_run(verdict, programs, scratch):
    """A line that a kill has cut is made again, and only that."""
    output = scratch / "arena"
    words = command(ARENA / "run.py", ["--sizes", "small", "--on", "stokes-mac-2d,darcy-2d", "--only", "SciPy SuperLU,default",
                                       "--programs", programs, "--output", output])
    first = Run(words, scratch)
    rows = page.read_results(output / "results.jsonl")
    verdict.claim(first.status == 0 and len(rows) == 4 and all(row["is_solved"] for row in rows),
                  f"a run of four pairs: {first.out[:300]} {first.err}")
    text = (output / "results.jsonl").read_text()
    (output / "results.jsonl").write_text(text[:-20])
    made = [line for line in Run(words, scratch).out.splitlines() if line.startswith("small 1 ")]
    verdict.claim(len(made) == 1 and len(page.read_results(output / "results.jsonl")) == 4, f"one pair is made again: {made}")
    text = (output / "RESULTS.md").read_text()
    verdict.claim("| stokes-mac-2d |" in text and (output / "profiles.svg").stat().st_size > 1000, "there is a page with a picture")
    failed = {**rows[0], "is_solved": False, "message": "time limit"}
    verdict.claim("time limit" in page.table_of_failures(page.Results([failed])), "a failure is on the page with its message")


def main():
    programs, scratch = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    pages.PROGRAMS = catalogue.fsi.PROGRAMS = str(programs)
    verdict = Verdict()
    folders = check_made(verdict, scratch)
    check_default(verdict, programs, folders)
    check_run(verdict, programs, scratch)
    sys.exit(verdict.status())


if __name__ == "__main__":
    main()
