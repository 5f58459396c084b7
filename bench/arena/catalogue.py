"""Names, sizes and origins of the systems of the arena, and their checksums."""
import csv
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(HERE)), "xml"))

import flows  # noqa: E402
import fsi  # noqa: E402
import solids  # noqa: E402
from system import agree, checksum, write  # noqa: E402

SIZES = ("small", "medium", "large")
# Limits of a run, for each size.
SECONDS = {"small": 20, "medium": 60, "large": 600}
GIGABYTES = {"small": 4, "medium": 6, "large": 12}
CHECKSUMS = os.path.join(HERE, "checksums.csv")

# name: function, its argument for each size, origin.
CATALOGUE = {
    "stokes-taylor-hood-2d": (flows.stokes_taylor_hood_plane, (16, 48, 224), "channel, P2–P1, field after field"),
    "stokes-taylor-hood-3d": (flows.stokes_taylor_hood_space, (4, 8, 16), "duct, P2–P1, velocities by node"),
    "stokes-mini-2d": (flows.stokes_mini, (20, 56, 240), "channel, P1 with bubbles–P1, prescribed values in unit rows"),
    "stokes-p1p1-2d": (flows.stokes_p1p1_plane, (20, 64, 288),
                       "channel, P1–P1 with Brezzi and Pitkäranta's term, p first in each node, unit rows"),
    "stokes-p1p1-3d": (flows.stokes_p1p1_space, (6, 12, 32), "duct, P1–P1, p last in each node"),
    "stokes-q1q1-2d": (flows.stokes_q1q1_plane, (28, 80, 400),
                       "lid-driven cavity, Q1–Q1 with Bochev and Dohrmann's term, field after field, p but for a constant"),
    "stokes-q1q1-3d": (flows.stokes_q1q1_space, (8, 16, 40), "lid-driven cavity, Q1–Q1, p last in each node"),
    "stokes-mac-2d": (flows.stokes_mac_plane, (28, 90, 400), "closed box, marker and cell, C = 0"),
    "stokes-mac-3d": (flows.stokes_mac_space, (9, 18, 48), "closed box, marker and cell, C = 0"),
    "stokes-jumps-2d": (flows.stokes_jumps, (16, 48, 192), "sinking discs of 1e6 times the viscosity, P2–P1"),
    "unsteady-q1q1-3d": (flows.unsteady, (8, 16, 40), "cavity, a short time step, Q1–Q1"),
    "navier-stokes-2d": (flows.navier_stokes, (16, 48, 192), "Newton's matrix at Kovasznay's flow, Re = 40, P2–P1, unit rows"),
    "oseen-q1q1-2d": (flows.oseen_q1q1, (28, 80, 400), "recirculating wind, Re = 200, Q1–Q1 without upwinding"),
    "oseen-p1p1-2d": (flows.oseen_p1p1, (28, 80, 400), "recirculating wind, Re = 5000, P1–P1 with SUPG and PSPG"),
    "rotating-3d": (flows.rotating, (8, 16, 40), "rotating box, Ekman number 1e-3, P1–P1"),
    "brinkman-2d": (flows.brinkman, (16, 48, 192), "obstacles of permeabilities down to 1e-6, P2–P1"),
    "darcy-2d": (flows.darcy_plane, (20, 72, 320), "Raviart–Thomas fluxes, permeabilities of 1e-4 to 1"),
    "darcy-3d": (flows.darcy_space, (5, 10, 28), "Raviart–Thomas fluxes, permeabilities of 0.01 to 1"),
    "cook-2d": (solids.cook, (16, 48, 192), "Cook's membrane, incompressible, P2–P1"),
    "beam-3d": (solids.beam, (4, 9, 22), "bent beam, nu = 0.49999, P1–P1"),
    "plate-3d": (solids.plate, (8, 16, 48), "thin steel plate with flat elements, incompressible, P1–P1, SI units, unit rows"),
    "contact-2d": (solids.contact, (16, 52, 240), "two blocks, mortar multipliers in the contact face"),
    "porous-2d": (solids.porous, (16, 48, 192), "Biot's consolidation, P2–P1"),
    "control-2d": (solids.control, (28, 80, 400), "optimal control of a Poisson equation, weight 1e-4, P1"),
    "weak-boundary-2d": (solids.weak_boundary, (40, 140, 600), "Poisson equation, boundary values by multipliers, P1"),
    "fsi-fluid-3d": (fsi.fluid, ("small", "medium", "large"), "pulse in a tube, the fluid's Jacobian, P1–P1"),
    "fsi-wall-3d": (fsi.wall, ("small", "medium", "large"), "pulse in a tube, the wall's Jacobian, two layers, P1–P1"),
    "fsi-monolithic-3d": (fsi.monolithic, ("small", "medium", "large"), "pulse in a tube, monolithic Jacobian, P1–P1"),
}


def make(name, size):
    function, arguments, _ = CATALOGUE[name]
    return function(arguments[SIZES.index(size)])


def known_checksums():
    """(name, size) -> checksum"""
    try:
        with open(CHECKSUMS, newline="", encoding="utf-8") as file:
            return {(row["name"], row["size class"]): row for row in csv.DictReader(file)}
    except FileNotFoundError:
        return {}


def rounding_of(name):
    """Jacobians depend on an iteration that ends at a tolerance."""
    return 1e-6 if name.startswith("fsi-") else 1e-9


def written(name, size, folder):
    """Folder of the system's files, made unless they exist. Raises where its checksum is not the recorded one."""
    path = os.path.join(folder, f"{name}-{size}")
    if os.path.exists(os.path.join(path, "known.json")):
        return path
    system = make(name, size)
    recorded = known_checksums().get((name, size))
    if recorded and not agree(checksum(system), recorded, rounding_of(name)):
        raise RuntimeError(f"{name}, {size}: the checksum is not the recorded one")
    write(system, path)
    return path


def record(chosen, sizes):
    """Adds the checksums of systems to the file."""
    known = known_checksums()
    for name in chosen:
        for size in sizes:
            known[name, size] = {"name": name, "size class": size, **checksum(make(name, size))}
            print(name, size, known[name, size]["unknowns"], flush=True)
            columns = list(known[name, size])
            with open(CHECKSUMS, "w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, columns, lineterminator="\n")
                writer.writeheader()
                places = {name: k for k, name in enumerate(CATALOGUE)}
                writer.writerows(known[key] for key in sorted(known, key=lambda key: (places[key[0]], SIZES.index(key[1]))))


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("write", "record"):
        sys.exit("usage: catalogue.py write FOLDER [NAME [SIZE]] | record NAME|all SIZE")
    if sys.argv[1] == "record":
        record(list(CATALOGUE) if sys.argv[2] == "all" else [sys.argv[2]], [sys.argv[3]])
    else:
        for one in sys.argv[3:4] or CATALOGUE:
            print(written(one, sys.argv[4] if len(sys.argv) > 4 else "small", sys.argv[2]))
