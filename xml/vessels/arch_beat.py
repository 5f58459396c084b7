"""The arch from its surface to a beat: the runs and the pages of `reproduce arch`. Needs python3-gmsh, python3-vtk9 and
python3-h5py."""
import json
import os
import re
import subprocess
import time

from flat_elements import SCRIPTS, make
from pages import ENVIRONMENT, columns_of, commits_of, read_json, shrink, table_text, write_commit

# name -> options of tunica-mesh lumen, options of tunica-vessel
MESHES = {"coarse": (["--across", "4", "--layers", "1", "--first", "0.2"], ["--wall-elements", "2", "--step", "10"]),
          "fine": (["--across", "13"], [])}
GOALS = ["--inlet", "inlet", "--pressure", "120/80", "--flow", "5"]
OPENINGS = {"inlet": (-25, 3.9, 10.4), "outlet_descending": (18.2, 12.8, -30.8), "outlet_brachiocephalic": (-28.3, -7.1, 89.5),
            "outlet_subclavian": (29.7, 12.4, 88.3), "outlet_carotid": (-1.2, -5.8, 97.9)}  # centres [mm]
TABLES = ("Pressures", "Flows", "Windkessels", "Pulse wave velocity", "Shear stress at the wall", "Displacement and strain",
          "Distensibility", "Stress in the wall", "Does the beat repeat itself", "Budget of mass", "Budget of energy")
FIGURES = {"beat_pressures": "Pressures", "beat_flows": "Flows", "space_displacement": "Displacement from the mesh",
           "space_wall_shear_stress": "Wall shear stress", "space_time_averaged_wss": "Wall shear stress, averaged over the beat",
           "space_oscillatory_shear_index": "Oscillatory shear index", "space_largest_principal_stress": "Largest principal stress"}
TIMED = "seconds.json"  # of what comes before tunica-vessel


def folder_of(wanted, name):
    return os.path.join(os.path.abspath(wanted.output), "arch-" + name)


def is_done(folder):
    return "report" in read_json(os.path.join(folder, "stages.json")).get("stages", {})


def surface_of(wanted):
    """The files of the surface and of the names of its openings."""
    folder = os.path.join(os.path.abspath(wanted.output), "meshes")
    os.makedirs(folder, exist_ok=True)
    surface, names = (os.path.join(folder, file) for file in ("arch-raw.stl", "arch-openings.csv"))
    if not os.path.exists(surface):
        make(os.path.join(SCRIPTS, "make_vessel.py"), "arch", surface, "--raw", "on")
    with open(names, "w", encoding="utf-8") as file:
        file.writelines(f"{opening},{x},{y},{z}\n" for opening, (x, y, z) in OPENINGS.items())
    return surface, names


def lumen_of(wanted, name):
    """The mesh of the lumen, and what it took [s]."""
    surface, names = surface_of(wanted)
    lumen, seconds = (os.path.join(os.path.dirname(surface), f"arch-raw-{name}{end}") for end in (".h5", "-" + TIMED))
    if not os.path.exists(seconds):
        start = time.time()
        make(os.path.join(wanted.programs, "tunica-mesh"), "lumen", surface, lumen, *MESHES[name][0], "--names", names, "--overwrite")
        with open(seconds, "w", encoding="utf-8") as file:
            json.dump(time.time() - start, file)
    return lumen


def run_one(wanted, name, more):
    folder = folder_of(wanted, name)
    if is_done(folder):
        return
    words = [os.path.join(wanted.programs, "tunica-vessel"), lumen_of(wanted, name), *GOALS, *MESHES[name][1], *more, "--output", folder]
    if subprocess.run(words, env=ENVIRONMENT, check=False).returncode not in (0, 2):  # 2: more beats are needed
        raise SystemExit(f"reproduce: {' '.join(words)} fails")
    write_commit(folder)


def run_all(wanted):
    run_one(wanted, "coarse", [])
    run_one(wanted, "fine", ["--start-from", folder_of(wanted, "coarse")])


def sections_of(path):
    """Those of TABLES in the summary of a report, their headings one level lower."""
    with open(path, encoding="utf-8") as file:
        parts = re.split(r"^(?=## )", file.read(), flags=re.MULTILINE)
    return ["#" + part.rstrip() + "\n" for part in parts if part.startswith(tuple("## " + name for name in TABLES))]


def stages_table(wanted):
    rows = []
    for name in MESHES:
        folder = folder_of(wanted, name)
        stages, beats = read_json(os.path.join(folder, "stages.json"))["stages"], read_json(os.path.join(folder, "beats.json"))
        wall = read_json(os.path.join(folder, "wall.json"))
        lumen = read_json(os.path.join(wanted.output, "meshes", f"arch-raw-{name}-{TIMED}"))
        of_beats = sum(columns_of(os.path.join(folder, "results"))["seconds"])
        seconds = [lumen, stages["wall"]["seconds"], of_beats, stages["report"]["seconds"]]
        change = beats["beats"][-1]["change"]
        rows.append([name, f"{wall['mesh']['tetrahedra']:,}", str(len(beats["beats"])), f"{100 * change:.2g} %" if change else "–", *[f"{s / 60:.1f}" for s in seconds]])
    return table_text(["mesh", "tetrahedra", "beats", "change of the last", "minutes: lumen", "wall", "beats", "report"], rows).splitlines()


def draw(wanted):
    report, figures = os.path.join(folder_of(wanted, "fine"), "results", "report"), os.path.join(wanted.page, "figures")
    os.makedirs(figures, exist_ok=True)
    lines = []
    for name, text in FIGURES.items():
        source, target = os.path.join(report, name + ".png"), f"arch-{name.replace('space_', '').replace('_', '-')}.png"
        if os.path.exists(source):
            shrink(source, os.path.join(figures, target))
            lines += [f"{text}:", "", f"![{text}](figures/{target})", ""]
    return lines


def section(wanted):
    if not all(is_done(folder_of(wanted, name)) for name in MESHES):
        return []
    commits = ", ".join(commit for commit, names in commits_of(wanted.output).items() if any(name.startswith("arch-") for name in names))
    lines = ["## An aortic arch, from its surface to a beat", "",
             f"The surface of `meshes/make_vessel.py arch`, with the steps of its voxels, by `tunica-mesh lumen` and `tunica-vessel` for "
             f"120/80 mmHg and 5 l/min; the fine mesh starts from the beats of the coarse one. Steps of 10 and 5 ms, one rank; commit "
             f"{commits}. Minutes are of the clock; the machine may have had other work. `arch.xml` is the case on the coarse mesh.", "", *stages_table(wanted), "", "On the fine mesh:", ""]
    for part in sections_of(os.path.join(folder_of(wanted, "fine"), "results", "report", "summary.md")):
        lines += [part]
    return lines + draw(wanted)
