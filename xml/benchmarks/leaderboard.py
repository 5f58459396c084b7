"""All benchmarks in one table: how far off, of how many unknowns, at what cost; ours on the finest mesh beside what others publish."""
import csv
import os

from pages import commits_of, record_of, rows_of

# Who, of what size, and what is off, in parts; by benchmark. Costs of theirs are not published.
OTHERS = {
    "obstacle": (("Richter's finest, Q2 elements", "7.6 million unknowns", {"displacement": -0.0006, "force": 0.0083}),
                 ("finite volumes", "485,000 fluid cells", {"displacement": -0.0221, "force": -0.0142})),
    "elastic-tube": (("finite volumes", "64 x (20 + 8) cells", {"velocity profile": 0.0049, "flow": 0.0004, "radial displacement": -0.0011}),),
    "turek-hron": (("Featflow's second mesh, Q2-P1", "19,000 unknowns", {"u_x(A)": 0.0073, "u_y(A)": -0.0019, "drag": -0.0014, "lift": -0.0026}),),
    "collapsible-channel": (("finite volumes, partitioned, 16 iterations a step", "80 x 8 cells in the wall", {"static, ½": -0.167}),
                            ("the same", "640 x 8 cells in the wall", {"static, ½": -0.0022})),
    "silicone-flap": (("finite volumes", "230,000 cells", {"tip": 0.0085}), ("finite volumes", "810,000 cells", {"tip": 0.0024}),
                      ("inf-sup stable elements", "", {"tip": 0.030}), ("elements of equal order", "", {"tip": -0.049})),
    "pressure-pulse": (("finite volumes", "22,400 cells", {"largest u_r": 0.0074, "least u_z": 0.0135}),),
}
KEYS = ("benchmark", "level", "unknowns", "steps", "seconds", "commit")


def cost_of(folder):
    """Unknowns, accepted steps and core-seconds of a run's march: by its processor's time where that was kept, else by the clock."""
    record = record_of(folder)
    sizes = record["sizes"]
    unknowns = sizes.get("system unknowns") or sizes.get("fluid unknowns") or sizes.get("wall unknowns")
    timings = record["timings"]
    seconds = timings.get("march from the first step", timings["march"]) * record["ranks"]
    try:
        with open(folder + ".cpu", encoding="utf-8") as file:
            seconds = float(file.read())
    except FileNotFoundError:
        pass
    return unknowns, record["steps"]["accepted"], seconds


def update(benchmarks, page):
    """Rows of costs.csv: of the finest run of these benchmarks anew, of others as they are; by benchmark."""
    path = os.path.join(page, "costs.csv")
    costs = {row["benchmark"]: row for row in rows_of(path)}
    for benchmark in benchmarks:
        if found := benchmark.finest_run():
            folder = benchmark.folder(*found)
            unknowns, steps, seconds = cost_of(folder)
            commits = [commit for commit, names in commits_of(benchmark.output).items() if os.path.basename(folder) in names]
            costs[benchmark.name] = dict(zip(KEYS, (benchmark.name, f"{found[0]:g}", str(unknowns), str(steps), f"{seconds:.4g}",
                                                    "".join(commits))))
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.DictWriter(file, KEYS, lineterminator="\n")
        rows.writeheader()
        rows.writerows(costs.values())
    return costs


def errors_text(errors):
    return ", ".join(f"{name} {100 * error:+.2g} %" for name, error in errors.items())


def section(titles, errors, costs):
    """titles: name -> title; errors: name -> level -> quantity -> error; costs: as update() returns them."""
    lines = ["## Leaderboard", "", "Ours on the finest meshes above, others as they have been published. Core-seconds are a whole "
             "run's processor time by its steps, or where that was not kept the time of its march by the clock; of steady flows a step "
             "is one in pseudo-time. The machine is a virtual one of 2.6 GHz whose memory others use, too.", "",
             "| benchmark | code | size | off by | core-s a step | core-s a step and million unknowns |", "|---|---|---|---|---|---|"]
    for name in (name for name in titles if name in errors):
        finest = {quantity: error for level in sorted(errors[name]) for quantity, error in errors[name][level].items()}
        size = step = relative = ""
        if name in costs:
            unknowns, seconds = int(costs[name]["unknowns"]), float(costs[name]["seconds"]) / int(costs[name]["steps"])
            size, step, relative = f"{unknowns:,} unknowns", f"{seconds:.3g}", f"{1e6 * seconds / unknowns:.3g}"
        lines.append(f"| {titles[name]} | **Tunica** | {size} | {errors_text(finest)} | {step} | {relative} |")
        lines += [f"| | {who} | {of_size} | {errors_text(off)} | | |" for who, of_size, off in OTHERS.get(name, ())]
    return [*lines, ""]
