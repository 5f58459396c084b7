"""The folder of a run that never was: a tube with a travelling bulge."""
import csv
import json
import os

import h5py
import numpy as np

LENGTH, INNER, OUTER = 50.0, 5.0, 6.2
AROUND, ALONG = 24, 40


def prism_tets(wedges):
    """Three tets for each wedge (a0 a1 a2 | b0 b1 b2); the diagonals follow the point numbers."""
    tets = []
    for wedge in wedges:
        a, b = wedge[:3], wedge[3:]
        order = np.argsort(a)
        a, b = a[order], b[order]
        tets += [(a[0], a[1], a[2], b[2]), (a[0], a[1], b[2], b[1]), (a[0], b[1], b[2], b[0])]
    return np.array(tets)


def tube(radii, with_axis):
    """Rings of points at the radii, extruded along z; with_axis fills the innermost ring."""
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    disc = np.concatenate([np.stack([r * np.cos(angle), r * np.sin(angle)], 1) for r in radii])
    triangles = []
    for ring in range(len(radii) - 1):
        for i in range(AROUND):
            j = (i + 1) % AROUND
            p, q = ring * AROUND, (ring + 1) * AROUND
            triangles += [(p + i, q + i, q + j), (p + i, q + j, p + j)]
    if with_axis:
        triangles += [(len(disc), i, (i + 1) % AROUND) for i in range(AROUND)]
        disc = np.vstack([disc, [0.0, 0.0]])
    z = np.linspace(0, LENGTH, ALONG + 1)
    points = np.concatenate([np.column_stack([disc, np.full(len(disc), h)]) for h in z])
    layers = [np.hstack([np.array(triangles) + k * len(disc), np.array(triangles) + (k + 1) * len(disc)])
              for k in range(ALONG)]
    return points, prism_tets(np.concatenate(layers))


def wave(points, time):
    """Radial displacement of a pulse that travels along z."""
    pulse = np.exp(-(((points[:, 2] - 3.0 * time) / 6.0) ** 2))
    radius = np.maximum(np.hypot(points[:, 0], points[:, 1]), 1e-12)
    size = 0.12 * np.where(radius < INNER, radius / INNER, INNER / radius) * pulse
    return np.column_stack([size * points[:, 0] / radius, size * points[:, 1] / radius, 0 * size])


def write_fields(path, grids, times, stress_at_cells):
    meshes = {"fluid": tube([1.7, 3.4, INNER], True), "wall": tube([INNER, 5.6, OUTER], False)}
    with h5py.File(path, "w") as file:
        for grid in grids:
            file[f"{grid}/points"], file[f"{grid}/tets"] = meshes[grid]
        for number, time in enumerate(times):
            step = file.create_group(f"step_{4 * number:06d}")
            step.attrs["step"], step.attrs["time"] = 4 * number, time
            if "fluid" in grids:
                p = meshes["fluid"][0]
                r = np.hypot(p[:, 0], p[:, 1])
                pulse = np.exp(-(((p[:, 2] - 3.0 * time) / 6.0) ** 2))
                step["fluid/displacement"] = wave(p, time)
                step["fluid/velocity"] = np.column_stack([0 * r, 0 * r, 0.3 * pulse * (1 - (r / INNER) ** 2)])
                step["fluid/pressure"] = 1.3 * pulse
            if "wall" in grids:
                p, t = meshes["wall"]
                at = p[t].mean(axis=1) if stress_at_cells else p
                pulse = np.exp(-(((at[:, 2] - 3.0 * time) / 6.0) ** 2))
                step["wall/displacement"] = wave(p, time)
                step["wall/von_mises"] = 9.0 * pulse * INNER / np.hypot(at[:, 0], at[:, 1])


