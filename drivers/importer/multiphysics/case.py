"""From solver.xml to mesh.h5 and case.xml in a folder."""
import os

import numpy as np

from .. import summary, tunica_file
from ..case_writer import Sublist, Writer
from ..raw import BadMesh
from . import conditions, materials, meshes as of_meshes, tree, units as of_units
from .equation import Equation
from .network import Network
from .notes import Notes

MESH, CASE = "mesh.h5", "case.xml"
UNDAMPED = 0.99   # spectral radius from which generalised-alpha damps nothing worth the name
ALIKE = 0.5       # degrees by which the angle between families of fibres may vary
PROGRAM = {"FSI": "tunica-fsi", "fluid": "tunica-fluid", "wall": "tunica-solid"}


def is_case(path):
    """Whether a file is one of svMultiPhysics; other programs have meshes in XML."""
    if not path.lower().endswith(".xml") or not os.path.isfile(path):
        return False
    with open(path, "rb") as file:
        head = file.read(1 << 16)
    return any(b"<" + root.encode() in head for root in tree.ROOTS)


def check_target(folder, may_overwrite):
    """Before the long work."""
    if os.path.exists(folder) and not os.path.isdir(folder):
        raise BadMesh(f"{folder}: is there already and is no folder, expected one for {MESH} and {CASE}")
    for name in (MESH, CASE):
        path = os.path.join(folder, name)
        if os.path.exists(path) and not may_overwrite:
            raise BadMesh(f"{path}: is there already. --overwrite replaces it")


