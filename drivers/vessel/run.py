"""Stage run: beat by beat, until the beat repeats itself and has the pressures and shares asked for."""
import dataclasses
import os
import shutil
import time
import xml.etree.ElementTree as ElementTree

import numpy as np

from . import beats, case_file, checkpoint, correction, lumen, tune, tuning, walls
from .errors import BadInput, NotConverged
from .folder import hash_of, hash_of_file, is_free, read_json, write_atomically, write_json
from .network import Windkessel
from .programs import last_line
from .units import mmhg

TABLE, TUNED, RESULTS_FOLDER, LOG = tune.BEATS, "case-tuned.xml", "results", "run.log"
READS = (case_file.CASE, walls.MESH, lumen.TABLE, walls.TABLE, tune.TABLE, tune.INFLOW)
RESULTS = (TABLE, TUNED)
FIRST, RISE = "inflow-first.txt", 0.1  # part of the first beat in which its inflow rises from rest
MOST_SECONDS = 120  # for a run that was told to end
PERIODIC = 0.01  # change from beat to beat of a pressure, of the pulse, and of the wall shear stress
SURFACE = "./ParameterList[@name='Fluid']/ParameterList[@name='Surfaces']/ParameterList[@name='{}']"
KEYS = {"proximal": "proximal resistance", "capacitance": "capacitance", "distal": "distal resistance"}


def fingerprint(folder):
    """Of what the beats depend on."""
    return hash_of([hash_of_file(folder.file(name)) for name in READS])


def begin(folder, tuned):
    """What was done so far, or a new record. Results of another case are removed first: only a run of this one may go on."""
    path = folder.file(TABLE)
    if os.path.exists(path):
        record = read_json(path)
        if record.get("case") == fingerprint(folder):
            return record
        os.remove(path)
    wait_until_free(folder.file(RESULTS_FOLDER))
    shutil.rmtree(folder.file(RESULTS_FOLDER), ignore_errors=True)
    record = {"case": fingerprint(folder), "beats": [],
              "next": {"windkessels": as_dicts(windkessels_in_case(folder, tuned)[0]), "circuits": None}}
    write_json(path, record)
    return record


def as_dicts(windkessels):
    return {name: dataclasses.asdict(w) for name, w in windkessels.items()}


def from_dicts(entries):
    return {name: Windkessel(**entry) for name, entry in entries.items()}


def root_of_case(folder):
    try:
        return ElementTree.parse(folder.file(case_file.CASE)).getroot()
    except ElementTree.ParseError as error:
        raise BadInput(f"{folder.file(case_file.CASE)}: is no valid XML: {error}") from None


def number_in(folder, surface, name, key, default=None):
    found = surface.find(f"./Parameter[@name='{key}']") if surface is not None else None
    try:
        return float(found.get("value")) if found is not None or default is None else default
    except (AttributeError, TypeError, ValueError):
        raise BadInput(f"{folder.file(case_file.CASE)}: Fluid / Surfaces / {name}: lacks a number \"{key}\": outlets are "
                       "Windkessels here") from None


def windkessels_in_case(folder, tuned):
    """Windkessels and their initial pressures in the case, which may have been edited."""
    windkessels, initial = {}, {}
    for name in tuned["outlets"]:
        surface = root_of_case(folder).find(SURFACE.format(name))
        values = [number_in(folder, surface, name, key) for key in KEYS.values()]
        windkessels[name] = Windkessel(*values, number_in(folder, surface, name, "distal pressure", 0.0))
        initial[name] = number_in(folder, surface, name, "initial pressure", 0.0)
    return windkessels, initial


def time_step(folder, period):
    """Step size of the case, which may have been edited [ms]."""
    size = root_of_case(folder).find("./ParameterList[@name='Time']/Parameter[@name='step size']")
    step = float(size.get("value")) if size is not None else 0.0
    if step <= 0 or abs(period / step - round(period / step)) > 1e-6:
        raise BadInput(f"{folder.file(case_file.CASE)}: Time: \"step size\" is {step:g} ms, expected a whole part of the beat of "
                       f"{period:g} ms")
    return step


def wait_until_free(results):
    """The run of a program that was killed goes on until it has written its checkpoint."""
    for second in range(MOST_SECONDS):
        if is_free(os.path.join(results, ".tunica-lock")):
            return
        if second % 10 == 9:
            print(f"  {results}: waiting for an earlier run to end", flush=True)
        time.sleep(1)
    raise BadInput(f"{results}: another run writes its results there. Wait for its end")


def rising(count):
    """Part of the inflow at each of so many times of the first beat."""
    part = np.minimum(np.arange(count) / (RISE * count), 1.0)
    return 0.5 * (1.0 - np.cos(np.pi * part))


def first_state(folder, options, tuned):
    """What sets where the first beat begins: where other beats ended, or at rest."""
    if options.start_from:
        return ["--set", f"Time/initial state={os.path.abspath(os.path.join(options.start_from, RESULTS_FOLDER))}"]
    return first_inflow(folder, tuned)


