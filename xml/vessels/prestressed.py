"""Walls that were imaged under pressure: the runs and tables of `reproduce prestress` and `reproduce systole`."""
import os

from flat_elements import HERE, commits_text, effort_of, folder_of, mesh_of, timed, write_effort
from pages import command, keep_results, record_of, rows_of, table_text, write_commit

PRESSURE = 10.67  # kPa, 80 mmHg
# shape -> surfaces at the outlets' walls, where fibres end
OUTLETS = {"arch": ["descending", "brachiocephalic", "carotid", "subclavian"], "carotid": ["internal", "external"]}
SHARES = {"0.1": {"arch": "arch-0.1", "carotid": "carotid-0.1"}, "0.15": {"arch": "arch", "carotid": "carotid-0.15"}}
FIBRES = {"media": {"law": "holzapfel", "c10": "60", "k1": "47"}, "adventitia": {"law": "holzapfel", "c10": "12", "k1": "11"}}
LAWS = {"c10 = 100 kPa": {layer: {"c10": "100"} for layer in FIBRES}, "c10 = 200 kPa": {}, "fibres": FIBRES}
# name -> shape, share of the radius, law, tissue around it
WALLS = {f"{shape}-{share}-{law.split()[-2] if ' ' in law else law}": (shape, share, law, True)
         for shape in OUTLETS for share in SHARES for law in LAWS}
WALLS.update({f"{shape}-{share}-free": (shape, share, "c10 = 200 kPa", False) for shape, share in (("arch", "0.15"), ("carotid", "0.1"))})
SYSTOLES = {"arch": "arch", "carotid": "carotid"}  # case -> mesh


def settings_of(name):
    shape, _, law, has_tissue = WALLS[name]
    settings = [f"Wall/Layers/{layer}/{key}={value}" for layer, keys in LAWS[law].items() for key, value in keys.items()]
    if law == "fibres":
        ends = ", ".join("wall_outlet_" + outlet for outlet in OUTLETS[shape])
        settings += ["Wall/Fibre Frame/kind=laplace", "Wall/Fibre Frame/start surfaces={wall_inlet}",
                     f"Wall/Fibre Frame/end surfaces={{{ends}}}"]
    return settings + ([] if has_tissue else ["Wall/Surfaces/outer/stiffness=0"])


def run(wanted, name, ranks, program, case, settings):
    """One run with its effort beside it, unless there is one."""
    folder = folder_of(wanted, name, ranks)
    if effort_of(folder):
        return
    keep_results(folder, wanted.overwrite)
    words = command(os.path.join(wanted.programs, program),
                    [os.path.join(HERE, "solvers", case + ".xml"), "--output", folder, "--overwrite"], settings + wanted.set, ranks)
    print(f"{name}, ranks: {ranks} ...", end=" ", flush=True)
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    with open(folder + ".log", "w", encoding="utf-8") as log:
        status, seconds = timed(words, log, wanted.most_seconds)
    write_commit(folder)
    write_effort(folder, status, seconds)
    print(f"{seconds:.0f} s, " + ("done" if status == 0 else f"ends with {status}, see {log.name}"), flush=True)


# 1. The prestress alone, beside one static load of a quarter of the pressure.

def run_prestress(wanted):
    for name, (shape, share, _, _) in WALLS.items():
        mesh = [f"Mesh/file={mesh_of(wanted, SHARES[share][shape])}"]
        prestress = [f"Wall/Prestress/pressure={PRESSURE}", f"Wall/Surfaces/interface/pressure={PRESSURE}"]
        for ranks in wanted.ranks:
            run(wanted, f"prestress-{name}", ranks, "tunica-solid", shape + "-wall", mesh + settings_of(name) + prestress)
        run(wanted, f"static-{name}", 1, "tunica-solid", shape + "-wall", mesh + settings_of(name))


