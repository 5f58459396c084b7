"""Fills what the layers leave by Gmsh: first the openings in their planes, then the volume."""
import contextlib
import dataclasses
import multiprocessing

import numpy as np

from importer.raw import BadMesh

from . import surface as base
from .surface import unit

DELAUNAY, HXT = 1, 10
PATIENCE = 120.0  # s


def gmsh_module():
    try:
        import gmsh
    except ImportError as error:
        raise BadMesh("the core is filled by Gmsh for Python, in Debian the package python3-gmsh "
                      f"({error})") from error
    return gmsh


@contextlib.contextmanager
def model(threads=1):
    """Gmsh, silent, with a model of its own."""
    gmsh = gmsh_module()
    gmsh.initialize(["-noenv"], False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.option.setNumber("General.NumThreads", threads)
        gmsh.model.add("core")
        yield gmsh
    finally:
        gmsh.finalize()


def disc(points, loop, normal):
    """Triangles in a plane within a curve whose vertices stay: (new points, triangles by numbers of points then on).

    Normals along the given one.
    """
    u = unit(np.cross(normal, np.eye(3)[int(np.abs(normal).argmin())]))
    v = np.cross(normal, u)
    origin = points[loop].mean(axis=0)
    flat = np.stack([(points[loop] - origin) @ u, (points[loop] - origin) @ v], axis=1)
    side = np.linalg.norm(flat - np.roll(flat, -1, axis=0), axis=1)
    size = 0.5 * (side + np.roll(side, 1))
    with model() as gmsh:
        geo = gmsh.model.geo
        corners = [geo.addPoint(x, y, 0.0, h) for (x, y), h in zip(flat.tolist(), size.tolist())]
        lines = [geo.addLine(p, q) for p, q in zip(corners, corners[1:] + corners[:1])]
        geo.addPlaneSurface([geo.addCurveLoop(lines)])
        geo.synchronize()
        for line in lines:
            gmsh.model.mesh.setTransfiniteCurve(line, 2)
        gmsh.option.setNumber("Mesh.Algorithm", 5)
        gmsh.model.mesh.generate(2)
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        nodes = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    order = np.argsort(tags)
    tags, xyz = tags[order].astype(np.int64), xyz.reshape(-1, 3)[order]
    number = np.concatenate([loop, np.arange(len(tags) - len(loop)) + len(points)])
    triangles = number[np.searchsorted(tags, nodes.astype(np.int64))]
    inner = xyz[len(loop):]
    new = origin + inner[:, :1] * u + inner[:, 1:2] * v
    every = np.vstack([points, new])
    if (base.doubled_normals(every, triangles) @ normal).sum() < 0.0:
        triangles = triangles[:, ::-1]
    return new, triangles


@dataclasses.dataclass
class Sizes:
    """Of sides at the vertices of a mesh that lies about where the new one will be; linear in its tetrahedra."""
    points: np.ndarray
    tets: np.ndarray
    size: np.ndarray


def fill(points, triangles, algorithm=HXT, sizes=None):
    """Tetrahedra inside a closed surface that stays: (points, those given first; tetrahedra), or None if Gmsh fails.

    In a process of its own: on some surfaces that touch themselves Gmsh dies, or goes on for ever.
    """
    gmsh_module()
    fork = multiprocessing.get_context("fork")
    receiver, sender = fork.Pipe(duplex=False)
    child = fork.Process(target=lambda: sender.send(filled(points, triangles, algorithm, sizes)), daemon=True)
    child.start()
    sender.close()
    try:
        return receiver.recv() if receiver.poll(PATIENCE + 1e-3 * len(triangles)) else None
    except EOFError:
        return None
    finally:
        child.terminate()
        child.join()


def ask_for(gmsh, sizes):
    """Sizes by a field of Gmsh, which takes the nearest where the other mesh is not."""
    corners = sizes.points[sizes.tets].transpose(0, 2, 1).reshape(-1, 12)
    view = gmsh.view.add("sizes")
    gmsh.view.addListData(view, "SS", len(corners), np.hstack([corners, sizes.size[sizes.tets]]).reshape(-1))
    field = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)


def filled(points, triangles, algorithm, sizes):
    used = np.unique(triangles)
    with model() as gmsh:
        surface = gmsh.model.addDiscreteEntity(2)
        gmsh.model.mesh.addNodes(2, surface, (used + 1).tolist(), points[used].reshape(-1).tolist())
        gmsh.model.mesh.addElementsByType(surface, 2, [], (triangles + 1).reshape(-1).tolist())
        gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([surface])])
        gmsh.model.geo.synchronize()
        gmsh.option.setNumber("Mesh.Renumber", 0)  # so that numbers tell which vertex is which
        gmsh.option.setNumber("Mesh.Algorithm3D", algorithm)
        gmsh.option.setNumber("Mesh.Optimize", 1)
        gmsh.option.setNumber("Mesh.OptimizeThreshold", 0.5)
        if sizes is not None:
            ask_for(gmsh, sizes)
        try:
            gmsh.model.mesh.generate(3)
        except Exception:  # Gmsh says no more than that it failed
            return None
        tags, xyz, _ = gmsh.model.mesh.getNodes(3)
        nodes = gmsh.model.mesh.getElementsByType(4)[1].reshape(-1, 4).astype(np.int64)
    if not len(nodes):
        return None
    number = np.full(int(max(tags.max(initial=0), used.max() + 1)) + 1, -1)
    number[used + 1] = used
    number[tags.astype(np.int64)] = np.arange(len(tags)) + len(points)
    return np.vstack([points, xyz.reshape(-1, 3)]), number[nodes]
