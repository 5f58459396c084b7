"""The elements of solver.xml, which remember what was read of them."""
import difflib
import os
import re
from xml.etree import ElementTree

from ..raw import BadMesh, hint
from . import keys

ROOTS = ("svMultiPhysicsFile", "svFSIFile")
TRUE, FALSE = ("true", "1", "t", ".true.", "yes"), ("false", "0", "f", ".false.", "no")
SURE = 0.8  # likeness from which an unknown key is a misspelt one


def parse(path):
    """The outermost element."""
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise BadMesh(f"{path}: cannot be read: {error.strerror}") from error
    except ElementTree.ParseError as error:
        raise BadMesh(f"{path}: is no valid XML: {error}") from None
    if root.tag not in ROOTS:
        raise BadMesh(f'{path}: the outermost element is "{root.tag}", expected "{ROOTS[0]}"')
    return root


def read(path):
    return Node(parse(path), path, "")


class Node:
    """An element: its text, its attributes, and its children by their names."""

    def __init__(self, element, file, outer):
        self.file, self.tag, self.attributes = file, element.tag, element.attrib
        self.text = (element.text or "").strip()
        self.title = " ".join([self.tag, *(value.strip() for value in list(element.attrib.values())[:1])])
        self.place = self.title if not outer else f"{outer} / {self.title}"
        if self.tag in ROOTS:
            self.place = ""
        self.children, self.taken, self.unknown = [], set(), []
        for child in children_of(element, file):
            self.add(child)

    def add(self, child):
        known = keys.OF.get(self.tag)
        if known and child.tag not in known:
            near = difflib.get_close_matches(child.tag, known, 1, SURE)
            if near:
                raise BadMesh(f'{self.file}: {self.where()}unknown key "{child.tag}". Did you mean "{near[0]}"?')
            self.unknown.append(child.tag)
        else:
            self.children.append(Node(child, self.file, self.place))

    def where(self):
        return f"{self.place}: " if self.place else ""

    def all(self, tag):
        self.taken.add(tag)
        return [child for child in self.children if child.tag == tag]

    def one(self, tag):
        """The last of this name, as it is with svMultiPhysics; None where there is none."""
        return (self.all(tag) or [None])[-1]

    def has(self, tag):
        return self.one(tag) is not None

    def word(self, tag, default=None):
        child = self.one(tag)
        return child.text if child is not None and child.text else default

    def required(self, tag):
        value = self.word(tag)
        if value is None:
            raise BadMesh(f'{self.file}: {self.where()}"{tag}" is missing')
        return value

    def number(self, tag, default=None):
        text = self.required(tag) if default is None else self.word(tag)
        if text is None:
            return float(default)
        try:
            return float(text)
        except ValueError:
            raise BadMesh(f'{self.file}: {self.where()}{tag} is "{text}", expected a number') from None

    def count(self, tag, default=None):
        value = self.number(tag, default)
        if value != int(value) or value < 0:
            raise BadMesh(f"{self.file}: {self.where()}{tag} is {value:g}, expected a whole number, not negative")
        return int(value)

    def flag(self, tag, default=False):
        text = self.word(tag)
        if text is None:
            return default
        if text.lower() in TRUE + FALSE:
            return text.lower() in TRUE
        raise BadMesh(f'{self.file}: {self.where()}{tag} is "{text}", expected true or false')

    def vector(self, tag):
        """Three numbers as (x, y, z); None where the key is not there."""
        return None if not self.has(tag) else self.one(tag).as_vector()

    def as_vector(self):
        words = re.sub(r"[(),]", " ", self.text).split()
        try:
            values = [float(word) for word in words]
        except ValueError:
            values = []
        if len(values) != 3:
            raise BadMesh(f'{self.file}: {self.place} is "{self.text}", expected three numbers, (x, y, z)')
        return values

    def choice(self, tag, names, default):
        """What this text stands for, as meant() says."""
        return meant(self.file, f"{self.where()}{tag}", self.word(tag, default), names)

    def name(self, attribute="name"):
        value = self.attributes.get(attribute, "").strip()
        if not value:
            raise BadMesh(f'{self.file}: {self.place}: the attribute "{attribute}" is missing')
        return value

    def path(self, tag):
        """The file that this key must name; paths begin at the folder of solver.xml."""
        self.required(tag)
        return self.one(tag).as_path()

    def as_path(self):
        path = os.path.normpath(os.path.join(os.path.dirname(self.file), self.text))
        if os.path.isfile(path):
            return path
        folder = os.path.dirname(path)
        there = os.listdir(folder) if os.path.isdir(folder) else []
        near = hint(os.path.basename(path), there, "Paths begin at the folder of this file.")
        raise BadMesh(f'{self.file}: {self.place} is "{self.text}", and there is no file {path}. {near}')

    def skip(self, *tags):
        """What need not be read, since it is told together; all of it without names."""
        self.taken |= set(tags) or {child.tag for child in self.children}
        for child in self.children if not tags else []:
            child.skip()

    def left(self):
        """(place, key, text) of each thing in this element that was read by nobody."""
        for child in self.children:
            if child.tag not in self.taken:
                yield self.place, child.tag, child.text
            else:
                yield from child.left()
        for tag in self.unknown:
            yield self.place, tag, None


def meant(file, place, text, names):
    """What a word stands for. names: as it is written there -> meaning; capitals or not are the same here."""
    by_small = {name.lower(): name for name in names}
    if text.lower() in by_small:
        return names[by_small[text.lower()]]
    near = difflib.get_close_matches(text.lower(), by_small, 1)
    nearest = f'Did you mean "{by_small[near[0]]}"?' if near else "Expected one of " + ", ".join(names) + "."
    raise BadMesh(f'{file}: {place} is "{text}", which has no meaning there. {nearest}')


def children_of(element, file):
    """With the content of files that are included."""
    for child in element:
        if child.tag == "Include_xml":
            yield from parse(os.path.join(os.path.dirname(file), (child.text or "").strip()))
        elif isinstance(child.tag, str):
            yield child
