"""The scripts of meshes/ that make flat elements and vessels as a segmentation gives them: a straight shape has the area of
its cylinder, the surfaces have one hole at each end and lie in its plane, the shipped lumens lie on them; a layer that is
joined to a lumen has its volume, and a bent tube that of the straight one. xml/vessels/reproduce solvers fills its table.

Usage: segmented_vessels.py FOLDER_OF_PROGRAMS SCRATCH
"""
import json
import math
import pathlib
import re
import sys

import h5py
import numpy as np

from runs import ENVIRONMENT, ROOT, Run, Verdict, fresh

sys.path.insert(0, str(ROOT / "meshes"))
import segmented  # noqa: E402
import vessel_shapes  # noqa: E402

REPRODUCE = ROOT / "xml" / "vessels" / "reproduce"
VOXELS = {"arch": 1.6}  # mm, twice those of the script: an eighth of the time
SMALL = ["--around", "16", "--axial", "8", "--media-layers", "1", "--adventitia-layers", "1"]


def area_of(points, triangles):
    x = points[triangles]
    return 0.5 * np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1).sum()


def volume_of(path):
    with h5py.File(path) as file:
        x = file["vertices"][:][file["tets"][:]]
    return np.linalg.det(x[:, 1:] - x[:, :1]).sum() / 6.0


def rims_of(points, triangles):
    """Euler characteristic, and the points of the edges with one triangle."""
    edges, count = np.unique(np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1),
                             axis=0, return_counts=True)
    return len(points) - len(edges) + len(triangles), points[np.unique(edges[count == 1])], count.max()


def is_a_cylinder(verdict):
    """A straight branch, cut squarely: 2 pi r L, with a radius that voxels know to a part of their size."""
    radius, length = 5.0, 40.0
    ends = [vessel_shapes.End("inlet", 0, True, 0.0), vessel_shapes.End("outlet", 0, False, 0.0)]
    shape = vessel_shapes.Shape([[(1, 2, z, radius) for z in np.linspace(0, length + 2.4 * radius, 6)]], ends, 0.5, 0.6, 1.0)
    points, triangles = segmented.open_surface(shape, shape.voxel)
    area, expected = area_of(points, triangles), 2 * math.pi * radius * length
    verdict.claim(abs(area - expected) < 0.01 * expected, f"a straight shape has the area {area:.1f} mm², a cylinder {expected:.1f}")
    raw = area_of(*segmented.open_surface(shape, shape.voxel, passes=0))
    verdict.claim(raw > 1.03 * area, f"with the steps of the voxels it is {raw:.1f} mm²")


def is_open_at_its_ends(verdict, name):
    shape = vessel_shapes.SHAPES[name]()
    shape.voxel = VOXELS.get(name, shape.voxel)
    points, triangles = segmented.open_surface(shape, shape.voxel)
    euler, rims, most = rims_of(points, triangles)
    verdict.claim(euler == 2 - len(shape.ends) and most == 2,
                  f"{name}: a sphere with {len(shape.ends)} holes (Euler characteristic {euler})")
    left = np.full(len(rims), True)
    for end in shape.ends:
        centre, normal, radius = vessel_shapes.plane_of(shape, end)
        near = np.linalg.norm(rims - centre, axis=1) < 1.5 * radius
        off = abs((rims[near] - centre) @ normal).max()
        wide = np.linalg.norm(rims[near] - centre, axis=1)
        # the tilted section of a tube that narrows, on voxels
        verdict.claim(off < 0.05 * shape.voxel and abs(wide.mean() - radius) < 0.15 * radius,
                      f"{name}, {end.name}: rim {off:.1e} mm off its plane, of radius {wide.mean():.2f} mm ({radius:g})")
        left &= ~near
    verdict.claim(not left.any(), f"{name}: no other rims")
    return shape


def shipped_lumen_lies_on(verdict, name, shape):
    """The vertices of the coarse mesh: where the distance of its own shape vanishes, but for what smoothing and voxels move."""
    with h5py.File(ROOT / "meshes" / f"{name}.h5") as file:
        surfaces = [word.decode() for word in file["surface_names"][:]]
        chosen = file["triangles"][:][file["triangle_surface"][:] == surfaces.index("interface")]
        x = file["vertices"][:][np.unique(chosen)]
    distance, low = vessel_shapes.sample(shape, shape.voxel)
    k = np.round((x - low) / shape.voxel).astype(int)
    far = np.quantile(abs(distance[tuple(k.T)]), 0.99) / shape.voxel
    verdict.claim(far < 1.5, f"meshes/{name}.h5: 99 of 100 vertices of its interface within {far:.2f} voxels of the shape")
    missing = {end.name for end in shape.ends} - set(surfaces)
    verdict.claim(not missing, f"meshes/{name}.h5 has an opening for each end {sorted(missing)}")


def run(verdict, words, folder, status=0):
    done = Run([str(word) for word in words], folder)
    name = pathlib.Path(words[0]).name
    if not verdict.claim(done.status == status, f"{name} {words[1]} ends with {status} ({done.seconds:.1f} s)"):
        print(done.out + done.err)
    return done


