"""Makes the runs side by side; those that are done remain, those that were interrupted continue."""
import os
import shutil
import signal
import time

from vessel import checkpoint
from vessel.errors import BadInput, NotConverged
from vessel.folder import hash_of, hash_of_file, read_json, write_json
from vessel.programs import PROGRESS_SECONDS, last_line

from .plan import BASE

RECORD, FORMAT, RUNS, MESHES, LOCK = "certify.json", "tunica-certify 1", "runs", "meshes", ".tunica-certify-lock"
DONE, BAD_INPUT, NOT_CONVERGED, FAULT, DONE_BADLY, STOPPED = range(6)  # exit statuses
PAUSE = 0.1


def identity_of(case, mesh):
    """Of what the numbers depend on: the parameters without those of the output, and the contents of files."""
    words = {}

    def walk(node, path):
        for entry in node.findall("Parameter"):
            value = entry.get("value")
            is_file = os.path.isfile(value) and path != ["Mesh"]
            words["/".join(path + [entry.get("name")])] = hash_of_file(value) if is_file else value
        for child in node.findall("ParameterList"):
            if child.get("name") != "Output":
                walk(child, path + [child.get("name")])

    walk(case.root, [])
    words.pop("Mesh/file")
    return hash_of([words, hash_of_file(mesh)])


def check_folder(path, overwrite):
    """A folder that holds files of others is left alone."""
    if not os.path.exists(path):
        return
    if not os.path.isdir(path):
        raise BadInput(f"--output {path}: is no folder")
    if os.path.exists(os.path.join(path, RECORD)):
        record = read_json(os.path.join(path, RECORD))
        if not isinstance(record, dict) or record.get("format") != FORMAT:
            raise BadInput(f"{path}/{RECORD}: its format is not \"{FORMAT}\"; was it made by another version?")
    elif set(os.listdir(path)) - {LOCK}:
        raise BadInput(f"{path}: holds files but no {RECORD}, so that it was not made by tunica-certify. Name another folder"
                       + (": --overwrite replaces only what tunica-certify has made" if overwrite else ""))


def open_folder(path, case, identity, overwrite):
    """Continues what belongs to this case, and replaces runs only if asked to."""
    record = os.path.join(path, RECORD)
    if os.path.exists(record) and not overwrite:
        before = read_json(record)
        if before.get("identity") != identity:
            raise BadInput(f"{path}: holds runs of {before.get('case')} with other parameters or another mesh. Name another folder "
                           "with --output, or replace them with --overwrite")
    for name in (RUNS, MESHES) if overwrite else ():
        shutil.rmtree(os.path.join(path, name), ignore_errors=True)
    write_json(record, {"format": FORMAT, "case": os.path.abspath(case.path), "identity": identity})
    for name in (RUNS, MESHES):
        os.makedirs(os.path.join(path, name), exist_ok=True)


class Runs:
    """Starts the jobs; failed has those that did not come to their end, with the reason."""

    def __init__(self, folder, case, options, programs):
        self.folder, self.case, self.options, self.programs = folder, case, options, programs
        self.failed, self.children = {}, {}

    def results(self, job):
        return os.path.join(self.folder, RUNS, job.name)

    def is_done(self, job):
        path = os.path.join(self.results(job), "run.json")
        return os.path.exists(path) and read_json(path).get("status") == "done"

    def log(self, job):
        return os.path.join(self.folder, RUNS, job.name + ".log")

    def words(self, job):
        results = self.results(job)
        way = "--restart" if checkpoint.newest(results) else "--overwrite"
        return [self.case.program, os.path.abspath(self.case.path), "--output", results, way,
                *(word for setting in [*self.case.settings, *job.settings] for word in ("--set", setting))]

    def make(self, jobs, prepare):
        """All of them; prepare(job) makes its mesh. Raises where the case itself fails."""
        waiting = sorted((job for job in jobs if not self.is_done(job)), key=lambda job: (job.name != BASE, -job.cost))
        done, self.start, last = len(jobs) - len(waiting), time.time(), time.time()
        try:
            while waiting or self.children:
                while waiting and (len(self.children) + 1) * self.options.ranks <= self.options.cores:
                    self._start(waiting.pop(0), prepare)
                done += self._collect()
                time.sleep(PAUSE)
                if time.time() - last > PROGRESS_SECONDS:
                    last = time.time()
                    print(f"  {last - self.start:.0f} s: {done} of {len(jobs)} runs done; "
                          + "; ".join(f"{job.name} {self.progress(job)}" for job in self.children), flush=True)
        finally:
            self._end()

    def _start(self, job, prepare):
        prepare(job)
        self.children[job] = self.programs.start(self.words(job), self.log(job), self.options.ranks)

    def progress(self, job):
        path = os.path.join(self.results(job), "steps.csv")
        try:
            with open(path, "rb") as file:
                steps = max(file.read().count(b"\n") - 1, 0)
        except OSError:
            steps = 0
        return f"step {steps}" + (f" of {job.steps}" if job.steps else "")

    def _collect(self):
        """Takes note of the runs that have ended; returns how many."""
        ended = [(job, child.poll()) for job, child in self.children.items() if child.poll() is not None]
        for job, status in ended:
            del self.children[job]
            if status in (DONE, DONE_BADLY):
                print(f"  {job.name}: done after {time.time() - self.start:.0f} s", flush=True)
                continue
            reason = f"{self.case.program} ended with status {status}: {last_line(self.log(job))} (all in {self.log(job)})"
            if job.name == BASE or status not in (NOT_CONVERGED, FAULT):
                kind = {BAD_INPUT: BadInput, NOT_CONVERGED: NotConverged, STOPPED: NotConverged}.get(status, RuntimeError)
                raise kind(f"{job.name}: {reason}")
            self.failed[job.name] = reason
            print(f"  {job.name}: {reason}", flush=True)
        return len(ended)

    def _end(self):
        """Runs that still go on are asked to write a checkpoint and end."""
        for child in self.children.values():
            child.send_signal(signal.SIGTERM)
        for child in self.children.values():
            child.wait()
        self.children = {}

