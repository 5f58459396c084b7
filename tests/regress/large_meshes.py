"""Meshes that no rank has as a whole: made, read, cut and marched on several ranks. Memory stays near
what the rows of a rank take, counts of iterations do not grow with the ranks, with either scheme, and a dry
run tells what a run takes.

Usage: large_meshes.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import json
import pathlib
import re
import sys

import h5py

from runs import LONG, ROOT, Run, Verdict, command, fresh, table

COARSE = ROOT / "meshes" / "tube-coarse.h5"
TETS = 39060
PROGRAM = 150  # MB that a rank has whatever the mesh
RANKS = (1, 2, 4) if LONG else (1, 4)
# Files of 32 MiB, half of what the mesh takes; what MPI itself maps is smaller.
LIMIT = ("import os, resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (2**25, 2**25)); "
         "os.execv(sys.argv[1], sys.argv[1:])")


def refined(verdict, programs, folder):
    words = ["refine", COARSE, "fine.h5", "--project", "interface,layer,outer"]
    run = Run(command(programs / "tunica-mesh", words, 3), folder)
    verdict.claim(run.status == 0 and f"{8 * TETS} tetrahedra" in run.out,
                  "three ranks refine a mesh: " + run.out.strip())
    return folder / "fine.h5"


def parts(verdict, programs, folder, mesh, ranks, size):
    """What each rank gets, as told by the program."""
    words = ["partition", mesh, "--by", "geometric"]
    run = Run(command(programs / "tunica-mesh", words, ranks), folder)
    rows = [[int(word) for word in line.split()] for line in run.out.splitlines()
            if re.fullmatch(r"[\d ]+", line)]
    verdict.claim(run.status == 0 and len(rows) == ranks, f"{ranks} ranks share the mesh")
    verdict.claim(sum(row[1] for row in rows) == 8 * TETS, "together they count all tetrahedra")
    most = 1.5 * size / ranks / 2**20 + PROGRAM
    peak = max(row[5] for row in rows)
    verdict.claim(peak <= most, f"{ranks} ranks: at most {peak} MB each, permitted {most:.0f}")
    fluid, wall, cut = (float(number) for number in re.search(
        r"fluid (\S+), wall (\S+); (\S+) %", run.out).groups())
    verdict.claim(max(fluid, wall) < 1.03, f"{ranks} ranks: fluid {fluid}, wall {wall} of the mean")
    verdict.claim(cut < 2.0 * ranks, f"{ranks} ranks: {cut} % of the tetrahedra are cut")


def of_text(verdict, programs, folder, mesh):
    """A text file passes rank 0 in pieces: no rank has more of it than of our own format."""
    text, again = folder / "fine.msh", folder / "again.h5"
    Run(command(programs / "tunica-mesh", ["convert", mesh, text], 1), folder)
    run = Run(command(programs / "tunica-mesh", ["convert", text, again], 4), folder)
    verdict.claim(run.status == 0, "four ranks convert text: " + run.out.strip())
    with h5py.File(mesh) as one, h5py.File(again) as other:
        verdict.claim(set(one) == set(other) and all((one[k][()] == other[k][()]).all() for k in one),
                      "and have what was written")
    again.unlink()
    parts(verdict, programs, folder, text, 4, mesh.stat().st_size)
    text.unlink()


def damaged(verdict, programs, folder, mesh):
    with h5py.File(mesh, "r+") as file:
        tets = file["tets"]
        tet = tets[1000]
        tets[1000] = tet[[1, 0, 2, 3]]
    words = [ROOT / "xml" / "pulse.xml", "--set", f"Mesh/file={mesh}"]
    run = Run(command(programs / "tunica-check", words, 3), folder)
    refined = Run(command(programs / "tunica-mesh", ["refine", mesh, "finer.h5"], 3), folder)
    for done in (run, refined):
        told = done.err.count("inverted element: tetrahedron 1000 of region")
        verdict.claim(done.status == 1 and told == 1 and str(mesh) in done.err,
                      f"an inverted tetrahedron is told {told} times: "
                      + (done.err.splitlines() or ["nothing"])[0])
    verdict.claim(not (folder / "finer.h5").exists(), "and not refined")


def no_room(verdict, programs, folder):
    """A file that may not grow ends all ranks, and leaves what was there."""
    (folder / "kept.h5").write_bytes(b"kept")
    words = ["-c", LIMIT, programs / "tunica-mesh", "refine", COARSE, "kept.h5", "--times", 2,
             "--overwrite", "on"]
    run = Run(command(sys.executable, words, 2), folder)
    verdict.claim(run.status == 3 and run.err.count("no room for") == 1,
                  "without room two ranks end with 3: " + (run.err.splitlines() or ["nothing"])[0])
    verdict.claim((folder / "kept.h5").read_bytes() == b"kept", "what was there is there")
    verdict.claim(not (folder / "kept.h5.tmp").exists(), "no draft stays behind")


def alone(verdict, programs, folder):
    """What one rank does is refused to several, which would write one file."""
    run = Run(command(programs / "tunica-mesh", ["tube", "twice.h5"], 2), folder)
    verdict.claim(run.status == 1 and run.err.count("tube runs on one rank, not on 2") == 1,
                  "two ranks make no tube: " + (run.err.splitlines() or ["nothing"])[0])
    verdict.claim(not (folder / "twice.h5").exists(), "and write nothing")


def marched(verdict, programs, folder):
    effort = {}
    for ranks in RANKS:
        words = [ROOT / "xml" / "pulse.xml", "--set", f"Mesh/file={COARSE}",
                 "--set", "Mesh/partitioner=geometric", "--steps", 2 if LONG else 1]
        dry = Run(command(programs / "tunica-fsi", words + ["--dry-run"], ranks), folder)
        told = re.search(r"memory: about (\S+) (MB|GB)", dry.out)
        expected = float(told[1]) * {"MB": 1, "GB": 1000}[told[2]]
        results = folder / f"ranks-{ranks}"
        run = Run(command(programs / "tunica-fsi", words + ["--output", results], ranks), folder)
        verdict.claim(run.status == 0, f"{ranks} ranks march")
        record = json.loads((results / "run.json").read_text())
        found = record["memory"]["peak of one rank [MB]"]
        verdict.claim(abs(found - expected) < 0.25 * found,
                      f"{ranks} ranks: {expected:.0f} MB expected on a rank, {found:.0f} found")
        phases = list(record["memory by phase [MB]"].values())
        verdict.claim(len(phases) >= 8 and all(len(of_ranks) == ranks for of_ranks in phases),
                      f"{ranks} ranks tell their memory in {len(phases)} phases")
        verdict.claim(all(list(peaks) == sorted(peaks) for peaks in zip(*phases)),
                      "and the peaks of each grow")
        steps = table(results / "steps.csv")
        effort[ranks] = sum(steps["system_linear"])
        verdict.claim(effort[ranks] <= 1.1 * effort[1],
                      f"{ranks} ranks: {effort[ranks]:.0f} iterations, {effort[1]:.0f} on one")


def partitioned(verdict, programs, folder):
    """The fields, each solved for itself, on as many ranks as few cores bear."""
    effort = {}
    for ranks in (1, 4, 16) if LONG else (1, 4):
        results = folder / f"partitioned-{ranks}"
        words = [ROOT / "xml" / "pulse.xml", "--set", f"Mesh/file={COARSE}", "--set", "Coupling/scheme=dirichlet-neumann",
                 "--set", "Output/fields every=0", "--steps", 1, "--output", results]
        run = Run(command(programs / "tunica-fsi", words, ranks), folder)
        verdict.claim(run.status == 0, f"{ranks} ranks solve for one field after the other")
        steps = table(results / "steps.csv")
        effort[ranks] = {field: sum(steps[f"{field}_linear"]) for field in ("fluid", "wall")}
        most = 1.15 if ranks == 16 else 1.1  # a rank of sixteen has few nodes that are not next to another's
        for field, iterations in effort[ranks].items():
            verdict.claim(iterations <= most * effort[1][field],
                          f"{ranks} ranks: {iterations:.0f} iterations of the {field}, {effort[1][field]:.0f} on one")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    mesh = refined(verdict, programs, folder)
    for ranks in (2, 4) if LONG else (4,):
        parts(verdict, programs, folder, mesh, ranks, mesh.stat().st_size)
    of_text(verdict, programs, folder, mesh)
    damaged(verdict, programs, folder, mesh)
    no_room(verdict, programs, folder)
    alone(verdict, programs, folder)
    marched(verdict, programs, folder)
    partitioned(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
