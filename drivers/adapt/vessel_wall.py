"""The wall around the lumen, measured in the run's mesh, so that it can be grown again on another one."""
import dataclasses

import numpy as np

from importer.raw import BadMesh
from lumen import surface as base
from lumen.surface import Surface
from lumen.target import Target
from report.surfaces import numbers_by_place

from . import columns


@dataclasses.dataclass
class Wall:
    """layers: (name, share of the thickness, elements through it), from the lumen outwards; thickness at points [mm]."""
    layers: list
    points: np.ndarray
    thickness: np.ndarray
    tets: int

    @property
    def through(self):
        return sum(elements for _, _, elements in self.layers)

    def text(self):
        """As --layers of tunica-mesh wall."""
        return ",".join(f"{name}={share:.6g}:{elements}" for name, share, elements in self.layers)


def of(run):
    """None where the run has no wall."""
    if "wall" not in run.run.grids():
        return None
    fields = run.run.fields
    points, tets, region = (fields[f"wall/{name}"][:] for name in ("points", "tets", "region"))
    at_wall, of_blood = numbers_by_place(points, run.points)  # between layers points are there once for each
    place = np.full(max(at_wall.max(), of_blood.max()) + 1, -1)
    place[at_wall] = np.arange(len(points))
    tets, inner = place[at_wall[tets]], place[of_blood[run.wall]]
    found = columns.peeled(points, tets, inner)
    if not found.is_layer.all():
        raise BadMesh(f"{run.mesh_file}: its wall is not made of layers of prisms on {run.wall_names[0]}: it was not grown by "
                      "tunica-mesh wall, and cannot be grown again. Grow a wall, or give a run of the blood alone")
    names = [name.decode() for name in fields["wall/region_names"][:]]
    return Wall(layers_of(found, names, region), points[np.unique(inner)], thickness_of(points, found.far, inner), len(tets))


def layers_of(found, names, region):
    """Heights of neighbouring layers of the same region are added."""
    layers = []
    for height, layer in zip(found.heights, found.tets):
        name = names[region[layer[0]]]
        if layers and layers[-1][0] == name:
            layers[-1] = (name, layers[-1][1] + height, layers[-1][2] + 1)
        else:
            layers.append((name, height, 1))
    whole = sum(height for _, height, _ in layers)
    return [(name, height / whole, elements) for name, height, elements in layers]


def thickness_of(points, far, inner):
    outer = Target(Surface(*base.compact(points, far)))
    at = points[np.unique(inner)]
    return np.linalg.norm(outer.nearest(at)[0] - at, axis=1)
