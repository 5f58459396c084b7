"""The runs that xml/paper/reproduce leaves: DIR/coarse/ITEM and DIR/fine/ITEM."""
import os
from functools import cache

from report.run_data import BadRun, Run, SolverRun, read_json, rows_where

MESHES = ("coarse", "fine")
MATERIALS = {"mooney-rivlin": "Mooney–Rivlin", "artery": "artery"}
FORCINGS = {"fixed": "1e-8 always", "increment": "the paper's rule", "short": "the same, final part 0.1",
            "type-1": "Eisenstat–Walker 1", "type-2": "Eisenstat–Walker 2"}
ACCELERATORS = {"aitken": "Aitken", "iqn-ils": "IQN-ILS", "iqn-ils-alone": "IQN-ILS without earlier steps",
                "aitken-added-mass": "Aitken, added mass out, backflow stabilised",
                "iqn-ils-added-mass": "IQN-ILS, added mass out, backflow stabilised"}


class PaperRuns:
    """Whatever is there; missing runs are None. A run under way counts as far as it has come."""

    def __init__(self, folder):
        if not os.path.isdir(folder):
            raise BadRun(f"{folder} is not a folder; expected that of xml/paper/reproduce")
        self.folder = folder
        self.items = {mesh: sorted(os.listdir(os.path.join(folder, mesh)))
                      for mesh in MESHES if os.path.isdir(os.path.join(folder, mesh))}
        if not any(self.items.values()):
            raise BadRun(f"{folder} holds no run; expected {folder}/coarse/ITEM as xml/paper/reproduce makes them")

    def path(self, mesh, item):
        return os.path.join(self.folder, mesh, item)

    def has(self, mesh, item, table):
        return os.path.exists(os.path.join(self.path(mesh, item), table))

    @cache
    def march(self, mesh, item, with_fields=False):
        """A run of tunica-fsi that has finished a step."""
        if not self.has(mesh, item, "steps.csv"):
            return None
        try:
            run = Run(self.path(mesh, item), with_fields=with_fields)
        except BadRun:  # it has just begun
            return None
        return run if run.steps.get("step") else None

    def solvers(self, mesh, item):
        """A run of tunica-solvers that has solved a system."""
        if not self.has(mesh, item, "solvers.csv"):
            return None
        try:
            return SolverRun(self.path(mesh, item))
        except BadRun:  # none yet
            return None

    def origins(self):
        """(mesh, item, run.json, item.json) of each run."""
        for mesh, items in self.items.items():
            for item in items:
                if self.has(mesh, item, "run.json") and self.has(mesh, item, "item.json"):
                    path = self.path(mesh, item)
                    yield mesh, item, read_json(path, "run.json"), read_json(path, "item.json")


def second_iteration(run, field):
    """Newton's rows of the second coupling iteration in the first step."""
    return rows_where(run.newton, step=1.0, coupling_iteration=2.0, field=field)
