"""Systems of incompressible flow and of flow in porous media."""
import numpy
import scipy.sparse as sparse

import fem
from system import System, by_node, prescribe, saddle


def velocity_dofs(space, where, component=None):
    """Unknowns of a velocity, component after component."""
    nodes = numpy.flatnonzero(where)
    components = range(space.mesh.d) if component is None else [component]
    return numpy.concatenate([k * space.n + nodes for k in components])


def parabola(places):
    """4 y (1 - y) in the plane, 16 y (1 - y) z (1 - z) in space."""
    return numpy.prod([4 * places[:, k] * (1 - places[:, k]) for k in range(1, places.shape[1])], axis=0)


def channel(system, velocity, how):
    """A parabolic profile at the left end, walls, an open right end."""
    d = velocity.mesh.d
    given = fem.on_boundary(velocity.places, [side for side in fem.all_sides(d) if side != "0+"])
    profile = numpy.where(fem.on_boundary(velocity.places, ["0-"]), parabola(velocity.places), 0.0)
    values = numpy.concatenate([profile[given]] + [numpy.zeros(given.sum())] * (d - 1))
    return prescribe(system, velocity_dofs(velocity, given), values, how)


def cavity(system, velocity, how):
    """Closed walls, and a lid that moves with 16 x² (1 - x)² in the plane, likewise in space."""
    d, places = velocity.mesh.d, velocity.places
    given = fem.on_boundary(places, fem.all_sides(d))
    low, high = places.min(axis=0), places.max(axis=0)
    s = (places - low) / (high - low)
    along = numpy.prod([(4 * s[:, k] * (1 - s[:, k])) ** 2 for k in range(d - 1)], axis=0)
    lid = numpy.where(fem.on_boundary(places, [f"{d - 1}+"]), along, 0.0)
    values = numpy.concatenate([lid[given]] + [numpy.zeros(given.sum())] * (d - 1))
    return prescribe(system, velocity_dofs(velocity, given), values, how)


def stokes(velocity, pressure, C=None, viscosity=1.0, **known):
    """viscosity: a number, or one for each cell."""
    d = velocity.mesh.d
    A = fem.repeated(velocity.stiffness(viscosity), d)
    mass = pressure.mass(1 / viscosity)
    return saddle(A, fem.divergence(velocity, pressure), C, components=d, schur=mass if C is None else mass + C,
                  is_symmetric=True, **known)


def box_mesh(shape, degree, lengths=None, origin=None):
    return fem.Simplices(fem.grid(shape, lengths or [1.0] * len(shape), origin), fem.simplices(shape), degree)


def projected_mass(pressure):
    """Mass minus that of the means of the cells (Bochev, Dohrmann and Gunzburger 2006)."""
    constant = pressure.mesh.constant()
    across = pressure.matrix(numpy.einsum("qm,qmi,qmj->mij", pressure.mesh.weights, pressure.phi, constant.phi), constant)
    return pressure.mass() - across @ sparse.diags(1 / pressure.mesh.volumes) @ across.T


def stokes_taylor_hood_plane(n):
    mesh = box_mesh((n, n), 2)
    u, p = mesh.quadratic(), mesh.linear()
    return channel(stokes(u, p), u, "eliminated")


def stokes_taylor_hood_space(n):
    mesh = box_mesh((n, n, n), 2)
    u, p = mesh.quadratic(), mesh.linear()
    system = channel(stokes(u, p), u, "eliminated")
    return by_node(system, u.n, "behind")


def stokes_mini(n):
    mesh = box_mesh((n, n), 4)
    u, p = mesh.with_bubbles(), mesh.linear()
    return channel(stokes(u, p), u, "rows")


def stokes_p1p1_plane(n):
    """Brezzi and Pitkäranta's stabilisation, p in front of the velocities of its node."""
    mesh = box_mesh((2 * n, n), 2, [2.0, 1.0])
    u = mesh.linear()
    return by_node(channel(stokes(u, u, u.stiffness(mesh.size ** 2 / 12)), u, "rows"), u.n, "first")


def stokes_p1p1_space(n):
    mesh = box_mesh((2 * n, n, n), 2, [2.0, 1.0, 1.0])
    u = mesh.linear()
    return by_node(channel(stokes(u, u, u.stiffness(mesh.size ** 2 / 12)), u, "eliminated"), u.n, "last")


