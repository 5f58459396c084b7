"""A run that is told to stop ends behind its last whole step, with a checkpoint and an exit status of its own, whichever
rank has heard of it; told twice, it ends at once. One that fails leaves its last good state.

Usage: stops.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

from runs import ENVIRONMENT, MONOLITHIC, ROOT, TIGHT, Run, Verdict, checkpoints, command, fresh, remove_results, same_steps

CASE = ROOT / "xml" / "pulse-tiny.xml"
STOPPED = 5
# Without a preconditioner and with a basis of two vectors no solve of the second step comes to an end.
STUCK = [word for setting in ("preconditioner=none", "fallbacks={}", "restart=2", "max iterations=1000000")
         for word in ("--set", f"Coupling/Linear Solver/{setting}")]
STUCK += ["--set", "Coupling/Newton/linear tolerance=1e-14", "--set", "Output/progress every=0"]
RARELY = ["--set", "Output/fields every=0", "--set", "Output/checkpoint every=1000"]
SOON = [*RARELY, *MONOLITHIC]  # a step takes little


def words(output, steps, *more):
    return [CASE, "--output", output, "--steps", steps, *SOON, *more]


def steps_in(results):
    try:
        return len((results / "steps.csv").read_text().splitlines()) - 1
    except FileNotFoundError:
        return 0


def begun(words, log, is_ready):
    """A run in the folder of the file that takes its lines, once it is ready."""
    with open(log, "w") as out:
        process = subprocess.Popen(words, cwd=log.parent, env=ENVIRONMENT, stdout=out, stderr=out)
    while process.poll() is None and not is_ready():
        time.sleep(0.001)
    return process


def status_when_told(words, log, is_ready, number):
    """Exit status of a run whose last rank gets a signal once it is ready."""
    process = begun(words, log, is_ready)
    os.kill((ranks_of(process) or [process.pid])[-1], number)
    return process.wait()


def started(programs, folder, output, ranks=1, is_ready=lambda results: steps_in(results) > 0):
    """A run that would be long, once it is ready: behind its first step."""
    return begun(command(programs / "tunica-fsi", words(output, 1000), ranks), folder / f"{output}.txt",
                 lambda: is_ready(folder / output))


def ranks_of(process):
    """Process numbers of the ranks that mpirun has started, lowest first."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = path.read_text()
        except OSError:
            continue
        name, rest = text[text.index("(") + 1:text.rindex(")")], text[text.rindex(")") + 2:].split()
        if name.startswith("tunica-") and int(rest[1]) == process.pid:
            found.append(int(path.parent.name))
    return sorted(found)


def check_stop(verdict, folder, output, name, status):
    results, last = folder / output, steps_in(folder / output)
    verdict.claim(status == STOPPED, f"{output}: exit status {status} is {STOPPED}")
    verdict.claim(max(checkpoints(results), default=0) == last, f"{output}: there is a checkpoint of step {last}, the last")
    record = json.loads((results / "run.json").read_text())
    verdict.claim(record["status"] == "stopped" and f"stopped by {name} after step {last}" in record["message"],
                  f"{output}: run.json says \"{record['message']}\"")
    verdict.claim(record["message"] in (folder / f"{output}.txt").read_text(), f"{output}: so does the screen")


def stops(verdict, programs, folder):
    for name in ("SIGTERM", "SIGINT", "SIGUSR1"):
        process = started(programs, folder, name)
        process.send_signal(getattr(signal, name))
        check_stop(verdict, folder, name, name, process.wait())
    last = steps_in(folder / "SIGUSR1")
    for output, more in (("straight", []), ("SIGUSR1", ["--restart"])):
        done = Run(command(programs / "tunica-fsi", words(output, last + 2, *more)), folder)
        verdict.claim(done.status == 0, f"{output}: ends with {done.status} after {last + 2} steps")
    same_steps(verdict, "stopped and gone on", folder / "SIGUSR1", folder / "straight")


def hears_of_its_limit_in_the_set_up(verdict, programs, folder):
    process = started(programs, folder, "early", is_ready=lambda results: (results / ".tunica-lock").exists())
    process.send_signal(signal.SIGUSR1)
    check_stop(verdict, folder, "early", "SIGUSR1", process.wait())
    verdict.claim(steps_in(folder / "early") > 0, "it has made a step all the same")


def agrees(verdict, programs, folder):
    process = started(programs, folder, "one-rank", 2)
    ranks = ranks_of(process)
    verdict.claim(len(ranks) == 2, f"two ranks run: {ranks}")
    os.kill(ranks[-1], signal.SIGUSR1)
    check_stop(verdict, folder, "one-rank", "SIGUSR1", process.wait())


def ends_at_once(verdict, programs, folder):
    process = started(programs, folder, "twice")
    process.send_signal(signal.SIGSTOP)  # both wishes come before anything else is done
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGCONT):
        process.send_signal(number)
    status = process.wait()
    verdict.claim(status in (-signal.SIGTERM, -signal.SIGINT), f"the second signal ends the run: {status}")


def is_stuck(log):
    """It says that it is in the second step's first solve, and far from its end."""
    return "step 2: fluid and wall: Newton step 1: GCR iteration 200" in log.read_text()


