"""Two jets bend a flap of silicone that is lighter than the fluid: an experiment."""
import os

import numpy as np

from benchmark import Benchmark, HERE, arrays_of

HEIGHTS = tuple(range(5, 70, 5))  # of the probes along the flap, mm
TIP = {"": 16.41, "alone": 29.50}  # of the experiment, at which the flap's stiffness is calibrated without flow, mm
# Centrelines that fit the experiment, z over y: z = c (a y + b y^2 + ...), and how far it is off these, root mean square, mm.
FITTED = {"": (62.528, (0.0, 2.417, -2.226, 0.811), 0.178), "alone": (57.643, (-0.123, 2.468, -2.300, 0.978), 0.339)}
VOXEL = 0.977  # mm


class SiliconeFlap(Benchmark):
    """The centreline of the flap, with the flow and without."""
    name, levels, variants = "silicone-flap", (0.5, 1), ("", "alone")
    title = "Two jets bend a flap of silicone"
    exact = {"tip": TIP[""], "tip without flow": TIP["alone"]}

    def settings(self, level, variant):
        settings = {"Mesh/file": self.make_mesh(level)}
        coarser = [m for m in self.levels if m < level and self.is_done(m)]
        if coarser and not variant:  # bent as it is there, a flap bears long steps from the first on
            settings.update({"Time/initial state": self.folder(coarser[-1]), "Time/step size": 50})
        return settings

    def case(self, variant):
        return os.path.join(HERE, f"{self.name}{variant and '-'}{variant}.xml")

    def run_one(self, level, variant, program="tunica-fsi", statuses=(0,)):
        super().run_one(level, variant, "tunica-solid" if variant else program, statuses)

    def centreline(self, level, variant):
        """y and z of the probes."""
        columns = arrays_of(self.folder(level, variant))
        displaced = [np.array([columns[f"wall_displacement_{axis}_{axis}_{z}_mm"][-1] for z in HEIGHTS]) for axis in "yz"]
        return displaced[0], displaced[1] + HEIGHTS

    def off_fit(self, level, variant):
        """Root mean square from the fitted centreline, from a tenth of the tip's y on: nearer to the base the fit is none [mm]."""
        y, z = self.centreline(level, variant)
        length, factors, _ = FITTED[variant]
        part = y / TIP[variant]
        fitted = length * np.polynomial.polynomial.polyval(part, factors)
        return float(np.sqrt(np.mean((z - fitted)[part > 0.1] ** 2)))

    def values(self, level):
        return {"tip": self.centreline(level, "")[0][-1], "tip without flow": self.centreline(level, "alone")[0][-1]}

    def section(self):
        lines = ["Phase I of A. Hessenthaler et al., Int. J. Numer. Methods Biomed. Eng. 33 (2017) e2848: a flap of silicone, 11 x 2 x 65 mm, "
                 "between two jets of Reynolds number 1283; steady, by `steady` without a march. Neo-Hookean, μ = 61 kPa, which another "
                 "code has calibrated by the tip without flow; what is left of its weight pulls it upwards. The chamber's surface is "
                 "in the experiment's data; here the inlets widen as oblique cones into the wide pipe (`make_silicone_flap.py`), so "
                 "that the flow is not quite that of the experiment. Half of it; 4 elements through the flap on the mesh of level 1.", "",
                 "| tetrahedra: fluid + flap | y of the tip, mm | off by | centreline, rms, mm | y without flow, mm | off by | centreline, rms, mm |",
                 "|---|" + "---|" * 6]
        for m in self.complete_levels():
            cells = (f"{self.values(m)[name]:.2f} | {self.values(m)[name] - self.exact[name]:+.2f} mm | {self.off_fit(m, variant):.2f}"
                     for name, variant in (("tip", ""), ("tip without flow", "alone")))
            lines.append(f"| {self.size(m)} | {' | '.join(cells)} |")
        cells = (f"*{TIP[variant]:.2f}* | *± {VOXEL}, a voxel* | *± {FITTED[variant][2]}*" for variant in ("", "alone"))
        return [*lines, f"| *experiment* | {' | '.join(cells)} |"]

    def size(self, level):
        sizes = self.record(level)["sizes"]
        return f"{sizes['fluid tetrahedra']:,} + {sizes['wall tetrahedra']:,}"
