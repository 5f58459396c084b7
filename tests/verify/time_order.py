"""Halving the step of a coupled pulse makes all of its fields better by second order, down to small
steps: BDF2, the default, and the trapezoidal rule, by xml/verification/reproduce on the tiny tube.

Usage: time_order.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import re
import sys

from runs import LONG, ROOT, Run, Verdict, fresh

LEAST = {"displacement": 1.9, "velocity": 1.9, "lumen pressure": 1.8, "wall pressure": 1.8}


def last_orders(page):
    """By quantity, of the last two halvings, at 1 ms."""
    rows = re.findall(r"^\| 1 \| ([a-z ]+) \[[^]]+\] \| [^|]+ \| ([^|]+) \|$", page, re.M)
    return {quantity: float(orders.split()[-1]) for quantity, orders in rows}


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for scheme, halvings in (("bdf2", 5 if LONG else 4), ("trapezoidal", 4 if LONG else 3)):
        output = folder / scheme
        run = Run(["/usr/bin/python3", ROOT / "xml" / "verification" / "reproduce", "--programs", programs,
                   "--output", output, "--page", output, "--meshes", "tiny", "--end", "1",
                   "--halvings", str(halvings), "--only", f"tiny-smooth-{scheme}"], folder)
        if not verdict.claim(run.status == 0, f"{scheme}: the series ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            continue
        found = last_orders((output / "RESULTS.md").read_text(encoding="utf-8"))
        for quantity, least in LEAST.items():
            verdict.claim(found.get(quantity, 0.0) > least,
                          f"{scheme}: the {quantity} is of order {found.get(quantity)}, more than {least}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
