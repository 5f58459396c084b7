"""Tables by branch over the last beat, from fields.h5: shear stress at the wall, displacement, strain, distensibility.

  distensibility D = (V_s - V_d) / (V_d (p_s - p_d))     V volume of the lumen in the middle half of a branch, p its mean
                                                         pressure, s and d where they are greatest and least
  velocity of pulse waves c = 1 / sqrt(rho D)            Bramwell and Hill
  strain 1 - lengths of the lumen's triangles in the direction in which they are greatest, since the end of diastole
"""
import os

import numpy as np

from report.case_tables import integral
from report.parts import area_where, moved_vectors
from report.surfaces import area_vectors
from report.tables import Table
from report.wall_stress import quantile
from vessel.beats import shear_change
from vessel.units import MMHG

LOW_WSS, HIGH_OSI = 0.4, 0.2  # Pa, 1
PASCAL = 1000.0  # of a kPa
# Points and weights on a triangle, exact for cubic polynomials.
CUBIC, WEIGHTS = np.vstack([np.full(3, 1 / 3), 0.4 * np.eye(3) + 0.2]), np.array([-27, 25, 25, 25]) / 48
FEW = 20  # outputs in a beat below which peaks may be missed


class BeatFields:
    """Outputs of the last beat, and the lumen's surface in them."""

    def __init__(self, run, beat, parts, density):
        self.run, self.beat, self.parts, self.density = run, beat, parts, density
        self.outputs = [o for o in run.outputs if beat.start - 1e-6 * beat.period <= o[0] <= beat.end * (1 + 1e-9)]
        lumen = parts.lumen
        self.nodes, self.triangles = lumen.nodes, lumen.triangles
        self.areas = np.linalg.norm(area_vectors(lumen.points, lumen.triangles), axis=1)

    def on_lumen(self, group, name):
        values = self.run.nodal(group, "fluid", name)
        return None if values is None else values[self.nodes]

    def branches(self):
        """(name, triangles of the lumen); the whole last, where there are several."""
        found = [(branch.name, self.parts.of_triangle == k) for k, branch in enumerate(self.parts.branches)]
        found = [(name, chosen) for name, chosen in found if chosen.any()]
        whole = ("all", np.ones(len(self.triangles), dtype=bool))
        return found + [whole] if len(found) != 1 else found

    def weights(self, chosen):
        """Area of each node of the lumen [mm^2]."""
        return np.bincount(self.triangles[chosen].reshape(-1), np.repeat(self.areas[chosen] / 3, 3), len(self.nodes))

    def place(self, node):
        return ", ".join(f"{x:.3g}" for x in self.parts.points[self.nodes[node]].round(3) + 0.0)


def averages(fields, begin):
    """TAWSS, OSI and RRT by branch, averaged from that time on [ms]."""
    if not fields.outputs:
        return None
    group = fields.outputs[-1][1]
    tawss, osi, rrt = (fields.on_lumen(group, name) for name in ("time_averaged_wss", "oscillatory_shear_index",
                                                                "relative_residence_time"))
    if tawss is None or osi is None or rrt is None:
        return None
    tawss, osi, rrt = PASCAL * tawss.reshape(-1), osi.reshape(-1), rrt.reshape(-1) / PASCAL
    rows = []
    for name, chosen in fields.branches():
        weights, areas, corners = fields.weights(chosen), fields.areas[chosen], fields.triangles[chosen]
        area = areas.sum()
        low, high = area_where(areas, tawss[corners], LOW_WSS, False), area_where(areas, osi[corners], HIGH_OSI, True)
        rows.append([name, f"{area:.4g}", f"{np.average(tawss, weights=weights):.3g}", f"{quantile(tawss, weights, 0.99):.3g}",
                     f"{low:.4g}", f"{100 * low / area:.1f} %", f"{np.average(osi, weights=weights):.3f}", f"{high:.4g}",
                     f"{100 * high / area:.1f} %", f"{quantile(rrt, weights, 0.5):.3g}", f"{quantile(rrt, weights, 0.99):.3g}"])
    end, period = fields.outputs[-1][0], fields.beat.period
    over = f"Averaged from {begin:g} to {end:g} ms" + ("." if end - begin > period * (1 - 1e-6) else f", less than a beat of {period:g} ms.")
    return Table("Shear stress at the wall, averaged over time", f"{over} Areas are those of the mesh as it was given.",
                 ["branch", "area, mm²", "TAWSS mean, Pa", "99 %, Pa", f"TAWSS < {LOW_WSS:g} Pa, mm²", "of the area", "OSI mean",
                  f"OSI > {HIGH_OSI:g}, mm²", "of the area", "RRT median, 1/Pa", "99 %, 1/Pa"], rows)


