"""Names of the openings: by falling radius, from a file of points, or from the faces of the surface."""
import csv

import numpy as np

from importer.raw import BadMesh

from . import face_names
from .surface import show

FAR = 3.0  # radii from an opening's centre: the point belongs to none
EXPECTED = 'expected "name,x,y,z"'


def settle(rims, given, path, scale, wishes=None):
    """Sorts rims by falling radius and names them. given: (name, point) of the surface's faces; wishes: of a file."""
    rims = sorted(rims, key=lambda rim: -rim.radius)
    for number, rim in enumerate(rims, 1):
        rim.name = f"opening-{number}"
    path = None if wishes is None else path
    wishes = given if wishes is None else wishes
    taken = {}
    for name, point in wishes:
        rim = min(rims, key=lambda r: np.linalg.norm(r.centre - point))
        if np.linalg.norm(rim.centre - point) > FAR * rim.radius:
            if path:
                raise BadMesh(f'{path}: the point of "{name}", {show(point / scale)}, is near no opening; the nearest is '
                              f"{rim.name} at {show(rim.centre / scale)}")
            continue
        if id(rim) in taken and path:
            raise BadMesh(f'{path}: "{name}" and "{taken[id(rim)]}" are near the same opening, at {show(rim.centre / scale)}')
        taken.setdefault(id(rim), name)
        rim.name = taken[id(rim)]
    check(rims, path)
    return rims


def check(rims, path):
    names = [rim.name for rim in rims]
    for name in names:
        if names.count(name) > 1 or name == "lumen_wall":
            raise BadMesh(f'{path or "the surface"}: the name "{name}" stands for two surfaces, expected one for each')


def wanted(path, scale):
    """(names with points, or None; names of faces by their numbers, or None) of the file of --names."""
    if path and face_names.is_file_of_them(path):
        return None, face_names.read(path)
    return read(path, scale) if path else None, None


def read(path, scale):
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            rows = [(k, row) for k, row in enumerate(csv.reader(file), 1)
                    if row and "".join(row).strip() and not row[0].lstrip().startswith("#")]
    except (OSError, UnicodeDecodeError) as error:
        raise BadMesh(f"{path}: cannot be read as a file of names: {error}") from error
    wishes = []
    for number, row in rows:
        try:
            point = np.array([float(word) for word in row[1:]])
        except ValueError:
            point = np.zeros(0)
        if number == rows[0][0] and len(row) == 4 and not len(point):
            continue  # a line of titles
        if len(row) != 4 or len(point) != 3 or not np.isfinite(point).all() or not row[0].strip():
            raise BadMesh(f'{path}:{number}: "{",".join(row)}", {EXPECTED}')
        wishes.append((row[0].strip(), point * scale))
    return wishes
