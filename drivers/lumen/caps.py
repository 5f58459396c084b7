"""Takes the flat caps off a closed surface: by the numbers of its faces, else by their shape."""
import numpy as np
from scipy.spatial import cKDTree

from . import surface as base
from .surface import Edges, show, unit

FLAT = 0.04       # distance to the plane over the radius of the disc
ROUND = 0.4       # 4 pi area / perimeter squared, small where rims are ragged
LONG = 2.0        # the long axis of a disc over the short one
PARALLEL = 0.3    # mean of the cosine between a cap and the surface around it
RADIAL = 0.6      # mean of the cosine between the wall behind a cap and the way from its axis
BESIDE = 3.0      # radii of the smaller one between a cap and a plateau of voxels on the wall behind it
LESS = 0.85       # of the cosine behind a cap: that behind such a plateau
ENOUGH = 0.4      # area of that wall over a cylinder's
STARTS = 400      # so many regions are looked at
PLANES = 30       # in each
LEAST = 6.0       # area of a cap, in squares of short sides


def taken_off(surface, say):
    """The wall alone, and the names of caps by their centres, where the file has them."""
    numbered = by_numbers(surface)
    caps = by_shape(surface) if numbered is None else numbered
    is_wall = np.ones(len(surface.triangles), dtype=bool)
    names = []
    for chosen in caps:
        is_wall[chosen] = False
        corners = surface.points[surface.triangles[chosen]]
        name = name_of(surface, chosen, numbered is not None)
        if name:
            names.append((name, corners.mean(axis=(0, 1))))
    if caps:
        say(f"{len(caps)} flat caps found, the first about "
            f"{show(surface.points[surface.triangles[caps[0]]].mean(axis=(0, 1)))}")
    return surface.take(is_wall), names


def name_of(surface, chosen, has_number):
    """Of a cap; one that is a face of the file without a name is called after its number, as tunica-import does."""
    if surface.face is None:
        return None
    number = int(surface.face[chosen[0]])
    return surface.names.get(number) or (f"surface-{number}" if has_number else None)


def by_numbers(surface):
    """Faces of a file that are flat discs; None where it has no faces, or no such."""
    if surface.face is None or len(np.unique(surface.face)) < 2:
        return None
    edges = Edges(surface.triangles)
    found = []
    for number in np.unique(surface.face):
        chosen = np.flatnonzero(surface.face == number)
        if is_disc(surface, edges, chosen, 0.15):
            found.append(chosen)
    return found or None


def by_shape(surface):
    """From the largest triangles on: what lies in their plane, is a round disc, and ends a tube."""
    points, triangles = surface.points, surface.triangles
    edges, found = Edges(triangles), []
    normal, area = unit(base.doubled_normals(points, triangles)), base.areas(points, triangles)
    middle = points[triangles].mean(axis=1)
    tree = cKDTree(middle)
    is_taken = np.zeros(len(triangles), dtype=bool)
    for size, chosen in flat_regions(points, triangles, edges, normal, area):
        if is_taken[chosen].any() or not is_disc(surface, edges, chosen, FLAT):
            continue
        outward = behind(surface, tree, normal, area * ~is_taken, chosen)
        if outward > RADIAL:
            is_taken[chosen] = True
            found.append((outward, chosen))
    return without_plateaus(middle, normal, area, found)


def without_plateaus(middle, normal, area, found):
    """Flat pieces of wall beside a cap, which look across it, have a tube of a kind behind them too, where a branch is two voxels
    wide. found: pairs of behind() and triangles."""
    whole = [area[chosen].sum() for _, chosen in found]
    centre = [(area[chosen, None] * middle[chosen]).sum(axis=0) / size for (_, chosen), size in zip(found, whole)]
    vector = [unit((area[chosen, None] * normal[chosen]).sum(axis=0)) for _, chosen in found]

    def is_beside(i, j):
        reach = BESIDE * np.sqrt(min(whole[i], whole[j]) / np.pi)
        return np.linalg.norm(centre[i] - centre[j]) < reach and abs(vector[i] @ vector[j]) < 0.5

    every = range(len(found))
    return [found[i][1] for i in every if not any(found[i][0] < LESS * found[j][0] and is_beside(i, j) for j in every)]


