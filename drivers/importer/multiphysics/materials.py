"""Fluids and walls: the parameters of a Domain, or of an equation without any, as keys of Tunica."""
from .tree import meant

LAWS = {"neoHookean": "neo-hookean", "nHK": "neo-hookean", "stVenantKirchhoff": "st-venant-kirchhoff",
        "stVK": "st-venant-kirchhoff", "Mooney-Rivlin": "mooney-rivlin", "MR": "mooney-rivlin", "HGO": "holzapfel",
        "Guccione": None, "Gucci": None, "HolzapfelOgden": None, "HolzapfelOgden-ModifiedAnisotropy": None, "Lee-Sacks": None,
        "CANN": None}
VISCOSITIES = {"Constant": "newtonian", "Newtonian": "newtonian", "Carreau-Yasuda": "carreau-yasuda", "Cassons": "casson"}
QUADRATIC = ("quad", "quadratic")
STIFF = 1000.0  # bulk modulus over shear modulus, where the wall of svMultiPhysics is exactly incompressible


def fluid(domain, units, notes):
    entries = [("density", units.density * domain.number("Density", 0.5))]
    viscosity = domain.one("Viscosity")
    if viscosity is None:
        domain.required("Viscosity")
    law = meant(domain.file, f"{viscosity.place}: the model", viscosity.name("model"), VISCOSITIES)
    if law == "carreau-yasuda":
        return entries + [
            ("law", law), ("viscosity", units.viscosity * viscosity.number("Limiting_high_shear_rate_viscosity")),
            ("viscosity at rest", units.viscosity * viscosity.number("Limiting_low_shear_rate_viscosity")),
            ("time constant", units.time * viscosity.number("Shear_rate_tensor_multiplier")),
            ("power", viscosity.number("Power_law_index")), ("sharpness", viscosity.number("Shear_rate_tensor_exponent"))]
    if law == "casson":
        notes.add(f"{viscosity.place}", "viscosity by Casson's law", "its limit at high shear rates is taken as a constant")
        viscosity.skip("Yield_stress_parameter", "Low_shear_rate_threshold")
        return entries + [("viscosity", units.viscosity * viscosity.number("Asymptotic_viscosity_parameter") ** 2)]
    return entries + [("viscosity", units.viscosity * viscosity.number("Value"))]


def wall(domain, units, notes):
    """(entries of a layer, whether its law has fibres)"""
    model = domain.one("Constitutive_model")
    law = "neo-hookean" if model is None else meant(domain.file, f"{model.place}: the type", model.name("type"), LAWS)
    E = units.pressure * domain.number("Elasticity_modulus", 1e7)
    nu = domain.number("Poisson_ratio", 0.3)
    mu = 0.5 * E / (1.0 + nu)
    entries = [("density", units.density * domain.number("Density", 0.5))]
    refuse_viscosity(domain, notes)
    if law == "st-venant-kirchhoff":
        return [("law", law)] + entries + st_venant(domain, E, nu, notes), False
    if law is None:
        mu, law = stand_in(model, mu, units, notes), "neo-hookean"
    constants = {"neo-hookean": neo_hookean, "mooney-rivlin": mooney_rivlin, "holzapfel": holzapfel}[law]
    return ([("law", law)] + entries + constants(model, mu, units, notes) + [bulk(domain, E, nu, mu, units, notes)],
            law == "holzapfel")


def stand_in(model, mu, units, notes):
    """Shear modulus of a law that Tunica does not have, at small strains; the mean where it depends on the direction.

    Guccione: c b_fs/2 in both planes of the fibre, c b_t/2 across; Holzapfel and Ogden: a; others: mu as given.
    """
    kind, why = model.name("type").lower(), "by Elasticity_modulus and Poisson_ratio"
    if kind.startswith("gucci"):
        mu = units.pressure * model.number("c") * (2.0 * model.number("bfs") + model.number("bt")) / 6.0
        why = "of this law at small strains, the mean over directions"
    elif kind.startswith("holzapfelogden"):
        mu, why = units.pressure * model.number("a"), "of this law's matrix at small strains"
    notes.add(model.place, "a law that Tunica does not have",
              f"neo-hookean stands in for it, with the shear modulus {why}, {mu:.4g} kPa: other stresses. Choose a law and its "
              "constants before you run it")
    model.skip()
    return mu


def neo_hookean(model, mu, units, notes):
    return [("c10", mu, "kPa, shear modulus: energy c10/2 (J1 - 3)")]


def mooney_rivlin(model, mu, units, notes):
    """Their energy is c1 (J1 − 3) + c2 (J2 − 3), ours has half of our constants."""
    notes.add(model.place, "some versions of svMultiPhysics put c2 in place of c1, too", "both are taken as they are given")
    return [("c10", 2.0 * units.pressure * model.number("c1"), "twice c1: energy c10/2 (J1 - 3)"),
            ("c01", 2.0 * units.pressure * model.number("c2"), "twice c2")]


def holzapfel(model, mu, units, notes):
    values = {key: model.number(key) for key in ("a4", "b4", "a6", "b6")}
    for one, other in (("a4", "a6"), ("b4", "b6")):
        if values[one] != values[other]:
            notes.add(f"{model.place} / {one}, {other}", "families of fibres that differ", "both have the mean")
    notes.add(model.place, "fibres resist compression, too", "fibres carry tension only")
    return [("c10", mu, "kPa, E/(2(1 + nu))"),
            ("k1", units.pressure * 0.5 * (values["a4"] + values["a6"]), "a4 and a6"),
            ("k2", 0.5 * (values["b4"] + values["b6"]), "b4 and b6"), ("dispersion", model.number("kappa"))]


def bulk(domain, E, nu, mu, units, notes):
    """κ of p = −κ (J − 1)."""
    penalty = domain.word("Dilational_penalty_model", "ST91")
    if penalty.lower() not in QUADRATIC:
        notes.add(f"{domain.place} / Dilational_penalty_model = {penalty}", "pressure as another function of the volume J",
                  "kappa (J - 1), the same to first order in J - 1")
    if domain.has("Penalty_parameter"):
        return "bulk modulus", units.pressure * domain.number("Penalty_parameter"), "kPa, Penalty_parameter"
    if nu < 0.5:
        return "bulk modulus", E / (3.0 * (1.0 - 2.0 * nu)), "kPa, E/(3(1 - 2 nu))"
    notes.add(f"{domain.place} / Poisson_ratio = {nu:g}", "an exactly incompressible wall",
              f"nearly: a bulk modulus of {STIFF:g} shear moduli")
    return "bulk modulus", STIFF * mu, "kPa"


def st_venant(domain, E, nu, notes):
    notes.add(domain.place, "St. Venant-Kirchhoff's law with a dilational penalty in addition, in newer versions",
              "the plain law, without the penalty")
    domain.skip("Dilational_penalty_model", "Penalty_parameter")
    if nu > 0.4999:
        notes.of_key(domain, "Poisson_ratio", "an incompressible wall", "0.4999, the most that the law bears here")
    return [("young modulus", E), ("poisson ratio", min(nu, 0.4999))]


def refuse_viscosity(domain, notes):
    viscosity = domain.one("Viscosity")
    if viscosity is not None and viscosity.number("Value", 0.0) != 0.0:
        notes.add(viscosity.place, "a wall of this viscosity", "elastic; viscous fraction and relaxation time of a layer are another "
                  "model")
