"""A page of its own with the surfaces of the vessel to be turned, without network: viewer.html, filled with data."""
import base64
import html
import json
import os

import numpy as np
from matplotlib import pyplot as plt

from report.canvas import colour_scale
from report.run_data import spread
from report.section import norm_of
from report.space import views
from report.space_figures import MOST_FURTHER, STRESSES, magnitude, words

MOST_OUTPUTS = 20
MOST_NUMBERS = 15_000_000  # of 16 bits: 40 MB of text


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


def _chosen(run, surfaces):
    """Outputs: about 20, fewer of large meshes."""
    size = sum(3 * len(part.nodes) + 4 * len(part.nodes) for _, _, part in surfaces)
    count = int(np.clip(MOST_NUMBERS // max(size, 1), 2, MOST_OUTPUTS))
    return spread(run.outputs, count)


def _ramp():
    return _text((255 * plt.get_cmap("turbo")(np.linspace(0, 1, 256))[:, :3]).astype(np.uint8))


def write(run, parts, folder, factor, plane):
    """Returns the name of the page; None where there is no surface."""
    surfaces = [(title, grid, part) for title, grid, part in (
        ("wall", "wall", parts.wall), ("lumen", "fluid", parts.lumen)) if part is not None]
    if not surfaces:
        return None
    outputs = _chosen(run, surfaces)
    everything = np.concatenate([part.points for _, _, part in surfaces])
    axes = views(plane)[0].axes
    low, high = (everything @ axes.T).min(axis=0), (everything @ axes.T).max(axis=0)
    sizes = [norm_of(run.displacement(group, surfaces[0][1])).max() for _, group in outputs]
    data = {"times": [float(f"{t:.6g}") for t, _ in outputs], "first": int(np.argmax(sizes)), "factor": factor,
            "centre": ((low + high) / 2 @ axes).tolist(), "turn": axes.T.reshape(-1).tolist(), "normal": axes[2].tolist(),
            "size": float((high - low)[1:].max()), "length": float((high - low)[0] / (high - low)[1:].max()),
            "depth": float((high - low)[2] / 2), "ramp": _ramp(),
            "surfaces": [_surface(run, title, grid, part, outputs) for title, grid, part in surfaces]}
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "viewer.html"), encoding="utf-8") as file:
        text = file.read()
    title = html.escape(os.path.basename(os.path.abspath(run.folder)))
    with open(os.path.join(folder, "vessel.html"), "w", encoding="utf-8") as file:
        file.write(text.replace("@TITLE@", title).replace("@DATA@", json.dumps(data).replace("</", "<\\/")))
    return "vessel.html"
