"""Stage case: an ordinary case, with comments that say where each number came from."""
import math
import os

import numpy as np

from importer.case_writer import Writer

from . import lumen, tune, walls
from .errors import BadInput
from .folder import read_json, write_atomically
from .units import BLOOD_DENSITY, BLOOD_VISCOSITY, L_PER_MIN, mmhg

CASE = "case.xml"
READS = (lumen.TABLE, walls.MESH, walls.TABLE, tune.TABLE, tune.INFLOW)
RESULTS = (CASE,)
FIELDS = 20  # outputs of the fields in a beat
CHECKPOINTS = 8  # in a beat: what a run that is killed has to repeat at most
PROFILES = {"womersley": "that of a pulsating flow in a round tube, Womersley, J. Physiol. 127 (1955)",
            "parabolic": "that of a steady flow in a round tube", "flat": "the same velocity everywhere"}
LEAST_HOLD = 0.5  # of what openings with perpendicular normals hold
BACKFLOW = 0.2  # safe, and with no effect where nothing flows back


def steps_of(period, longest):
    """Steps of a beat, a multiple of FIELDS, so that every beat has fields at the same times."""
    return FIELDS * math.ceil(period / longest / FIELDS - 1e-9)


def source_of(wall, key):
    """Where a number of wall.json comes from, as it stands there."""
    return wall.get("sources", {}).get(key, "of " + walls.TABLE)


def write_time(out, wall, tuned, options):
    steps = steps_of(tuned["period"], options.step)
    out.begin("Mesh")
    out.put("file", walls.MESH, f"of the stages mesh and wall; wall of {wall['thickness']:g} of the local radius, "
            + source_of(wall, "thickness"))
    out.end()
    out.begin("Time")
    out.put("step size", tuned["period"] / steps,
            f"ms; {steps} steps in a beat of {tuned['period']:.6g} ms, at most {options.step:g} ms (option step)")
    out.put("steps", 3 * steps, "three beats by tunica-fsi alone; tunica-vessel goes on beat by beat")
    out.put("cuts", 3, "a step that fails is halved up to three times")
    out.end()


def write_inlet(out, tuned, options):
    out.begin(tuned["inlet"])
    out.put("condition", "flow rate")
    out.put("flow rate", 1.0, f"ml/s, times the curve: {tuned['inflow']}; mean {tuned['mean flow'] / L_PER_MIN:.3g} l/min")
    out.put("profile", options.profile, f"option profile: {PROFILES[options.profile]}")
    out.begin("Amplitude", "of the stage tune, begins at the end of diastole")
    out.put("kind", "file")
    out.put("file", tune.INFLOW)
    out.put("interpolation", "spline")
    out.put("period", tuned["period"], "ms, of the curve or option heart-rate")
    out.end()
    out.end()


def write_outlet(out, name, outlet):
    capped = outlet["proximal resistance"] < 0.999 * outlet["characteristic impedance"]
    whole = outlet["proximal resistance"] + outlet["distal resistance"]
    why = (f"kPa ms/mm^3; {100 * outlet['proximal resistance'] / whole:.2g} % of the whole: rho c/A would be "
           f"{outlet['characteristic impedance']:.3g}" if capped else "kPa ms/mm^3; rho c/A, the characteristic impedance")
    out.begin(name)
    out.put("condition", "windkessel")
    out.put("proximal resistance", outlet["proximal resistance"], why)
    out.put("capacitance", outlet["capacitance"], "mm^3/kPa; tuned, shared like the flow")
    out.put("distal resistance", outlet["distal resistance"], f"tuned for {100 * outlet['split']:.3g} % of the mean flow")
    out.put("distal pressure", outlet["distal pressure"],
            f"kPa, behind the small vessels; {'assumed' if outlet['distal pressure'] == 0 else 'of ' + tune.TABLE}")
    out.put("initial pressure", outlet["initial pressure"], "kPa; of the network in a beat that repeats itself, at its beginning")
    out.put("backflow stabilisation", BACKFLOW, "so that blood that flows back brings in no energy: Esmaily Moghadam and others, "
            "Comput. Mech. 48 (2011)")
    out.end()


def write_fluid(out, tuned, options):
    out.begin("Fluid")
    out.put("density", BLOOD_DENSITY, "mg/mm^3, blood")
    out.put("viscosity", BLOOD_VISCOSITY, "kPa ms, blood at high shear rates")
    out.begin("Surfaces")
    write_inlet(out, tuned, options)
    for name, outlet in tuned["outlets"].items():
        write_outlet(out, name, outlet)
    out.begin("interface")
    out.put("condition", "interface")
    out.end()
    out.end()
    out.end()


