"""The stress in each layer of the wall: what nearly all of it bears, the greatest one and where, the estimated error."""
import numpy as np

from report.run_data import region_names, spread
from report.tables import Table

QUANTITIES = (("largest_principal_stress", "largest principal stress"), ("von_mises", "von Mises stress"),
              ("fibre_stress", "stress along the fibres"))
MOST_OUTPUTS = 20
HEADING = ["layer", "quantity [kPa]", "99 % quantile", "greatest", "at x, y, z [mm]", "in elements", "time [ms]"]


def tet_volumes(points, tets):
    x = points[tets]
    return abs(np.einsum("ij,ij->i", x[:, 1] - x[:, 0], np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 0]))) / 6.0


def quantile(values, weights, part):
    """The least value that this part of the weight does not exceed."""
    order = np.argsort(values)
    share = np.cumsum(weights[order]) / weights.sum()
    return float(values[order][min(np.searchsorted(share, part), len(order) - 1)])


def squares(tensors, tets):
    """Means over the elements of σ : σ, σ linear between the points; components as in fields.h5."""
    twice = np.array([1.0, 2.0, 2.0, 1.0, 2.0, 1.0])
    at = tensors[tets]
    return (np.einsum("eak,k,eak->e", at, twice, at) + np.einsum("ek,k,ek->e", at.sum(1), twice, at.sum(1))) / 20.0


class Layers:
    """The wall's mesh as in fields.h5 by its regions."""

    def __init__(self, run):
        wall = run.fields["wall"]
        self.run, self.points, self.tets = run, wall["points"][:], wall["tets"][:]
        self.volume = tet_volumes(self.points, self.tets)
        region = wall["region"][:] if "region" in wall else np.zeros(len(self.tets), int)
        names = region_names(run.fields, "wall")
        self.of = {names[r] if r < len(names) else "wall": np.flatnonzero(region == r) for r in np.unique(region)}

    def peak(self, cells, name, group):
        """Quantile, greatest value, its place and the greatest value of elements; None without the array."""
        values, of_elements = self.run.recovered(group, name), self.run.of_elements(group, "wall", name)
        if values is None:
            return None
        nodes, index = np.unique(self.tets[cells], return_inverse=True)
        weights = np.bincount(index.ravel(), np.repeat(self.volume[cells], 4))
        most = nodes[np.argmax(values[nodes])]
        in_cells = float("nan") if of_elements is None else float(of_elements.reshape(-1)[cells].max())
        return quantile(values[nodes], weights, 0.99), float(values[most]), self.points[most], in_cells

    def error(self, cells, group):
        """Of the elements' stress in parts of the stress, both as root mean squares."""
        error, stress = (self.run.field(group, "wall", n) for n in ("stress_error", "recovered_stress"))
        if error is None or stress is None:
            return float("nan")
        v = self.volume[cells]
        size = (v * squares(stress, self.tets[cells])).sum()
        return float(np.sqrt((v * error.reshape(-1)[cells] ** 2).sum() / size)) if size > 0 else float("nan")


def of_beat(run, outputs, begin, branch_at):
    """The same of the outputs of a beat, with the branch of each place and times from its begin; None without stress at the
    vertices."""
    peaks, errors = tables(run, outputs)
    if not peaks:
        return None
    note = ("At the vertices, each layer for itself, at the output in which the quantile is greatest."
            + " Estimated error: " * bool(errors) + ", ".join(f"{layer} {error}" for layer, error in errors) + "." * bool(errors))
    rows = [[*row[:5], branch_at(np.array(row[4].split(", "), dtype=float)), row[5], row[6] - begin]
            for row in peaks]
    return Table("Stress in the wall", note, [*HEADING[:5], "branch", HEADING[5], "at, ms"], rows)


def tables(run, outputs):
    """Rows of HEADING, each of the output in which the quantile is greatest; rows of layer and estimated error; empty
    where the run has no stress at the vertices."""
    if run.fields is None or "wall" not in run.grids():
        return [], []
    layers, peaks, errors = Layers(run), [], []
    outputs = spread(outputs, MOST_OUTPUTS) if outputs else []
    for layer, cells in layers.of.items():
        for name, words in QUANTITIES:
            found = [(layers.peak(cells, name, group), time) for time, group in outputs]
            found = [(peak, time) for peak, time in found if peak is not None]
            if not found:
                continue
            (of_most, greatest, place, in_cells), time = max(found, key=lambda item: item[0][0])
            peaks.append([layer, words, of_most, greatest, ", ".join(f"{x:.3g}" for x in place.round(3) + 0.0), in_cells, float(time)])
        error = [layers.error(cells, group) for _, group in outputs]
        if np.isfinite(error).any():
            errors.append([layer, f"{100 * error[-1]:.1f} %"])
    return peaks, errors
