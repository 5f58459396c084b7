"""What a run refuses to replace and a restart to go on from, with one clear message and without
touching the folder; what a restart takes over in spite of a difference; a full disk; the case in
its own folder; fluid and wall alone.

Usage: restart_limits.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import resource
import shutil
import subprocess
import sys
import time

from runs import ENVIRONMENT, MONOLITHIC, ROOT, Run, Verdict, checkpoints, command, fresh, same_steps, table

CASE = ROOT / "xml" / "pulse-tiny.xml"
MESHES = ROOT / "meshes"


def fsi(programs, folder, steps, more=(), ranks=1):
    words = [CASE, "--output", "results", "--steps", steps] + list(more)
    return Run(command(programs / "tunica-fsi", words, ranks), folder)


def snapshot(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def refuses(verdict, programs, folder):
    before = snapshot(folder / "results")
    mesh = f"Mesh/file={MESHES / 'tube-medium.h5'}"
    for name, more, ranks, parts in (
            ("another mesh", ["--restart", "--set", mesh], 1,
             ["checkpoint-000002.h5 belongs to another mesh", "tube-medium.h5"]),
            ("another step size", ["--restart", "--set", "Time/step size=0.25"], 2,
             ['"step size" is 0.25 ms', "was made with 0.125 ms"]),
            ("no checkpoint", ["--restart", "--output", "nowhere"], 1,
             ['"nowhere" has no checkpoint', "--output"]),
            ("a bad case", ["--set", "Fluid/densty=1"], 1, ["densty"]),
            ("results without a word", [], 2,
             ['"results" holds results of an earlier run (steps.csv, run.json, fields.h5, '
              'checkpoint-000002.h5, checkpoint-000001.h5)', "--restart", "--output", "--overwrite"]),
            ("both words", ["--restart", "--overwrite"], 1, ["one of the two"])):
        run = fsi(programs, folder, 4, more, ranks)
        lines = [line for line in run.err.splitlines() if line.startswith("tunica-fsi: ")]
        verdict.claim(run.status == 1, f"{name}: exit status {run.status} is 1")
        verdict.claim(len(lines) == 1, f"{name}: {' | '.join(lines)}")
        for part in parts:
            verdict.claim(part in " ".join(lines), f"{name}: the message holds: {part}")
    verdict.claim(snapshot(folder / "results") == before, "refusals leave all as it was")


def knows_its_end(verdict, programs, folder):
    before = snapshot(folder / "results")
    run = fsi(programs, folder, 2, ["--restart"])
    verdict.claim(run.status == 0 and "has made 2 of 2 steps" in run.out,
                  "a run that has made its steps says so")
    verdict.claim(snapshot(folder / "results") == before, "and leaves all as it was")


def survives_a_full_disk(verdict, programs, folder):
    """From the first checkpoint on no file grows beyond 120 kB; a checkpoint needs more."""
    results = folder / "full"
    words = [CASE, "--output", "full", "--steps", 6, *MONOLITHIC, "--set", "Output/fields every=0"]
    process = subprocess.Popen(  # with what the system does where a file may not grow, which is to kill
        command(programs / "tunica-fsi", words), cwd=folder, env=ENVIRONMENT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while process.poll() is None and not checkpoints(results):
        time.sleep(0.01)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (120000, resource.RLIM_INFINITY))
    _, errors = process.communicate()
    lines = errors.splitlines()
    verdict.claim(process.returncode == 3, f"full disk: exit status {process.returncode} is 3")
    verdict.claim(len(lines) == 1 and "no checkpoint could be written" in lines[0],
                  f"full disk: {' | '.join(lines)}")
    last = max(checkpoints(results))
    verdict.claim(not list(results.glob("*.tmp")), "full disk: no draft is left")
    run = Run(command(programs / "tunica-fsi", words + ["--restart", "--steps", last + 1]), folder)
    verdict.claim(run.status == 0 and table(results / "steps.csv")["step"][-1] == last + 1,
                  f"full disk: with room again the run goes on after step {last}")


def tells_of_lost_words(verdict, programs, folder):
    for name, words in (("tunica-fsi", [CASE, "--output", "unheard", "--steps", 1, *MONOLITHIC]), ("tunica-check", [CASE]),
                        ("tunica-mesh", ["info", MESHES / "tube-tiny.h5"])):
        with open("/dev/full", "w") as full:
            done = subprocess.run(command(programs / name, words), cwd=folder, env=ENVIRONMENT, text=True,
                                  stdout=full, stderr=subprocess.PIPE)
        verdict.claim(done.returncode == 3 and "standard output could not be written" in done.stderr,
                      f"{name} > /dev/full: exit status {done.returncode} is 3: {done.stderr.strip()}")
    record = json.loads((folder / "unheard" / "run.json").read_text())
    verdict.claim(record["status"] == "done", "tunica-fsi > /dev/full: the results are whole")


def goes_further(verdict, programs, folder):
    run = fsi(programs, folder, 3, ["--restart", "--set", "Coupling/accelerator=aitken",
                                    "--set", "Coupling/tolerance=1e-5"])
    verdict.claim(run.status == 0 and 'the accelerator was "iqn-ils" and is "aitken" now' in run.out,
                  "another accelerator begins without history, and says so")
    verdict.claim(table(folder / "results" / "steps.csv")["step"] == [1.0, 2.0, 3.0],
                  "more --steps prolong the run")
    record = json.loads((folder / "results" / "run.json").read_text())
    legs = record["history"]
    verdict.claim(record["status"] == "done" and [leg["after step"] for leg in legs] == [0, 2],
                  f"run.json knows {len(legs)} legs and the end")
    verdict.claim(record["timings"]["march from the first step"] > record["timings"]["march"],
                  "run.json counts the time before the restart")


def begins_anew(verdict, programs, folder):
    run = fsi(programs, folder, 1, ["--overwrite", "--set", "Output/checkpoint every=0"])
    verdict.claim(run.status == 0 and checkpoints(folder / "results") == [],
                  "--overwrite removes the checkpoints of the run before; none are written if not wanted")
    verdict.claim(table(folder / "results" / "steps.csv")["step"] == [1.0], "and begins anew")


def one_result_is_enough(verdict, programs, folder):
    for name in ("steps.csv", "run.json", "fields.h5", "checkpoint-000007.h5"):
        (folder / "some").mkdir(exist_ok=True)
        (folder / "some" / name).write_text("mine")
        run = fsi(programs, folder, 1, ["--output", "some"])
        verdict.claim(run.status == 1 and f"({name})" in run.err and
                      snapshot(folder / "some") == {name: b"mine"}, f"{name} alone is not replaced")
        shutil.rmtree(folder / "some")
    (folder / "some").mkdir()
    (folder / "some" / "notes.txt").write_text("mine")
    run = fsi(programs, folder, 1, ["--output", "some", "--set", "Output/fields every=0"])
    verdict.claim(run.status == 0 and (folder / "some" / "notes.txt").read_text() == "mine",
                  "a folder with other files is fine, and they stay")


def leaves_a_checkpoint_where_fields_have_no_room(verdict, programs, folder):
    def words(output):
        return [CASE, "--output", output, "--steps", 8, *MONOLITHIC, "--set", "Output/fields every=1",
                "--set", "Output/checkpoint every=100"]
    straight = Run(command(programs / "tunica-fsi", words("spacious")), folder)
    verdict.claim(straight.status == 0, "a run with room for its fields is done")
    room = int(0.6 * (folder / "spacious" / "fields.h5").stat().st_size)
    results = folder / "crowded"
    process = subprocess.Popen(command(programs / "tunica-fsi", words("crowded")), cwd=folder, env=ENVIRONMENT, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while process.poll() is None and not (results / "steps.csv").exists():
        time.sleep(0.01)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (room, resource.RLIM_INFINITY))
    _, errors = process.communicate()
    last = int(table(results / "steps.csv")["step"][-1])
    verdict.claim(process.returncode == 3 and "fields.h5" in errors, f"no room for fields: {process.returncode}, {errors.strip()}")
    verdict.claim(1 < last < 8 and checkpoints(results) == [last], f"there is a checkpoint of step {last}: {checkpoints(results)}")
    run = Run(command(programs / "tunica-fsi", words("crowded") + ["--restart"]), folder)
    verdict.claim(run.status == 0, f"with room it goes on {run.err}")
    same_steps(verdict, "no room for fields", results, folder / "spacious")


def keeps_its_own_case(verdict, programs, folder):
    """A case in the folder of its results stays as it is, however it is named."""
    text = CASE.read_text().replace("../meshes", str(MESHES)) + "<!-- by hand -->\n"
    home, link = folder / "home", folder / "link"
    home.mkdir()
    link.symlink_to("home")
    (home / "case.xml").write_text(text)
    (folder / "linked.xml").symlink_to(home / "case.xml")
    def run(case, output, *more):
        words = [case, "--output", output, *MONOLITHIC, "--set", "Output/fields every=0", *more]
        return Run(command(programs / "tunica-fsi", words), folder)
    other = run(CASE, "home", "--steps", 1)
    verdict.claim(other.status == 1 and "home/case.xml: another case has the file name" in other.err
                  and [path.name for path in home.iterdir()] == ["case.xml"],
                  "the case of another run is not replaced")
    for case, output, more, name in (
            ("home/case.xml", "home", ["--steps", 1], "case-used.xml"),
            ("linked.xml", "link", ["--steps", 1, "--overwrite"], "case-used.xml"),
            ("link/../home/case.xml", "./home", ["--steps", 2, "--restart"], "case-used-2.xml"),
            (CASE, "home", ["--steps", 3, "--restart"], "case-used-3.xml"),
            (CASE, "home", ["--steps", 1, "--overwrite"], "case-used.xml")):
        done = run(case, output, *more)
        used = (home / name).read_text()
        verdict.claim(done.status == 0 and (home / "case.xml").read_text() == text,
                      f"{case} into {output}: the case stays as it is {done.err}")
        verdict.claim(f'name="steps" type="int" value="{more[1]}"' in used,
                      f"{case} into {output}: {name} has what was used")
    verdict.claim(sorted(path.name for path in home.glob("case*")) == ["case-used.xml", "case.xml"],
                  "--overwrite removes the parameters of the legs before")
    shutil.copy(home / "case.xml", folder / "case-used.xml")
    mine = run("case-used.xml", ".", "--steps", 1)
    verdict.claim(mine.status == 0 and (folder / "case-used.xml").read_text() == text and
                  'value="1"' in (folder / "case.xml").read_text(),
                  f"a case of that name in the folder of the results is not taken for a result {mine.err}")


def one_field_goes_on(verdict, programs, folder, program, case, *words):
    def run(output, steps, *more, ranks=1):
        return Run(command(programs / program, [case, "--output", output, "--steps", steps, *words,
                                                *more], ranks), folder)
    straight, first = run("straight", 4), run("broken", 2)
    second = run("broken", 4, "--restart", ranks=2)
    verdict.claim([run.status for run in (straight, first, second)] == [0, 0, 0],
                  f"{program}: all end with 0")
    same_steps(verdict, program, folder / "broken", folder / "straight")
    if "Wall/analysis=dynamic" in words:
        energies = table(folder / "straight" / "steps.csv")["wall_kinetic_energy_kPa_mm3"]
        verdict.claim(min(energies) > 0, f"{program}: a moving wall has kinetic energy from its first step on")
    shutil.rmtree(folder / "broken")
    shutil.rmtree(folder / "straight")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    run = fsi(programs, folder, 2)
    verdict.claim(run.status == 0, f"the first two steps end with 0 ({run.seconds:.1f} s)")
    for part in (refuses, knows_its_end, survives_a_full_disk, leaves_a_checkpoint_where_fields_have_no_room,
                 tells_of_lost_words, goes_further, begins_anew, one_result_is_enough, keeps_its_own_case):
        part(verdict, programs, folder)
    one_field_goes_on(verdict, programs, folder, "tunica-solid", ROOT / "xml" / "inflation.xml",
                      "--set", "Wall/analysis=dynamic")
    one_field_goes_on(verdict, programs, folder, "tunica-fluid", ROOT / "xml" / "poiseuille.xml")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
