"""What runs left in their folders: run.json, the tables and the fields."""
import csv
import json
import os
import re
import shutil
import tempfile

import h5py
import numpy as np

from report.section import apart_by_region, nodal_means, von_mises


class BadRun(Exception):
    """The folder or an option does not fit; the text is for the user."""


def read_json(folder, name):
    """The object in a JSON file of a run."""
    if not os.path.isdir(folder):
        raise BadRun(f"{folder} is not a folder; expected the output folder of a run")
    path = os.path.join(folder, name)
    try:
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
    except OSError:
        raise BadRun(f"{path} is missing; is {folder} the output folder of a run?") from None
    except ValueError as error:
        raise BadRun(f"{path} is not valid JSON: {error}") from None
    if not isinstance(record, dict):
        raise BadRun(f"{path} holds no JSON object")
    return record


def read_table(folder, name, required=True, first="step"):
    """Columns as lists; numbers where all entries are numbers. Incomplete last rows are dropped."""
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        if required:
            raise BadRun(f"{path} is missing")
        return {}
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise BadRun(f"{path} is empty, expected at least a heading")
    heading = rows[0]
    if heading[0] != first:
        raise BadRun(f"{path}: the first column is \"{heading[0]}\", expected \"{first}\"")
    rows = [row for row in rows[1:] if len(row) == len(heading)]
    return {column: _numbers([row[i] for row in rows]) for i, column in enumerate(heading)}


# Of elements, from what there is in the same output: found(name) is an array or None.
DERIVED = {
    "von_mises": lambda found: None if (t := found("cauchy_stress")) is None else von_mises(t),
    "largest_principal_stress": lambda found: None if (t := found("principal_stress")) is None else t[:, 0],
    "fibre_stress": lambda found: None if (t := found("fibre_stress_1")) is None else np.maximum(t, found("fibre_stress_2")),
}
# At the points of the wall, from what is recovered there.
RECOVERED = {
    "von_mises": lambda found: found("recovered_von_mises"),
    "largest_principal_stress":
        lambda found: None if (t := found("recovered_principal_stress")) is None else t[:, 0],
    "fibre_stress":
        lambda found: None if (t := found("recovered_fibre_stress_1")) is None
        else np.maximum(t, found("recovered_fibre_stress_2")),
}
KNOWN_ARRAYS = ("displacement", "velocity", "pressure", "von_mises", "cauchy_stress")


def open_fields(path):
    """For reading, whatever a writer does with it: without locks, else as SWMR, else a copy."""
    try:
        return h5py.File(path, "r")
    except OSError:
        pass
    try:
        return h5py.File(path, "r", swmr=True)
    except (OSError, ValueError):
        with tempfile.NamedTemporaryFile(suffix=".h5") as copy:  # stays readable when its name is gone
            shutil.copyfile(path, copy.name)
            return h5py.File(copy.name, "r")


def region_names(file, grid):
    """In the order of their numbers; empty where the file has none."""
    path = f"{grid}/region_names"
    return [name.decode() for name in file[path][:]] if path in file else []


