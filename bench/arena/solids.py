"""Systems of solids, of contact, of porous solids and of optimal control."""
import numpy
import scipy.sparse as sparse

import fem
from flows import box_mesh, velocity_dofs
from system import System, by_node, prescribe, saddle


def load_on_side(space, side, direction):
    """A unit load on a side, shared by the places on it, on a component of the displacement."""
    is_loaded = fem.on_boundary(space.places, [side])
    f = numpy.zeros(space.mesh.d * space.n)
    f[direction * space.n + numpy.flatnonzero(is_loaded)] = 1.0 / is_loaded.sum()
    return f


def mixed_elasticity(displacement, pressure, C, f, shear=1.0):
    """2 mu eps(u) : eps(v) - p div v, -q div u - C, with mu = shear."""
    A = fem.elasticity(displacement, shear)
    return saddle(A, fem.divergence(displacement, pressure), C, f, fields=("displacement", "pressure"),
                  components=displacement.mesh.d, is_symmetric=True, rigid=fem.rigid_motions(displacement.places),
                  places=displacement.places if displacement.mesh.d == 3 else None,
                  schur=pressure.mass(1 / shear) + (0 if C is None else C))


def clamped(system, space, how="eliminated"):
    return prescribe(system, velocity_dofs(space, fem.on_boundary(space.places, ["0-"])), 0.0, how)


def cook(n):
    """Cook's membrane, incompressible, Taylor–Hood: 48 wide, 44 high at the left, 16 at the right."""
    points = fem.grid((n, n), (1.0, 1.0))
    x, y = points.T
    mesh = fem.Simplices(numpy.stack([48 * x, 44 * (x + y) - 28 * x * y], axis=1), fem.simplices((n, n)), 2)
    u, p = mesh.quadratic(), mesh.linear()
    return clamped(mixed_elasticity(u, p, None, load_on_side(u, "0+", 1)), u)


def beam(n):
    """A bent beam, nearly incompressible (nu = 0.49999), P1–P1 in space, p last in each node."""
    mesh = box_mesh((4 * n, n, n), 2, [4.0, 1.0, 1.0])
    u = mesh.linear()
    C = u.mass(2e-5) + u.stiffness(mesh.size ** 2 / 4)
    return by_node(clamped(mixed_elasticity(u, u, C, load_on_side(u, "0+", 2)), u), u.n, "last")


