"""Tables about the case: its parameters, and whether a load with a period has made the run periodic."""
import json
import os
import re
import xml.etree.ElementTree as xml

import numpy as np

# Foreign lists of solvers, and what only says where things are.
NOT_SHOWN = {"Linear Solver", "Output", "Probes", "Solvers"}
FLOW = re.compile(r"inflow_(.+)_mm3_per_ms$")
PERIODIC = re.compile(r"(inflow_.+|mean_pressure_.+)")


def _last_parameters(folder):
    """Name of the file with the parameters that the run used last, as run.json tells."""
    try:
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
            return [json.load(file)["history"][-1]["parameters"]]
    except (OSError, ValueError, LookupError, TypeError):
        return []


def read_case(folder):
    """The root of the parameters that were used last, None where there are none to be read."""
    for name in _last_parameters(folder) + ["case-used.xml", "case.xml"]:
        try:
            return xml.parse(os.path.join(folder, name)).getroot()
        except (OSError, xml.ParseError):
            continue
    return None


def _readable(value):
    words = value.strip()
    return words if len(words) < 90 else words[:80] + " …"


def parameters(case):
    """(heading, rows of name and value) for each list of the case with parameters of its own."""
    found = []

    def walk(node, path):
        rows = [(p.get("name"), _readable(p.get("value", ""))) for p in node.findall("Parameter") if p.get("value")]
        if rows and path:
            found.append((" / ".join(path), rows))
        for child in node.findall("ParameterList"):
            if child.get("name") not in NOT_SHOWN:
                walk(child, path + [child.get("name")])

    if case is not None:
        walk(case, [])
    return found


def _number(parameter):
    """None where there is none."""
    try:
        return float(parameter.get("value"))
    except (AttributeError, TypeError, ValueError):
        return None


def averages_from(case):
    """The time from which wall shear stress is averaged [ms]."""
    output = case.find("ParameterList[@name='Output']") if case is not None else None
    key = output.find("Parameter[@name='averages from']") if output is not None else None
    return _number(key) or 0.0


def period(case):
    """The longest period of an amplitude [ms], None without one."""
    found = []
    for node in case.iter("ParameterList") if case is not None else ():
        for parameter in node.findall("Parameter"):
            if node.get("name") == "Amplitude" and parameter.get("name") == "period":
                found.append(_number(parameter) or 0.0)
    return max((p for p in found if p > 0), default=None)


def integral(values, times):
    """By the trapezoidal rule."""
    return np.sum(np.diff(times) * (values[1:] + values[:-1]) / 2)


def openings(steps, length):
    """Over the last cycle, or the whole run where length is None or longer: when it begins, and rows of name, mean flow
    into the fluid [mm^3/ms], its share of all that leaves (NaN where it enters), mean, least and greatest pressure
    [kPa]. None where no flow is known."""
    times = np.array(steps.get("time", []), dtype=float)
    flows = {m.group(1): np.array(steps[c], dtype=float) for c in steps
             if (m := FLOW.match(c)) and all(isinstance(v, float) for v in steps[c])}
    if len(times) < 2 or not flows:
        return None
    kept = times >= times[-1] - (length or np.inf) * (1 + 1e-9)
    if kept.sum() < 2:
        return None
    mean = lambda values: integral(values[kept], times[kept]) / np.ptp(times[kept])  # noqa: E731
    means = {name: mean(values) for name, values in flows.items()}
    leaves = -sum(flow for flow in means.values() if flow < 0)
    rows = []
    for name, flow in means.items():
        row = [name.replace("_", " "), flow, -flow / leaves if flow < 0 else float("nan")]
        pressure = steps.get(f"mean_pressure_{name}_kPa")
        if pressure is not None and all(isinstance(v, float) for v in pressure):
            pressure = np.array(pressure)
            row += [mean(pressure), pressure[kept].min(), pressure[kept].max()]
        rows.append(row)
    return times[kept][0], rows


def l2_norm(values, times):
    return np.sqrt(integral(np.square(values), times))


def changes_per_cycle(steps, length):
    """(column, relative L2 difference of the last cycle and the one before) for flows and mean pressures. None where
    there are no two cycles. At rest no step has ended: a cycle that begins there lacks its first one."""
    times = np.array(steps.get("time", []), dtype=float)
    if len(times) < 4 or times[-1] + 1e-9 * length < 2 * length:
        return None
    last = times[times >= times[-1] - length * (1 + 1e-9)]
    last = last[last - length >= times[0] - 1e-9 * length]
    rows = []
    for column, values in steps.items():
        if not PERIODIC.match(column) or not all(isinstance(v, float) for v in values):
            continue
        now, before = np.interp(last, times, values), np.interp(last - length, times, values)
        norm, change = l2_norm(now, last), l2_norm(now - before, last)
        rows.append((column, change / norm if norm > 0 else float("nan")))
    return rows