def first_inflow(folder, tuned):
    """The run begins from rest, where a carotid has half of its mean flow at all times: its inflow rises to the curve in the
    first part of the first beat. Returns what sets that, and nothing where the case has another inlet."""
    inlet = root_of_case(folder).find(SURFACE.format(tuned["inlet"]))
    entry = inlet.find("./ParameterList[@name='Amplitude']/Parameter[@name='file']") if inlet is not None else None
    if entry is None or entry.get("value") != tune.INFLOW:
        return []
    samples = tune.read_inflow(folder, tuned["period"])
    both = np.concatenate([samples * rising(len(samples)), samples])  # the end of the first beat is the beginning of the second
    text = tune.inflow_text(both, 2 * tuned["period"], "the first beat, which rises from rest, and the second")
    write_atomically(folder.file(FIRST), text)
    place = f"Fluid/Surfaces/{tuned['inlet']}/Amplitude"
    return ["--set", f"{place}/file={FIRST}", "--set", f"{place}/period={2 * tuned['period']!r}"]


def settings(number, period, windkessels):
    words = ["--set", f"Output/averages from={(number - 1) * period!r}"]
    for name, w in windkessels.items():
        for field, key in KEYS.items():
            words += ["--set", f"Fluid/Surfaces/{name}/{key}={w[field]!r}"]
    return words


def advance(folder, options, programs, number, tuned, windkessels):
    """Computes until the end of the beat of this number. Steps that were halved count, so that more may be needed."""
    period = tuned["period"]
    step, results = time_step(folder, period), folder.file(RESULTS_FOLDER)
    words = settings(number, period, windkessels) + (first_state(folder, options, tuned) if number == 1 else [])
    steps, before = round(number * period / step), -1.0
    while True:
        has_state = checkpoint.newest(results) or os.path.exists(os.path.join(results, "prestress.h5"))
        way = ["--restart", "--allow-changes"] if has_state else ["--overwrite"]
        status = programs.run(["tunica-fsi", folder.file(case_file.CASE), "--output", results, "--steps", steps, *way,
                               *words], folder.file(LOG), options.ranks, shown=True)
        check_status(status, folder, options)
        newest = checkpoint.newest(results)
        if newest is None:
            raise BadInput(f"{folder.file(case_file.CASE)}: Output: \"checkpoint every\" is 0, expected checkpoints, from which "
                           "the next beat continues")
        reached = checkpoint.time_of(newest)
        if reached > number * period - 1e-6 * period:
            return
        if reached <= before:
            raise RuntimeError(f"{results}: the run does not come beyond {reached:g} ms")
        before, steps = reached, steps + round((number * period - reached) / step)


def check_status(status, folder, options):
    reason = f"tunica-fsi ended with status {status}: {last_line(folder.file(LOG))} (all in {folder.file(LOG)})"
    if status == 2 and "the prestress, at" in reason and options.ends == "slide":
        raise NotConverged(reason + ". Ends that slide hold the wall along their normals alone; across a plane that all openings "
                           "nearly face, its bending and the tissue alone bear the pressure. Give --ends clamped --from case")
    if status in (2, 5):
        raise NotConverged(reason + ". The same command continues from the last checkpoint")
    if status == 1:
        raise BadInput(reason)
    if status not in (0, 4):
        raise RuntimeError(reason)


def curves_of(folder, number, tuned):
    table = beats.read_steps(folder.file(RESULTS_FOLDER, "steps.csv"))
    return beats.curves_of(table, number, tuned["period"], tuned["inlet"], list(tuned["outlets"]))


def run_beat(folder, options, programs, tuned, record):
    """Runs the next beat and adds it to the record, with what follows from it still to be chosen."""
    number, following = len(record["beats"]) + 1, record["next"]
    wait_until_free(folder.file(RESULTS_FOLDER))
    newest = checkpoint.newest(folder.file(RESULTS_FOLDER))
    start = (number - 1) * tuned["period"]
    if following["circuits"] and newest and abs(checkpoint.time_of(newest) - start) < 1e-6 * tuned["period"]:
        if not checkpoint.set_circuits(newest, following["circuits"]):
            print(f"  {newest}: cannot be changed; the stored pressures go on as they are", flush=True)
    advance(folder, options, programs, number, tuned, following["windkessels"])
    curves = curves_of(folder, number, tuned)
    before = curves_of(folder, number - 1, tuned) if number > 1 else None
    results = folder.file(RESULTS_FOLDER)
    shear = beats.shear_change(os.path.join(results, "fields.h5"), beats.read_steps(os.path.join(results, "steps.csv")), number,
                               tuned["period"]) if number > 1 else None
    return {"windkessels": following["windkessels"],
            "circuits begin": following["circuits"] or windkessels_in_case(folder, tuned)[1],
            "measured": beats.measure(curves, tuned["inlet"]), "change": beats.change(curves, before, tuned["inlet"]),
            "shear change": shear}


