"""Puts a mesh in order: what Tunica's meshes promise and those of others do not."""
import numpy as np

from . import places
from .faces import Faces, patches, show, six_volumes
from .raw import BadMesh

FLAT = 1e-12  # volume over the cube of the longest edge
INTERFACE, LEFT_OVER = "interface", "surface-0"


def orient(raw):
    """Makes all tetrahedra positive; flat ones are refused."""
    volumes = six_volumes(raw.points, raw.tets) / 6.0
    corners = raw.points[raw.tets]
    edges = corners[:, [1, 2, 3, 2, 3, 3]] - corners[:, [0, 0, 0, 1, 1, 2]]
    longest = np.sqrt((edges ** 2).sum(axis=2).max(axis=1))
    flat = np.abs(volumes) <= FLAT * longest ** 3
    if flat.any():
        first = int(np.flatnonzero(flat)[0])
        raise BadMesh(f"{raw.path}: {int(flat.sum()):,} tetrahedra are flat, the first, number {first}, at "
                      f"{show(corners[first].mean(axis=0))}. Mesh anew, or remove slivers")
    negative = volumes < 0.0
    raw.tets[negative] = raw.tets[negative][:, [0, 1, 3, 2]]
    if negative.any():
        raw.note(f"{int(negative.sum()):,} of {len(raw.tets):,} tetrahedra turned round, to be positive")


def drop_unused(raw):
    used = np.zeros(len(raw.points), dtype=bool)
    used[raw.tets] = True
    if used.all():
        return
    raw.note(f"{int((~used).sum()):,} points that belong to no tetrahedron dropped")
    position = np.cumsum(used) - 1
    raw.points = raw.points[used]
    raw.tets, raw.triangles = position[raw.tets], position[raw.triangles]


def keep_triangles(raw, kept):
    raw.triangles, raw.surface = raw.triangles[kept], raw.surface.take(kept)


def surface_names(raw):
    """As a user knows them, by position."""
    return [name or f"surface-{number}" for name, number in zip(raw.surface.names, raw.surface.ids)]


def check_triangles(raw, faces, is_merged):
    """Each is a face, and no face has two. Those without a surface are left out."""
    keep_triangles(raw, raw.surface.of >= 0)
    at = faces.find(raw.triangles)
    names = surface_names(raw)
    stray = np.flatnonzero(at < 0)
    if len(stray):
        place = show(raw.points[raw.triangles[stray[0]]].mean(axis=0))
        raise BadMesh(f"{raw.path}: {len(stray):,} triangles are no faces of tetrahedra, the first, of the surface "
                      f'"{names[raw.surface.of[stray[0]]]}", at {place}. Do surface and volume not share their '
                      "vertices (--merge), or is the triangle one of another mesh?")
    drop_repeated(raw, at, names, is_merged)


def drop_repeated(raw, at, names, is_merged):
    """Where parts were merged, the triangles of both sides lie on a common face: the first one names it."""
    order = np.argsort(at, kind="stable")
    again = np.flatnonzero(at[order][1:] == at[order][:-1])
    first, second = order[again], order[again + 1]
    clash = np.flatnonzero(raw.surface.of[first] != raw.surface.of[second])
    if len(clash):
        both = " and ".join(f'"{names[raw.surface.of[side[clash[0]]]]}"' for side in (first, second))
        if not is_merged:
            raise BadMesh(f"{raw.path}: {len(clash):,} faces belong to two surfaces, the first to {both}. Each face "
                          "belongs to one surface only")
        raw.note(f"{len(clash):,} faces belong to two surfaces, as to {both}: they are left to the first of them")
    elif len(again):
        raw.note(f"{len(again):,} triangles that are there twice dropped")
    kept = np.ones(len(at), dtype=bool)
    kept[second] = False
    keep_triangles(raw, kept)


def cover_inside(raw):
    """Tetrahedra without a region get one that has a number and no name."""
    missing = raw.region.of < 0
    if missing.any():
        free = 1 if not raw.region.ids else 0 if 0 not in raw.region.ids else max(raw.region.ids) + 1
        raw.region.of = np.where(missing, len(raw.region.ids), raw.region.of)
        raw.region.ids.append(free)
        raw.region.names.append(None)


def settle(raw, is_merged=False):
    """Orientation and faces of one mesh as a file has it, before surfaces are added."""
    cover_inside(raw)
    orient(raw)
    faces = Faces(raw.path, raw.points, raw.tets)
    check_triangles(raw, faces, is_merged)
    drop_unused(raw)


