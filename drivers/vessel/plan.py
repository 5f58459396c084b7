"""What a run will take: --dry-run. Sizes from the mesh where there is one, otherwise from the surface."""
import os

from . import case_file, flow_shapes, lumen, run, tune, walls
from .errors import BadInput
from .folder import read_json
from .mesh_file import Mesh

# The cost of tunica-check, src/tunica/judge/cost.cpp, with as many tetrahedra in the fluid as in the wall. A test compares them.
MB_OF_PROGRAM, MB_A_TETRAHEDRON, SECONDS_A_TETRAHEDRON = 115.0, 3.3e-3, 2.2e-5
SHARED = 1.2  # times the memory of a tetrahedron on several ranks
USUAL_BEATS = 4
USUAL_ELEMENTS, USUAL_LAYERS = 3, 3  # through the wall, and thin ones at it
OF_PRISM = 3  # tetrahedra


def size_of(folder, options):
    """Tetrahedra and how they are known, or None."""
    if os.path.exists(folder.file(walls.TABLE)):
        return walls.read(folder)["mesh"]["tetrahedra"], "of its mesh"
    through = OF_PRISM * (options.wall_elements or USUAL_ELEMENTS)
    if os.path.exists(folder.file(lumen.TABLE)):
        mesh = Mesh(folder.file(lumen.MESH))
        return len(mesh.tets) + through * len(mesh.triangles_of(options.lumen_wall)), "from the mesh of the lumen"
    if options.size and options.lumen.lower().endswith(".stl"):
        # Equal sides: a triangle has 0.43 of their square. There are some 6 tetrahedra to the cube of a side: those of Gmsh are a little wider.
        volume, area = measures_of(options.lumen)
        side = options.size / (options.scale or 1.0)
        at_wall = through + OF_PRISM * (USUAL_LAYERS if options.layers is None else options.layers)
        return int(6 * volume / side ** 3 + at_wall * area / (0.43 * side ** 2)), "from the surface and --size"
    return None


def measures_of(path):
    """Volume that a closed surface includes, and nearly that of one with open ends, and its area, in its unit."""
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkIOGeometry import vtkSTLReader
    vtkObject.GlobalWarningDisplayOff()
    reader = vtkSTLReader()
    reader.SetFileName(path)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(reader.GetOutputPort())
    mass = vtkMassProperties()
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    volume = mass.GetVolume()
    if not 0 < volume < float("inf"):
        raise BadInput(f"{path}: includes a volume of {volume:.3g} mm^3, expected the surface of a lumen as an STL file")
    return volume, mass.GetSurfaceArea()


def period_of(folder, options):
    if os.path.exists(folder.file(tune.TABLE)):
        return tune.read(folder)["period"]
    return flow_shapes.inflow(options, walls.read_wall(options))[1]


def duration_text(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} minutes" if seconds < 5400 else f"{seconds / 3600:.1f} hours"


def lines(folder, options):
    period = period_of(folder, options)
    steps = case_file.steps_of(period, options.step)
    found = [f"beat: {period:.5g} ms in {steps} steps of {period / steps:.4g} ms; {USUAL_BEATS} beats are usual, at most "
             f"{options.beats}"]
    size = size_of(folder, options)
    if size is None:
        return found + ["size: known after the stage mesh: give the same command with --to wall, and then --dry-run again"]
    tetrahedra, how = size
    share = tetrahedra / options.ranks
    seconds = SECONDS_A_TETRAHEDRON * share
    memory = MB_OF_PROGRAM * options.ranks + (SHARED if options.ranks > 1 else 1) * MB_A_TETRAHEDRON * tetrahedra
    done = len(read_json(folder.file(run.TABLE))["beats"]) if os.path.exists(folder.file(run.TABLE)) else 0
    left = max(1, USUAL_BEATS - done)
    return found + [f"size: about {tetrahedra} tetrahedra ({how}), {memory / 1000:.1f} GB",
                    f"time: about {seconds:.2g} s a step with {options.ranks} rank(s), {duration_text(seconds * steps)} a beat, "
                    f"{duration_text(seconds * steps * left)} for {left} beat(s); within a factor of 2 with a core for each rank"]