def stokes_q1q1_plane(n):
    mesh = fem.Boxes((n, n), (1.0, 1.0))
    u = mesh.linear()
    return cavity(stokes(u, u, projected_mass(u), constants=("pressure",)), u, "eliminated")


def stokes_q1q1_space(n):
    mesh = fem.Boxes((n, n, n), (1.0, 1.0, 1.0))
    u = mesh.linear()
    system = cavity(stokes(u, u, projected_mass(u), constants=("pressure",)), u, "eliminated")
    return by_node(system, u.n, "last")


def differences(shape, axis):
    """Pressures (cells) to inner faces across an axis: p of the cell behind minus that of the cell before."""
    parts = []
    for k, n in enumerate(shape):
        if k == axis:
            parts.append(sparse.diags([-numpy.ones(n - 1), numpy.ones(n - 1)], [0, 1], shape=(n - 1, n)))
        else:
            parts.append(sparse.identity(n))
    return product_of(parts)


def product_of(parts):
    """Kronecker product, the first coordinate fastest."""
    product = parts[0]
    for part in parts[1:]:
        product = sparse.kron(part, product)
    return sparse.csr_matrix(product)


def walled_laplace(n, is_staggered):
    """Second differences times -1: between walls that lie on faces (staggered) or half a cell off."""
    size = n - 1 if is_staggered else n
    main = numpy.full(size, 2.0)
    if not is_staggered:
        main[[0, -1]] = 3.0
    return sparse.diags([-numpy.ones(size - 1), main, -numpy.ones(size - 1)], [-1, 0, 1])


def stokes_mac(shape):
    """Marker and cell: pressures in cells, velocities on faces; a smooth force in a closed box."""
    d, h = len(shape), 1.0 / shape[0]
    blocks, gradients, forces = [], [], []
    for axis in range(d):
        total = None
        for k in range(d):
            parts = [walled_laplace(n, i == axis) if i == k else sparse.identity(n - 1 if i == axis else n)
                     for i, n in enumerate(shape)]
            total = product_of(parts) if total is None else total + product_of(parts)
        blocks.append(total * h ** (d - 2))
        gradients.append(differences(shape, axis) * h ** (d - 1))
        places = numpy.meshgrid(*[h * (numpy.arange(1, n) if i == axis else numpy.arange(n) + 0.5)
                                  for i, n in enumerate(shape)][::-1], indexing="ij")[::-1]
        forces.append(h ** d * numpy.sin(numpy.pi * (axis + 1) * places[(axis + 1) % d].ravel())
                      * numpy.cos(2 * places[axis].ravel()))
    return saddle(sparse.block_diag(blocks, format="csr"), sparse.vstack(gradients).T.tocsr(), None,
                  numpy.concatenate(forces), constants=("pressure",), is_symmetric=True,
                  schur=h ** d * sparse.identity(int(numpy.prod(shape)), format="csr"))


def stokes_mac_plane(n):
    return stokes_mac((n, n))


def stokes_mac_space(n):
    return stokes_mac((n, n, n))


def stokes_jumps(n):
    """Discs of 1e6 times the viscosity that sink (May and Moresi 2008, figure 5), Taylor–Hood."""
    mesh = box_mesh((n, n), 2)
    u, p = mesh.quadratic(), mesh.linear()
    middles = mesh.points[mesh.cells].mean(axis=1)
    centres = numpy.array([[0.3, 0.3], [0.7, 0.4], [0.35, 0.75], [0.72, 0.78]])
    is_disc = (numpy.linalg.norm(middles[:, None] - centres[None], axis=2) < 0.13).any(axis=1)
    viscosity = numpy.where(is_disc, 1e3, 1e-3)
    system = stokes(u, p, None, viscosity, constants=("pressure",))
    system.b[u.n:2 * u.n] = u.load(-numpy.broadcast_to(is_disc.astype(float), mesh.weights.shape))
    given = velocity_dofs(u, fem.on_boundary(u.places, fem.all_sides(2)))
    return prescribe(system, given, 0.0, "eliminated")


