"""The installed programs run the installed cases and draw the report, wherever they are moved to.

Usage: installed_programs.py SOURCE BUILD CMAKE
"""
import pathlib
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
