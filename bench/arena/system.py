"""A linear system K x = b of the arena: what is known of it, its checksum, its files."""
import dataclasses
import hashlib
import json
import pathlib

import numpy
import scipy.sparse as sparse

ROUNDING = 1e-13


@dataclasses.dataclass
class System:
    K: sparse.csr_matrix
    b: numpy.ndarray
    fields: dict  # name -> numbers of its unknowns; the first holds vectors, the second multipliers
    components: int = 1  # of a vector
    is_by_node: bool = False  # numbers of the vectors: components side by side, not one after the other
    constants: tuple = ()  # fields that K determines but for a constant
    places: numpy.ndarray = None  # of the nodes of a solid in space, in the order of their numbers
    rigid: numpy.ndarray = None  # near-null space of the first field, in the order of its numbers
    schur: sparse.csr_matrix = None  # approximation of the Schur complement that textbooks give, positive
    is_symmetric: bool = False

    def __post_init__(self):
        self.K = without_rounding(self.K, self.fields)
        for name in self.constants:
            part = self.b[self.fields[name]]
            self.b[self.fields[name]] = part - part.mean()

    @property
    def n(self):
        return self.K.shape[0]


def without_rounding(K, fields):
    """Without entries below the rounding of the largest in their row or in their column of their block; else the pattern would
    depend on the machine, and rows of B that add up to nothing would hold noise."""
    K = sparse.coo_matrix(sparse.csr_matrix(K))
    n, of = K.shape[0], numpy.zeros(K.shape[0], int)
    for number, rows in enumerate(fields.values()):
        of[rows] = number
    size = numpy.abs(K.data)
    row, column = (numpy.zeros(n * len(fields)) for _ in range(2))
    at, along = K.row * len(fields) + of[K.col], K.col * len(fields) + of[K.row]
    numpy.maximum.at(row, at, size)
    numpy.maximum.at(column, along, size)
    least, most = numpy.minimum(row[at], column[along]), numpy.maximum(row[at], column[along])
    is_kept = size > ROUNDING * numpy.maximum(least, most / 10)
    kept = sparse.csr_matrix((K.data[is_kept], (K.row[is_kept], K.col[is_kept])), shape=K.shape)
    kept.sort_indices()
    return kept


def saddle(A, B, C=None, f=None, **known):
    """[A B'; B -C] in the order of the blocks; f: the right-hand side of the first."""
    n, m = A.shape[0], B.shape[0]
    K = sparse.bmat([[A, B.T], [B, None if C is None else -C]], format="csr")
    b = numpy.concatenate([numpy.zeros(n) if f is None else f, numpy.zeros(m)])
    fields = known.pop("fields", ("velocity", "pressure"))
    return System(K, b, {fields[0]: numpy.arange(n), fields[1]: numpy.arange(n, n + m)}, **known)


def prescribe(system, unknowns, values, how="eliminated"):
    """Unknowns with given values: "eliminated" from their columns, or unit "rows" whose columns stay."""
    K, b = system.K, system.b
    is_given = numpy.zeros(system.n, bool)
    is_given[unknowns] = True
    x = numpy.zeros(system.n)
    x[unknowns] = values
    free = sparse.diags((~is_given).astype(float))
    if how == "eliminated":
        b = b - K @ x
        K = K @ free
    K = free @ K + sparse.diags(is_given.astype(float))
    return dataclasses.replace(system, K=K, b=numpy.where(is_given, x, b), is_symmetric=system.is_symmetric and how != "rows")


def reordered(system, order):
    """Unknown k of the result is unknown order[k]."""
    new = numpy.empty(system.n, int)
    new[order] = numpy.arange(system.n)
    fields, rigid, schur = {}, system.rigid, system.schur
    for place, (name, old) in enumerate(system.fields.items()):
        along = numpy.argsort(new[old])
        fields[name] = new[old[along]]
        if place == 0 and rigid is not None:
            rigid = rigid[along]
        if place == 1 and schur is not None:
            schur = sparse.csr_matrix(schur)[along][:, along]
    return dataclasses.replace(system, K=system.K[order][:, order], b=system.b[order], fields=fields, rigid=rigid, schur=schur)


def by_node(system, n_nodes, place="last"):
    """Vectors component after component, then as many scalars as nodes: the unknowns of a node side by side, its scalar
    first or last; vectors alone where there are fewer scalars ("behind")."""
    d = system.components
    vectors = numpy.arange(d * n_nodes).reshape(d, n_nodes).T
    scalars = numpy.arange(d * n_nodes, system.n)
    system = dataclasses.replace(system, is_by_node=True)
    if place == "behind":
        return reordered(system, numpy.concatenate([vectors.ravel(), scalars]))
    parts = [scalars[:, None], vectors] if place == "first" else [vectors, scalars[:, None]]
    return reordered(system, numpy.hstack(parts).ravel())


