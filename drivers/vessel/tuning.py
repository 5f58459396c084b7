"""Windkessels with which the network has given pressures and shares of the flow.

Unknown are the whole resistance of each outlet and one capacitance, which the outlets share like the flow, so that all
have the same time constant. Given are the systolic and the diastolic pressure at the inlet and the shares: as many.
The proximal resistance is the characteristic impedance rho c/A, behind which a wave is not reflected, but at most a share
of the whole resistance: with rho c/A alone the flow of systole may raise the pressure beyond the goal at once, whatever
the capacitance.
"""
import dataclasses

import numpy as np

from .errors import NotConverged
from .network import Network, Windkessel, beat_of
from .units import mmhg

TOLERANCE = 1e-6  # of pressures and shares
LEAST, MOST = 1e-3, 1e3  # of the capacitance, times period over whole resistance: none, and all that matters


@dataclasses.dataclass
class Goal:
    """Pressures in kPa; splits: outlet -> share of the mean flow."""
    systolic: float
    diastolic: float
    splits: dict


@dataclasses.dataclass
class Problem:
    """The vessel and its load: pieces, inlet, impedance by outlet, inflow over a beat [mm^3/ms], period [ms], and the pressure
    behind each outlet [kPa], zero where none is given."""
    pieces: list
    inlet: str
    impedances: dict
    inflow: np.ndarray
    period: float
    largest_proximal: float  # share of the whole resistance
    distal_pressures: dict = dataclasses.field(default_factory=dict)


def murray(openings, inlet, given):
    """Share of the flow by outlet: the given ones, and the cube of the radius for the rest."""
    outlets = [o for o in openings if o["name"] != inlet]
    free = [o for o in outlets if o["name"] not in given]
    cubes = sum(o["radius"] ** 3 for o in free)
    rest = 1.0 - sum(given.values())
    return {o["name"]: given[o["name"]] if o["name"] in given else rest * o["radius"] ** 3 / cubes for o in outlets}


def windkessels_of(problem, goal, logs, share):
    """From the logarithms of the whole resistances and of the capacitance of all outlets together."""
    found = {}
    for (name, split), log in zip(goal.splits.items(), logs):
        whole = float(np.exp(log))
        proximal = min(problem.impedances[name], share * whole)
        found[name] = Windkessel(proximal, float(np.exp(logs[-1])) * split, whole - proximal,
                                 problem.distal_pressures.get(name, 0.0))
    return found


def solve(problem, windkessels):
    network = Network(problem.pieces, problem.inlet, windkessels)
    return network, network.periodic(problem.inflow, problem.period)


def residual(problem, goal, logs, share):
    """Relative errors of both pressures, and of all shares but the first, which follows."""
    beat = beat_of(*solve(problem, windkessels_of(problem, goal, logs, share)))
    errors = [beat.systolic / goal.systolic - 1, beat.diastolic / goal.diastolic - 1]
    return np.array(errors + [beat.splits[name] / split - 1 for name, split in list(goal.splits.items())[1:]])


def guess(problem, goal):
    """Resistances from the mean pressure, a capacitance from the decay in diastole."""
    mean = goal.diastolic + 0.4 * (goal.systolic - goal.diastolic)
    mean -= min(0.9 * mean, max(problem.distal_pressures.values(), default=0.0))
    whole = mean / problem.inflow.mean()
    logs = [np.log(whole / split) for split in goal.splits.values()]
    return np.array(logs + [np.log(problem.period / (whole * np.log(goal.systolic / goal.diastolic)))])


def pulse_with(problem, goal, capacitance, share):
    """Pulse pressure with a capacitance in units of the guess, resistances as guessed."""
    logs = guess(problem, goal)
    mean = problem.inflow.mean()
    logs[-1] = np.log(capacitance * problem.period * mean / goal.systolic)
    beat = beat_of(*solve(problem, windkessels_of(problem, goal, logs, share)))
    return beat.systolic - beat.diastolic


def choose_share(problem, goal):
    """Largest share of the proximal resistance that leaves the pulse of the goal possible, and the pulses that are."""
    pulse, share = goal.systolic - goal.diastolic, problem.largest_proximal
    most = pulse_with(problem, goal, LEAST, share)
    if most < pulse:
        raise NotConverged(
            f"--pressure: a pulse of {mmhg(pulse):.0f} mmHg is out of reach, the largest is about {mmhg(most):.0f}: the vessel "
            "itself takes up that much blood. Is the flow too small, or the wall too soft? --flow, --wall, --thickness")
    for _ in range(12):
        least = pulse_with(problem, goal, MOST, share)
        if least < 0.85 * pulse:
            return share
        share *= 0.7
    least = pulse_with(problem, goal, MOST, 0.0)
    if least < 0.98 * pulse:
        return 0.0
    raise NotConverged(
        f"--pressure: a pulse of {mmhg(pulse):.0f} mmHg is out of reach, the least is about {mmhg(least):.0f}: to move the "
        "blood in the vessel takes that much. Is the flow too large, an opening far too small, or the surface not in mm? "
        "--flow, --pressure, --scale")


def jacobian(function, at, value):
    columns = []
    for k in range(len(at)):
        moved = at.copy()
        moved[k] += 1e-5
        columns.append((function(moved) - value) / 1e-5)
    return np.array(columns).T


def tune(problem, goal, share=None):
    """Windkessels for the goal, and the share of the proximal resistance. Newton's method, with steps of at most a factor e."""
    share = choose_share(problem, goal) if share is None else share
    logs = guess(problem, goal)

    def function(at):
        return residual(problem, goal, at, share)

    value = function(logs)
    for _ in range(100):
        if np.abs(value).max() < TOLERANCE:
            return windkessels_of(problem, goal, logs, share), share
        step = -np.linalg.solve(jacobian(function, logs, value), value)
        step *= min(1.0, 1.0 / np.abs(step).max())
        for _ in range(30):
            trial = function(logs + step)
            if np.linalg.norm(trial) < np.linalg.norm(value) or np.abs(step).max() < 1e-9:
                break
            step *= 0.5
        logs, value = logs + step, trial
    raise NotConverged(f"tune: the network misses the goals by {100 * np.abs(value).max():.1f} %. Is the pulse of --pressure "
                       "possible with this flow and this vessel?")
