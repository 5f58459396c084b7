"""The cases of xml/monolithic/ that partitioned coupling cannot run, or hardly: one Newton's method
runs them, and where the other goes some steps of the way both agree.

Usage: beyond_partitioned.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import sys

from runs import LONG, ROOT, Run, Verdict, command, fresh, table

PARTITIONED = ["Coupling/scheme=dirichlet-neumann"]
COMPARED = ("max_displacement_wall_mm", "max_speed_mm_per_ms", "fluid_pressure_max_kPa",
            "wall_pressure_max_kPa", "elastic_energy_kPa_mm3", "fluid_volume_mm3")


class Runs:
    def __init__(self, verdict, programs, folder):
        self.verdict, self.program, self.folder = verdict, programs / "tunica-fsi", folder

    def run(self, case, settings=(), steps=None):
        words = [ROOT / "xml" / "monolithic" / f"{case}.xml", "--overwrite", "--output", case]
        words += ["--steps", steps] if steps else []
        for setting in ["Output/fields every=0", *settings]:
            words += ["--set", setting]
        return Run(command(self.program, words), self.folder)

    def history(self, case, most, steps=None):
        """Of the monolithic run, each of whose steps takes so many Newton steps at most."""
        done = self.run(case, steps=steps)
        self.verdict.claim(done.status == 0, f"{case}: ends with 0 ({done.seconds:.1f} s)")
        if done.status != 0:
            print(done.out + done.err)
        rows = table(self.folder / case / "steps.csv")
        self.verdict.claim(max(rows["system_newton"]) <= most,
                           f"{case}: {max(rows['system_newton']):.0f} Newton steps, at most {most}")
        return rows

    def agree(self, case, one, other, steps):
        for name in COMPARED:
            a, b = one[name][:steps], other[name][:steps]
            scale = max(map(abs, a))
            error = max(abs(x - y) for x, y in zip(a, b)) / scale
            self.verdict.claim(len(b) == steps and error < 1e-5,
                               f"{case}: {name} differs by {error:.1e} of {scale:.4g}")


def balloon(runs):
    rows = runs.history("balloon", 8)
    # What has flowed in makes the volume grow, and the pressure with it.
    time, inflow, volume = rows["time"], rows["inflow_inlet_mm3_per_ms"], rows["fluid_volume_mm3"]
    first = 4
    came = sum(0.5 * (inflow[k] + inflow[k - 1]) * (time[k] - time[k - 1])
               for k in range(first + 1, len(time)))
    grew = volume[-1] - volume[first]
    runs.verdict.claim(abs(grew / came - 1.0) < 1e-3 and grew > 4.0,
                       f"balloon: {came:.4f} mm^3 flow in, it grows by {grew:.4f} mm^3")
    pressure = rows["mean_pressure_interface_kPa"]
    runs.verdict.claim(pressure[-1] > 2.0 * pressure[len(pressure) // 2] > 0.0,
                       f"balloon: its pressure rises to {pressure[-1]:.4f} kPa")
    other = runs.run("balloon", PARTITIONED)
    runs.verdict.claim(other.status == 1 and "without an open surface" in other.err,
                       "balloon: partitioned coupling refuses what flows in")


def light_wall(runs):
    rows = runs.history("light-wall", 12)
    steps = 2 if LONG else 1
    runs.run("light-wall", PARTITIONED + ["Coupling/tolerance=1e-9"], steps=steps)
    other = table(runs.folder / "light-wall" / "steps.csv")
    runs.agree("light-wall", rows, other, steps)
    runs.verdict.claim(min(other["coupling_iterations"]) >= 15,
                       f"light-wall: partitioned coupling takes {other['coupling_iterations']}")


def long_step(runs):
    rows = runs.history("long-step", 14)
    # A load that comes at once is too much for so few full steps of Newton's method.
    sudden = runs.run("long-step", ["Fluid/Surfaces/inlet/Amplitude/values={1,1,0}",
                                    "Coupling/Newton/max iterations=4"], steps=3)
    tries = table(runs.folder / "long-step" / "steps.csv")["coupling_iterations"]
    runs.verdict.claim(sudden.status == 0 and max(tries) == 2 and len(tries) == 3,
                       f"long-step, loaded at once: {tries} attempts, the second with care")
    runs.run("long-step", PARTITIONED + ["Coupling/tolerance=1e-9"])
    other = table(runs.folder / "long-step" / "steps.csv")
    runs.agree("long-step", rows, other, len(rows["time"]))
    runs.verdict.claim(max(other["coupling_iterations"]) >= 15,
                       f"long-step: partitioned coupling takes {other['coupling_iterations']}")


def flap(runs):
    rows = runs.history("flap", 10)
    tip = rows["wall_displacement_tip_mm"]
    runs.verdict.claim(0.05 < max(tip) < 0.1, f"flap: its tip moves by {max(tip):.4f} mm")
    other = runs.run("flap", PARTITIONED + ["Coupling/tolerance=1e-9"])
    runs.verdict.claim(other.status == 2, "flap: partitioned coupling fails on the way")
    runs.agree("flap", rows, table(runs.folder / "flap" / "steps.csv"), 4)


def main(programs, scratch):
    verdict = Verdict()
    runs = Runs(verdict, programs, fresh(scratch))
    for case in (balloon, light_wall, long_step, flap):
        case(runs)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
