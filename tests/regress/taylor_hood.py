"""A Stokes problem as another code would hand it over: Taylor-Hood elements in the plane.

Flow through the unit square from a parabolic profile on the left to an open end on the right.
Velocities are numbered by component, there is no stabilisation, and pressures live on fewer nodes
than velocities. Plain Python, no code in common with the suite.

Usage: taylor_hood.py FOLDER DIVISIONS
"""
import pathlib
import random
import sys

VISCOSITY = 1.0
# Midpoints of the edges: exact for quadratic functions, with weights of a third of the area.
POINTS = ((0.5, 0.5, 0.0), (0.0, 0.5, 0.5), (0.5, 0.0, 0.5))


def triangles(n):
    """Corners and midpoints in the grid of half cells, each triangle twice the six points."""
    for j in range(0, 2 * n, 2):
        for i in range(0, 2 * n, 2):
            for a, b, c in (((i, j), (i + 2, j), (i + 2, j + 2)), ((i, j), (i + 2, j + 2), (i, j + 2))):
                middle = [((p[0] + q[0]) // 2, (p[1] + q[1]) // 2) for p, q in ((a, b), (b, c), (c, a))]
                yield [a, b, c] + middle


def barycentric_gradients(a, b, c, h):
    area2 = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) * h * h
    pairs = ((b, c), (c, a), (a, b))
    return [((p[1] - q[1]) * h / area2, (q[0] - p[0]) * h / area2) for p, q in pairs], area2 / 2


def quadratic_gradients(g, l):
    corner = [[(4 * l[k] - 1) * g[k][d] for d in (0, 1)] for k in range(3)]
    edge = [[4 * (l[p] * g[q][d] + l[q] * g[p][d]) for d in (0, 1)] for p, q in ((0, 1), (1, 2), (2, 0))]
    return corner + edge


def add(matrix, i, j, value):
    row = matrix.setdefault(i, {})
    row[j] = row.get(j, 0.0) + value


def assemble(n):
    """A, B2 as {row: {column: value}}, and the numbers of unknowns."""
    wide = 2 * n + 1
    n_nodes = wide * wide
    h = 0.5 / n
    A, B2 = {}, {}
    for points in triangles(n):
        g, area = barycentric_gradients(*points[:3], h)
        u = [p[1] * wide + p[0] for p in points]
        q = [p[1] // 2 * (n + 1) + p[0] // 2 for p in points[:3]]
        for l in POINTS:
            w = area / 3
            dphi = quadratic_gradients(g, l)
            for a in range(6):
                for b in range(6):
                    value = VISCOSITY * w * (dphi[a][0] * dphi[b][0] + dphi[a][1] * dphi[b][1])
                    for d in (0, 1):
                        add(A, d * n_nodes + u[a], d * n_nodes + u[b], value)
                for k in range(3):
                    for d in (0, 1):
                        add(B2, q[k], d * n_nodes + u[a], -w * l[k] * dphi[a][d])
    return A, B2, n_nodes, (n + 1) * (n + 1)


def fixed_values(n):
    wide = 2 * n + 1
    fixed = {}
    for j in range(wide):
        for i in range(wide):
            if i > 0 and 0 < j < wide - 1:
                continue
            y = j * 0.5 / n
            fixed[j * wide + i] = 4 * y * (1 - y) if i == 0 else 0.0
            fixed[wide * wide + j * wide + i] = 0.0
    return fixed


def eliminate(matrix, rhs, fixed, has_fixed_rows):
    """Moves known values to the right-hand side."""
    for i, row in matrix.items():
        for j in [j for j in row if j in fixed and j != i]:
            rhs[i] -= row.pop(j) * fixed[j]
        if has_fixed_rows and i in fixed:
            row.clear()
            row[i] = 1.0
            rhs[i] = fixed[i]
        elif not has_fixed_rows and i in row and i in fixed:  # a column, not a diagonal
            rhs[i] -= row.pop(i) * fixed[i]


def write_matrix(path, matrix, n_rows, n_columns):
    entries = [(i, j, v) for i in sorted(matrix) for j, v in sorted(matrix[i].items()) if v != 0.0]
    with open(path, "w") as file:
        file.write(f"%%MatrixMarket matrix coordinate real general\n{n_rows} {n_columns} {len(entries)}\n")
        file.writelines(f"{i + 1} {j + 1} {v:.17g}\n" for i, j, v in entries)


def renumbered(matrix, rows, columns):
    return {rows[i]: {columns[j]: v for j, v in row.items()} for i, row in matrix.items()}


def orders(order, n_nodes, n_pressures):
    """New numbers of velocities and pressures; "shuffled" is neither by node nor by component."""
    n = 2 * n_nodes
    if order == "by node":
        return [2 * (k % n_nodes) + k // n_nodes for k in range(n)], list(range(n_pressures))
    if order == "shuffled":
        shuffle = random.Random(1).sample
        return shuffle(range(n), n), shuffle(range(n_pressures), n_pressures)
    return list(range(n)), list(range(n_pressures))


def write_system(folder, n, order="by component"):
    """A.mtx, B2.mtx, rhs.mtx and nodes.txt, the map of unknowns to nodes and components."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    A, B2, n_nodes, n_pressures = assemble(n)
    fixed = fixed_values(n)
    b, d = [0.0] * (2 * n_nodes), [0.0] * n_pressures
    eliminate(A, b, fixed, True)
    eliminate(B2, d, fixed, False)
    u, p = orders(order, n_nodes, n_pressures)
    A, B2 = renumbered(A, u, u), renumbered(B2, p, u)
    b = [b[k] for k in sorted(range(len(b)), key=u.__getitem__)]
    d = [d[k] for k in sorted(range(len(d)), key=p.__getitem__)]
    with open(folder / "nodes.txt", "w") as file:
        file.writelines(f"{k % n_nodes} {k // n_nodes}\n"
                        for k in sorted(range(2 * n_nodes), key=u.__getitem__))
        file.writelines(f"{k}\n" for k in sorted(range(n_pressures), key=p.__getitem__))
    write_matrix(folder / "A.mtx", A, 2 * n_nodes, 2 * n_nodes)
    write_matrix(folder / "B2.mtx", B2, n_pressures, 2 * n_nodes)
    with open(folder / "rhs.mtx", "w") as file:
        file.write(f"%%MatrixMarket matrix array real general\n{len(b) + len(d)} 1\n")
        file.writelines(f"{value:.17g}\n" for value in b + d)


if __name__ == "__main__":
    write_system(sys.argv[1], int(sys.argv[2]))
