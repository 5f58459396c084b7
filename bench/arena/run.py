#!/usr/bin/python3
"""The arena: every contestant on every system, each pair in processes of their own, under limits of time and memory.

  bench/arena/run.py                              small and medium systems on one rank, then the page
  bench/arena/run.py --sizes small --ranks 1,2,4  other sizes and ranks
  bench/arena/run.py --only NAME,NAME --on NAME,NAME     some contestants, or groups of them, on some systems
  bench/arena/run.py --published --page bench/arena      the page of this folder, anew, in some hours
  bench/arena/run.py --report                     the page alone, from the results that there are

A result is a line in results.jsonl of the folder of results. Pairs that have one are not run again, so that a run that is
killed goes on where it was. Seconds are those of processors, of all ranks together: other work on the machine does not count.
"""
import argparse
import concurrent.futures
import glob
import importlib.util
import itertools
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import catalogue  # noqa: E402
import page  # noqa: E402
import system as systems  # noqa: E402
from catalogue import GIGABYTES, SECONDS  # noqa: E402
from contestants import CONTESTANTS, PUBLISHED, case_of  # noqa: E402
from pages import ENVIRONMENT, PROGRAMS, command, commit, results_of, rows_of  # noqa: E402

WALL_FACTOR = 40  # a machine may give us this part of a processor
# One rank waits for nobody; MUMPS asks for messages all the same, and would give its processor away each time.
ALONE = {"OMPI_MCA_mpi_yield_when_idle": "0"}
PYTHON = "/usr/bin/python3"
# Debian's petsc4py is found by itself only beside petsc-dev.
sys.path += sorted(glob.glob("/usr/lib/petscdir/petsc3.*/*-real/lib/python3/dist-packages"))[-1:]
PATHS = os.pathsep.join([*sys.path[:2], *sys.path[-1:], os.environ.get("PYTHONPATH", "")])
# Where Open MPI begins to tell that it ends the ranks.
MPI_SAYS = re.compile(r"^(?:-{20,}|\[[^\]\s]+:\d+\])", re.MULTILINE)
KILLED = {signal.SIGXCPU: "time limit", signal.SIGKILL: "time limit", signal.SIGABRT: "abort",
          signal.SIGSEGV: "segmentation fault"}


def command_of(contestant, folder, scratch, ranks, programs, tolerance):
    solution = os.path.join(scratch, "x.npy")
    if contestant.kind == "petsc":
        return command(PYTHON, [os.path.join(HERE, "solve_petsc.py"), folder, solution, contestant.settings], ranks=ranks)
    if contestant.kind == "scipy":
        return command(PYTHON, [os.path.join(HERE, "solve_scipy.py"), folder, solution])
    words = [os.path.join(folder, "K.mtx"), os.path.join(folder, "b.mtx")]
    keys, places = list(contestant.keys), os.path.join(folder, "coordinates.mtx")
    if contestant.settings is not None:
        words = [os.path.join(scratch, "case.xml")]
        with open(words[0], "w", encoding="utf-8") as file:
            file.write(case_of(contestant, folder))
    elif os.path.exists(places):
        keys.append("System/coordinates=" + places)
    return command(os.path.join(programs, "tunica-solvers"), [*words, "--output", os.path.join(scratch, "out"), "--overwrite"],
                   [f"Solvers/tolerance={tolerance:g}", *keys], ranks)


