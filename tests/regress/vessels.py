"""xml/vessels/bifurcation.xml: a vessel that no axis describes, elements that Gmsh made, and steps that
are long beside the time in which waves cross an element.

Usage: vessels.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys
import xml.etree.ElementTree as xml

from runs import ROOT, Run, Verdict, command, entry, fresh, same_steps, table

CASE = ROOT / "xml" / "vessels" / "bifurcation.xml"
STEPS = 3
DIRECT = ["--set", "Wall/Fibre Frame/Linear Solver/method=direct"]
# The bending of a long vessel is hardly in the residual.
TIGHT = ["--set", "Coupling/Newton/linear tolerance=1e-8"]


def run(verdict, programs, folder, output, more=(), ranks=1):
    words = [CASE, "--output", output, "--steps", STEPS, *more]
    done = Run(command(programs / "tunica-fsi", words, ranks), folder)
    verdict.claim(done.status == 0, f"{output}: ends with 0 ({done.seconds:.1f} s)")
    if done.status != 0:
        print(done.out + done.err)
    return folder / output


def conserves_mass(verdict, results):
    """What flows in and does not flow out widens the vessel: BDF2 for the volume, Euler at first."""
    steps = table(results / "steps.csv")
    volume, time = steps["fluid_volume_mm3"], steps["time"]
    flows = [name for name in steps if name.startswith("inflow_")]
    for k in range(2, len(time)):
        growth = (1.5 * volume[k] - 2.0 * volume[k - 1] + 0.5 * volume[k - 2]) / (time[k] - time[k - 1])
        inflow = sum(steps[name][k] for name in flows)
        verdict.claim(abs(growth - inflow) < 0.02 * steps["inflow_inlet_mm3_per_ms"][k],
                      f"step {k + 1}: {growth:.5f} mm³/ms wider, {inflow:.5f} more in than out")


def compares_smoothers(verdict, programs, folder):
    """Factors without fill overshoot on this matrix; the default sees that."""
    case = xml.parse(CASE).getroot()
    entry(entry(case, "Mesh"), "file").set("value", str(ROOT / "meshes" / "bifurcation.h5"))
    settings = entry(entry(xml.parse(ROOT / "xml" / "monolithic" / "solvers.xml").getroot(), "Solvers"),
                     "System")
    for setting in [one for one in settings if one.get("name") != "nodal ILU 2+2"]:
        settings.remove(setting)
    plain = xml.fromstring(xml.tostring(settings[0]))
    plain.set("name", "without bound")
    sweeps = entry(entry(entry(plain, "MueLu"), "Factories"), "Sweeps")
    xml.SubElement(sweeps, "Parameter", name="spectral bound", type="double", value="0")
    settings.append(plain)
    solvers = xml.SubElement(case, "ParameterList", name="Solvers")
    for key, value in (("step", 2), ("newton step", 2)):
        xml.SubElement(solvers, "Parameter", name=key, type="int", value=str(value))
    solvers.append(settings)
    (folder / "solvers.xml").write_text(xml.tostring(case, encoding="unicode"))
    for ranks in (1, 3):
        done = Run(command(programs / "tunica-solvers",
                           ["solvers.xml", "--output", f"solvers-{ranks}"], ranks), folder)
        if not verdict.claim(done.status == 0, f"solvers, {ranks} ranks: ends with 0"):
            print(done.out + done.err)
            continue
        bounded, unbounded = table(folder / f"solvers-{ranks}" / "solvers.csv")["iterations"]
        verdict.claim(bounded <= 16 and 1.5 * bounded <= unbounded,
                      f"solvers, {ranks} ranks: {bounded:.0f} iterations, {unbounded:.0f} without bound")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for ranks in (1, 2):
        checked = Run(command(programs / "tunica-check", [CASE], ranks), folder)
        verdict.claim(checked.status == 0, f"tunica-check, {ranks} ranks: {checked.out}{checked.err}")
    # The directions of the fibres are asked for before the first step.
    refused = Run(command(programs / "tunica-fsi", [
        CASE, "--dry-run", "--set", "Wall/Fibre Frame/Linear Solver/max iterations=1"], 1), folder)
    verdict.claim(refused.status == 1 and "Fibre Frame" in refused.err,
                  f"--dry-run tries the directions of fibres: {refused.status} {refused.err}")
    alone = run(verdict, programs, folder, "alone", TIGHT)
    conserves_mass(verdict, alone)
    same_steps(verdict, "directions by a direct solver", run(verdict, programs, folder, "direct", DIRECT + TIGHT),
               alone)
    same_steps(verdict, "3 ranks", run(verdict, programs, folder, "on-3", TIGHT, 3), alone)
    compares_smoothers(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
