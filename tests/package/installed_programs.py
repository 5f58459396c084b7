"""The installed programs run the installed cases and draw the report, wherever they are moved to.

Usage: installed_programs.py SOURCE BUILD CMAKE
"""
import pathlib
import shutil
import sys
import tempfile

from installation import CMAKE, SOURCE, Run, Verdict, install_and_move, must
from runs import command


def run_the_example(verdict, prefix, case, scratch):
    """examples/fsi knows nothing of the source tree."""
    folder = scratch / "fsi"
    shutil.copytree(SOURCE / "examples" / "fsi", folder)
    must([CMAKE, "-S", folder, "-B", folder / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"], scratch)
    must([CMAKE, "--build", folder / "build"], scratch)
    run = Run(command(folder / "build" / "fsi", [case, scratch / "side-by-side"], 2), scratch)
    lines = run.out.splitlines()
    verdict.claim(run.status == 0 and len(lines) > 2, f"two vessels run side by side {run.err}")
    moved = [[float(word) for word in line.split(":")[1].replace("mm", "").split("and")] for line in lines]
    verdict.claim(all(soft > stiff > 0.0 for soft, stiff in moved), f"the softer wall moves further: {lines[-1:]}")


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-package-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("fsi", scratch)
        programs, shared = prefix / "bin", prefix / "share" / "tunica"

        cases = sorted((shared / "xml").rglob("*.xml"))
        shipped = sorted((SOURCE / "xml").rglob("*.xml"))
        verdict.claim(len(cases) == len(shipped), f"{len(cases)} of {len(shipped)} cases are installed")
        for case in cases:
            check = Run(command(programs / "tunica-check", [case]), scratch)
            verdict.claim(check.status == 0, f"{case.name} is valid {check.err}")

        run_the_example(verdict, prefix, shared / "xml" / "pulse-tiny.xml", scratch)
        run = Run(command(programs / "tunica-fsi", [shared / "xml" / "pulse-tiny.xml", "--steps", "1",
                                                    "--output", scratch / "out"], 2), scratch)
        verdict.claim(run.status == 0, f"the pulse runs on 2 ranks {run.err}")
        report = Run([str(programs / "tunica-report"), str(scratch / "out")], scratch)
        verdict.claim(report.status == 0 and (scratch / "out" / "report" / "index.html").exists(),
                      f"the report is drawn {report.err}")
        wall = Run([str(programs / "tunica-import"), str(shared / "meshes" / "block.h5"), str(scratch / "block.h5")], scratch)
        verdict.claim(wall.status == 0 and (scratch / "block.h5").exists(), f"a mesh is imported {wall.err}")
        paper = Run([str(shared / "xml" / "paper" / "reproduce"), "--list"], scratch)
        verdict.claim(paper.status == 0, f"the items of the paper are listed {paper.err}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