def peaks(fields):
    """Shear stress over the outputs of the beat: of each node the greatest."""
    seen = [(time, fields.on_lumen(group, "wall_shear_stress")) for time, group in fields.outputs]
    seen = [(time, PASCAL * np.linalg.norm(v.reshape(len(v), -1), axis=1)) for time, v in seen if v is not None]
    if not seen:
        return None
    every = np.array([values for _, values in seen])
    most, when = every.max(axis=0), every.argmax(axis=0)
    rows = []
    for name, chosen in fields.branches():
        weights = fields.weights(chosen)
        means = every @ weights / weights.sum()
        worst = int(np.where(weights > 0, most, -1.0).argmax())
        rows.append([name, f"{means.max():.3g}", f"{seen[int(means.argmax())][0] - fields.beat.start:.4g}",
                     f"{np.average(most, weights=weights):.3g}", f"{quantile(most, weights, 0.99):.3g}", f"{most[worst]:.3g}",
                     fields.place(worst), f"{seen[int(when[worst])][0] - fields.beat.start:.4g}"])
    few = f"; only {len(seen)}, between which peaks may be missed" if len(seen) < FEW else ""
    return Table("Peak shear stress at the wall", f"Of {len(seen)} outputs of the beat{few}. Times count from its begin.",
                 ["branch", "greatest mean over the area, Pa", "at, ms", "mean of the peaks, Pa", "99 % of the area below, Pa",
                  "greatest, Pa", "at x, y, z, mm", "at, ms"], rows)


def wss_change(fields):
    """Since the beat before, as tunica-vessel has it; None where no two outputs are a period apart."""
    run, beat = fields.run, fields.beat
    table = {name: np.array(run.steps[name]) for name in ("step", "time")}
    table["step_size"] = np.diff(table["time"], prepend=0.0)
    return shear_change(os.path.join(run.folder, "fields.h5"), table, beat.end / beat.period, beat.period)


def kinetic_inflow(fields):
    """-rho/2 int |u|^2 u.n da dt over the inlet and the outputs of the beat [kPa mm^3]; None where the inlet is not known."""
    end = fields.parts.ends.get(fields.beat.inlet)
    velocities = [fields.run.nodal(group, "fluid", "velocity") for _, group in fields.outputs]
    if end is None or len(velocities) < 3 or any(v is None for v in velocities):
        return None
    power = []
    for velocity, (_, group) in zip(velocities, fields.outputs):
        normals, at = moved_vectors(fields.run, end, group), np.einsum("qk,tkx->tqx", CUBIC, velocity[end.nodes][end.triangles])
        power.append(-0.5 * fields.density * np.einsum("q,tq,tqx,tx->", WEIGHTS, (at ** 2).sum(axis=2), at, normals))
    return float(integral(np.array(power), np.array([time for time, _ in fields.outputs])))


def diastole(fields):
    """Number of the output in which the lumen is smallest, and the volumes of all tetrahedra in each output."""
    volumes = []
    for _, group in fields.outputs:
        x = (fields.parts.points + fields.run.displacement(group, "fluid"))[fields.parts.tets]
        volumes.append(abs(np.linalg.det(x[:, 1:] - x[:, :1])) / 6)
    volumes = np.array(volumes)
    return int(volumes.sum(axis=1).argmin()), volumes


