"""Walls that bend, whose stress is known: their meshes, cases and reference values, and what a run has in their place."""
import os
import subprocess
import sys
from dataclasses import dataclass

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from pages import ENVIRONMENT, ROOT, command  # noqa: E402

# Of the stabilisation: keys of "Wall", and types and values of theirs.
LINEAR = {"stabilisation residual": ("string", "linear")}
VARIANTS = {"default": {}, "linear": LINEAR, "weaker": {**LINEAR, "stabilisation modulus factor": ("double", 3)}}
STEPS = 5


@dataclass
class Point:
    """Where a stress is known. component: of the Cauchy stress as fields.h5 has them, or "largest" or "smallest"
    principal stress."""
    words: str
    place: tuple
    component: object
    value: float


@dataclass
class Section:
    """displacements: words, place, component and value [mm]."""
    title: str
    mesh: list  # arguments of meshes/make_bending.py but for file and number
    law: tuple  # μ and κ [kPa]
    conditions: list
    displacements: list
    stresses: list


XX, YY = 0, 3
TUBE = [("ends", "held", ("components", "Array(string)", "{z}")), ("sym_x", "held", ("components", "Array(string)", "{x}")),
        ("sym_y", "held", ("components", "Array(string)", "{y}"))]
# An independent computation, P2-P1 with 16 x 256 elements; the round tube by quadrature.
SECTIONS = {
    "round": Section(
        "Round tube", ["tube", 1.43, 1.43], (100.0, 1e6), TUBE + [("inner", "pressure", ("pressure", "double", "12.5232"))],
        [("inside", (1.43, 0.0), 0, 0.3575)],
        [Point("hoop, inside", (1.43, 0.0), YY, 79.73), Point("hoop, outside", (1.82, 0.0), YY, 60.50)]),
    "oval": Section(
        "Oval tube", ["tube", 1.8, 1.1], (100.0, 1e6), TUBE + [("inner", "pressure", ("pressure", "double", "8"))],
        [("end of the long axis", (1.8, 0.0), 0, -0.0812), ("of the short axis", (0.0, 1.1), 1, 0.5415)],
        [Point("hoop, end of the long axis, inside", (1.8, 0.0), YY, 87.62), Point("outside", (2.19, 0.0), YY, 5.32),
         Point("of the short axis, inside", (0.0, 1.1), XX, 20.2), Point("outside", (0.0, 1.49), XX, 53.2)]),
    "cook": Section(
        "Cook's membrane", ["cook"], (80.194, 400889.8),
        [("ends", "held", ("components", "Array(string)", "{z}")), ("clamped", "clamped", None),
         ("loaded", "traction", ("traction", "Array(double)", "{0, 6.25, 0}"))],
        [("tip", (48.0, 60.0), 1, 6.9345)],
        [Point("largest principal at (24, 22.5)", (24.0, 22.5), "largest", 21.31),
         Point("smallest at (24, 51.5)", (24.0, 51.5), "smallest", -16.34),
         Point("largest at (16, 16)", (16.0, 16.0), "largest", 15.88)]),
}


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def sublist(name, text):
    return f'<ParameterList name="{name}">\n{text}\n</ParameterList>'


def case_text(section, mesh, variant):
    surfaces = []
    for surface, condition, more in section.conditions:
        text = parameter("condition", "string", condition) + (parameter(*more) if more else "")
        if condition in ("pressure", "traction"):
            text += sublist("Amplitude", parameter("kind", "string", "table") + parameter(
                "times", "Array(double)", f"{{0, {STEPS}}}") + parameter("values", "Array(double)", "{0, 1}"))
        surfaces.append(sublist(surface, text))
    layer = (parameter("law", "string", "neo-hookean") + parameter("c10", "double", section.law[0])
             + parameter("bulk modulus", "double", section.law[1]))
    wall = (parameter("analysis", "string", "static")
            + "".join(parameter(key, *value) for key, value in VARIANTS[variant].items())
            + sublist("Layers", sublist("wall", layer)) + sublist("Surfaces", "\n".join(surfaces))
            + sublist("Linear Solver", parameter("method", "string", "direct")))
    return sublist("Case", "\n".join([
        sublist("Mesh", parameter("file", "string", mesh)),
        sublist("Time", parameter("step size", "double", 1.0) + parameter("steps", "int", STEPS)), sublist("Wall", wall),
        sublist("Output", parameter("fields every", "int", STEPS) + parameter("checkpoint every", "int", 0))]))


