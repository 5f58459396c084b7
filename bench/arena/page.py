"""The page of the arena: tables and performance profiles of the results."""
import json
import os

import numpy

import catalogue
from contestants import CONTESTANTS
from pages import processor, table_text

# Less is below what clocks resolve, and counts as this.
LEAST_SECONDS = 0.02
LOST = 1.5

INTRODUCTION = """# The arena: who solves which saddle-point system, and how fast

Made by `bench/arena/run.py --published --page bench/arena`; this page is not edited by hand. Commits: {commits}. Processor: {processor}.
Pairs that have been run on one rank: {done} of {pairs}; a cell without an entry is a pair that has not. Another run makes the others.

**Systems.** Each is made from nothing by a function of `bench/arena/`, and compared with its checksum (`checksums.csv`). One is
written by `bench/arena/catalogue.py write FOLDER NAME SIZE`, as K.mtx and b.mtx. Those of FSI are exported by `tunica-solvers`.

**Rules.** Each pair of contestant and system runs in processes of its own, with at most {limits}. The arena itself judges x: each
field's residual, relative to what its rows add up, and the whole, |b − Kx| / |b|, have to be at most 1e-8 (the rule of
[docs/choosing.md](../../docs/choosing.md#measuring-solvers)). Seconds are processor seconds of all ranks together, of set-up and
solve without reading files; with other work on the machine those of the wall clock would mean nothing. Memory is that of the
largest process at its peak, with the files it has read. PETSc and SciPy may go on from a solution that the judge would not accept.
`tunica-solvers` is then run again with a tolerance of 1e-10 (* in the tables): its own 1e-8 is relative to the system as prepared.

**What they know.** Our default gets K.mtx and b.mtx, and the places of the nodes of solids in space (`beam-3d`, `plate-3d`,
`fsi-wall-3d`), nothing else. Without LU it shows how the iterations of its methods grow: the
small systems are otherwise solved by factors. Contestants of Trilinos run in `tunica-solvers`, so that they
profit from its preparation (order of unknowns, scaling, known values). Those of PETSc and SciPy get what an expert would give
them: the fields, the components of a node side by side, rigid motions, undetermined constants, and where textbooks know one
(`mass`) an approximation of the Schur complement.

**Left out.** PETSc's `PCBDDC`, which needs matrices that are not assembled across ranks (`MATIS`); Teko's PCD, which needs a Laplacian
and a convection matrix of the pressures; MueLu's Schwarz smoother with patches, which `tunica-solvers` does not reach for systems of
other programs. FROSch has a subdomain for each rank, and takes part on two ranks and more: on one it would be sparse LU. Its
subdomains are factored by KLU2, the only sparse LU of Debian's Amesos2 that takes indefinite matrices.
"""


def key_of(row):
    return row["size"], row["ranks"], row["contestant"], row["system"]


def read_results(path):
    """The last result of each pair; a line that a kill has cut is left out."""
    found = {}
    try:
        with open(path, encoding="utf-8") as file:
            lines = file.read().split("\n")
    except FileNotFoundError:
        return []
    for line in lines:
        try:
            row = json.loads(line)
        except ValueError:
            continue
        found[key_of(row)] = row
    return list(found.values())


def seconds(row):
    return max(row["setup"] + row["solve"], LEAST_SECONDS)


class Results:
    def __init__(self, rows):
        self.rows = {key_of(row): row for row in rows}
        self.names = [c.name for c in CONTESTANTS]

    def get(self, size, ranks, contestant, system):
        return self.rows.get((size, ranks, contestant, system))

    def systems(self, size, ranks=1):
        return [name for name in catalogue.CATALOGUE if any((size, ranks, c, name) in self.rows for c in self.names)]

    def of_system(self, size, system, ranks=1):
        found = [self.get(size, ranks, c, system) for c in self.names]
        return [row for row in found if row]

    def best(self, size, system, group=None, ranks=1):
        """The quickest that solves it, of a group of contestants; "peers" are all but ours."""
        groups = {c.name: c.group for c in CONTESTANTS}
        found = [row for row in self.of_system(size, system, ranks) if row["is_solved"]
                 and (group is None or (groups[row["contestant"]] == "ours") == (group == "ours"))]
        return min(found, key=seconds, default=None)

    def sizes(self, ranks=1):
        return [size for size in catalogue.SIZES if self.systems(size, ranks)]

    def ratios(self, size, contestant):
        """Seconds over those of the best, infinite where it fails; of the systems that two contestants have tried and one solves."""
        found = []
        for system in self.systems(size):
            best, row = self.best(size, system), self.get(size, 1, contestant, system)
            if best and row and len(self.of_system(size, system)) > 1:
                found.append(seconds(row) / seconds(best) if row["is_solved"] else numpy.inf)
        return numpy.array(found)


def number(value):
    return f"{value:.2f}" if value < 10 else f"{value:.0f}"


def cell(row):
    if row is None:
        return ""
    return f"{number(row['setup'] + row['solve'])} ({row['iterations']}{star(row)})" if row["is_solved"] else "–"


