"""A run that is killed and restarted, on as many ranks or on more, ends as one that was not; a
damaged checkpoint is passed over for the one before.

Usage: restart.py FOLDER_OF_PROGRAMS SCRATCH [ACCELERATOR [STEPS]]
"""
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

from runs import (ENVIRONMENT, ROOT, Run, Verdict, checkpoints, command, exactly_same_steps, fresh, same_steps,
                  table)

CASE = ROOT / "xml" / "pulse-tiny.xml"


def words(output, steps, accelerator):
    arguments = [CASE, "--output", output, "--steps", steps]
    settings = [f"Coupling/accelerator={accelerator}"]
    if accelerator == "aitken":  # many iterations, which magnify what the linear solvers leave: exact on as many ranks
        settings += ["Coupling/first factor of a step=last factor", "Coupling/tolerance=1e-5"]
    for setting in settings:
        arguments += ["--set", setting]
    return arguments


def kill_behind(step, process, results):
    """Kills the process in the step behind the first checkpoint that is not older."""
    while process.poll() is None:
        if max(checkpoints(results), default=0) >= step:
            break
        time.sleep(0.01)
    time.sleep(0.1)
    was_running = process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.wait()
    return was_running


def check_tables(verdict, name, results, steps):
    for file, key in (("coupling", "iteration"), ("newton", "coupling_iteration"),
                      ("linear", "coupling_iteration")):
        rows = table(results / f"{file}.csv")
        keys = list(zip(rows["step"], rows[key]))
        verdict.claim(keys == sorted(keys) and set(rows["step"]) == set(range(1, steps + 1)),
                      f"{name}: {file}.csv has {len(keys)} rows in order, of all {steps} steps")
    rows = table(results / "coupling.csv")
    keys = list(zip(rows["step"], rows["iteration"]))
    verdict.claim(len(set(keys)) == len(keys), f"{name}: no coupling iteration is there twice")


def check_fields(verdict, name, results, straight, steps):
    def times(folder):
        root = xml.parse(folder / "fields.xdmf").getroot()
        return [float(time.get("Value")) for time in root.iter("Time")]
    verdict.claim(times(results) == times(straight), f"{name}: fields.xdmf has {steps} steps")
    try:
        import h5py
    except ImportError:
        print("skip  h5py is not installed: fields.h5 is not opened")
        return
    with h5py.File(results / "fields.h5", "r") as one, h5py.File(straight / "fields.h5") as other:
        for field in ("fluid/velocity", "wall/displacement", "wall/von_mises"):
            a, b = (file[f"step_{steps:06d}/{field}"][...] for file in (one, other))
            error = abs(a - b).max() / abs(b).max()
            verdict.claim(error < 1e-6, f"{name}: the last {field} differs by {error:.1e}")


def go_on(verdict, programs, folder, results, arguments, ranks=1):
    name = f"{results.name}, {ranks} rank(s)"
    run = Run(command(programs / "tunica-fsi", arguments + ["--restart"], ranks), folder)
    verdict.claim(run.status == 0, f"{name}: ends with 0 ({run.seconds:.1f} s)")
    if run.status != 0:
        print(run.out + run.err)
    return run, name


def pass_over_damage(verdict, programs, folder, steps, accelerator):
    last = max(checkpoints(folder / "damaged"))
    newest = folder / "damaged" / f"checkpoint-{last:06d}.h5"
    image = bytearray(newest.read_bytes())
    image[len(image) // 2] ^= 0xff
    newest.write_bytes(image)
    run, name = go_on(verdict, programs, folder, folder / "damaged",
                      words("damaged", steps, accelerator))
    verdict.claim(f"checkpoint of step {last} is unusable" in run.out and
                  f"restart after step {last - 1}" in run.out,
                  f"{name}: tells that the newest checkpoint is damaged and takes the other")
    same_steps(verdict, name, folder / "damaged", folder / "straight")


def main(programs, scratch, accelerator="iqn-ils", steps="5"):
    verdict = Verdict()
    folder, steps = fresh(scratch), int(steps)
    straight = folder / "straight"
    run = Run(command(programs / "tunica-fsi", words("straight", steps, accelerator)), folder)
    verdict.claim(run.status == 0, f"the run without a break ends with 0 ({run.seconds:.1f} s)")
    verdict.claim(checkpoints(straight) == [steps - 1, steps], "it keeps its last two checkpoints")

    with open(folder / "log.txt", "w") as log:
        arguments = command(programs / "tunica-fsi", words("killed", steps, accelerator))
        process = subprocess.Popen(arguments, cwd=folder, env=ENVIRONMENT, stdout=log, stderr=log)
        was_running = kill_behind(min(2, steps - 2), process, folder / "killed")
    verdict.claim(was_running, "the other one was killed before its end")
    restarts = {"one": 1, "two": 2} if accelerator == "iqn-ils" else {"one": 1}
    for copy in [*restarts, "damaged"]:
        shutil.copytree(folder / "killed", folder / copy)

    for name, ranks in restarts.items():
        results = folder / name
        run, name = go_on(verdict, programs, folder, results, words(name, steps, accelerator), ranks)
        if ranks == 1:  # whatever saves work begins anew with each step
            exactly_same_steps(verdict, name, results, straight)
        else:
            same_steps(verdict, name, results, straight)
        check_tables(verdict, name, results, steps)
        check_fields(verdict, name, results, straight, steps)
    if accelerator == "iqn-ils":
        pass_over_damage(verdict, programs, folder, steps, accelerator)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]), *sys.argv[3:]))
