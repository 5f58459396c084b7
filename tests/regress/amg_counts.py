"""The cycles of xml/paper/amg-*.xml on the coarse tube: few at every Newton step, and hardly more for
another bulk modulus or number of ranks.

Usage: amg_counts.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import sys

from runs import LONG, ROOT, Run, Verdict, agree, command, fresh, table, two_at_a_time, write_case

CASES = {
    "fluid": ("amg-fluid.xml", "Fluid", ["Braess-Sarazin 8+8", "Braess-Sarazin 4+4",
                                         "Braess-Sarazin 2+2, GCR", "node pairs 2+2, GCR",
                                         "nodal ILU(0) 3+3", "nodal ILU(0) 3+3, GCR"]),
    "wall": ("amg-mooney-rivlin.xml", "Wall", ["Vanka 12+12", "Vanka 6+6", "Vanka 2+2, GCR",
                                               "node pairs 2+2, GCR", "nodal ILU(0) 3+3",
                                               "nodal ILU(0) 3+3, GCR"]),
}
MOST_CYCLES, MOST_ITERATIONS = 15, 11
HALVED = {"Braess-Sarazin 4+4": "Braess-Sarazin 8+8", "Vanka 6+6": "Vanka 12+12"}


def counts(verdict, programs, folder, field, name, keys=(), ranks=1):
    """Setting -> iterations of each Newton step; empty if the run fails."""
    words = [f"{field}.xml", "--output", name, "--set", f"Solvers/field={field}"]
    for key in keys:
        words += ["--set", key]
    run = Run(command(programs / "tunica-solvers", words, ranks), folder)
    if not verdict.claim(run.status == 0, f"{name} ends with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return {}
    rows = table(folder / name / "solvers.csv")
    verdict.claim(set(rows["verdict"]) == {"converged"}, f"{name}: all converge")
    found = {}
    for setting, iterations in zip(rows["setting"], rows["iterations"]):
        found.setdefault(setting, []).append(iterations)
    return found


def are_few(verdict, name, found):
    for setting, values in found.items():
        most = MOST_ITERATIONS if "GCR" in setting else MOST_CYCLES
        verdict.claim(max(values) <= most, f"{name}: {setting} takes {values}, at most {most}")
    for half, full in HALVED.items():
        if half in found and full in found:
            ratio = max(h / f for h, f in zip(found[half], found[full]))
            verdict.claim(ratio <= 2, f"{name}: {half} takes at most {ratio:.2f} times {full}")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for field, (case, list_name, settings) in CASES.items():
        write_case(ROOT / "xml" / "paper" / case, folder / f"{field}.xml", {list_name: settings})
    step = ["Solvers/newton step=2"]

    def of_modulus(modulus):
        keys = step + [f"Wall/Layers/{layer}/bulk modulus={modulus}" for layer in ("media", "adventitia")]
        return counts(verdict, programs, folder, "wall", f"bulk-{modulus}", keys)
    *at_each_step, soft, stiff = two_at_a_time([
        *(lambda field=field: counts(verdict, programs, folder, field, field) for field in CASES),
        lambda: of_modulus("1e3"), lambda: of_modulus("1e7")])
    alone = {}
    for field, found in zip(CASES, at_each_step):
        are_few(verdict, field, found)
        alone[field] = {setting: values[1:2] for setting, values in found.items()}
        by_ranks = [alone[field]] + [counts(verdict, programs, folder, field, f"{field}-{ranks}", step, ranks)
                                     for ranks in ((2, 4) if LONG else (2,))]
        # Pairs across ranks are cut.
        pairs = [{s: n[0] for s, n in run.items() if "pairs" in s} for run in by_ranks]
        others = [{s: n[0] for s, n in run.items() if "pairs" not in s} for run in by_ranks]
        agree(verdict, f"{field}, ranks", others, 1.25, slack=1)
        agree(verdict, f"{field}, ranks", pairs, 1.7)
    by_modulus = [{s: n[0] for s, n in run.items()} for run in (alone["wall"], soft, stiff)]  # the case has 1e5
    agree(verdict, "bulk modulus", by_modulus, 1.2, slack=1)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
