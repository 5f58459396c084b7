"""Walls by kind of vessel: thickness, layers, tissue, and what the flow into it usually is. Keys: src/REFERENCES.md.

Sources
  shape of the law of two layers with fibres: [HGO00], for the carotid of a rabbit from a stress-free state: media c10 = 3 kPa,
    k1 = 2.3632 kPa, k2 = 0.8393, 29 deg; adventitia c10 = 0.3 kPa, k1 = 0.562 kPa, k2 = 0.7112, 62 deg to the circumference; media to
    adventitia 2 : 1. Its energy c/2 (I1 - 3) + k1/(2 k2) sum(exp(k2 (I - 1)^2) - 1) is that of `law` = holzapfel.
  stiffness: [Ol99], E h/r = 2e7 exp(-22.53 r) + 8.65e5, in g, cm and s; that is 2000 exp(-2.253 r) + 86.5 kPa, r in mm, in
    p = 4/3 E h/r (1 - sqrt(A0/A)). The moduli of [HGO00] are all multiplied by one factor, by which the thin tube of
    `thin_wall.py` widens at 80 mmHg as this says for `radius`. A test repeats it. That it holds at 80 mmHg, and for these four
    vessels, is assumed.
  thickness over radius, assumed after [NO05]: about 0.15 in the aorta, 0.2 and more in muscular arteries; cerebral arteries are
    thin for their size and lack an external elastic lamina.
  tissue: springs and dashpots as in [MX1]. The numbers are ours: a tenth of the stiffness of the wall itself or less, so that
    the tissue steadies the wall and does not bear its load.
"""
from math import exp

PAPER = "Holzapfel, Gasser and Ogden, J. Elasticity 61 (2000)"
STIFFNESS = "Olufsen, Am. J. Physiol. 276 (1999)"
HGO = {"media": {"c10": 3.0, "k1": 2.3632, "k2": 0.8393, "fibre angle": 29.0},
       "adventitia": {"c10": 0.3, "k1": 0.562, "k2": 0.7112, "fibre angle": 62.0}}


def source_of(name, factor):
    """Where the constants of a layer come from, for the comment in a case."""
    keys = HGO[name]
    return (f"{name} of a rabbit's carotid, {PAPER} (c10 {keys['c10']:g}, k1 {keys['k1']:g} kPa), times {factor:g}: the stiffness "
            f"of {STIFFNESS} at 80 mmHg, assumed")


def stiffened(factor):
    """Both layers with moduli so many times those of the source."""
    layers = {}
    for name, share in (("media", 2 / 3), ("adventitia", 1 / 3)):
        keys = dict(HGO[name], law="holzapfel")
        keys["c10"], keys["k1"] = round(factor * keys["c10"], 4), round(factor * keys["k1"], 4)
        layers[name] = {"share": share, "keys": keys, "source": source_of(name, factor)}
    return layers


# thickness: share of the radius. radius [mm]: that at which the stiffness is that of the source.
# tissue [kPa/mm], damping [kPa ms/mm]. flow [l/min]: usual mean; shape: of flow_shapes.py.
PRESETS = {
    "aorta": {"thickness": 0.15, "radius": 11.0, "layers": stiffened(42.0), "tissue": 1.0, "damping": 10.0,
              "flow": 5.0, "shape": "aorta"},
    "carotid": {"thickness": 0.2, "radius": 3.1, "layers": stiffened(33.0), "tissue": 2.0, "damping": 10.0,
                "flow": 0.4, "shape": "carotid"},
    "coronary": {"thickness": 0.25, "radius": 1.7, "layers": stiffened(41.0), "tissue": 5.0, "damping": 10.0,
                 "flow": 0.06, "shape": "coronary"},
    # One layer without fibres: two layers as above are not described there.
    "cerebral": {"thickness": 0.2, "radius": 1.5, "tissue": 5.0, "damping": 10.0, "flow": 0.25, "shape": "cerebral",
                 "layers": {"wall": {"share": 1.0, "keys": {"law": "neo-hookean", "c10": 285.0},
                                     "source": f"one layer without fibres; c10 by the stiffness of {STIFFNESS} at 80 mmHg, assumed"}}},
}


def olufsen(radius):
    """r dp/dr [kPa] near A0 of a tube of this radius [mm], [Ol99]."""
    return 4.0 / 3.0 * (2000.0 * exp(-2.253 * radius) + 86.5)
