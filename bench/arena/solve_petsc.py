"""Solves a system of the arena by PETSc, through petsc4py, and writes the solution; one line of JSON says how.

Usage: [mpirun -n RANKS] solve_petsc.py FOLDER SOLUTION OPTIONS
"""
import json
import sys
import time

import numpy
import petsc4py
import scipy.sparse as sparse

import system as systems

TOLERANCE = 1e-8
MOST_SOLVES = 6


def portions(n, size):
    return [n * k // size for k in range(size + 1)]


def dealt(system, size):
    """The unknowns of each rank, its part of each field, and how the first field is turned: the components of a vector side by
    side."""
    first, *others = system.fields.values()
    turned, width = numpy.arange(len(first)), system.components
    if width > 1 and not system.is_by_node:
        turned = turned.reshape(width, -1).T.ravel()
    cuts = [[width * c for c in portions(len(first) // width, size)]] + [portions(len(f), size) for f in others]
    return [[rows[cut[r]:cut[r + 1]] for rows, cut in zip([first[turned]] + others, cuts)] for r in range(size)], turned


def matrix(PETSc, K, begin, end):
    part = K[begin:end]
    A = PETSc.Mat().createAIJ(((end - begin, K.shape[0]), (end - begin, K.shape[1])),
                              csr=(part.indptr, part.indices, part.data))
    A.assemble()
    return A


class Dealt:
    """The system in PETSc's matrices, each rank with its own rows."""

    def __init__(self, PETSc, system):
        self.rank, size = PETSc.COMM_WORLD.rank, PETSc.COMM_WORLD.size
        parts, turned = dealt(system, size)
        self.order = numpy.concatenate([rows for part in parts for rows in part])
        sizes = [[len(rows) for rows in part] for part in parts]
        self.begin = sum(map(sum, sizes[:self.rank]))
        self.end = self.begin + sum(sizes[self.rank])
        self.K = system.K[self.order][:, self.order].tocsr()
        self.b = system.b[self.order]
        self.A = matrix(PETSc, self.K, self.begin, self.end)
        place = numpy.argsort(self.order)
        self.fields = {name: place[rows] for name, rows in system.fields.items()}
        self.sets = []
        offset = self.begin
        for count in sizes[self.rank]:
            self.sets.append(PETSc.IS().createStride(count, offset, 1))
            offset += count
        self.sets[0].setBlockSize(system.components)
        for name in system.constants:
            vector = self.A.createVecRight()
            mine = self.fields[name]
            mine = mine[(mine >= self.begin) & (mine < self.end)] - self.begin
            vector.array[mine] = 1.0
            vector.normalize()
            self.A.setNullSpace(PETSc.NullSpace().create(vectors=[vector]))
        cut = [sum(counts[0] for counts in sizes[:r]) for r in (self.rank, self.rank + 1)]
        modes = [] if system.rigid is None else system.rigid[turned].T
        self.modes = [PETSc.Vec().createWithArray(numpy.array(mode[cut[0]:cut[1]])) for mode in modes]


def set_up(PETSc, held, system, is_given):
    solver = PETSc.KSP().create()
    solver.setOperators(held.A)
    solver.setTolerances(rtol=TOLERANCE, atol=1e-300, max_it=500)
    solver.setFromOptions()
    pc = solver.getPC()
    if pc.getType() == "fieldsplit":
        pc.setFieldSplitIS(("0", held.sets[0]), ("1", held.sets[1]))
        if held.modes:
            basis = orthonormal(PETSc, held.modes)
            held.sets[0].compose("nearnullspace", basis)
        if is_given:
            cut = portions(system.schur.shape[0], PETSc.COMM_WORLD.size)[held.rank:held.rank + 2]
            pc.setFieldSplitSchurPreType(PETSc.PC.SchurPreType.USER, matrix(PETSc, sparse.csr_matrix(-system.schur), *cut))
    solver.setUp()
    solver.setUpOnBlocks()
    return solver


def orthonormal(PETSc, vectors):
    for k, vector in enumerate(vectors):
        for other in vectors[:k]:
            vector.axpy(-vector.dot(other), other)
        vector.normalize()
    return PETSc.NullSpace().create(vectors=vectors)


def solve(PETSc, solver, held):
    """Solves for what is left until the arena's judge is content; returns x, the iterations and the last reason."""
    total, x, iterations, reason = numpy.zeros(len(held.b)), held.A.createVecRight(), 0, 0
    right = held.A.createVecLeft()
    before = numpy.inf
    for _ in range(MOST_SOLVES):
        r = held.b - held.K @ total
        right.array[:] = r[held.begin:held.end]
        solver.solve(right, x)
        reason = solver.getConvergedReason()
        iterations += solver.getIterationNumber()
        scatter, whole = PETSc.Scatter.toAll(x)
        scatter.scatter(x, whole, addv=False)
        total = total + whole.array
        left = numpy.linalg.norm(held.b - held.K @ total)
        if systems.is_solved(held.K, held.b, total, held.fields, TOLERANCE) or not left < 0.5 * before:
            break
        before = left
    return total, iterations, reason


def sum_of(PETSc, number):
    """Over the ranks."""
    vector = PETSc.Vec().createMPI((1, PETSc.COMM_WORLD.size))
    vector.array[:] = number
    return vector.sum()


def main():
    folder, path, options = sys.argv[1:4]
    petsc4py.init(["arena"] + options.split())
    from petsc4py import PETSc
    system = systems.read(folder)
    held = Dealt(PETSc, system)
    started = time.process_time()
    solver = set_up(PETSc, held, system, "-arena_schur_given" in options)
    prepared = time.process_time()
    x, iterations, reason = solve(PETSc, solver, held)
    ended = time.process_time()
    seconds = [sum_of(PETSc, number) for number in (prepared - started, ended - prepared)]
    found = {"setup": seconds[0], "solve": seconds[1], "iterations": iterations,
             "message": "" if reason > 0 else f"KSPConvergedReason {reason}"}
    if held.rank == 0:
        back = numpy.empty(len(x))
        back[held.order] = x
        numpy.save(path, back)
        print(json.dumps(found))


if __name__ == "__main__":
    main()
