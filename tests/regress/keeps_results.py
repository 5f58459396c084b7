"""What runs shipped cases in a row does not remove results that it cannot finish.

Usage: keeps_results.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import shutil
import sys

from runs import ROOT, Run, Verdict, fresh


def refuses(verdict, name, words, folder, results):
    results.mkdir(parents=True)
    (results / "run.json").write_text('{"status": "running"}')
    (results / "steps.csv").write_text("hours of work")
    done = Run([str(word) for word in words], folder)
    verdict.claim(done.status != 0 and "--overwrite" in done.err, f"{name}: stops and asks: {done.err.strip()}")
    verdict.claim((results / "steps.csv").read_text() == "hours of work", f"{name}: the results are still there")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    case = ROOT / "xml" / "verification" / "reproduce"
    refuses(verdict, "verification", [case, "--programs", programs, "--output", folder / "verification", "--only",
                                      "tiny-smooth-bdf2", "--page", folder], folder,
            folder / "verification" / "tiny-smooth-bdf2-0")
    refuses(verdict, "paper", [ROOT / "xml" / "paper" / "reproduce", "krylov-fluid", "--output",
                               folder / "paper", "--build", programs.parent], folder,
            folder / "paper" / "coarse" / "krylov-fluid")
    # With programs that do nothing the script comes as far as its results.
    home = folder / "home"
    (home / "cmake").mkdir(parents=True)
    (home / "cmake" / "setup.sh").write_text('cores=1\nstage() { echo "$@"; }\ninstall_packages() { :; }\nbuild() { :; }\n')
    shutil.copy(ROOT / "quickstart", home / "quickstart")
    refuses(verdict, "quickstart", [home / "quickstart"], folder, home / "results" / "pulse")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