def goal_in(tuned):
    return tuning.Goal(tuned["goal"]["systolic"], tuned["goal"]["diastolic"],
                       {name: outlet["split"] for name, outlet in tuned["outlets"].items()})


def is_periodic(beat):
    """A case that writes no fields is judged by its pressures alone."""
    return beat["change"] is not None and max(beat["change"], beat.get("shear change") or 0.0) < PERIODIC


def is_done(beat, goal, options):
    return is_periodic(beat) and max(map(abs, correction.errors(goal, beat["measured"]).values())) <= options.tolerance


def change_text(beat):
    """Both changes, where they are known."""
    if beat["change"] is None:
        return ""
    shear = beat.get("shear change")
    return (f"change {100 * beat['change']:.2g} % of the pulse"
            + ("" if shear is None else f" and {100 * shear:.2g} % of the wall shear stress"))


def make(folder, options, programs):
    table, wall, tuned = read_json(folder.file(lumen.TABLE)), walls.read(folder), tune.read(folder)
    goal, record = goal_in(tuned), begin(folder, tuned)
    problem = tune.problem_of(table, wall, options, tune.read_inflow(folder, tuned["period"]), tuned["period"])
    problem.distal_pressures = {name: w.distal_pressure for name, w in windkessels_in_case(folder, tuned)[0].items()}
    while not (record["beats"] and is_done(record["beats"][-1], goal, options)) and len(record["beats"]) < options.beats:
        beat = run_beat(folder, options, programs, tuned, record)
        as_run = dict(beat, windkessels=from_dicts(beat["windkessels"]))
        is_first = not record["beats"] and not options.start_from
        start = correction.Start(tuned["goal"]["diastolic"], rising(len(problem.inflow))) if is_first else None
        # A first beat that starts from another mesh is off by what the time scheme and the other mesh leave, too.
        permitted = options.tolerance * (1.0 if options.start_from and not record["beats"] else 0.5)
        chosen = correction.choose(problem, goal, tuned["proximal share"], as_run, permitted, start)
        record["beats"].append(beat)
        record["next"] = {"windkessels": as_dicts(chosen.windkessels), "circuits": chosen.circuits}
        beat["expected"], beat["corrected"] = chosen.expected, chosen.is_changed
        write_json(folder.file(TABLE), record)
        print("  " + line_of(len(record["beats"]), beat, goal), flush=True)
    write_tuned(folder, record["beats"][-1])
    return [verdict(record["beats"], goal, options)]


def line_of(number, beat, goal):
    m = beat["measured"]
    worst = max(abs(m["splits"][name] - split) for name, split in goal.splits.items())
    change = "" if beat["change"] is None else ", " + change_text(beat)
    return (f"beat {number}: {mmhg(m['systolic']):.1f}/{mmhg(m['diastolic']):.1f} mmHg (goal {mmhg(goal.systolic):.1f}/"
            f"{mmhg(goal.diastolic):.1f}), shares within {100 * worst:.1f} %{change}")


def verdict(done, goal, options):
    last = done[-1]
    if is_done(last, goal, options):
        return (f"after {len(done)} beats the beat repeats itself ({change_text(last)}) and has the pressures and shares asked for")
    worst = correction.errors(goal, last["measured"])
    where = max(worst, key=lambda name: abs(worst[name]))
    change = "there is one beat only"
    if last["change"] is not None:
        change = "the last beat: " + change_text(last)
    count = "1 beat" if len(done) == 1 else f"{len(done)} beats"
    return (f"not reached in {count}: {where} is off by {100 * worst[where]:.1f} %, {change} "
            f"(goals: {100 * options.tolerance:g} % and {100 * PERIODIC:g} %). --beats {len(done) + 4} goes on")


def is_converged(folder, options):
    tuned, record = tune.read(folder), read_json(folder.file(TABLE))
    return bool(record["beats"]) and is_done(record["beats"][-1], goal_in(tuned), options)


def write_tuned(folder, beat):
    """The case with the Windkessels of the last beat, which begins with the pressures that they store at its end."""
    builder = ElementTree.TreeBuilder(insert_comments=True)
    root = ElementTree.parse(folder.file(case_file.CASE), ElementTree.XMLParser(target=builder)).getroot()
    for name, w in beat["windkessels"].items():
        values = {key: w[field] for field, key in KEYS.items()}
        values["initial pressure"] = beat["measured"]["circuits end"][name]
        surface = root.find(SURFACE.format(name))
        for key, value in values.items():
            surface.find(f"./Parameter[@name='{key}']").set("value", repr(value))
    head = "<!-- case.xml with the Windkessels and the stored pressures of the last beat of tunica-vessel. -->\n"
    write_atomically(folder.file(TUNED), head + ElementTree.tostring(root, encoding="unicode") + "\n")