def plate(n):
    """A plate of aspect 20 with flat elements, incompressible, P1–P1, in SI units with the modulus of steel."""
    mesh = box_mesh((2 * n, 2 * n, max(2, n // 4)), 2, [0.2, 0.2, 0.01])
    u, shear = mesh.linear(), 8e10
    thickness = 0.01 / max(2, n // 4)
    C = u.stiffness(thickness ** 2 / (4 * shear))
    return by_node(clamped(mixed_elasticity(u, u, C, 1e3 * load_on_side(u, "0+", 2), shear), u, "rows"), u.n, "last")


def hat_values(nodes, s):
    """Values of the piecewise linear functions of sorted nodes at points s: (points, nodes)."""
    k = numpy.clip(numpy.searchsorted(nodes, s, side="right") - 1, 0, len(nodes) - 2)
    t = (s - nodes[k]) / (nodes[k + 1] - nodes[k])
    rows = numpy.arange(len(s))
    return sparse.csr_matrix((numpy.concatenate([1 - t, t]), (numpy.tile(rows, 2), numpy.concatenate([k, k + 1]))),
                             shape=(len(s), len(nodes)))


def contact(n):
    """Two elastic blocks (nu = 0.3) pressed on each other, frictionless: mortar multipliers on meshes that do not match."""
    parts, sides = [], []
    for divisions, origin in ((n, 0.0), (3 * n // 2, 1.0)):
        u = fem.Boxes((divisions, divisions), (1.0, 1.0), (0.0, origin)).linear()
        parts.append(u)
        sides.append(numpy.flatnonzero(numpy.abs(u.places[:, 1] - 1.0) < 1e-12))
    lower, upper = parts
    breaks = numpy.unique(numpy.concatenate([part.places[side, 0] for part, side in zip(parts, sides)]).round(12))
    x, w = fem.gauss(2)
    width = numpy.diff(breaks)
    s, weights = (breaks[:-1, None] + width[:, None] * x).ravel(), (width[:, None] * w).ravel()
    hats = [hat_values(part.places[side, 0], s) for part, side in zip(parts, sides)]
    total = 2 * (lower.n + upper.n)
    rows = []
    for k, (offset, sign) in enumerate(((lower.n, -1.0), (2 * lower.n + upper.n, 1.0))):
        block = hats[0].T @ sparse.diags(sign * weights) @ hats[k]
        choose = sparse.csr_matrix((numpy.ones(len(sides[k])), (numpy.arange(len(sides[k])), offset + sides[k])),
                                   shape=(len(sides[k]), total))
        rows.append(block @ choose)
    A = sparse.block_diag([fem.elasticity(part, 1.0, 1.5) for part in parts], format="csr")
    rigid = numpy.zeros((total, 6))
    rigid[:2 * lower.n, :3], rigid[2 * lower.n:, 3:] = fem.rigid_motions(lower.places), fem.rigid_motions(upper.places)
    system = saddle(A, rows[0] + rows[1], fields=("displacement", "multiplier"), components=2, is_symmetric=True, rigid=rigid)
    bottom = velocity_dofs(lower, fem.on_boundary(lower.places, ["1-"]))
    top = 2 * lower.n + velocity_dofs(upper, fem.on_boundary(upper.places, ["1+"]))
    values = numpy.concatenate([numpy.zeros(len(bottom) + len(top) // 2), numpy.full(len(top) // 2, -0.01)])
    return prescribe(system, numpy.concatenate([bottom, top]), values, "eliminated")


def porous(n):
    """Biot's consolidation, a short step: P2 displacements, P1 pressures, permeability 1e-6, nu = 0.3."""
    mesh = box_mesh((n, n), 2)
    u, p = mesh.quadratic(), mesh.linear()
    C = p.stiffness(1e-6) + p.mass(1e-8)
    A = fem.elasticity(u, 1.0, 1.5)
    system = saddle(A, fem.divergence(u, p), C, load_on_side(u, "0+", 1), fields=("displacement", "pressure"),
                    components=2, is_symmetric=True, rigid=fem.rigid_motions(u.places), schur=p.mass(0.4) + C)
    drained = 2 * u.n + numpy.flatnonzero(fem.on_boundary(p.places, ["1+"]))
    return clamped(prescribe(system, drained, 0.0, "eliminated"), u)


def control(n, weight=1e-4):
    """min |y - y_d|²/2 + weight |q|²/2 with -laplace y = q: states and controls in pairs, then multipliers; P1."""
    mesh = box_mesh((n, n), 2)
    y = mesh.linear()
    M, L = y.mass(), y.stiffness()
    x = mesh.at_points()
    wanted = y.load(numpy.where(x[..., 0] < 0.5, x[..., 1], 1 - x[..., 0]))
    A = sparse.block_diag([M, weight * M], format="csr")
    system = saddle(A, sparse.hstack([L, -M], format="csr"), None, numpy.concatenate([wanted, numpy.zeros(y.n)]),
                    fields=("state and control", "multiplier"), components=2, is_symmetric=True)
    edge = numpy.flatnonzero(fem.on_boundary(y.places, fem.all_sides(2)))
    return by_node(prescribe(system, numpy.concatenate([edge, 2 * y.n + edge]), 0.0, "eliminated"), y.n, "behind")


def weak_boundary(n):
    """-laplace u = 1 with values on the boundary by multipliers in every second node of it; P1, zero C."""
    mesh = box_mesh((n, n), 2)
    u = mesh.linear()
    edge = numpy.flatnonzero(fem.on_boundary(u.places, fem.all_sides(2)))
    middle = u.places[edge] - 0.5
    edge = edge[numpy.argsort(numpy.arctan2(middle[:, 1], middle[:, 0]))]
    count = len(edge)
    h = 1.0 / n
    hats = sparse.csr_matrix((numpy.repeat([0.5 * h, h, 0.5 * h], count // 2),
                              (numpy.tile(numpy.arange(count // 2), 3),
                               numpy.concatenate([(numpy.arange(0, count, 2) + k) % count for k in (-1, 0, 1)]))),
                             shape=(count // 2, count))
    choose = sparse.csr_matrix((numpy.ones(count), (numpy.arange(count), edge)), shape=(count, u.n))
    K = sparse.bmat([[u.stiffness(), (hats @ choose).T], [hats @ choose, None]], format="csr")
    b = numpy.concatenate([u.load(numpy.ones(mesh.weights.shape)), numpy.zeros(count // 2)])
    return System(K, b, {"values": numpy.arange(u.n), "multiplier": numpy.arange(u.n, u.n + count // 2)}, is_symmetric=True)
