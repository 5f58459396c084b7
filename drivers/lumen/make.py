"""The way from a file with a surface to a mesh of its inside, step by step."""
import dataclasses

import numpy as np

from importer.raw import BadMesh

from . import (caps, centreline, core, crossings, ends, handles, medial, names, options as of_options, picture, rebuild,
               remesh, repair, result, rims as of_rims, sizes, smooth, subdivide, summary, surface_files, unfold, volume)
from . import surface as base
from .faults import BadSurface
from .surface import Surface

ROUGH = 0.45                # cosine between normals of triangles and of the surface about them, after smoothing
BEYOND = 0.6                # radii by which ends are lengthened while the surface is smoothed
SMALL, LARGE = 0.05, 40.0   # mm, radii of vessels beyond which the unit is doubted


def lumen(options, progress):
    path = options.surface
    core.gmsh_module()  # missed now rather than at the end
    wishes, of_faces = names.wanted(options.names, options.scale)
    progress.stage(f"reading {path}")                                          # 1. read, mend, open
    raw, rims, given = opened(path, options, of_faces, progress)
    doubt_unit(rims, options, progress)
    voxel = smooth.voxel_of(raw)
    raw, rims = subdivided(raw, rims)
    progress.stage("smoothing")                                                # 2. smooth, cut the ends square
    target, rims, kept = evened(raw, rims, voxel, options, progress)
    if options.extend > 0.0:
        target, rims = ends.extended(target, rims, options.extend)
    rims = names.settle(rims, given, options.names, options.scale, wishes)
    progress.stage("balls and centreline")                                     # 3. radii, centreline, sizes
    balls = medial.balls(target, rims)
    branches = centreline.branches(balls, rims, path)
    size = sizes.wanted(target, balls.of_vertex, options)
    progress.stage(f"triangles of the wall, {size.min():.2g} to {size.max():.2g} mm")  # 4. the wall anew
    wall, rims, size, radii = remeshed(target, rims, size, balls.of_vertex, progress)
    refuse_crossing(wall, path, "the triangles made of it, too wide for a narrow gap (a larger --across makes smaller "
                    "ones), cross")
    mesh = volume.fill(wall, rims, volume.Wish(options.first * size), radii, options, progress)  # 5. layers and core
    change = kept * base.volume(*base.closed(wall)) / base.volume(*base.closed(target)) - 1.0
    table = summary.table_of(mesh, rims, raw, change)
    write(mesh, rims, target, branches, table, options, progress)              # 6. files and table
    for line in summary.lines(table, rims, voxel):
        print(line)
    print(f"written    {options.out}, {of_options.beside(options.out).json}, {of_options.beside(options.out).png} in "
          f"{progress.seconds():.0f} s")


def opened(path, options, of_faces, progress):
    """The wall without caps, its openings, and names of caps with their places."""
    surface = surface_files.read(path, of_faces)
    surface.points = surface.points * options.scale
    progress.say(f"{len(surface.triangles):,} triangles, {len(surface.points):,} points")
    surface, given = without_caps(subdivide.evened(repair.mended(surface, path, progress.note)), path, progress)
    surface = handles.cut(surface, path, progress.note)
    surface, rims = of_rims.openings(surface, path, progress.note)
    if not rims:
        raise BadSurface(f"{path}: no opening is found: the surface is closed, and no part of it is a flat disc that "
                         "ends a tube. Cut the vessel's ends, with ParaView's or 3D Slicer's clip, or close them flat",
                         surface)
    refuse_crossing(surface, path, "the surface crosses itself")
    return surface, rims, given


def without_caps(surface, path, progress):
    """The wall of a surface that is closed, but for small holes, and names of its caps with their places."""
    if len(base.loops(surface.triangles)):
        filled, rims = of_rims.openings(surface, path, lambda text: None)
        if rims:
            return surface, []
        surface = filled
    surface, given = caps.taken_off(surface, progress.say)
    return repair.apart(surface, path), given


def refuse_crossing(surface, path, words):
    pairs = crossings.crossing(surface.points, surface.triangles)
    if len(pairs):
        place = surface.points[surface.triangles[pairs[0]]].mean(axis=(0, 1))
        raise BadSurface(f"{path}: {words} at {len(pairs):,} pairs of triangles, the first at {base.show(place)}: sheets that "
                         "pass through one another, or branches that touch. Mend it where it was made: separate the "
                         "branches in the segmentation", surface, place)


def doubt_unit(rims, options, progress):
    least, largest = (pick(rim.radius for rim in rims) for pick in (min, max))
    if largest < SMALL or largest > LARGE or least < 0.1 * SMALL:
        progress.warn(f"openings have radii of {least:.3g} to {largest:.3g} mm: is the unit of {options.surface} the mm? "
                      f"--scale 10 for cm, --scale 1000 for m; now it is {options.scale:g}")


