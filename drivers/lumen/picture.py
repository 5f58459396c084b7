"""Pictures by matplotlib: the mesh with sections, and the place of a fault."""
import numpy as np

from . import labels
from . import surface as base
from .surface import unit

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
WALL, LAYER, CORE, MARK = (0.80, 0.42, 0.38), (0.95, 0.75, 0.45), (0.70, 0.82, 0.93), (0.85, 0.05, 0.05)
INSIDE = (0.55, 0.55, 0.60)  # of a wall, seen through a hole
MOST = 60000  # triangles that are painted


def pyplot():
    import logging
    import matplotlib
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it tells of its own files, the first time
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    return plt


def axes_of(points):
    """To the right, up and to the eye: the extent along them falls, so that most is seen."""
    _, vectors = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))
    up, right = vectors[:, 2], vectors[:, 1]
    right, up = (right if right[np.abs(right).argmax()] > 0 else -right), (up if up[np.abs(up).argmax()] > 0 else -up)
    return np.array([right, up, np.cross(right, up)])


def paint(axis, points, triangles, frame, colours, lines=0.0):
    """Triangles as seen along the third direction of the frame, the far ones first."""
    from matplotlib.collections import PolyCollection
    seen = points @ frame.T
    order = np.argsort(seen[triangles][:, :, 2].mean(axis=1))
    normals = unit(base.doubled_normals(points, triangles[order])) @ frame.T
    light = 0.35 + 0.65 * np.abs(normals @ unit(np.array([-0.4, 0.5, 0.8])))
    sides = np.where(normals[:, 2:] < 0.0, INSIDE, np.asarray(colours)[order])
    faces = np.clip(sides * light[:, None], 0.0, 1.0)
    axis.add_collection(PolyCollection(seen[triangles[order]][:, :, :2], facecolors=faces, linewidths=lines or 0.3,
                                       edgecolors="#33333355" if lines else faces))
    axis.set_aspect("equal")
    axis.autoscale_view()
    return seen


def section(points, tets, origin, frame, reach):
    """Polygons in a plane through an origin, in the frame's first two directions, and which tetrahedra they are of."""
    local = (points - origin) @ frame.T
    near = np.flatnonzero((np.linalg.norm(local, axis=1) < reach)[tets].any(axis=1))
    height = local[:, 2]
    mixed = near[(height[tets[near]].min(axis=1) < 0.0) & (height[tets[near]].max(axis=1) >= 0.0)]
    polygons = []
    for tet in tets[mixed]:
        cut = []
        for i, j in EDGES:
            a, b = tet[i], tet[j]
            if (height[a] < 0.0) != (height[b] < 0.0):
                part = height[a] / (height[a] - height[b])
                cut.append(local[a, :2] + part * (local[b, :2] - local[a, :2]))
        cut = np.array(cut)
        middle = cut - cut.mean(axis=0)
        polygons.append(cut[np.argsort(np.arctan2(middle[:, 1], middle[:, 0]))])
    return polygons, mixed


def places(rims, branches):
    """(title, point, direction, radius, whether along the vessel) of three sections."""
    if not branches:
        return [(rim.name, rim.centre - 0.5 * rim.radius * rim.normal, rim.normal, rim.radius, False) for rim in rims[:2]]
    every = [(b.radii[k], b, k) for b in branches for k in range(1, len(b.points) - 1)]
    found = []
    longest = max(branches, key=lambda b: np.linalg.norm(np.diff(b.points, axis=0), axis=1).sum())
    middle = (longest.radii[len(longest.points) // 2], longest, len(longest.points) // 2)
    narrowest = min(every, key=lambda e: e[0])
    for title, (radius, branch, k), along in (("in the middle of the longest branch", middle, False),
                                              ("where it is narrowest", narrowest, False),
                                              ("along it", narrowest, True)):
        found.append((title, branch.points[k], unit(branch.points[k + 1] - branch.points[k - 1]), radius, along))
    return found


def frame_of(direction, along):
    across = unit(np.cross(direction, np.eye(3)[int(np.abs(direction).argmin())]))
    other = np.cross(direction, across)
    return np.array([direction, across, other]) if along else np.array([across, other, direction])


def mesh(mesh_, rims, branches, path):
    from matplotlib.collections import PolyCollection
    plt = pyplot()
    figure = plt.figure(figsize=(15, 10), dpi=100)
    grid = figure.add_gridspec(2, 3)
    whole = figure.add_subplot(grid[:, :2] if len(places(rims, branches)) < 3 else grid[0, :2])
    frame = draw_surface(whole, mesh_, branches)
    slots = [grid[0, 2], grid[1, 2], grid[1, :2]]
    for slot, (title, point, direction, radius, along) in zip(slots, places(rims, branches)):
        axis = figure.add_subplot(slot)
        reach = (4.0 if along else 2.0) * radius
        polygons, tets = section(mesh_.points, mesh_.tets, point, frame_of(direction, along), reach)
        colours = [LAYER if t < mesh_.in_layers else CORE for t in tets]
        axis.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors="#222222", linewidths=0.4))
        axis.set_aspect("equal")
        axis.set_xlim(-reach, reach)
        axis.set_ylim(-0.45 * reach if along else -0.8 * reach, 0.45 * reach if along else 0.8 * reach)
        axis.set_title(f"section {title}, mm", fontsize=10)
    figure.tight_layout()
    labels.draw(whole, [rim.name for rim in rims], [(frame @ rim.centre)[:2] for rim in rims])
    figure.savefig(path)
    plt.close(figure)


