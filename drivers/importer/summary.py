"""What was read, in a few lines, and whether it can be in mm."""
import math

import numpy as np

from .faces import normals, six_volumes
from .places import extent

SHORTEST, LONGEST = 0.5, 5000.0  # mm, between which vessels lie


def extent_text(lengths):
    """Three digits of the longest."""
    longest = max(lengths)
    decimals = min(max(2 - math.floor(math.log10(longest)), 0), 12) if longest > 0 else 0
    return " x ".join(f"{length:.{decimals}f}" for length in lengths) + " mm"


def unit_doubt(raw, scale):
    """A question where the size is not that of a vessel in mm."""
    longest = float(extent(raw.points).max())
    so_long = f"the vessel is {longest:.3g} mm long: " if longest < 1000 else f"the vessel is {longest:.0f} mm long: "
    if longest < SHORTEST:
        return f"{so_long}is this in m? try --scale {1000 * scale:g}"
    if longest > LONGEST:
        return f"{so_long}is this in µm? try --scale {scale / 1000:g}"
    if raw.program == "SimVascular" and scale == 1.0:
        return f"{so_long}SimVascular's models mostly are in cm. If this one is, --scale 10"
    return ""


def sums(of, values, count):
    return np.bincount(of, weights=values, minlength=count)


def neighbours(raw, faces):
    """Names of the regions on the sides of each surface."""
    tets = faces.tets[faces.find(raw.triangles)]
    regions = np.where(tets < 0, -1, raw.region.of[tets])
    pairs = np.unique(np.concatenate([np.stack([raw.surface.of, r], axis=1) for r in regions.T]), axis=0)
    return [[raw.region.names[r] for s, r in pairs.tolist() if s == k and r >= 0]
            for k in range(len(raw.surface.names))]


def lines(raw, faces):
    low, high = raw.points.min(axis=0), raw.points.max(axis=0)
    yield (f"{raw.path}: {len(raw.points):,} vertices, {len(raw.tets):,} tetrahedra, "
           f"{len(raw.triangles):,} triangles")
    yield "box      " + ", ".join(f"{c} {a:.6g} .. {b:.6g}" for c, a, b in zip("xyz", low, high)) + " mm"
    yield "extent   " + extent_text(extent(raw.points).tolist())
    regions, surfaces = raw.region.names, raw.surface.names
    width = max(map(len, regions + surfaces))
    volumes = sums(raw.region.of, six_volumes(raw.points, raw.tets) / 6.0, len(regions))
    counts = np.bincount(raw.region.of, minlength=len(regions))
    for name, count, volume in zip(regions, counts, volumes):
        yield f"region   {name:<{width}} {count:>11,} tetrahedra  volume {volume:.6g} mm^3"
    areas = sums(raw.surface.of, np.linalg.norm(normals(raw.points, raw.triangles), axis=1) / 2.0, len(surfaces))
    counts = np.bincount(raw.surface.of, minlength=len(surfaces))
    for name, count, area, sides in zip(surfaces, counts, areas, neighbours(raw, faces)):
        yield f"surface  {name:<{width}} {count:>11,} triangles   area {area:.6g} mm^2, of {' and '.join(sides)}"
    for name in raw.vectors:
        yield f"vectors  {name}"
    for text in raw.notes:
        yield f"note     {text}"