def star(row):
    return "*" if row["tolerance"] < 1e-8 else ""


def table_of_systems(results):
    known = {key: int(line["unknowns"]) for key, line in catalogue.known_checksums().items()}
    known.update({(system, size): row["unknowns"] for (size, _, _, system), row in results.rows.items()})
    rows = [[name, origin] + [f"{known[name, size]:,}" if (name, size) in known else "" for size in catalogue.SIZES]
            for name, (_, _, origin) in catalogue.CATALOGUE.items()]
    return "## Systems\n\n" + table_text(["system", "origin", *(f"unknowns, {size}" for size in catalogue.SIZES)], rows)


def table_of_contestants(results):
    rows = []
    for k, contestant in enumerate(CONTESTANTS, 1):
        line = [str(k), contestant.name, contestant.source]
        for size in results.sizes():
            tried = [row for system in results.systems(size) if (row := results.get(size, 1, contestant.name, system))]
            line.append(f"{sum(row['is_solved'] for row in tried)} of {len(tried)}" if tried else "")
            ratios = results.ratios(size, contestant.name)
            line.append(str(int((ratios <= LOST).sum())) if len(ratios) else "")
        rows.append(line)
    head = ["", "contestant", "settings from"]
    for size in results.sizes():
        head += [f"{size}: solved", f"within {LOST} times the best"]
    return "## Contestants, one rank\n\n" + table_text(head, rows)


def table_of_default(results, size):
    rows = []
    for system in results.systems(size):
        row, ours, peer = (results.get(size, 1, "default", system), results.best(size, system, "ours"),
                           results.best(size, system, "peers"))
        best = results.best(size, system)
        if row is None:
            continue
        line = [system, f"{row['unknowns']:,}"]
        if row["is_solved"]:
            line += [row["used"], f"{row['iterations']}{star(row)}", number(row["setup"]), number(row["solve"]), f"{row['memory']:.0f}"]
        else:
            line += ["fails", "", "", "", ""]
        line += [f"{found['contestant']}, {number(seconds(found))}" if found else "none" for found in (ours, peer)]
        line.append(number(seconds(row) / seconds(best)) if row["is_solved"] else "–" if best else "")
        rows.append(line)
    return (f"## The default, {size} systems, one rank\n\n"
            + table_text(["system", "unknowns", "solved by", "iterations", "set-up s", "solve s", "MB", "best of ours, s",
                          "best peer, s", "default / best"], rows))


def table_of_all(results, size, ranks=1):
    present = [(k, c.name) for k, c in enumerate(CONTESTANTS, 1)
               if any(results.get(size, ranks, c.name, s) for s in results.systems(size, ranks))]
    rows = [[system] + [cell(results.get(size, ranks, name, system)) for _, name in present]
            for system in results.systems(size, ranks)]
    title = f"## All, {size} systems, {ranks} rank{'s' if ranks > 1 else ''}: seconds (iterations)\n\n"
    return title + "Numbers of contestants as above; – fails.\n\n" + table_text(["system", *(str(k) for k, _ in present)], rows)


def tables_of_ranks_for_all(results):
    """Of sizes and ranks that more contestants than the default have tried."""
    tried = {(list(catalogue.SIZES).index(size), size, ranks) for size, ranks, contestant, _ in results.rows
             if ranks > 1 and contestant != "default"}
    return [table_of_all(results, size, ranks) for _, size, ranks in sorted(tried)]


def table_of_growth(results):
    """Iterations from size to size."""
    sizes = results.sizes()
    if not sizes:
        return ""
    names = ["default"] + [name for name in results.names if name != "default" and
                           sum(numpy.isfinite(results.ratios(sizes[-1], name))) > len(results.systems(sizes[-1])) / 2]
    rows = []
    for system in results.systems(sizes[-1]):
        line = [system]
        for name in names:
            found = [results.get(size, 1, name, system) for size in sizes]
            line.append(" → ".join(f"{row['iterations']}" if row and row["is_solved"] else "–" if row else "" for row in found))
        rows.append(line)
    return ("## Growth of iterations with size: " + " → ".join(sizes) + "\n\n" + table_text(["system", *names], rows))


def table_of_ranks(results):
    all_ranks = sorted({ranks for _, ranks, _, _ in results.rows})
    if len(all_ranks) < 2:
        return ""
    text = ""
    for size in catalogue.SIZES:
        names = [name for name in results.names if any(results.get(size, r, name, s) for r in all_ranks[1:]
                                                       for s in catalogue.CATALOGUE)]
        rows = []
        for system in catalogue.CATALOGUE:
            line = [system]
            for name in names:
                found = [results.get(size, ranks, name, system) for ranks in all_ranks]
                line.append(", ".join(str(row["iterations"]) if row and row["is_solved"] else "–" if row else "?" for row in found))
            rows.append(line)
        if names:
            text += (f"## Iterations on {', '.join(map(str, all_ranks))} ranks, {size} systems\n\n"
                     + table_text(["system", *names], rows) + "\n")
    return text