class Translation:
    """All of it, before anything is written."""

    def __init__(self, path, units, tolerance=None):
        self.path, self.units, self.notes = path, of_units.OF[units], Notes()
        self.angle = None  # half of that between both families of fibres in each tetrahedron
        self.root = tree.read(path)
        self.general = self.root.one("GeneralSimulationParameters")
        if self.general is None:
            raise BadMesh(f'{path}: "GeneralSimulationParameters" is missing')
        self.equation = Equation(self.root)
        for projection in self.root.all("Add_projection"):
            projection.skip("Project_from_face")
        self.time = self.time_entries()
        self.mesh = of_meshes.read(self.root, self.equation, self.units, self.notes, tolerance)
        self.fields = {field for field in ("fluid", "wall") if self.equation.kind in ("FSI", field)}
        self.surfaces = conditions.Conditions(self.equation, self.mesh, Network(self.equation), self.units, self.notes).all()
        self.text = self.written()

    def time_entries(self):
        size, steps = self.general.number("Time_step_size"), self.general.count("Number_of_time_steps")
        if size <= 0.0 or steps < 1:
            raise BadMesh(f"{self.path}: {self.general.place}: Number_of_time_steps = {steps} of Time_step_size = {size:g}, "
                          "expected one or more, of more than 0")
        return [("step size", self.units.time * size, "ms"), ("steps", steps)]

    def time_scheme(self):
        rho = self.general.number("Spectral_radius_of_infinite_time_step", 0.5)
        scheme = "trapezoidal" if rho >= UNDAMPED else "bdf2"
        self.notes.of_key(self.general, "Spectral_radius_of_infinite_time_step", "the generalised-alpha scheme, second order",
                          f'"{scheme}", second order, ' + ("without damping" if rho >= UNDAMPED else
                                                           "which damps what it does not resolve"))
        return "time scheme", scheme

    def regions(self, field):
        """Names of the regions of a field, and their domains."""
        for name in self.mesh.raw.region.names:
            if (name in self.mesh.fluid_names) == (field == "fluid"):
                number = self.mesh.domains[name]
                yield name, self.equation.domain(number, name)

    def on_surfaces(self, field):
        """One list for each surface that has a condition, and the interface."""
        found = [(name, Sublist(entries)) for name, entries in self.surfaces[field].items()]
        if self.equation.kind == "FSI":
            found.append(("interface", Sublist([("condition", "interface")])))
        return ("Surfaces", Sublist(found))

    def fluid_entries(self, scheme):
        (name, domain), *others = self.regions("fluid")
        if others:
            self.notes.add(self.equation.node.place, "several domains of the fluid", f"all have the parameters of {domain.title}")
            for _, other in others:
                other.skip()
        names = [name] + [other for other, _ in others]
        return [("regions", names)] + materials.fluid(domain, self.units, self.notes) + [scheme, self.on_surfaces("fluid")]

    def wall_entries(self, scheme):
        layers, with_fibres = [], []
        for name, domain in self.regions("wall"):
            entries, has_fibres = materials.wall(domain, self.units, self.notes)
            if has_fibres:
                entries.append(self.fibre_angle(name, domain))
                with_fibres.append(name)
            layers.append((name, Sublist(entries)))
        frame = [("Fibre Frame", Sublist([("kind", "mesh")]))] if with_fibres else []
        return self.prestress() + frame + [("Layers", Sublist(layers)), scheme, self.on_surfaces("wall")]

    def fibre_angle(self, name, domain):
        """Both families lie to both sides of their bisector, as ours do of the circumference: this gives the frame."""
        raw = self.mesh.raw
        if self.angle is None and "fibre 1" not in raw.vectors:
            raise BadMesh(f"{self.path}: {domain.place}: HGO needs two directions of fibres, two Fiber_direction or "
                          "Fiber_direction_file_path in Add_mesh")
        if self.angle is None:
            self.angle = frame_of_fibres(raw)
        angles = self.angle[raw.region.of == raw.region.names.index(name)]
        if np.ptp(angles) > 2.0 * ALIKE:
            least, most = 2.0 * angles.min(), 2.0 * angles.max()
            self.notes.add(domain.place, f"an angle between fibres that varies, {least:.3g} to {most:.3g} degrees", "the mean angle")
        return "fibre angle", float(angles.mean()), "degrees, half of the angle between both directions"

    def prestress(self):
        """A file of stresses says that the mesh is loaded, but not by how much."""
        if self.equation.node.flag("Prestress"):
            self.notes.of_key(self.equation.node, "Prestress", "a run that only finds the stress of the wall",
                              "the wall is loaded as it is. Wall / Prestress / pressure finds that stress when a run begins")
        nodes = [node for node in self.root.all("Add_mesh") if node.has("Prestress_file_path")]
        if not nodes:
            return []
        pressure = self.initial_pressure()
        done = (f"found when the run begins, in balance with {pressure:.4g} kPa, the mean initial pressure of the Windkessels. This is "
                "a guess: correct Wall / Prestress / pressure" if pressure > 0.0 else
                "left out, since that file does not say which pressure the stress balances. Give this as Wall / Prestress / pressure; "
                "without it the mesh is free of stress")
        self.notes.of_key(nodes[0], "Prestress_file_path", "stress of the wall at the start", done)
        return [("Prestress", Sublist([("pressure", pressure, "kPa, a guess: see the list above")]))] if pressure > 0.0 else []

    def initial_pressure(self):
        """Mean of the Windkessels that begin with one, kPa; otherwise zero."""
        found = [dict(entry[:2] for entry in entries).get("initial pressure", 0.0) for entries in self.surfaces["fluid"].values()]
        return float(np.mean([pressure for pressure in found if pressure > 0.0] or [0.0]))

    def mesh_motion(self):
        node = self.equation.mesh
        nu = 0.3 if node is None else min(node.number("Poisson_ratio", 0.3), 0.45)
        if node is not None:
            for bc in node.all("Add_BC"):
                bc.skip()
            self.notes.add(f"{node.place} / Add_BC", "where the mesh of the fluid is held", "openings deform with their rims")
            self.notes.add(node.place, "the mesh moves on from where it was in the step before", "it moves from the mesh of the file")
        return [("law", "elastic"), ("poisson ratio", nu), ("stiffening", 1.0, "as there: modulus over the volume of an element")]

    def output_entries(self):
        saves = self.general.flag("Save_results_to_VTK_format", True)
        every = self.general.count("Increment_in_saving_VTK_files", 0) or 1
        return [("folder", "results"), ("fields every", every if saves else 0),
                ("checkpoint every", self.general.count("Increment_in_saving_restart_files", 0))]

    def written(self):
        scheme = self.time_scheme()
        lists = [("Mesh", [("file", MESH)]), ("Time", self.time)]
        lists += [("Fluid", self.fluid_entries(scheme))] if "fluid" in self.fields else []
        lists += [("Wall", self.wall_entries(scheme))] if "wall" in self.fields else []
        lists += [("Mesh Motion", self.mesh_motion())] if self.equation.kind == "FSI" else []
        lists += [("Output", self.output_entries())]
        self.notes.rest(self.root)
        out = Writer(f"Made by tunica-import from {os.path.basename(self.path)}, for {PROGRAM[self.equation.kind]}.",
                     " ".join(" ".join(self.units.lines()).split()),
                     *(["Without a counterpart:"] if self.notes.rows else []), *self.notes.texts())
        for name, entries in lists:
            out.begin(name)
            out.put_all(entries)
            out.end()
        return out.text()

    def lines(self):
        yield from summary.lines(self.mesh.raw, self.mesh.outer)
        yield from self.units.lines()
        yield from self.notes.lines()

    def doubt(self):
        longest = float(np.ptp(self.mesh.raw.points, axis=0).max())
        if not summary.SHORTEST <= longest <= summary.LONGEST:
            return f"the vessel is {longest:.3g} mm long: are these the --units of {os.path.basename(self.path)}?"
        return ""

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        tunica_file.write(self.mesh.raw, os.path.join(folder, MESH))
        path = os.path.join(folder, CASE)
        try:
            with open(path + ".part", "w", encoding="utf-8") as file:
                file.write(self.text)
            os.replace(path + ".part", path)
        except OSError as error:
            raise BadMesh(f"{path}: cannot be written: {error}") from error


def frame_of_fibres(raw):
    """Axial and radial direction of each element, in place of both families; half the angle between them."""
    first, second = raw.vectors.pop("fibre 1"), raw.vectors.pop("fibre 2")
    second = np.where((first * second).sum(axis=1)[:, None] < 0.0, -second, second)
    along = first + second
    across = first - second
    length, width = np.linalg.norm(along, axis=1), np.linalg.norm(across, axis=1)
    any_other = np.eye(3)[np.abs(along).argmin(axis=1)]
    parallel = width < 1e-6 * np.maximum(length, 1e-300)
    across = np.where(parallel[:, None], np.cross(along, any_other), across)
    raw.vectors |= {"axial": across, "radial": np.cross(along, across)}
    return np.degrees(np.arctan2(np.where(parallel, 0.0, width), length))
