"""Tables of a beat from steps.csv and the case, in the units of the clinic beside those of the case: pressures, flows,
Windkessels, waves, budgets of mass and energy. beat: beat.Beat; told: what tunica-vessel knows of the case, or {}."""
import numpy as np

from report import beat as beats
from report import case_tables
from report.tables import Table
from vessel.beats import settled_at
from vessel.units import L_PER_MIN, MMHG_S_PER_ML, ML_PER_MMHG, mmhg

MICROJOULES = 1000.0  # kPa mm^3 = 1 microjoule; tables are in millijoules
LISTED = ("proximal resistance", "distal resistance", "capacitance")


def share(part, sign=""):
    return "–" if part is None or not np.isfinite(part) else f"{round(100 * part, 1) + 0.0:{sign}.1f} %"  # no minus before a zero


def signed(part):
    return share(part, "+")


def pressures(beat, told):
    goal, rows = told.get("goal"), []
    at_inlet, aim, off = beat.pressures[beat.inlet], "", ""
    if goal:
        high, low = mmhg(goal["systolic"]), mmhg(goal["diastolic"])
        aim = f"{high:.0f}/{low:.0f}, pulse {high - low:.0f}"
        off = f"{signed(at_inlet.max() / goal['systolic'] - 1)}, {signed(at_inlet.min() / goal['diastolic'] - 1)}"
    for name in beat.openings():
        p = beat.pressures[name]
        if p is None:
            rows.append([name] + ["–"] * 9)
            continue
        is_inlet = name == beat.inlet
        drop = at_inlet - p
        rows.append([name + (" (in)" if is_inlet else ""), f"{mmhg(p.max()):.1f}", f"{mmhg(p.min()):.1f}", f"{mmhg(np.ptp(p)):.1f}",
                     f"{mmhg(beat.mean(p)):.1f}", aim if is_inlet else "", off if is_inlet else "", f"{p.max():.2f}/{p.min():.2f}",
                     "" if is_inlet else f"{mmhg(beat.mean(drop)):.2f}", "" if is_inlet else f"{mmhg(drop.max()):.2f}"])
    return Table("Pressures", "Of the last beat. Drop: pressure at the inlet less that at the outlet.",
                 ["pressure, mmHg", "systole", "diastole", "pulse", "mean", "goal", "off by", "kPa", "mean drop", "greatest drop"], rows)


def flows(beat, told):
    splits, rows = told.get("splits", {}), []
    mean = {name: beat.mean(flow) for name, flow in beat.flows.items()}
    leaves = -sum(mean[name] for name in beat.outlets)
    for name in beat.outlets:
        goal = splits.get(name)
        part = -mean[name] / leaves if leaves else float("nan")
        rows.append([name, f"{-mean[name]:.3g}", f"{-mean[name] / L_PER_MIN:.3g}", f"{(-beat.flows[name]).max():.3g}",
                     f"{(-beat.flows[name]).min():.3g}", share(part), share(goal) if goal else "",
                     signed(part / goal - 1) if goal else ""])
    name = beat.inlet
    rows.append([name + " (in)", f"{mean[name]:.3g}", f"{mean[name] / L_PER_MIN:.3g}", f"{beat.flows[name].max():.3g}",
                 f"{beat.flows[name].min():.3g}", "", "", ""])
    return Table("Flows", "Of the last beat; 1 ml/s = 1 mm³/ms. Out of the outlets, into the inlet.",
                 ["flow", "mean, ml/s", "mean, l/min", "greatest, ml/s", "least, ml/s", "share", "goal", "off by"], rows)


def numbers_of(case, name):
    """The parameters of a surface of the fluid that are numbers, and its condition."""
    surface = case.find(f"./ParameterList[@name='Fluid']/ParameterList[@name='Surfaces']/ParameterList[@name='{name}']")
    found = {}
    for parameter in surface.findall("Parameter") if surface is not None else ():
        try:
            found[parameter.get("name")] = float(parameter.get("value"))
        except (TypeError, ValueError):
            found[parameter.get("name")] = parameter.get("value")
    return found


