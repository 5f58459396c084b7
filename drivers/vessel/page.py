"""Stage report: summary.md and report.html in the units of the clinic, beside the report of the last run by tunica-report."""
import html
import os
import re

from . import beat_figures, beats, case_file, correction, lumen, run, tune, walls
from .errors import BadInput
from .folder import read_json, write_atomically
from .mesh_file import Mesh, elements_across
from .units import L_PER_MIN, MMHG_S_PER_ML, ML_PER_MMHG, mmhg

SUMMARY, PAGE = "summary.md", "report.html"
READS = (run.TABLE, tune.TABLE, walls.TABLE, lumen.TABLE, case_file.CASE)
RESULTS = (SUMMARY, PAGE)
FEW_ACROSS = 10  # elements across an opening


def table_of(heading, rows):
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    return lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows] + [""]


def pressures(tuned, beat, goal):
    rows = []
    aim = (f"{mmhg(goal.systolic):.0f}/{mmhg(goal.diastolic):.0f}, pulse {mmhg(goal.systolic - goal.diastolic):.0f}")
    for name, (high, low) in beat["measured"]["pressures"].items():
        is_inlet = name == tuned["inlet"]
        rows.append([name + (" (in)" if is_inlet else ""), f"{mmhg(high):.1f}", f"{mmhg(low):.1f}", f"{mmhg(high - low):.1f}",
                     aim if is_inlet else ""])
    return table_of(["pressure, mmHg", "systole", "diastole", "pulse", "goal"], rows)


def flows(tuned, beat, goal):
    rows = []
    for name, split in goal.splits.items():
        flow, share = beat["measured"]["mean flows"][name], beat["measured"]["splits"][name]
        rows.append([name, f"{flow:.3g}", f"{flow / L_PER_MIN:.3g}", f"{100 * share:.1f} %", f"{100 * split:.1f} %"])
    rows.append([tuned["inlet"] + " (in)", f"{tuned['mean flow']:.3g}", f"{tuned['mean flow'] / L_PER_MIN:.3g}", "", ""])
    return table_of(["mean flow", "ml/s", "l/min", "share", "goal"], rows)


def windkessels(tuned, beat):
    rows = []
    for name, w in beat["windkessels"].items():
        first = tuned["outlets"][name]
        resistance = (w["proximal"] + w["distal"]) / (first["proximal resistance"] + first["distal resistance"])
        rows.append([name, f"{w['proximal'] / MMHG_S_PER_ML:.4g}", f"{w['distal'] / MMHG_S_PER_ML:.4g}",
                     f"{w['capacitance'] / ML_PER_MMHG:.4g}", f"{w['distal'] * w['capacitance'] / 1000:.2g}",
                     f"{100 * (resistance - 1):+.1f} %", f"{100 * (w['capacitance'] / first['capacitance'] - 1):+.1f} %"])
    return table_of(["Windkessel", "proximal, mmHg s/ml", "distal, mmHg s/ml", "capacitance, ml/mmHg", "time constant, s",
                     "resistance since the network", "capacitance since the network"], rows)


def beats_table(done, goal, minutes):
    rows = []
    for number, beat in enumerate(done, 1):
        m = beat["measured"]
        worst = max(abs(share - goal.splits[name]) for name, share in m["splits"].items())
        rows.append([number, f"{mmhg(m['systolic']):.1f}", f"{mmhg(m['diastolic']):.1f}", f"{100 * worst:.1f} %",
                     "" if beat["change"] is None else f"{100 * beat['change']:.2g} %", "yes" if beat["corrected"] else "no",
                     f"{minutes[number - 1]:.3g}"])
    return table_of(["beat", "systole, mmHg", "diastole, mmHg", "worst share", "change since the beat before, of the pulse",
                     "Windkessels corrected after it", "minutes"], rows)


def meshes(folder, table):
    mesh = Mesh(folder.file(lumen.MESH))
    rows = [[o["name"], f"{o['radius']:.2f}", f"{o['area']:.1f}", f"{elements_across(mesh, o):.0f}"]
            for o in table["openings"]]
    return table_of(["opening", "radius, mm", "area, mm²", "elements across"], rows), rows


def assumptions(options, tuned, wall):
    """What nobody has said, and was assumed."""
    found = [f"Inflow: {tuned['inflow']}.", f"Wall: {options.wall}, {wall['thickness']:g} of the local radius thick; "
             f"tissue around it of {wall['tissue']:g} kPa/mm.",
             f"The surface shows the vessel at the end of diastole, at {mmhg(tuned['goal']['diastolic']):.0f} mmHg.",
             f"The pressures of the goal are those at {tuned['inlet']}.",
             "Blood is Newtonian, 3.5 mPa s, 1.06 g/ml.", "The pressure behind the outlets: " + ", ".join(
                 f"{name} {mmhg(outlet['distal pressure']):.3g} mmHg" for name, outlet in tuned["outlets"].items()) + "."]
    given = options.given_splits
    free = [name for name in tuned["outlets"] if name not in given]
    if free and len(tuned["outlets"]) > 1:
        found.append(f"Shares of the flow by Murray's law, the cube of the radius: {', '.join(free)}.")
    return found