class Ended:
    """A process with its children, run under limits."""

    def __init__(self, words, scratch, seconds, gigabytes):
        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
            resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 2 ** 30),) * 2)
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with open(os.path.join(scratch, "stdout"), "w+", encoding="utf-8") as out, \
                open(os.path.join(scratch, "stderr"), "w+", encoding="utf-8") as err:
            process = subprocess.Popen(words, stdout=out, stderr=err, cwd=scratch, preexec_fn=limit, start_new_session=True,
                                       env={**ENVIRONMENT, **({} if words[0] == "mpirun" else ALONE), "OPENBLAS_NUM_THREADS": "1",
                                            "PYTHONPATH": PATHS})
            timer = threading.Timer(WALL_FACTOR * seconds, lambda: os.killpg(process.pid, signal.SIGKILL))
            timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read())
        self.out, self.err = texts
        self.status, self.processor = process.returncode, usage.ru_utime + usage.ru_stime
        self.memory = usage.ru_maxrss / 1e3

    def failure(self, seconds):
        """Why there is no solution, in a few words."""
        text = self.err + self.out
        if self.status < 0:
            signal_ = signal.Signals(-self.status)
            if signal_ != signal.SIGABRT or not self.err.strip():
                return KILLED.get(signal_, signal_.name)
        if "CPU time limit exceeded" in text or "signal 24" in text or self.processor > seconds:
            return "time limit"
        for word in ("MemoryError", "bad_alloc", "Cannot allocate", "out of memory", "Out of memory"):
            if word in text:
                return "memory limit"
        lines = [line.strip() for line in MPI_SAYS.split(self.err)[0].splitlines()]
        lines = [line for line in lines if not set(line) <= set("-=^~") and not line.startswith("warning:")]
        return (lines[-1] if lines else f"status {self.status}")[:160]


def figures_of_tunica(scratch, ended, seconds):
    rows = rows_of(os.path.join(scratch, "out", "solvers.csv"))
    sums = {key: sum(float(row[key + "_processor_seconds"]) for row in rows) for key in ("setup", "solve")}
    verdicts = [f"{row['setting']}: {row['verdict']}" if len(rows) > 1 else row["verdict"] for row in rows]
    path = os.path.join(scratch, "out", "solution.mtx")
    x = systems.read_vector(path) if os.path.exists(path) else None
    is_good = bool(rows) and rows[-1]["verdict"] == "converged"
    last = rows[-1] if rows else {"iterations": 0, "setting": ""}
    return x, {**sums, "is_content": is_good, "iterations": int(last["iterations"]), "used": last["setting"],
               "message": "" if is_good and len(rows) == 1 else "; ".join(verdicts)[:300] or ended.failure(seconds)}


def figures_of_python(scratch, ended, seconds):
    import numpy
    try:
        found = json.loads(ended.out.strip().splitlines()[-1])
        return numpy.load(os.path.join(scratch, "x.npy")), found
    except (IndexError, ValueError, OSError):
        return None, {"setup": 0.0, "solve": 0.0, "iterations": 0, "message": ended.failure(seconds)}


def tried(contestant, system, folder, size, ranks, programs, tolerance):
    """Runs a pair and judges what it leaves."""
    with tempfile.TemporaryDirectory(prefix="arena-") as scratch:
        ended = Ended(command_of(contestant, folder, scratch, ranks, programs, tolerance), scratch, SECONDS[size], GIGABYTES[size])
        read = figures_of_tunica if contestant.kind == "tunica" else figures_of_python
        x, figures = read(scratch, ended, SECONDS[size])
    figures.update(memory=ended.memory, processor=ended.processor, is_solved=False, tolerance=tolerance)
    if x is not None and len(x) == system.n:
        whole, fields, backward = systems.residuals(system.K, system.b, x, system.fields)
        figures.update(residual=whole, fields=fields, backward=backward,
                       is_solved=bool(systems.is_solved(system.K, system.b, x, system.fields)))
    return figures


def result_of(contestant, system, folder, size, ranks, programs):
    """Whoever takes for solved what the judge does not is asked once more, for a smaller residual; the figures are those of the
    last run."""
    for tolerance in (1e-8, 1e-10):
        figures = tried(contestant, system, folder, size, ranks, programs, tolerance)
        if figures["is_solved"] or not figures.pop("is_content", False):
            break
    if figures["is_solved"]:
        figures["message"] = figures["message"] if contestant.name == "default" else ""
    elif not figures["message"]:
        figures["message"] = f"|b - Kx| = {figures.get('residual', float('nan')):.1e} |b|"
    figures.pop("is_content", None)
    return figures


class Book:
    """The file of results."""

    def __init__(self, path):
        self.path, self.lock = path, threading.Lock()
        self.done = {page.key_of(row) for row in page.read_results(path)}
        with open(path, "a+b") as file:  # a kill may have cut the last line
            if file.tell() > 0:
                file.seek(-1, os.SEEK_END)
                if file.read() != b"\n":
                    file.write(b"\n")

    def add(self, row):
        with self.lock, open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")


