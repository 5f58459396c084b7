"""The folder of a case: which stages are done, of what, and whether it may continue."""
import fcntl
import hashlib
import json
import os
import time

from .errors import BadInput
from .options import FREE, STAGE_OF, STAGES

RECORD, LOCK, FORMAT = "stages.json", ".tunica-vessel-lock", "tunica-vessel 1"
LOG, REFUSED = "programs.log", "refused.png"  # all that a surface that was refused leaves
FILE_OPTIONS = ("lumen", "wall", "flow")  # of which the contents count, not the name


def hash_of_file(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        for part in iter(lambda: file.read(1 << 20), b""):
            digest.update(part)
    return digest.hexdigest()[:16]


def hash_of(thing):
    return hashlib.sha256(json.dumps(thing, sort_keys=True).encode()).hexdigest()[:16]


def write_atomically(path, text):
    """A file of that name appears complete, or not at all."""
    draft = path + ".tmp"
    with open(draft, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(draft, path)


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise BadInput(f"{path}: is no valid JSON: {error}") from None
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None


def is_free(path):
    """Whether no process holds the lock in this file, which need not exist."""
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        pass
    return True


def hold(path, lock, program):
    """Makes the folder and holds the lock in it, until what is returned is closed, or this process ends in whatever way."""
    held = None
    try:
        os.makedirs(path, exist_ok=True)
        held = open(os.path.join(path, lock), "w", encoding="utf-8")
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        held.close()
        raise BadInput(f"{path}: another {program} works there. Wait for its end, or name another folder") from None
    except OSError as error:
        raise BadInput(f"{path}: cannot be written: {error.strerror}") from None
    return held


def write_json(path, thing):
    write_atomically(path, json.dumps(thing, indent=2) + "\n")


def words_of(options):
    """What the results depend on: option -> text, with a hash behind the name of a file."""
    words = {}
    for name in STAGE_OF:
        value = getattr(options, name)
        if name in FILE_OPTIONS and value is not None and os.path.isfile(value):
            value = f"{os.path.basename(value)} ({hash_of_file(value)})"
        words[name] = None if value is None else str(value)
    return words


class Folder:
    """The record of the stages, which is replaced in one step."""

    def __init__(self, path, words):
        self.path, self.words, self.lock = path, words, None
        self.record = {"format": FORMAT, "options": words, "stages": {}}
        if os.path.exists(self.file(RECORD)):
            self.record = read_json(self.file(RECORD))
            if not isinstance(self.record, dict) or self.record.get("format") != FORMAT:
                raise BadInput(f"{self.file(RECORD)}: its format is not \"{FORMAT}\"; was it made by another version?")
        elif os.path.isdir(path) and set(os.listdir(path)) - {LOCK, RECORD + ".tmp", LOG, REFUSED}:
            raise BadInput(f"{path}: holds files but no {RECORD}, so that it was not made by tunica-vessel. Name another folder")

    def file(self, *names):
        return os.path.join(self.path, *names)

    def accept(self, first):
        """Takes over the options, if they fit what was made before; `first` is made anew, so that its options may differ."""
        before = self.record["options"]
        changed = [name for name in STAGE_OF if before.get(name) != self.words[name] and name not in FREE]
        bound = [name for name in changed if first is None or STAGES.index(STAGE_OF[name]) < STAGES.index(first)]
        done = [name for name in bound if STAGE_OF[name] in self.record["stages"] or self._is_begun(STAGE_OF[name])]
        if done:
            name = done[0]
            stage = min((STAGE_OF[n] for n in done), key=STAGES.index)
            raise BadInput(f"{self.path}: was made with --{name.replace('_', '-')} {before.get(name)}, not "
                           f"{self.words[name]}. Name another folder, or make it anew with --from {stage}")

    def _is_begun(self, stage):
        """A run that has results belongs to its options before it is done."""
        return stage == "run" and os.path.exists(self.file("beats.json"))

    def begin(self):
        """From now on the folder is ours alone, until the end of this process, however it ends."""
        self.lock = hold(self.path, LOCK, "tunica-vessel")
        self.record["options"] = self.words
        self.save()

    def close(self):
        if self.lock:
            self.lock.close()
            self.lock = None

    def abandon(self):
        """A folder in which no stage was ever done is not one of a case: neither the record nor the lock remains."""
        if not set(os.listdir(self.path)) <= {RECORD, LOCK, LOG, REFUSED}:
            return
        for name in (RECORD, LOCK):
            if os.path.exists(self.file(name)):
                os.remove(self.file(name))
        self.close()
        if not os.listdir(self.path):
            os.rmdir(self.path)

    def save(self):
        write_json(self.file(RECORD), self.record)

    def inputs_of(self, stage, files):
        """A hash of the options of a stage, and of the files of earlier ones that it reads, as they are now."""
        mine = {name: self.words[name] for name in STAGE_OF if STAGE_OF[name] == stage and name not in FREE}
        present = {name: hash_of_file(self.file(name)) for name in files if os.path.exists(self.file(name))}
        return hash_of([mine, present])

    def is_done(self, stage, files):
        """Made from what its inputs are now, and all its results are there, though perhaps edited."""
        entry = self.record["stages"].get(stage)
        return (entry is not None and entry["inputs"] == self.inputs_of(stage, files)
                and all(os.path.exists(self.file(name)) for name in entry["results"]))

    def edited(self, stage):
        """Results that were changed after they had been made."""
        entry = self.record["stages"][stage]
        return [name for name, digest in entry["results"].items() if hash_of_file(self.file(name)) != digest]

    def forget(self, stage):
        """A stage is made anew: what follows no longer counts, unless it turns out the same."""
        self.record["stages"].pop(stage, None)
        self.save()

    def finish(self, stage, files, results, seconds):
        self.record["stages"][stage] = {
            "inputs": self.inputs_of(stage, files), "results": {name: hash_of_file(self.file(name)) for name in results},
            "seconds": round(seconds, 1), "finished": time.strftime("%Y-%m-%d %H:%M:%S")}
        self.save()
