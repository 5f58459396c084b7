"""Conditions of svZeroDSolver, behind surfaces that are Coupled: a Windkessel or a resistance alone is also one of ours."""
import json

from ..raw import BadMesh

KINDS = {"RCR": ("Rp", "C", "Rd", "Pd"), "RESISTANCE": ("R", "Pd")}


class Network:
    """What stands behind each block that svMultiPhysics couples to; empty without an interface."""

    def __init__(self, equation):
        node = equation.node.one("svZeroDSolver_interface")
        self.pressure, self.flow, self.blocks, self.file, self.initial = 1.0, 1.0, {}, None, 0.0
        if node is None:
            return
        self.pressure = 1.0 / node.number("Pressure_conversion_factor", 1.0)
        self.flow = 1.0 / node.number("Flowrate_conversion_factor", 1.0)
        self.initial = node.number("Initial_pressures", 0.0)
        self.file = node.path("Configuration_file")
        try:
            with open(self.file, encoding="utf-8") as file:
                content = json.load(file)
            self.read(content)
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise BadMesh(f"{self.file}: cannot be read as a case of svZeroDSolver: {error}") from None

    def read(self, content):
        found = {c["bc_name"]: (c["bc_type"], c["bc_values"]) for c in content.get("boundary_conditions", [])}
        for block in content.get("external_solver_coupling_blocks", []):
            self.blocks[block["name"]] = found.get(block["connected_block"])

    def behind(self, name):
        """(kind, values in the units of the case) or None."""
        kind, values = self.blocks.get(name) or (None, {})
        if kind not in KINDS:
            return None
        resistance = self.pressure / self.flow
        factors = {"R": resistance, "Rp": resistance, "Rd": resistance, "C": self.flow / self.pressure, "Pd": self.pressure}
        try:
            found = {key: factors[key] * float(values[key] if key != "Pd" else values.get(key, 0.0)) for key in KINDS[kind]}
        except (KeyError, TypeError, ValueError) as error:
            raise BadMesh(f'{self.file}: the condition behind "{name}" has no number {error}, expected '
                          f"{', '.join(KINDS[kind])}") from None
        return kind, found
