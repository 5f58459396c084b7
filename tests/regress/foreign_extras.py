"""What tunica-solvers makes of more than K and b: of a matrix like the Schur complement, of rows that are excluded, and of
multipliers with dense rows; and of the settings of another case.

Usage: foreign_extras.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys

import taylor_hood
from foreign_matrices import (DIVISIONS, ITERATIVE, N, N_PRESSURES, N_VECTORS, WIDE, Tried, cavity, channel, difference,
                              prescribe, scaled, whole_matrix, without_rounding, write)
from runs import Run, Verdict, command, fresh, table


def mass_of_pressures(factor):
    """Of linear functions on the corners; that over the viscosity is as good as the Schur complement."""
    M, area = {}, 0.5 / DIVISIONS ** 2
    for points in taylor_hood.triangles(DIVISIONS):
        corners = [p[1] // 2 * (DIVISIONS + 1) + p[0] // 2 for p in points[:3]]
        for k in corners:
            for l in corners:
                taylor_hood.add(M, k, l, factor * area / (6 if k == l else 12))
    return M


def check_schur(verdict, programs, scratch, K, exact):
    """What the user knows of the Schur complement, in any units and of either sign."""
    counts = []
    for name, factor, sign, ranks in (("mass", 1.0, 1, 1), ("mass-si", 1e-4, 1, 1), ("mass-negative", 1.0, -1, 1),
                                      ("mass-2", 1.0, 1, 2)):
        factors = [1.0] * N_VECTORS + [factor] * N_PRESSURES
        folder = scratch / name
        write(folder, *prescribe(scaled(K, [0.0] * N, factors)[0], channel(), "rows"))
        taylor_hood.write_matrix(folder / "S.mtx", mass_of_pressures(sign * factor ** 2), N_PRESSURES, N_PRESSURES)
        tried = Tried(programs, folder, ranks, ITERATIVE + (("System/schur", folder / "S.mtx"),))
        if not verdict.claim(tried.is_good and tried.names == ["field by field, S given"], f"{name}: {tried.run.err}"):
            continue
        x = [value * f for value, f in zip(tried.x, factors)]
        counts.append(tried.iterations)
        verdict.claim(abs(tried.iterations - counts[0]) <= (0 if ranks == 1 else 2) and difference(x, exact, 8) < 1e-6,
                      f"{name}, {ranks} ranks: {tried.iterations:g} iterations, {counts[0]:g} of the first")
    wrong = Tried(programs, folder, settings=(("System/schur", folder / "K.mtx"),))
    verdict.claim(wrong.run.status == 1 and f"expected one for the {N_PRESSURES} scalar unknowns" in wrong.run.err,
                  f"a matrix of another size is refused: {wrong.run.err}")


def bordered(K, b, rows):
    """With a multiplier for each row {unknown: weight} = value."""
    K = {i: dict(row) for i, row in K.items()}
    for row, value in rows:
        for j, weight in row.items():
            taylor_hood.add(K, j, len(b), weight)
            taylor_hood.add(K, len(b), j, weight)
        b = b + [value]
    return K, b


def check_border(verdict, programs, scratch, K):
    """The mean of the pressure by a multiplier, which takes what the flow through the walls leaves over; and the flow
    through a section by one that is excluded."""
    folder, inflow, mean = scratch / "mean", 1e-3, 7.0
    whole, b = prescribe(K, cavity(), "rows")
    b = b[:N_VECTORS] + [value + inflow for value in b[N_VECTORS:]]
    write(folder, *bordered(whole, b, [({N_VECTORS + k: 1 / N_PRESSURES for k in range(N_PRESSURES)}, mean)]))
    for settings, ranks in (((), 1), (ITERATIVE, 1), (ITERATIVE, 2)):
        tried = Tried(programs, folder, ranks, settings)
        if not verdict.claim(tried.is_good and len(tried.names) == 1, f"mean: {tried.run.err}"):
            continue
        found = sum(tried.x[N_VECTORS:N]) / N_PRESSURES
        verdict.claim(abs(found - mean) < 1e-7 and abs(tried.x[N] / (inflow * N_PRESSURES) - 1) < 1e-6,
                      f"mean, {ranks} ranks: {tried.names[0]}: pressure {found:.9g}, multiplier {tried.x[N]:.6g}")
        verdict.claim(f"row {N + 1} of K is the border of the system" in tried.run.out, "mean: the border is said")
    folder = scratch / "section"
    section = {j * WIDE + DIVISIONS: 0.5 / DIVISIONS for j in range(1, WIDE - 1)}
    write(folder, *bordered(*prescribe(K, channel(), "rows"), [(section, 1.0)]))
    (folder / "rows.txt").write_text(f"{N + 1}\n")
    exact = Tried(programs, folder, settings=[("System/border", "false")])
    for ranks in (1, 2):
        tried = Tried(programs, folder, ranks, (*ITERATIVE, ("System/exclude", folder / "rows.txt")))
        verdict.claim(exact.is_good and tried.is_good and difference(tried.x, exact.x, max(map(abs, exact.x))) < 1e-6 and
                      abs(sum(w * tried.x[j] for j, w in section.items()) - 1) < 1e-7 and len(tried.names) == 1,
                      f"section, {ranks} ranks: {tried.names} as without a border {tried.run.err}")
    for rows, reason in (("12 x", 'found "x"'), ("5", "row 5 of K, which is not"), ("99999", "row 99999 of K, which is not")):
        (folder / "rows.txt").write_text(rows + "\n")
        wrong = Tried(programs, folder, settings=[("System/exclude", folder / "rows.txt")])
        verdict.claim(wrong.run.status == 1 and reason in wrong.run.err, f"{rows}: refused: {wrong.run.err}")


def scaled_rows(K, b, factor):
    """Rows of pressures times numbers that differ: as finite volumes divided by their cells."""
    return ({i: {j: v * (factor(i) if i >= N_VECTORS else 1) for j, v in row.items()} for i, row in K.items()},
            [value * (factor(i) if i >= N_VECTORS else 1) for i, value in enumerate(b)])


def check_singular_inside(verdict, programs, scratch, K):
    """What remains without the border is singular: with a left null vector that is no constant, with constants that
    nothing gives, and in a way that is not known."""
    closed, b = prescribe(K, cavity(), "rows")
    mean = {N_VECTORS + k: 1 / N_PRESSURES for k in range(N_PRESSURES)}
    inside = [j for j in range(N_VECTORS) if j not in cavity()]
    flow = {j: 1 / len(inside) for j in inside}
    write(scratch / "volumes", *bordered(*scaled_rows(closed, b, lambda i: 1 + (i * i % 7) / 4), [(mean, 7.0)]))
    write(scratch / "flow", *bordered(closed, b, [(flow, 0.1)]))
    for name, expected in (("volumes", 7.0), ("flow", 0.0)):
        for settings, ranks in (((), 1), (ITERATIVE, 1), (ITERATIVE, 2)):
            tried = Tried(programs, scratch / name, ranks, settings)
            found = sum(tried.x[N_VECTORS:N]) / N_PRESSURES if tried.is_good else None
            verdict.claim(tried.is_good and len(tried.names) == 1 and abs(found - expected) < 1e-6,
                          f"{name}, {ranks} ranks: a mean pressure of {found} is {expected} {tried.run.err}")
    # u and p as without a multiplier, which is zero by the row of s; s = 3 - flow
    through = [j for j in range(N_VECTORS) if j not in channel()]
    flow = {j: 1 / len(through) for j in through}
    whole, b = bordered(*prescribe(K, channel(), "rows"), [({**flow, N + 1: 1.0}, 3.0)])
    whole[N + 1] = {N: 1.0}
    write(scratch / "slack", whole, b + [0.0])
    slack, plain = Tried(programs, scratch / "slack"), Tried(programs, scratch / "channel")
    verdict.claim(slack.is_good and "nothing converges without the border" in slack.run.out + slack.run.err and
                  difference(slack.x, plain.x, 8) < 1e-6 and
                  abs(slack.x[N + 1] - 3 + sum(w * plain.x[j] for j, w in flow.items())) < 1e-6,
                  f"slack: what fails without the border is solved with it {slack.run.err}")


def check_settings_beside(verdict, programs, scratch):
    """Settings of any case are compared on a matrix: here those of a list "Fluid"."""
    folder = scratch / "channel"
    case = folder / "lists.xml"
    names = ("ILU(1)", "block LU")
    kinds = ("ilu", "block")
    settings = "".join(f'<ParameterList name="{name}"><Parameter name="method" type="string" value="gmres"/>'
                       f'<Parameter name="preconditioner" type="string" value="{kind}"/></ParameterList>'
                       for name, kind in zip(names, kinds))
    case.write_text(f'<ParameterList name="Case"><ParameterList name="Solvers"><ParameterList name="Fluid">{settings}'
                    "</ParameterList></ParameterList></ParameterList>\n")
    files = [folder / "K.mtx", folder / "b.mtx", case]
    run = Run(command(programs / "tunica-solvers", [*files, "--output", folder / "beside", "--overwrite"]), folder)
    verdict.claim(run.status == 0, f"settings beside a matrix: status {run.status} {run.err}")
    rows = table(folder / "beside" / "solvers.csv")
    verdict.claim(tuple(rows["setting"]) == names, f"settings beside a matrix: {list(rows['setting'])} are compared")
    case.write_text('<ParameterList name="Case"/>\n')
    run = Run(command(programs / "tunica-solvers", [*files, "--output", folder / "beside", "--overwrite"]), folder)
    verdict.claim(run.status == 1 and 'lists.xml: a list "Solvers" is missing' in run.err,
                  f"a case without settings is refused: {run.err}")


def main():
    programs, scratch = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    verdict = Verdict()
    K = without_rounding(whole_matrix())
    write(scratch / "channel", *prescribe(K, channel(), "rows"))
    check_schur(verdict, programs, scratch, K, Tried(programs, scratch / "channel").x)
    check_border(verdict, programs, scratch, K)
    check_singular_inside(verdict, programs, scratch, K)
    check_settings_beside(verdict, programs, scratch)
    sys.exit(verdict.status())


if __name__ == "__main__":
    main()
