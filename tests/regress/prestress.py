"""A prestress that a signal ends, in a load or behind one, goes on with the loads that it would have taken, and ends
with the same wall; a wall that is free to move as a whole is refused, by the name of the motion; a flat wall, which
can bear no pressure, leans on the tissue around it, and so does a fork that would creep.

Usage: prestress.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import signal
import sys
import xml.etree.ElementTree as ElementTree

from runs import ROOT, Run, Verdict, command, fresh, remove_results, same_steps, table
from stops import STOPPED, status_when_told

CASE = ROOT / "xml" / "pulse-tiny.xml"
# The wall alone, imaged under 0.5 kPa, then under 0.6: what it does depends on its prestress.
SETTINGS = ["Wall/analysis=static", "Wall/Surfaces/interface/condition=pressure", "Wall/Surfaces/interface/pressure=0.6",
            "Wall/Prestress/pressure=0.5", "Wall/Prestress/load steps=40", "Wall/Prestress/tolerance=1e-10",
            "Wall/Prestress/linear tolerance=1e-12", "Output/fields every=0"]
# Without a preconditioner and with a basis of two vectors no solve comes to an end.
STUCK = [f"Wall/Linear Solver/{setting}" for setting in
         ("method=gcr", "preconditioner=none", "fallbacks={}", "restart=2", "max iterations=1000000")]
STUCK += ["Output/progress every=0"]
SLIDING = [f"Wall/Surfaces/{end}/{setting}" for end in ("struct_in", "struct_out")
           for setting in ("condition=held", "components={normal}")]


def words(program, output, settings=(), *more, ranks=1):
    sets = [word for setting in [*SETTINGS, *settings] for word in ("--set", setting)]
    return command(program, [CASE, "--output", output, "--steps", 1, *sets, *more], ranks)


def check_stop(verdict, folder, name, status, message):
    record = json.loads((folder / "broken" / "run.json").read_text())
    verdict.claim(status == STOPPED and record["status"] == "stopped", f"{name}: exit status {status} is {STOPPED}")
    verdict.claim(message in record["message"] and record["message"] in (folder / f"{name}.txt").read_text(),
                  f"{name}: it says \"{record['message']}\"")


def goes_on(verdict, program, folder):
    results = folder / "broken"
    # Told in the set-up, it ends behind a load; how many it has borne by then is left open.
    status = status_when_told(words(program, "broken"), folder / "behind.txt",
                              lambda: (results / ".tunica-lock").exists(), signal.SIGUSR1)
    loads = table(results / "prestress.csv")["load"]
    verdict.claim(0 < loads[-1] < 1, f"it has borne {loads[-1]:.3f} of the load")
    check_stop(verdict, folder, "behind", status, f"with {loads[-1]:.3g} of the load borne. Continue with --restart.")

    before = (results / "prestress.h5").read_bytes()
    rows = (results / "prestress.csv").read_text()
    log = folder / "within.txt"
    status = status_when_told(words(program, "broken", STUCK, "--restart", "--allow-changes", ranks=2), log,
                              lambda: "GCR iteration 100" in log.read_text(), signal.SIGTERM)
    check_stop(verdict, folder, "within", status, f"with {loads[-1]:.3g} of the load borne. Continue with --restart.")
    verdict.claim((results / "prestress.h5").read_bytes() == before, "within: the file of the load before is untouched")
    verdict.claim((results / "prestress.csv").read_text() == rows, "within: so are the rows of prestress.csv")

    more = Run(words(program, "broken", [], "--restart", "--allow-changes"), folder)
    straight = Run(words(program, "straight"), folder)
    verdict.claim([more.status, straight.status] == [0, 0], f"it goes on: {more.status} {more.err.strip()}")
    one, other = (table(folder / name / "prestress.csv") for name in ("broken", "straight"))
    for column in ("load_step", "iteration", "load"):
        verdict.claim(one[column] == other[column], f"{column} is the same in all {len(other[column])} rows")
    moved = table(folder / "straight" / "steps.csv")["max_displacement_wall_mm"][-1]
    verdict.claim(moved > 1e-3, f"the wall moves by {moved:.2e} mm from where it was imaged")
    same_steps(verdict, "stopped and gone on", results, folder / "straight", 1e-8)


def refuses_free_walls(verdict, programs, folder):
    """Static, or dynamic behind a prestress; a tube along z whose ends are held along it alone."""
    for program, settings in (("tunica-solid", SETTINGS), ("tunica-fsi", ["Wall/Prestress/pressure=0.5"])):
        sets = [word for setting in [*settings, *SLIDING] for word in ("--set", setting)]
        done = Run(command(programs / program, [CASE, "--output", program, "--steps", 1, *sets]), folder)
        verdict.claim(done.status == 1 and "against sliding in x and y, and turning about z" in done.err,
                      f"{program}: {done.status} {done.err.strip()}")


# A flat wall between four planes along which it slides, imaged under 2 kPa from below, on springs of 5 kPa/mm above.
# It has neither curvature nor ends that hold it: the springs have all of the pressure, and give way by 1 kPa/5 kPa/mm.
PRESSURE, MORE, STIFFNESS = 2.0, 1.0, 5.0
SLAB = {"Mesh": {"file": "slab.h5"}, "Time": {"step size": 1.0, "steps": 3},
        "Wall": {"analysis": "static", "stabilisation residual": "linear",
                 "Layers": {"block": {"law": "neo-hookean", "c10": 20.0}},
                 "Prestress": {"pressure": PRESSURE, "surfaces": ["z_low"]},
                 "Surfaces": {**{side: {"condition": "held", "components": ["normal"]} for side in ("x_low", "x_high", "y_low", "y_high")},
                              "z_low": {"condition": "pressure", "pressure": PRESSURE,
                                        "Amplitude": {"kind": "table", "times": [0.0, 1.0, 3.0],
                                                      "values": [1.0, 1.0, (PRESSURE + MORE) / PRESSURE]}},
                              "z_high": {"condition": "support", "stiffness": STIFFNESS}}},
        "Output": {"fields every": 0, "checkpoint every": 1}}


def as_xml(name, values):
    """A parameter list of nested dictionaries."""
    root = ElementTree.Element("ParameterList", name=name)
    for key, value in values.items():
        if isinstance(value, dict):
            root.append(as_xml(key, value))
            continue
        first = value[0] if isinstance(value, list) else value
        kind = {str: "string", float: "double", int: "int"}[type(first)]
        text = "{" + ", ".join(map(str, value)) + "}" if isinstance(value, list) else str(value)
        ElementTree.SubElement(root, "Parameter", name=key, type=f"Array({kind})" if isinstance(value, list) else kind, value=text)
    return root


def leans_on_tissue(verdict, programs, folder):
    made = Run(command(programs / "tunica-mesh", ["block", "slab.h5", "--x", 4, "--y", 4, "--z", 0.5, "--cells-x", 4, "--cells-y", 4,
                                                  "--cells-z", 2]), folder)
    verdict.claim(made.status == 0, f"slab.h5: {made.status} {made.err.strip()}")
    ElementTree.ElementTree(as_xml("Case", SLAB)).write(folder / "slab.xml")
    solid = programs / "tunica-solid"
    whole = Run(command(solid, ["slab.xml", "--output", "slab"]), folder)
    verdict.claim(whole.status == 0 and "does not bear" in whole.out and "the tissue holds 2 kPa" in whole.out,
                  f"slab: {whole.status} {whole.err.strip()}")
    last = {name: values[-1] for name, values in table(folder / "slab" / "prestress.csv").items()}
    for name in ("tissue_mean_kPa", "tissue_largest_kPa"):
        verdict.claim(abs(last[name] - PRESSURE) < 1e-3, f"slab: {name} is {last[name]:.6f} of {PRESSURE}")
    steps = table(folder / "slab" / "steps.csv")
    moved = steps["max_displacement_wall_mm"]
    verdict.claim(moved[0] < 1e-6, f"slab: stays where it was imaged, within {moved[0]:.1e} mm")
    verdict.claim(abs(moved[-1] - MORE / STIFFNESS) < 1e-3, f"slab: gives way by {moved[-1]:.5f} mm of {MORE / STIFFNESS}")
    force = steps["support_force_z_high_z_mN"][-1]
    verdict.claim(abs(force + 16.0 * (PRESSURE + MORE)) < 0.02, f"slab: the tissue holds it with {force:.3f} mN")

    # From a checkpoint, on another number of ranks, the springs are stretched as before.
    begun = Run(command(solid, ["slab.xml", "--output", "slab-begun", "--steps", 1]), folder)
    gone_on = Run(command(solid, ["slab.xml", "--output", "slab-begun", "--restart"], 2), folder)
    verdict.claim([begun.status, gone_on.status] == [0, 0], f"slab: goes on {gone_on.status} {gone_on.err.strip()}")
    same_steps(verdict, "slab gone on", folder / "slab-begun", folder / "slab", 1e-6)

    alone = Run(command(solid, ["slab.xml", "--output", "slab-alone", "--set", "Wall/Prestress/tissue=relaxed"]), folder)
    verdict.claim(alone.status == 2 and "no step reduces the imbalance" in alone.err,
                  f"slab: alone it bears nothing: {alone.status} {alone.err.strip()}")


def creeps_no_more(verdict, programs, folder):
    """A fork whose openings face nearly one plane, and slide: what its wall pushes across it must end somewhere."""
    ends = ("wall_inlet", "wall_outlet_internal", "wall_outlet_external")
    settings = ["Wall/Prestress/pressure=10.67", "Wall/Surfaces/interface/pressure=10.67", "Wall/Fibre Frame/kind=laplace",
                "Wall/Fibre Frame/start surfaces={wall_inlet}", f"Wall/Fibre Frame/end surfaces={{{ends[1]}, {ends[2]}}}"]
    settings += [f"Wall/Surfaces/{end}/{setting}" for end in ends for setting in ("condition=held", "components={normal}")]
    for layer, constants in (("media", {"c10": 99, "k1": 78}), ("adventitia", {"c10": 9.9, "k1": 18.5})):
        settings += [f"Wall/Layers/{layer}/{key}={value}" for key, value in {"law": "holzapfel", **constants}.items()]
    sets = [word for setting in settings for word in ("--set", setting)]
    done = Run(command(programs / "tunica-solid", [ROOT / "xml" / "vessels" / "solvers" / "carotid-wall.xml", "--output", "fork", *sets]),
               folder)
    verdict.claim(done.status == 0 and "steps do not get shorter" in done.out, f"fork: {done.status} {done.err.strip()}")
    held = table(folder / "fork" / "prestress.csv")["tissue_largest_kPa"][-1]
    verdict.claim(0 < held < 0.01, f"fork: the tissue holds at most {held:.4f} of 10.67 kPa")
    moved = table(folder / "fork" / "steps.csv")["max_displacement_wall_mm"][-1]
    verdict.claim(moved < 2.6e-3, f"fork: stays where it was imaged, within {moved:.1e} mm")


def main(programs, scratch):
    verdict, folder = Verdict(), fresh(scratch)
    goes_on(verdict, programs / "tunica-solid", folder)
    refuses_free_walls(verdict, programs, folder)
    leans_on_tissue(verdict, programs, folder)
    creeps_no_more(verdict, programs, folder)
    remove_results(folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
