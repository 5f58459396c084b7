"""A run keeps a budget: budget.csv, verdicts on the screen and in run.json.

    mass, forces, energy   close to what solvers leave, coupled by one Newton's method or by a fixed point
    loose tolerances       are told while the run goes on, at its end, in run.json and on the page
    a break, more ranks    change nothing
    Poiseuille             the pressure's power is Δp Q, and all of it is taken out at the end
    a wall from rest       what the load does is stored: the trapezoidal rule takes nothing
    an inflated tube       the lumen grows by what flows in, the wall keeps its volume

Usage: budget.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import math
import pathlib
import sys

from runs import MONOLITHIC, ROOT, TIGHT, Run, Verdict, command, fresh, table

TINY = ROOT / "xml" / "pulse-tiny.xml"
FEW = ["--set", "Output/fields every=0", "--set", "Output/checkpoint every=1"]
LOOSE = ["--set", "Coupling/Newton/absolute increment=0.1", "--set", "Coupling/Newton/linear tolerance=0.3"]
DROP, POISEUILLE = 1e-3, 0.0261  # kPa, and mm^3/ms by the law: pi R^4 p / (8 mu L)
UNIT = "_kPa_mm3_per_ms"


class Budgets:
    """Runs of cases, and what they leave."""

    def __init__(self, programs, folder, verdict):
        self.programs, self.folder, self.verdict = programs, folder, verdict

    def run(self, name, case, words, program="tunica-fsi", ranks=1):
        run = Run(command(self.programs / program, [case, "--output", name, *FEW, *words], ranks), self.folder)
        if not self.verdict.claim(run.status == 0, f"{name}: ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            sys.exit(1)
        return run

    def record(self, name):
        return json.loads((self.folder / name / "run.json").read_text())

    def part(self, name, of):
        return self.record(name)["budget"][of][2]

    def rows(self, name):
        return table(self.folder / name / "budget.csv")

    def closes(self, name, most, of=("mass", "forces", "energy", "wall volume")):
        for one in of:
            part = self.part(name, one)
            self.verdict.claim(part < most, f"{name}: solvers leave {part:.1e} of {one}")

    def adds_up(self, name):
        """What comes in is what is taken out and stored."""
        terms = self.record(name)["budget of energy [kPa mm^3]"]
        left = sum(value for term, value in terms.items() if term != "energy_change") - terms["energy_change"]
        self.verdict.claim(abs(left) < 1e-12 * abs(terms["load_power"]), f"{name}: the terms of its energy add up")
        return terms


def pulse(b):
    verdict = b.verdict
    b.run("straight", TINY, ["--steps", 4, *MONOLITHIC])
    b.closes("straight", 1e-6)
    b.adds_up("straight")
    rows = b.rows("straight")
    verdict.claim(rows["step"] == [1, 2, 3, 4], "budget.csv has a row for each step")
    verdict.claim(all(a <= c <= d <= e <= f for a, c, d, e, f in zip(*(rows[f"det_F_{q}"] for q in (0, 1, 50, 99, 100)))),
                  "the quantiles of det F are in order")
    steps = table(b.folder / "straight" / "steps.csv")
    verdict.claim(rows["volume_mm3"] == steps["fluid_volume_mm3"] and rows["det_F_0"] == steps["min_det_F"],
                  "it agrees with steps.csv")

    b.run("broken", TINY, ["--steps", 2, *MONOLITHIC])
    b.run("broken", TINY, ["--steps", 4, *MONOLITHIC, "--restart"])
    for section in ("budget", "budget verdicts", "budget of energy [kPa mm^3]"):
        verdict.claim(b.record("broken")[section] == b.record("straight")[section],
                      f"a run that goes on has the same {section}, to the last digit")
    verdict.claim((b.folder / "broken" / "budget.csv").read_text() == (b.folder / "straight" / "budget.csv").read_text(),
                  "and the same budget.csv")

    b.run("off", TINY, ["--steps", 2, *MONOLITHIC, "--set", "Output/budget=false"])
    verdict.claim(not (b.folder / "off" / "budget.csv").exists() and "budget" not in b.record("off"),
                  "no budget where the case wants none")
    b.run("off", TINY, ["--steps", 4, *MONOLITHIC, "--restart", "--set", "Output/budget=true"])
    energies, expected = (b.record(name)["budget of energy [kPa mm^3]"]["load_power"] for name in ("off", "straight"))
    verdict.claim(b.rows("off")["step"] == [3, 4] and 0 < energies < expected, "it may begin where a run goes on")


def ranks(b):
    for n in (1, 2):
        b.run(f"ranks-{n}", TINY, ["--steps", 1, *TIGHT], ranks=n)
    b.closes("ranks-1", 1e-11)
    one, two = b.rows("ranks-1"), b.rows("ranks-2")
    scale = {unit: max(abs(values[0]) for column, values in one.items() if column.endswith(unit))
             for unit in ("mm3", "mm3_per_ms", "mN", "det_F_0", "1", "50", "99", "100", UNIT)}
    worst = max((abs(one[column][0] - two[column][0]) / scale[unit], column)
                for column in one for unit in scale if column.endswith(unit) and scale[unit] > 0.0)
    b.verdict.claim(worst[0] < 1e-9, f"2 ranks have the same budget, but for {worst[0]:.1e} of {worst[1]}")


def partitioned(b):
    b.run("partitioned", TINY, ["--steps", 1, "--set", "Coupling/scheme=dirichlet-neumann"])
    b.closes("partitioned", 1e-9)
    b.adds_up("partitioned")


def loose(b):
    verdict = b.verdict
    run = b.run("loose", TINY, ["--steps", 3, *MONOLITHIC, *LOOSE])
    part = b.part("loose", "mass")
    residuals = b.part("loose", "residuals")
    verdict.claim(part < 0.1 and residuals > part, f"more is left at vertices ({residuals:.1e}) than of their sum")
    verdict.claim(part > 1e-6, f"loose tolerances leave {part:.1e} of the mass")
    verdict.claim(run.err.count("warning: mass is not kept") == 1, "it is told once while the run goes on")
    verdict.claim("warning: budget of mass: solvers lost or gained" in run.err, "and at its end")
    page = Run(command(b.programs / "tunica-report", ["loose", "--no-fields"]), b.folder)
    text = (b.folder / "loose" / "report" / "index.html").read_text()
    verdict.claim(page.status == 0 and "SOLVERS HAVE NOT KEPT THE BUDGET of mass" in text and "NOT KEPT" in text,
                  "the page says so")
    run = b.run("permitted", TINY, ["--steps", 3, *MONOLITHIC, *LOOSE, "--set", "Output/budget solver bound=1",
                                    "--set", "Output/budget scheme bound=1e-9"])
    verdict.claim("warning: mass" not in run.err and "warning: budget" not in run.err, "unless the case permits it")
    verdict.claim("budget of losses" in run.out and "BEYOND 1e-09" in run.out, "what the scheme takes has a bound of its own")


def poiseuille(b):
    b.run("poiseuille", ROOT / "xml" / "poiseuille.xml", [], "tunica-fluid")
    b.closes("poiseuille", 1e-12, ("mass", "forces", "energy"))
    b.adds_up("poiseuille")
    last = {column: values[-1] for column, values in b.rows("poiseuille").items()}
    steps = {column: values[-1] for column, values in table(b.folder / "poiseuille" / "steps.csv").items()}
    flow = steps["inflow_inlet_mm3_per_ms"]
    load = last["load_power" + UNIT]
    b.verdict.claim(math.isclose(load, DROP * flow, rel_tol=1e-9), f"the pressure's power is the drop times the flow: {load:.4g}")
    b.verdict.claim(abs(load / (DROP * POISEUILLE) - 1.0) < 0.02, "which is that of Poiseuille's law")
    taken = last["viscous_power" + UNIT] + last["stabilisation_power" + UNIT]
    b.verdict.claim(abs(taken / load - 1.0) < 1e-3, f"viscosity and stabilisation take {taken / load:.5f} of it")
    b.verdict.claim(math.isclose(last["throughput_mm3_per_ms"], flow, rel_tol=1e-6), "the throughput is the flow")


def wall(b):
    """A quarter of a tube, inflated from rest: no fluid."""
    words = ["--steps", 20, "--set", "Wall/analysis=dynamic", "--set", "Wall/time scheme=trapezoidal",
             "--set", "Time/step size=0.04"]
    b.run("wall", ROOT / "xml" / "inflation.xml", words, "tunica-solid")
    b.closes("wall", 1e-12, ("forces", "energy", "wall volume"))
    terms = b.adds_up("wall")
    kept = terms["energy_change"] / terms["load_power"]
    b.verdict.claim(abs(kept - 1.0) < 5e-3, f"the trapezoidal rule keeps {kept:.4f} of what the load does")
    rows = b.rows("wall")
    b.verdict.claim(abs(rows["det_F_50"][-1] - 1.0) < 1e-3 and "throughput_mm3_per_ms" not in rows, "its volume is kept")
    b.run("static", ROOT / "xml" / "inflation.xml", ["--steps", 1], "tunica-solid")
    b.closes("static", 1e-12, ("forces", "wall volume"))
    b.verdict.claim("energy" not in b.record("static")["budget"], "an equilibrium has no powers")


def main(programs, scratch):
    budgets = Budgets(programs, fresh(scratch), Verdict())
    for part in (pulse, ranks, partitioned, loose, poiseuille, wall):
        part(budgets)
    return budgets.verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
