"""A pressure that acts for 3 ms runs along an elastic tube as a pulse."""
import os

import numpy as np

from benchmark import Benchmark, arrays_of

RADIAL, AXIAL = "wall_displacement_x_radial_mm", "wall_displacement_z_axial_mm"


class PressurePulse(Benchmark):
    """Displacement of the inner wall at half the tube's length."""
    name, levels = "pressure-pulse", (1, 2, 3)
    title = "A pulse in an elastic tube"
    # By finite volumes with BDF2: the finest mesh, with steps of 0.00625 ms, and the coarsest, of 16,000 cells in the fluid and 6,400
    # in the wall, with 0.025 ms.
    exact = {"largest u_r": 0.15847, "least u_z": -0.08835, "least u_r after 14 ms": -0.09566}
    peer = {"largest u_r": 0.15964, "least u_z": -0.08954}
    step_size = {1: 0.1, 2: 0.05, 3: 0.05}   # ms
    duration = {1: 20, 2: 20, 3: 7.5}        # ms, with the first two extrema alone on the finest mesh

    def layers(self, level):
        """The outermost of the lumen are as thin as the boundary layer of the pulse."""
        return {"rings": 3 + 2 * level, "ring-grading": 0.15}

    def write_mesh(self, mesh, level):
        """A tube for the lumen, on which the wall is grown: every sixth tetrahedron of a tube's own wall has no edge through its layer, so
        that thin ones bend too stiffly."""
        sizes = {"radius": 5, "length": 50, "around": 16 * level, "axial": 32 * level, "wall": "off", **self.layers(level)}
        self.tunica_mesh("tube", mesh + ".lumen.h5", *(word for key, value in sizes.items() for word in ("--" + key, value)))
        self.tunica_mesh("wall", mesh + ".lumen.h5", mesh, "--surfaces", "interface", "--layers", f"media=1:{1 + level}")
        os.remove(mesh + ".lumen.h5")

    def settings(self, level, _):
        size = self.step_size[level]
        return {"Mesh/file": self.make_mesh(level), "Time/step size": size, "Time/steps": round(self.duration[level] / size)}

    def values(self, level):
        columns = arrays_of(self.folder(level))
        time, radial, axial = columns["time"], columns[RADIAL], columns[AXIAL]
        found = {"largest u_r": np.max(radial), "least u_z": np.min(axial[time < 6.5])}
        return {**found, "least u_r after 14 ms": np.min(radial[time > 14])} if time[-1] > 14 else found

    def section(self):
        lines = ["3dTube of the tutorials of solids4foam (P. Cardiff et al., arXiv:1808.10736): radius 5 mm, wall 1 mm, "
                 "length 50 mm, E = 300 kPa, ν = 0.3, ends clamped, 1.3332 kPa at the inlet for 3 ms. Displacement of the inner wall at "
                 "half the length, mm.", "", "| tetrahedra: fluid + wall | step, ms | " + " | | ".join(self.exact) + " | |", "|---|" + "---|" * 7]
        for m in self.complete_levels():
            v, e = self.values(m), self.errors(m)
            cells = [f"{v[name]:.5f} | {100 * e[name]:+.1f} %" if name in v else " | " for name in self.exact]
            lines.append(f"| {self.size(m)} | {self.step_size[m]:g} | {' | '.join(cells)} |")
        published = [f"*{self.peer[name]:.5f}* | {100 * (self.peer[name] / self.exact[name] - 1):+.1f} %" if name in self.peer else " | "
                     for name in self.exact]
        lines.append("| *finite volumes, 16,000 + 6,400 cells* | *0.025* | " + " | ".join(published) + " |")
        lines.append("| *the same, 64 times as many* | *0.00625* | " + " | ".join(f"*{value:.5f}* |" for value in self.exact.values())
                     + " |")
        return lines
