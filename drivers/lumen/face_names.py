"""Names of the numbered faces of a surface, from files of SimVascular beside it."""
import os
import re
from xml.etree import ElementTree

import numpy as np

from importer.raw import BadMesh
from importer.simvascular import face_files
from importer.vtk_files import data_of, read_surface

ENDINGS = (".mdl", ".facenames")
FACE = re.compile(r"set g\w+FaceNames\((\d+)\)\s+\{?([^{}]*?)\}?\s*$")


def is_file_of_them(path):
    return path.lower().endswith(ENDINGS)


def read(path):
    """Number -> name."""
    found = content(path)
    if not found:
        raise BadMesh(f"{path}: names no faces, expected those of a model of SimVascular")
    return found


def content(path):
    try:
        with open(path, encoding="utf-8-sig") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        raise BadMesh(f"{path}: cannot be read as names of faces: {error}") from error
    return of_model(path, text) if path.lower().endswith(".mdl") else of_script(text)


def of_model(path, text):
    """<face id="2" name="cap_aorta" type="cap"/>; the file has two outermost elements, which XML does not permit."""
    try:
        root = ElementTree.fromstring("<all>" + re.sub(r"<\?xml.*?\?>", "", text) + "</all>")
        return {int(face.get("id")): face.get("name") for face in root.iter("face")}
    except (ElementTree.ParseError, TypeError, ValueError) as error:
        raise BadMesh(f"{path}: cannot be read as a model of SimVascular: {error}") from None


def of_script(text):
    """set gPolyDataFaceNames(2) {cap_aorta}"""
    found = (FACE.match(line.strip()) for line in text.splitlines())
    return {int(face[1]): face[2].strip() for face in found if face}


def beside(path):
    """Of model.vtp those of model.mdl or model.vtp.facenames; of an exterior those of the faces in mesh-surfaces."""
    for other in (os.path.splitext(path)[0] + ".mdl", path + ".facenames"):
        found = content(other) if os.path.isfile(other) else {}
        if found:
            return found
    found = {}
    for name, file in face_files(path):
        numbers = face_numbers(file)
        if len(numbers) == 1:
            found[int(numbers[0])] = name
    return found


def face_numbers(path):
    """Different ones in a file; none where it is no surface of triangles."""
    try:
        return np.unique(data_of(read_surface(path)[0].GetCellData()).get("ModelFaceID", []))
    except BadMesh:
        return []
