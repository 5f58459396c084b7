"""A channel whose wall is in part elastic, and has hardly any mass."""
import math
import os
from xml.etree import ElementTree

import numpy as np

from benchmark import Benchmark, arrays_of, limit_of, order_of
from pages import has_ended

PLACES = ("¼", "½", "¾")
COLUMNS = ("wall_displacement_y_quarter_mm", "wall_displacement_y_half_mm", "wall_displacement_y_three_quarters_mm")
# Of a beam of Kirchhoff's and Love's without mass, by oomph-lib, as solids4foam publishes them: mm, and ms.
STATIC = (-96.45925, -143.62832, -96.45925)
AT = {250: (-41.85, -55.96, -30.58), 1000: (-98.70, -147.19, -99.47)}
TROUGH = (((-148.2, 461), (-216.00, 469), (-151.3, 478)), (300, 650))        # and between which times it is looked for
REBOUND = (((-34.1, 775), (-40.43, 791), (-19.5, 797)), (650, 950))
ACCELERATORS = {"aitken": "Aitken", "iqn-ils": "IQN-ILS, columns of up to 8 steps",
                "iqn-ils anew": "IQN-ILS, columns of the step alone"}
PARTITIONED_STEPS = 3


def plate(load=200.0, length=10.0, thickness=0.05, modulus=455e6, ratio=0.3):
    """Deflections [m] at a quarter and at half of a long plate between clamps, which load bends and stretches:
    S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed., section 3; cylindrical bending.

      D w'''' - T w'' = q,   w = w' = 0 at the ends,   T = E'h/(2 l) ∫ w'^2 dx,   E' = E/(1 - nu^2),  D = E' h^3/12
    """
    stiffness = modulus / (1 - ratio ** 2)
    bending = stiffness * thickness ** 3 / 12
    a = 0.5 * length
    x = np.linspace(0.0, a, 4001)

    def bent(tension):
        k = math.sqrt(tension / bending)
        c = load * a / (tension * k * math.sinh(k * a))
        w = load / (2 * tension) * (a ** 2 - x ** 2) - c * (math.cosh(k * a) - np.cosh(k * x))
        return w, -load * x / tension + c * k * np.sinh(k * x)

    low, high = 1e-3 * load * length, 1e3 * load * length
    while high / low > 1 + 1e-12:
        tension = math.sqrt(low * high)
        slope = bent(tension)[1]
        square = 0.5 * np.sum((slope[1:] ** 2 + slope[:-1] ** 2) * np.diff(x)) * 2 / length  # its mean
        low, high = (tension, high) if 0.5 * stiffness * thickness * square > tension else (low, tension)
    w = bent(low)[0]
    return -w[len(x) // 2], -w[0]


def extremum(t, y, least, most, sign):
    """Value and time of the least (sign 1) or the largest (-1) y between two times, by a parabola through three steps."""
    inside = np.flatnonzero((t > least) & (t < most))
    k = inside[np.argmin(sign * y[inside])]
    a, b, c = np.polyfit(t[k - 1:k + 2] - t[k], y[k - 1:k + 2], 2)
    return c - b * b / (4 * a), t[k] - b / (2 * a)


class CollapsibleChannel(Benchmark):
    """Vertical displacements of the wall at a quarter, half and three quarters of its length."""
    name, levels, variants = "collapsible-channel", (1, 1.5, 2, 4), ("static", "start", "")
    title = "A channel collapses"
    exact = STATIC[1]

    def variants_of(self, level):
        if level == 4:
            return ("static",)
        return self.variants + (("long steps", *ACCELERATORS) if level == 1 else ())

    def is_done(self, level, variant=""):
        how = ("done", "not converged") if variant in ACCELERATORS else ("done",)
        return has_ended(self.folder(level, variant), how)

    def complete_levels(self):
        """Where the wall alone has been computed; not all have a swing."""
        return [m for m in self.levels if self.is_done(m, "static")]

    def has_swing(self, level):
        return self.is_done(level)

    def settings(self, level, variant):
        settings = {"Mesh/file": self.make_mesh(level)}
        if variant == "static":
            # Forces of bending are small beside those that lengthen elements: round-off leaves 1e-8 of them.
            return {**settings, "Time/step size": 50, "Time/steps": 5, "Wall/analysis": "static",
                    "Wall/Linear Solver/method": "direct", "Wall/Newton/linear tolerance": 1e-4}
        if variant == "start":
            return {**settings, "Time/step control": "steady", "Time/step size": 1e8, "Time/tolerance": 1e-4,
                    "Output/fields every": 1, "Output/budget": "false", "Fluid/Linear Solver/method": "direct"}
        settings["Time/initial state"] = self.folder(level, "start")
        if variant == "long steps":
            settings.update({"Time/step size": 10, "Time/steps": 100})
        if variant in ACCELERATORS:
            settings.update({"Time/steps": PARTITIONED_STEPS, "Coupling/scheme": "dirichlet-neumann",
                             "Coupling/accelerator": variant.split(" ", maxsplit=1)[0], "Coupling/tolerance": 1e-3,
                             "Fluid/Linear Solver/method": "direct", "Fluid/Newton/absolute increment": 1e-6,
                             "Wall/Linear Solver/method": "direct", "Wall/Newton/linear tolerance": 1e-4,
                             "Wall/Newton/absolute increment": 1e-6})
        if variant == "iqn-ils anew":
            settings["Coupling/reused steps"] = 0
        return settings

    def case(self, variant):
        """Without what monolithic coupling alone knows, where that is not the scheme."""
        if variant not in ACCELERATORS:
            return super().case(variant)
        tree = ElementTree.parse(super().case(variant))
        coupling = tree.getroot().find("ParameterList[@name='Coupling']")
        coupling.clear()
        coupling.set("name", "Coupling")
        path = os.path.join(self.output, f"{self.name}-{variant}.xml")
        tree.write(path)
        return path

    def run_one(self, level, variant, program="tunica-fsi", statuses=(0,)):
        program = {"static": "tunica-solid", "start": "tunica-fluid"}.get(variant, program)
        super().run_one(level, variant, program, (0, 2) if variant in ACCELERATORS else statuses)

    def static(self, level):
        columns = arrays_of(self.folder(level, "static"))
        return [columns[name][-1] for name in COLUMNS]

    def swing(self, level, variant=""):
        """Quantity -> at each place (displacement, time)."""
        columns = arrays_of(self.folder(level, variant))
        t = columns["time"]
        found = {}
        for name, (_, (least, most)), sign in (("trough", TROUGH, 1), ("rebound", REBOUND, -1)):
            found[name] = [extremum(t, columns[column], least, most, sign) for column in COLUMNS]
        for time in (time for time in AT if time <= t[-1]):
            k = np.argmin(abs(t - time))
            found[f"{time} ms"] = [(columns[column][k], t[k]) for column in COLUMNS]
        return found

    def errors(self, level):
        errors = {f"static, {place}": value / exact - 1 for place, value, exact in
                  zip(PLACES[:2], self.static(level), STATIC)}
        if self.has_swing(level):
            for name, (exact, _) in (("trough", TROUGH), ("rebound", REBOUND)):
                (value, time), (exact_value, exact_time) = self.swing(level)[name][1], exact[1]
                errors[f"{name}, ½"] = value / exact_value - 1
                errors[f"time of the {name}"] = time / exact_time - 1
        return errors

    def section(self):
        quarter, half = plate()
        lines = ["A channel of 25 x 1 m, whose upper wall is elastic from 5 to 15 m: 0.05 m thick, clamped, E = 455 MPa, ν = 0.3. "
                 "Re 50; 6 Pa at the inlet, 0 at the outlet, parallel flow at both; begins with that flow, and the wall flat. "
                 "200 Pa from outside within 0.25 s. Published: the case collapsibleChannel of solids4foam, with a beam by "
                 "oomph-lib, good to 0.3 %. The beam has no mass; here the wall has 0.01 of the fluid's density, where "
                 "0.28 % belong to 1. Slices one cell thick, BDF2, steps of 5 ms.", "",
                 "The outer pressure alone, displacements in mm:", "", "| tetrahedra: wall | ¼ | | ½ | |", "|---|---|---|---|---|"]
        levels = self.complete_levels()
        for m in levels:
            tets = self.record(m, "static")["sizes"]["wall tetrahedra"]
            cells = " | ".join(f"{value:.3f} | {100 * (value / exact - 1):+.2f} %" for value, exact in
                               zip(self.static(m)[:2], STATIC))
            lines.append(f"| {tets:,} | {cells} |")
        lines += [f"| *a plate's closed form* | *{1000 * quarter:.3f}* | | *{1000 * half:.3f}* | |",
                  f"| *published* | *{STATIC[0]:.3f}* | | *{STATIC[1]:.3f}* | |", ""]
        return lines + self.limits_of_statics(levels) + self.swings(levels)

    def limits_of_statics(self, levels):
        if len(levels) < 2:
            return []
        texts = []
        for k in range(2):
            limit = limit_of(levels, [self.static(m)[k] for m in levels])
            texts.append(f"{100 * (limit / STATIC[k] - 1):+.2f} % at {PLACES[k]}")
        return [f"Extrapolated from the last two, at second order: {' and '.join(texts)}. Cells of the wall are cut into four by "
                "their diagonals; what is off is bending, which linear elements resist too much.", ""]

    def swings(self, levels):
        levels = [m for m in levels if self.has_swing(m)]
        if not levels:
            return []
        is_last = len(levels) > 1
        lines = ["With the flow, in mm, troughs and rebounds at which time in ms; in brackets what both are off:", "",
                 "| | | " + " | ".join(f"{self.size(m)} tetrahedra" for m in levels) + (" | extrapolated" if is_last else "") +
                 " | *published* |", "|---|---|" + "---|" * (len(levels) + 1 + is_last)]
        swings = [self.swing(m) for m in levels]
        exact = {"250 ms": [(value, None) for value in AT[250]], "first trough": TROUGH[0], "first rebound": REBOUND[0],
                 "1000 ms": [(value, None) for value in AT[1000]]}
        for name, values in exact.items():
            if name.endswith("ms") and not all(name in swing for swing in swings):
                continue
            for k, (value, time) in enumerate(values):
                found = [swing[name.rsplit(" ", maxsplit=1)[-1] if time else name][k] for swing in swings]
                if is_last:
                    found.append(tuple(limit_of(levels, each) for each in zip(*found)))
                cells = [f"{y:.2f}" + (f" at {t:.1f}" if time else "") + f" ({100 * (y / value - 1):+.1f} %" +
                         (f", {100 * (t / time - 1):+.1f} %)" if time else ")") for y, t in found]
                lines.append(f"| {name} | {PLACES[k]} | " + " | ".join(cells) + f" | *{value:.2f}{f' at {time}' if time else ''}* |")
        return lines + [""] + self.orders(levels, swings) + self.of_steps_and_schemes()

    def orders(self, levels, swings):
        if len(levels) < 3:
            return []
        found = {name: order_of(levels, [swing[name][1][0] for swing in swings]) for name in ("trough", "rebound")}
        return ["Orders at ½ from three meshes: " + ", ".join(f"{order:.1f} for the {name}" if order else f"none for the {name}"
                                                              for name, order in found.items()) + ".", ""]

    def of_steps_and_schemes(self):
        if not all(self.is_done(1, variant) for variant in ("", "long steps", *ACCELERATORS)):
            return []
        short, long = (self.swing(1, variant) for variant in ("", "long steps"))
        third = {name: 100 * (short[name][1][0] / long[name][1][0] - 1) / 3 for name in ("trough", "rebound")}
        lines = [f"Time steps: on the first mesh, by the difference from steps of 10 ms, those of 5 ms have an error of "
                 f"{-third['trough']:+.2f} % in the first trough at ½ and of {-third['rebound']:+.2f} % in the rebound.", "",
                 f"Partitioned, Dirichlet-Neumann with the added mass preconditioner, to 1e-3 mm, the first {PARTITIONED_STEPS} "
                 "steps on the first mesh:", "",
                 "| | steps done | iterations a step | at most | |", "|---|---|---|---|---|"]
        monolithic = arrays_of(self.folder(1))
        for variant, name in ACCELERATORS.items():
            columns = arrays_of(self.folder(1, variant))
            done, iterations = int(np.sum(columns["converged"])), columns["coupling_iterations"]
            off = max(abs(columns[column][done - 1] - monolithic[column][done - 1]) for column in COLUMNS)
            largest = max(abs(monolithic[column][done - 1]) for column in COLUMNS)
            end = "fails" if done < PARTITIONED_STEPS else f"{off:.1g} mm of {largest:.2g} mm from monolithic at the end"
            lines.append(f"| {name} | {done} | {np.mean(iterations):.1f} | {int(np.max(iterations))} | {end} |")
        return lines
