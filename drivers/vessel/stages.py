"""The stages in their order: what is done already remains, what its inputs no longer fit is made anew."""
import os
import time

from . import case_file, flow_shapes, lumen, page, plan, run, tune, walls
from .errors import BadInput, NotConverged
from .folder import Folder, words_of
from .options import STAGES
from .programs import Programs


class Stage:
    """make(folder, options, programs) returns lines to print; reads and leaves name files in the folder."""

    def __init__(self, module):
        self.make, self.reads, self.leaves = module.make, getattr(module, "READS", ()), module.RESULTS


ALL = dict(zip(STAGES, map(Stage, (lumen, walls, tune, case_file, run, page))))


def wanted_stages(options):
    return STAGES[:STAGES.index(options.last or STAGES[-1]) + 1]


def is_forced(stage, options):
    return options.first is not None and STAGES.index(stage) >= STAGES.index(options.first)


def open_folder(options):
    folder = Folder(options.output, words_of(options))
    folder.accept(options.first)
    return folder


def check_files(options):
    """Files of the user that later stages read are read once before the long work."""
    options.mean_inflow = float(flow_shapes.inflow(options, walls.read_wall(options))[0].mean())  # ml/s


def tell_plan(options):
    check_files(options)
    folder = open_folder(options)
    for stage in wanted_stages(options):
        is_kept = folder.is_done(stage, ALL[stage].reads) and not is_forced(stage, options)
        print(f"{stage}: " + ("is done" if is_kept else "would be made"))
    print("\n".join(plan.lines(folder, options)))


def make_all(options):
    check_files(options)
    programs = Programs(options.programs)
    folder = open_folder(options)
    folder.begin()
    for stage in [name for name in STAGES if is_forced(name, options)]:
        forget(folder, stage)
    try:
        for stage in wanted_stages(options):
            make_one(folder, stage, options, programs)
    except BadInput:
        folder.abandon()
        raise
    if os.path.exists(folder.file(run.TABLE)) and options.last in (None, "run", "report") and not run.is_converged(folder, options):
        raise NotConverged(run.verdict(run.read_json(folder.file(run.TABLE))["beats"], run.goal_in(run.tune.read(folder)), options))


def forget(folder, stage):
    folder.forget(stage)
    if stage == "run" and os.path.exists(folder.file(run.TABLE)):
        os.remove(folder.file(run.TABLE))


def make_one(folder, stage, options, programs):
    work = ALL[stage]
    if folder.is_done(stage, work.reads):
        edited = folder.edited(stage)
        print(f"[{stage}] is done" + (f"; {', '.join(edited)} changed since, and taken as it is" if edited else ""), flush=True)
        return
    print(f"[{stage}]", flush=True)
    start = time.time()
    lines = work.make(folder, options, programs)
    print("\n".join("  " + line for line in lines), flush=True)
    # A run that did not reach its goals goes on with the same command.
    if stage != "run" or run.is_converged(folder, options):
        folder.finish(stage, work.reads, work.leaves, time.time() - start)
