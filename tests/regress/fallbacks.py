"""Where the preconditioner of a case stagnates another one takes its place, told once, in the tables and the record; a
restart goes on with it to the last digit; and a long solve says how far it is.

Usage: fallbacks.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import pathlib
import sys

from runs import Run, Verdict, command, exactly_same_steps, fresh, table

BLOCK = """<ParameterList name="Case">
  <ParameterList name="Mesh"><Parameter name="file" type="string" value="block.h5"/></ParameterList>
  <ParameterList name="Time">
    <Parameter name="step size" type="double" value="1.0"/><Parameter name="steps" type="int" value="{steps}"/>
  </ParameterList>
  <ParameterList name="Wall">
    <Parameter name="analysis" type="string" value="static"/>
    <ParameterList name="Layers"><ParameterList name="block">
      <Parameter name="law" type="string" value="st-venant-kirchhoff"/>
      <Parameter name="young modulus" type="double" value="100.0"/>
      <Parameter name="poisson ratio" type="double" value="{poisson}"/>
    </ParameterList></ParameterList>
    <ParameterList name="Surfaces">{held}
      <ParameterList name="z_high">
        <Parameter name="condition" type="string" value="moved"/>
        <Parameter name="components" type="Array(string)" value="{{z}}"/>
        <Parameter name="displacement" type="Array(double)" value="{{0.0, 0.0, {moved}}}"/>
        <ParameterList name="Amplitude">
          <Parameter name="kind" type="string" value="table"/>
          <Parameter name="times" type="Array(double)" value="{{0, {steps}}}"/>
          <Parameter name="values" type="Array(double)" value="{{0, 1}}"/>
        </ParameterList>
      </ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>"""
HELD = """
      <ParameterList name="{side}">
        <Parameter name="condition" type="string" value="held"/>
        <Parameter name="components" type="Array(string)" value="{{normal}}"/>
      </ParameterList>"""
WEAK = ["--set", "Wall/Linear Solver/preconditioner=none"]  # it stagnates on any wall


def write_case(path, moved, steps, poisson=0.3):
    held = "".join(HELD.format(side=side) for side in ("x_low", "y_low", "z_low"))
    path.write_text(BLOCK.format(held=held, moved=moved, steps=steps, poisson=poisson))


def solid(programs, folder, case, output, *more, ranks=1):
    return Run(command(programs / "tunica-solid", [case, "--output", output, *more], ranks), folder)


def compresses_a_block(verdict, programs, folder):
    """By a fifth in one step, by default."""
    write_case(folder / "block.xml", -0.2, 1)
    run = solid(programs, folder, "block.xml", "block")
    verdict.claim(run.status == 0, f"a block is compressed by a fifth in one step: {run.status} {run.err.strip()}")
    verdict.claim("line search failed" not in run.out + run.err, "NOX says nothing of its own")


def does_without_stress(verdict, programs, folder):
    """A block whose subscales feed on the stress that drives them bears as much without."""
    write_case(folder / "feeding.xml", -0.2, 1, poisson=0.45)
    default = solid(programs, folder, "feeding.xml", "feeding")
    linear = solid(programs, folder, "feeding.xml", "linear", "--set", "Wall/stabilisation residual=linear")
    verdict.claim([default.status, linear.status] == [0, 0], f"a block of a Poisson ratio of 0.45 is compressed: {default.err.strip()}")
    verdict.claim("subscales does not converge" in default.out, "where the stress of its subscales does not settle it is told")
    energies = [table(folder / name / "steps.csv")["elastic_energy_kPa_mm3"][-1] for name in ("feeding", "linear")]
    verdict.claim(abs(energies[0] / energies[1] - 1.0) < 1e-7, f"its energy is that without: {energies}")


def takes_another(verdict, programs, folder, ranks):
    name = f"weak-{ranks}"
    write_case(folder / "weak.xml", -0.02, 1)
    run = solid(programs, folder, "weak.xml", name, *WEAK, ranks=ranks)
    rows = table(folder / name / "linear.csv")
    used = rows.get("preconditioner", [])
    verdict.claim(run.status == 0, f"{ranks} ranks: it converges with another preconditioner: {run.status} {run.err.strip()}")
    verdict.claim(used[:2] == ["none", "vanka"] and used.count("none") == 1 and rows["converged"][:2] == [0, 1],
                  f"{ranks} ranks: the first fails once, the second is kept: {used}")
    told = [line for line in run.out.splitlines() if "takes its place" in line]
    verdict.claim(len(told) == 1 and "stagnates" in told[0], f"{ranks} ranks: told once: {told}")
    record = json.loads((folder / name / "run.json").read_text())
    counts = record.get("linear solves", {})
    verdict.claim(counts == {"wall, none": 1, "wall, vanka": used.count("vanka")}, f"{ranks} ranks: run.json counts {counts}")
    newton = table(folder / name / "newton.csv")
    sums = sum(newton["linear_iterations"]), sum(rows["iterations"])
    verdict.claim(sums[0] == sums[1], f"{ranks} ranks: the iterations of both count: {sums}")


def goes_on_to_the_last_digit(verdict, programs, folder):
    """In steps 1, 3 and 6 the first one is tried; a run that begins with step 3, 4 or 5 does the same."""
    write_case(folder / "steps.xml", -0.05, 5)
    straight = solid(programs, folder, "steps.xml", "straight", *WEAK)
    parts = [solid(programs, folder, "steps.xml", "parts", *WEAK, "--steps", steps, *more)
             for steps, more in ((2, []), (3, ["--restart"]), (5, ["--restart"]))]
    verdict.claim([straight.status] + [part.status for part in parts] == [0] * 4, "steps in one go and in three parts")
    exactly_same_steps(verdict, "in parts", folder / "parts", folder / "straight")
    rows = [table(folder / name / "linear.csv") for name in ("straight", "parts")]
    used = [list(zip(row["step"], row["preconditioner"], row["iterations"], row["true_residual"])) for row in rows]
    verdict.claim(used[0] == used[1], "the same preconditioners, iterations and residuals")
    tried = sorted({step for step, name, *_ in used[0] if name == "none"})
    verdict.claim(tried == [1, 3], f"the first one is tried in steps 1 and 3 of 5: {tried}")


def says_how_far_it_is(verdict, programs, folder):
    run = solid(programs, folder, "block.xml", "told", "--set", "Output/progress every=0")
    lines = [line for line in run.out.splitlines() if "iteration" in line]
    verdict.claim(bool(lines) and lines[0].startswith("step 1: wall: Newton step 1: GCR iteration 1, relative residual "),
                  f"a long solve says where it is: {lines[:1]}")
    quiet = solid(programs, folder, "block.xml", "quiet", "--set", "Output/progress every=1e6")
    verdict.claim("GCR iteration" not in quiet.out, "not more often than it is asked to")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    made = Run(command(programs / "tunica-mesh", ["block", "block.h5"]), folder)
    verdict.claim(made.status == 0, f"the block is meshed {made.err}")
    compresses_a_block(verdict, programs, folder)
    does_without_stress(verdict, programs, folder)
    for ranks in (1, 2):
        takes_another(verdict, programs, folder, ranks)
    goes_on_to_the_last_digit(verdict, programs, folder)
    says_how_far_it_is(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
