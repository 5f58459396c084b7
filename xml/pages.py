"""What the scripts share that make the pages of results: where things lie, runs and what they leave, tables."""
import csv
import json
import os
import re
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Installed, ROOT is PREFIX/share/tunica and the programs are in PREFIX/bin.
IS_INSTALLED = not os.path.exists(os.path.join(ROOT, "CMakeLists.txt"))
BUILT = os.path.dirname(os.path.dirname(ROOT)) if IS_INSTALLED else os.path.join(ROOT, "build", "release")
PROGRAMS = os.path.join(BUILT, "bin")
MODULES = PROGRAMS if IS_INSTALLED else os.path.join(ROOT, "drivers")  # of the programs in Python
# As cmake/setup.sh, which says why.
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_mpi_yield_when_idle": "1", **os.environ,
               "OMP_NUM_THREADS": "1"}


def results_of(name):
    """The folder of a page's runs, where none is given."""
    return os.path.join("" if IS_INSTALLED else ROOT, "results", name)


def commit():
    """Of the sources; "unknown" where they are installed, or there is no Git."""
    try:
        found = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=10", "HEAD"], capture_output=True, text=True,
                               check=False)
    except OSError:
        return "unknown"
    return found.stdout.strip() or "unknown"


def write_commit(folder):
    """Beside the folder of a run, of what sources it is."""
    with open(folder + ".commit", "w", encoding="utf-8") as file:
        file.write(commit())


def commits_of(output):
    """Commit -> names of the runs in the folder that are of it."""
    found = {}
    for entry in sorted(os.listdir(output)):
        name, end = os.path.splitext(entry)
        if end == ".commit":
            with open(os.path.join(output, entry), encoding="utf-8") as file:
                found.setdefault(file.read().strip(), []).append(name)
    return found


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = (line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
            return next(names, "unknown")
    except OSError:
        return "unknown"


def command(program, words, settings=(), ranks=1):
    """Of a program with settings "List/key=value"."""
    prefix = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    return [*prefix, program, *words] + [word for setting in settings for word in ("--set", setting)]


def refine(program, coarser, path, stdout=None):
    """Makes the mesh of path from a coarser one by tunica-mesh."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    subprocess.run([program, "refine", coarser, path], check=True, stdout=stdout)


def read_json(path):
    """Nothing where the file cannot be read."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def record_of(folder):
    """run.json of a run."""
    return read_json(os.path.join(folder, "run.json"))


def has_ended(folder, how=("done",)):
    return record_of(folder).get("status") in how


def keep_results(folder, is_overwritten):
    """Stops where the folder holds a run that has not come to its end: it may have cost hours."""
    if not is_overwritten and os.path.exists(os.path.join(folder, "run.json")):
        raise SystemExit(f"{folder} holds a run that has not come to its end. --overwrite begins such runs anew.")


def rows_of(path):
    """Of a CSV file, as words; none where there is no file."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except FileNotFoundError:
        return []


def columns_of(folder):
    """Of a run's steps.csv, as numbers."""
    rows = rows_of(os.path.join(folder, "steps.csv"))
    if not rows:
        raise SystemExit(f"{folder} has no steps.csv with steps in it")
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


# Ends of the columns of steps.csv that say how a step was solved.
OF_ITERATIONS = ("step", "time", "converged", "iterations", "_newton", "_linear", "seconds", "residual", "rejected", "step_size",
                 "error_estimate")


def differences(one, other):
    """Column -> the largest difference of two histories over the largest value of the column, or of all components where
    it is one of a vector. Columns that are zero but for round-off are left out."""
    names = [name for name in one if name in other and not name.endswith(OF_ITERATIONS)]
    vector_of = lambda name: re.sub("_[xyz]_", "_", name)  # noqa: E731
    largest = {}
    for name in names:
        largest[vector_of(name)] = max(largest.get(vector_of(name), 0.0), *map(abs, one[name]))
    return {name: max(abs(a - b) for a, b in zip(one[name], other[name])) / largest[vector_of(name)]
            for name in names if largest[vector_of(name)] > 1e-12}


def table_text(head, rows):
    text = "| " + " | ".join(head) + " |\n|" + "---|" * len(head) + "\n"
    return text + "".join("| " + " | ".join(row) + " |\n" for row in rows)


def shrink(source, target):
    """Half as wide and high: a page need not be heavy."""
    from matplotlib import image
    pixels = image.imread(source)[..., :3]
    height, width = (size // 2 * 2 for size in pixels.shape[:2])
    image.imsave(target, pixels[:height, :width].reshape(height // 2, 2, width // 2, 2, 3).mean(axis=(1, 3)))
