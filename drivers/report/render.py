"""Pictures of scenes: by VTK where it and a display are there, else by Matplotlib, which draws the triangles
from the farthest to the nearest one."""
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager

import numpy as np
from matplotlib import image
from matplotlib.collections import PolyCollection

PIXELS = 1500  # of the longer side
PATIENCE = 600  # seconds for all pictures


@contextmanager
def display():
    """Environment with a display of its own, where Xvfb is there."""
    server = shutil.which("Xvfb")
    if server is None:
        yield dict(os.environ)
        return
    # Between two windows nobody is connected: without -noreset the server begins anew and may refuse the second.
    with subprocess.Popen([server, "-displayfd", "1", "-screen", "0", "640x480x24", "-nolisten", "tcp", "-noreset"],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        try:
            is_ready, _, _ = select.select([process.stdout], [], [], 20)
            number = process.stdout.readline().decode().strip() if is_ready else ""
            yield dict(os.environ, DISPLAY=f":{number}") if number else dict(os.environ)
        finally:
            process.terminate()


def by_vtk(scenes, sights):
    """Pixels for each (scene's name, view's number) of sights, name -> scene; or None with the reason."""
    with tempfile.TemporaryDirectory() as folder:
        jobs = []
        for name, scene in scenes.items():
            arrays = {f"{what}{k}": getattr(piece, what) for k, piece in enumerate(scene.pieces)
                      for what in ("points", "triangles", "colours")}
            np.savez(os.path.join(folder, f"{name}.npz"), count=len(scene.pieces), begins=scene.arrows[0],
                     vectors=scene.arrows[1], **arrays)
        for (name, number), (view, box) in sights.items():
            scale = PIXELS / max(box[1] - box[0], box[3] - box[2])
            jobs.append({"scene": f"{name}.npz", "picture": f"{name}-{number}.png", "axes": view.axes.tolist(),
                         "box": [float(b) for b in box], "width": int(scale * (box[1] - box[0])),
                         "height": int(scale * (box[3] - box[2]))})
        with open(os.path.join(folder, "jobs.json"), "w", encoding="utf-8") as file:
            json.dump(jobs, file)
        reason = _run(folder)
        if reason:
            return None, reason
        return {sight: image.imread(os.path.join(folder, f"{sight[0]}-{sight[1]}.png")) for sight in sights}, ""


def _run(folder):
    """Draws the jobs of that folder; what went wrong."""
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "vtk_pictures.py")
    with display() as environment:
        if "DISPLAY" not in environment:
            return "there is no display and no Xvfb"
        try:
            done = subprocess.run([sys.executable, script, folder], env=environment, capture_output=True,
                                  timeout=PATIENCE, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            return str(error)
    if b"ModuleNotFoundError" in done.stderr:
        return "Python's VTK is not installed"
    return f"VTK failed with {done.returncode}" if done.returncode else ""


def _quartered(corners):
    """Each triangle as four; corners: (triangle, corner, value)."""
    a, b, c = (corners[:, k] for k in range(3))
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = [np.stack(part, axis=1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return np.concatenate(parts)


def by_matplotlib(axes, scene, view):
    """Triangles lit from the eye, each of small parts with one colour."""
    seen, colours = [], []
    total = sum(len(piece.triangles) for piece in scene.pieces)
    for piece in scene.pieces:
        corners, values = (piece.points @ view.axes.T)[piece.triangles], piece.colours[piece.triangles]
        for _ in range(2 if total < 4000 else 1 if total < 16000 else 0):
            corners, values = _quartered(corners), _quartered(values)
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        light = 0.45 + 0.55 * abs(normal[:, 2]) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
        seen.append(corners)
        colours.append(light[:, None] * values.mean(axis=1))
    seen, colours = np.concatenate(seen), np.clip(np.concatenate(colours), 0, 1)
    order = np.argsort(seen[:, :, 2].mean(axis=1))
    axes.add_collection(PolyCollection(seen[order][:, :, :2], facecolors=colours[order], edgecolors=colours[order],
                                       linewidths=0.3, rasterized=True))
    begins, vectors = (a @ view.axes.T for a in scene.arrows)
    if len(begins):
        axes.quiver(begins[:, 0], begins[:, 1], vectors[:, 0], vectors[:, 1], angles="xy", scale_units="xy", scale=1,
                    width=0.0016, headwidth=5, headlength=6, color="#1f1f1f", zorder=3)
