"""What a benchmark of this folder is: a case, run on meshes of several levels, and what its folders hold."""
import os
import resource
import subprocess
import sys

import numpy as np

from pages import ENVIRONMENT, MODULES, ROOT, columns_of, command, commits_of, has_ended, record_of, write_commit

sys.path.append(MODULES)
from certify.richardson import order_of_ratio, remainder

HERE = os.path.dirname(os.path.abspath(__file__))


def arrays_of(folder):
    return {name: np.array(values) for name, values in columns_of(folder).items()}


def order_of(levels, values):
    """p of F_m = F + c m^-p through the last three levels; None where these show none."""
    f, g, h = values[-3:]
    p = order_of_ratio((f - g) / (g - h), 1 / np.array(levels[-3:]), None)
    return None if np.isnan(p) else p


def limit_of(levels, values, p=2):
    """Of the last two levels, at this order."""
    return values[-1] + (values[-1] - values[-2]) * remainder(p, 1 / np.array(levels))


class Benchmark:
    """A case, on meshes of several levels: m of them is the one with m times as many cells along each axis."""
    levels, variants = (1, 2), ("",)
    main = ""  # the variant whose cost is shown

    def __init__(self, wanted):
        self.programs, self.output = wanted.programs, wanted.output
        self.levels = [m for m in self.levels if m <= wanted.finest]

    def folder(self, level, variant=""):
        return os.path.join(self.output, f"{self.name}-{level}{variant and '-'}{variant}")

    def record(self, level, variant=""):
        return record_of(self.folder(level, variant))

    def is_done(self, level, variant=""):
        return has_ended(self.folder(level, variant))

    def variants_of(self, level):
        return self.variants

    def done(self, level):
        """The variants of the level that have been run."""
        return [variant for variant in self.variants_of(level) if self.is_done(level, variant)]

    def complete_levels(self):
        return [m for m in self.levels if len(self.done(m)) == len(self.variants_of(m))]

    def finest_run(self):
        """Level and variant of that whose cost is shown; None without runs."""
        levels = [level for level in self.levels if self.is_done(level, self.main)]
        return (levels[-1], self.main) if levels else None

    def make_mesh(self, level, *more):
        """The mesh of a level, once; what else its script writes is named by more."""
        os.makedirs(self.output, exist_ok=True)
        mesh = os.path.join(self.output, f"{self.name}-{level}.h5")
        if not os.path.exists(mesh):
            self.write_mesh(mesh, level, *more)
        return mesh

    def write_mesh(self, mesh, level, *more):
        subprocess.run([sys.executable, os.path.join(ROOT, "meshes", self.script()), mesh + ".msh", *more, str(level)], check=True)
        name, *options = self.conversion(level)
        self.tunica_mesh(name, mesh + ".msh", mesh, *options)
        os.remove(mesh + ".msh")

    def script(self):
        return f"make_{self.name.replace('-', '_')}.py"

    def conversion(self, level):
        """The command of tunica-mesh that makes a mesh of what the script has written, and its options."""
        return ["convert"]

    def tunica_mesh(self, *words):
        subprocess.run([os.path.join(self.programs, "tunica-mesh"), *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    def run(self):
        for level in self.levels:
            for variant in self.variants_of(level):
                if not self.is_done(level, variant):
                    self.run_one(level, variant)

    def case(self, variant):
        return os.path.join(HERE, self.name + ".xml")

    def run_one(self, level, variant, program="tunica-fsi", statuses=(0,)):
        settings = [f"{key}={value}" for key, value in self.settings(level, variant).items()]
        words = [self.case(variant), "--output", self.folder(level, variant)]
        # Where the folder holds a run that has not ended, the program says so and stops.
        words = command(os.path.join(self.programs, program), words, settings)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        status = subprocess.run(words, env=ENVIRONMENT, check=False).returncode
        if status not in statuses:
            raise subprocess.CalledProcessError(status, words)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        write_commit(self.folder(level, variant))
        with open(self.folder(level, variant) + ".cpu", "w", encoding="utf-8") as file:
            file.write(f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.4g}\n")

    def commits(self):
        """Of the sources with which its runs were made."""
        found = commits_of(self.output) if os.path.isdir(self.output) else {}
        return [commit for commit, names in found.items() if any(name.startswith(self.name + "-") for name in names)]

    def errors(self, level):
        """Quantity -> error, in parts of what has been published."""
        return {name: value / self.exact[name] - 1 for name, value in self.values(level).items()}

    def size(self, level):
        """Tetrahedra of the fluid and of the wall, of the fields that were run."""
        sizes = self.record(level, self.main if self.is_done(level, self.main) else self.done(level)[-1])["sizes"]
        return " + ".join(f"{sizes[key]:,}" for key in ("fluid tetrahedra", "wall tetrahedra") if key in sizes)


class SteadyFlow(Benchmark):
    """Of a fluid between rigid walls. Meshes begin with the flow of the next coarser one."""
    levels = (1, 2, 3)

    def run_one(self, level, variant, program="tunica-fluid", statuses=(0,)):
        super().run_one(level, variant, program, statuses)

    def beginning(self, level):
        """Where there is a coarser mesh; the first step then may be long."""
        coarser = [m for m in self.levels if m < level and self.is_done(m)]
        return {"Time/initial state": self.folder(coarser[-1]), "Time/step size": 200} if coarser else {}
