"""How the Windkessels and their pressures are corrected between two beats, by the network.

The map of the stored pressures from the beginning of a beat to its end is c -> Phi c + g. Phi is that of the network, g is
seen in the beat; the beat repeats itself from c* = (1 - Phi)^-1 (c_end - Phi c_begin) on. What the beat's pressures and
shares would be from c* on, less those of the network, is what the network lacks: it is tuned anew for goals that are lower
by that much.
"""
import dataclasses

import numpy as np

from . import tuning
from .errors import NotConverged
from .network import beat_of

LEAST_PULSE = 0.2  # of a shifted goal, of the pulse
LARGEST_JUMP = 0.5  # of the stored pressures between two beats, of the pulse


@dataclasses.dataclass
class Next:
    """With what the next beat runs, and what this one would be if it repeated itself."""
    windkessels: dict
    circuits: dict
    expected: dict
    is_changed: bool


@dataclasses.dataclass
class Start:
    """How the first beat begins: the pressure in the vessel at rest [kPa], and the part of the inflow at each of its times."""
    pressure: float
    part: np.ndarray


def of_start(network, x, problem, start):
    """Deviation over the beat that comes from the start, not from the stored pressures; none in later beats."""
    if start is None:
        return np.zeros((len(x) + 1, x.shape[1]))
    vessel, nodes = network.circuits().start, len(network.nodes)
    away = np.zeros(x.shape[1])
    away[:nodes] = start.pressure - x[0, :nodes]
    away[nodes:vessel] = -x[0, nodes:vessel]
    return network.transient(away, problem.period, problem.inflow * (start.part - 1.0))


def settled(network, period, begin, end, extra):
    """c* by outlet; extra: what the start has added to the end."""
    at = network.circuits()
    c0, c1 = (np.array([values[name] for name in network.outlets]) for values in (begin, end))
    c1 = c1 - extra
    moved = np.array([network.monodromy(period) @ network.settle(unit) for unit in np.eye(len(c0))])[:, at].T
    return dict(zip(network.outlets, np.linalg.solve(np.eye(len(c0)) - moved, c1 - moved @ c0).tolist()))


def of_repeated(network, x, measured, away):
    """The measured pressures and shares less what this deviation from the repeated beat has made of them, by the network."""
    plain, moved = beat_of(network, x), beat_of(network, x + away[:-1])
    return {"systolic": measured["systolic"] - (moved.systolic - plain.systolic),
            "diastolic": measured["diastolic"] - (moved.diastolic - plain.diastolic),
            "splits": {name: share - (moved.splits[name] - plain.splits[name]) for name, share in measured["splits"].items()}}


def errors(goal, beat):
    """Relative errors by what they are of."""
    found = {"systolic": beat["systolic"] / goal.systolic - 1, "diastolic": beat["diastolic"] / goal.diastolic - 1}
    found.update({name: beat["splits"][name] / split - 1 for name, split in goal.splits.items()})
    return found


def shifted(goal, expected, plain):
    """The goal for the network: less what it lacks."""
    splits = {name: max(0.2 * split, split - (expected["splits"][name] - plain.splits[name]))
              for name, split in goal.splits.items()}
    whole = sum(splits.values())
    diastolic = goal.diastolic - (expected["diastolic"] - plain.diastolic)
    systolic = goal.systolic - (expected["systolic"] - plain.systolic)
    pulse = max(systolic - diastolic, LEAST_PULSE * (goal.systolic - goal.diastolic))
    return tuning.Goal(diastolic + pulse, diastolic, {name: split / whole for name, split in splits.items()})


def retuned(problem, goal, share):
    """Windkessels for the goal, with less proximal resistance where it is out of reach; None where that does not help."""
    for each in (share, None):
        try:
            return tuning.tune(problem, goal, each)[0]
        except NotConverged:
            continue
    return None


def choose(problem, goal, share, beat, permitted, start=None):
    """beat: an entry of beats.json. The Windkessels remain where the beat, repeated, would be within the permitted errors."""
    windkessels, begin, measured = beat["windkessels"], beat["circuits begin"], beat["measured"]
    network, x = tuning.solve(problem, windkessels)
    extra = of_start(network, x, problem, start)
    fixed = settled(network, problem.period, begin, measured["circuits end"], extra[-1, network.circuits()])
    away = network.deviation([begin[name] - fixed[name] for name in network.outlets], problem.period, len(x))
    expected = of_repeated(network, x, measured, away + extra)
    plain = beat_of(network, x)
    is_changed = max(map(abs, errors(goal, expected).values())) > permitted
    lacks = {name: fixed[name] - plain.circuits[name] for name in network.outlets}
    if is_changed:
        found = retuned(problem, shifted(goal, expected, plain), share)
        is_changed, windkessels = found is not None, found or windkessels
        plain = beat_of(*tuning.solve(problem, windkessels))
    largest = LARGEST_JUMP * (goal.systolic - goal.diastolic)
    circuits = {name: measured["circuits end"][name] + float(np.clip(
        plain.circuits[name] + lacks[name] - measured["circuits end"][name], -largest, largest)) for name in network.outlets}
    return Next(windkessels, circuits, expected, is_changed)