def doubts(options, tuned, wall, across, done):
    """Choices that a reader should look at."""
    found = []
    coarse = [row[0] for row in across if float(row[3]) < FEW_ACROSS]
    if coarse:
        found.append(f"Fewer than {FEW_ACROSS} elements across {', '.join(coarse)}: do not rely on the wall shear stress there.")
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


def text_of(folder, options):
    table, wall, tuned = read_json(folder.file(lumen.TABLE)), walls.read(folder), tune.read(folder)
    done, goal = read_json(folder.file(run.TABLE))["beats"], run.goal_in(tuned)
    last = done[-1]
    mesh_lines, across = meshes(folder, table)
    worst = max(map(abs, correction.errors(goal, last["measured"]).values()))
    verdict = run.verdict(done, goal, options)
    lines = [f"# {os.path.basename(os.path.abspath(folder.path))}", "", verdict[0].upper() + verdict[1:] + ".", "",
             f"Largest distance from a goal: {100 * worst:.1f} %. Figures: [pressures](pressures.png), [flows](flows.png)"
             + (", [mesh](lumen.png)" if os.path.exists(folder.file("lumen.png")) else "") + "; fields and stress: "
             "[results/report/index.html](results/report/index.html).", "", "## Pressures", ""]
    lines += pressures(tuned, last, goal) + ["## Flows", ""] + flows(tuned, last, goal)
    lines += ["## Windkessels", ""] + windkessels(tuned, last)
    lines += ["## Beats", "", f"A beat repeats itself when no pressure changes by {100 * run.PERIODIC:g} % of the pulse, "
              f"after the first {100 * beats.SETTLING:g} % of the beat, in which a correction is still felt.", ""]
    minutes = beats.minutes(beats.read_steps(folder.file(run.RESULTS_FOLDER, "steps.csv")), len(done), tuned["period"])
    lines += beats_table(done, goal, minutes) + ["## Mesh", ""]
    lines += [f"{wall['mesh']['tetrahedra']} tetrahedra, about {wall['mesh']['unknowns']} unknowns.", ""]
    lines += mesh_lines + ["## Assumed", ""] + ["- " + text for text in assumptions(options, tuned, wall)]
    lines += ["", "## Doubtful", ""] + ["- " + text for text in doubts(options, tuned, wall, across, done) or ["Nothing."]]
    return "\n".join(lines) + "\n"


def html_of(text):
    """The few forms that text_of() uses, as HTML."""
    body, in_table = [], False
    for line in text.split("\n"):
        line = re.sub(r"\[([^\]]+)\]\(([^)]+)\)", r'<a href="\2">\1</a>', html.escape(line, quote=False))
        if in_table and not line.startswith("|"):
            body.append("</table>")
            in_table = False
        if line.startswith("|---"):
            continue
        if line.startswith("|"):
            cell = "td" if in_table else "th"
            body += [] if in_table else ["<table>"]
            in_table = True
            body.append("<tr>" + "".join(f"<{cell}>{word.strip()}</{cell}>" for word in line.strip("|").split("|")) + "</tr>")
        elif line.startswith("#"):
            level = len(line) - len(line.lstrip("#"))
            body.append(f"<h{level}>{line.lstrip('# ')}</h{level}>")
        elif line.startswith("- "):
            body.append(f"<p>• {line[2:]}</p>")
        elif line:
            body.append(f"<p>{line}</p>")
        if line == "## Flows":
            body.append('<img src="pressures.png" alt="pressures"><img src="flows.png" alt="flows">')
    return ('<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>tunica-vessel</title><style>'
            "body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em}table{border-collapse:collapse}"
            "td,th{border:1px solid #bbb;padding:.25em .6em;text-align:right}td:first-child,th:first-child{text-align:left}"
            "img{max-width:49%}</style>\n" + "\n".join(body) + "</html>\n")


def make(folder, options, programs):
    record = read_json(folder.file(run.TABLE))
    if not record["beats"]:
        raise BadInput(f"{folder.file(run.TABLE)}: no beat is complete; there is nothing to report")
    tuned = tune.read(folder)
    beat_figures.draw(folder, tuned, record["beats"])
    lines = []
    status = programs.run(["tunica-report", folder.file(run.RESULTS_FOLDER)], folder.file(lumen.LOG))
    if status != 0:  # the numbers remain
        lines.append(f"warning: tunica-report ended with status {status}, see {folder.file(lumen.LOG)}")
    text = text_of(folder, options)
    write_atomically(folder.file(SUMMARY), text)
    write_atomically(folder.file(PAGE), html_of(text))
    return lines + [f"report: {folder.file(PAGE)}, {folder.file(SUMMARY)}"]
