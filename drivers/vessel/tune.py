"""Stage tune: inflow, goals and Windkessels, by the network of the vessel."""
import os

import numpy as np

from . import flow_shapes, lumen, tuning, vessel_model, walls
from .errors import BadInput, nearest
from .folder import read_json, write_atomically, write_json
from .network import Windkessel, beat_of
from .units import L_PER_MIN, MMHG, MMHG_S_PER_ML, ML_PER_MMHG, mmhg

TABLE, INFLOW = "windkessels.json", "inflow.txt"
BEATS = "beats.json"  # of the stage run, where --start-from begins
READS = (lumen.TABLE, walls.TABLE)
RESULTS = (TABLE, INFLOW)
WITHIN = 0.02  # what the network has to reach


def inlet_of(table, options):
    return options.inlet or table["openings"][0]["name"]


def goal_of(table, options):
    """Pressures in kPa, and the share of each outlet."""
    inlet = inlet_of(table, options)
    outlets = [opening["name"] for opening in table["openings"] if opening["name"] != inlet]
    for name in options.given_splits:
        if name not in outlets:
            raise BadInput(f"--splits: {name} is no outlet. {nearest(name, outlets)}")
    whole = sum(options.given_splits.values())
    if len(options.given_splits) == len(outlets) and abs(whole - 1) > 1e-6:
        raise BadInput(f"--splits: the shares of all outlets add up to {whole:g}, expected 1")
    if len(options.given_splits) < len(outlets) and whole > 1 - 1e-6:
        raise BadInput(f"--splits: the shares add up to {whole:g}; nothing is left for the other outlets")
    systolic, diastolic = options.goal
    return tuning.Goal(systolic * MMHG, diastolic * MMHG, tuning.murray(table["openings"], inlet, options.given_splits))


def problem_of(table, wall, options, inflow, period):
    """The network's problem; the compliance is that at diastolic pressure, with which the wall was imaged."""
    inlet, pressure = inlet_of(table, options), options.goal[1] * MMHG
    impedances = {o["name"]: vessel_model.impedance(o, wall, pressure) for o in table["openings"] if o["name"] != inlet}
    return tuning.Problem(vessel_model.build(table, wall, pressure), inlet, impedances, inflow, period, options.proximal)


def read_inflow(folder, period):
    """Samples [ml/s] over a beat of inflow.txt, which may have been edited."""
    rows, _ = flow_shapes.read_rows(folder.file(INFLOW))
    t, y = np.array(rows).reshape(-1, 2).T
    if len(t) < 5 or (np.diff(t) <= 0).any() or t[-1] - t[0] >= period:
        raise BadInput(f"{folder.file(INFLOW)}: expected five rows or more, with times that grow, within a beat of {period:g} ms")
    return flow_shapes.periodic_spline(t, y, period, np.arange(flow_shapes.SAMPLES) * period / flow_shapes.SAMPLES)


def inflow_text(samples, period, told):
    lines = [f"# ms  ml/s: {told}; from the end of diastole on, repeated every {period:g} ms"]
    lines += [f"{k * period / len(samples):.6g} {value:.8g}" for k, value in enumerate(samples)]
    return "\n".join(lines) + "\n"


def started_from(path, names, period):
    """Windkessels at the end of the beats of another folder, the pressures stored in them, and their proximal share."""
    table, beats = (read_json(os.path.join(path, name)) for name in (TABLE, BEATS))
    if not beats.get("beats"):
        raise BadInput(f"--start-from: {os.path.join(path, BEATS)} has no beats")
    last = beats["beats"][-1]
    if sorted(last["windkessels"]) != sorted(names) or abs(table["period"] - period) > 1e-6 * period:
        raise BadInput(f"--start-from: {path} has the outlets {', '.join(last['windkessels'])} and a beat of {table['period']:g} ms, "
                       f"here there are {', '.join(names)} and {period:g} ms")
    return ({name: Windkessel(**entry) for name, entry in last["windkessels"].items()}, last["measured"]["circuits end"],
            table["proximal share"])


def make(folder, options, _programs):
    table, wall = read_json(folder.file(lumen.TABLE)), walls.read(folder)
    samples, period, told = flow_shapes.inflow(options, wall)
    goal = goal_of(table, options)
    problem = problem_of(table, wall, options, samples, period)
    if options.start_from:
        windkessels, circuits, share = started_from(options.start_from, list(goal.splits), period)
        beat = beat_of(*tuning.solve(problem, windkessels))
        beat.circuits.update(circuits)
    else:
        windkessels, share = tuning.tune(problem, goal)
        beat = beat_of(*tuning.solve(problem, windkessels))
        check(beat, goal)
    write_atomically(folder.file(INFLOW), inflow_text(samples, period, told))
    write_json(folder.file(TABLE), {
        "units": "kPa, mm^3/ms (ml/s), ms", "inflow": told, "period": period, "mean flow": float(samples.mean()),
        "inlet": problem.inlet, "goal": {"systolic": goal.systolic, "diastolic": goal.diastolic},
        "proximal share": share, "network": summary(problem, beat),
        "outlets": {name: entry(goal, beat, problem, name, w) for name, w in windkessels.items()}})
    return report(problem, goal, beat, windkessels, told)


def entry(goal, beat, problem, name, w):
    return {"split": goal.splits[name], "proximal resistance": w.proximal, "capacitance": w.capacitance,
            "distal resistance": w.distal, "distal pressure": w.distal_pressure, "initial pressure": beat.circuits[name],
            "characteristic impedance": problem.impedances[name]}


def summary(problem, beat):
    return {"systolic": beat.systolic, "diastolic": beat.diastolic, "splits": beat.splits,
            "compliance of the vessel": sum(piece.compliance for piece in problem.pieces)}


def check(beat, goal):
    errors = [beat.systolic / goal.systolic - 1, beat.diastolic / goal.diastolic - 1]
    errors += [beat.splits[name] / split - 1 for name, split in goal.splits.items()]
    if max(abs(error) for error in errors) > WITHIN:
        raise RuntimeError(f"the network misses its goals by {max(errors):.3g} though it was tuned")


def report(problem, goal, beat, windkessels, told):
    lines = [f"inflow: {told}; {problem.inflow.mean() / L_PER_MIN:.3g} l/min, beat of {problem.period:.4g} ms",
             f"network: {mmhg(beat.systolic):.1f}/{mmhg(beat.diastolic):.1f} mmHg at {problem.inlet}, goal "
             f"{mmhg(goal.systolic):.1f}/{mmhg(goal.diastolic):.1f}"]
    for name, w in windkessels.items():
        lines.append(f"  {name}: {100 * beat.splits[name]:.1f} % of the flow (goal {100 * goal.splits[name]:.1f} %); "
                     f"{clinical(w)}")
    return lines


def clinical(w):
    return (f"R {w.proximal / MMHG_S_PER_ML:.3g} + {w.distal / MMHG_S_PER_ML:.3g} mmHg s/ml, "
            f"C {w.capacitance / ML_PER_MMHG:.3g} ml/mmHg")


def read(folder):
    """The table, with a Windkessel for each outlet under "windkessels"."""
    table = read_json(folder.file(TABLE))
    try:
        table["windkessels"] = {name: Windkessel(o["proximal resistance"], o["capacitance"], o["distal resistance"],
                                                 o["distal pressure"]) for name, o in table["outlets"].items()}
    except (KeyError, TypeError) as error:
        raise BadInput(f"{os.path.join(folder.path, TABLE)}: lacks the key {error}") from None
    return table
