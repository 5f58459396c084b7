"""A steady flow around a cylinder in a channel."""
import os

from benchmark import SteadyFlow, arrays_of, limit_of, order_of

COLUMNS = {"before": "fluid_pressure_before_kPa", "behind": "fluid_pressure_behind_kPa",
           "drag": "drag_cylinder_mN", "lift": "lift_cylinder_mN"}
# 2 F/(rho U^2 D H) of twice the half that is computed, with U = 0.2 mm/ms.
COEFFICIENT = 2 * 2 / (1.0 * 0.2 ** 2 * 100 * 410)


class Cylinder(SteadyFlow):
    """3D-1Z: drag and lift coefficients, and the difference of pressures before and behind the cylinder [Pa]."""
    name = "cylinder"
    title = "A flow around a cylinder"
    exact = {"drag": 6.18533, "lift": 0.009401, "pressure difference": 0.171007}
    bounds = {"drag": "6.05 to 6.25", "lift": "0.008 to 0.010", "pressure difference": "0.165 to 0.175"}

    def settings(self, level, _):
        inlet = os.path.join(self.output, f"cylinder-{level}-inlet.csv")
        return {"Mesh/file": self.make_mesh(level, inlet), "Fluid/Surfaces/inlet/file": inlet, **self.beginning(level)}

    def values(self, level):
        columns = arrays_of(self.folder(level))
        last = {name: columns[column][-1] for name, column in COLUMNS.items()}
        # At 1000 kg/m^3, where this is computed, pressures are 1000 times those of the 1 kg/m^3 of the publications.
        return {"drag": COEFFICIENT * last["drag"], "lift": COEFFICIENT * last["lift"],
                "pressure difference": last["before"] - last["behind"]}

    def section(self):
        lines = ["3D-1Z of M. Schäfer and S. Turek, Notes Numer. Fluid Mech. 52 (1996) 547-566: a channel of 2.5 x 0.41 x 0.41 m, a "
                 "cylinder of 0.1 m in it, Re 20, steady; a half, cut at its plane of symmetry. Published: V. John, Int. J. Numer. Meth. "
                 "Fluids 40 (2002) 775; M. Braack, T. Richter, Computers & Fluids 35 (2006) 372. Coefficients of the whole "
                 "cylinder; the pressure for a density of 1 kg/m³.", "",
                 "| tetrahedra | " + " | | ".join(("drag", "lift", "pressure difference, Pa")) + " | |", "|---|" + "---|---|" * 3]
        levels = self.complete_levels()
        for m in levels:
            lines.append(f"| {self.size(m)} | {self.cells(self.values(m))} |")
        if len(levels) > 1:
            lines.append(f"| extrapolated, second order | {self.cells(self.limits())} |")
        lines.append("| *published* | " + " | ".join(f"*{value:.6g}* | *{self.bounds[name]}*" for name, value in self.exact.items()) + " |")
        return lines + self.orders()

    def cells(self, values):
        return " | ".join(f"{value:.5g} | {100 * (value / self.exact[name] - 1):+.2f} %" for name, value in values.items())

    def limits(self):
        """Of the last two levels, at second order."""
        levels = self.complete_levels()
        return {name: limit_of(levels, [self.values(m)[name] for m in levels]) for name in self.exact}

    def orders(self):
        """Of three levels."""
        levels = self.complete_levels()
        if len(levels) < 3:
            return []
        found = {name: order_of(levels, [self.values(m)[name] for m in levels]) for name in self.exact}
        return ["", "Orders from three meshes: " + ", ".join(f"{order:.1f} for the {name}" if order else f"none for the {name}"
                                                             for name, order in found.items()) + "."]
