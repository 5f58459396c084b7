"""What scripts that write lumens by Gmsh share. Wants Debian's python3-gmsh."""
import gmsh


def begin():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)


def write(path, size, volumes, name_of):
    """Meshes the volumes [tags], region fluid, and writes them as Gmsh 2.2. size: of the elements [mm];
    name_of(surface's tag): of the surfaces that bound them all."""
    gmsh.model.occ.synchronize()
    gmsh.model.setPhysicalName(3, gmsh.model.addPhysicalGroup(3, volumes), "fluid")
    surfaces = {}
    for _, surface in gmsh.model.getBoundary([(3, volume) for volume in volumes], oriented=False):
        surfaces.setdefault(name_of(surface), []).append(surface)
    for name in sorted(surfaces):
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, surfaces[name]), name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5 * size)
    gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
    gmsh.model.mesh.generate(3)
    gmsh.write(path)
    gmsh.finalize()
