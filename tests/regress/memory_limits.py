"""Too little memory on one rank of two: exit status 3 and one message wherever it runs out.

Usage: memory_limits.py FOLDER_OF_PROGRAMS SCRATCH [LIMITS]
"""
import pathlib
import sys

from runs import ROOT, Run, Verdict, fresh

CASE = ROOT / "xml" / "pulse-coarse.xml"  # takes far more than the program by itself
LIMITED = pathlib.Path(__file__).with_name("limited.py")
SECONDS = 100.0


def limited_run(program, folder, limit, words):
    """The second rank with so many bytes of address space; 0: it leaves its largest in "peak"."""
    all_words = [str(program), *map(str, words)]
    wrapper = ["/usr/bin/python3", str(LIMITED), str(limit), str(folder / "peak")]
    return Run(["mpirun", "--oversubscribe", "-n", "1", *all_words, ":", "-n", "1", *wrapper,
                *all_words], folder)


def peak(program, folder, words):
    run = limited_run(program, folder, 0, words)
    return run.status, int((folder / "peak").read_text())


def main(programs, scratch, n_limits):
    verdict = Verdict()
    folder = fresh(scratch)
    program = programs / "tunica-fsi"
    work = [CASE, "--steps", 1, "--output", "results", "--overwrite"]
    status, least = peak(program, folder, ["--help"])
    verdict.claim(status == 0, f"an idle rank takes {least / 1e6:.0f} MB")
    status, most = peak(program, folder, work)
    verdict.claim(status == 0, f"a working one takes {most / 1e6:.0f} MB")
    statuses = []
    for k in range(n_limits):  # the last one suffices: the same run takes some MB more or less each time
        limit = least + (most - least) * (k + 1) // n_limits if k + 1 < n_limits else most + most // 4
        run = limited_run(program, folder, limit, work)
        told = [line for line in run.err.splitlines() if line.startswith("tunica")]
        print(f"{limit / 1e6:.1f} MB: status {run.status}, {run.seconds:.1f} s: {' | '.join(told)}")
        verdict.claim(run.status in (0, 3), f"{limit / 1e6:.1f} MB: exit status {run.status} is 0 or 3")
        verdict.claim(run.status == 0 or len(told) == 1, f"{limit / 1e6:.1f} MB: {len(told)} messages")
        verdict.claim(run.seconds < SECONDS, f"{limit / 1e6:.1f} MB: it ends within {SECONDS:.0f} s")
        statuses.append(run.status)
    verdict.claim(3 in statuses and statuses[-1] == 0, "some limits are too low, the last suffices")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(),
                  int(sys.argv[3]) if len(sys.argv) > 3 else 5))