class Run:
    """All tables in memory; fields are read step by step. What a run that failed, was killed or is going on
    has not left is told in remarks, sentences for the page."""

    def __init__(self, folder, with_fields=True):
        self.folder = folder
        self.remarks = []
        self.record = self._record()
        self.steps = self._table("steps.csv")
        self.newton = self._table("newton.csv")
        self.linear = self._table("linear.csv")
        self.coupling = self._table("coupling.csv", required=False)  # none with a single field
        if not self.steps.get("step"):
            self.remarks.append("The run has not finished a step: there are no curves.")
        self.fields = None
        self.outputs = []  # (time, group name)
        self._meshes, self._origins = {}, {}
        if with_fields:
            self._open_fields()

    def _record(self):
        try:
            record = read_json(self.folder, "run.json")
        except BadRun as error:
            if not os.path.exists(os.path.join(self.folder, "run.json")):
                raise
            self.remarks.append(f"{error}.")
            return {}
        status = record.get("status", "running")
        if status == "running":
            self.remarks.append("The run is going on, or was killed: this is what it has left so far.")
        elif status != "done":
            self.remarks.append("The run has not come to its end: this is what it has left.")
        return record

    def _table(self, name, required=True):
        path = os.path.join(self.folder, name)
        is_there = os.path.exists(path)
        if (required and not is_there) or (is_there and os.path.getsize(path) == 0):
            self.remarks.append(f"{name} is {'empty' if is_there else 'missing'}; what needs it is left out.")
            return {}
        return read_table(self.folder, name, required=False)

    def _open_fields(self):
        path = os.path.join(self.folder, "fields.h5")
        if not os.path.exists(path):
            self.remarks.append("fields.h5 is missing; there are no pictures of the vessel.")
            return
        try:
            self.fields = open_fields(path)
        except OSError:
            self.remarks.append("fields.h5 is not a readable HDF5 file; there are no pictures of the vessel.")
            return
        self.outputs = sorted((float(self.fields[name].attrs["time"]), name) for name in self._finished())
        if not self.outputs or not self.grids():
            self.fields = None
            self.remarks.append("fields.h5 holds no finished output; there are no pictures of the vessel.")

    def _finished(self):
        """Groups of outputs. What was being written when the run was killed has no time yet; in files whose arrays
        do not say where they stand, which are of earlier versions, it may have one, but the XDMF does not know it."""
        names = [n for n in self.fields if n.startswith("step_") and "time" in self.fields[n].attrs]
        try:
            with open(os.path.join(self.folder, "fields.xdmf"), encoding="utf-8") as file:
                told = set(re.findall(r":/(step_\d+)/", file.read()))
        except OSError:
            return names
        return [n for n in names if n in told or self._says_where(self.fields[n])]

    @staticmethod
    def _says_where(output):
        return any("centre" in array.attrs for grid in output.values() if hasattr(grid, "values") for array in grid.values())

    def grids(self):
        return [g for g in ("fluid", "wall") if self.fields is not None and f"{g}/tets" in self.fields]

    def mesh(self, grid):
        """Points and tets. Of the wall points are there once for each layer: what jumps between layers is
        smooth on either side."""
        if grid not in self._meshes:
            points, tets = self.fields[f"{grid}/points"][:], self.fields[f"{grid}/tets"][:]
            origin = np.arange(len(points))
            if grid == "wall" and f"{grid}/region" in self.fields:
                tets, origin = apart_by_region(tets, self.fields[f"{grid}/region"][:])
            self._meshes[grid], self._origins[grid] = (points[origin], tets), origin
        return self._meshes[grid]

    def field(self, output, grid, name):
        """Values of a field at an output time as the run has written them, None if it has not."""
        path = f"{output}/{grid}/{name}"
        try:
            return self.fields[path][:] if path in self.fields else None
        except (OSError, KeyError):
            return None

    def recovered(self, output, name):
        """A stress of the wall at its points in the file, where the run has recovered it there."""
        values = RECOVERED[name](lambda other: self.field(output, "wall", other)) if name in RECOVERED else None
        return None if values is None else values.reshape(-1)

    def of_elements(self, output, grid, name):
        """A field as the run has written it, or what follows from others."""
        values = self.field(output, grid, name)
        if values is None and name in DERIVED:
            values = DERIVED[name](lambda other: self.field(output, grid, other))
        return values

    def nodal(self, output, grid, name):
        """The same at the points of mesh(): as recovered there; other fields of elements as means."""
        values = self.recovered(output, name) if grid == "wall" else None
        if values is None:
            values = self.of_elements(output, grid, name)
        if values is None:
            return None
        points, tets = self.mesh(grid)
        if len(values) == len(self.fields[f"{grid}/points"]):
            return values[self._origins[grid]]
        return nodal_means(points, tets, values.reshape(len(tets)))

    def displacement(self, output, grid):
        found = self.nodal(output, grid, "displacement")
        return np.zeros(self.mesh(grid)[0].shape) if found is None else found

    def further_arrays(self, grid):
        """Names of arrays at the points that the report does not know."""
        group = self.fields.get(f"{self.outputs[-1][1]}/{grid}", {})
        count = len(self.fields[f"{grid}/points"])
        return [n for n in group if n not in KNOWN_ARRAYS and len(group[n]) == count]

    def nearest_outputs(self, text):
        """(time, group) of the outputs nearest to the times of the option; default about six."""
        if self.fields is None:
            return []
        if text is None:
            moving = [o for o in self.outputs if o[0] > 0] or self.outputs  # rest says little
            return spread(moving, 6)
        try:
            wanted = [float(t) for t in text.split(",")]
        except ValueError:
            raise BadRun(f"--times {text}: expected numbers [ms] with commas between them") from None
        times = np.array([t for t, _ in self.outputs])
        if not np.all(np.isfinite(wanted)):
            raise BadRun(f"--times {text}: expected finite numbers [ms]")
        return [self.outputs[i] for i in sorted({int(np.argmin(abs(times - t))) for t in wanted})]

    def choose_step(self, wanted):
        steps = [int(s) for s in self.steps.get("step", [])]
        if not steps:
            return None
        if wanted is None:
            return 2 if 2 in steps else steps[-1]
        if wanted not in steps:
            raise BadRun(f"--step {wanted}: the run has the steps {steps[0]} to {steps[-1]}")
        return wanted


