"""Vessels as shapes of balls along splines. They are of no one person.

A shape is a list of branches, and a list of ends. A branch is a Catmull-Rom spline through points (x, y, z, radius) [mm]
with a ball at each of its points; branches are joined by the smooth union -k log(sum exp(-d/k)) of their signed
distances d.
"""
import dataclasses

import numpy as np

FAR = 1e3  # mm, a distance that no branch has
SPACING = 0.25  # of balls, in voxels


@dataclasses.dataclass
class End:
    """branch, at_start: which end of which spline; tilt: of the plane that cuts it, degrees; inset: of the plane from
    the last point, in radii."""
    name: str
    branch: int
    at_start: bool
    tilt: float
    inset: float = 1.2


@dataclasses.dataclass
class Shape:
    branches: list
    ends: list
    blend: float  # k of the union, mm
    voxel: float  # mm
    size: float   # of the elements where none is given, mm


def arch():
    """The ascending aorta from above its root, the arch with three branches, the descending aorta."""
    aorta = [(-23, 7, -6, 14), (-25, 4, 10, 14.5), (-25, 1, 28, 14), (-18, -1, 46, 13.2), (-2, 2, 56, 12.2), (14, 8, 50, 11.4),
             (21, 13, 34, 10.8), (22, 15, 12, 10.3), (20, 14, -14, 9.8), (17, 12, -42, 9.4)]
    brachiocephalic = [(-16, -1, 50, 6.5), (-19, -4, 64, 6.2), (-25, -7, 78, 5.8), (-30, -7, 96, 5.6)]
    carotid = [(-1, 2, 58, 4.5), (1, -1, 72, 3.9), (1, -5, 86, 3.6), (-2, -6, 102, 3.5)]
    subclavian = [(11, 7, 53, 5), (17, 8, 66, 4.6), (23, 11, 80, 4.3), (33, 13, 92, 4.1)]
    ends = [End("inlet", 0, True, 6.0), End("outlet_descending", 0, False, -9.0), End("outlet_brachiocephalic", 1, False, 10.0),
            End("outlet_carotid", 2, False, -7.0), End("outlet_subclavian", 3, False, 12.0)]
    return Shape([aorta, brachiocephalic, carotid, subclavian], ends, 0.9, 0.8, 1.7)


def carotid():
    """The common carotid artery and its division; the internal branch has a bulb, and a stenosis of 60 % of its diameter."""
    internal = [(0.8, 0.3, -4, 3.2), (0, 0, 10, 3.2), (-0.9, -0.3, 24, 3.25), (-1.8, 0, 32, 3.5), (-4, 0.5, 38.5, 3.3),
                (-5.6, 0.9, 42.5, 2.2), (-6.6, 1.1, 45, 1.0), (-7.5, 1.2, 47.5, 1.9), (-8.6, 1, 52, 2.4), (-9.6, 0, 62, 2.3),
                (-9.2, -1.4, 74, 2.2)]
    external = [(-0.6, -0.2, 28, 2.6), (2.2, -0.9, 36, 2.2), (5.4, -2, 45, 1.9), (7.6, -2.6, 56, 1.75), (9.6, -2.4, 69, 1.7)]
    ends = [End("inlet", 0, True, -7.0), End("outlet_internal", 0, False, 9.0), End("outlet_external", 1, False, -11.0)]
    return Shape([internal, external], ends, 0.25, 0.4, 0.62)


SHAPES = {"arch": arch, "carotid": carotid}


def spline(points, step):
    """Points of the Catmull-Rom spline, about step apart; radius included."""
    p = np.asarray(points, dtype=float)
    p = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
    pieces = []
    for a, b, c, d in zip(p, p[1:], p[2:], p[3:]):
        t = np.arange(0, 1, step / np.linalg.norm(c[:3] - b[:3]))[:, None]
        pieces.append(b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * b - a - 3 * c + d))))
    return np.vstack(pieces + [p[-2:-1]])


def sample(shape, voxel):
    """Signed distance on the voxels, below zero within, axes (x, y, z), and the place of the first voxel."""
    balls = [spline(branch, SPACING * voxel) for branch in shape.branches]
    every = np.vstack(balls)
    low = (every[:, :3] - every[:, 3:]).min(axis=0) - 4 * voxel
    high = (every[:, :3] + every[:, 3:]).max(axis=0) + 4 * voxel
    axes = [low[k] + voxel * np.arange(int(np.ceil((high[k] - low[k]) / voxel)) + 1) for k in range(3)]
    total = np.zeros([len(axis) for axis in axes])
    margin = 6 * shape.blend
    for branch in balls:
        distance = np.full(total.shape, FAR)
        for *centre, radius in branch:
            window = tuple(slice(*np.searchsorted(axis, (c - radius - margin, c + radius + margin)))
                           for axis, c in zip(axes, centre))
            x, y, z = (axis[part] - c for axis, part, c in zip(axes, window, centre))
            to_centre = np.sqrt(x[:, None, None] ** 2 + y[None, :, None] ** 2 + z[None, None, :] ** 2)
            np.minimum(distance[window], to_centre - radius, out=distance[window])
        total += np.exp(-distance / shape.blend)
    with np.errstate(divide="ignore"):
        return np.minimum(FAR, -shape.blend * np.log(total)), low


def plane_of(shape, end):
    """Centre, outward normal and radius of an end."""
    points = np.array(shape.branches[end.branch], dtype=float)
    last, before = (points[0], points[1]) if end.at_start else (points[-1], points[-2])
    outwards = (last - before)[:3] / np.linalg.norm((last - before)[:3])
    side = np.cross(outwards, np.eye(3)[np.argmin(abs(outwards))])
    angle = np.radians(end.tilt)
    normal = np.cos(angle) * outwards + np.sin(angle) * side / np.linalg.norm(side)
    return last[:3] - end.inset * last[3] * outwards, normal, last[3]
