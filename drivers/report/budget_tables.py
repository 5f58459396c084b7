"""The budget of a run: totals of mass, forces, energy and volume with a verdict each, as run.json has them."""
from report.tables import Table

TOTALS, VERDICTS, ENERGIES = "budget", "budget verdicts", "budget of energy [kPa mm^3]"  # sections of run.json
TERMS = {"load_power": "loads: tractions, pressures, Windkessels, tissue",
         "reaction_power": "prescribed velocities and displacements",
         "kinetic_inflow": "kinetic energy that flows in",
         "viscous_power": "viscosity",
         "backflow_power": "stabilisation of backflow",
         "divergence_power": "divergence that elements have",
         "stabilisation_power": "stabilisation of the flow",
         "wall_stabilisation_power": "stabilisation of the wall",
         "interface_power": "velocities that differ at the interface",
         "power_error": "left by solvers",
         "scheme_power": "time scheme, and what relaxes in the wall",
         "energy_change": "stored"}


def _rows(record):
    """(of, sentence, part, bound) of each verdict; none where the run has kept no budget."""
    totals, verdicts = record.get(TOTALS), record.get(VERDICTS)
    if not isinstance(totals, dict) or not isinstance(verdicts, dict):
        return []
    return [(of, verdicts[of].split(": ")[1], part, bound) for of, (_, _, part, bound) in totals.items() if of in verdicts]


def _is_kept(part, bound):
    return part is not None and part <= bound


def tables(record):
    """Of the verdicts, and of where the energy has gone."""
    rows = _rows(record)
    if not rows:
        return []
    found = [Table("Budget of the run", "What solvers leave should vanish with their tolerances; what scheme and time steps make, "
                   "with the mesh and the step. The steps are in budget.csv.",
                   ["balance of", "", "part", "permitted", "verdict"],
                   [[of, text, "–" if part is None else f"{part:.1e}", f"{bound:g}", "kept" if _is_kept(part, bound) else "NOT KEPT"]
                    for of, text, part, bound in rows])]
    energies = record.get(ENERGIES)
    if energies:
        work = record[TOTALS]["energy"][1]
        share = lambda value: f"{100 * value / work:.3g} %" if work else "–"  # noqa: E731
        stored = {"energy_change": -energies["energy_change"]} if "energy_change" in energies else {}
        found.append(Table("Where the energy went", "Positive where it came in; the sum is zero. In parts of all work.",
                           ["term", "kPa mm³", "of all work"],
                           [[TERMS.get(name, name), f"{value:.4g}", share(value)]
                            for name, value in {**energies, **stored}.items() if value]))
    return found


def alarm(record):
    """A sentence where solvers left more than is permitted, else nothing."""
    broken = [f"{of} ({'no number' if part is None else f'{part:.1e}'} where {bound:g} is permitted)" for of, text, part, bound in _rows(record)
              if not _is_kept(part, bound) and text.startswith("solvers")]
    return f"SOLVERS HAVE NOT KEPT THE BUDGET of {', '.join(broken)}: solve more accurately." if broken else ""
