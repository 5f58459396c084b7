"""What is written: the mesh, with the wall grown again, the case that begins with the run, and a table."""
import copy
import json
import os
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py

from importer.raw import BadMesh
from lumen import quality, result


def files(out):
    """Names of all that is written."""
    stem = os.path.splitext(out)[0]
    return out, stem + ".xml", stem + ".json"


def write(run, wall, mesh, rims, target, plan, options, progress):
    out, case, table = files(options.out)
    folder = os.path.dirname(os.path.abspath(out))
    with tempfile.TemporaryDirectory(prefix=".adapt-", dir=folder) as drafts:
        lumen, draft = os.path.join(drafts, "lumen.h5"), os.path.join(drafts, "vessel.h5")
        name = run.wall_names[0] if wall is None else result.WALL
        result.write(mesh, rims, lumen, name, run.region)
        if wall is None:
            draft = lumen
        else:
            progress.stage("growing the wall")
            grow(run, wall, lumen, draft, drafts, options, progress)
        result.remember(target, draft)
        count = len(h5py.File(draft, "r")["tets"])
        os.replace(draft, out)
    write_case(run, out, case, options)
    write_table(mesh, plan, count, table, options)
    angles = quality.least_dihedral(mesh.points, mesh.tets)
    print(f"elements   {count:,} tetrahedra, {len(mesh.tets):,} of them in the lumen, of those {mesh.in_layers:,} in its layers; "
          f"{len(mesh.wall):,} triangles on the wall")
    print(f"angles     least between faces: {angles[mesh.in_layers:].min(initial=180.0):.1f} degrees in the core")
    print(f"written    {out}, {case}, {table} in {progress.seconds():.0f} s; tunica-{program(run)} {case} begins where the run "
          "ended")


def program(run):
    return "fsi" if "wall" in run.run.grids() else "fluid"


def grow(run, wall, lumen, draft, folder, options, progress):
    samples = os.path.join(folder, "thickness.h5")
    with h5py.File(samples, "w") as file:
        file["points"], file["thickness"] = wall.points, wall.thickness
    tool = os.path.join(options.programs, "tunica-mesh")
    words = [tool, "wall", lumen, draft, "--surfaces", result.WALL, "--layers", wall.text(), "--thickness-file", samples,
             "--interface", run.wall_names[0]]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    told = [line for line in done.stdout.split("\n") if line.strip()]
    for line in told if done.returncode == 0 else []:
        progress.say(line)
    if done.returncode != 0:
        raise BadMesh(f"{options.out}: the wall cannot be grown again: {told[-1] if told else tool}")


def write_case(run, out, path, options):
    """The run's, with another mesh and another beginning."""
    root = copy.deepcopy(run.case)
    put(root, "Mesh", "file", os.path.basename(out), "string")
    put(root, "Mesh", "scale", "1", "double")
    put(root, "Time", "initial state", run.folder, "string")
    put(root, "Output", "folder", "results/" + os.path.splitext(os.path.basename(out))[0], "string")
    ElementTree.indent(root)
    text = f"<!-- The case of {run.folder}, on a mesh that tunica-mesh adapt made of its errors. -->\n"
    with open(path, "w", encoding="utf-8") as file:
        file.write(text + ElementTree.tostring(root, encoding="unicode") + "\n")


def put(root, section, key, value, kind):
    parent = root.find(f"./ParameterList[@name='{section}']")
    if parent is None:
        parent = ElementTree.SubElement(root, "ParameterList", name=section)
    found = parent.find(f"./Parameter[@name='{key}']")
    if found is None:
        found = ElementTree.SubElement(parent, "Parameter", name=key, type=kind)
    found.set("value", value)


def write_table(mesh, plan, count, path, options):
    content = {"run": os.path.abspath(options.run), "tetrahedra": count, "of the lumen": len(mesh.tets), "in layers": mesh.in_layers,
               "layers": plan.layers, "growth": round(plan.growth, 4), "sizes": [float(plan.size.min()), float(plan.size.max())]}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(content, file, indent=1)
        file.write("\n")
