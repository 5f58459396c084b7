"""How far a tube of thin walls widens under pressure: the compliance that the network of the vessel has.

The wall as it was imaged, of radius r and thickness h, bears the pressure p by the stretch l of its circumference; it
keeps its length and its volume. With the Cauchy stress s(l), the sum over the layers by their shares,

  p = s(l) h/r,   r dp/dr = h/r (ds/d ln l - 2 s) + k r

The first term: r grows with l, while h/r falls with 1/r^2. k is the stiffness of the tissue around the wall [kPa/mm].
"""
import math

from .errors import BadInput

STEP = 1e-4  # of ln l, for difference quotients


def energy(keys, l):
    """Energy [kPa] of a layer of these keys of `Wall / Layers`, stretched by l along its circumference only."""
    law = keys.get("law", "mooney-rivlin")
    if law == "st-venant-kirchhoff":
        strain, nu = 0.5 * (l * l - 1), keys.get("poisson ratio", 0.4)
        return 0.5 * keys.get("young modulus", 100.0) / (1 - nu * nu) * strain * strain
    first = l * l + 1 + 1 / (l * l)  # both invariants, with the axis kept
    c01 = keys.get("c01", 0.3 if law == "mooney-rivlin" else 0.0)
    found = 0.5 * (keys.get("c10", 3.0) + c01) * (first - 3)
    if law == "holzapfel":
        cos2 = math.cos(math.radians(keys.get("fibre angle", 29.0))) ** 2
        kappa, k2 = keys.get("dispersion", 0.0), keys.get("k2", 0.8393)
        e = kappa * (first - 3) + (1 - 3 * kappa) * (l * l - 1) * cos2
        if e > 0:
            found += keys.get("k1", 2.3632) / k2 * math.expm1(k2 * e * e)  # of both families
    return found


def stress(layers, l):
    """Cauchy stress l dW/dl [kPa], averaged over the thickness."""
    return sum(layer["share"] * (energy(layer["keys"], l * math.exp(STEP)) - energy(layer["keys"], l * math.exp(-STEP)))
               for layer in layers.values()) / (2 * STEP)


def stretch_under(layers, thickness, pressure):
    """The stretch at which the wall bears the pressure; thickness is a share of the radius."""
    low, high = 1.0, 3.0
    if stress(layers, high) < pressure / thickness:
        raise BadInput(f"--wall: layers as soft as these bear no {pressure:.3g} kPa with a thickness of {thickness:g} of the "
                       "radius")
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stress(layers, middle) < pressure / thickness else (low, middle)
    return low


def stiffness(layers, thickness, pressure, tissue_times_radius=0.0):
    """r dp/dr [kPa]. An exponent that softens is bounded: a wall that would burst has no beat."""
    l = stretch_under(layers, thickness, pressure)
    slope = (stress(layers, l * math.exp(STEP)) - stress(layers, l * math.exp(-STEP))) / (2 * STEP)
    found = thickness * (slope - 2 * pressure / thickness)
    if found <= 0:
        raise BadInput(f"--wall: layers as soft as these burst at {pressure:.3g} kPa with a thickness of {thickness:g} of the "
                       "radius")
    return found + tissue_times_radius


def compliance(radius, r_dp_dr):
    """dA/dp [mm^2/kPa] of a tube: 2 pi r dr/dp."""
    return 2 * math.pi * radius * radius / r_dp_dr


def wave_speed(r_dp_dr, density):
    """[mm/ms] of Bramwell and Hill: c^2 = A/rho dp/dA = r dp/dr / (2 rho)."""
    return math.sqrt(r_dp_dr / (2 * density))