def prestress_cells(wanted, name, ranks):
    folder = folder_of(wanted, f"prestress-{name}", ranks)
    rows = rows_of(os.path.join(folder, "prestress.csv"))
    effort, static = effort_of(folder), effort_of(folder_of(wanted, f"static-{name}", 1))
    last = rows[-1]
    status = effort["status"]
    ending = "found" if status == 0 else "stopped" if status is None else "not found"
    ratio = f"{effort['cpu seconds'] / static['cpu seconds']:.1f}" if static.get("status") == 0 else "–"
    moved = max((float(row["max_displacement_wall_mm"]) for row in rows_of(os.path.join(folder, "steps.csv"))), default=None)
    held = [float(last[f"tissue_{which}_kPa"]) for which in ("mean", "largest")]
    return [f"{ending}, load {float(last['load']):.2f}", str(len(rows)), f"{effort['cpu seconds']:.0f}", ratio,
            f"{float(last['min_det_G']):.2f} to {float(last['max_det_G']):.2f}",
            f"{held[0]:.2f}, {held[1]:.1f}" if held[1] > 0.0 else "–", f"{moved:.0e}" if moved is not None else "–"]


def prestress_section(wanted):
    lines = []
    for name, (shape, share, law, has_tissue) in WALLS.items():
        for ranks in wanted.all_ranks:
            folder = folder_of(wanted, f"prestress-{name}", ranks)
            if effort_of(folder) and rows_of(os.path.join(folder, "prestress.csv")):
                lines.append([shape, share + " r", law, "5 kPa/mm" if has_tissue else "none", str(ranks)] +
                             prestress_cells(wanted, name, ranks))
    if not lines:
        return []
    return ["## The prestress of walls of 0.1 and 0.15 of the radius", "",
            f"Made by `xml/vessels/reproduce prestress`: {PRESSURE} kPa (80 mmHg), two layers of one neo-Hookean law or of fibres in "
            "two families, clamped ends; all of the search by default. Beside its CPU seconds their ratio to one static load of 2.67 "
            "kPa on the same wall, programs begun and ended included. Tissue: what its springs hold in the mesh, root mean square and "
            "at most, where the wall alone cannot. Moved: of the wall in a static step that follows under the pressure of the image. "
            + commits_text(wanted, lambda name: name.startswith(("prestress-", "static-"))), "",
            *table_text(["vessel", "wall", "law", "tissue", "ranks", "prestress", "steps", "CPU s", "static loads", "det G",
                         "tissue holds, kPa", "moved, mm"], lines).splitlines(), ""]


# 2. The first 100 ms of a systole.

def run_systole(wanted):
    for name, mesh in SYSTOLES.items():
        for ranks in wanted.ranks:
            run(wanted, f"systole-{name}", ranks, "tunica-fsi", name + "-beat", [f"Mesh/file={mesh_of(wanted, mesh)}"])


def systole_cells(folder):
    record, steps = record_of(folder), rows_of(os.path.join(folder, "steps.csv"))
    first, rest = steps[0], steps[1:]

    def total(rows, column):
        return sum(float(row[column]) for row in rows)
    newton, linear = "system_newton", "system_linear"
    memory = record["memory"]["peak of all ranks [MB]"]
    unknowns = sum(value for key, value in record["sizes"].items() if key.endswith(" unknowns"))
    cells = [f"{unknowns:,}", str(record["prestress"]["iterations"]), str(len(steps)), f"{first[newton]}, {first[linear]}"]
    return cells + [f"{total(rest, newton) / len(rest):.1f}, {total(rest, linear) / len(rest):.1f}",
                    f"{total(rest, 'seconds') / len(rest):.1f}", f"{memory:,.0f}"]


def systole_section(wanted):
    lines = []
    for name in SYSTOLES:
        for ranks in wanted.all_ranks:
            folder = folder_of(wanted, f"systole-{name}", ranks)
            if effort_of(folder) and len(rows_of(os.path.join(folder, "steps.csv"))) > 1:
                lines.append([name, str(ranks)] + systole_cells(folder))
    if not lines:
        return []
    return ["## The beginning of a beat", "",
            "Made by `xml/vessels/reproduce systole` from `xml/vessels/solvers/arch-beat.xml` and `carotid-beat.xml`: prestress, then steps "
            "of 5 ms from rest, in which the inflow rises; all solvers by default. "
            + commits_text(wanted, lambda name: name.startswith("systole-")), "",
            *table_text(["vessel", "ranks", "unknowns", "steps of the prestress", "time steps", "Newton steps, iterations of the first",
                         "of each after it", "seconds a step", "memory of all ranks, MB"], lines).splitlines(), ""]
