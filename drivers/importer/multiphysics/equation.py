"""Which equation the case solves, and what its domains are."""
from ..raw import BadMesh
from .tree import meant

TYPES = {"FSI": "FSI", "fluid": "fluid", "struct": "wall", "ustruct": "wall", "mesh": "mesh"}
FIELDS = {"fluid": "fluid", "struct": "wall", "ustruct": "wall"}


class Equation:
    """The FSI, fluid or struct equation; `mesh` is that of the mesh motion, or None."""

    def __init__(self, root):
        found = {}
        for node in root.all("Add_equation"):
            kind = kind_of(node)
            if kind in found:
                raise BadMesh(f"{root.file}: {node.place}: the second equation of its kind, expected one")
            found[kind] = node
        self.mesh = found.pop("mesh", None)
        if len(found) != 1:
            raise BadMesh(f'{root.file}: Add_equation: {", ".join(n.title for n in found.values()) or "none"}, expected one: FSI, '
                          "fluid or struct")
        (self.kind, self.node), = found.items()
        self.domains = {int(domain_number(domain)): domain for domain in self.node.all("Domain")}
        for domain in self.domains.values():
            domain.skip("Equation")

    def domain(self, number, place):
        """With the parameters; without any Domain these stand in the equation itself."""
        if not self.domains:
            return self.node
        if number not in self.domains:
            raise BadMesh(f"{self.node.file}: {place}: the domain {number} has no parameters, expected one of "
                          f"{', '.join(map(str, sorted(self.domains)))}, which {self.node.title} has")
        return self.domains[number]

    def field_of(self, number, mesh_node):
        domain = self.domain(number, mesh_node.place)
        if self.kind != "FSI":
            return self.kind
        return meant(domain.file, f"{domain.place} / Equation", domain.required("Equation"), FIELDS)


def kind_of(node):
    return meant(node.file, f"{node.place}: the type", node.name("type"), TYPES)


def domain_number(node):
    text = node.name("id")
    if not text.isdigit():
        raise BadMesh(f'{node.file}: {node.place}: the id is "{text}", expected a whole number')
    return text
