"""xml/paper/reproduce: its list, valid settings, an item run once and not again, and in the item of
adaptive control not more Newton steps and cycles than Langer and Yang print, at night with their other wall, too.

Usage: paper_items.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import os
import pathlib
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

from runs import LONG, ROOT, Run, Verdict, command, fresh, table

REPRODUCE = ROOT / "xml" / "paper" / "reproduce"
# Newton steps and cycles of the paper's tables for the coarse mesh.
MOST = {"mooney-rivlin": {"fluid": (4, 9), "wall": (4, 9)}, "artery": {"wall": (5, 19)}}


def reproduce(programs, folder, *words):
    return Run([str(REPRODUCE), "--ranks", "1", "--output", str(folder / "paper"), "--build",
                str(programs.parent), *words], folder)


def settings_are_valid(verdict, programs, folder):
    loader = SourceFileLoader("reproduce", str(REPRODUCE))
    module = module_from_spec(spec_from_loader("reproduce", loader))
    sys.modules["reproduce"] = module  # dataclasses look for it there
    loader.exec_module(module)
    for item in module.items():
        words = [REPRODUCE.parent / f"{item.case}.xml", "--dry-run"]
        chosen = [word for setting in item.settings for word in ("--set", setting)]
        run = Run(command(programs / item.program, words + chosen), folder)
        verdict.claim(run.status == 0, f"{item.name} has a valid case {run.err}")


def counts(path, field):
    rows = table(path / "newton.csv")
    found = [n for step, k, f, n in zip(rows["step"], rows["coupling_iteration"], rows["field"],
                                        rows["linear_iterations"]) if (step, k, f) == (1, 2, field)]
    return len(found), sum(found)


def adaptive_control(verdict, programs, folder, wall):
    item = f"newton-{wall}-increment"
    run = reproduce(programs, folder, item)
    if not verdict.claim(run.status == 0, f"{item} ends with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return
    for field, (newton, cycles) in MOST[wall].items():
        ours = counts(folder / "paper" / "coarse" / item, field)
        verdict.claim(ours[0] <= newton and ours[1] <= cycles,
                      f"{item}: the {field} takes {ours[0]} Newton steps and {ours[1]:g} cycles, "
                      f"the paper's {newton} and {cycles}")
    page = (folder / "paper" / "report" / "RESULTS.md").read_text(encoding="utf-8")
    verdict.claim(item in page and "| **total** |" in page, f"{item} is on the page")


def main(programs, scratch):
    programs, folder, verdict = pathlib.Path(programs).resolve(), fresh(scratch), Verdict()
    listed = reproduce(programs, folder, "--list")
    verdict.claim(listed.status == 0 and "pulse-artery-aitken" in listed.out, "--list names the items")
    wrong = reproduce(programs, folder, "amg-arteri")
    verdict.claim(wrong.status == 1 and "unknown item" in wrong.err, "an unknown item is refused")
    settings_are_valid(verdict, programs, folder)
    for wall in MOST if LONG else ("artery",):
        adaptive_control(verdict, programs, folder, wall)
    record = folder / "paper" / "coarse" / "newton-artery-increment" / "run.json"
    before = os.stat(record).st_mtime_ns
    again = reproduce(programs, folder, "newton-artery-increment")
    verdict.claim(again.status == 0 and "1 of 1 items are complete" in again.out
                  and os.stat(record).st_mtime_ns == before, "a complete item is left alone")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
