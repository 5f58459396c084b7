#!/usr/bin/python3
"""Writes the mesh of a channel with an elastic flap on its floor: make_flap.py OUT.msh

Channel 4 mm long, 1 mm high, 0.5 mm wide; flap 0.1 mm thick and 0.6 mm high at x = 1 mm, over the whole
width. Cells along the axes, each cut into six tetrahedra about its diagonal, so that all faces conform.
Regions fluid and flap; surfaces inlet, outlet, floor, roof, sides (of the fluid), interface, base (under
the flap) and flap_sides. Gmsh 2.2.
"""
import itertools
import sys


def graded(points, counts):
    """The corners of that many equal cells between each pair of points."""
    corners = [points[0]]
    for a, b, n in zip(points, points[1:], counts):
        corners += [a + (b - a) * (k + 1) / n for k in range(n)]
    return corners


X = graded([0.0, 0.7, 1.0, 1.1, 1.4, 2.2, 4.0], [4, 3, 2, 3, 4, 5])
Y = graded([0.0, 0.6, 1.0], [6, 4])
Z = graded([0.0, 0.5], [3])
FLAP = (1.0, 1.1, 0.6)  # from x, to x, height
REGIONS = ["fluid", "flap"]
SURFACES = ["inlet", "outlet", "floor", "roof", "sides", "interface", "base", "flap_sides"]


def vertex(i, j, k):
    return (i * len(Y) + j) * len(Z) + k


def is_flap(i, j):
    return FLAP[0] - 1e-9 < X[i] and X[i + 1] < FLAP[1] + 1e-9 and Y[j + 1] < FLAP[2] + 1e-9


def cells():
    return itertools.product(range(len(X) - 1), range(len(Y) - 1), range(len(Z) - 1))


def tetrahedra():
    """Vertices and region of each; from corner to corner of a cell, axis by axis (Kuhn)."""
    for i, j, k in cells():
        for order in itertools.permutations(range(3)):
            corner, path = [i, j, k], []
            for axis in (None, *order):
                if axis is not None:
                    corner[axis] += 1
                path.append(vertex(*corner))
            if order in ((0, 2, 1), (2, 1, 0), (1, 0, 2)):  # odd: turn it round
                path[2], path[3] = path[3], path[2]
            yield path, int(is_flap(i, j))


def surface_of(face, regions, points):
    """The name of a face with these regions on its sides; None inside a field."""
    if len(regions) == 2:
        return "interface" if set(regions) == {0, 1} else None
    at = [{round(points[v][axis], 9) for v in face} for axis in range(3)]
    if at[2] in ({Z[0]}, {Z[-1]}):
        return "flap_sides" if regions[0] else "sides"
    if at[1] == {Y[0]}:
        return "base" if regions[0] else "floor"
    if at[1] == {Y[-1]}:
        return "roof"
    return "inlet" if at[0] == {X[0]} else "outlet"


def main(path):
    points = [(x, y, z) for x in X for y in Y for z in Z]
    tets = list(tetrahedra())
    faces = {}
    for t, region in tets:
        for face in ((t[0], t[2], t[1]), (t[0], t[1], t[3]), (t[0], t[3], t[2]), (t[1], t[2], t[3])):
            faces.setdefault(tuple(sorted(face)), []).append((region, face))
    triangles = []
    for sides in faces.values():
        name = surface_of(sides[0][1], [region for region, _ in sides], points)
        if name:
            triangles.append((SURFACES.index(name), sides[0][1]))
    with open(path, "w", encoding="utf-8") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n")
        out.write(f"{len(REGIONS) + len(SURFACES)}\n")
        for k, name in enumerate(SURFACES):
            out.write(f'2 {k + 1} "{name}"\n')
        for k, name in enumerate(REGIONS):
            out.write(f'3 {k + 1 + len(SURFACES)} "{name}"\n')
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(points)}\n")
        for k, (x, y, z) in enumerate(points):
            out.write(f"{k + 1} {x:.12g} {y:.12g} {z:.12g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(triangles) + len(tets)}\n")
        number = itertools.count(1)
        for tag, face in triangles:
            out.write(f"{next(number)} 2 2 {tag + 1} {tag + 1} {' '.join(str(v + 1) for v in face)}\n")
        for t, region in tets:
            tag = region + 1 + len(SURFACES)
            out.write(f"{next(number)} 4 2 {tag} {tag} {' '.join(str(v + 1) for v in t)}\n")
        out.write("$EndElements\n")


if __name__ == "__main__":
    main(sys.argv[1])
