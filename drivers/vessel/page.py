"""Stage report: tells tunica-report what this program knows of the case, in a file beside the run, and calls it."""
import os
import shutil

from . import beats, case_file, correction, lumen, run, tune, walls
from .errors import BadInput
from .folder import read_json, write_json
from .units import mmhg

TOLD, PICTURE = "vessel.json", "lumen.png"
READS = (run.TABLE, tune.TABLE, walls.TABLE, lumen.TABLE, case_file.CASE)
RESULTS = tuple(os.path.join(run.RESULTS_FOLDER, "report", name) for name in ("index.html", "summary.md"))


def beats_table(done, goal, minutes):
    rows, part = [], lambda value: "" if value is None else f"{100 * value:.2g} %"
    for number, beat in enumerate(done, 1):
        m = beat["measured"]
        worst = max(abs(share - goal.splits[name]) for name, share in m["splits"].items())
        rows.append([number, f"{mmhg(m['systolic']):.1f}", f"{mmhg(m['diastolic']):.1f}", f"{100 * worst:.1f} %",
                     part(beat["change"]), part(beat.get("shear change")), "yes" if beat["corrected"] else "no",
                     f"{minutes[number - 1]:.3g}"])
    return {"note": f"A beat repeats itself when no pressure changes by {100 * run.PERIODIC:g} % of the pulse, nor the wall shear stress "
                    f"by as much of its largest one, after the first {100 * beats.SETTLING:g} % of the beat and {beats.REMEMBERED} steps, "
                    "in which a correction is still felt.",
            "heading": ["beat", "systole, mmHg", "diastole, mmHg", "worst share", "change since the beat before, of the pulse",
                        "of the wall shear stress", "Windkessels corrected after it", "minutes"], "rows": rows}


def assumptions(options, tuned, wall):
    """What nobody has said, and was assumed; tunica-report adds what the case says."""
    found = [f"Inflow: {tuned['inflow']}.", f"Wall: {options.wall}, {wall['thickness']:g} of the local radius thick.",
             "The surface shows the vessel at the end of diastole.", f"The pressures of the goal are those at {tuned['inlet']}.",
             "The pressure behind the outlets: " + ", ".join(
                 f"{name} {mmhg(outlet['distal pressure']):.3g} mmHg" for name, outlet in tuned["outlets"].items()) + "."]
    given = options.given_splits
    free = [name for name in tuned["outlets"] if name not in given]
    if free and len(tuned["outlets"]) > 1:
        found.append(f"Shares of the flow by Murray's law, the cube of the radius: {', '.join(free)}.")
    return found


def doubts(options, tuned, wall, done):
    """Choices that a reader should look at; tunica-report adds what it finds in the mesh."""
    found = []
    capped = [name for name, o in tuned["outlets"].items() if o["proximal resistance"] < 0.999 * o["characteristic impedance"]]
    if capped:
        found.append(f"The proximal resistance of {', '.join(capped)} is below the characteristic impedance, so that waves are "
                     "reflected there. With all of it the pulse would be beyond the goal, or the share of the whole resistance "
                     f"beyond {100 * options.proximal:g} %.")
    if options.wall not in walls.PRESETS:
        found.append("The wall is that of a file; nothing compares it with measured stiffness.")
    elif tuned["goal"]["diastolic"] < 0.75 * 10.67 or tuned["goal"]["diastolic"] > 1.25 * 10.67:
        found.append("The stiffness of the wall is that at 80 mmHg, the diastolic pressure is another.")
    first = done[0]["measured"]
    if abs(first["systolic"] / tuned["goal"]["systolic"] - 1) > 0.15:
        found.append("The first beat missed the pressures of the network by more than 15 %: the vessel has losses that "
                     "Poiseuille's law lacks.")
    if len(tuned["outlets"]) > 1 and not options.splits:
        found.append("Murray's law is a rule of thumb; measured shares (--splits) are better.")
    return found + wall["warnings"]


def told_of(folder, options, done):
    """What the report shows beside the numbers of the run."""
    wall, tuned = walls.read(folder), tune.read(folder)
    goal = run.goal_in(tuned)
    verdict, worst = run.verdict(done, goal, options), max(map(abs, correction.errors(goal, done[-1]["measured"]).values()))
    minutes = beats.minutes(beats.read_steps(folder.file(run.RESULTS_FOLDER, "steps.csv")), len(done), tuned["period"])
    return {"verdict": f"{verdict[0].upper()}{verdict[1:]}. Largest distance from a goal: {100 * worst:.1f} %.",
            "period": tuned["period"], "goal": tuned["goal"], "splits": goal.splits, "network": run.as_dicts(tuned["windkessels"]),
            "beats": beats_table(done, goal, minutes), "assumed": assumptions(options, tuned, wall),
            "doubtful": doubts(options, tuned, wall, done)}


def make(folder, options, programs):
    record = read_json(folder.file(run.TABLE))
    if not record["beats"]:
        raise BadInput(f"{folder.file(run.TABLE)}: no beat is complete; there is nothing to report")
    results = folder.file(run.RESULTS_FOLDER)
    write_json(os.path.join(results, TOLD), told_of(folder, options, record["beats"]))
    if os.path.exists(folder.file(PICTURE)):
        shutil.copyfile(folder.file(PICTURE), os.path.join(results, PICTURE))
    programs.must(["tunica-report", results, *(["--pdf"] if options.pdf else [])], folder.file(lumen.LOG))
    if not os.path.exists(folder.file(RESULTS[1])):
        raise BadInput(f"{folder.file(RESULTS[0])} has no tables of the beat; it says why")
    return [f"report: {folder.file(RESULTS[0])}, {folder.file(RESULTS[1])}"]
