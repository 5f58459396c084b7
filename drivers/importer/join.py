"""One mesh of the fluid's and the wall's, which have the same vertices on their interface."""
import numpy as np

from . import names
from .faces import Faces
from .order import between_fluid_and_wall, keep_triangles
from .places import nearest, pairs_within
from .raw import BadMesh, Raw, Tags

PART_OF_EDGE = 0.01  # the tolerance, unless it is given: of the shortest edge on the outside


def name_regions(raw, field):
    """One region has the field's name. Of several, those without a name are numbered behind it."""
    if len(raw.region.names) < 2:
        raw.region = Tags(np.zeros(len(raw.tets), dtype=np.int64), [1], [field])
    raw.region.names = [name or f"{field}-{number}" for name, number in zip(raw.region.names, raw.region.ids)]


def stacked(first, second, prefixes):
    """The tags of one mesh behind those of another. What has the same name in both gets a prefix."""
    common = set(first.names) & set(second.names)
    renamed = [f"{prefix}_{name}" if name in common else name
               for tags, prefix in zip((first, second), prefixes) for name in tags.names]
    of_second = np.where(second.of < 0, -1, second.of + len(first.names))
    return Tags(np.concatenate([first.of, of_second]), list(range(1, len(renamed) + 1)), renamed)


def outside(raw):
    """Vertices of the outer faces, and the shortest edge there."""
    faces = Faces(raw.path, raw.points, raw.tets)
    triangles = faces.outward[faces.is_outer]
    corners = raw.points[triangles]
    edges = corners - corners[:, [1, 2, 0]]
    return np.unique(triangles), float(np.sqrt((edges ** 2).sum(axis=2).min()))


def common_vertices(fluid, wall, tolerance):
    """Pairs of vertices, of the fluid and of the wall, at the same place."""
    (of_fluid, edge_fluid), (of_wall, edge_wall) = outside(fluid), outside(wall)
    if tolerance is None:
        tolerance = PART_OF_EDGE * min(edge_fluid, edge_wall)
    pairs = pairs_within(fluid.points[of_fluid], wall.points[of_wall], tolerance)
    where = f"{fluid.path} and {wall.path}"
    if not len(pairs):
        apart = nearest(fluid.points[of_fluid], wall.points[of_wall])
        raise BadMesh(f"{where}: fluid and wall have no vertex in common: within {tolerance:.3g} mm, while they come "
                      f"as near as about {apart:.3g} mm. Expected two meshes that conform: one interface, meshed once. "
                      "Where it is only rounded off, --tolerance")
    if any(len(np.unique(column)) < len(column) for column in pairs.T):
        raise BadMesh(f"{where}: within {tolerance:.3g} mm a vertex has two of the other mesh, expected a --tolerance "
                      "well below the shortest edge of the interface")
    return of_fluid[pairs[:, 0]], of_wall[pairs[:, 1]]


def unite(fluid, wall, tolerance):
    """Both behind each other; the wall takes the fluid's vertices on the interface."""
    of_fluid, of_wall = common_vertices(fluid, wall, tolerance)
    is_new = np.ones(len(wall.points), dtype=bool)
    is_new[of_wall] = False
    position = len(fluid.points) + np.cumsum(is_new) - 1
    position[of_wall] = of_fluid
    vectors = {}
    for name in {**fluid.vectors, **wall.vectors}:
        rows = [raw.vectors.get(name, np.zeros((len(raw.tets), 3))) for raw in (fluid, wall)]
        vectors[name] = np.concatenate(rows)
    return Raw(f"{fluid.path} and {wall.path}", np.concatenate([fluid.points, wall.points[is_new]]),
               np.concatenate([fluid.tets, position[wall.tets]]),
               stacked(fluid.region, wall.region, ("fluid", "wall")),
               np.concatenate([fluid.triangles, position[wall.triangles]]),
               stacked(fluid.surface, wall.surface, ("fluid", "wall")), vectors,
               [f"fluid: {text}" for text in fluid.notes] + [f"wall: {text}" for text in wall.notes],
               fluid.program or wall.program)


def give_up_interface(raw, fluid_names):
    """Faces between the two lose the names they had in each mesh: they are one surface now."""
    faces = Faces(raw.path, raw.points, raw.tets)
    is_interface = between_fluid_and_wall(raw, faces, fluid_names)
    if not is_interface.any():
        raise BadMesh(f"{raw.path}: fluid and wall have vertices in common, but no face. Expected two meshes that "
                      "conform: one interface, meshed once")
    is_on_it = is_interface[faces.find(raw.triangles)]
    for position, name in enumerate(raw.surface.names):
        of_this = raw.surface.of == position
        lost, all_of_it = int((of_this & is_on_it).sum()), int(of_this.sum())
        if lost:
            raw.note(f'{lost:,} of {all_of_it:,} triangles of "{name}" are on the interface')
    keep_triangles(raw, ~is_on_it)


def join(fluid, wall, tolerance):
    """Both after order.settle(). Returns the mesh and the names of the fluid's regions."""
    for raw, field in ((fluid, "fluid"), (wall, "wall")):
        name_regions(raw, field)
        names.settle(raw.region, "region")
        names.settle(raw.surface, "surface")
    count = len(fluid.region.names)
    raw = unite(fluid, wall, tolerance)
    fluid_names = raw.region.names[:count]
    give_up_interface(raw, fluid_names)
    return raw, fluid_names
