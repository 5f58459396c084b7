"""*SURFACE of Abaqus: sides of elements, which meshio passes over."""
import re

import numpy as np

from .raw import BadMesh

# Corners of the sides S1 .. S4 of a linear tetrahedron.
SIDES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}


def sections(path):
    """(keyword, parameters, lines of data) of each; keywords and the names of parameters in capitals."""
    found = []
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        for line in file:
            line = line.strip()
            if line.startswith("**") or not line:
                continue
            if line.startswith("*"):
                keyword, *words = [word.strip() for word in line[1:].split(",")]
                pairs = [word.partition("=") for word in words]
                found.append((keyword.upper(), {k.strip().upper(): v.strip().strip('"') for k, _, v in pairs}, []))
            elif found:
                found[-1][2].append([word.strip() for word in line.split(",") if word.strip()])
    return found


def numbers_in(lines):
    return [int(word) for line in lines for word in line if re.fullmatch(r"\d+", word)]


class Sets:
    """Numbers of elements by the names of their sets, which are the same in capitals."""

    def __init__(self, found, mesh):
        self.members = {}
        blocks = iter(mesh.cells)
        self.of_tets = []  # numbers, in the order of the tetrahedra
        for keyword, parameters, lines in found:
            if keyword == "ELEMENT":
                block = next(blocks)
                numbers = numbers_in(lines)[::1 + block.data.shape[1]]
                self.of_tets += numbers if block.type == "tetra" else []
                self.add(parameters, numbers)
            elif keyword == "ELSET":
                numbers = numbers_in(lines)
                if "GENERATE" in parameters:
                    rows = [[int(word) for word in line] + [1] for line in lines]
                    numbers = [n for row in rows for n in range(row[0], row[1] + 1, row[2])]
                names = [word for line in lines for word in line if not word.isdigit()]
                self.add(parameters, numbers + [n for name in names for n in self.members.get(name.upper(), [])])

    def add(self, parameters, numbers):
        if parameters.get("ELSET"):
            self.members.setdefault(parameters["ELSET"].upper(), []).extend(numbers)

    def elements(self, word):
        """Of a set, or the one of that number; none where there is no such set."""
        return [int(word)] if word.isdigit() else self.members.get(word.upper())


class Surfaces:
    """names, triangles and of (which of the names each has); notes on what was passed over; the sets that the
    surfaces are made of, in capitals."""

    def __init__(self, path, mesh, tets):
        found = sections(path)
        wanted = [(parameters, lines) for keyword, parameters, lines in found if keyword == "SURFACE"]
        self.names, self.triangles, self.of, self.notes, self.sets = [], np.zeros((0, 3), dtype=np.int64), [], [], set()
        if not wanted:
            return
        sets = Sets(found, mesh)
        self.row = {number: k for k, number in enumerate(sets.of_tets)}
        taken = {}
        for parameters, lines in wanted:
            self.add(path, (parameters.get("NAME", ""), parameters.get("TYPE", "ELEMENT").upper(), lines), sets,
                     (tets, taken))

    def add(self, path, surface, sets, faces):
        name, kind, lines = surface
        tets, taken = faces
        sides = [(line[0], line[1].upper()) for line in lines if len(line) > 1 and line[1].upper() in SIDES]
        left = len(lines) - len(sides)
        if kind != "ELEMENT" or left:
            what = f"of the type {kind}" if kind != "ELEMENT" else f"has {left} lines without a side S1 to S4"
            self.notes.append(f'the *SURFACE "{name}" {what}, which is passed over: sides of tetrahedra are read')
        if kind != "ELEMENT" or not sides:
            return
        corners, twice = [], 0
        for word, side in sides:
            numbers = sets.elements(word)
            if numbers is None:
                raise BadMesh(f'{path}: the *SURFACE "{name}" names the set "{word}", which no *ELSET or *ELEMENT has')
            self.sets.add(word.upper())
            missing = [n for n in numbers if n not in self.row]
            if missing:
                raise BadMesh(f'{path}: the *SURFACE "{name}" has a side of element {missing[0]}, expected one of the '
                              "tetrahedra")
            corners += [tets[self.row[n]][list(SIDES[side])] for n in numbers]
        kept = []
        for triangle in corners:
            other = taken.setdefault(tuple(sorted(triangle.tolist())), name)
            twice += other != name
            kept += [triangle] if other == name else []
        if twice:
            self.notes.append(f'{twice:,} faces of the *SURFACE "{name}" belong to an earlier one, which keeps them')
        if kept:
            self.names.append(name)
            self.of += [len(self.names) - 1] * len(kept)
            self.triangles = np.concatenate([self.triangles, np.array(kept, dtype=np.int64)])


def add_surfaces(raw, found):
    """Puts them behind the triangles that the mesh has; a face that one of these names keeps that name."""
    named = {tuple(sorted(t)) for t, of in zip(raw.triangles.tolist(), raw.surface.of) if of >= 0}
    is_new = np.array([tuple(sorted(t)) not in named for t in found.triangles.tolist()], dtype=bool)
    if not is_new.all():
        found.notes.append(f"{int((~is_new).sum()):,} faces of *SURFACEs are triangles of a set, whose name they keep")
    positions = np.array([raw.surface.position(name) for name in found.names], dtype=np.int64)
    of = np.array(found.of, dtype=np.int64)
    raw.triangles = np.concatenate([raw.triangles, found.triangles[is_new]])
    raw.surface.of = np.concatenate([raw.surface.of, positions[of[is_new]] if len(of) else of])
    for text in found.notes:
        raw.note(text)
