"""Tunica's C interface for Python: ctypes and NumPy, nothing to compile.

    solver = tunica.Solver(K)                 # any SciPy matrix, or rows of a distributed one
    x = solver.solve(b)
    solver.refresh(K)                         # new values on the same pattern
    print(solver.report().setting)

TUNICA_LIBRARY names libtunica_c.so where the loader does not find it.
"""
import collections
import ctypes
import os

import numpy

SOLVED, BAD_INPUT, NOT_CONVERGED, FAULT = range(4)
Report = collections.namedtuple(
    "Report", "status iterations is_refresh_numeric unknowns residual backward_error setup_seconds refresh_seconds "
    "solve_seconds message setting notes settings")


class _Report(ctypes.Structure):
    """tunica_report of tunica.h."""
    _fields_ = [(name, ctypes.c_int) for name in ("status", "iterations", "is_refresh_numeric", "reserved")] + [
        ("unknowns", ctypes.c_longlong)] + [(name, ctypes.c_double) for name in (
            "residual", "backward_error", "setup_seconds", "refresh_seconds", "solve_seconds")] + [
        (name, ctypes.c_char_p) for name in ("message", "setting", "notes", "settings")]


def _load():
    # Open MPI looks for its own symbols among those of the whole program.
    library = ctypes.CDLL(os.environ.get("TUNICA_LIBRARY", "libtunica_c.so"), mode=ctypes.RTLD_GLOBAL)
    library.tunica_create.restype = ctypes.c_void_p
    library.tunica_create.argtypes = [ctypes.c_longlong] + 5 * [ctypes.c_void_p]
    library.tunica_create.argtypes[4] = ctypes.c_char_p
    library.tunica_refresh.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    library.tunica_solve.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
    library.tunica_query.restype = ctypes.POINTER(_Report)
    library.tunica_query.argtypes = [ctypes.c_void_p]
    library.tunica_destroy.argtypes = [ctypes.c_void_p]
    return library


_library = _load()


class NotSolved(RuntimeError):
    """What went wrong, in the words of the library; x, if any, is the nearest solution."""

    def __init__(self, text, x=None):
        super().__init__(text)
        self.x = x


def _numbers(array, kind):
    return numpy.ascontiguousarray(array, dtype=kind)


class Solver:
    def __init__(self, K, settings=None, communicator=None):
        """K: compressed rows (indptr, indices, data), those of this rank; settings: XML or the path of a file;
        communicator: of mpi4py, for distributed rows."""
        K = K.tocsr() if hasattr(K, "tocsr") else K
        self._rows = len(K.indptr) - 1
        handle = None if communicator is None else ctypes.byref(ctypes.c_int(communicator.py2f()))
        offsets, columns, values = (_numbers(K.indptr, numpy.int64), _numbers(K.indices, numpy.int64),
                                    _numbers(K.data, numpy.float64))
        self._entries = len(values)
        self._solver = _library.tunica_create(
            self._rows, offsets.ctypes.data, columns.ctypes.data, values.ctypes.data,
            None if settings is None else settings.encode(), handle)
        self._check(self.report().status)

    def refresh(self, K):
        """New values in the same places."""
        values = _numbers(K.tocsr().data if hasattr(K, "tocsr") else K.data, numpy.float64)
        if len(values) != self._entries:
            raise ValueError(f"{len(values)} values, expected {self._entries}: is the pattern another one?")
        self._check(_library.tunica_refresh(self._solver, values.ctypes.data))

    def solve(self, b):
        b = _numbers(b, numpy.float64)
        if len(b) != self._rows:
            raise ValueError(f"b has {len(b)} rows, expected {self._rows}")
        x = numpy.zeros(self._rows)
        self._check(_library.tunica_solve(self._solver, b.ctypes.data, x.ctypes.data), x)
        return x

    def report(self):
        one = _library.tunica_query(self._solver).contents
        return Report(**{name: getattr(one, name).decode() if name in Report._fields[-4:] else getattr(one, name)
                         for name in Report._fields})

    def close(self):
        if getattr(self, "_solver", None):
            _library.tunica_destroy(self._solver)
            self._solver = None

    __del__ = close

    def _check(self, status, x=None):
        if status != SOLVED:
            raise NotSolved(self.report().message, x)