def ends_a_step_that_is_stuck(verdict, programs, folder):
    """A signal to one rank of two in a linear solve; the step before stays, and the run can go on from there."""
    good = Run(command(programs / "tunica-fsi", words("stuck", 1, "--set", "Coupling/scheme=monolithic")), folder)
    verdict.claim(good.status == 0, f"the first step is made: {good.status} {good.err}")
    checkpoint = folder / "stuck" / "checkpoint-000001.h5"
    before = checkpoint.read_bytes()
    log = folder / "stuck.txt"
    status = status_when_told(
        command(programs / "tunica-fsi", words("stuck", 3, "--set", "Coupling/scheme=monolithic", *STUCK, "--restart"), 2),
        log, lambda: is_stuck(log), signal.SIGTERM)
    check_stop(verdict, folder, "stuck", "SIGTERM", status)
    verdict.claim("within step 2" in log.read_text(), "the screen names the step that has not ended")
    verdict.claim(checkpoint.read_bytes() == before, "the checkpoint of the step before is untouched")
    more = Run(command(programs / "tunica-fsi", words("stuck", 2, "--set", "Coupling/scheme=monolithic", "--restart")), folder)
    straight = Run(command(programs / "tunica-fsi", words("free", 2, "--set", "Coupling/scheme=monolithic")), folder)
    verdict.claim([more.status, straight.status] == [0, 0], f"with other solvers it goes on: {more.status} {more.err}")
    same_steps(verdict, "stuck and gone on", folder / "stuck", folder / "free")


def keeps_to_the_clock(verdict, programs, folder):
    limited = Run(command(programs / "tunica-fsi", words("clock", 3, "--set", "Time/wall limit=0:00:00.001")), folder)
    (folder / "clock.txt").write_text(limited.err)
    verdict.claim(steps_in(folder / "clock") == 1, "with no time left one step is made")
    check_stop(verdict, folder, "clock", '"wall limit"', limited.status)
    more = Run(command(programs / "tunica-fsi", words("clock", 2, "--restart", "--set", "Time/wall limit=999:00:00")), folder)
    verdict.claim(more.status == 0, f"with time it goes on: {more.status} {more.err}")
    never = Run(command(programs / "tunica-fsi", words("never", 3, "--set",
                                                       "Time/wall limit=0.001", "--set", "Output/checkpoint every=0")), folder)
    verdict.claim(never.status == STOPPED and "without a checkpoint" in never.err and not checkpoints(folder / "never"),
                  f"where checkpoints are not wanted there is none: {never.err.strip()}")


def goes_on_on_a_third_number_of_ranks(verdict, programs, folder):
    """Monolithic, and solved so far that round-off is all that may differ."""
    def run(output, ranks, *more):
        return Run(command(programs / "tunica-fsi", words(output, 4, *TIGHT, *more), ranks), folder)
    limited = run("third", 2, "--set", "Time/wall limit=0.001")
    more = run("third", 3, "--restart", "--set", "Time/wall limit=999:00:00")
    straight = run("alone", 1)
    verdict.claim([limited.status, more.status, straight.status] == [STOPPED, 0, 0], "two ranks stop, three go on, one makes all")
    same_steps(verdict, "two ranks, then three", folder / "third", folder / "alone", 1e-10)


def pulse(path, values):
    """The case with an inlet pressure of these factors at the first steps."""
    text = CASE.read_text().replace("../meshes", str(ROOT / "meshes"))
    old = text[text.index('<Parameter name="times"'):]
    old = old[:old.index("</ParameterList>")]
    times = ", ".join(str(0.125 * k) for k in range(len(values)))
    new = (f'<Parameter name="times" type="Array(double)" value="{{{times}}}"/>'
           f'<Parameter name="values" type="Array(double)" value="{{{", ".join(map(str, values))}}}"/>')
    path.write_text(text.replace(old, new))


def leaves_its_last_good_state(verdict, programs, folder):
    pulse(folder / "bad.xml", [1, 1, 1, 1e9])
    pulse(folder / "good.xml", [1, 1, 1, 1])
    def run(case, output, *more):
        return Run(command(programs / "tunica-fsi", [case, "--output", output, "--steps", 4, *RARELY, *more]), folder)
    failed = run("bad.xml", "failed")
    verdict.claim(failed.status == 2 and checkpoints(folder / "failed") == [2],
                  f"step 3 fails with {failed.status}, the checkpoint is {checkpoints(folder / 'failed')}")
    mended, straight = run("good.xml", "failed", "--restart", "--allow-changes"), run("good.xml", "good")
    verdict.claim([mended.status, straight.status] == [0, 0], f"mended it goes on {mended.err}")
    same_steps(verdict, "mended", folder / "failed", folder / "good")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for part in (stops, hears_of_its_limit_in_the_set_up, agrees, ends_at_once, ends_a_step_that_is_stuck, keeps_to_the_clock,
                 goes_on_on_a_third_number_of_ranks, leaves_its_last_good_state):
        part(verdict, programs, folder)
    remove_results(folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