def checksum(system):
    """What is compared between machines: the pattern exactly, sums of values up to rounding."""
    pattern = hashlib.sha256()
    pattern.update(numpy.asarray(system.K.indptr, "<i8").tobytes())
    pattern.update(numpy.asarray(system.K.indices, "<i8").tobytes())
    k = numpy.arange(1, system.n + 1)
    v, w = numpy.sin(k), numpy.cos(0.7 * k)
    return {"unknowns": system.n, "entries": system.K.nnz, "pattern": pattern.hexdigest()[:12],
            "values": float(v @ (system.K @ w)), "size": float(numpy.linalg.norm(system.K.data)),
            "rhs": float(v @ system.b), "rhs size": float(numpy.linalg.norm(system.b))}


def agree(one, other, rounding=1e-9):
    """Whether two checksums are those of the same system."""
    if any(str(one[key]) != str(other[key]) for key in ("unknowns", "entries", "pattern")):
        return False
    return all(abs(float(one[key]) - float(other[key])) <= rounding * float(one[size]) for key, size in
               (("values", "size"), ("size", "size"), ("rhs", "rhs size"), ("rhs size", "rhs size")))


def residuals(K, b, x, fields):
    """Relative residual of the whole, |b - Kx| / |b|, and of each field relative to what its rows add up, the norm of
    |K||x| + |b| in them."""
    r = b - K @ x
    added = abs(K) @ numpy.abs(x) + numpy.abs(b)
    norm = numpy.linalg.norm
    parts = {name: float(norm(r[rows]) / max(norm(added[rows]), 1e-300)) for name, rows in fields.items()}
    return float(norm(r) / norm(b)), parts, float(norm(r) / norm(added))


def is_solved(K, b, x, fields, tolerance=1e-8):
    """By the rule of docs/choosing.md: every field, and the whole by |b - Kx| / |b|, or as nearly as rounding permits."""
    if not numpy.all(numpy.isfinite(x)):
        return False
    whole, parts, backward = residuals(K, b, x, fields)
    return max(parts.values()) <= tolerance and (whole <= tolerance or backward <= 1e-13)


def write_array(path, values):
    """A dense matrix, column after column."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("%%MatrixMarket matrix array real general\n{} {}\n".format(*values.shape))
        file.write("".join(map("%.17g\n".__mod__, values.T.ravel().tolist())))


def write(system, folder):
    """K.mtx and b.mtx, as a first-time user has them, and coordinates.mtx of a solid in space; known.npz with all that is
    known, for peers and for the judge."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    K = system.K.tocoo()
    with open(folder / "K.mtx", "w", encoding="utf-8") as file:
        file.write(f"%%MatrixMarket matrix coordinate real general\n{system.n} {system.n} {K.nnz}\n")
        for begin in range(0, K.nnz, 200000):
            some = slice(begin, begin + 200000)
            file.write("".join(map("%d %d %.17g\n".__mod__, zip(
                (K.row[some] + 1).tolist(), (K.col[some] + 1).tolist(), K.data[some].tolist()))))
    write_array(folder / "b.mtx", system.b[:, None])
    if system.places is not None:
        write_array(folder / "coordinates.mtx", system.places)
    arrays = {"data": system.K.data, "indices": system.K.indices, "indptr": system.K.indptr, "b": system.b,
              "rigid": numpy.zeros((0, 0)) if system.rigid is None else system.rigid}
    if system.schur is not None:
        schur = sparse.csr_matrix(system.schur)
        arrays.update(schur_data=schur.data, schur_indices=schur.indices, schur_indptr=schur.indptr)
    for name, rows in system.fields.items():
        arrays["field_" + name] = rows
    numpy.savez(folder / "known.npz", **arrays)
    with open(folder / "known.json", "w", encoding="utf-8") as file:
        json.dump({"fields": list(system.fields), "components": system.components,
                   "is_by_node": system.is_by_node, "constants": list(system.constants),
                   "is_symmetric": system.is_symmetric}, file, indent=1)


def read(folder):
    folder = pathlib.Path(folder)
    with open(folder / "known.json", encoding="utf-8") as file:
        known = json.load(file)
    with numpy.load(folder / "known.npz") as arrays:
        K = sparse.csr_matrix((arrays["data"], arrays["indices"], arrays["indptr"]))
        schur = None
        if "schur_data" in arrays:
            schur = sparse.csr_matrix((arrays["schur_data"], arrays["schur_indices"], arrays["schur_indptr"]))
        fields = {name: arrays["field_" + name] for name in known["fields"]}
        rigid = arrays["rigid"] if arrays["rigid"].size else None
        return System(K, arrays["b"], fields, known["components"], known["is_by_node"], tuple(known["constants"]),
                      rigid=rigid, schur=schur, is_symmetric=known["is_symmetric"])


def read_vector(path):
    """Of a Matrix Market file with one column."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("%")]
    return numpy.array(lines[1:], dtype=float)
