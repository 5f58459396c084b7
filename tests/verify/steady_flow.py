"""Steady flows in pseudo-time: behind a step at a Reynolds number where Newton's method from rest
fails, whatever the first step in time; and where it does not fail, and in a tube, what a march in
large time steps arrives at.

Usage: steady_flow.py FOLDER_OF_PROGRAMS SCRATCH
"""
import itertools
import math
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh, table, xml

CELLS, LENGTH = 6, 5  # in the unit height of the channel; its length
OBSERVED = ("fluid_kinetic_energy_kPa_mm3", "viscous_power_kPa_mm3_per_ms", "fluid_pressure_max_kPa",
            "max_speed_mm_per_ms")


def tetrahedra(cells):
    """Six for each cube; corners as integers."""
    for cell in sorted(cells):
        for order in itertools.permutations(range(3)):
            corner, path = list(cell), [cell]
            for axis in order:
                corner[axis] += 1
                path.append(tuple(corner))
            odd = sum(order[a] > order[b] for a in range(3) for b in range(a + 1, 3)) % 2
            yield [path[1], path[0], path[2], path[3]] if odd else path


def write_mesh(path, cells, size, surface_of):
    """Gmsh 2.2 of cubes; surface_of names a face by its centre."""
    tets, number, faces = list(tetrahedra(cells)), {}, {}
    for tet in tets:
        for corner in tet:
            number.setdefault(corner, len(number) + 1)
        for left_out in range(4):
            face = tuple(sorted(tet[:left_out] + tet[left_out + 1:]))
            faces[face] = face not in faces  # an inner one is there twice
    surfaces = {}
    for face in (face for face, is_outer in faces.items() if is_outer):
        centre = [size * sum(corner[i] for corner in face) / 3.0 for i in range(3)]
        surfaces.setdefault(surface_of(centre), []).append(face)
    names = list(surfaces)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(names) + 1]
    lines += [f'2 {k + 1} "{name}"' for k, name in enumerate(names)]
    lines += [f'3 {len(names) + 1} "fluid"', "$EndPhysicalNames", "$Nodes", len(number)]
    lines += [f"{n} {size * p[0]!r} {size * p[1]!r} {size * p[2]!r}" for p, n in number.items()]
    elements = [(2, k + 1, face) for k, name in enumerate(names) for face in surfaces[name]]
    elements += [(4, len(names) + 1, tet) for tet in tets]
    lines += ["$EndNodes", "$Elements", len(elements)]
    lines += [f"{n + 1} {kind} 2 {tag} {tag} " + " ".join(str(number[p]) for p in corners)
              for n, (kind, tag, corners) in enumerate(elements)]
    path.write_text("\n".join(map(str, lines + ["$EndElements", ""])))


def channel(folder):
    """Behind a step of half its height the channel widens."""
    m = CELLS
    cells = {(i, j, k) for i in range(LENGTH * m) for j in range(m // 2) for k in range(m)
             if i >= m or k >= m // 2}
    write_mesh(folder / "channel.msh", cells, 1.0 / m,
               lambda x: "inlet" if x[0] == 0.0 else "outlet" if x[0] > LENGTH - 1e-9 else "wall")


def case(reynolds, time):
    """Of the largest velocity at the inlet and the height of the step."""
    return xml({"Case": {
        "Mesh": {"file": "channel.msh"}, "Time": time,
        "Output": {"fields every": 0, "checkpoint every": 0},
        "Fluid": {"density": 1.0, "viscosity": 1.0 * 0.5 / reynolds,
                  "Surfaces": {"inlet": {"condition": "velocity", "velocity": [1.0, 0.0, 0.0],
                                         "profile": "parabolic"},
                               "wall": {"condition": "no slip"}},
                  "Linear Solver": {"method": "direct"}}}})


def solve(programs, folder, text, words=()):
    (folder / "case.xml").write_text(text)
    run = Run(command(programs / "tunica-fluid",
                      ["case.xml", "--output", "results", "--overwrite", *words]), folder)
    return run, table(folder / "results" / "steps.csv")


def largest_difference(one, other, columns=OBSERVED):
    return max(abs(one[c][-1] - other[c][-1]) / abs(other[c][-1]) for c in columns)


def behind_a_step(verdict, programs, folder, reynolds):
    name = f"step, Re {reynolds}"
    run, _ = solve(programs, folder, case(reynolds, {"step size": 1000.0, "steps": 1}))
    verdict.claim(run.status == 2, f"{name}: Newton's method from rest fails")
    found = []
    for first, more in ((0.1, {}), (1.0, {"newton increment": 0.1, "velocity scale": 1e-4})):
        time = dict(more, **{"step size": first, "step control": "steady"})
        run, rows = solve(programs, folder, case(reynolds, time))
        if run.status != 0:
            print(run.out + run.err)
        verdict.claim(run.status == 0 and rows["step_size"][-1] == math.inf and
                      rows["error_estimate"][-1] <= 1.0,
                      f"{name}: steady after {len(rows['step'])} steps from {first} ms, "
                      f"{sum(rows['fluid_newton']):.0f} Newton steps")
        found.append(rows)
    difference = largest_difference(*found)
    verdict.claim(difference < 1e-6, f"{name}: the way there changes it by {difference:.1e}")
    net = found[0]["inflow_inlet_mm3_per_ms"][-1]
    verdict.claim(net > 0.0, f"{name}: {net:.4f} mm^3/ms pass")


def as_marched(verdict, programs, folder):
    _, marched = solve(programs, folder, case(10, {"step size": 1e5, "steps": 12}),
                       ["--set", "Fluid/time scheme=implicit euler"])
    _, rows = solve(programs, folder, case(10, {"step size": 1.0, "step control": "steady"}))
    difference = largest_difference(rows, marched)
    verdict.claim(difference < 1e-5, f"step, Re 10: a march arrives there, but for {difference:.1e}")
    run, _ = solve(programs, folder,
                   case(10, {"step size": 1.0, "step control": "steady", "steps": 3}))
    verdict.claim(run.status == 2 and "is not steady after 3 steps" in run.err,
                  "step, Re 10: three steps are not enough, and it says so")
    run = Run(command(programs / "tunica-fsi",
                      [ROOT / "xml" / "pulse-tiny.xml", "--set", "Time/step control=steady"]), folder)
    verdict.claim(run.status == 1 and "needs a \"largest step\"" in run.err, "and a wall needs a largest step")


def in_a_tube(verdict, programs, folder):
    text = (ROOT / "xml" / "poiseuille.xml").read_text().replace("../meshes", str(ROOT / "meshes"))
    _, marched = solve(programs, folder, text, ["--steps", 12])
    run, rows = solve(programs, folder, text.replace(
        '<Parameter name="steps" type="int" value="5"/>',
        '<Parameter name="step control" type="string" value="steady"/>'))
    flow = rows["inflow_inlet_mm3_per_ms"][-1]
    difference = largest_difference(rows, marched, ("inflow_inlet_mm3_per_ms",))
    verdict.claim(run.status == 0 and difference < 1e-5,
                  f"tube: {flow:.5f} mm^3/ms, a march arrives there but for {difference:.1e}")
    verdict.claim(abs(flow / 0.0261 - 1.0) < 0.1, "tube: Poiseuille has 0.0261")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    channel(folder)
    for reynolds in (200, 400):
        behind_a_step(verdict, programs, folder, reynolds)
    as_marched(verdict, programs, folder)
    in_a_tube(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
