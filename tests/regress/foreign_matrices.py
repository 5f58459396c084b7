"""tunica-solvers on one matrix and one right-hand side as other programs write them: with prescribed values in rows of
their own, penalties, rounding for entries, other units, an undetermined pressure, a diagonal, and unknowns in any order.

Usage: foreign_matrices.py FOLDER_OF_PROGRAMS SCRATCH
"""
import random
import sys
import pathlib

import taylor_hood
from runs import Run, Verdict, command, fresh, table

DIVISIONS = 16
WIDE = 2 * DIVISIONS + 1
N_NODES, N_PRESSURES = WIDE * WIDE, (DIVISIONS + 1) * (DIVISIONS + 1)
N_VECTORS = 2 * N_NODES
N = N_VECTORS + N_PRESSURES


def whole_matrix():
    """[A B'; B 0] of the flow through the square, velocities by component, without prescribed values."""
    A, B2, _, _ = taylor_hood.assemble(DIVISIONS)
    K = {i: dict(row) for i, row in A.items()}
    for k, row in B2.items():
        for j, value in row.items():
            taylor_hood.add(K, N_VECTORS + k, j, value)
            taylor_hood.add(K, j, N_VECTORS + k, value)
    return K


def without_rounding(K):
    return {i: {j: v for j, v in row.items() if abs(v) > 1e-13} for i, row in K.items()}


def channel():
    return taylor_hood.fixed_values(DIVISIONS)


def cavity():
    """A lid that moves with a smooth velocity of no net flow."""
    fixed = {}
    for j in range(WIDE):
        for i in range(WIDE):
            if 0 < i < WIDE - 1 and 0 < j < WIDE - 1:
                continue
            x = i * 0.5 / DIVISIONS
            fixed[j * WIDE + i] = 16 * (x * (1 - x)) ** 2 if j == WIDE - 1 else 0.0
            fixed[N_NODES + j * WIDE + i] = 0.0
    return fixed


def scaled(K, b, factors):
    return ({i: {j: v * factors[i] * factors[j] for j, v in row.items()} for i, row in K.items()},
            [value * factor for value, factor in zip(b, factors)])


def prescribe(K, fixed, how):
    """Rows of the fixed unknowns: "eliminated", unit "rows" whose columns stay, or a "penalty"."""
    K = {i: dict(row) for i, row in K.items()}
    b = [0.0] * N
    if how == "eliminated":
        taylor_hood.eliminate(K, b, fixed, True)
        return K, b
    for i, value in fixed.items():
        if how == "rows":
            K[i] = {i: 1.0}
            b[i] = value
        else:
            K[i][i] = 1e20
            b[i] = 1e20 * value
    return K, b


def with_rounding(K):
    """Entries of 1e-17 where nothing is coupled."""
    shuffle = random.Random(2)
    K = {i: dict(row) for i, row in K.items()}
    for i in range(N_VECTORS):
        if len(K[i]) > 1:
            for _ in range(8):
                K[i].setdefault(shuffle.randrange(N_VECTORS), 1e-17 * shuffle.uniform(-1, 1))
    return K


