"""What the regression scripts share: starting a driver and reading what it leaves."""
import csv
import pathlib
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "xml")]
import scratch  # noqa: E402
from pages import ENVIRONMENT  # noqa: E402

fresh, remove_results = scratch.fresh, scratch.remove_results  # of all scripts
SKIPPED = 77  # exit status of a test that has nothing to run with
LONG = "--long" in sys.argv  # the form of the night, of scripts that have more to show than each claim once
sys.argv = [word for word in sys.argv if word != "--long"]
# The default, for cases that say otherwise: a step takes a tenth of what partitioned coupling does.
MONOLITHIC = ["--set", "Coupling/scheme=monolithic"]
# Coupled systems solved so far that round-off is all that may differ.
TIGHT = [word for setting in ("scheme=monolithic", "Newton/absolute increment=1e-13", "Newton/linear tolerance=1e-10",
                              "mesh tolerance=1e-13") for word in ("--set", f"Coupling/{setting}")]


class Run:
    """A finished process: status, out, err, seconds."""

    def __init__(self, words, folder, environment=ENVIRONMENT):
        start = time.time()
        done = subprocess.run(words, cwd=folder, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.seconds = time.time() - start
        self.status, self.out, self.err = done.returncode, done.stdout, done.stderr


def command(program, words, ranks=1):
    prefix = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    return prefix + [str(program)] + [str(word) for word in words]


def two_at_a_time(tasks):
    """What functions without arguments return, in their order. For runs on one rank, in tests that ctest gives two
    processors and more, since others of their runs have as many ranks."""
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda task: task(), tasks))


def table(path):
    """The columns of a CSV file: name -> values, numbers where they are numbers."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [value(row[name]) for row in rows] for name in (rows[0] if rows else [])}


class Verdict:
    """Collects claims; a script ends with sys.exit(verdict.status())."""

    def __init__(self):
        self.failures = 0

    def claim(self, holds, text):
        print(("ok    " if holds else "FAIL  ") + text, flush=True)
        self.failures += not holds
        return holds

    def status(self):
        print(f"{self.failures} failures" if self.failures else "all claims hold")
        return 1 if self.failures else 0


def checkpoints(folder):
    """Steps of the checkpoints in a run's folder."""
    return sorted(int(path.stem.split("-")[1]) for path in folder.glob("checkpoint-*.h5"))


EFFORT = ("seconds", "converged", "interface_residual", "coupling_iterations", "fluid_newton",
          "wall_newton", "fluid_linear", "wall_linear", "system_newton",
          "system_linear")  # how it was found, which depends on ranks


def same_steps(verdict, name, results, expected, tolerance=1e-6, first=None):
    """Both folders have the same steps.csv, apart from the effort; of the second one so many first steps, where they
    are given. Columns that share their first word and their unit, as all pressures of the fluid do, are compared
    with their largest value."""
    def kind(column):
        words = column.split("_")
        return words[0], column.split("_kPa")[-1] if "_kPa" in column else words[-1]
    one, other = table(results / "steps.csv"), table(expected / "steps.csv")
    other = {column: values[:first] for column, values in other.items()}
    if not verdict.claim(one.keys() == other.keys() and one["step"] == other["step"],
                         f"{name}: steps.csv has the same columns and steps"):
        return
    worst, where = 0.0, "none"
    for column in one.keys() - set(EFFORT):
        scale = max(abs(value) for c in other if kind(c) == kind(column) for value in other[c])
        errors = [abs(a - b) for a, b in zip(one[column], other[column])]
        if not all(error <= worst * scale for error in errors):  # also where one is not a number
            is_number = scale > 0.0 and all(error == error for error in errors)
            worst, where = max(errors) / scale if is_number else float("inf"), column
    verdict.claim(worst < tolerance, f"{name}: steps.csv differs by {worst:.1e}, in {where}")


def exactly_same_steps(verdict, name, results, expected, but=("seconds",)):
    """Both folders have the same steps.csv, to the last digit, but for those columns."""
    one, other = table(results / "steps.csv"), table(expected / "steps.csv")
    differing = [column for column in one if column not in but and one[column] != other.get(column)]
    verdict.claim(one.keys() == other.keys() and not differing,
                  f"{name}: {len(one['step'])} steps agree to the last digit {differing[:5]}")


def entry(parent, name):
    found = [child for child in parent if child.get("name") == name]
    assert len(found) == 1, name
    return found[0]


def parameter(name, value):
    kind = {str: "string", int: "int", float: "double"}.get(type(value), "Array(double)")
    if isinstance(value, (list, tuple)):
        kind = "Array(double)" if isinstance(value[0], float) else "Array(string)"
        value = "{" + ",".join(map(str, value)) + "}"
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def xml(entries):
    """A case from nested dictionaries: parameter lists."""
    return "".join(f'<ParameterList name="{name}">{xml(value)}</ParameterList>'
                   if isinstance(value, dict) else parameter(name, value)
                   for name, value in entries.items())


def write_case(case, path, settings):
    """A case of tunica-solvers with the wanted settings only: field -> names."""
    tree = ElementTree.parse(case)
    root = tree.getroot()
    mesh = entry(entry(root, "Mesh"), "file")
    mesh.set("value", str((case.parent / mesh.get("value")).resolve()))
    for field, names in settings.items():
        entries = entry(entry(root, "Solvers"), field)
        for setting in [one for one in entries if one.get("name") not in names]:
            entries.remove(setting)
    tree.write(path)


def agree(verdict, name, counts, factor, slack=0):
    """For each setting the largest count is at most factor times the least, or slack more."""
    if not verdict.claim(all(counts), f"{name}: every run has counts"):
        return
    for setting in counts[0]:
        values = [count[setting] for count in counts]
        verdict.claim(max(values) <= max(factor * min(values), min(values) + slack),
                      f"{name}: {setting} takes {min(values):.0f} to {max(values):.0f}")
