"""The default block preconditioner on the systems of xml/solvers-tiny.xml: Krylov iterations do not
depend on viscosity, time step, bulk modulus and ranks.

Usage: krylov_counts.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import sys

from runs import LONG, ROOT, Run, Verdict, agree, command, fresh, table, two_at_a_time, write_case

CASE = ROOT / "xml" / "solvers-tiny.xml"
SETTINGS = {"Fluid": ["block LU, GCR"], "Wall": ["block LU, BiCGStab", "block LU, GMRES"]}
MOST = {"block LU, GCR": 22, "block LU, BiCGStab": 12, "block LU, GMRES": 20}
VISCOSITY, TIME_STEP = 3.5e-3, 0.125


class Bench:
    """Runs of tunica-solvers in one folder."""

    def __init__(self, verdict, programs, folder):
        self.verdict, self.program, self.folder = verdict, programs / "tunica-solvers", folder
        write_case(CASE, folder / "case.xml", SETTINGS)

    def most(self, name, field, keys, ranks=1):
        """Setting -> most iterations of a Newton step; empty if the run fails."""
        words = ["case.xml", "--output", name]
        for key in ["Solvers/tolerance=1e-8", f"Solvers/field={field}"] + keys:
            words += ["--set", key]
        run = Run(command(self.program, words, ranks), self.folder)
        if not self.verdict.claim(run.status == 0, f"{name} ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            return {}
        rows = table(self.folder / name / "solvers.csv")
        counts = {s: [] for s in rows["setting"]}
        for setting, iterations in zip(rows["setting"], rows["iterations"]):
            counts[setting].append(iterations)
        result = {setting: max(values) for setting, values in counts.items()}
        for setting, n in result.items():
            self.verdict.claim(n <= MOST[setting] and set(rows["verdict"]) == {"converged"},
                               f"{name}: {setting} takes {n:.0f}, at most {MOST[setting]}")
        return result


def of_field(counts, field):
    return {setting: n for setting, n in counts.items() if setting in SETTINGS[field]}


def fluid_is_robust(verdict, bench, as_it_is):
    variants = {f"viscosity-{f:g}": [f"Fluid/viscosity={f * VISCOSITY}"] for f in (0.1, 10)}
    variants["step-0.1"] = [f"Time/step size={0.1 * TIME_STEP}"]
    # The inlet's load lasts longer than the long step.
    variants["step-10"] = [f"Time/step size={10 * TIME_STEP}", "Fluid/Surfaces/inlet/Amplitude/times={0, 10}"]
    counts = two_at_a_time([lambda name=name, keys=keys: bench.most(name, "fluid", keys) for name, keys in variants.items()])
    agree(verdict, "viscosity and time step", [of_field(as_it_is, "Fluid")] + counts, 2.5)


def wall_is_robust(verdict, bench, as_it_is):
    def of_modulus(modulus):
        return bench.most(f"bulk-{modulus}", "wall",
                          [f"Wall/Layers/{layer}/bulk modulus={modulus}" for layer in ("media", "adventitia")])
    moduli = ("1e3", "1e4", "1e7") if LONG else ("1e3", "1e7")  # the case has 1e5
    counts = two_at_a_time([lambda modulus=modulus: of_modulus(modulus) for modulus in moduli])
    agree(verdict, "bulk modulus", [of_field(as_it_is, "Wall")] + counts, 1.2)


def ranks_agree(verdict, bench, as_it_is):
    counts = [as_it_is] + [bench.most(f"ranks-{ranks}", "both", [], ranks) for ranks in ((2, 4) if LONG else (2,))]
    agree(verdict, "ranks", counts, 1.15, slack=2)


def main(programs, scratch):
    verdict = Verdict()
    bench = Bench(verdict, programs, fresh(scratch))
    as_it_is = bench.most("as-it-is", "both", [])
    fluid_is_robust(verdict, bench, as_it_is)
    wall_is_robust(verdict, bench, as_it_is)
    ranks_agree(verdict, bench, as_it_is)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