def run(programs, folder, name, n, variant, ranks=1):
    """Status of the run, whose results are in the folder; mesh and case lie beside it."""
    section, mesh, case = SECTIONS[name], f"{folder}.msh", f"{folder}.xml"
    kind, *sizes = section.mesh
    subprocess.run(["/usr/bin/python3", os.path.join(ROOT, "meshes", "make_bending.py"), kind, mesh, str(n), *map(str, sizes)],
                   check=True)
    with open(case, "w", encoding="utf-8") as file:
        file.write(case_text(section, os.path.abspath(mesh), variant))
    words = command(os.path.join(programs, "tunica-solid"), [case, "--output", folder, "--overwrite"], ranks=ranks)
    with open(f"{folder}.log", "w", encoding="utf-8") as log:
        return subprocess.run(words, env=ENVIRONMENT, stdout=log, stderr=log, check=False).returncode


class Found:
    """The last output of a run."""

    def __init__(self, folder):
        with h5py.File(os.path.join(folder, "fields.h5"), "r") as file:
            last = file[max(name for name in file if name.startswith("step_"))]["wall"]
            self.points, self.tets = file["wall/points"][:], file["wall/tets"][:]
            self.displacement, self.cells = last["displacement"][:], last["cauchy_stress"][:]
            self.nodes, self.error = last["recovered_stress"][:], last["stress_error"][:].reshape(-1)
        x = self.points[self.tets]
        self.volume = abs(np.linalg.det(x[:, 1:] - x[:, :1])) / 6.0

    def _around(self, place):
        """Elements that have the place (x, y) in them or at a vertex, and its barycentric coordinates there, in
        the middle of the slice."""
        at = np.array([*place, 0.5 * self.points[:, 2].max()])
        x = self.points[self.tets]
        weights = np.linalg.solve(np.swapaxes(x[:, 1:] - x[:, :1], 1, 2), (at - x[:, 0])[:, :, None])[:, :, 0]
        weights = np.column_stack([1.0 - weights.sum(1), weights])
        found = np.flatnonzero((weights > -1e-6).all(1))
        return found, weights[found]

    def displacement_at(self, place, component):
        tets, weights = self._around(place)
        return float((weights[0] @ self.displacement[self.tets[tets[0]]])[component])

    @staticmethod
    def _of(stress, component):
        if isinstance(component, int):
            return float(stress[component])
        xx, xy, xz, yy, yz, zz = stress
        values = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        return float(values[-1] if component == "largest" else values[0])

    def stress_at(self, point):
        """That of the elements there, their mean at the vertex where the point is one, as viewers average it, and
        the recovered one."""
        tets, weights = self._around(point.place)
        cell = max((self._of(s, point.component) for s in self.cells[tets]), key=abs)
        values = []
        for a in self.tets[tets[0]]:
            has = (self.tets == a).any(1)
            values.append(np.average(self.cells[has], axis=0, weights=self.volume[has]))
        mean = self._of(weights[0] @ np.array(values), point.component)
        return cell, mean, self._of(weights[0] @ self.nodes[self.tets[tets[0]]], point.component)

    def estimated_error(self):
        """Root mean square of what the elements differ from the recovered stress, in parts of that."""
        at, twice = self.nodes[self.tets], np.array([1.0, 2.0, 2.0, 1.0, 2.0, 1.0])
        squares = (np.einsum("eak,k,eak->e", at, twice, at) + np.einsum("ek,k,ek->e", at.sum(1), twice, at.sum(1))) / 20.0
        return float(np.sqrt((self.volume * self.error ** 2).sum() / (self.volume * squares).sum()))
