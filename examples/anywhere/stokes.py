#!/usr/bin/python3
"""Stokes flow by Tunica from Python: python3 stokes.py [CELLS]

Exit status: 0 all is as expected, 1 not.
"""
import sys

import numpy
from flow import stokes

import tunica


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 32
    K, b = stokes(n)
    solver = tunica.Solver(K)
    print(solver.report().notes, end="")
    x = solver.solve(b)
    report = solver.report()
    residual = numpy.linalg.norm(b - K @ x) / numpy.linalg.norm(b)
    print(f"{report.unknowns} unknowns, {report.setting}: {report.iterations} iterations, residual {residual:.1e}")

    # Twice the viscosity: half the velocities, the same pressures.
    twice, _ = stokes(n, 2.0)
    solver.refresh(twice)
    y = solver.solve(b)
    y.reshape(-1, 3)[:, 1:] *= 2.0
    apart = numpy.abs(x - y).max()
    report = solver.report()
    print(f"twice the viscosity, half the velocity: {apart:.1e} apart")
    print(f"set-up {report.setup_seconds:.3f} s, refresh {report.refresh_seconds:.3f} s, solve {report.solve_seconds:.3f} s")

    try:
        solver.solve(numpy.full(len(b), numpy.nan))
        is_refused = False
    except tunica.NotSolved as refusal:
        is_refused = True
        print(f"refused: {refusal}")
    return 0 if residual < 1e-7 and apart < 1e-6 and report.is_refresh_numeric and is_refused else 1


if __name__ == "__main__":
    sys.exit(main())
