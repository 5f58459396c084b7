"""A fault of the input that has a place."""
from importer.raw import BadMesh


class BadSurface(BadMesh):
    """A surface that no lumen can be made of; knows the place, for a picture."""

    def __init__(self, message, surface=None, place=None):
        super().__init__(message)
        self.surface, self.place = surface, place
