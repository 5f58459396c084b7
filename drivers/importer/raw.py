"""What a file says of a mesh, before it is put in order."""
import dataclasses
import difflib

import numpy as np


class BadMesh(Exception):
    """The input is not what was expected; one line that names the file."""


def hint(word, words, otherwise):
    """For a name that does not exist: the nearest that does, or that text."""
    near = difflib.get_close_matches(word, words, 1)
    return f'Did you mean "{near[0]}"?' if near else otherwise


@dataclasses.dataclass
class Tags:
    """To which region or surface elements belong: a position per element, -1 where the file names none.

    A name is None where the file gives a number only.
    """
    of: np.ndarray
    ids: list
    names: list

    @classmethod
    def of_numbers(cls, numbers, names=None, untagged=None):
        """From a number per element and the names that some numbers have; `untagged` stands for none."""
        numbers = np.asarray(numbers).astype(np.int64)
        ids, of = np.unique(numbers, return_inverse=True)
        of = of.reshape(-1)
        if untagged in ids:
            position = int(np.searchsorted(ids, untagged))
            of = np.where(of == position, -1, of - (of > position))
            ids = np.delete(ids, position)
        return cls(of, ids.tolist(), [(names or {}).get(i) for i in ids.tolist()])

    @classmethod
    def none(cls, count):
        return cls(np.full(count, -1), [], [])

    def take(self, elements):
        return Tags(self.of[elements], list(self.ids), list(self.names))

    def position(self, name):
        """Of the tag with this name, which is added where there is none."""
        if name not in self.names:
            self.names.append(name)
            self.ids.append(max(self.ids, default=0) + 1)
        return self.names.index(name)


@dataclasses.dataclass
class Raw:
    """Vertices, tetrahedra and triangles as a file has them."""
    path: str
    points: np.ndarray
    tets: np.ndarray
    region: Tags
    triangles: np.ndarray
    surface: Tags
    vectors: dict = dataclasses.field(default_factory=dict)  # name -> a row per tetrahedron
    notes: list = dataclasses.field(default_factory=list)
    program: str = ""  # that wrote it, where its unit is known

    def note(self, text):
        self.notes.append(text)


LINEAR = {"tetra", "triangle"}
PASSED_OVER = ("vertex", "line", "empty")
HOW_TO_LINEAR = ("Save it in first order: ElementOrder = 1 in Gmsh, no quadratic elements in SimVascular and "
                 "Netgen.")


def check_shapes(path, counts):
    """Refuses what is neither a linear tetrahedron nor a triangle. counts: shape -> number of cells."""
    counts = {shape: n for shape, n in counts.items() if n and not shape.startswith(PASSED_OVER)}
    curved = sorted(s for s in counts if s not in LINEAR and s.startswith(("tetra", "triangle")))
    if curved:
        raise BadMesh(f"{path}: {counts[curved[0]]:,} elements are of the kind {curved[0]} (quadratic or higher), "
                      f"expected linear tetrahedra. {HOW_TO_LINEAR}")
    others = [s for s in counts if s not in LINEAR]
    if others:
        found = ", ".join(f"{counts[s]:,} {s}" for s in sorted(others))
        raise BadMesh(f"{path}: {found} beside {counts.get('tetra', 0):,} tetrahedra, expected tetrahedra alone. "
                      "Mesh without hexahedra, prisms and pyramids, in boundary layers too, or cut them into "
                      "tetrahedra.")
    if not counts.get("tetra"):
        raise BadMesh(f"{path}: no tetrahedra, but {counts.get('triangle', 0):,} triangles, expected a volume mesh. "
                      "A surface has to be filled first, by Gmsh, TetGen or SimVascular.")


def check_arrays(raw):
    """Finite points, and vertices that exist."""
    if not np.isfinite(raw.points).all():
        first = int(np.flatnonzero(~np.isfinite(raw.points).all(axis=1))[0])
        raise BadMesh(f"{raw.path}: point {first} has a coordinate that is not a finite number")
    for what, elements in (("tetrahedron", raw.tets), ("triangle", raw.triangles)):
        wrong = (elements < 0) | (elements >= len(raw.points))
        if wrong.any():
            first = int(np.flatnonzero(wrong.any(axis=1))[0])
            raise BadMesh(f"{raw.path}: {what} {first} has vertex {elements[first][wrong[first]][0]}, "
                          f"expected 0..{len(raw.points) - 1}")
        again = (np.diff(np.sort(elements, axis=1), axis=1) == 0).any(axis=1)
        if again.any():
            first = int(np.flatnonzero(again)[0])
            raise BadMesh(f"{raw.path}: {what} {first} has a vertex more than once: {elements[first].tolist()}")
    if max(len(raw.points), 4 * len(raw.tets)) > np.iinfo(np.int32).max:
        raise BadMesh(f"{raw.path}: {len(raw.tets):,} tetrahedra are more than a Tunica mesh holds")
