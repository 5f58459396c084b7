"""One results folder is for one run at a time; a run that was killed is no longer in it.

Usage: two_runs.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import signal
import socket
import subprocess
import sys
import time

from runs import ENVIRONMENT, MONOLITHIC, ROOT, Run, Verdict, checkpoints, command, fresh, table

CASE = ROOT / "xml" / "pulse-tiny.xml"
WORDS = [CASE, "--output", "results", "--set", "Output/fields every=0", *MONOLITHIC]


def snapshot(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    results = folder / "results"
    with open(folder / "log.txt", "w") as log:
        first = subprocess.Popen(command(programs / "tunica-fsi", WORDS + ["--steps", 1000]), cwd=folder,
                                 env=ENVIRONMENT, stdout=log, stderr=log)
    while first.poll() is None and not checkpoints(results):
        time.sleep(0.01)
    first.send_signal(signal.SIGSTOP)  # alive, and it touches nothing
    time.sleep(0.1)
    before = snapshot(results)
    for name, more, ranks in (("a new run", [], 1), ("a restart", ["--restart"], 2),
                              ("a run that overwrites", ["--overwrite"], 1)):
        second = Run(command(programs / "tunica-fsi", WORDS + ["--steps", 2, *more], ranks), folder)
        verdict.claim(second.status == 1 and f"process {first.pid} on host {socket.gethostname()}" in second.err,
                      f"{name} is refused beside another: {second.status} {second.err.splitlines()[:1]}")
    dry = Run(command(programs / "tunica-fsi", WORDS + ["--dry-run"]), folder)
    verdict.claim(dry.status == 0, "a dry run writes nothing and may")
    verdict.claim(snapshot(results) == before, "the folder is as it was")
    first.send_signal(signal.SIGKILL)
    first.wait()
    last = max(checkpoints(results))
    verdict.claim((results / ".tunica-lock").exists(), "the killed run leaves its lock")
    third = Run(command(programs / "tunica-fsi", WORDS + ["--steps", last + 1, "--restart"], 2), folder)
    verdict.claim(third.status == 0 and table(results / "steps.csv")["step"][-1] == last + 1,
                  f"and nobody minds: the run goes on after step {last} {third.err}")
    verdict.claim(not (results / ".tunica-lock").exists(), "a run that ends takes its lock away")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