def strain(before, now, triangles):
    """Greatest elongation of each triangle between two shapes."""
    sides = lambda x: np.stack([x[triangles[:, 1]] - x[triangles[:, 0]], x[triangles[:, 2]] - x[triangles[:, 0]]], axis=2)  # noqa: E731
    metric = lambda s: np.swapaxes(s, 1, 2) @ s  # noqa: E731
    c = np.linalg.solve(metric(sides(before)), metric(sides(now)))  # its eigenvalues are the squares of the stretches
    half = 0.5 * np.trace(c, axis1=1, axis2=2)
    return np.sqrt(half + np.sqrt(np.clip(half ** 2 - np.linalg.det(c), 0, None))) - 1


def motion(fields, volumes, rest):
    """Displacement and strain by branch."""
    moves = np.array([fields.run.displacement(group, "fluid")[fields.nodes] for _, group in fields.outputs])
    place = fields.parts.points[fields.nodes] + moves
    systole = int(volumes.sum(axis=1).argmax())
    longest = np.max([strain(place[rest], now, fields.triangles) for now in place], axis=0)
    since = np.linalg.norm(moves - moves[rest], axis=2).max(axis=0)
    rows = []
    for number, (name, chosen) in enumerate(fields.branches()):
        weights = fields.weights(chosen)
        worst = int(np.where(weights > 0, since, -1.0).argmax())
        middle = fields.parts.branches[number].middle if number < len(fields.parts.branches) and name != "all" else slice(None)
        size = volumes[:, middle].sum(axis=1)
        at = int(np.where(chosen, longest, -1.0).argmax())
        rows.append([name, f"{np.linalg.norm(moves, axis=2)[:, weights > 0].max():.3g}", f"{since[worst]:.3g}", fields.place(worst),
                     f"{100 * (np.sqrt(size[systole] / size[rest]) - 1):.2f} %", f"{100 * quantile(longest[chosen], fields.areas[chosen], 0.99):.2f} %",
                     f"{100 * longest[at]:.2f} %", fields.place(fields.triangles[at][0])])
    return Table("Displacement and strain of the wall", f"Diastole: the output at {fields.outputs[rest][0] - fields.beat.start:.4g} ms of "
                 f"the beat, in which the lumen is smallest; systole: that at {fields.outputs[systole][0] - fields.beat.start:.4g} ms, in "
                 "which it is largest.",
                 ["branch", "displacement from the mesh, mm", "since diastole, mm", "at x, y, z, mm", "mean widening of the radius",
                  "strain, 99 % of the area below", "greatest", "at x, y, z, mm"], rows)


def distensibility(fields, volumes):
    """By branch, and the velocity of pulse waves that follows."""
    mean_of = [fields.run.nodal(group, "fluid", "pressure") for _, group in fields.outputs]
    if not fields.parts.branches or any(p is None for p in mean_of):
        return None
    rows = []
    for branch in fields.parts.branches:
        if not len(branch.middle):
            continue
        v = volumes[:, branch.middle]
        pressure = np.array([np.average(p.reshape(-1)[fields.parts.tets[branch.middle]].mean(axis=1), weights=w)
                             for p, w in zip(mean_of, v)])
        pulse, size = np.ptp(pressure), v.sum(axis=1)
        change = np.ptp(size) / size.min()
        if pulse <= 0 or change <= 0:
            continue
        d = change / pulse
        rows.append([branch.name, f"{pulse / MMHG:.1f}", f"{100 * change:.2f} %", f"{1000 * d * MMHG:.3g}", f"{d:.3g}",
                     f"{1 / np.sqrt(fields.density * d):.3g}"])
    return Table("Distensibility, and pulse wave velocity from it", "Of the middle half of each branch; the velocity is that of Bramwell "
                 f"and Hill with {fields.density:g} g/ml.",
                 ["branch", "pulse there, mmHg", "change of the lumen", "distensibility, 1/1000 mmHg", "1/kPa",
                  "velocity, m/s"], rows) if rows else None
