"""Solves a system of the arena by SciPy's SuperLU and writes the solution; one line of JSON says how.

Usage: solve_scipy.py FOLDER SOLUTION
"""
import json
import sys
import time

import numpy
import scipy.sparse as sparse
import scipy.sparse.linalg

import system as systems


def main():
    folder, path = sys.argv[1:3]
    system = systems.read(folder)
    K, b = system.K.tocsc(), system.b.copy()
    for name in system.constants:  # one value of a field that is known but for a constant
        fixed = numpy.zeros(system.n)
        fixed[system.fields[name][0]] = 1.0
        K = (sparse.diags(1 - fixed) @ K @ sparse.diags(1 - fixed) + sparse.diags(fixed)).tocsc()
        b = b * (1 - fixed)
    started = time.process_time()
    factors = scipy.sparse.linalg.splu(K)
    prepared = time.process_time()
    x, solves = numpy.zeros(system.n), 0
    for _ in range(4):
        x += factors.solve(b - K @ x)
        solves += 1
        if systems.is_solved(system.K, system.b, x, system.fields):
            break
    numpy.save(path, x)
    print(json.dumps({"setup": prepared - started, "solve": time.process_time() - prepared, "iterations": solves, "message": ""}))


if __name__ == "__main__":
    main()