def windkessels(beat, case, told):
    rows, first = [], told.get("network", {})
    for name in beat.outlets:
        w = numbers_of(case, name)
        if w.get("condition") != "windkessel" or not all(isinstance(w.get(key), float) for key in LISTED):
            continue
        proximal, distal, capacitance = (w[key] for key in LISTED)
        row = [name, f"{proximal / MMHG_S_PER_ML:.4g}", f"{distal / MMHG_S_PER_ML:.4g}", f"{capacitance / ML_PER_MMHG:.4g}",
               f"{distal * capacitance / 1000:.3g}", f"{mmhg(w.get('distal pressure', 0.0)):.3g}",
               f"{proximal:.4g}/{distal:.4g}", f"{capacitance:.4g}"]
        if name in first:
            row += [signed((proximal + distal) / (first[name]["proximal"] + first[name]["distal"]) - 1),
                    signed(capacitance / first[name]["capacitance"] - 1)]
        rows.append(row)
    heading = ["Windkessel", "proximal, mmHg s/ml", "distal, mmHg s/ml", "capacitance, ml/mmHg", "time constant, s",
               "pressure behind, mmHg", "kPa ms/mm³", "mm³/kPa"]
    if any(len(row) > len(heading) for row in rows):
        heading += ["resistance since the network", "capacitance since the network"]
    return Table("Windkessels", "", heading, [row + [""] * (len(heading) - len(row)) for row in rows]) if rows else None


def pulse_waves(beat, ways):
    """From foot to foot of the pressure. ways: from the inlet along the vessel [mm], {} where they are not known."""
    feet, step = beats.arrivals(beat), beat.longest_step()
    rows = []
    for name in beat.outlets:
        if feet[name] is None or feet[beat.inlet] is None or name not in ways:
            continue
        half = 0.5 * beat.period  # either foot may be that of the next pulse
        delay = (feet[name] - feet[beat.inlet] + half) % beat.period - half
        is_seen = delay >= step
        rows.append([name, f"{ways[name]:.1f}", f"{delay:.2f}", f"{ways[name] / delay:.2f}" if is_seen else f"delay below a step of {step:g} ms"])
    return Table("Pulse wave velocity, from foot to foot", "Of the mean pressure of inlet and outlet; m/s = mm/ms.",
                 ["outlet", "way from the inlet, mm", "delay, ms", "velocity, m/s"], rows) if rows else None


def mass(beat):
    """Blood that enters and leaves in the beat [ml], what the vessel has kept, and what is missing."""
    volume = lambda flow: case_tables.integral(flow, beat.times) / 1000.0  # noqa: E731
    enters, leaves = (sum(volume(np.clip(s * flow, 0, None)) for flow in beat.flows.values()) for s in (1, -1))
    lumen = beat.of("fluid_volume_mm3")
    kept = float("nan") if lumen is None else (lumen[-1] - lumen[0]) / 1000.0
    swing = float("nan") if lumen is None else np.ptp(lumen) / 1000.0
    missing = enters - leaves - kept
    rows = [["enters", f"{enters:.4g}", ""], ["leaves", f"{leaves:.4g}", share(leaves / enters)],
            ["more in the vessel at the end of the beat than at its begin", f"{kept:.3g}", share(kept / enters)],
            ["missing", f"{missing:.2g}", share(missing / enters)],
            ["the vessel takes up and gives back", f"{swing:.4g}", share(swing / enters)]]
    return Table("Budget of mass", "", ["blood in a beat", "ml", "of what enters"], rows)


PRESCRIBED = ("flow rate", "velocity", "velocity from file")  # through which kinetic_inflow of steps.csv does not look
POWERS = (("kinetic_inflow", "kinetic energy that flows in under pressure", 1), ("divergence_power", "divergence that elements have", 1),
          ("viscous_power", "viscosity of blood", -1), ("backflow_power", "stabilisation of backflow", -1),
          ("stabilisation_power", "stabilisation of the flow", -1), ("wall_stabilisation_power", "stabilisation of the wall", -1),
          ("support_power_", "damping of the tissue", -1))
