"""What a run will take: --dry-run. Sizes from the mesh where there is one, otherwise from the surface."""
import os

from . import case_file, flow_shapes, lumen, run, tune, walls
from .errors import BadInput
from .folder import read_json

SECONDS_A_STEP = 6e-5  # of each unknown and rank, measured on an arch of 43,000 unknowns; within a factor of 3
USUAL_BEATS = 4
MB_AN_UNKNOWN = 5e-3


def size_of(folder, options):
    """Unknowns and how they are known, or None."""
    if os.path.exists(folder.file(walls.TABLE)):
        return walls.read(folder)["mesh"]["unknowns"], "of its mesh"
    if os.path.exists(folder.file(lumen.TABLE)):
        return 9 * read_json(folder.file(lumen.TABLE))["vertices"], "from the mesh of the lumen"
    if options.size and options.lumen.lower().endswith(".stl"):
        # A mesh has a vertex for each 0.7 cubes of its edge, with a wall of three elements twice as many.
        return int(9 * volume_of(options.lumen) * (options.scale or 1.0) ** 3 / (0.7 * options.size ** 3)), "from the volume of the surface and --size"
    return None


def volume_of(path):
    """Volume [mm^3] that a closed surface includes, and nearly that of one with open ends."""
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
    return volume


def period_of(folder, options):
    if os.path.exists(folder.file(tune.TABLE)):
        return tune.read(folder)["period"]
    return flow_shapes.inflow(options, walls.read_wall(options))[1]


def minutes_text(seconds):
    return f"{seconds / 60:.0f} minutes" if seconds < 5400 else f"{seconds / 3600:.1f} hours"


def lines(folder, options):
    period = period_of(folder, options)
    steps = case_file.steps_of(period, options.step)
    found = [f"beat: {period:.5g} ms in {steps} steps of {period / steps:.4g} ms; {USUAL_BEATS} beats are usual, at most "
             f"{options.beats}"]
    size = size_of(folder, options)
    if size is None:
        return found + ["size: known after the stage mesh: give the same command with --to wall, and then --dry-run again"]
    unknowns, how = size
    seconds = SECONDS_A_STEP * unknowns / min(options.ranks, 2 if unknowns < 1e5 else 8)
    done = len(read_json(folder.file(run.TABLE))["beats"]) if os.path.exists(folder.file(run.TABLE)) else 0
    left = max(1, USUAL_BEATS - done)
    return found + [f"size: about {unknowns} unknowns ({how}), {MB_AN_UNKNOWN * unknowns / 1000 + 0.1:.1f} GB",
                    f"time: about {seconds:.1f} s a step with {options.ranks} rank(s), {minutes_text(seconds * steps)} a beat, "
                    f"{minutes_text(seconds * steps * left)} for {left} beat(s); within a factor of 3"]