def write_wall(out, table, wall, tuned, options):
    names = [opening["name"] for opening in table["openings"]]
    out.begin("Wall")
    out.begin("Prestress")
    out.put("pressure", tuned["goal"]["diastolic"],
            f"kPa, {mmhg(tuned['goal']['diastolic']):.4g} mmHg: assumes an image at the end of diastole")
    out.end()
    if any(layer["keys"]["law"] == "holzapfel" for layer in wall["layers"].values()):
        out.begin("Fibre Frame")
        out.put("kind", "laplace", "fibres turn about the way from the inlet to the outlets")
        out.put("start surfaces", ["wall_" + tuned["inlet"]])
        out.put("end surfaces", ["wall_" + name for name in names if name != tuned["inlet"]])
        out.end()
    out.begin("Layers")
    for name, layer in wall["layers"].items():
        out.begin(name, f"{100 * layer['share']:.3g} % of the thickness; {layer.get('source', 'of ' + walls.TABLE)}")
        for key, value in layer["keys"].items():
            out.put(key, value)
        out.end()
    out.end()
    write_wall_surfaces(out, names, wall, options)
    out.end()


def write_wall_surfaces(out, names, wall, options):
    out.begin("Surfaces")
    for name in names:
        out.begin("wall_" + name)
        if options.ends == "slide":
            out.put("condition", "held")
            out.put("components", ["normal"], "option ends: the end slides in its plane")
        else:
            out.put("condition", "clamped", "option ends: held as imaged; assumed")
        out.end()
    out.begin("interface")
    out.put("condition", "interface")
    out.end()
    if wall["tissue"] or wall["damping"]:
        out.begin("outer")
        out.put("condition", "support")
        out.put("stiffness", float(wall["tissue"]), f"kPa/mm; tissue around the wall, {source_of(wall, 'tissue')}")
        out.put("damping", float(wall["damping"]), f"kPa ms/mm; {source_of(wall, 'damping')}")
        out.put("direction", "all", "also along the vessel, which would otherwise be free to turn")
        out.end()
    out.end()


def write_output(out, tuned, options):
    steps = steps_of(tuned["period"], options.step)
    out.begin("Output")
    out.put("folder", "results")
    out.put("fields every", steps // FIELDS)
    out.put("checkpoint every", max(1, steps // CHECKPOINTS))
    out.end()


def text_of(folder, options):
    table, wall, tuned = read_json(folder.file(lumen.TABLE)), walls.read(folder), tune.read(folder)
    out = Writer("Made by tunica-vessel. Change what you like and give the same command again: it goes on with the changed file. "
                 f"Wall: {os.path.basename(options.wall)}.")
    write_time(out, wall, tuned, options)
    write_fluid(out, tuned, options)
    write_wall(out, table, wall, tuned, options)
    out.begin("Mesh Motion")
    out.put("stiffening", 1.0, "small elements keep their shape")
    out.end()
    write_output(out, tuned, options)
    return out.text()


def slide_lines(table):
    """Ends that slide hold the wall along their normals n alone, against a shift v by sum (n.v)^2. The pressure of the prestress
    pushes the wall also where that is next to nothing; what its bending does not bear is left to the tissue."""
    hold = np.linalg.svd(np.array([opening["normal"] for opening in table["openings"]]))[1]
    if len(hold) == 3 and hold[-1] > LEAST_HOLD:
        return []
    return ["warning: --ends slide: all openings face nearly one plane or direction, and no end holds the wall across it. In "
            "its prestress the tissue holds what it does not bear there; --ends clamped holds it"]


def make(folder, options, programs):
    """The case is written beside its name first, and validated there."""
    draft = folder.file("draft-" + CASE)
    write_atomically(draft, text_of(folder, options))
    log = folder.file(lumen.LOG)
    status = programs.run(["tunica-check", draft], log)
    with open(log, encoding="utf-8", errors="replace") as file:
        told = file.read().split("\n$ ")[-1].split("\n")
    if status != 0:
        raise BadInput(f"{draft}: tunica-check refuses it: {[line for line in told if line.strip()][-1]}")
    os.replace(draft, folder.file(CASE))
    slide = slide_lines(read_json(folder.file(lumen.TABLE))) if options.ends == "slide" else []
    return [f"case: {folder.file(CASE)} is valid", *slide] + ["  " + line for line in told if line.startswith(("warning", "CFL", "memory"))]
