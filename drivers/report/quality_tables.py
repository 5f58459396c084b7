"""Tables about the mesh and the wall that a run had, from fields.h5."""
import numpy as np

from report.surfaces import edges_of, numbers_by_place
from report.tables import Table

FEW_ACROSS, FEW_THROUGH = 10, 2  # elements across an opening, through the wall


def elements_across(end):
    """Edges of a cap across its diameter, of the circle of its area; its radius [mm] and area [mm^2]."""
    x = end.points[end.triangles]
    area = 0.5 * np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1).sum()
    edge = np.mean([np.linalg.norm(x[:, i] - x[:, i - 1], axis=1) for i in range(3)])
    return 2 * np.sqrt(area / np.pi) / edge, np.sqrt(area / np.pi), area


def openings(parts):
    rows = []
    for name, end in parts.ends.items():
        across, radius, area = elements_across(end)
        rows.append([name, f"{radius:.2f}", f"{area:.1f}", f"{across:.0f}"])
    return Table("Openings", "", ["opening", "radius, mm", "area, mm²", "elements across"], rows) if rows else None


def layers_through(points, tets, inner, outer):
    """For each outer point the least number of edges from the inner ones."""
    pairs = edges_of(tets)
    level = np.full(len(points), -1)
    level[inner] = 0
    for count in range(1, len(points)):
        for a, b in ((0, 1), (1, 0)):
            reached = pairs[(level[pairs[:, a]] == count - 1) & (level[pairs[:, b]] < 0), b]
            level[reached] = count
        if not (level == count).any():
            break
    return level[outer]


def _without_rim(surface):
    """Nodes that do not lie on the edge of a surface."""
    sides = np.sort(surface.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    sides, count = np.unique(sides, axis=0, return_counts=True)
    return surface.nodes[np.setdiff1d(np.arange(len(surface.nodes)), sides[count == 1])]


def through_wall(run, parts):
    """Elements through the wall at its outer points, and how thick it is there; None without both fields."""
    if len(run.grids()) < 2 or not len(parts.surfaces.outer.nodes):
        return None
    from scipy.spatial import cKDTree
    points, tets = run.mesh("wall")
    lumen = parts.surfaces.lumen
    of_wall, of_lumen = numbers_by_place(points, lumen.points)
    numbers, first, same = np.unique(of_wall, return_index=True, return_inverse=True)
    inner, outer = np.flatnonzero(np.isin(numbers, of_lumen)), np.unique(same.reshape(-1)[_without_rim(parts.surfaces.outer)])
    if not len(inner) or not len(outer):
        return None
    thickness = cKDTree(points[first[inner]]).query(points[first[outer]])[0]
    return layers_through(points[first], same.reshape(-1)[tets], inner, outer), thickness


def quality(run, beat, through):
    from lumen.quality import least_dihedral
    rows = []
    for grid in run.grids():
        points, tets = run.mesh(grid)
        angles = least_dihedral(points, tets)
        rows += [[f"{grid}: tetrahedra, vertices", f"{len(tets)}, {len(run.fields[f'{grid}/points'])}"],
                 [f"{grid}: least angle between faces; 1 % have less than", f"{angles.min():.1f}°; {np.quantile(angles, 0.01):.1f}°"]]
        ratio = min(float(_change(run, grid, group, points, tets).min()) for _, group in run.outputs[-20:])
        rows.append([f"{grid}: least volume of an element in the last outputs, of its first one", f"{ratio:.3f}"])
    if through:
        count, thickness = through
        rows += [["elements through the wall, beside its ends: least, most", f"{count.min()}, {count.max()}"],
                 ["thickness of the wall: 1 %, median, 99 %", ", ".join(f"{t:.2f}" for t in np.quantile(thickness, (0.01, 0.5, 0.99))) + " mm"]]
    low, high = beat.of("min_det_F"), beat.of("max_det_F")
    if low is not None and high is not None:
        rows.append(["det F of the wall in the beat: least, greatest", f"{low.min():.3f}, {high.max():.3f}"])
    rows.append(["steps in the beat, longest", f"{len(beat.times) - 1}, {beat.longest_step():g} ms"])
    return Table("Mesh and wall", "", ["", ""], rows)


def _change(run, grid, group, points, tets):
    size = lambda x: np.linalg.det(x[tets][:, 1:] - x[tets][:, :1])  # noqa: E731
    return size(points + run.displacement(group, grid)) / size(points)


def doubts(beat, parts, through):
    """What of these a reader should look at. through: what through_wall() has found."""
    found = []
    if not beat.is_whole():
        found.append(f"The run is shorter than one beat of {beat.period:g} ms: all that is said of a beat is of a part of it.")
    if parts is None:
        return found
    coarse = [name for name, end in parts.ends.items() if elements_across(end)[0] < FEW_ACROSS]
    if coarse:
        found.append(f"Fewer than {FEW_ACROSS} elements across {', '.join(coarse)}: do not rely on the wall shear stress there.")
    if through and through[0].min() < FEW_THROUGH:
        found.append(f"The wall has {through[0].min()} element through it at places: its stress is that of a coarse mesh.")
    if not parts.ends:
        found.append("The caps of the lumen could not be told apart: there are no tables by branch.")
    return found