ENERGIES = ("fluid_kinetic_energy_", "wall_kinetic_energy_", "elastic_energy_", "volumetric_energy_", "support_energy_")


def columns_of(beat, begin):
    """The sum of the columns that begin so, None without one."""
    found = [values for column in beat.steps if column.startswith(begin) and (values := beat.of(column)) is not None]
    return sum(found) if found else None


def works(beat, kinetic):
    """(what, energy [mJ], its sign in the balance) over the beat; None where a pressure is not known. kinetic: energy that
    flows in at the inlet [kPa mm^3], where it is no part of the columns, else None."""
    total = lambda power: float(case_tables.integral(power, beat.times)) / MICROJOULES  # noqa: E731
    found = []
    for name in beat.openings():
        mean = beat.of(f"mean_pressure_{name}_kPa")
        pressure = beat.pressures[name] if mean is None else mean
        if pressure is None:
            return None
        found.append((f"pressure at {name}", total(pressure * beat.flows[name]), 1))
    if kinetic is not None:
        found.append((f"kinetic energy that flows in at {beat.inlet}", kinetic / MICROJOULES, 1))
    powers = ((text, columns_of(beat, column), sign) for column, text, sign in POWERS)
    found += [(text, total(power), sign) for text, power, sign in powers if power is not None]
    stored = [values for begin in ENERGIES if (values := columns_of(beat, begin)) is not None]
    if stored:
        found.append(("more stored at the end of the beat than at its begin",
                      float(sum(v[-1] - v[0] for v in stored)) / MICROJOULES, -1))
    return found


def energy(beat, kinetic):
    """What pressure does at the openings in the beat, and where it goes."""
    found = works(beat, kinetic)
    if found is None:
        return None
    given = found[0][1]
    found.append(("remainder: time scheme, damping inside the wall", sum(sign * value for _, value, sign in found), 1))
    rows = [[text, f"{value:.4g}", share(value / given) if given else "–"] for text, value, _ in found if value]
    rows.append([f"mean power of pressure at {beat.inlet}, mW", f"{1000 * given / beat.period:.4g}", ""])
    return Table("Budget of energy", "Of pressure at openings: positive where it enters the blood; 1 mJ = 1000 kPa mm³.",
                 ["energy in a beat", "mJ", "of what the inlet gives"], rows)


def periodicity(beat, wss_change):
    """Largest change of each pressure since the beat before, of the pulse at the inlet; of flows, of the mean inflow."""
    times = beat.of("time", whole=True)
    if times[-1] - times[0] < 2 * beat.period * beats.WHOLE - beat.longest_step():
        return Table("Does the beat repeat itself?", "The run is not two beats long.", [], [])
    rows = []
    pulse, stroke = np.ptp(beat.pressures[beat.inlet]), beat.mean(beat.flows[beat.inlet])
    for what, column_of, size in (("pressure", beat.pressure_column, pulse), ("flow", "inflow_{}_mm3_per_ms".format, stroke)):
        for name in beat.openings():
            values = beat.of(column_of(name), whole=True)
            if values is None:
                continue
            now = beat.times[beat.times > beat.start + settled_at(beat.period, np.diff(beat.times))]
            change = np.abs(np.interp(now, times, values) - np.interp(now - beat.period, times, values)).max() / size
            rows.append([f"{what} at {name}", f"{100 * change:.2g} %"])
    if wss_change is not None:
        rows.append(["wall shear stress", f"{100 * wss_change:.2g} %"])
    return Table("Does the beat repeat itself?", "Largest change since the beat before, after its first twentieth and two steps: of pressures in parts "
                 "of the pulse at the inlet, of flows in parts of the mean inflow; of wall shear stress its root mean square, in parts of "
                 "the largest one.",
                 ["quantity", "change"], rows)