def plan_of(wanted):
    """Sizes, ranks and contestants, as PUBLISHED."""
    return PUBLISHED if wanted.published else [(wanted.sizes, wanted.ranks, wanted.only)]


def wanted_pairs(wanted):
    is_there = {"tunica": True, "scipy": True, "petsc": importlib.util.find_spec("petsc4py") is not None}
    if not is_there["petsc"]:
        print("without PETSc: the Debian package python3-petsc4py is missing", file=sys.stderr)
    for sizes, all_ranks, only in plan_of(wanted):
        for size, ranks, contestant in itertools.product(sizes, all_ranks, CONTESTANTS):
            is_wanted = not only or {contestant.name, contestant.group} & set(only)
            if not (is_there[contestant.kind] and is_wanted) or (contestant.ranks and ranks not in contestant.ranks):
                continue
            for name in catalogue.CATALOGUE:
                if not wanted.on or name in wanted.on:
                    yield size, ranks, contestant, name


def run_pair(wanted, book, size, ranks, contestant, name):
    key = {"size": size, "ranks": ranks, "contestant": contestant.name, "system": name}
    if page.key_of(key) in book.done:
        return
    with wanted.making:
        folder = catalogue.written(name, size, wanted.systems)
    system = systems.read(folder)
    if contestant.needs == "schur" and system.schur is None:
        return
    figures = result_of(contestant, system, folder, size, ranks, wanted.programs)
    book.add({**key, "unknowns": system.n, **figures, "commit": wanted.commit, "when": time.strftime("%Y-%m-%d %H:%M")})
    print(f"{size} {ranks} {contestant.name} on {name}: {'solved' if figures['is_solved'] else figures['message']}, "
          f"{figures['iterations']} iterations, {figures['setup'] + figures['solve']:.2f} s", flush=True)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    split = lambda text: text.split(",")  # noqa: E731
    parser.add_argument("--sizes", type=split, default=["small", "medium"])
    parser.add_argument("--ranks", type=lambda text: [int(r) for r in split(text)], default=[1])
    parser.add_argument("--only", type=split, help="names of contestants or of their groups")
    parser.add_argument("--published", action="store_true", help="the pairs of the page in the tree, whatever sizes, ranks and --only say")
    parser.add_argument("--on", type=split, help="names of systems")
    parser.add_argument("--jobs", type=int, default=1, help="pairs at a time")
    parser.add_argument("--programs", default=PROGRAMS, help="folder of tunica-solvers")
    parser.add_argument("--output", default=results_of("arena"))
    parser.add_argument("--report", action="store_true", help="the page alone")
    parser.add_argument("--page", default=None, help="folder of the page; without it beside the results")
    parser.add_argument("--overwrite", action="store_true", help="forget the results that there are")
    wanted = parser.parse_args()
    for name in wanted.only or []:
        if name not in [word for contestant in CONTESTANTS for word in (contestant.name, contestant.group)]:
            parser.error(f"no contestant {name}; there are {', '.join(contestant.name for contestant in CONTESTANTS)}")
    wanted.programs = catalogue.fsi.PROGRAMS = os.path.abspath(wanted.programs)
    wanted.output = os.path.abspath(wanted.output)
    wanted.systems = os.path.join(wanted.output, "systems")
    wanted.commit, wanted.making = commit(), threading.Lock()
    return wanted


def main():
    wanted = arguments()
    if wanted.overwrite and not wanted.report:
        shutil.rmtree(wanted.output, ignore_errors=True)
    for folder in (wanted.systems, wanted.page or wanted.output):
        os.makedirs(folder, exist_ok=True)
    path = os.path.join(wanted.output, "results.jsonl")
    if not wanted.report:
        book = Book(path)
        with concurrent.futures.ThreadPoolExecutor(wanted.jobs) as pool:
            for done in [pool.submit(run_pair, wanted, book, *pair) for pair in wanted_pairs(wanted)]:
                done.result()
    print(page.write(page.read_results(path), wanted.page or wanted.output))


if __name__ == "__main__":
    main()