def kovasznay(places, reynolds):
    """Velocity of a grid's wake and its gradient: an exact solution of the equations of Navier and Stokes."""
    rate = reynolds / 2 - numpy.sqrt(reynolds ** 2 / 4 + 4 * numpy.pi ** 2)
    x, y = places[..., 0], places[..., 1]
    e, s, c = numpy.exp(rate * x), numpy.sin(2 * numpy.pi * y), numpy.cos(2 * numpy.pi * y)
    velocity = numpy.stack([1 - e * c, rate / (2 * numpy.pi) * e * s], axis=-1)
    slopes = numpy.stack([numpy.stack([-rate * e * c, 2 * numpy.pi * e * s], axis=-1),
                          numpy.stack([rate ** 2 / (2 * numpy.pi) * e * s, rate * e * c], axis=-1)], axis=-2)
    return velocity, slopes


def navier_stokes(n):
    """Newton's matrix at Kovasznay's flow of Re = 40, Taylor–Hood: (w . grad) u + (u . grad) w."""
    mesh = box_mesh((n, n), 5, [1.5, 2.0], [-0.5, -0.5])
    u, p = mesh.quadratic(), mesh.linear()
    wind, slopes = kovasznay(mesh.at_points(), 40.0)
    A = u.stiffness(1 / 40) + u.convection(wind)
    blocks = [[u.mass(slopes[..., i, j]) + (A if i == j else 0 * A) for j in range(2)] for i in range(2)]
    system = saddle(sparse.bmat(blocks, format="csr"), fem.divergence(u, p), None, components=2, schur=p.mass(40.0))
    given = fem.on_boundary(u.places, ["0-", "1-", "1+"])
    values = kovasznay(u.places[given], 40.0)[0].T.ravel()
    return prescribe(system, velocity_dofs(u, given), values, "rows")


def recirculation(places):
    x, y = places[..., 0], places[..., 1]
    return numpy.stack([2 * y * (1 - x ** 2), -2 * x * (1 - y ** 2)], axis=-1)


def oseen_p1p1(n, reynolds=5000.0):
    """A recirculating wind (Elman, Silvester and Wathen, example 8.1.3) at Re = 5000; SUPG/PSPG, P1–P1."""
    mesh = box_mesh((n, n), 4, [2.0, 2.0], [-1.0, -1.0])
    u = mesh.linear()
    wind, viscosity = recirculation(mesh.at_points()), 1 / reynolds
    h = mesh.size * numpy.sqrt(2)
    speed = numpy.linalg.norm(wind, axis=-1)
    tau = 1 / numpy.sqrt((2 * speed / h) ** 2 + (12 * viscosity / h ** 2) ** 2)
    slope = numpy.einsum("qmd,qmjd->qmj", wind, u.dphi)
    upwind = u.matrix(numpy.einsum("qm,qmi,qmj->mij", mesh.weights * tau, slope, slope))
    A = u.stiffness(viscosity) + u.convection(wind) + upwind
    along = [u.matrix(numpy.einsum("qm,qmi,qmj->mij", mesh.weights * tau, slope, u.dphi[..., k])) for k in range(2)]
    B = fem.divergence(u, u)
    B1T = B.T + sparse.vstack(along)
    B2 = B - sparse.hstack([matrix.T for matrix in along])
    K = sparse.bmat([[fem.repeated(A, 2), B1T], [B2, -u.stiffness(tau)]], format="csr")
    system = System(K, numpy.zeros(3 * u.n), {"velocity": numpy.arange(2 * u.n), "pressure": numpy.arange(2 * u.n, 3 * u.n)},
                    2, constants=("pressure",), schur=u.mass(reynolds) + u.stiffness(tau))
    return cavity(system, u, "eliminated")


def oseen_q1q1(n):
    """The same wind at Re = 200 without upwinding, Q1–Q1."""
    mesh = fem.Boxes((n, n), (2.0, 2.0), (-1.0, -1.0))
    u, viscosity = mesh.linear(), 1 / 200
    A = u.stiffness(viscosity) + u.convection(recirculation(mesh.at_points()))
    system = saddle(fem.repeated(A, 2), fem.divergence(u, u), projected_mass(u) / viscosity, components=2,
                    constants=("pressure",), schur=u.mass(1 / viscosity))
    return by_node(cavity(system, u, "eliminated"), u.n, "last")


