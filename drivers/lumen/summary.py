"""The table at the end."""
import numpy as np

from . import quality
from . import surface as base
from .target import Target


def table_of(mesh, rims, raw, volume_change):
    """Numbers of a mesh, beside the surface it was made of."""
    angles = quality.least_dihedral(mesh.points, mesh.tets)
    volumes = quality.six_volumes(mesh.points, mesh.tets) / 6.0
    wall = mesh.points[np.unique(mesh.wall)]
    known = wall[before_ends(wall, rims, raw)]
    distance = np.linalg.norm(Target(raw).nearest(known)[0] - known, axis=1)
    worst = int(distance.argmax())
    around = [len(rim.loop) for rim in rims]
    return {"vertices": len(mesh.points), "tetrahedra": len(mesh.tets), "in layers": mesh.in_layers,
            "triangles": len(mesh.wall), "volume": float(volumes.sum()), "least volume": float(volumes.min()),
            "angle in layers": angles[:mesh.in_layers].min(initial=180.0),
            "angle in core": angles[mesh.in_layers:].min(initial=180.0),
            "poor in core": int((angles[mesh.in_layers:] < 10.0).sum()),
            "distance": float(distance.mean()), "largest distance": float(distance.max()),
            "farthest": known[worst], "volume change": volume_change, "around": around}


def before_ends(wall, rims, raw):
    """Whether a vertex stands where the surface was: not on what has been added to the ends."""
    is_known = np.ones(len(wall), dtype=bool)
    for rim in rims:
        offset = wall - rim.centre
        near = np.linalg.norm(offset - np.outer(offset @ rim.normal, rim.normal), axis=1) < 2.5 * rim.radius
        is_known &= ~(near & (np.abs(offset @ rim.normal) <= rim.added))
    return is_known if is_known.any() else np.ones(len(wall), dtype=bool)


def lines(table, rims, voxel):
    in_layers, inside = table["in layers"], table["tetrahedra"] - table["in layers"]
    yield (f"elements   {table['tetrahedra']:,} tetrahedra, {in_layers:,} in layers and {inside:,} in the core; "
           f"{table['vertices']:,} vertices; {table['triangles']:,} triangles on the wall")
    layers = f"{table['angle in layers']:.1f} degrees in the layers, " if in_layers else ""
    yield f"angles     least between faces: {layers}{table['angle in core']:.1f} in the core"
    change = round(100.0 * table["volume change"], 2) + 0.0  # no minus before a zero
    yield f"volume     {table['volume']:.6g} mm³, {change:+.2f} % beside the surface given, cut at the same ends"
    yield (f"distance   of the wall to the surface given: {table['distance']:.3g} mm in the mean "
           f"({table['distance'] / voxel:.2f} voxels), {table['largest distance']:.3g} mm at most, at "
           f"{base.show(table['farthest'])}")
    width = max(len(rim.name) for rim in rims)
    for rim, around in zip(rims, table["around"]):
        yield (f"{rim.name:<{width}}  radius {rim.radius:.3g} mm, {around} elements around, {around / np.pi:.0f} across, "
               f"centre {base.show(rim.centre)}")