def between_fluid_and_wall(raw, faces, fluid_names):
    """Whether a face lies between a fluid region and another one."""
    is_fluid = np.array([name in fluid_names for name in raw.region.names] + [False])
    of_tet = is_fluid[raw.region.of]
    return ~faces.is_outer & (of_tet[faces.tets[:, 0]] != of_tet[faces.tets[:, 1]])


def add_triangles(raw, faces, chosen, positions):
    raw.triangles = np.concatenate([raw.triangles, faces.outward[chosen]])
    raw.surface.of = np.concatenate([raw.surface.of, positions])


def report_touching(raw, faces, fluid_names):
    """Fluid and wall may share no vertices but those of common faces: a coupled run would refuse them."""
    is_fluid = np.array([name in fluid_names for name in raw.region.names])[raw.region.of]
    of_both = np.zeros((3, len(raw.points)), dtype=bool)
    of_both[0, raw.tets[is_fluid]] = of_both[1, raw.tets[~is_fluid]] = True
    of_both[2, faces.outward[between_fluid_and_wall(raw, faces, fluid_names)]] = True
    touching = np.flatnonzero(of_both[0] & of_both[1] & ~of_both[2])
    if len(touching):
        raw.note(f"fluid and wall touch in {len(touching):,} vertices without a common face, the first at "
                 f"{show(raw.points[touching[0]])}: a coupled run refuses that")


def cover_interface(raw, faces, fluid_names, has_triangle):
    missing = between_fluid_and_wall(raw, faces, fluid_names) & ~has_triangle
    if missing.any():
        position = raw.surface.position(INTERFACE)
        add_triangles(raw, faces, missing, np.full(int(missing.sum()), position))
        raw.note(f'{int(missing.sum()):,} faces between fluid and wall put into the surface "{INTERFACE}"')
    bare = ~faces.is_outer & ~has_triangle
    differ = raw.region.of[faces.tets[:, 0]] != raw.region.of[faces.tets[:, 1]]
    if (bare & differ).any() and not set(fluid_names) & set(raw.region.names):
        raw.note(f"{int((bare & differ).sum()):,} faces between regions have no surface, and no region is called "
                 f'"{", ".join(fluid_names)}": with --fluid-regions NAME those of the fluid get the surface '
                 f'"{INTERFACE}"')


def cover_outside(raw, faces, has_triangle, split_angle):
    """Outer faces without a triangle: one surface, or a patch each."""
    missing = faces.is_outer & ~has_triangle
    if not missing.any():
        return
    if split_angle is None:
        add_triangles(raw, faces, missing, np.full(int(missing.sum()), left_over(raw)))
        raw.note(f'{int(missing.sum()):,} outer faces without a surface put into "{LEFT_OVER}"; --split-angle 40 '
                 "separates caps and walls")
        return
    patch = patches(raw.points, faces.outward[missing], raw.region.of[faces.tets[missing, 0]], split_angle)
    count, number = int(patch.max()) + 1, 0
    positions = []
    for _ in range(count):
        number += 1
        while f"surface-{number}" in surface_names(raw):
            number += 1
        positions.append(raw.surface.position(f"surface-{number}"))
    add_triangles(raw, faces, missing, np.array(positions)[patch])
    raw.note(f"{int(missing.sum()):,} outer faces without a surface split into {count:,} patches"
             + (": a larger --split-angle makes fewer" if count > 20 else ""))


def left_over(raw):
    """Position of surface-0, which has the number 0 where that is free."""
    if LEFT_OVER in surface_names(raw):
        return surface_names(raw).index(LEFT_OVER)
    raw.surface.names.append(LEFT_OVER)
    raw.surface.ids.append(0 if 0 not in raw.surface.ids else max(raw.surface.ids) + 1)
    return len(raw.surface.names) - 1


def finish(raw, fluid_names, split_angle):
    """Every outer face, and every one between fluid and wall, gets a surface. After settle()."""
    faces = Faces(raw.path, raw.points, raw.tets)
    has_triangle = np.zeros(faces.count, dtype=bool)
    has_triangle[faces.find(raw.triangles)] = True
    cover_interface(raw, faces, fluid_names, has_triangle)
    cover_outside(raw, faces, has_triangle, split_angle)
    report_touching(raw, faces, fluid_names)
    places.report_twins(raw)
    return faces
