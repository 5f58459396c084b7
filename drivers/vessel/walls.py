"""Stage wall: a wall of a preset or of a file grows around the lumen."""
import os
import xml.etree.ElementTree as ElementTree

import numpy as np

from . import lumen
from .errors import BadInput, nearest
from .flow_shapes import SHAPES
from .folder import read_json, write_json
from .mesh_file import Mesh
from .presets import PRESETS

MESH, TABLE = "vessel.h5", "wall.json"
READS = (lumen.MESH, lumen.TABLE)
RESULTS = (MESH, TABLE)
KEYS = {"thickness": float, "tissue": float, "damping": float, "flow": float, "shape": str}
SOURCED = ("thickness", "tissue", "damping")  # with a note in wall.json on where they come from
LARGEST = {"thickness": 1.0, "tissue": 1e4, "damping": 1e5, "flow": 50.0}
LAWS = ("mooney-rivlin", "neo-hookean", "holzapfel", "st-venant-kirchhoff")
OF_LAYER = ("share", "law", "c10", "c01", "k1", "k2", "fibre angle", "dispersion", "bulk modulus", "young modulus",
            "poisson ratio", "density", "viscous fraction", "relaxation time")


def read_wall(options):
    """Thickness, layers, tissue, damping, flow and shape of --wall, with what the options override, and where they come from."""
    if options.wall in PRESETS:
        wall = {key: value for key, value in PRESETS[options.wall].items() if key != "radius"}
        wall["sources"] = dict.fromkeys(SOURCED, f"assumed for {options.wall}")
    else:
        wall = read_file(options.wall)
    for key in ("thickness", "tissue"):
        if getattr(options, key) is not None:
            wall[key], wall["sources"][key] = getattr(options, key), f"option {key}"
    return wall


def read_file(path):
    """A wall of one's own: the list Wall with KEYS and the list Layers, each with a share and the keys of Wall / Layers."""
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise BadInput(f"{path}: is no valid XML: {error}") from None
    wall = {"thickness": 0.15, "tissue": 1.0, "damping": 10.0, "flow": 5.0, "shape": "aorta", "layers": {},
            "sources": dict.fromkeys(SOURCED, "assumed")}
    for entry in root:
        name = entry.get("name")
        if entry.tag == "ParameterList" and name == "Layers":
            wall["layers"] = {layer.get("name"): read_layer(path, layer) for layer in entry}
        elif name in KEYS:
            wall[name], wall["sources"][name] = value_of(path, entry, KEYS[name]), f"of {os.path.basename(path)}"
        else:
            raise BadInput(f"{path}: unknown key \"{name}\". {nearest(str(name), [*KEYS, 'Layers'])}")
    if not wall["layers"]:
        raise BadInput(f"{path}: Layers is empty, expected a list for each layer, from the lumen outwards")
    if wall["shape"] not in SHAPES:
        raise BadInput(f"{path}: \"shape\" is {wall['shape']}. {nearest(wall['shape'], list(SHAPES))}")
    for key, most in LARGEST.items():
        if not 0 <= wall[key] <= most or (wall[key] == 0 and key in ("thickness", "flow")):
            raise BadInput(f"{path}: \"{key}\" is {wall[key]:g}, expected a positive number up to {most:g}")
    whole = sum(layer["share"] for layer in wall["layers"].values())
    for layer in wall["layers"].values():
        layer["share"] /= whole
    return wall


def read_layer(path, layer):
    keys = {}
    for entry in layer:
        name = entry.get("name")
        if name not in OF_LAYER:
            raise BadInput(f"{path}: Layers / {layer.get('name')}: unknown key \"{name}\". {nearest(str(name), OF_LAYER)}")
        keys[name] = value_of(path, entry, str if name == "law" else float)
    if keys.setdefault("law", LAWS[0]) not in LAWS:
        raise BadInput(f"{path}: Layers / {layer.get('name')}: \"law\" is {keys['law']}. {nearest(keys['law'], LAWS)}")
    share = keys.pop("share", 1.0)
    if share <= 0:
        raise BadInput(f"{path}: Layers / {layer.get('name')}: \"share\" is {share:g}, expected a positive number")
    return {"share": share, "keys": keys, "source": f"of {os.path.basename(path)}"}


def value_of(path, entry, kind):
    try:
        return kind(entry.get("value"))
    except (TypeError, ValueError):
        raise BadInput(f"{path}: \"{entry.get('name')}\" is {entry.get('value')}, expected a number") from None


def layers_text(wall, options):
    """As --layers of tunica-mesh wall; the elements are divided by the shares, one for each layer at least."""
    words = []
    for name, layer in wall["layers"].items():
        word = f"{name}={layer['share']:.6g}"
        if options.wall_elements:
            word += f":{max(1, round(options.wall_elements * layer['share']))}"
        words.append(word)
    return ",".join(words)


def make(folder, options, programs):
    wall = read_wall(options)
    draft = folder.file("draft-" + MESH)
    log = folder.file(lumen.LOG)
    programs.must(["tunica-mesh", "wall", folder.file(lumen.MESH), draft, "--surfaces", options.lumen_wall, "--layers",
                   layers_text(wall, options), "--thickness-fraction", repr(wall["thickness"]), "--overwrite", "on"], log)
    mesh = Mesh(draft)
    wall["mesh"] = {"vertices": len(mesh.vertices), "tetrahedra": len(mesh.tets), "unknowns": unknowns_of(mesh)}
    wall["warnings"] = warnings_in(log) + of_other_size(options, read_json(folder.file(lumen.TABLE))["openings"])
    os.replace(draft, folder.file(MESH))
    write_json(folder.file(TABLE), wall)
    layers = ", ".join(f"{name} ({layer['keys']['law']})" for name, layer in wall["layers"].items())
    return [f"wall: {wall['thickness']:g} of the radius, {layers}; {wall['mesh']['tetrahedra']} tetrahedra with the lumen, "
            f"about {wall['mesh']['unknowns']} unknowns"] + [f"  warning: {text}" for text in wall["warnings"]]


def of_other_size(options, openings):
    """A preset whose vessel is far larger or smaller than this one: its stiffness and its flow are those of another."""
    usual, largest = PRESETS.get(options.wall, {}).get("radius"), max(opening["radius"] for opening in openings)
    if usual is None or usual / 2 <= largest <= 2 * usual:
        return []
    return [f"--wall {options.wall} is made for a radius of about {usual:g} mm, the largest opening has {largest:.2g} mm"]


def unknowns_of(mesh):
    """Four at each vertex; those between layers have a second pressure."""
    between = [mesh.triangles_of(name).ravel() for name in mesh.surfaces if name.startswith("layer")]
    return int(4 * len(mesh.vertices) + sum(len(np.unique(vertices)) for vertices in between))


def warnings_in(log):
    """Those of the last program in the log."""
    with open(log, encoding="utf-8", errors="replace") as file:
        last = file.read().split("\n$ ")[-1]
    return [line[len("warning: "):] for line in last.split("\n") if line.startswith("warning: ")]


def read(folder):
    return read_json(folder.file(TABLE))