def add_recovered_stress(folder):
    """To a run of the wall with stress at cells: two layers, and stress at the points, the largest principal one greatest
    at the far end in the third output."""
    with h5py.File(os.path.join(folder, "fields.h5"), "r+") as file:
        points, tets = file["wall/points"][:], file["wall/tets"][:]
        region = np.where(points[tets].mean(1)[:, 2] < LENGTH / 2, 0, 1)
        file["wall/region"], file["wall/region_names"] = region, np.array(["near", "far"], dtype="S8")
        for k, step in enumerate([name for name in file if name.startswith("step_")]):
            wall, size = file[f"{step}/wall"], 3.0 - abs(k - 2.0)
            wall["recovered_principal_stress"] = size * np.outer(1.0 + points[:, 2] / LENGTH, [1.0, 0.5, 0.0])
            wall["recovered_stress"] = np.tile([2.0, 0.0, 0.0, 0.0, 0.0, 0.0], (len(points), 1))
            wall["recovered_von_mises"] = np.full(len(points), 2.0)
            wall["stress_error"] = np.where(region == 0, 0.5, 0.1)


def write_table(path, heading, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(heading.split(","))
        writer.writerows(rows)


NEWTON_COLUMNS = ("step,coupling_iteration,field,iteration,increment,relative_increment,residual,exponent,step_length,"
                  "linear_tolerance,linear_residual,linear_iterations")


def newton_rows(step, rounds, fields):
    for k in range(1, rounds + 1):
        for field in fields:
            for i, increment in enumerate((1e-1, 2e-3, 3e-6, 1e-11), 1):
                increment *= 0.3**k
                yield [step, k, field, i, increment, increment / 5, increment * 0.1, 1.9 if i > 2 else "nan", 1.0,
                       1e-6, 8.1e-7, 11 + i]


def linear_rows(step, rounds, fields):
    for k in range(1, rounds + 1):
        for field in fields:
            for i in range(1, 5):
                yield [step, k, field, i, "GMRES + block multigrid", 11 + i, 1e-6, 8e-7, 8.1e-7, 0.12, 0.31, 1]


def write_run(folder, grids=("fluid", "wall"), stress_at_cells=False, steps=24):
    os.makedirs(folder)
    coupled = len(grids) == 2
    with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump({"program": "tunica-fsi", "status": "done", "started": "2024-01-01T10:00:00Z",
                   "ended": "2024-01-01T11:00:00Z", "ranks": 4, "memory": {"peak of one rank [MB]": 312.4},
                   "versions": {"tunica": "0.1.0", "MPI": "Open MPI v4.1.4"},
                   "sizes": {"fluid points": 2993}, "timings": {"assembly": 12.25, "solve": 80.5}}, file)
    rounds = lambda s: 6 + s % 3 if coupled else 1  # noqa: E731
    rows = [[s, 0.5 * s, 1 if s != 17 else 0, rounds(s) if coupled else 0, 3e-7 if coupled else 0]
            + [4 * rounds(s) if g in grids else 0 for g in ("fluid", "wall")]
            + [50 * rounds(s) if g in grids else 0 for g in ("fluid", "wall")]
            + [1.5, 0.12 + 0.01 * np.sin(s), 30 * np.exp(-(((s - 6) / 4) ** 2))] for s in range(1, steps + 1)]
    write_table(os.path.join(folder, "steps.csv"),
                "step,time,converged,coupling_iterations,interface_residual,fluid_newton,wall_newton,fluid_linear,"
                "wall_linear,seconds,max_displacement_wall_mm,inflow_inlet_mm3_per_ms", rows)
    if coupled:
        write_table(os.path.join(folder, "coupling.csv"),
                    "step,time,iteration,interface_residual,relaxation,columns,fluid_newton,wall_newton,fluid_linear,"
                    "wall_linear,motion_seconds,fluid_seconds,wall_seconds,update_seconds",
                    [[s, 0.5 * s, k, 0.1 * 0.12**k * (1 + 0.3 * np.sin(s * k)), 0.4 + 0.1 * np.cos(s + 2 * k), 0, 4, 4,
                      50, 50, 0.01, 0.4, 0.9, 0.02] for s in range(1, steps + 1) for k in range(1, rounds(s) + 1)])
    write_table(os.path.join(folder, "newton.csv"),
                NEWTON_COLUMNS,
                [r for s in range(1, steps + 1) for r in newton_rows(s, rounds(s), grids)])
    write_table(os.path.join(folder, "linear.csv"),
                "step,coupling_iteration,field,newton_iteration,method,iterations,tolerance,recurrence_residual,"
                "true_residual,setup_seconds,solve_seconds,converged",
                [r for s in range(1, steps + 1) for r in linear_rows(s, rounds(s), grids)])
    write_fields(os.path.join(folder, "fields.h5"), grids, 2.0 * np.arange(steps // 4 + 1), stress_at_cells)
    return folder


def solver_rows(unknowns, fields, growth):
    """Two settings; the second reaches the cap in the last Newton step of the wall."""
    for field in fields:
        for k in range(1, 5):
            for setting, method, count in (("default, GCR", "gcr", 12), ("paper P_L, BiCGStab", "bicgstab", 28 * growth)):
                cap = field == "wall" and k == 4 and method == "bicgstab"
                yield [field, k, setting, method, "block", unknowns, 200 if cap else int(count + k % 2), 0.3, 8e-9,
                       8e-9, 0.12, 0.31, "nan" if cap else 1e-9, "cap" if cap else "converged"]


def write_case(path, period):
    """A load with that period."""
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""<ParameterList name="Case"><ParameterList name="Fluid">
  <Parameter name="viscosity" type="double" value="3.5e-3"/>
  <ParameterList name="Surfaces"><ParameterList name="inlet"><ParameterList name="Amplitude">
    <Parameter name="period" type="double" value="{period}"/>
  </ParameterList></ParameterList></ParameterList></ParameterList></ParameterList>""")


def write_solver_run(folder, unknowns=9072, fields=("fluid", "wall"), growth=1, coupling_iteration=2):
    os.makedirs(folder)
    record = {"program": "tunica-solvers", "status": "done", "ranks": 2, "versions": {"tunica": "0.1.0"}}
    for name, more in (("run.json", {}), ("solvers.json", {"step": 1, "coupling iteration": coupling_iteration,
                                                           "tolerance": 1e-8})):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            json.dump({**record, **more}, file)
    write_table(os.path.join(folder, "solvers.csv"),
                "field,newton_step,setting,method,preconditioner,unknowns,iterations,convergence_factor,true_residual,"
                "recurrence_residual,setup_seconds,solve_seconds,difference,verdict",
                solver_rows(unknowns, fields, growth))
    write_table(os.path.join(folder, "newton.csv"),
                NEWTON_COLUMNS,
                newton_rows(1, 2, fields))
    return folder


# --- two beats of a tube --------------------------------------------------------------------

PERIOD, STEP, OUTPUT = 800.0, 5.0, 40.0  # ms
DIASTOLIC, PULSE = 80 * 0.133322, 40 * 0.133322  # kPa
MEAN_FLOW, SWING = 5e6 / 6e4, 0.8  # 5 l/min in mm^3/ms; the flow swings by this part of it
WIDENING = 0.02  # of the radius in systole
DELAY = 10.0  # ms from the inlet to the outlet
CROSS_SECTION = 0.5 * AROUND * INNER**2 * np.sin(2 * np.pi / AROUND)  # of the polygon, without load


def rise(time):
    """From 0 in diastole to 1 in systole."""
    return 0.5 - 0.5 * np.cos(2 * np.pi * time / PERIOD)


def beat_flow(time):
    return MEAN_FLOW * (1 - SWING * np.cos(2 * np.pi * time / PERIOD))


def oriented(points, tets):
    """All of positive volume, so that caps are seen from outside."""
    x = points[tets]
    return np.where((np.linalg.det(x[:, 1:] - x[:, :1]) < 0)[:, None], tets[:, [0, 2, 1, 3]], tets)


def write_beat_fields(path):
    """Radial widening by a factor, pressure uniform in space, plug flow; shear stress, its averages and OSI linear along z."""
    meshes = {"fluid": tube([1.7, 3.4, INNER], True), "wall": tube([INNER, 5.6, OUTER], False)}
    with h5py.File(path, "w") as file:
        for grid, (points, tets) in meshes.items():
            file[f"{grid}/points"], file[f"{grid}/tets"] = points, oriented(points, tets)
        for time in np.arange(0.0, 2 * PERIOD + 1, OUTPUT):
            number = int(round(time / STEP))
            step = file.create_group(f"step_{number:06d}")
            step.attrs["step"], step.attrs["time"] = number, time
            for grid, (points, _) in meshes.items():
                step[f"{grid}/displacement"] = WIDENING * rise(time) * points * (1, 1, 0)
            z = meshes["fluid"][0][:, 2] / LENGTH
            area = CROSS_SECTION * (1 + WIDENING * rise(time)) ** 2
            step["fluid/velocity"] = np.outer(np.ones(len(z)), [0, 0, beat_flow(time) / area])
            step["fluid/pressure"] = np.full(len(z), DIASTOLIC + PULSE * rise(time))
            step["fluid/wall_shear_stress"] = np.outer(2e-3 * z * rise(time) * (0.9 if time < PERIOD else 1.0), [0, 0, 1])
            step["fluid/time_averaged_wss"], step["fluid/oscillatory_shear_index"] = 1e-3 * z, 0.5 * z
            step["fluid/relative_residence_time"] = 1e3 * (1 + z)


def write_beat_steps(path):
    """The outlet has the pressure of the inlet later, and what flows in less what the vessel takes up."""
    time = np.arange(STEP, 2 * PERIOD + 1, STEP)
    volume = CROSS_SECTION * LENGTH * (1 + WIDENING * rise(time)) ** 2
    speed = np.pi / PERIOD * np.sin(2 * np.pi * time / PERIOD)  # of rise()
    taken = CROSS_SECTION * LENGTH * 2 * (1 + WIDENING * rise(time)) * WIDENING * speed
    area = volume / LENGTH
    columns = {"step": np.arange(1, len(time) + 1), "time": time, "converged": 1 + 0 * time, "seconds": 0.1 + 0 * time,
               "inflow_inlet_mm3_per_ms": beat_flow(time), "inflow_outlet_mm3_per_ms": taken - beat_flow(time),
               "area_inlet_mm2": area, "area_outlet_mm2": area, "fluid_volume_mm3": volume,
               "mean_pressure_inlet_kPa": DIASTOLIC + PULSE * rise(time),
               "mean_pressure_outlet_kPa": DIASTOLIC + PULSE * rise(time - DELAY),
               "pressure_outlet_kPa": DIASTOLIC + PULSE * rise(time - DELAY)}
    write_table(path, ",".join(columns), zip(*columns.values()))


def write_beat_case(path):
    """A Windkessel of 1 and 9 mmHg s/ml and 0.1 ml/mmHg."""
    windkessel = {"proximal resistance": 0.133322, "distal resistance": 9 * 0.133322, "capacitance": 100 / 0.133322}
    numbers = "".join(f'<Parameter name="{name}" type="double" value="{value!r}"/>' for name, value in windkessel.items())
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""<ParameterList name="Case"><ParameterList name="Fluid">
  <Parameter name="density" type="double" value="1.06"/> <Parameter name="viscosity" type="double" value="3.5e-3"/>
  <ParameterList name="Surfaces"><ParameterList name="inlet"><Parameter name="condition" type="string" value="flow rate"/>
    <ParameterList name="Amplitude"><Parameter name="period" type="double" value="{PERIOD}"/></ParameterList></ParameterList>
  <ParameterList name="outlet"><Parameter name="condition" type="string" value="windkessel"/>{numbers}</ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Wall"><ParameterList name="Prestress"><Parameter name="pressure" type="double" value="{DIASTOLIC}"/>
  </ParameterList><ParameterList name="Layers"><ParameterList name="media"><Parameter name="law" type="string" value="holzapfel"/>
  </ParameterList></ParameterList></ParameterList></ParameterList>""")


def write_beats(folder):
    """Two beats of a tube that widens as a whole."""
    os.makedirs(folder)
    with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump({"program": "tunica-fsi", "status": "done", "ranks": 1}, file)
    write_table(os.path.join(folder, "newton.csv"), NEWTON_COLUMNS, [])
    write_table(os.path.join(folder, "linear.csv"), "step,field", [])
    write_beat_steps(os.path.join(folder, "steps.csv"))
    write_beat_case(os.path.join(folder, "case.xml"))
    write_beat_fields(os.path.join(folder, "fields.h5"))
    return folder
