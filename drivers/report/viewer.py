"""A page of its own with the surfaces of the vessel to be turned and in motion, without network: viewer.html, filled with
data. Of a vessel with a beat it shows the last one. Large surfaces are thinned so that the page keeps below a size."""
import base64
import html
import json
import os

import numpy as np
from matplotlib import pyplot as plt

from report.canvas import colour_scale
from report.page import title_of
from report.run_data import spread
from report.section import norm_of
from report.space import views
from report.space_figures import MOST_FURTHER, STRESSES, magnitude, words
from report.surfaces import normals_of, weighted_centre

MOST_OUTPUTS = 21  # a beat of tunica-vessel, both ends of it
MOST_NUMBERS = 8_000_000  # of 16 bits: 21 MB of text


def _packed(values):
    """16 bits a number, between the least and the greatest one."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    scaled = 65535 * (np.nan_to_num(values, nan=low) - low) / (high - low or 1.0)
    return {"low": low, "high": high, "data": _text(np.round(scaled).astype("<u2"))}


def _text(array):
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def _fields(run, grid):
    """(name, label) of what colours that grid's surface."""
    if grid == "wall":
        return [("displacement", "displacement [mm]")] + [(name, label) for name, _, label in STRESSES]
    return [("pressure", "pressure [kPa]"), ("displacement", "displacement [mm]")] + [
        (name, words(name)) for name in run.further_arrays("fluid")[:MOST_FURTHER]]


def _surface(run, title, grid, part, outputs):
    moves = [run.displacement(group, grid)[part.nodes] for _, group in outputs]
    fields = []
    for name, label in _fields(run, grid):
        values = [run.nodal(group, grid, name) for _, group in outputs]
        if all(v is None for v in values):
            continue
        values = [None if v is None else magnitude(v)[part.nodes] for v in values]
        norm = colour_scale(np.concatenate([v for v in values if v is not None]))
        fields.append({"label": label, "low": float(norm.vmin), "high": float(norm.vmax),
                       "values": [None if v is None else _packed(v) for v in values]})
    return {"name": title, "points": _packed(part.points), "triangles": _text(part.triangles.astype("<u4")),
            "moves": [_packed(m) for m in moves], "fields": fields}


class Thinned:
    """A surface with fewer points: of those in a cube of space that look the same way the one nearest to their middle. Opposite
    sides of a thin wall remain apart."""

    def __init__(self, part, most):
        edge = part.points[part.triangles[:, 0]] - part.points[part.triangles[:, 1]]
        size, kept, which = 0.5 * norm_of(edge).mean(), np.arange(len(part.nodes)), np.arange(len(part.nodes))
        looks = (normals_of(part.points, part.triangles) > 0) @ (1, 2, 4)
        while len(kept) > most:
            size *= 1.2
            cube = np.column_stack([np.floor((part.points - part.points.min(axis=0)) / size).astype(int), looks])
            _, which, count = np.unique(cube, axis=0, return_inverse=True, return_counts=True)
            which = which.reshape(-1)
            middle = np.stack([np.bincount(which, part.points[:, k]) for k in range(3)], axis=1) / count[:, None]
            order = np.lexsort([norm_of(part.points - middle[which]), which])
            kept = order[np.concatenate([[0], np.cumsum(count)[:-1]])]
        triangles = which[part.triangles]
        is_flat = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
        _, first = np.unique(np.sort(triangles[~is_flat], axis=1), axis=0, return_index=True)
        self.nodes, self.points, self.triangles = part.nodes[kept], part.points[kept], triangles[~is_flat][np.sort(first)]


def _chosen(run, clinic):
    """Outputs, about 20: of the last beat where there is one."""
    begin = clinic.beat.start * (1 - 1e-9) if clinic else -np.inf
    found = [o for o in run.outputs if o[0] >= begin]
    return spread(found if len(found) > 2 else run.outputs, MOST_OUTPUTS)


def _fitting(run, surfaces, count):
    """The surfaces, thinned where so many outputs of them would be too many numbers."""
    numbers = [len(part.nodes) * (3 + len(_fields(run, grid))) * count for _, grid, part in surfaces]
    share = MOST_NUMBERS / max(sum(numbers), 1)
    if share >= 1:
        return surfaces
    return [(title, grid, Thinned(part, int(share * len(part.nodes)))) for title, grid, part in surfaces]


def _labels(clinic):
    """Name and place of each opening."""
    ends = clinic.parts.ends if clinic and clinic.parts else {}
    return [{"name": name, "place": weighted_centre(end.points, end.triangles)[0].tolist()} for name, end in ends.items()]


def _ramp():
    return _text((255 * plt.get_cmap("turbo")(np.linspace(0, 1, 256))[:, :3]).astype(np.uint8))


def write(run, clinic, parts, folder, look):
    """Returns the name of the page; None where there is no surface. look: magnification and plane."""
    factor, plane = look
    surfaces = [(title, grid, part) for title, grid, part in (
        ("wall", "wall", parts.wall), ("lumen", "fluid", parts.lumen)) if part is not None]
    if not surfaces:
        return None
    outputs = _chosen(run, clinic)
    surfaces = _fitting(run, surfaces, len(outputs))
    everything = np.concatenate([part.points for _, _, part in surfaces])
    axes = views(plane)[0].axes
    low, high = (everything @ axes.T).min(axis=0), (everything @ axes.T).max(axis=0)
    sizes = [norm_of(run.displacement(group, surfaces[0][1])).max() for _, group in outputs]
    begin = clinic.beat.start if clinic else 0.0
    data = {"times": [float(f"{t - begin:.6g}") for t, _ in outputs], "is_beat": clinic is not None, "labels": _labels(clinic),
            "first": int(np.argmax(sizes)), "factor": factor,
            "centre": ((low + high) / 2 @ axes).tolist(), "turn": axes.T.reshape(-1).tolist(), "normal": axes[2].tolist(),
            "size": float((high - low)[1:].max()), "length": float((high - low)[0] / (high - low)[1:].max()),
            "depth": float((high - low)[2] / 2), "ramp": _ramp(),
            "surfaces": [_surface(run, title, grid, part, outputs) for title, grid, part in surfaces]}
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "viewer.html"), encoding="utf-8") as file:
        text = file.read()
    title = html.escape(title_of(run))
    with open(os.path.join(folder, "vessel.html"), "w", encoding="utf-8") as file:
        file.write(text.replace("@TITLE@", title).replace("@DATA@", json.dumps(data).replace("</", "<\\/")))
    return "vessel.html"