def orders():
    """New numbers of the unknowns."""
    first = [N_PRESSURES + k for k in range(N_VECTORS)] + list(range(N_PRESSURES))
    by_node = [2 * (k % N_NODES) + k // N_NODES for k in range(N_VECTORS)] + list(range(N_VECTORS, N))
    beside, number = [0] * N, 0
    for node in range(N_NODES):
        i, j = node % WIDE, node // WIDE
        beside[node], beside[N_NODES + node] = number, number + 1
        number += 2
        if i % 2 == 0 and j % 2 == 0:
            beside[N_VECTORS + j // 2 * (DIVISIONS + 1) + i // 2] = number
            number += 1
    return {"scalars first": first, "by node, scalars last": by_node, "scalars among the vectors": beside}


def write(folder, K, b):
    folder.mkdir(parents=True, exist_ok=True)
    taylor_hood.write_matrix(folder / "K.mtx", K, len(b), len(b))
    with open(folder / "b.mtx", "w") as file:
        file.write(f"%%MatrixMarket matrix array real general\n{len(b)} 1\n")
        file.writelines(f"{value:.17g}\n" for value in b)


def read_solution(path):
    with open(path) as file:
        return [float(line) for line in file if not line.startswith("%") and len(line.split()) == 1]


class Tried:
    """A run on the matrix in a folder."""

    def __init__(self, programs, folder, ranks=1, settings=(), case=None):
        words = [case] if case else [folder / "K.mtx", folder / "b.mtx"]
        words += ["--output", folder / "out", "--overwrite"]
        for key, value in settings:
            words += ["--set", f"{key}={value}"]
        self.run = Run(command(programs / "tunica-solvers", words, ranks), folder)
        self.is_good = self.run.status == 0
        if self.is_good:
            rows = table(folder / "out" / "solvers.csv")
            self.names, self.verdicts = list(rows["setting"]), list(rows["verdict"])
            self.iterations = rows["iterations"][-1]
            self.x = read_solution(folder / "out" / "solution.mtx")


ITERATIVE = (("Solvers/direct operations", 0),)


def difference(x, y, size):
    return max(abs(a - b) for a, b in zip(x, y)) / size


def check_prescribed(verdict, programs, scratch, K):
    """However values are prescribed, the system that is solved is that without them."""
    exact, count = None, None
    for how in ("eliminated", "rows", "penalty"):
        folder = scratch / how
        write(folder, *prescribe(K, channel(), how))
        for settings in ((), ITERATIVE):
            tried = Tried(programs, folder, settings=settings)
            if not verdict.claim(tried.is_good, f"{how}: status {tried.run.status} {tried.run.err}"):
                continue
            exact = exact or tried.x
            apart = difference(tried.x, exact, 8)
            verdict.claim(apart < 1e-6, f"{how}: {tried.names} gives the same solution up to {apart:.1e}")
            if settings:
                count = count or tried.iterations
                verdict.claim(abs(tried.iterations - count) <= 0.2 * count,
                              f"{how}: {tried.iterations:g} iterations, {count:g} of the first")
        verdict.claim("scalars last" in tried.run.out and "2 components, by component" in tried.run.out,
                      f"{how}: the order is said")
        verdict.claim("rows 1, 2, 3, 4, 5, 6 and" in tried.run.out and "more of K give" in tried.run.out,
                      f"{how}: the rows of known values are named")
    errors = [abs(p - 8 * (1 - k % (DIVISIONS + 1) / DIVISIONS)) for k, p in enumerate(exact[N_VECTORS:])]
    verdict.claim(max(errors) < 1e-10, f"the pressure is off by {max(errors):.1e}")
    return exact, count


def check_rounding(verdict, programs, scratch, K, exact, count):
    folder = scratch / "rounding"
    broken, b = prescribe(K, channel(), "rows")
    write(folder, with_rounding(broken), b)
    tried = Tried(programs, folder, settings=ITERATIVE)
    verdict.claim(tried.is_good and tried.iterations == count and difference(tried.x, exact, 8) < 1e-6 and
                  "are left out" in tried.run.out, f"entries that are rounding do not count {tried.run.err}")


def check_units(verdict, programs, scratch, K, exact, count):
    """Viscosity and lengths in other units: A times mu, B times L."""
    for mu, length in ((1e-3, 1e-3), (4e3, 1e3)):
        factors = [mu ** 0.5] * N_VECTORS + [length / mu ** 0.5] * N_PRESSURES
        folder = scratch / f"units-{mu:g}"
        write(folder, *prescribe(scaled(K, [0.0] * N, factors)[0],
                                 {i: v / factors[i] for i, v in channel().items()}, "rows"))
        tried = Tried(programs, folder, settings=ITERATIVE)
        if not verdict.claim(tried.is_good, f"{folder.name}: {tried.run.err}"):
            continue
        x = [value * factor for value, factor in zip(tried.x, factors)]
        verdict.claim(abs(tried.iterations - count) <= 0.2 * count and difference(x, exact, 8) < 1e-6,
                      f"{folder.name}: {tried.iterations:g} iterations, {count:g} in the first units")


def check_orders(verdict, programs, scratch, K, exact, count):
    K, b = prescribe(K, channel(), "rows")
    for name, numbers in orders().items():
        folder = scratch / name.replace(" ", "-").replace(",", "")
        values = [0.0] * N
        for k, number in enumerate(numbers):
            values[number] = b[k]
        write(folder, taylor_hood.renumbered(K, numbers, numbers), values)
        for ranks in (1, 2):
            tried = Tried(programs, folder, ranks, ITERATIVE)
            if not verdict.claim(tried.is_good, f"{name}, {ranks} ranks: {tried.run.err}"):
                continue
            apart = difference([tried.x[number] for number in numbers], exact, 8)
            verdict.claim(apart < 1e-6 and name in tried.run.out,
                          f"{name}, {ranks} ranks: {tried.iterations:g} iterations, {apart:.1e} apart")
            verdict.claim(ranks > 1 or tried.iterations == count, f"{name}: as many iterations as in any order")


def check_cavity(verdict, programs, scratch, K):
    """The pressure is determined but for a constant; a net inflow makes the system contradict itself."""
    for net_inflow in (0.0, 1e-3):
        folder = scratch / f"cavity-{net_inflow:g}"
        broken, b = prescribe(K, cavity(), "rows")
        b = b[:N_VECTORS] + [value + net_inflow for value in b[N_VECTORS:]]
        write(folder, broken, b)
        for settings in ((), ITERATIVE):
            tried = Tried(programs, folder, settings=settings)
            if not verdict.claim(tried.is_good, f"cavity: {tried.run.err}"):
                continue
            pressures = tried.x[N_VECTORS:]
            verdict.claim(abs(sum(pressures)) < 1e-9 * N_PRESSURES and tried.verdicts[-1] == "converged",
                          f"cavity: {tried.names[-1]} gives a pressure of mean zero")
        verdict.claim("constant scalars in its null space" in tried.run.out, "cavity: it is said")
        verdict.claim(("left out" in tried.run.err) == (net_inflow > 0),
                      "cavity: a net inflow is said" if net_inflow else "cavity: no net inflow is said")


def control(n, weight):
    """min |y - y_d|^2/2 + weight |q|^2/2 with -laplace y = q by finite differences inside a square: y and q of each node,
    then the multipliers."""
    h2, N_q, K, b = 1.0 / (n + 1) ** 2, n * n, {}, [0.0] * (3 * n * n)
    for i in range(N_q):
        p = 2 * N_q + i
        near = [j for j, inside in ((i - n, i >= n), (i + n, i + n < N_q), (i - 1, i % n > 0), (i + 1, i % n < n - 1)) if inside]
        for j in (i, *near):  # mass
            share = h2 * (0.5 if j == i else 0.125)
            taylor_hood.add(K, 2 * i, 2 * j, share)
            taylor_hood.add(K, 2 * i + 1, 2 * j + 1, weight * share)
        b[2 * i] = h2 * (i % n) / n
        stencil = {2 * i: 4.0, 2 * i + 1: -h2, **{2 * j: -1.0 for j in near}}
        for j, value in stencil.items():
            taylor_hood.add(K, p, j, value)
            taylor_hood.add(K, j, p, value)
    return K, b


def check_own_rows(verdict, programs, scratch):
    """Fields are scaled for the solve; the answer is one of the rows as they are given, too, where the large ones have b = 0."""
    folder = scratch / "control"
    K, b = control(40, 1e-4)
    n_vectors = 2 * len(b) // 3
    K, b = scaled(K, b, [1.0] * n_vectors + [100.0] * (len(b) - n_vectors))
    write(folder, K, b)
    tried = Tried(programs, folder, settings=ITERATIVE)
    if not verdict.claim(tried.is_good, f"control: {tried.run.err}"):
        return
    rest = [value - sum(entry * tried.x[j] for j, entry in K[i].items()) for i, value in enumerate(b)]
    left = (sum(r * r for r in rest) / sum(value * value for value in b)) ** 0.5
    verdict.claim(left < 3e-8 and tried.verdicts[-1] == "converged",
                  f"control: {tried.names[-1]} leaves {left:.1e} of |b| in the rows of the file")


def finite_volumes(n):
    """Flow through a porous square: fluxes through the inner faces, A diagonal, then pressures of the cells."""
    faces = [(j * n + i, j * n + i + 1) for j in range(n) for i in range(n - 1)]
    faces += [(j * n + i, j * n + i + n) for j in range(n - 1) for i in range(n)]
    chance, K = random.Random(3), {}
    for f, (one, other) in enumerate(faces):
        taylor_hood.add(K, f, f, 10 ** chance.uniform(-1, 1))
        for cell, sign in ((one, 1.0), (other, -1.0)):
            taylor_hood.add(K, f, len(faces) + cell, sign)
            taylor_hood.add(K, len(faces) + cell, f, sign)
    return K, [0.0] * len(faces) + [1.0] + [0.0] * (n * n - 2) + [-1.0]


MULTIGRID_ALONE = """<ParameterList name="Case"><ParameterList name="System">
<Parameter name="K" type="string" value="K.mtx"/><Parameter name="rhs" type="string" value="b.mtx"/></ParameterList>
<ParameterList name="Solvers"><ParameterList name="Settings"><ParameterList name="cycles">
<Parameter name="preconditioner" type="string" value="multigrid"/>
</ParameterList></ParameterList></ParameterList></ParameterList>
"""


def check_diagonal(verdict, programs, scratch):
    """Where A is diagonal there is nothing to coarsen in it: its Schur complement is exact."""
    folder = scratch / "volumes"
    K, b = finite_volumes(45)
    write(folder, K, b)
    tried = Tried(programs, folder, settings=ITERATIVE)
    if verdict.claim(tried.is_good, f"finite volumes: {tried.run.err}"):
        verdict.claim(tried.names == ["field by field"] and tried.iterations <= 60 and tried.verdicts == ["converged"],
                      f"finite volumes: {tried.names[-1]} takes {tried.iterations:g} iterations")
    (folder / "cycles.xml").write_text(MULTIGRID_ALONE)
    tried = Tried(programs, folder, case=folder / "cycles.xml")
    verdict.claim(tried.run.status == 2 and "coarsening stands still" in tried.run.out + tried.run.err,
                  "levels that keep all unknowns are refused")


def check_same_case(verdict, programs, scratch):
    """What is printed as the case of a run solves the same."""
    folder = scratch / "rows"
    tried = Tried(programs, folder, settings=ITERATIVE)
    text = tried.run.out
    case = folder / "same.xml"
    case.write_text(text[text.index("<ParameterList"):text.rindex("</ParameterList>")] + "</ParameterList>\n")
    again = Tried(programs, folder, case=case)
    verdict.claim(again.is_good and again.names == tried.names[-1:] and again.iterations == tried.iterations and
                  again.x == tried.x, f"the printed case does the same {again.run.err}")


def check_overruled(verdict, programs, scratch):
    tried = Tried(programs, scratch / "rows", settings=[("System/scalars", "none"), ("System/components", 1)])
    verdict.claim(tried.is_good and f"{N} vector unknowns, 1 component" in tried.run.out, "the order may be overruled")


def main():
    programs, scratch = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    verdict = Verdict()
    K = without_rounding(whole_matrix())
    exact, count = check_prescribed(verdict, programs, scratch, K)
    check_rounding(verdict, programs, scratch, K, exact, count)
    check_units(verdict, programs, scratch, K, exact, count)
    check_orders(verdict, programs, scratch, K, exact, count)
    check_cavity(verdict, programs, scratch, K)
    check_own_rows(verdict, programs, scratch)
    check_diagonal(verdict, programs, scratch)
    check_same_case(verdict, programs, scratch)
    check_overruled(verdict, programs, scratch)
    sys.exit(verdict.status())


if __name__ == "__main__":
    main()
