"""A run that is killed leaves its finished steps readable: fields.h5, fields.xdmf and the tables.

Usage: kill_run.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

from runs import ENVIRONMENT, ROOT, Verdict, command, fresh, table


def finished_steps(results):
    """Steps that the XDMF names; -1 while there is none or only a part of one."""
    try:
        text = (results / "fields.xdmf").read_text()
    except FileNotFoundError:
        return -1
    return len(xml.fromstring(text).findall(".//Time"))


def kill_after(steps, process, results):
    while finished_steps(results) < steps and process.poll() is None:
        time.sleep(0.02)
    time.sleep(0.3)  # into the next step
    was_running = process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.wait()
    return was_running


def check_fields(verdict, results, steps):
    try:
        import h5py
    except ImportError:
        print("skip  h5py is not installed: fields.h5 is not opened")
        return
    with h5py.File(results / "fields.h5", "r") as file:
        points = file["fluid/points"].shape[0]
        for k in range(1, steps + 1):
            values = file[f"step_{k:06d}/fluid/velocity"][...]
            verdict.claim(values.shape == (points, 3) and bool((values == values).all()),
                          f"step {k} of fields.h5 holds {values.shape[0]} velocities")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    results = folder / "results"
    words = command(programs / "tunica-fsi",
                    [ROOT / "xml" / "pulse-tiny.xml", "--output", "results"])
    with open(folder / "log.txt", "w") as log:
        process = subprocess.Popen(words, cwd=folder, env=ENVIRONMENT, stdout=log, stderr=log)
    was_running = kill_after(2, process, results)
    verdict.claim(was_running, "the run was killed before its end")
    steps = finished_steps(results)
    verdict.claim(steps >= 2, f"fields.xdmf names {steps} finished steps")
    rows = table(results / "steps.csv")
    verdict.claim(len(rows["step"]) >= steps and rows["step"] == sorted(rows["step"]),
                  f"steps.csv has {len(rows['step'])} whole rows")
    verdict.claim(all(None not in column for column in rows.values()), "no row is cut off")
    for name in ("coupling", "newton", "linear"):
        verdict.claim(len(table(results / f"{name}.csv")) > 0, f"{name}.csv is readable")
    record = json.loads((results / "run.json").read_text())
    verdict.claim(record["status"] == "running", f"run.json says \"{record['status']}\"")
    check_fields(verdict, results, steps)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
