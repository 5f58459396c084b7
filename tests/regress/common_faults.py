"""An exception that all ranks meet alike ends the run as ever, with the last whole step as a checkpoint, however rarely
they are wanted; one that a rank meets alone leaves none.

Usage: common_faults.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import shutil
import sys

from runs import ENVIRONMENT, ROOT, Run, Verdict, checkpoints, command, exactly_same_steps, fresh, table

STEPS = 3
WHOLE = ["Coupling/scheme=monolithic", "Coupling/Newton/jacobian cost=0"]  # each step has its Jacobians
ADAPTIVE = ["Time/step control=adaptive", "Time/end time=0.2", "Time/tolerance=0.05", "Time/displacement scale=0.005",
            "Time/velocity scale=0.2", "Coupling/scheme=monolithic"]


class Case:
    """A case, and how it is run: with so many ranks and these settings besides."""

    def __init__(self, programs, folder, name, ranks=1, program="tunica-fsi", case="pulse-tiny", settings=()):
        self.programs, self.folder, self.name, self.ranks, self.program = programs, folder, name, ranks, program
        self.case, self.settings = ROOT / "xml" / f"{case}.xml", list(settings)
        self.straight = folder / f"{name}-straight"

    def run(self, output, fault=None, steps=STEPS, every=100, fields=0, more=()):
        arguments = [self.case, "--output", output, "--steps", steps, *more]
        for setting in (f"Output/checkpoint every={every}", f"Output/fields every={fields}", *self.settings):
            arguments += ["--set", setting]
        environment = dict(ENVIRONMENT, TUNICA_FAULT=fault) if fault else ENVIRONMENT
        return Run(command(self.programs / self.program, arguments, self.ranks), self.folder, environment)

    def goes_straight(self, verdict):
        run = self.run(self.straight)
        verdict.claim(run.status == 0, f"{self.name}: a run without faults ends with {run.status}, 0 {run.err}")

    def jacobian_of(self, step, rank, kind):
        """The fault of the second Jacobian of a step."""
        before = sum(row < step for row in table(self.straight / "newton.csv")["step"])
        return f"jacobian:{rank}:{kind}:{before + 2}"


def told(run):
    """Lines of the program; mpirun adds some of its own."""
    return [line for line in run.err.splitlines() if line.startswith("tunica")]


def snapshot(folder):
    return {path.name: path.read_bytes() for path in folder.glob("checkpoint-*")}


def fails(verdict, name, run, words, status=3):
    verdict.claim(run.status == status, f"{name}: exit status {run.status} is {status}")
    verdict.claim(len(told(run)) == 1 and words in told(run)[0], f"{name}: one message: {' | '.join(told(run))}")


def leaves(verdict, case, fault, words, step, fields=0, status=3):
    """The fault leaves a checkpoint of the step, from which the run goes on as if nothing had been."""
    name = f"{case.name}, {fault}"
    output = case.folder / name.translate(str.maketrans(" :", "--", ","))
    fails(verdict, name, case.run(output, fault, fields=fields), words, status)
    verdict.claim(checkpoints(output) == [step], f"{name}: the checkpoint {checkpoints(output)} is of step {step}")
    again = case.run(output, fields=fields, more=["--restart"])
    verdict.claim(again.status == 0, f"{name}: the restart ends with {again.status}, 0 {again.err}")
    exactly_same_steps(verdict, name, output, case.straight)


def in_a_step(verdict, case, kind, words):
    leaves(verdict, case, case.jacobian_of(3, "all", kind), words, 2)


def not_in_the_table(verdict, case):
    """A step that is accepted, but in no table, is made again."""
    leaves(verdict, case, "steps table:all:error:3", "fault wanted at: steps table", 2, status=1)


def without_fields(verdict, case):
    """A step that lacks its fields only is not."""
    leaves(verdict, case, "field output:all:runtime:2", "fault wanted at: field output", 2, fields=1)


def of_one_rank(verdict, case):
    verdict.claim(case.run("alone", steps=1).status == 0, f"{case.name}: the first step succeeds")
    made = table(case.straight / "newton.csv")["step"]
    passes = made.count(2.0) + 2
    for rank in (0, 1):
        name, output = f"{case.name}, rank {rank} alone", case.folder / f"alone-{rank}"
        shutil.copytree(case.folder / "alone", output)
        before = snapshot(output)
        run = case.run(output, f"jacobian:{rank}:runtime:{passes}", more=["--restart"])
        fails(verdict, name, run, f"fault wanted at: jacobian (on rank {rank} alone)")
        verdict.claim(table(output / "steps.csv")["step"] == [1.0, 2.0], f"{name}: two steps are made")
        verdict.claim(checkpoints(output) == [1] and snapshot(output) == before, f"{name}: the checkpoint stays as it was")


def where_each_has_one_or_none(verdict, case):
    fault = case.jacobian_of(3, "all", "runtime")
    for every, expected in ((0, []), (1, [1, 2])):
        output = case.folder / f"every-{every}"
        fails(verdict, f"every {every}", case.run(output, fault, every=every), "fault wanted at: jacobian")
        verdict.claim(checkpoints(output) == expected, f"every {every}: the checkpoints are {expected}")


def that_cannot_be_written(verdict, case):
    """What happened first is told. A folder is where the draft of the checkpoint should be."""
    output = case.folder / "unwritable"
    obstacle = output / "checkpoint-000002.h5.tmp" / "mine"
    obstacle.mkdir(parents=True)
    run = case.run(output, case.jacobian_of(3, "all", "runtime"))
    fails(verdict, "unwritable", run, "fault wanted at: jacobian")
    verdict.claim(checkpoints(output) == [] and obstacle.is_dir(), "unwritable: there is no checkpoint")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    one, two = Case(programs, folder, "one rank"), Case(programs, folder, "two ranks", 2, settings=WHOLE)
    adaptive = Case(programs, folder, "adaptive", settings=ADAPTIVE)
    fluid = Case(programs, folder, "fluid", program="tunica-fluid", case="poiseuille")
    wall = Case(programs, folder, "wall", program="tunica-solid", case="inflation", settings=["Wall/analysis=dynamic"])
    for case in (one, two, adaptive, fluid, wall):
        case.goes_straight(verdict)
    for case in (one, fluid):
        in_a_step(verdict, case, "runtime", "fault wanted at: jacobian")
    for case in (two, wall):
        in_a_step(verdict, case, "bad_alloc", "(jacobian)")
    for case in (two, adaptive):
        not_in_the_table(verdict, case)
    without_fields(verdict, two)
    of_one_rank(verdict, two)
    where_each_has_one_or_none(verdict, wall)  # all programs share what writes checkpoints, and its steps are short
    that_cannot_be_written(verdict, wall)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
