"""Add_BC: conditions of surfaces, each as the entries of a list of Fluid / Surfaces or Wall / Surfaces, or None."""
import os

from ..raw import BadMesh, hint
from . import waves
from .rcr_file import NAME, RcrFile

TYPES = {"Dir": "Dir", "Dirichlet": "Dir", "Neu": "Neu", "Neumann": "Neu", "Trac": "Trac", "Traction": "Trac", "Robin": "Robin",
         "Rbn": "Robin", "CMM": "CMM", "Coupled Momentum": "CMM", "RIS0D": "RIS0D"}
TIMES = {name: name for name in ("Steady", "Unsteady", "Coupled", "Resistance", "RCR", "Spatial", "General")} | {"Windkessel": "RCR"}
PROFILES = {"Flat": "flat", "Parabolic": "parabolic", "User_defined": "user"}
FREE = "the surface is free"
AXES = "xyz"


class Conditions:
    def __init__(self, equation, meshes, network, units, notes):
        self.meshes, self.network, self.units, self.notes = meshes, network, units, notes
        self.equation = equation
        self.rcr_file, self.windkessels = RcrFile(os.path.dirname(equation.node.file)), 0

    def all(self):
        """field -> {name of the surface: entries}"""
        found = {"fluid": {}, "wall": {}}
        for node in self.equation.node.all("Add_BC"):
            face = self.face_of(node)
            if face is None:
                node.skip()
                self.notes.add(node.place, "a condition on the interface", "left out: fluid and wall move together there")
                continue
            entries = self.of_fluid(node, face) if face.field == "fluid" else self.of_wall(node, face)
            if entries:
                found[face.field][node.name()] = entries
        return found

    def face_of(self, node):
        name, faces = node.name(), self.meshes.faces
        if name not in faces:
            there = f"Faces are {', '.join(faces)}."
            raise BadMesh(f'{node.file}: {node.place}: there is no face "{name}". {hint(name, faces, there)}')
        return faces[name]

    # Fluid

    def of_fluid(self, node, face):
        kind = node.choice("Type", TYPES, node.required("Type"))
        if kind == "Dir":
            return self.velocity(node, face)
        if kind == "Neu":
            return self.open_end(node, face)
        return self.give_up(node, f"a condition of the type {kind} on the fluid")

    def give_up(self, node, meaning, done=FREE):
        node.skip()
        self.notes.add(node.place, meaning, done)

    def velocity(self, node, face):
        factor, amplitude = self.load(node)
        if factor is None:
            return self.give_up(node, "velocities that vary over the surface", "left out; velocity from file takes a table of them")
        along = self.components(node)
        node.skip("Zero_out_perimeter", "Impose_on_state_variable_integral")
        if node.flag("Weakly_applied"):
            self.notes.of_key(node, "Weakly_applied", "a velocity by a penalty", "prescribed strongly")
            node.skip("Penalty_parameter", "Penalty_parameter_normal", "Penalty_parameter_tangential")
        if factor == 0.0:
            node.skip("Profile", "Impose_flux")
            return [("condition", "held"), ("components", along)] if along else [("condition", "no slip")]
        profile = self.profile(node)
        if node.flag("Impose_flux"):
            if along:
                self.notes.of_key(node, "Effective_direction", "a flow along an axis", "along the surface's normal")
            return [("condition", "flow rate"), ("flow rate", -factor * self.units.flow, "mm^3/ms, into the vessel; theirs is positive outward"),
                    ("profile", profile)] + amplitude
        return self.along_normal(node, face, factor * self.units.velocity, profile, along) + amplitude

    def along_normal(self, node, face, speed, profile, along):
        if along and len(along) < 3:
            self.notes.of_key(node, "Effective_direction", "the other components are free", "they are zero")
        if not along and not face.is_flat:
            self.notes.add(node.place, "a velocity along the normals of a curved surface", "along their mean")
        return [("condition", "velocity"), ("velocity", self.vector(speed, face, along), "mm/ms, along the mean normal, which points outward"),
                ("profile", "uniform" if profile == "flat" else profile)]

    def profile(self, node):
        profile = node.choice("Profile", PROFILES, "Flat")
        if profile != "user":
            return profile
        node.skip("Spatial_profile_file_path")
        self.notes.of_key(node, "Profile", "a profile from a file", "parabolic; velocity from file takes a table")
        return "parabolic"

    def open_end(self, node, face):
        if node.choice("Profile", PROFILES, "Flat") != "flat":
            self.notes.of_key(node, "Profile", "a pressure that varies over the surface", "uniform")
        dependence = node.choice("Time_dependence", TIMES, "Steady")
        backflow = [("backflow stabilisation", self.backflow())]
        if dependence == "Resistance":
            return self.resistance(node.number("Value"), 0.0) + backflow
        if dependence == "RCR":
            return self.rcr(node) + backflow
        if dependence == "Coupled":
            entries = self.coupled(node)
            return entries and entries + backflow
        factor, amplitude = self.load(node)
        if factor is None:
            return self.give_up(node, "a pressure that varies over the surface")
        return [("condition", "pressure"), ("pressure", factor * self.units.pressure, "kPa")] + backflow + amplitude

    def rcr(self, node):
        """RCR_values; without them those of rcrt.dat, which svMultiPhysics does not read, but SimVascular writes."""
        values, position = node.one("RCR_values"), self.windkessels
        self.windkessels += 1
        if values is not None:
            return self.windkessel(values.number("Proximal_resistance"), values.number("Capacitance"),
                                   values.number("Distal_resistance"), values.number("Distal_pressure", 0.0),
                                   values.number("Initial_pressure", 0.0))
        found = self.rcr_file.of(node.name(), position)
        if found is None:
            raise BadMesh(f'{node.file}: {node.place}: "RCR_values" is missing, and no {NAME} beside the file has values for it')
        self.notes.add(node.place, "without RCR_values", f"those of {NAME}, " + ("by their name" if self.rcr_file.named else
                                                                                 "in the order of the conditions"))
        if not found.is_steady:
            self.notes.add(f"{NAME}, {node.name()}", "a pressure behind the Windkessel that varies", "its mean")
        return self.windkessel(found.proximal, found.capacitance, found.distal, found.pressure, 0.0)

    def backflow(self):
        """Their coefficient is that of the fluid's domain; both multiply ρ (u·n)₋ u."""
        domains = [domain for domain in self.equation.domains.values() if domain.word("Equation", "fluid").lower() == "fluid"]
        return (domains or [self.equation.node])[0].number("Backflow_stabilization_coefficient", 0.2)

    def resistance(self, R, distal):
        return [("condition", "resistance"), ("resistance", R * self.units.resistance, "kPa ms/mm^3"),
                ("distal pressure", distal * self.units.pressure)]

    def windkessel(self, proximal, capacitance, distal, pressure, initial):
        return [("condition", "windkessel"), ("proximal resistance", proximal * self.units.resistance, "kPa ms/mm^3"),
                ("capacitance", capacitance * self.units.capacitance, "mm^3/kPa"),
                ("distal resistance", distal * self.units.resistance), ("distal pressure", pressure * self.units.pressure),
                ("initial pressure", initial * self.units.pressure, "kPa, in the capacitance")]

    def coupled(self, node):
        interface = node.one("Coupling_interface")
        block = node.word("svZeroDSolver_block") or (interface and interface.word("svZeroDSolver_block"))
        kind, values = self.network.behind(block) or (None, {})
        if kind == "RCR":
            return self.windkessel(values["Rp"], values["C"], values["Rd"], values["Pd"], self.network.initial)
        if kind == "RESISTANCE":
            return self.resistance(values["R"], values["Pd"])
        return self.give_up(node, "a network behind the surface that is no Windkessel and no resistance alone")

    # Wall

    def of_wall(self, node, face):
        kind = node.choice("Type", TYPES, node.required("Type"))
        if kind not in ("Dir", "Neu", "Robin"):
            return self.give_up(node, f"a condition of the type {kind} on the wall")
        factor, amplitude = self.load(node)
        if factor is None:
            return self.give_up(node, "values that vary over the surface")
        node.skip("Profile", "Zero_out_perimeter", "Impose_flux")
        if kind == "Dir":
            return self.displacement(node, face, factor, amplitude)
        if kind == "Robin":
            return self.support(node, factor, amplitude)
        if not node.flag("Follower_pressure_load") and factor != 0.0:
            self.notes.add(node.place, "a pressure on the undeformed face", "it follows the deformed one")
        pressure = [("condition", "pressure"), ("pressure", factor * self.units.pressure, "kPa")]
        return pressure + amplitude if factor != 0.0 else None

    def displacement(self, node, face, factor, amplitude):
        along = self.components(node)
        is_displacement = node.flag("Impose_on_state_variable_integral", self.equation.kind == "wall")
        if factor == 0.0:
            return [("condition", "held"), ("components", along)] if along else [("condition", "clamped")]
        if not is_displacement:
            return self.give_up(node, "a velocity of the wall", "the surface is free; moved takes a displacement")
        vector = self.vector(factor * self.units.length, face, along)
        return [("condition", "moved"), ("components", along or list(AXES)), ("displacement", vector, "mm")] + amplitude

    def support(self, node, factor, amplitude):
        if node.has("Spatial_values_file_path"):
            return self.give_up(node, "springs that vary over the surface")
        entries = [("condition", "support"), ("stiffness", node.number("Stiffness", 1.0) * self.units.stiffness, "kPa/mm"),
                   ("damping", node.number("Damping", 1.0) * self.units.damping, "kPa ms/mm"),
                   ("direction", "normal" if node.flag("Apply_along_normal_direction") else "all")]
        return entries + [("pressure", factor * self.units.pressure)] + amplitude if factor != 0.0 else entries

    # Values

    def components(self, node):
        """Axes that Effective_direction names; none where it names no axis."""
        return [axis for axis, part in zip(AXES, node.vector("Effective_direction") or (0.0,) * 3) if part != 0.0]

    def vector(self, size, face, along):
        """Of this size along the axes, or along the face's normal where there are none."""
        return [size * (axis in along) for axis in AXES] if along else [size * part for part in face.normal]

    def load(self, node):
        """(factor, entries of the amplitude): a value, or 1 and a curve in their units; None where it varies in space."""
        dependence = node.choice("Time_dependence", TIMES, "Steady")
        if dependence == "Steady":
            return node.number("Value", 0.0), []
        if dependence != "Unsteady":
            return None, []
        node.skip("Value")
        is_ramp = node.flag("Ramp_function")
        if node.has("Temporal_values_file_path"):
            wave = waves.of_points(node.path("Temporal_values_file_path"), is_ramp)
        elif node.has("Fourier_coefficients_file_path"):
            wave = waves.of_coefficients(node.path("Fourier_coefficients_file_path"))
        else:
            raise BadMesh(f'{node.file}: {node.place}: "Temporal_values_file_path" is missing, or "Fourier_coefficients_file_path"')
        if not wave.is_ramp and not wave.closes():
            self.notes.add(node.place, "a curve whose last value is not its first", "the same, as a table that jumps at each period")
        return 1.0, [("Amplitude", wave.entries(self.units.time))]
