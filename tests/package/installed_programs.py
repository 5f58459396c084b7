"""The installed programs run the installed cases and draw the report, wherever they are moved to.

Usage: installed_programs.py SOURCE BUILD CMAKE
"""
import pathlib
import re
import shutil
import sys
import tempfile

from installation import SOURCE, Run, Verdict, build_against, install_and_move
from runs import command


def run_the_example(verdict, prefix, mesh, scratch):
    """examples/fsi knows nothing of the source tree: a law and a load of its own, and a probe."""
    folder = scratch / "fsi"
    shutil.copytree(SOURCE / "examples" / "fsi", folder)
    build_against(prefix, folder, folder / "build", scratch)
    program, case, mesh_key = folder / "build" / "fsi", folder / "case.xml", f"Mesh/file={mesh}"
    run = Run(command(program, [case, scratch / "squeezed", mesh_key], 2), scratch)
    moved = [float(line.split(":")[1].split()[0]) for line in run.out.splitlines()]
    verdict.claim(run.status == 0 and len(moved) == 8, f"a case with a law and a load of its own runs {run.err}")
    verdict.claim(moved and min(moved) < -0.005, f"the squeeze narrows the vessel: {moved}")
    stiff = Run(command(program, [case, scratch / "stiff", mesh_key, "Wall/Layers/media/mu=90",
                                  "Wall/Layers/adventitia/mu=90"], 2), scratch)
    less = [float(line.split(":")[1].split()[0]) for line in stiff.out.splitlines()]
    verdict.claim(less and 0.0 > min(less) > 0.8 * min(moved), f"a stiffer wall by less: {less}")


def cases_are_whole(verdict, programs, shared, scratch):
    """Each case is as in the source tree and finds its files, so that a check of one of each folder, and of those that name no
    file, tells of all: tests/house/shipped_cases.sh checks each in the source tree."""
    installed, shipped = (sorted(path.relative_to(root) for path in (root / "xml").rglob("*.xml")) for root in (shared, SOURCE))
    verdict.claim(installed == shipped, f"{len(installed)} of {len(shipped)} cases are installed")
    checked = {}
    for case in installed:
        text = (shared / case).read_text(encoding="utf-8")
        files = re.findall(r'name="file"[^>]*value="([^"]+)"', text)
        verdict.claim(text == (SOURCE / case).read_text(encoding="utf-8")
                      and all((shared / case.parent / file).is_file() for file in files),
                      f"{case} is the shipped one, and so many files of it are there: {len(files)}")
        checked[case.parent if files else case] = case
    for case in checked.values():
        check = Run(command(programs / "tunica-check", [shared / case]), scratch)
        verdict.claim(check.status == 0, f"{case} is valid {check.err}")


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-package-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("fsi", scratch)
        programs, shared = prefix / "bin", prefix / "share" / "tunica"

        cases_are_whole(verdict, programs, shared, scratch)
        run_the_example(verdict, prefix, shared / "meshes" / "tube-tiny.h5", scratch)
        run = Run(command(programs / "tunica-fsi", [shared / "xml" / "pulse-tiny.xml", "--steps", "1",
                                                    "--output", scratch / "out"], 2), scratch)
        verdict.claim(run.status == 0, f"the pulse runs on 2 ranks {run.err}")
        report = Run([str(programs / "tunica-report"), str(scratch / "out")], scratch)
        verdict.claim(report.status == 0 and (scratch / "out" / "report" / "index.html").exists(),
                      f"the report is drawn {report.err}")
        wall = Run([str(programs / "tunica-import"), str(shared / "meshes" / "block.h5"), str(scratch / "block.h5")], scratch)
        verdict.claim(wall.status == 0 and (scratch / "block.h5").exists(), f"a mesh is imported {wall.err}")
        lumen = Run([str(programs / "tunica-mesh"), "lumen", "--help"], scratch)
        verdict.claim(lumen.status == 0 and "--thinnest" in lumen.out, f"the command lumen finds its program {lumen.err}")
        vessel = Run([str(programs / "tunica-vessel"), str(scratch / "block.h5"), "--output", str(scratch / "vessel")], scratch)
        verdict.claim(vessel.status == 1 and "regions" in vessel.err, f"tunica-vessel knows a lumen from a block {vessel.err}")
        certify = Run([str(programs / "tunica-certify"), str(shared / "xml" / "pulse-tiny.xml"), "--dry-run"], scratch)
        verdict.claim(certify.status == 0 and "mesh-2" in certify.out, f"tunica-certify plans {certify.err}")
        paper = Run([str(shared / "xml" / "paper" / "reproduce"), "--list"], scratch)
        verdict.claim(paper.status == 0, f"the items of the paper are listed {paper.err}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
