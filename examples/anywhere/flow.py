"""Stokes flow through the unit square in a few lines of SciPy: bilinear elements for velocities and pressure, stabilised
after Brezzi and Pitkäranta, as in stokes.c."""
import numpy
import scipy.sparse as sparse


def line(n):
    """Mass, stiffness and derivative of the functions of n cells on (0, 1)."""
    h = 1.0 / n
    cells = sparse.vstack([sparse.eye(n, n + 1), sparse.eye(n, n + 1, k=1)]).tocsr()

    def matrix(cell):
        return (cells.T @ sparse.kron(numpy.array(cell), sparse.eye(n)) @ cells).tocsr()

    return (matrix([[h / 3, h / 6], [h / 6, h / 3]]), matrix([[1 / h, -1 / h], [-1 / h, 1 / h]]),
            matrix([[-0.5, -0.5], [0.5, 0.5]]))


def stokes(n, viscosity=1.0):
    """K in the order 3 * node + {p, u, v}, and b; prescribed values stand in rows of their own."""
    mass, stiffness, slope = line(n)
    A = sparse.kron(mass, stiffness) + sparse.kron(stiffness, mass)
    Bx, By = -sparse.kron(mass, slope.T), -sparse.kron(slope.T, mass)
    C = A / (12.0 * n * n * viscosity)
    K = sparse.bmat([[-C, Bx, By], [Bx.T, viscosity * A, None], [By.T, None, viscosity * A]], format="lil")
    m = (n + 1) ** 2
    x, y = numpy.arange(m) % (n + 1), numpy.arange(m) // (n + 1)
    fixed = numpy.flatnonzero((x == 0) | (y == 0) | (y == n))
    b = numpy.concatenate([numpy.zeros(m), numpy.asarray(sparse.kron(mass, mass).sum(axis=1)).ravel(), numpy.zeros(m)])
    for rows in (m + fixed, 2 * m + fixed):
        K[rows] = 0.0
        K[rows, rows] = 1.0
        b[rows] = 0.0
    order = numpy.arange(3 * m).reshape(3, m).T.ravel()  # field after field -> node by node
    K = K.tocsr()[order][:, order]
    K.sort_indices()
    return K, b[order]
