"""What a beat in three dimensions was like, from steps.csv."""
import csv
import dataclasses

import h5py
import numpy as np

from .errors import BadInput

SETTLING, REMEMBERED = 0.05, 2  # part of a beat, and steps of the time scheme, in which a correction at its beginning is still felt


@dataclasses.dataclass
class Curves:
    """Over one beat: times from its beginning [ms], steps, pressure by opening [kPa], flow out by outlet [ml/s], p_c by outlet."""
    time: np.ndarray
    step: np.ndarray
    pressure: dict
    flow: dict
    stored: dict


def read_steps(path):
    """Columns of numbers; an incomplete last row is dropped."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None
    heading = rows[0]
    rows = [row for row in rows[1:] if len(row) == len(heading)]
    wanted = [k for k, name in enumerate(heading) if name in ("step", "time", "step_size", "seconds")
              or name.startswith(("mean_pressure_", "pressure_", "stored_pressure_", "inflow_"))]
    return {heading[k]: np.array([float(row[k]) for row in rows]) for k in wanted}


def rows_of(table, number, period):
    """Which rows belong to the beat of this number, counted from 1."""
    small = 1e-6 * period
    return (table["time"] > (number - 1) * period + small) & (table["time"] < number * period + small)


def minutes(table, count, period):
    """What the steps of each of the first beats took."""
    return [float(table["seconds"][rows_of(table, number, period)].sum() / 60.0) for number in range(1, count + 1)]


def curves_of(table, number, period, inlet, outlets):
    """The beat of this number, counted from 1."""
    chosen = rows_of(table, number, period)
    pressure = {inlet: table[f"mean_pressure_{inlet}_kPa"][chosen]}
    pressure.update({name: table[f"pressure_{name}_kPa"][chosen] for name in outlets})
    return Curves(table["time"][chosen] - (number - 1) * period, table["step_size"][chosen], pressure,
                  {name: -table[f"inflow_{name}_mm3_per_ms"][chosen] for name in outlets},
                  {name: table[f"stored_pressure_{name}_kPa"][chosen] for name in outlets})


def mean_flows(curves):
    whole = curves.step.sum()
    return {name: float((flow * curves.step).sum() / whole) for name, flow in curves.flow.items()}


def measure(curves, inlet):
    """Numbers of a beat for beats.json."""
    flows = mean_flows(curves)
    total = sum(flows.values())
    p = curves.pressure[inlet]
    return {"systolic": float(p.max()), "diastolic": float(p.min()),
            "splits": {name: flow / total for name, flow in flows.items()},
            "circuits end": {name: float(values[-1]) for name, values in curves.stored.items()},
            "pressures": {name: [float(values.max()), float(values.min())] for name, values in curves.pressure.items()},
            "mean flows": flows}


def settled_at(period, steps):
    """From the beginning of a beat [ms]: the beat before may have begun with corrected Windkessels, whose pressures jump once."""
    return max(SETTLING * period, REMEMBERED * float(np.max(steps))) * (1 + 1e-6)


def change(curves, before, inlet):
    """Largest change of a pressure since the beat before, as a part of the pulse at the inlet, once settled."""
    if before is None:
        return None
    pulse = np.ptp(curves.pressure[inlet])
    late = curves.time > settled_at(curves.time[-1], curves.step)
    return float(max(np.abs(np.interp(curves.time, before.time, before.pressure[name]) - values)[late].max()
                     for name, values in curves.pressure.items()) / pulse)


def shear_at(path, steps):
    """Wall shear stress [kPa] on the nodes of the fluid at those of these steps that have fields."""
    with h5py.File(path) as file:
        names = {step: f"step_{step:06d}/fluid/wall_shear_stress" for step in steps}
        return {step: file[name][:] for step, name in names.items() if name in file}


def shear_change(path, table, number, period):
    """As change(), of the wall shear stress: its root mean square over the wall, as a part of the largest one in the beat. None
    where there are no fields at the same times of both beats."""
    time = {int(step): at for step, at in zip(table["step"], table["time"]) if at > (number - 2) * period}  # both beats
    late = (number - 1) * period + settled_at(period, table["step_size"][rows_of(table, number, period)])
    try:
        fields = {time[step]: values for step, values in shear_at(path, time).items()}
    except (OSError, KeyError):
        return None
    end = number * period * (1 + 1e-6)
    largest = max((np.linalg.norm(values) for at, values in fields.items() if end - period < at < end), default=0.0)
    changes = [np.linalg.norm(values - before) for at, values in fields.items() if late < at < end
               for earlier, before in fields.items() if abs(at - period - earlier) < 1e-6 * period]
    return float(max(changes) / largest) if changes and largest > 0.0 else None