def flat_regions(points, triangles, edges, normal, area):
    """(area, triangles) of connected regions in one plane, the largest first.

    A sliver has no direction of its own: it belongs to a plane when its corners lie in it.
    """
    inner = edges.sides[:, 1] >= 0
    a, b = edges.sides[inner].T
    scale = side_of(points, triangles)
    offset = np.abs(np.stack([base.dot(normal[a][:, None], points[triangles[b]] - points[triangles[a, :1]]),
                              base.dot(normal[b][:, None], points[triangles[a]] - points[triangles[b, :1]])]))
    flat = offset.max(axis=2).min(axis=0) < 0.02 * scale
    label, count = base.parts(len(triangles), a[flat], b[flat])
    total = np.bincount(label, weights=area, minlength=count)
    found = []
    for k in [k for k in np.argsort(-total)[:STARTS] if total[k] > LEAST * scale ** 2]:
        region = np.flatnonzero(label == k)
        for _ in range(PLANES):
            chosen = within_plane(points, triangles, region, normal, area)
            found.append((area[chosen].sum(), chosen))
            region = np.setdiff1d(region, chosen)
            if area[region].sum() < LEAST * scale ** 2:
                break
    return sorted((entry for entry in found if entry[0] > LEAST * scale ** 2), key=lambda entry: -entry[0])


def side_of(points, triangles):
    return float(np.percentile(base.edge_lengths(points, triangles), 20))


def within_plane(points, triangles, region, normal, area):
    """What lies in the plane of the region's largest triangle, and hangs together with it: slivers lead from a cap into
    the wall, and on to other planes."""
    seed = region[area[region].argmax()]
    height = np.abs((points[triangles[region]] - points[triangles[seed, 0]]) @ normal[seed]).max(axis=1)
    chosen = region[height < 0.1 * side_of(points, triangles)]
    label, _ = base.pieces(triangles[chosen])
    return chosen[label == label[np.flatnonzero(chosen == seed)[0]]]


def is_disc(surface, edges, chosen, tolerance):
    """One rim, flat and round, and no hole."""
    points, triangles = surface.points, surface.triangles[chosen]
    own = Edges(triangles)
    vertices = np.unique(triangles)
    if len(vertices) - len(own.count) + len(triangles) != 1 or base.pieces(triangles)[1] != 1:
        return False
    rim = own.boundary()
    around = np.linalg.norm(points[rim[:, 0]] - points[rim[:, 1]], axis=1).sum()
    vector = 0.5 * base.doubled_normals(points, triangles).sum(axis=0)
    area = np.linalg.norm(vector)
    if area <= 0.0 or 4.0 * np.pi * area < ROUND * around ** 2:
        return False
    height = (points[vertices] - points[vertices].mean(axis=0)) @ (vector / area)
    middle, weight = points[rim].mean(axis=1), np.linalg.norm(points[rim[:, 0]] - points[rim[:, 1]], axis=1)
    axes = np.linalg.eigvalsh(np.cov(middle.T, aweights=weight))
    return bool(np.abs(height).max() < tolerance * np.sqrt(area / np.pi) and axes[2] < LONG ** 2 * axes[1])


def behind(surface, tree, normal, area, chosen):
    """Behind a cap stands a tube as wide as it is: wall all around, which looks away from its axis, by the cosine returned.

    Zero where there is none: behind a plateau of voxels there is nothing, or walls that go on aside. area: zero for other
    caps, which may be near.
    """
    points, triangles = surface.points, surface.triangles
    vector = unit((area[chosen, None] * normal[chosen]).sum(axis=0))
    radius = np.sqrt(area[chosen].sum() / np.pi)
    centre = (area[chosen, None] * points[triangles[chosen]].mean(axis=1)).sum(axis=0) / area[chosen].sum()
    near = np.setdiff1d(np.array(tree.query_ball_point(centre, 1.8 * radius), dtype=np.int64), chosen)
    offset = points[triangles[near]].mean(axis=1) - centre
    if (area[near] * (normal[near] @ vector)).sum() > PARALLEL * area[near].sum():
        return 0.0
    depth = -(offset @ vector)
    aside = offset + np.outer(depth, vector)
    chosen = (depth > 0.05 * radius) & (depth < 1.2 * radius) & (np.linalg.norm(aside, axis=1) < 1.6 * radius)
    near, aside = near[chosen], unit(aside[chosen])
    if len(near) < 8 or area[near].sum() < ENOUGH * 2.0 * np.pi * 1.15 * radius ** 2:
        return 0.0
    outward = (area[near] * base.dot(normal[near], aside)).sum() / area[near].sum()
    across = np.cross(vector, aside[0])
    sector = np.floor(np.arctan2(aside @ across, aside @ np.cross(across, vector)) * 4.0 / np.pi).astype(int) % 8
    return float(outward) if len(np.unique(sector)) == 8 else 0.0
