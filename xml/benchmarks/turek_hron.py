"""The benchmarks of Turek and Hron: a flow bends an elastic beam behind a cylinder, or makes it swing."""
import numpy as np

from benchmark import Benchmark, arrays_of

X, Y = "wall_displacement_x_A_x_mm", "wall_displacement_y_A_y_mm"   # the end of the beam
DRAG, LIFT = "drag_body_mN_per_mm", "lift_body_mN_per_mm"           # of cylinder and beam together


class Slab(Benchmark):
    """Meshes of the plane, drawn out to slabs one cell thick."""
    columns = {"u_x(A)": X, "u_y(A)": Y, "drag": DRAG, "lift": LIFT}

    def script(self):
        return "make_turek_hron.py"

    def thickness(self, level):
        return 5 / level

    def conversion(self, level):
        return ["slab", "--thickness", self.thickness(level)]

    def flow(self, level, mean):
        """Settings of a mean velocity of the inflow, mm/ms."""
        thickness = self.thickness(level)
        return {"Mesh/file": self.make_mesh(level), "Fluid/Surfaces/inlet/flow rate": mean * 410 * thickness,
                "Output/Force Groups/body/per length": thickness}


class TurekHron(Slab):
    """The steady one of Turek's and Hron's, FSI1: the end of the beam, and forces on cylinder and beam together."""
    name, levels = "turek-hron", (1, 2, 3)
    title = "A flow bends a beam behind a cylinder"
    exact = {"u_x(A)": 2.270493e-2, "u_y(A)": 8.208773e-1, "drag": 14.29426, "lift": 0.763746}    # mm, N/m

    def settings(self, level, _):
        return self.flow(level, 0.2)

    def values(self, level):
        columns = arrays_of(self.folder(level))
        return {name: columns[column][-1] for name, column in self.columns.items()}

    def section(self):
        lines = ["FSI1 of S. Turek and J. Hron, LNCSE 53 (2006) 371-385; steady, in pseudo-time, on slabs one cell thick. "
                 "The published values are those of the finest tables of Featflow; its second mesh, with 19 k "
                 "unknowns of elements Q2-P1, has +0.73, -0.19, -0.14 and -0.26 %.", "",
                 "| tetrahedra: fluid + beam | u_x(A), mm | | u_y(A), mm | | drag, N/m | | lift, N/m | |", "|---|" + "---|" * 8]
        for m in self.complete_levels():
            v, e = self.values(m), self.errors(m)
            lines.append(f"| {self.size(m)} | " + " | ".join(f"{v[name]:.6g} | {100 * e[name]:+.2f} %" for name in v) + " |")
        lines.append("| *published* | " + " | ".join(f"*{value:.6g}* |" for value in self.exact.values()) + " |")
        return lines


def crests(values):
    """Extremes of a sampled curve, least and largest, each of a parabola through the extreme sample and its neighbours."""
    found = []
    for sign in (-1, 1):
        k = np.clip(np.argmax(sign * values), 1, len(values) - 2)
        a, b, c = values[k - 1:k + 2]
        bend = a - 2 * b + c
        found.append(b - (c - a) ** 2 / (8 * bend) if bend else b)
    return found


def rises(time, values):
    """Times at which the curve rises through zero."""
    k = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0))
    return time[k] - values[k] * (time[k + 1] - time[k]) / (values[k + 1] - values[k])


