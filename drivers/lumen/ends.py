"""Cuts the ends of a vessel flat and square to it, and lengthens them."""
import numpy as np

from . import rims as of_rims
from . import surface as base
from .faults import BadSurface
from .surface import Edges, Surface, show, unit

MARGIN = 0.15  # radii behind the rim's innermost point: rims of segmentations are ragged
BAND = 1.5     # radii of wall that say where an end points
AGREE = 0.94   # cosine between two such answers; else the one nearer to the rim's own is taken


def cut(surface, rims, path, say, beyond=None):
    """Each end cut by the plane that stands square on the wall about it; the new rims, in the same order.

    rims: curves of the surface, which may go on behind them to where the rims beyond are.
    """
    tilt, lost = 0.0, 0.0
    curves = [surface.points[rim.loop] for rim in rims]
    for rim, curve, last in zip(rims, curves, beyond or rims):
        normal = axis(surface, rim)
        tilt = max(tilt, float(np.degrees(np.arccos(np.clip(normal @ rim.normal, -1.0, 1.0)))))
        height = curve @ normal
        at = height.min() - MARGIN * rim.radius
        lost = max(lost, float(height.mean() - at))
        surface = clipped(surface, last, normal, at, path)
    surface, found = of_rims.openings(surface, path, say)
    if len(found) != len(rims):
        raise BadSurface(f"{path}: {len(rims)} ends became {len(found)} when they were cut square: branches too short, "
                         "or cut through a fork. Leave each end a length of two diameters", surface, rims[0].centre)
    say(f"{len(rims)} ends cut square to the vessel, up to {lost:.3g} mm shorter; rims were tilted by up to "
        f"{tilt:.0f} degrees")
    return surface, [min(found, key=lambda new: np.linalg.norm(new.centre - rim.centre)) for rim in rims]


def nearest_loop(surface, rim):
    """Vertices of this end, in a surface whose vertices have other numbers by now."""
    curves = base.loops(surface.triangles)
    return min(curves, key=lambda loop: np.linalg.norm(surface.points[loop].mean(axis=0) - rim.centre))


def axis(surface, rim):
    """Outward: square to the normals of the wall near the end, and along the line through the middles of two slices."""
    areas, vectors = base.areas(surface.points, surface.triangles), base.doubled_normals(surface.points, surface.triangles)
    inward = rim.centre - surface.points[surface.triangles].mean(axis=1)
    depth = (inward @ rim.normal) / rim.radius
    near = np.linalg.norm(inward, axis=1) < 3.2 * rim.radius
    near &= depth > 0.0
    found = [square_to(vectors[near & (depth < BAND)], rim), between(inward, areas, near & (depth > 0.2), depth, rim)]
    found = [way for way in found if way is not None and way @ rim.normal > 0.5]
    if len(found) == 2 and found[0] @ found[1] < AGREE:
        return max(found, key=lambda way: way @ rim.normal)
    return unit(sum(found)) if found else rim.normal


def square_to(vectors, rim):
    """The direction in which the normals, as long as areas, have least; None where there is none."""
    if len(vectors) < 12:
        return None
    length = np.maximum(np.linalg.norm(vectors, axis=1), np.finfo(float).tiny)
    values, directions = np.linalg.eigh((vectors / length[:, None]).T @ vectors)
    way = directions[:, 0] * (1.0 if directions[:, 0] @ rim.normal > 0.0 else -1.0)
    return way if values[0] < 0.3 * values[1] else None


def between(inward, areas, near, depth, rim):
    """From the middle of a slice of wall to that of the one before it. Steps of voxels do not turn this."""
    slices = [near & (depth < 1.2), near & (depth >= 1.2) & (depth < 2.4)]
    if min(chosen.sum() for chosen in slices) < 12:
        return None
    first, second = ((areas[chosen, None] * inward[chosen]).sum(axis=0) / areas[chosen].sum() for chosen in slices)
    return unit(second - first)