def draw_surface(axis, mesh_, branches):
    """Returns the directions in which it is seen."""
    frame = axes_of(mesh_.points[np.unique(mesh_.wall)])
    if np.ptp(mesh_.points @ frame[1]) > np.ptp(mesh_.points @ frame[0]):  # lying, as the place for it does
        frame = np.array([frame[1], -frame[0], frame[2]])
    triangles = np.concatenate([mesh_.wall] + mesh_.caps)
    colours = np.repeat(np.array([WALL, CORE]), [len(mesh_.wall), len(triangles) - len(mesh_.wall)], axis=0)
    paint(axis, mesh_.points, triangles, frame, colours, 0.25 if len(triangles) < MOST else 0.0)
    axis.margins(0.12)  # for the names
    axis.autoscale_view()
    for branch in branches:
        x, y, _ = frame @ branch.points.T
        axis.plot(x, y, "k-", lw=0.8, alpha=0.6)
    axis.set_title(f"{len(mesh_.wall):,} triangles on the wall, {len(mesh_.tets):,} tetrahedra; mm", fontsize=10)
    return frame


def frame_towards(points, triangles, place):
    """The place looks at the eye, and the vessel's length lies as it may."""
    near = np.argsort(np.linalg.norm(points[triangles].mean(axis=1) - place, axis=1))[:60]
    eye = unit(base.doubled_normals(points, triangles[near]).sum(axis=0))
    long = axes_of(points)[1]
    up = long - (long @ eye) * eye if abs(long @ eye) < 0.9 else np.eye(3)[int(np.abs(eye).argmin())]
    up = unit(up - (up @ eye) * eye)
    return np.array([np.cross(up, eye), up, eye])


def fault(surface, place, message, path):
    """The whole surface with a mark, and what is near it."""
    plt = pyplot()
    figure, (whole, near) = plt.subplots(1, 2, figsize=(14, 7), dpi=90)
    points, triangles = surface.points, surface.triangles
    frame = axes_of(points) if place is None else frame_towards(points, triangles, place)
    step = max(1, len(triangles) // MOST)
    paint(whole, points, triangles[::step], frame, np.tile(WALL, (len(triangles[::step]), 1)))
    if place is None:
        near.set_axis_off()
    else:
        draw_near(whole, near, (points, triangles), place, frame)
    figure.suptitle("\n".join(wrapped(message)), fontsize=9)
    figure.savefig(path)
    plt.close(figure)


def draw_near(whole, near, surface, place, frame):
    points, triangles = surface
    x, y, _ = frame @ place
    offset = np.linalg.norm(points[triangles].mean(axis=1) - place, axis=1)
    reach = max(0.06 * np.ptp(points, axis=0).max(), 2.0 * np.sort(offset)[min(30, len(offset) - 1)])
    chosen = triangles[offset < reach]
    paint(near, points, chosen, frame, np.tile(WALL, (len(chosen), 1)), 0.4)
    for axis, size in ((whole, 25), (near, 45)):
        axis.plot([x], [y], "o", ms=size, mfc="none", mec=MARK, mew=2.5)
    near.set_title(f"about {base.show(place)}, mm", fontsize=10)


def wrapped(text):
    import textwrap
    return textwrap.wrap(text, 150)