class SolverRun:
    """What tunica-solvers left: its table, and Newton's history of the systems in it."""

    def __init__(self, folder):
        self.folder = folder
        self.record = read_json(folder, "run.json")
        self.choice = read_json(folder, "solvers.json")
        self.solvers = read_table(folder, "solvers.csv", first="field")
        if not self.solvers.get("field"):
            raise BadRun(f"{os.path.join(folder, 'solvers.csv')} has no rows; no system has been solved")
        self.newton = {}  # none of another program's system
        if "step" in self.choice:
            self.newton = rows_where(read_table(folder, "newton.csv"), step=self.choice["step"],
                                     coupling_iteration=self.choice["coupling iteration"])

    def fields(self):
        return list(dict.fromkeys(self.solvers["field"]))

    def settings(self, field):
        """In the order of the case."""
        return list(dict.fromkeys(rows_where(self.solvers, field=field)["setting"]))

    def unknowns(self, field):
        return int(rows_where(self.solvers, field=field)["unknowns"][0])

    def place(self):
        if "step" not in self.choice:
            return "the files of the case"
        return f"step {self.choice['step']}, coupling iteration {self.choice['coupling iteration']}"


def spread(items, most):
    """So many of them at most, evenly, with the first and the last."""
    return [items[i] for i in np.unique(np.linspace(0, len(items) - 1, most).round().astype(int))]


def is_of_solvers(folder):
    return os.path.exists(os.path.join(folder, "solvers.csv"))


def read_solver_runs(folders):
    for folder in folders:
        if os.path.isdir(folder) and not is_of_solvers(folder):
            raise BadRun(f"{folder} has no solvers.csv; runs of tunica-solvers are compared with each other only")
    runs = [SolverRun(folder) for folder in folders]
    for run in runs[1:]:
        if run.place() != runs[0].place():
            raise BadRun(f"{run.folder} is about {run.place()}, {runs[0].folder} about {runs[0].place()}; "
                         "expected the same")
    return runs


def _numbers(texts):
    try:
        return [float(t) if t != "" else float("nan") for t in texts]
    except ValueError:
        return texts


def rows_where(table, **conditions):
    """The table restricted to rows whose columns have the given values."""
    if not table or any(c not in table for c in conditions):
        return {}
    count = len(next(iter(table.values())))
    keep = [i for i in range(count) if all(table[c][i] == v for c, v in conditions.items())]
    return {column: [values[i] for i in keep] for column, values in table.items()}
