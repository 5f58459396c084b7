"""tunica-solvers on linear systems that another program wrote, in several orders, on 1 and 4 ranks.

Usage: foreign_system.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table
from taylor_hood import write_system

DIVISIONS = 12
CASE = ROOT / "xml" / "system.xml"
CONVERGE = ["direct", "block LU, GCR", "Vanka 2+2, GCR", "Braess-Sarazin 2+2, GCR", "Braess-Sarazin 8+8"]

# Runs a command and says how much the largest process had [KB].
PEAK = ("import resource, subprocess, sys; status = subprocess.call(sys.argv[1:]); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(status)")


def solve(programs, scratch, name, files, ranks=1, settings=()):
    words = [CASE, "--output", scratch / name]
    for key, value in list(files.items()) + list(settings):
        words += ["--set", f"{key}={value}"]
    return Run(command(programs / "tunica-solvers", words, ranks), scratch)


def files_in(folder, *names):
    return {f"System/{name}": folder / f"{name}.mtx" for name in names}


def counts(folder):
    rows = table(folder / "solvers.csv")
    return dict(zip(rows["setting"], rows["iterations"])), dict(zip(rows["setting"], rows["verdict"]))


def error_of_pressure(path):
    """Against p = 8 (1 - x), which Taylor-Hood elements represent, in the order by component."""
    with open(path) as file:
        values = [float(line) for line in file if not line.startswith("%") and len(line.split()) == 1]
    n = DIVISIONS + 1
    pressures = values[-n * n:]
    return max(abs(p - 8 * (1 - (k % n) / DIVISIONS)) for k, p in enumerate(pressures))


def check_orders(verdict, programs, scratch):
    first = None
    for order in ("by component", "by node", "shuffled"):
        folder = scratch / order.replace(" ", "-")
        write_system(folder, DIVISIONS, order)
        files = files_in(folder, "A", "B2", "rhs")
        if order == "shuffled":
            settings = [("System/node map", folder / "nodes.txt")]
        else:
            settings = [("System/order", order)]
        for ranks in (1, 4):
            name = f"{folder.name}-{ranks}"
            run = solve(programs, scratch, name, files, ranks, settings)
            if not verdict.claim(run.status == 0, f"{name}: status {run.status} {run.err}"):
                continue
            iterations, verdicts = counts(scratch / name)
            failed = [s for s in CONVERGE if verdicts[s] != "converged"]
            verdict.claim(not failed, f"{name}: all converge but {failed}: {iterations}")
            rows = table(scratch / name / "solvers.csv")
            apart = max(d for s, d in zip(rows["setting"], rows["difference"]) if s in CONVERGE)
            verdict.claim(apart < 1e-5, f"{name}: solutions are {apart:.1e} apart")
            if order == "by component":
                error = error_of_pressure(scratch / name / "solution.mtx")
                verdict.claim(error < 1e-5, f"{name}: error of the pressure {error:.1e}")
            if ranks == 1:
                first = first or iterations
                verdict.claim(all(iterations[s] == first[s] for s in CONVERGE),
                              f"{name}: counts do not hang on the order of the files")


def check_numbers(verdict, programs, scratch):
    """Nodes may be counted from any number and with gaps."""
    folder = scratch / "shuffled"
    lines = (folder / "nodes.txt").read_text().split("\n")[:-1]
    far = folder / "far.txt"
    far.write_text("".join(" ".join([str(7 + 1000000 * int(words[0]))] + words[1:]) + "\n"
                           for words in (line.split() for line in lines)))
    for ranks in (1, 3):
        run = solve(programs, scratch, f"far-{ranks}", files_in(folder, "A", "B2", "rhs"), ranks,
                    [("System/node map", far)])
        _, verdicts = counts(scratch / f"far-{ranks}") if run.status == 0 else ({}, {})
        verdict.claim(run.status == 0 and all(verdicts[s] == "converged" for s in CONVERGE),
                      f"numbers with gaps, {ranks} ranks: {verdicts} {run.err}")


def check_own_export(verdict, programs, scratch):
    """What is exported and read back is the system that was solved before."""
    case = ROOT / "xml" / "solvers-tiny.xml"
    run = Run(command(programs / "tunica-solvers",
                      [case, "--output", scratch / "own", "--export", scratch / "systems",
                       "--set", "Solvers/newton step=1", "--set", "Solvers/field=wall"]), scratch)
    verdict.claim(run.status == 0, "the systems of a case are exported")
    files = files_in(scratch / "systems" / "wall-newton-1", "A", "B1T", "B2", "C", "rhs")
    again = solve(programs, scratch, "again", files, 1, [("System/components", 3), ("System/order", "by node"),
                  ("Solvers/Settings/ILU(1), GMRES/max iterations", 300), ("System/scaling", "none"), ("Solvers/tolerance", 1e-10)])
    verdict.claim(again.status == 0, f"and read back {again.err}")
    rows = table(scratch / "own" / "solvers.csv")
    before = dict(zip(rows["setting"], rows["iterations"]))["ILU(1), GMRES"]
    after = counts(scratch / "again")[0]["ILU(1), GMRES"]
    verdict.claim(before == after, f"ILU(1) takes {before:g} iterations before, {after:g} after")
    sizes = json.loads((scratch / "again" / "solvers.json").read_text())["solves"][0]["unknowns"]
    verdict.claim(sizes == rows["unknowns"][0], f"{sizes} unknowns")


def check_refusals(verdict, programs, scratch):
    good = scratch / "by-component"
    broken = scratch / "broken.mtx"
    broken.write_text("%%MatrixMarket matrix coordinate real general\n3 3 2\n1 1 1.0\n5 1 1.0\n")
    short = scratch / "nodes.txt"
    short.write_text("0 0\n0 1\n1 0\n")
    twice = scratch / "twice.txt"
    twice.write_text("0 0\n0 0\n")
    files = files_in(good, "A", "B2", "rhs")
    junk = scratch / "junk.txt"
    junk.write_text("0 0\n0.7\n")
    cases = {
        "junk in the map": (files, [("System/node map", junk)], "junk.txt, line 2: found \".7\" after"),
        "missing file": ({**files, "System/A": good / "AA.mtx"}, [], "AA.mtx"),
        "entry outside": ({**files, "System/A": broken}, [], "broken.mtx"),
        "A not square": ({**files, "System/A": good / "B2.mtx"}, [], "A is"),
        "wrong B2": ({**files, "System/B2": good / "A.mtx"}, [], "rhs has"),
        "no matrix": ({**files, "System/rhs": good / "nodes.txt"}, [], "nodes.txt"),
        "components": (files, [("System/components", 3)], "components"),
        "word": (files, [("System/order", "by nod")], "by node"),
        "key": (files, [("System/ordr", "by node")], "order"),
        "short map": (files, [("System/node map", short)], "unknowns, expected"),
        "double unknown": (files, [("System/node map", twice)], "twice.txt, line 2"),
    }
    for name, (given, settings, expected) in cases.items():
        for ranks in (1, 2) if name == "entry outside" else (1,):
            run = solve(programs, scratch, "refused", given, ranks, settings)
            said = [line for line in run.err.splitlines() if line.startswith("tunica-solvers:")]
            verdict.claim(run.status == 1 and len(said) == 1 and expected in run.err and
                          not (scratch / "refused").exists(),
                          f"{name} is refused: {run.status} {run.err.strip()[:160]}")


def write_wide(folder, nodes=6000, reach=10):
    """A chain of nodes of three components and a scalar, each coupled to many on both sides."""
    folder.mkdir()

    def write(name, rows, columns):
        near = [(i, j) for i in range(nodes) for j in range(max(0, i - reach), min(nodes, i + reach + 1))]
        with open(folder / f"{name}.mtx", "w") as file:
            file.write("%%MatrixMarket matrix coordinate real general\n"
                       f"{rows * nodes} {columns * nodes} {len(near) * rows * columns}\n")
            for i, j in near:
                file.writelines(f"{rows * i + a + 1} {columns * j + b + 1} {99 if i == j and a == b else 1}\n"
                                for a in range(rows) for b in range(columns))

    write("A", 3, 3)
    write("B2", 1, 3)
    (folder / "rhs.mtx").write_text(f"%%MatrixMarket matrix array real general\n{4 * nodes} 1\n" + "1\n" * 4 * nodes)


def check_memory(verdict, programs, scratch):
    """No rank has more than its rows of what is read."""
    write_wide(scratch / "wide")

    def peak(folder, ranks, components, order):
        words = [CASE, "--dry-run", "--set", f"System/components={components}", "--set", f"System/order={order}"]
        for key, value in files_in(folder, "A", "B2", "rhs").items():
            words += ["--set", f"{key}={value}"]
        run = Run([sys.executable, "-c", PEAK] + command(programs / "tunica-solvers", words, ranks), scratch)
        verdict.claim(run.status == 0, f"{folder.name} is read on {ranks} ranks {run.err}")
        return int(run.out.split()[-1]) / 1024

    program = peak(scratch / "by-component", 4, 2, "by component")
    one, four = (peak(scratch / "wide", ranks, 3, "by node") - program for ranks in (1, 4))
    verdict.claim(four < 0.5 * one, f"beside the {program:.0f} MB of the program a system takes {one:.0f} MB on one "
                                    f"rank, {four:.0f} MB on each of four")


def main():
    programs, scratch = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    verdict = Verdict()
    check_orders(verdict, programs, scratch)
    check_numbers(verdict, programs, scratch)
    check_own_export(verdict, programs, scratch)
    check_memory(verdict, programs, scratch)
    check_refusals(verdict, programs, scratch)
    sys.exit(verdict.status())


if __name__ == "__main__":
    main()
