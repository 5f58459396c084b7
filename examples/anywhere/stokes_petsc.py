#!/usr/bin/python3
"""Tunica as a preconditioner of PETSc: flexible GMRES on a Stokes problem, whose shell hands each residual to Tunica.

    python3 stokes_petsc.py [CELLS] [options of PETSc]
    mpirun -n 2 python3 stokes_petsc.py

Exit status: 0 converged, 1 not.
"""
import sys

import petsc4py

petsc4py.init(sys.argv)
from flow import stokes  # noqa: E402
from petsc4py import PETSc  # noqa: E402

import tunica  # noqa: E402

# A preconditioner needs no more than a digit.
SETTINGS = """<ParameterList name="Case">
  <ParameterList name="Solvers"> <Parameter name="tolerance" type="double" value="0.1"/> </ParameterList>
</ParameterList>"""


class Rows:
    """Those of this rank."""

    def __init__(self, matrix):
        self.indptr, self.indices, self.data = matrix.getValuesCSR()


class Shell:
    """PETSc calls it when the matrix is new or changed, and for each residual."""
    solver = None

    def setUp(self, pc):
        _, matrix = pc.getOperators()
        if self.solver is None:
            self.solver = tunica.Solver(Rows(matrix), SETTINGS, matrix.getComm().tompi4py())
        else:
            self.solver.refresh(Rows(matrix))

    def apply(self, pc, residual, correction):
        correction.setArray(self.solver.solve(residual.getArray()))


def distributed(K, b):
    matrix = PETSc.Mat().createAIJ(K.shape, nnz=27)
    first, last = matrix.getOwnershipRange()
    mine = K[first:last]
    matrix.setPreallocationCSR((mine.indptr.astype(PETSc.IntType), mine.indices.astype(PETSc.IntType), mine.data))
    matrix.assemble()
    x, right = matrix.createVecs()
    right.setArray(b[first:last])
    return matrix, x, right


def main():
    n = next((int(word) for word in sys.argv[1:] if word.isdigit()), 32)
    K, b = stokes(n)
    matrix, x, right = distributed(K, b)
    ksp = PETSc.KSP().create()
    ksp.setOperators(matrix)
    ksp.setType(PETSc.KSP.Type.FGMRES)
    ksp.getPC().setType(PETSc.PC.Type.PYTHON)
    shell = Shell()
    ksp.getPC().setPythonContext(shell)
    ksp.setTolerances(rtol=1e-10)
    ksp.setFromOptions()
    ksp.solve(right, x)
    residual = right.copy()
    matrix.multAdd(-x, right, residual)
    relative = residual.norm() / right.norm()
    PETSc.Sys.Print(f"{K.shape[0]} unknowns, {shell.solver.report().setting}: {ksp.getIterationNumber()} iterations of "
                    f"FGMRES, residual {relative:.1e}")
    return 0 if ksp.getConvergedReason() > 0 and relative < 1e-8 else 1


if __name__ == "__main__":
    sys.exit(main())
