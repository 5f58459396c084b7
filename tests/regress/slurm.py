"""docs/cluster/run.slurm: a run that Slurm stops before the limit of its jobs goes on in the next one, and its history is
that of a run nobody stopped. Slurm's daemons are started for one machine; where Debian's slurm-wlm is not
installed, or the user is not root, the test is skipped.

Usage: slurm.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time

from runs import ENVIRONMENT, ROOT, SKIPPED, TIGHT, Run, Verdict, command, fresh, same_steps, table

CASE = ROOT / "xml" / "pulse-tiny.xml"
STEPS = 300  # more than fit into the first job of most machines; nothing is claimed of how many do
NAMES = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel")
CONFIGURATION = """ClusterName=one
SlurmctldHost={host}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
PluginDir={plugins}
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/control
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/control.pid
SlurmdPidFile={folder}/spool.pid
SlurmctldPort={control}
SlurmdPort={daemon}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmctldLogFile={folder}/control.log
SlurmdLogFile={folder}/daemon.log
NodeName={host} CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as one:
        one.bind(("", 0))
        return one.getsockname()[1]


class Slurm:
    """munged, slurmctld and slurmd of their own, until it is closed."""

    def __init__(self, folder):
        self.folder = folder
        path = os.environ["PATH"] + ":/usr/sbin"
        self.programs = {name: shutil.which(name, path=path) for name in NAMES}
        self.daemons = []
        self.environment = dict(ENVIRONMENT, SLURM_CONF=str(folder / "slurm.conf"), PATH=path)

    def is_there(self):
        return all(self.programs.values()) and os.geteuid() == 0

    def start(self):
        folder = self.folder
        for name in ("control", "spool"):
            (folder / name).mkdir()
        prefix = pathlib.Path(self.programs["slurmctld"]).resolve().parents[1]
        plugins = next(iter(prefix.glob("lib/*/slurm*/auth_munge.so"))).parent
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], folder=folder, plugins=plugins, control=free_port(),
            daemon=free_port(), cores=os.cpu_count()))
        key = folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        munge = ["munged", "--foreground", "--force", f"--key-file={key}"] + [
            f"--{what}={folder}/munge.{end}" for what, end in (("socket", "socket"), ("pid-file", "pid"),
                                                               ("log-file", "log"), ("seed-file", "seed"))]
        for words in (munge, ["slurmctld", "-D"], ["slurmd", "-D"]):
            self.daemons.append(subprocess.Popen([self.programs[words[0]], *words[1:]], env=self.environment,
                                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
            time.sleep(2)  # the next one asks it

    def run(self, name, *words):
        done = subprocess.run([self.programs[name], *map(str, words)], env=self.environment, capture_output=True,
                              text=True)
        return done.stdout + done.stderr

    def close(self):
        if self.daemons:
            self.run("scancel", "--user=root")
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait()


def main(programs, scratch):
    programs, folder, verdict = pathlib.Path(programs).resolve(), fresh(scratch), Verdict()
    slurm = Slurm(folder)
    if not slurm.is_there():
        print("skip  Slurm is not installed, or this is not root")
        return SKIPPED
    try:
        slurm.start()
        for ranks, array in ((2, "1-1"), (1, "1-100%1")):  # the first job's limit comes, and others take over
            jobs = slurm.run("sbatch", "--parsable", f"--export=ALL,TUNICA={programs}", f"--ntasks={ranks}",
                             "--time=1", f"--array={array}", "--signal=B:USR1@50", f"--chdir={folder}",
                             ROOT / "docs" / "cluster" / "run.slurm", CASE, folder / "results", "--steps", STEPS, *TIGHT)
            verdict.claim(jobs.strip().isdigit(), f"sbatch takes the script: {jobs.strip()}")
            while "tunica" in slurm.run("squeue"):
                time.sleep(2)
    finally:
        slurm.close()
    outputs = sorted(folder.glob("tunica-*.out"))
    verdict.claim(0 < len(outputs) < 100, f"{len(outputs)} jobs have run, the others were cancelled")
    straight = Run(command(programs / "tunica-fsi", [CASE, "--output", "straight", "--steps", STEPS, *TIGHT], 3), folder,
                   ENVIRONMENT)
    verdict.claim(straight.status == 0, "a run that nobody stops is done")
    steps = table(folder / "results" / "steps.csv")["step"]
    verdict.claim(steps == list(range(1, STEPS + 1)), f"the jobs have made {len(steps)} steps, each once")
    legs = json.loads((folder / "results" / "run.json").read_text())["history"]
    ranks = [leg["ranks"] for leg in legs]
    verdict.claim(ranks == sorted(ranks, reverse=True), f"the jobs have {ranks} ranks")
    # Round-off grows over so many steps: four of them, on two, three ranks and one, agree to 1e-10, see stops.py.
    same_steps(verdict, "over all jobs", folder / "results", folder / "straight", 1e-9)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