class SwingingBeam(Slab):
    """The two that swing by themselves, FSI2 and FSI3: mean, amplitude and frequency of the last periods.

    The first mesh begins at rest, each finer one with the end of the coarser; so does "half", in steps half as long.
    """
    name, levels = "swinging-beam", (0.5, 1, 2)
    title = "A beam swings behind a cylinder"
    cases = ("fsi3", "fsi2")
    main = "fsi3"
    # Mean and amplitude in mm and N/m; frequency of the end's u_y in Hz.
    exact = {"fsi3": {"u_x(A)": (-2.88, 2.72), "u_y(A)": (1.47, 34.99), "drag": (460.5, 27.74), "lift": (2.50, 153.91), "Hz": 5.46},
             "fsi2": {"u_x(A)": (-14.85, 12.70), "u_y(A)": (1.30, 81.6), "drag": (215.06, 77.65), "lift": (0.61, 237.8), "Hz": 1.93}}
    inflow = {"fsi3": 2.0, "fsi2": 1.0}                            # mean, mm/ms
    step_size = {"fsi3": 2.0, "fsi2": 5.0}                         # ms, some 90 and 100 in a period of u_y
    from_rest, from_coarser = {"fsi3": 4800, "fsi2": 16000}, {"fsi3": 1200, "fsi2": 6000}     # ms
    periods = 3

    def variants_of(self, level):
        return [*self.cases, *(f"{case}-half" for case in self.cases)] if level == self.levels[0] else self.cases

    def complete_levels(self):
        """Levels of which the page has something: each run takes hours."""
        return [m for m in self.levels if self.done(m)]

    def settings(self, level, variant):
        case, *half = variant.split("-")
        settings = self.flow(level, self.inflow[case])
        if case == "fsi2":
            settings.update({"Wall/Layers/beam/young modulus": 1400, "Wall/Layers/beam/density": 10})
        duration = self.from_rest[case]
        if half or level > self.levels[0]:
            duration = self.from_coarser[case]
            coarser = level if half else self.levels[self.levels.index(level) - 1]
            amplitude = "Fluid/Surfaces/inlet/Amplitude/"
            settings.update({"Time/initial state": self.folder(coarser, case), amplitude + "interpolation": "linear",
                             amplitude + "times": "{0, 1}", amplitude + "values": "{1, 1}"})
        size = self.step_size[case] / (2 if half else 1)
        steps = round(duration / size)
        return {**settings, "Time/step size": size, "Time/steps": steps, "Output/fields every": steps}

    def swing(self, level, variant):
        """Quantity -> mean and amplitude, averages of the last periods; the frequency; the change of u_y's amplitude in these."""
        columns = arrays_of(self.folder(level, variant))
        time, y = columns["time"], columns[Y]
        begins = rises(time, y - np.mean(crests(y[-len(y) // 3:])))[-self.periods - 1:]
        periods = [(time >= a) & (time < b) for a, b in zip(begins, begins[1:])]
        found = {}
        for name, column in self.columns.items():
            least, largest = np.mean([crests(columns[column][period]) for period in periods], axis=0)
            found[name] = ((largest + least) / 2, (largest - least) / 2)
        first, last = (np.ptp(crests(y[period])) for period in (periods[0], periods[-1]))
        return {**found, "Hz": 1000 * self.periods / (begins[-1] - begins[0]), "change": last / first - 1}

    def off(self, case, found):
        """Quantity -> error of an amplitude or of the frequency, in parts of what has been published."""
        size = lambda value: np.atleast_1d(value)[-1]  # noqa: E731
        return {name: size(found[name]) / size(value) - 1 for name, value in self.exact[case].items()}

    def errors(self, level):
        return {f"{case.upper()}, {name}": error for case in self.cases if self.is_done(level, case)
                for name, error in self.off(case, self.swing(level, case)).items()}

    def section(self):
        lines = ["FSI3 and FSI2 of S. Turek and J. Hron, LNCSE 53 (2006) 371-385, on slabs one cell thick: mean and amplitude of "
                 f"the last {self.periods} periods, u in mm, forces in N/m, and what amplitude and frequency are off. The first mesh "
                 "begins at rest and swings up by itself; each finer one, and half the step, begins with the end of the coarser. "
                 "The last column is the change of u_y's amplitude within these periods. Published: the finest tables of Featflow."]
        found = {case: [(m, v) for m in self.levels for v in self.done(m) if v.startswith(case)] for case in self.cases}
        for case in (case for case in self.cases if found[case]):
            lines += ["", f"{case.upper()}:", "", "| tetrahedra: fluid + beam | step, ms | "
                      + " | | ".join([*self.columns, "frequency, Hz"]) + " | | change |", "|---|" + "---|" * 12]
            lines += [self.row(m, variant) for m, variant in found[case]]
            *both, frequency = self.exact[case].values()
            cells = " | ".join(f"*{mean} ± {amplitude}* | " for mean, amplitude in both)
            lines.append(f"| *published* | | {cells} | *{frequency}* | | |")
        return lines

    def row(self, level, variant):
        case, found = variant.split("-")[0], self.swing(level, variant)
        cells = []
        for name, error in self.off(case, found).items():
            value = f"{found[name]:.3f}" if name == "Hz" else "{:.4g} ± {:.4g}".format(*found[name])
            cells.append(f"{value} | {100 * error:+.1f} %")
        step = self.step_size[case] / (2 if variant.endswith("half") else 1)
        return f"| {self.size(level)} | {step:g} | {' | '.join(cells)} | {100 * found['change']:+.2f} % |"