def rotating(n):
    """2 omega x u beside a small viscosity (Ekman number 1e-3) and a time derivative, P1–P1 in a box."""
    mesh = box_mesh((n, n, n), 2)
    u, viscosity = mesh.linear(), 1e-3
    mass, A = u.mass(), u.stiffness(viscosity) + u.mass(0.1)
    blocks = sparse.bmat([[A, -2 * mass, None], [2 * mass, A, None], [None, None, A]], format="csr")
    C = u.stiffness(mesh.size ** 2 / (12 * viscosity + 2 * mesh.size ** 2))
    system = saddle(blocks, fem.divergence(u, u), C, components=3, constants=("pressure",),
                    schur=u.mass(1 / viscosity) + C)
    return by_node(cavity(system, u, "eliminated"), u.n, "last")


def unsteady(n):
    """A short time step: dt nu / h² about 1e-2; Q1–Q1 in space."""
    mesh = fem.Boxes((n, n, n), (1.0, 1.0, 1.0))
    u, step = mesh.linear(), 1e-2 * mesh.size[0] ** 2
    A = fem.repeated(u.mass(1 / step) + u.stiffness(), 3)
    system = saddle(A, fem.divergence(u, u), projected_mass(u), components=3, constants=("pressure",), is_symmetric=True)
    return by_node(cavity(system, u, "eliminated"), u.n, "last")


def checkers(places, count, low, high):
    """Values between low and high that change from square to square, the same on every mesh."""
    k = numpy.floor(places * count - 1e-9).astype(int)
    number = numpy.abs(numpy.sin(12.9898 * k[:, 0] + 78.233 * k[:, 1] + (37.719 * k[:, 2] if k.shape[1] > 2 else 0)) * 437.5)
    return low * (high / low) ** (number - numpy.floor(number))


def brinkman(n):
    """Free flow through obstacles of permeabilities down to 1e-6, Taylor–Hood."""
    mesh = box_mesh((n, n), 4)
    u, p = mesh.quadratic(), mesh.linear()
    drag = 1 / checkers(mesh.points[mesh.cells].mean(axis=1), 8, 1e-6, 1.0)
    A = fem.repeated(u.stiffness() + u.mass(drag), 2)
    system = saddle(A, fem.divergence(u, p), components=2, is_symmetric=True, schur=p.mass())
    return by_node(channel(system, u, "eliminated"), u.n, "behind")


def darcy(mesh, permeability):
    """Raviart and Thomas's fluxes through facets, pressures in cells; given pressures left and right, no flux elsewhere."""
    d, (facets, numbers, signs) = mesh.d, mesh.facets()
    away = mesh.at_points()[:, :, None, :] - mesh.points[mesh.cells][None]
    local = numpy.einsum("qm,qmid,qmjd->mij", mesh.weights / permeability, away, away, optimize=True)
    local *= signs[:, :, None] * signs[:, None, :] / (d * mesh.volumes[:, None, None]) ** 2
    i, j = (numpy.broadcast_to(part, local.shape).ravel() for part in (numbers[:, :, None], numbers[:, None, :]))
    n, m = len(facets), len(mesh.cells)
    A = sparse.csr_matrix((local.ravel(), (i, j)), shape=(n, n))
    cells = numpy.repeat(numpy.arange(m), d + 1)
    B = sparse.csr_matrix((-signs.ravel(), (cells, numbers.ravel())), shape=(m, n))
    middles = mesh.points[facets].mean(axis=1)
    is_outer = numpy.bincount(numbers.ravel(), minlength=n) == 1
    is_open = is_outer & fem.on_boundary(middles, ["0-", "0+"])
    out_of = numpy.zeros(n)
    numpy.add.at(out_of, numbers.ravel(), signs.ravel())
    f = numpy.where(is_outer & fem.on_boundary(middles, ["0-"]), -out_of, 0.0)
    system = saddle(A, B, None, f, fields=("flux", "pressure"), is_symmetric=True)
    return prescribe(system, numpy.flatnonzero(is_outer & ~is_open), 0.0, "eliminated")


def darcy_plane(n):
    mesh = box_mesh((n, n), 2)
    return darcy(mesh, checkers(mesh.points[mesh.cells].mean(axis=1), 16, 1e-4, 1.0))


def darcy_space(n):
    mesh = box_mesh((n, n, n), 2)
    return darcy(mesh, checkers(mesh.points[mesh.cells].mean(axis=1), 4, 1e-2, 1.0))
