"""What runs left in their folders: run.json, the tables and the fields."""
import csv
import json
import os

import h5py
import numpy as np


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


class Run:
    """All tables in memory; fields are read step by step."""

    def __init__(self, folder, with_fields=True):
        self.folder = folder
        self.record = read_json(folder, "run.json")
        self.steps = read_table(folder, "steps.csv")
        self.newton = read_table(folder, "newton.csv")
        self.linear = read_table(folder, "linear.csv")
        self.coupling = read_table(folder, "coupling.csv", required=False)  # none with a single field
        if not self.steps.get("step"):
            raise BadRun(f"{os.path.join(folder, 'steps.csv')} has no rows; the run has not finished a step")
        self.fields = None
        self.outputs = []  # (time, group name)
        if with_fields:
            self._open_fields()

    def _open_fields(self):
        path = os.path.join(self.folder, "fields.h5")
        if not os.path.exists(path):
            raise BadRun(f"{path} is missing; --no-fields leaves out what needs it")
        try:
            self.fields = h5py.File(path, "r")
        except OSError:
            raise BadRun(f"{path} is not a readable HDF5 file; --no-fields leaves it out") from None
        for name in sorted(self.fields):
            if name.startswith("step_"):
                self.outputs.append((float(self.fields[name].attrs["time"]), name))
        self.outputs.sort()
        if not self.outputs:
            raise BadRun(f"{path} holds no step; --no-fields leaves it out")

    def grids(self):
        return [g for g in ("fluid", "wall") if self.fields is not None and g in self.fields]

    def geometry(self, grid):
        return self.fields[f"{grid}/points"][:], self.fields[f"{grid}/tets"][:]

    def field(self, output, grid, name):
        """Values of a field at an output time, None if the run has not written it."""
        path = f"{output}/{grid}/{name}"
        return self.fields[path][:] if path in self.fields else None

    def displacement(self, output, grid):
        found = self.field(output, grid, "displacement")
        return np.zeros(self.fields[f"{grid}/points"].shape) if found is None else found

    def nearest_outputs(self, text):
        """(time, group) of the outputs nearest to the times of the option; default about six."""
        if self.fields is None:
            return []
        if text is None:
            moving = [o for o in self.outputs if o[0] > 0] or self.outputs  # rest says little
            return [moving[i] for i in np.unique(np.linspace(0, len(moving) - 1, 6).round().astype(int))]
        try:
            wanted = [float(t) for t in text.split(",")]
        except ValueError:
            raise BadRun(f"--times {text}: expected numbers [ms] with commas between them") from None
        times = np.array([t for t, _ in self.outputs])
        if not np.all(np.isfinite(wanted)):
            raise BadRun(f"--times {text}: expected finite numbers [ms]")
        return [self.outputs[i] for i in sorted({int(np.argmin(abs(times - t))) for t in wanted})]

    def choose_step(self, wanted):
        steps = [int(s) for s in self.steps["step"]]
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
        self.newton = rows_where(read_table(folder, "newton.csv"), step=self.choice["step"],
                                 coupling_iteration=self.choice["coupling iteration"])

    def fields(self):
        return [f for f in ("fluid", "wall") if f in self.solvers["field"]]

    def settings(self, field):
        """In the order of the case."""
        return list(dict.fromkeys(rows_where(self.solvers, field=field)["setting"]))

    def unknowns(self, field):
        return int(rows_where(self.solvers, field=field)["unknowns"][0])

    def place(self):
        return f"step {self.choice['step']}, coupling iteration {self.choice['coupling iteration']}"


def is_of_solvers(folder):
    return os.path.exists(os.path.join(folder, "solvers.csv"))


def read_solver_runs(folders):
    for folder in folders:
        if os.path.isdir(folder) and not is_of_solvers(folder):
            raise BadRun(f"{folder} has no solvers.csv; only runs of tunica-solvers are compared")
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
