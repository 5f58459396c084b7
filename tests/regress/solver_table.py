"""xml/solvers-tiny.xml: every setting solves every system, and the exported systems are those.

Usage: solver_table.py FOLDER_OF_PROGRAMS SCRATCH
"""
import csv
import json
import math
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table

CASE = ROOT / "xml" / "solvers-tiny.xml"
SETTINGS = 6


def numbers(path):
    """The lines of a Matrix Market file: its kind, its sizes, its entries."""
    with open(path) as file:
        kind = file.readline().split()[2]
        lines = [line.split() for line in file if not line.startswith("%")]
    return kind, [int(word) for word in lines[0]], lines[1:]


def dense(path):
    """Columns of an array file."""
    kind, (rows, columns), lines = numbers(path)
    assert kind == "array" and len(lines) == rows * columns, path
    values = [float(line[0]) for line in lines]
    return [values[rows * j:rows * (j + 1)] for j in range(columns)]


def add_product(path, factor, x, y):
    """y += factor M x for the matrix of a coordinate file."""
    kind, (rows, columns, entries), lines = numbers(path)
    assert kind == "coordinate" and len(lines) == entries, path
    assert (rows, columns) == (len(y), len(x)), path
    for i, j, value in lines:
        y[int(i) - 1] += factor * float(value) * x[int(j) - 1]


def size(x):
    return math.sqrt(sum(value * value for value in x))


def relative_residual(folder):
    """|b − K x| / |b| from the files, K = [A B1T; B2 -C]."""
    (b,), (x,) = dense(folder / "rhs.mtx"), dense(folder / "solution.mtx")
    n = len(b) * 3 // 4
    top, bottom = b[:n], b[n:]
    add_product(folder / "A.mtx", -1.0, x[:n], top)
    add_product(folder / "B1T.mtx", -1.0, x[n:], top)
    add_product(folder / "B2.mtx", -1.0, x[:n], bottom)
    add_product(folder / "C.mtx", 1.0, x[n:], bottom)
    return size(top + bottom) / size(b)


def check_modes(verdict, folder):
    """Three translations and the rotations about the axes, from the coordinates."""
    points = list(zip(*dense(folder / "coordinates.mtx")))
    modes = dense(folder / "nullspace.mtx")
    expected = [[], [], [], [], [], []]
    for x, y, z in points:
        for mode, values in zip(expected, ((1, 0, 0), (0, 1, 0), (0, 0, 1),
                                           (0, -z, y), (z, 0, -x), (-y, x, 0))):
            mode += values
    verdict.claim(modes == expected, f"{folder.name}: six rigid motions of {len(points)} nodes")


def check_export(verdict, folder, rows):
    names = sorted({f"{field}-newton-{step:.0f}"
                    for field, step in zip(rows["field"], rows["newton_step"])})
    verdict.claim(sorted(path.name for path in folder.iterdir()) == names,
                  f"a folder for each of {', '.join(names)}")
    for name in (names[0], names[-1]):
        residual = relative_residual(folder / name)
        verdict.claim(residual < 1e-9, f"{name}: the files hold K x = b up to {residual:.1e}")
        check_modes(verdict, folder / name)
        state = json.loads((folder / name / "state.json").read_text())
        verdict.claim(name == f"{state['field']}-newton-{state['newton step']}" and
                      state["coupling iteration"] == 2 and "A B1T" in state["operator"],
                      f"{name}: state.json says which it is")


def check_json(verdict, results):
    with open(results / "solvers.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    record = json.loads((results / "solvers.json").read_text())
    verdict.claim(record["case"]["file"] == str(CASE) and "Trilinos" in record["versions"],
                  "solvers.json names case and versions")
    same = [list(row) == list(solve) and
            all(text == solve[key] if isinstance(solve[key], str) else
                solve[key] is None or float(text) == solve[key] for key, text in row.items())
            for row, solve in zip(rows, record["solves"])]
    verdict.claim(len(rows) == len(record["solves"]) and all(same),
                  f"{len(rows)} rows of solvers.csv are those of solvers.json")


def check_run(verdict, programs, folder, ranks):
    results, systems = folder / f"ranks-{ranks}", folder / f"systems-{ranks}"
    run = Run(command(programs / "tunica-solvers",
                      [CASE, "--output", results, "--export", systems], ranks), folder)
    if not verdict.claim(run.status == 0, f"{ranks} ranks end with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return {}
    rows, newton = table(results / "solvers.csv"), table(results / "newton.csv")
    steps = sum(k == 2 for k in newton["coupling_iteration"])
    verdict.claim(len(rows["field"]) == SETTINGS * steps,
                  f"{SETTINGS} settings on each of {steps} systems")
    verdict.claim(set(rows["verdict"]) == {"converged"}, f"all converge: {set(rows['verdict'])}")
    verdict.claim(max(rows["difference"]) < 1e-6,
                  f"solutions differ by {max(rows['difference']):.1e}")
    verdict.claim(max(newton["coupling_iteration"]) == 2, "the run ends with the wanted iteration")
    check_json(verdict, results)
    check_export(verdict, systems, rows)
    return rows


def one_system(verdict, programs, folder):
    words = [CASE, "--output", "one"]
    for setting in ("step=2", "coupling iteration=1", "newton step=1", "field=wall",
                    "tolerance=1e-4", "export folder=alone", "Wall/default/max iterations=1"):
        words += ["--set", "Solvers/" + setting]
    run = Run(command(programs / "tunica-solvers", words), folder)
    verdict.claim(run.status == 0, f"one system: exit status {run.status} is 0")
    rows = table(folder / "one" / "solvers.csv")
    verdict.claim(rows["field"] == ["wall"] * SETTINGS and rows["newton_step"] == [1] * SETTINGS,
                  "one system: the first Newton step of the wall")
    verdict.claim(rows["verdict"] == ["cap"] + ["converged"] * (SETTINGS - 1),
                  f"one system: a setting that fails does not end the table: {rows['verdict']}")
    verdict.claim([path.name for path in (folder / "alone").iterdir()] == ["wall-newton-1"],
                  "one system: it is written")


def refuses(verdict, programs, folder):
    text = CASE.read_text().replace("../meshes", str(ROOT / "meshes"))
    (folder / "bad.xml").write_text(text.replace('"fill level"', '"fil level"'))
    for program, words in (("tunica-solvers", ["--output", "bad", "--export", "bad-systems"]),
                           ("tunica-check", [])):
        run = Run(command(programs / program, ["bad.xml"] + words), folder)
        verdict.claim(run.status == 1, f"{program}: exit status {run.status} is 1")
        verdict.claim('Solvers / Fluid / ILU(1), GMRES: unknown key "fil level". '
                      'Did you mean "fill level"?' in run.err, f"{program}: the key is named")
    verdict.claim(not list(folder.glob("bad[!.]*")), "nothing was written")
    run = Run(command(programs / "tunica-solvers",
                      [CASE, "--output", "none", "--set", "Solvers/newton step=100"]), folder)
    verdict.claim(run.status == 2 and "no linear system at time step 1" in run.err,
                  "a Newton step that there is not ends with 2")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    one = check_run(verdict, programs, folder, 1)
    two = check_run(verdict, programs, folder, 2)
    if one and two:
        direct = [k for k, method in enumerate(one["method"]) if method == "direct"]
        verdict.claim(len(one["field"]) == len(two["field"]) and
                      all(two["iterations"][k] == 1 for k in direct), "2 ranks solve the same")
    one_system(verdict, programs, folder)
    refuses(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