def subdivided(surface, rims):
    """Long sides halved: a surface of a few large triangles has no vertices to work with."""
    longest = 0.55 * min(rim.radius for rim in rims)
    if np.percentile(base.edge_lengths(surface.points, surface.triangles), 90) < longest:
        return surface, rims
    return subdivide.sampling(surface, rims, longest)


def evened(raw, rims, voxel, options, progress):
    """The smooth surface with its ends cut, its rims, and its volume over that of the surface given, before the cut.

    One with folds or crossings that smoothing leaves is drawn anew, and smoothed again.
    """
    path, say = options.surface, progress.say
    if options.no_smoothing:
        target, rims = ends.cut(raw, rims, path, say)
        return target, rims, 1.0
    longer, beyond, smooth_one = smoothed(raw, rims, voxel, say)
    if is_rough(smooth_one, rims):
        raw, rims = rebuild.rebuilt(raw, rims, voxel, path, progress.note)
        longer, beyond, smooth_one = smoothed(raw, rims, voxel, say)
    kept = base.volume(*base.closed(smooth_one)) / base.volume(*base.closed(longer))
    target, rims = ends.cut(smooth_one, rims, path, say, beyond)
    target, folds = unfold.unfolded(target)
    if folds:
        progress.note(f"folds taken out of the surface, at {folds:,} points")
    return target, rims, kept


def smoothed(surface, rims, voxel, say):
    """The surface with its ends lengthened, their rims, and the same smooth: a filter draws in what ends."""
    longer, beyond = ends.extended(surface, rims, BEYOND)
    return longer, beyond, smooth.smoothed(longer, beyond, voxel, say)


def is_rough(surface, rims):
    """Away from the rims, near which all is cut off."""
    folded = unfold.folded(surface.points, surface.triangles, ROUGH)
    edges = base.Edges(surface.triangles)
    at_rim = np.zeros(len(surface.points), dtype=bool)
    at_rim[edges.ends[edges.is_boundary]] = True
    at_rim[np.concatenate([rim.loop for rim in rims])] = True
    for _ in range(3):
        at_rim[surface.triangles[at_rim[surface.triangles].any(axis=1)]] = True
    return bool((folded & ~at_rim[surface.triangles].any(axis=1)).any()
                or len(crossings.crossing(surface.points, surface.triangles)))


def remeshed(target, rims, size, radii, progress):
    """The wall with its rims, and sizes and radii at its vertices. Its volume is that of the target: chords of a curved
    surface lie inside of it."""
    remesher = remesh.Remesher(target, rims, size)
    wall = remesher.run(progress.beat)
    own = own_rims(wall, rims)
    wall = smooth.with_volume(wall, base.volume(*base.closed(target)), remesher.size, own)
    wall, _ = unfold.unfolded(wall)
    near, cells = remesher.target.nearest(wall.points)
    return wall, own_rims(wall, rims), remesher.size, remesher.target.interpolate(radii, near, cells)


def own_rims(wall, rims):
    """The same openings, measured at the vertices of another surface."""
    loops = base.loops(wall.triangles)
    centres = np.array([wall.points[loop].mean(axis=0) for loop in loops])
    found = []
    for rim in rims:
        loop = loops[int(np.linalg.norm(centres - rim.centre, axis=1).argmin())]
        new = of_rims.measured(wall.points, loop, rim.normal)
        found.append(dataclasses.replace(new, normal=rim.normal, name=rim.name, added=rim.added))
    return found


def write(mesh, rims, target, branches, table, options, progress):
    beside = of_options.beside(options.out)
    progress.stage("writing")
    warn(table, progress)
    result.write(mesh, rims, options.out)
    if options.out.endswith(".h5"):
        result.remember(target, options.out)
    result.write_json(table, rims, branches, progress.notes, beside.json)
    try:
        picture.mesh(mesh, rims, branches, beside.png)
    except OSError as error:
        raise BadMesh(f"{beside.png}: cannot be written: {error}") from error


def warn(table, progress):
    if abs(table["volume change"]) > 0.01:
        progress.warn(f"the volume differs by {100.0 * table['volume change']:+.1f} % from that of the surface given")
    if table["poor in core"]:
        progress.warn(f"{table['poor in core']} tetrahedra of the core have angles below 10 degrees, the least "
                      f"{table['angle in core']:.1f}")


def show_fault(error, options, progress):
    """A picture of the place, if there is one to show."""
    if error.surface is None or not isinstance(error.surface, Surface):
        return
    path = of_options.beside(options.out).png
    try:
        picture.fault(error.surface, error.place, str(error), path)
        print(f"the place is shown in {path}")
    except Exception as trouble:  # the fault itself is what matters
        progress.warn(f"no picture of the place: {trouble}")
