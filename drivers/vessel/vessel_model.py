"""The network of a vessel: resistance, inertance and compliance along its branches.

  R = integral of 8 mu / (pi r^4) ds     Poiseuille
  L = integral of rho / (pi r^2) ds      a flat profile; 4/3 of it with a parabolic one
  C = integral of dA/dp ds               thin_wall.py

Losses in stenoses, bends and junctions are not in it. What they add is seen in the first beat in three dimensions.
"""
import math

import numpy as np

from . import thin_wall
from .network import Branch
from .units import BLOOD_DENSITY, BLOOD_VISCOSITY

LONGEST = 4.0  # of a piece, in its mean radius times two: shorter than the waves that matter
MOST_PIECES = 6


def stiffness_at(wall, radius, pressure):
    """r dp/dr [kPa] of the wall with the tissue around it."""
    return thin_wall.stiffness(wall["layers"], wall["thickness"], pressure, wall["tissue"] * radius)


def pieces_of(branch, wall, pressure):
    """A branch of lumen.json as pieces of the network."""
    points, radii = np.array(branch["points"]), np.array(branch["radii"])
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    r = 0.5 * (radii[1:] + radii[:-1])
    R = 8 * BLOOD_VISCOSITY / (math.pi * r ** 4) * step
    L = BLOOD_DENSITY / (math.pi * r ** 2) * step
    C = np.array([thin_wall.compliance(ri, stiffness_at(wall, ri, pressure)) for ri in r]) * step
    total = [max(float(v.sum()), 1e-12) for v in (R, L, C)]
    count = int(np.clip(math.ceil(step.sum() / (LONGEST * r.mean())), 1, MOST_PIECES))
    inner = [f"{branch['start']} to {branch['end']}, {k}" for k in range(1, count)]
    names = [branch["start"], *inner, branch["end"]]
    return [Branch(names[k], names[k + 1], *(v / count for v in total)) for k in range(count)]


def build(table, wall, pressure):
    """All pieces of the vessel at this pressure [kPa]."""
    return [piece for branch in table["branches"] for piece in pieces_of(branch, wall, pressure)]


def impedance(opening, wall, pressure):
    """Characteristic impedance rho c/A of an opening [kPa ms/mm^3]."""
    c = thin_wall.wave_speed(stiffness_at(wall, opening["radius"], pressure), BLOOD_DENSITY)
    return BLOOD_DENSITY * c / opening["area"]
