"""The default preconditioner of monolithic coupling on the coarse tube: GCR iterations to 1e-8 stay few
whatever the time step, the wall's bulk modulus and density, the material and the number of ranks.

Usage: monolithic_counts.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table, two_at_a_time

CASES = ROOT / "xml" / "monolithic"
AIM = 8
TIME_STEP = 0.125
LONG_STEP = 10  # beyond the aim, as the page of monolithic coupling says


def of_layers(key, value):
    return [f"Wall/Layers/{layer}/{key}={value}" for layer in ("media", "adventitia")]


# Name, case, settings, ranks, most iterations.
VARIANTS = [
    ("as-it-is", "default", [], 1, AIM),
    ("short-step", "default", [f"Time/step size={0.1 * TIME_STEP}"], 1, AIM),
    ("long-step", "default", [f"Time/step size={10 * TIME_STEP}"], 1, LONG_STEP),
    ("soft", "default", of_layers("bulk modulus", "1e3"), 1, AIM),
    ("stiff", "default", of_layers("bulk modulus", "1e7"), 1, AIM),
    ("light", "default", of_layers("density", 0.1), 1, AIM),
    ("heavy", "default", of_layers("density", 10), 1, AIM),
    ("artery", "default-artery", [], 1, AIM),
    ("four-ranks", "default", [], 4, AIM),
]
MOST_BY_RANKS = 1.2  # over those of one rank


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    counts = {}

    def solve(name, case, settings, ranks, most):
        words = [CASES / f"{case}.xml", "--output", name]
        for setting in settings:
            words += ["--set", setting]
        run = Run(command(programs / "tunica-solvers", words, ranks), folder)
        if not verdict.claim(run.status == 0, f"{name} ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return
        rows = table(folder / name / "solvers.csv")
        counts[name] = rows["iterations"][0]
        verdict.claim(rows["verdict"] == ["converged"] and 0 < counts[name] <= most,
                      f"{name}: {counts[name]:.0f} iterations, at most {most}")
    two_at_a_time([lambda variant=variant: solve(*variant) for variant in VARIANTS if variant[3] == 1])
    for variant in [one for one in VARIANTS if one[3] > 1]:
        solve(*variant)
    if {"as-it-is", "four-ranks"} <= counts.keys():
        verdict.claim(counts["four-ranks"] <= max(MOST_BY_RANKS * counts["as-it-is"], counts["as-it-is"] + 1),
                      f"{counts['four-ranks']:.0f} on four ranks, {counts['as-it-is']:.0f} on one")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