def table_of_losses(results):
    """Where the default fails or takes more than LOST times the seconds of the best."""
    rows = []
    for size in results.sizes():
        for system in results.systems(size):
            row, best = results.get(size, 1, "default", system), results.best(size, system)
            if row is None or best is None or (row["is_solved"] and seconds(row) <= LOST * seconds(best)):
                continue
            ratio = number(seconds(row) / seconds(best)) if row["is_solved"] else "fails"
            rows.append([system, size, ratio, f"{best['contestant']}, {number(seconds(best))} s",
                         row["message"].replace("|", "/") or f"{row['used']}: {row['iterations']} iterations"])
    return (f"## Where the default loses by more than {LOST}\n\n"
            + table_text(["system", "size", "default / best", "best", "what the default did"], rows))


def table_of_failures(results):
    rows = []
    for (size, ranks, contestant, system), row in results.rows.items():
        if not row["is_solved"]:
            rows.append((results.names.index(contestant), row["message"].replace("|", "/"), system, size, ranks))
    grouped = {}
    for place, message, system, size, ranks in rows:
        short = message if len(message) < 110 else message[:107] + "..."
        grouped.setdefault((place, short), []).append(f"{system} ({size}{f', {ranks} ranks' if ranks > 1 else ''})")
    lines = [[results.names[place], message, ", ".join(found)] for (place, message), found in sorted(grouped.items())]
    return "## Failures, with their messages\n\n" + table_text(["contestant", "message", "systems"], lines)


def draw_profiles(results, path):
    """Part of the systems that a contestant solves within a factor of the seconds of the best (Dolan and Moré 2002)."""
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "arena", "font.size": 9})
    from matplotlib import pyplot
    # One contestant alone is compared with nobody.
    sizes = [size for size in results.sizes() if any(numpy.isfinite(results.ratios(size, c.name)).any() for c in CONTESTANTS)]
    if not sizes:
        return
    figure, axes = pyplot.subplots(1, len(sizes), figsize=(6 * len(sizes), 6.5), squeeze=False, sharey=True)
    colours = {"ours": "tab:red", "Trilinos": "tab:blue", "PETSc": "tab:green", "SciPy": "tab:orange"}
    styles = ["-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 3)), (0, (6, 3, 1, 3)), (0, (8, 2))]
    for axis, size in zip(axes[0], sizes):
        counts = {}
        for contestant in CONTESTANTS:
            ratios = numpy.sort(results.ratios(size, contestant.name))
            place = counts[contestant.group] = counts.get(contestant.group, -1) + 1
            finite = ratios[numpy.isfinite(ratios)]
            if not len(finite):
                continue
            x = numpy.concatenate([[1.0], finite, [1e3]])
            y = numpy.concatenate([[0.0], numpy.arange(1, len(finite) + 1), [len(finite)]]) / len(ratios)
            axis.step(x, y, where="post", label=contestant.name, color=colours[contestant.group],
                      linestyle=styles[place % len(styles)], linewidth=2.5 if contestant.name == "default" else 1.0)
        axis.set(xscale="log", xlim=(1, 300), ylim=(0, 1.02), title=f"{size} systems, one rank",
                 xlabel="seconds over those of the best")
        axis.grid(alpha=0.3)
    axes[0][0].set_ylabel("part of the systems")
    axes[0][0].legend(fontsize=6.5, loc="lower right", ncol=2)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def write(rows, folder):
    """RESULTS.md and profiles.svg; returns the text."""
    results = Results(rows)
    pairs = sum(len(catalogue.CATALOGUE) * len(CONTESTANTS) for _ in results.sizes())
    done = sum(len(results.of_system(size, system)) for size in results.sizes() for system in catalogue.CATALOGUE)
    commits = ", ".join(sorted({row["commit"] for row in rows}))
    limits = "; ".join(f"{catalogue.SECONDS[s]} processor seconds of a rank and {catalogue.GIGABYTES[s]} GiB for {s} systems"
                       for s in results.sizes())
    draw_profiles(results, os.path.join(folder, "profiles.svg"))
    parts = [INTRODUCTION.format(commits=commits, processor=processor(), limits=limits, done=done, pairs=pairs),
             "![Performance profiles](profiles.svg)\n\n*Part of the systems that a contestant solves within a factor of the "
             "seconds of the best (Dolan and Moré 2002). Red: ours; blue: Trilinos; green: PETSc; orange: SciPy.*\n",
             table_of_contestants(results), *(table_of_default(results, size) for size in results.sizes()),
             table_of_losses(results), reasons(folder), table_of_growth(results), table_of_ranks(results),
             *(table_of_all(results, size) for size in results.sizes()), *tables_of_ranks_for_all(results),
             table_of_failures(results), table_of_systems(results)]
    text = "\n".join(part for part in parts if part)
    with open(os.path.join(folder, "RESULTS.md"), "w", encoding="utf-8") as file:
        file.write(text)
    return text


def reasons(folder):
    """What is written by hand beside the page."""
    try:
        with open(os.path.join(folder, "reasons.md"), encoding="utf-8") as file:
            return file.read()
    except FileNotFoundError:
        return ""
