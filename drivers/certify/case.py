"""What is to be known of a case before it is run otherwise: its program, steps, tolerances, mesh and period."""
import os
import xml.etree.ElementTree as ElementTree

from report import case_tables
from vessel.errors import BadInput

from .richardson import Theory

SMALLEST, LARGEST = 1e-14, 0.5  # relative tolerances: beneath is round-off, beyond nothing is solved
# Lists whose tolerances bound the error of a step, by coupling; those within preconditioners do not.
FIELDS = ("Fluid/Newton", "Wall/Newton")
ALWAYS = ("Coupling", "Coupling/Newton", "Mesh Motion/Linear Solver", "Wall/Prestress")
KEYS = ("tolerance", "relative increment", "absolute increment", "linear tolerance", "smallest tolerance", "largest tolerance",
        "mesh tolerance", "product tolerance", "final part")
SCHEMES = {"bdf2": 2, "trapezoidal": 2, "newmark": 2, "implicit euler": 1}


def scaled(path, value, factor):
    if path.endswith("absolute increment"):
        return value * factor
    return min(value, max(value * factor, SMALLEST)) if factor < 1 else max(value, min(value * factor, LARGEST))


class Case:
    """The case with all its defaults, as tunica-check prints it; settings are those of --set."""

    def __init__(self, path, settings, programs):
        self.path, self.settings = path, settings
        words = [word for setting in settings for word in ("--set", setting)]
        status, text = programs.output_of(["tunica-check", path, "--print-defaults", *words])
        if status != 0:
            raise BadInput(text.strip().removeprefix("tunica-check: "))
        self.root = ElementTree.fromstring(text)
        self.program = self._program()
        self.is_static = self.text("Wall", "analysis") == "static"
        self.control = self.text("Time", "step control")
        self.is_steady = self.control == "steady"

    def list(self, path):
        node = self.root
        for name in path.split("/"):
            node = node.find(f"./ParameterList[@name='{name}']") if node is not None else None
        return node

    def text(self, path, key):
        node = self.list(path)
        found = node.find(f"./Parameter[@name='{key}']") if node is not None else None
        return found.get("value") if found is not None else None

    def number(self, path, key):
        text = self.text(path, key)
        return float(text) if text not in (None, "") else None

    def _program(self):
        has_fluid, has_wall = self.list("Fluid") is not None, self.list("Wall") is not None
        if has_fluid and has_wall:
            return "tunica-fsi"
        if has_fluid or has_wall:
            return "tunica-fluid" if has_fluid else "tunica-solid"
        raise BadInput(f"{self.path}: has neither a list \"Fluid\" nor a list \"Wall\", expected a case that can be run")

    def mesh(self):
        return self.text("Mesh", "file")

    def steps(self):
        return int(self.number("Time", "steps"))

    def step_size(self):
        return self.number("Time", "step size")

    def end(self):
        """Of the run [ms]; None of pseudo-time."""
        if self.is_steady:
            return None
        return self.number("Time", "end time") if self.control == "adaptive" else self.steps() * self.step_size()

    def period(self):
        return case_tables.period(self.root)

    def varies_in_time(self):
        """Whether there is an error of the time step. Static walls are a load case after the other."""
        return not (self.is_steady or self.is_static)

    def time_theory(self):
        """The least order of the schemes in use. Newmark's own parameters decide about it: of second order with gamma = 1/2 only."""
        orders = []
        for field in ("Fluid", "Wall"):
            scheme = self.text(field, "time scheme")
            if scheme is not None and not (field == "Wall" and self.is_static):
                orders.append(SCHEMES.get(scheme, 1))
            if scheme == "newmark" and self.number("Wall/Newmark", "gamma") != 0.5:
                orders.append(1)
        order = min(orders, default=1)
        return Theory(2, 1) if order == 2 else Theory(1, 0.75)

    def finer_step(self, factor):
        """Settings with steps so many times as short."""
        if self.control == "adaptive":
            # The error of a step goes with its square or cube: a quarter is about half a step of the case.
            return [f"Time/tolerance={self.number('Time', 'tolerance') / factor ** 2!r}",
                    f"Time/step size={self.step_size() / factor!r}", "Time/steps=0"] + self._largest_step(factor)
        return [f"Time/step size={self.step_size() / factor!r}", f"Time/steps={self.steps() * factor}"]

    def _largest_step(self, factor):
        largest = self.number("Time", "largest step") or 0.0
        return [f"Time/largest step={largest / factor!r}"] if largest > 0 else []

    def tolerances(self):
        """Path of each tolerance of a solver -> its value. Monolithic coupling does not use those of the fields."""
        is_coupled = self.program == "tunica-fsi"
        lists = list(ALWAYS if is_coupled else ("Wall/Prestress",))
        if not is_coupled or self.text("Coupling", "scheme") != "monolithic":
            lists += FIELDS
        found = {f"{path}/{key}": self.number(path, key) for path in lists for key in KEYS}
        if self.is_steady:
            found["Time/tolerance"] = self.number("Time", "tolerance")
        return {path: value for path, value in found.items() if value}

    def with_tolerances(self, factor):
        """Settings with all tolerances times a factor, relative ones within what a computer can tell apart."""
        return [f"{path}={scaled(path, value, factor)!r}" for path, value in self.tolerances().items()]

    def output_at_end(self):
        """Settings of a run of which only the last fields are needed."""
        end = self.end()
        return [] if end is None else ["Output/fields every=0", f"Output/fields at={{{end!r}}}", "Output/fields interval=0"]

    def folder(self):
        return os.path.dirname(os.path.abspath(self.path))
