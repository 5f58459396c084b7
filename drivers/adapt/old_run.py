"""What a run left: its blood's mesh with the names of its surfaces, its wall's, its fields, and its case."""
import dataclasses
import os
import xml.etree.ElementTree as ElementTree

import numpy as np

from importer import tunica_file
from importer.raw import BadMesh
from lumen.surface import show
from report.run_data import BadRun, Run, region_names
from report.surfaces import area_vectors, boundary, weighted_centre

WALLS = ("interface", "no slip")   # conditions of a surface that is a wall
SAME = 1e-6                        # of the extent: vertices of the run and of the mesh's file
FLAT = 0.02                        # distance from its plane over the radius: an opening is flat


@dataclasses.dataclass
class Opening:
    """nodes: of the blood's mesh, on it."""
    name: str
    nodes: np.ndarray
    centre: np.ndarray
    normal: np.ndarray
    radius: float


class OldRun:
    """points, tets: the blood's mesh; wall: triangles on its wall, normals outward; openings; outputs: those of the beat."""

    def __init__(self, folder, start):
        try:
            self.run = Run(folder)
        except BadRun as error:
            raise BadMesh(str(error)) from None
        self.folder = os.path.abspath(folder)
        self.case = self._case()
        if "fluid" not in self.run.grids():
            why = " ".join(self.run.remarks) or "it is one of a wall alone"
            raise BadMesh(f"{folder}: the run has no fields of blood ({why}). \"Output / fields every\" asks for them")
        self.points, self.tets = self.run.mesh("fluid")
        self.outputs = self._outputs(start)
        self._name_surfaces(self._mesh())
        if len(self.wall_names) != 1:
            raise BadMesh(f"{self.mesh_file}: has {len(self.wall_names)} surfaces that are walls of the blood, "
                          f"{', '.join(self.wall_names)}; expected one")
        regions = [region_names(self.run.fields, "fluid")[k] for k in np.unique(self.run.fields["fluid/region"][:])]
        if len(regions) != 1 or self.raw.vectors:
            why = "fibre directions of its elements, which another mesh does not have" if self.raw.vectors else \
                f"{len(regions)} regions of blood, expected one"
            raise BadMesh(f"{self.mesh_file}: has {why}")
        self.region = regions[0]

    def _case(self):
        for name in ("case-used.xml", "case.xml"):
            path = os.path.join(self.folder, name)
            if os.path.exists(path):
                try:
                    return ElementTree.parse(path).getroot()
                except ElementTree.ParseError as error:
                    raise BadMesh(f"{path}: is no valid XML: {error}") from None
        raise BadMesh(f"{self.folder}: has no case.xml, expected the output folder of a run")

    def value(self, *place, default=None):
        """Of a parameter of the case."""
        *lists, key = place
        path = "./" + "".join(f"ParameterList[@name='{name}']/" for name in lists) + f"Parameter[@name='{key}']"
        found = self.case.find(path)
        return default if found is None else found.get("value")

    def _outputs(self, start):
        """From a time on; of a search for a steady flow the last alone."""
        if self.value("Time", "step control") == "steady":
            return [self.run.outputs[-1][1]]
        start = float(self.value("Output", "averages from", default="0")) if start is None else start
        chosen = [name for time, name in self.run.outputs if time > 0.0 and time >= start]
        if not chosen:
            raise BadMesh(f"{self.folder}: has no fields from {start:g} ms on; the last are of {self.run.outputs[-1][0]:g} ms")
        return chosen

    def _mesh(self):
        path = self.value("Mesh", "file", default="")
        self.mesh_file = os.path.join(self.folder, path)
        if not path.endswith(".h5"):
            raise BadMesh(f"{self.folder}: its mesh is {path}, expected Tunica's own format, .h5; tunica-mesh convert makes it")
        raw = tunica_file.read(self.mesh_file)
        self.scale = float(self.value("Mesh", "scale", default="1"))
        raw.points = raw.points * self.scale
        return raw

    def _name_surfaces(self, raw):
        vertices = self.run.fields["fluid/vertices"][:].astype(np.int64)
        extent = np.ptp(self.points, axis=0).max()
        if vertices.max() >= len(raw.points) or np.abs(raw.points[vertices] - self.points).max() > SAME * extent:
            raise BadMesh(f"{self.mesh_file}: is not the mesh of the run {self.folder}; it has been changed since")
        sides = boundary(self.points, self.tets)[0]
        of_side = tags_of(vertices[sides], raw.triangles, raw.surface.of)
        conditions = {name: self.value("Fluid", "Surfaces", name, "condition") for name in raw.surface.names}
        is_wall = [conditions[name] in WALLS for name in raw.surface.names]
        on_wall = np.array([*is_wall, False])[of_side]
        if not on_wall.any():
            raise BadMesh(f"{self.folder}: no surface of the blood is a wall, with the condition interface or no slip")
        self.wall, self.openings = sides[on_wall], []
        self.wall_names = [name for number, name in enumerate(raw.surface.names) if is_wall[number] and (of_side == number).any()]
        for number in np.unique(of_side[~on_wall]):
            name = raw.surface.names[number] if number >= 0 else "?"
            self.openings.append(self._opening(name, sides[of_side == number]))
        self.raw = raw

    def _opening(self, name, triangles):
        centre, area = weighted_centre(self.points, triangles)
        vector = area_vectors(self.points, triangles).sum(axis=0)
        normal = vector / np.linalg.norm(vector)
        radius = float(np.sqrt(area / np.pi))
        nodes = np.unique(triangles)
        away = np.abs((self.points[nodes] - centre) @ normal).max()
        if away > FLAT * radius:
            raise BadMesh(f"{self.mesh_file}: the opening \"{name}\" at {show(centre)} is not flat, {away:.2g} mm out of its plane: the "
                          "mesh is not one of tunica-mesh lumen, and cannot be made anew")
        return Opening(name, nodes, centre, normal, radius)

    def field(self, output, grid, name):
        return self.run.field(output, grid, name)


def tags_of(sides, triangles, tags):
    """The tag of each side among the triangles of a mesh, -1 where there is none."""
    both = np.sort(np.vstack([sides, triangles]), axis=1)
    _, number = np.unique(both, axis=0, return_inverse=True)
    number = number.reshape(-1)
    tag = np.full(number.max() + 1, -1)
    tag[number[len(sides):]] = tags
    return tag[number[:len(sides)]]
