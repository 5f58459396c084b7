"""The way from a run to a mesh with the same number of elements where they are of more use, step by step."""
import argparse

import numpy as np
from scipy.spatial import cKDTree

from lumen import core, medial, volume
from lumen import make as of_lumen
from lumen import sizes as of_sizes
from lumen import surface as base
from lumen.surface import Edges, Surface
from lumen.target import Target

from . import errors, new_case, origin, sizes, vessel_wall
from .old_run import OldRun

ROUNDS, NEAR = 3, 0.05   # of meshing anew, until the number of elements is this near to what was wanted


def adapt(options, progress):
    core.gmsh_module()  # missed now rather than at the end
    progress.stage(f"reading {options.run}")                                   # 1. the run, its wall, the surface
    run = OldRun(options.run, options.start)
    wall = vessel_wall.of(run)
    target, rims = origin.of(run, options.surface, progress.say)
    progress.stage("balls")                                                    # 2. how wrong it is where
    radii = medial.balls(target, rims).of_vertex
    near = cKDTree(target.points).query(run.points)[1]
    progress.stage(f"errors of {len(run.outputs)} outputs")
    found = errors.estimate(run, radii[near], options.over, progress.beat)
    for line in errors.lines(found):
        progress.say(line)
    bounds = sizes.bounds(target, radii)                                       # 3. sizes
    limits = sizes.limits_at(run, near, bounds, radii)
    planner = sizes.Planner(run, errors.wished(found, run), limits, wall.through if wall else 0, options)
    wanted = options.factor * (options.tetrahedra or len(run.tets) + (wall.tets if wall else 0))
    mesh, rims, plan = meshed(run, planner, wanted, (target, rims, radii, bounds), options, progress)  # 4. the lumen
    progress.stage("writing")                                                  # 5. the wall and the case
    new_case.write(run, wall, mesh, rims, target, plan, options, progress)


def meshed(run, planner, wanted, surface, options, progress):
    """The mesh whose number of elements is nearest to what is wanted, its rims and its plan."""
    old, best, aim = Target(Surface(*base.compact(run.points, run.wall))), None, wanted
    on = np.unique(run.wall)
    for _ in range(ROUNDS):
        plan, e = planner.with_count(aim)
        told = planner.count(plan)
        progress.say(f"sizes {plan.size.min():.2g} to {plan.size.max():.2g} mm for a part of {e:.2g} of each error; "
                     f"{plan.layers} layers, the one at the wall {plan.first[on].min():.2g} to {plan.first[on].max():.2g} mm, growth "
                     f"{plan.growth:.2g}; about {told.sum():,.0f} tetrahedra")
        mesh, rims = one(plan, planner, surface, old, on, options, progress)
        count = len(mesh.tets) + 3 * planner.through * len(mesh.wall)
        progress.say(f"{count:,} tetrahedra, wanted {wanted:,.0f}")
        if best is None or abs(count - wanted) < abs(best[0] - wanted):
            best = count, mesh, rims, plan
        if abs(count / wanted - 1.0) < NEAR or told.sum() > 1.1 * aim:
            break
        aim *= wanted / count
    if best[0] > 1.1 * wanted:
        progress.warn(f"{wanted:,.0f} tetrahedra are too few for a round lumen: {sizes.FEWEST_AROUND:.0f} elements around and "
                      f"{sizes.FEWEST_ACROSS:.0f} across are the least; {best[0]:,} remain")
    return best[1:]


def one(plan, planner, surface, old, on, options, progress):
    """The mesh of a plan and its rims."""
    target, rims, radii, bounds = surface
    near, cells = old.nearest(target.points)
    size = np.clip(old.interpolate(plan.size[on], near, cells), *bounds)
    size = of_sizes.graded(target, Edges(target.triangles), size)
    progress.stage(f"triangles of the wall, {size.min():.2g} to {size.max():.2g} mm")
    wall, rims, _, radii = of_lumen.remeshed(target, rims, size, radii, progress)
    of_lumen.refuse_crossing(wall, options.run, "the triangles of the new wall, too wide for a narrow gap, cross")
    first = old.interpolate(plan.first[on], *old.nearest(wall.points))
    wish = volume.Wish(first, core.Sizes(planner.points, planner.tets, plan.size))
    how = argparse.Namespace(layers=plan.layers, growth=plan.growth, surface=options.run)
    return volume.fill(wall, rims, wish, radii, how, progress), rims
