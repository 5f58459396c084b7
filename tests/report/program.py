"""tunica-report as its tests start it: SCRIPT PROGRAM SCRATCH_FOLDER"""
import os
import subprocess
import sys

PROGRAM = sys.argv[1]
sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from forked import Program  # noqa: E402

IN_FORKS = Program(PROGRAM)
from report import canvas, render  # noqa: E402


def draw_small():
    """Pictures in space take a ninth of the time."""
    render.PIXELS, canvas.DPI = 500, 100


def without_display():
    return {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "MPLBACKEND")}


def report(*words):
    """With small figures; tests/house/tutorial.py and tests/package/installed_programs.py have them in their size."""
    return IN_FORKS.run(words, env=without_display(), prepare=draw_small)


def started(*words, **variables):
    """As users start it."""
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, env={**without_display(), **variables})