def makes_layers_and_bends(verdict, programs, folder):
    mesh, bend, join = programs / "tunica-mesh", ROOT / "meshes" / "bend_tube.py", ROOT / "meshes" / "join_layer.py"
    run(verdict, [mesh, "tube", "lumen.h5", *SMALL, "--wall", "off"], folder)
    run(verdict, [mesh, "wall", "lumen.h5", "grown.h5", "--surfaces", "interface", "--layers", "inner=0.04:1,next=0.04:1"], folder)
    run(verdict, [join, "grown.h5", "layered.h5"], folder)
    whole, parts = volume_of(folder / "layered.h5"), volume_of(folder / "grown.h5")
    verdict.claim(whole == parts, f"the lumen with its layers has their volume, {whole:.4f} mm³")
    told = run(verdict, [mesh, "wall", "layered.h5", "vessel.h5", "--layers", "media=0.3:1"], folder).out
    verdict.claim("media" in told, "a wall grows around it: its outer faces all have surfaces")
    refused = run(verdict, [join, "lumen.h5", "never.h5"], folder, status=1)
    verdict.claim("no outer" in refused.err, f"a lumen without layers is refused: {refused.err.strip()[:80]}")

    run(verdict, [mesh, "tube", "tube.h5", *SMALL, "--lumen", "off"], folder)
    run(verdict, [bend, "tube.h5", "bent.h5", "90"], folder)
    straight, bent = volume_of(folder / "tube.h5"), volume_of(folder / "bent.h5")
    # chords of an arc in 8 parts of 90/8 degrees are shorter than it, sin(a/2)/(a/2), and elements have the chords' volume
    angle = math.radians(90.0 / 8)
    expected = straight * math.sin(angle) / angle
    verdict.claim(abs(bent - expected) < 2e-3 * straight,
                  f"bent, a tube of {straight:.3f} mm³ has {bent:.3f}; Pappus, by chords: {expected:.3f}")
    refused = run(verdict, [bend, "tube.h5", "never.h5", "720"], folder, status=1)
    verdict.claim("bend it less" in refused.err, "what would fold is refused")


def asks_for_gmsh(verdict, folder):
    (folder / "sitecustomize.py").write_text("import sys\nsys.modules['gmsh'] = None\n", encoding="utf-8")
    done = Run([str(ROOT / "meshes" / "make_vessel.py"), "carotid", "never.msh"], folder, {**ENVIRONMENT, "PYTHONPATH": str(folder)})
    verdict.claim(done.status == 1 and "apt install python3-gmsh" in done.err and not (folder / "never.msh").exists(),
                  f"without Gmsh: {done.err.strip()}")
    done = run(verdict, [ROOT / "meshes" / "make_vessel.py", "carotid", "raw.stl", "--raw", "on", "--voxel", "0.8"], folder)
    size, told = (folder / "raw.stl").stat().st_size, int(done.out.split()[1])
    verdict.claim(size == 84 + 50 * told and told > 1000, f"an .stl needs none: {told} triangles")


def fills_the_table(verdict, programs, folder):
    words = [REPRODUCE, "solvers", "--rows", "tube-2-wall", "--ranks", "1", "--programs", programs, "--output", "runs", "--page", "."]
    (folder / "RESULTS.md").write_text("# T\n\n<!-- beats -->\nbeats stay\n", encoding="utf-8")
    run(verdict, [*words, "--label", "before", "--set", "Wall/Linear Solver/max iterations=2",
                  "--set", "Wall/Linear Solver/fallbacks={}"], folder)
    run(verdict, words, folder)
    page = (folder / "RESULTS.md").read_text(encoding="utf-8")
    row = next((line for line in page.split("\n") if line.startswith("| tube of 2 : 1, wall")), "").split(" | ")
    verdict.claim("beats stay" in page, "the page keeps what it said of other items")
    ends = json.loads((folder / "runs" / "solvers" / "before" / "tube-2-wall-1.json").read_text(encoding="utf-8"))["status"]
    verdict.claim(len(row) == 12 and row[6] == "2*" and row[8].startswith("fails") and ends == 2,
                  f"before, by two iterations: {row[6:9]}")
    counts = [int(word) for word in re.findall(r"\d+", row[9])] if len(row) == 12 else [0]
    verdict.claim(2 < min(counts) and max(counts) < 30 and "*" not in row[9], f"now: {row[9:]}")
    # 2 mm and 1 mm thick under triangles of sides 1 and 1 mm, at the outer side 1.39 times as wide
    verdict.claim(len(row) == 12 and row[1] == "52,416" and abs(float(row[3]) - 2.2) < 0.3,
                  f"unknowns and width over thickness: {row[1:5]}")


def main():
    programs, folder = pathlib.Path(sys.argv[1]).resolve(), fresh(sys.argv[2])
    verdict = Verdict()
    is_a_cylinder(verdict)
    for name in vessel_shapes.SHAPES:
        shipped_lumen_lies_on(verdict, name, is_open_at_its_ends(verdict, name))
    makes_layers_and_bends(verdict, programs, folder)
    asks_for_gmsh(verdict, folder)
    fills_the_table(verdict, programs, folder)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
