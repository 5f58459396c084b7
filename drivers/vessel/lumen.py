"""Stage mesh: a surface or a mesh of the lumen becomes lumen.h5 and lumen.json."""
import os
import shutil

import numpy as np

from . import branches
from .errors import BadInput, nearest
from .folder import LOG, REFUSED, read_json, write_json
from .mesh_file import Mesh, opening_of
from .units import L_PER_MIN

MESH, TABLE = "lumen.h5", "lumen.json"
MESHES = (".h5", ".msh", ".vol")
RESULTS = (MESH, TABLE)
FASTEST = 4.0  # m/s: no mean over an opening and a beat is so large


def make(folder, options, programs):
    """Both files appear complete: they are made under other names, and renamed. A failure leaves no draft, but for a picture
    of the place of the fault."""
    draft = folder.file("draft-" + MESH)
    table_draft, picture = (os.path.splitext(draft)[0] + ending for ending in (".json", ".png"))
    remove(draft, table_draft, picture, folder.file(REFUSED))
    try:
        return fill(folder, options, programs, draft, table_draft, picture)
    except BadInput as error:
        if os.path.exists(draft) or not os.path.exists(picture):
            raise
        os.replace(picture, folder.file(REFUSED))
        raise BadInput(f"{error}. The place is shown in {folder.file(REFUSED)}") from None
    finally:
        remove(draft, table_draft, picture)


def fill(folder, options, programs, draft, table_draft, picture):
    log = folder.file(LOG)
    if os.path.splitext(options.lumen)[1].lower() in MESHES:
        if options.scale not in (None, 1.0):
            raise BadInput(f"{options.lumen}: --scale converts surfaces; tunica-import --scale {options.scale:g} converts a mesh")
        take_mesh(options.lumen, draft, programs, log)
    else:
        fill_surface(options, draft, programs, log)
    table = table_of(draft, table_draft, options)
    os.replace(draft, folder.file(MESH))
    write_json(folder.file(TABLE), table)
    if os.path.exists(picture):
        os.replace(picture, folder.file("lumen.png"))
    return report(table)


def remove(*paths):
    for path in paths:
        if os.path.exists(path):
            os.remove(path)


def take_mesh(source, draft, programs, log):
    beside = os.path.splitext(source)[0] + ".json"
    if source.lower().endswith(".h5"):
        shutil.copyfile(source, draft)
    else:
        programs.must(["tunica-mesh", "convert", source, draft], log)
    if os.path.exists(beside):
        shutil.copyfile(beside, os.path.splitext(draft)[0] + ".json")


def fill_surface(options, draft, programs, log):
    words = ["tunica-mesh", "lumen", options.lumen, draft]
    for name in ("scale", "size", "across", "layers"):
        value = getattr(options, name)
        words += [] if value is None else [f"--{name}", f"{value:g}"]
    programs.must(words, log)


def table_of(draft, table_draft, options):
    """What describes the lumen: the file of the program that made it, completed from the mesh where it lacks something."""
    mesh = Mesh(draft)
    check(mesh, options)
    table = read_json(table_draft) if os.path.exists(table_draft) else {}
    table = table if isinstance(table, dict) and "openings" in table else {}  # another file of that name
    names = [name for name in mesh.surfaces if name != options.lumen_wall and len(mesh.triangles_of(name))]
    openings = table.get("openings") or [opening_of(mesh, name) for name in names]
    openings = sorted(openings, key=lambda opening: -opening["area"])
    known = [opening["name"] for opening in openings]
    if sorted(known) != sorted(names):
        raise BadInput(f"{table_draft}: names the openings {', '.join(known)}, but the mesh has {', '.join(names)}")
    if options.inlet and options.inlet not in known:
        raise BadInput(f"--inlet {options.inlet}: there is no such opening. {nearest(options.inlet, known)}")
    check_speed(next(o for o in openings if o["name"] == (options.inlet or known[0])), options)
    table["openings"] = openings
    ends = {branch[end] for branch in table.get("branches") or () for end in ("start", "end")}
    if not set(known) <= ends:
        table["branches"] = branches.find(mesh, openings, options.inlet or known[0])
    fluid = mesh.tets_of("fluid")
    table.update(volume=float(np.abs(mesh.volume(fluid)).sum()), tetrahedra=len(fluid), vertices=len(mesh.vertices))
    table.setdefault("warnings", [])
    return table


def check(mesh, options):
    if mesh.regions != ["fluid"]:
        way = ("Give a mesh or the surface of the lumen: the wall is made here" if len(mesh.regions) > 1 else
               "tunica-import --fluid MESH OUT.h5 names it")
        raise BadInput(f"{options.lumen}: its regions are {', '.join(mesh.regions)}, expected the lumen alone, \"fluid\". {way}")
    if options.lumen_wall not in mesh.surfaces:
        raise BadInput(f"{options.lumen}: has no surface \"{options.lumen_wall}\" on which a wall could grow; --lumen-wall "
                       f"names it. {nearest(options.lumen_wall, mesh.surfaces)}")
    if len(mesh.surfaces) < 3:
        raise BadInput(f"{options.lumen}: has the surfaces {', '.join(mesh.surfaces)}, expected two openings or more and the wall")
    extent = np.ptp(mesh.vertices, axis=0).max()
    if not 2 <= extent <= 2000:
        raise BadInput(f"{options.lumen}: is {extent:.3g} mm long. Lengths are in mm: --scale 10 converts a surface in cm, 1000 one "
                       "in m; tunica-import --scale does so with a mesh")


def check_speed(inlet, options):
    """A surface in cm passes for one of a small vessel in mm, but a hundred times faster."""
    speed = options.mean_inflow / inlet["area"]
    if options.scale is None and speed > FASTEST:
        raise BadInput(f"{options.lumen}: the mean flow of {options.mean_inflow / L_PER_MIN:.3g} l/min would pass {inlet['name']}, of "
                       f"radius {inlet['radius']:.3g} mm, at {speed:.2g} m/s, where blood flows at less than 1 m/s. Lengths are in mm: is "
                       "this in cm? --scale 10 converts a surface, tunica-import --scale 10 a mesh; --scale 1 says that it is in "
                       "mm. Or is --flow too large?")


def report(table):
    lines = [f"lumen: {table['volume'] / 1000:.3g} ml, {table['tetrahedra']} tetrahedra, {len(table['branches'])} branches"]
    for opening in table["openings"]:
        lines.append(f"  {opening['name']}: radius {opening['radius']:.2f} mm")
    return lines + [f"  note: {text}" for text in table["warnings"]]