def clipped(surface, rim, normal, at, path, start=None):
    """Without what lies beyond the plane and hangs together with the rim, or with the vertices of the start."""
    points, height = surface.points.copy(), surface.points @ normal - at
    edges = Edges(surface.triangles)
    beyond = height[edges.ends].min(axis=1) > 0.0
    label, _ = base.parts(len(points), *edges.ends[beyond].T)
    loop = nearest_loop(surface, rim) if start is None else start
    is_beyond = np.isin(label, np.unique(label[loop])) & (height > 0.0)
    if not is_beyond.any():
        return surface
    reach = np.linalg.norm(points[is_beyond] - rim.centre, axis=1).max()
    if reach > 4.0 * rim.radius + np.linalg.norm(points[loop] - rim.centre, axis=1).max():
        raise BadSurface(f"{path}: the end at {show(rim.centre)} cannot be cut square: what lies beyond the cut goes on for "
                         f"{reach:.3g} mm. Cut the vessel there, where it is a tube", surface, rim.centre)
    height = np.where(is_beyond, height, np.minimum(height, 0.0))
    step = np.median(np.linalg.norm(np.diff(points[edges.ends], axis=1)[:, 0], axis=1))
    snapped = np.abs(points @ normal - at) < 0.05 * step
    snapped &= is_beyond | np.isin(np.arange(len(points)), edges.ends[is_beyond[edges.ends].any(axis=1)])
    points[snapped] -= np.outer(points[snapped] @ normal - at, normal)
    height[snapped] = 0.0
    return cut_triangles(surface, points, height)


def cut_triangles(surface, points, height):
    """Keeps the part of each triangle where the height is not above zero."""
    corners = surface.triangles
    above = (height[corners] > 0.0)
    count = above.sum(axis=1)
    kept, owner = [corners[count == 0]], [np.flatnonzero(count == 0)]
    new = NewPoints(points, height)
    for number in (1, 2):
        mixed = np.flatnonzero(count == number)
        lone = above[mixed].argmax(axis=1) if number == 1 else (~above[mixed]).argmax(axis=1)
        a, b, c = (corners[mixed, (lone + k) % 3] for k in range(3))
        p, q = new.on(a, b), new.on(a, c)
        kept += [np.stack([p, b, c], axis=1), np.stack([p, c, q], axis=1)] if number == 1 else [np.stack([a, p, q], axis=1)]
        owner += [mixed] * (2 if number == 1 else 1)
    triangles, owner = np.concatenate(kept), np.concatenate(owner)
    whole = (np.diff(np.sort(triangles, axis=1), axis=1) > 0).all(axis=1)
    face = None if surface.face is None else surface.face[owner[whole]]
    points, triangles = base.compact(new.points(), triangles[whole])
    cut_off = Surface(points, triangles, face, surface.names)
    label, number = base.pieces(triangles)
    return cut_off if number == 1 else cut_off.take(label == np.bincount(label).argmax())


class NewPoints:
    """Points where edges cross the height zero, one for each edge."""

    def __init__(self, points, height):
        self._points, self._height, self._made = points, height, {}

    def on(self, a, b):
        numbers = np.empty(len(a), dtype=np.int64)
        for i, (p, q) in enumerate(zip(a.tolist(), b.tolist())):
            if self._height[p] == 0.0 or self._height[q] == 0.0:
                numbers[i] = p if self._height[p] == 0.0 else q
                continue
            numbers[i] = self._made.setdefault((min(p, q), max(p, q)), len(self._points) + len(self._made))
        return numbers

    def points(self):
        if not self._made:
            return self._points
        a, b = np.array(list(self._made)).T
        part = (self._height[a] / (self._height[a] - self._height[b]))[:, None]
        return np.vstack([self._points, self._points[a] + part * (self._points[b] - self._points[a])])


def extended(surface, rims, radii):
    """Straight tubes of so many radii at the ends; their rims."""
    points, triangles, face = surface.points, surface.triangles, surface.face
    moved = []
    for rim in rims:
        length = radii * rim.radius
        loop = rim.loop
        step = max(np.linalg.norm(points[loop] - np.roll(points[loop], 1, axis=0), axis=1).mean(), 0.1 * rim.radius)
        count = max(int(np.ceil(length / step)), 1)
        ring = loop
        for k in range(1, count + 1):
            fresh = np.arange(len(loop)) + len(points)
            points = np.vstack([points, points[rim.loop] + rim.normal * length * k / count])
            a, b = np.roll(ring, -1), np.roll(fresh, -1)
            more = np.concatenate([np.stack([a, ring, fresh], axis=1), np.stack([a, fresh, b], axis=1)])
            triangles = np.vstack([triangles, more])
            ring = fresh
        moved.append(of_rims.Rim(ring, rim.centre + rim.normal * length, rim.normal, rim.area, rim.name, length))
    if face is not None:
        face = np.concatenate([face, np.full(len(triangles) - len(face), face[0])])
    return Surface(points, triangles, face, surface.names), moved
