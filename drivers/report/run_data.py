"""What a run left in its folder: run.json, the tables and the fields."""
import csv
import json
import os

import h5py
import numpy as np


class BadRun(Exception):
    """The folder or an option does not fit; the text is for the user."""


class Run:
    """All tables in memory; fields are read step by step."""

    def __init__(self, folder, with_fields=True):
        if not os.path.isdir(folder):
            raise BadRun(f"{folder} is not a folder; expected the output folder of a run")
        self.folder = folder
        self.record = self._read_record()
        self.steps = self._read_table("steps.csv", required=True)
        self.newton = self._read_table("newton.csv", required=True)
        self.linear = self._read_table("linear.csv", required=True)
        self.coupling = self._read_table("coupling.csv", required=False)  # none with a single field
        if not self.steps.get("step"):
            raise BadRun(f"{self._path('steps.csv')} has no rows; the run has not finished a step")
        self.fields = None
        self.outputs = []  # (time, group name)
        if with_fields:
            self._open_fields()

    def _path(self, name):
        return os.path.join(self.folder, name)

    def _read_record(self):
        path = self._path("run.json")
        try:
            with open(path, encoding="utf-8") as file:
                record = json.load(file)
        except OSError:
            raise BadRun(f"{path} is missing; is {self.folder} the output folder of a run?") from None
        except ValueError as error:
            raise BadRun(f"{path} is not valid JSON: {error}") from None
        if not isinstance(record, dict):
            raise BadRun(f"{path} holds no JSON object")
        return record

    def _read_table(self, name, required):
        """Columns as lists; numbers where all entries are numbers. Incomplete last rows are dropped."""
        path = self._path(name)
        if not os.path.exists(path):
            if required:
                raise BadRun(f"{path} is missing")
            return {}
        with open(path, newline="", encoding="utf-8", errors="replace") as file:
            rows = list(csv.reader(file))
        if not rows:
            raise BadRun(f"{path} is empty, expected at least a heading")
        heading = rows[0]
        if heading[0] != "step":
            raise BadRun(f"{path}: the first column is \"{heading[0]}\", expected \"step\"")
        rows = [row for row in rows[1:] if len(row) == len(heading)]
        return {column: _numbers([row[i] for row in rows]) for i, column in enumerate(heading)}

    def _open_fields(self):
        path = self._path("fields.h5")
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
        name = "mesh_displacement" if grid == "fluid" else "displacement"
        found = self.field(output, grid, name)
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


def _numbers(texts):
    try:
        return [float(t) if t != "" else float("nan") for t in texts]
    except ValueError:
        return texts


def rows_where(table, **conditions):
    """The table restricted to rows whose columns have the given values."""
    if not table or any(c not in table for c in conditions):
        return {}
    count = len(table["step"])
    keep = [i for i in range(count) if all(table[c][i] == v for c, v in conditions.items())]
    return {column: [values[i] for i in keep] for column, values in table.items()}
