"""What the tests of tunica-lumen share: its runs, the surfaces, and what every mesh is held to."""
import json
import os
import re
import subprocess
import sys
import unittest

PROGRAM, PROGRAMS, SCRATCH = sys.argv[1:4]
TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DRIVERS = os.path.dirname(os.path.realpath(PROGRAM))
sys.path += [TESTS, os.path.join(TESTS, "..", "xml"), DRIVERS]
from forked import Program  # noqa: E402
from pages import ENVIRONMENT  # noqa: E402
from scratch import fresh  # noqa: E402

IN_FORKS = Program(PROGRAM, "lumen.make", "h5py")


def tunica(program, *words):
    """A finished run of one of the other programs."""
    return subprocess.run([os.path.join(PROGRAMS, program), *map(str, words)], capture_output=True, text=True,
                          env=ENVIRONMENT)


class LumenTest(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.join(SCRATCH, self.id().split(".")[-1])
        os.makedirs(self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def run_lumen(self, *words):
        return IN_FORKS.run(words, cwd=self.folder)

    def meshed(self, surface, *words, openings, out="out.h5", core=10.0):
        """What stands beside the mesh, which has been checked: whole, of the surface's volume, near to it."""
        done = self.run_lumen(surface, self.path(out), *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.said, self.complained = done.stdout, done.stderr
        info = tunica("tunica-mesh", "info", self.path(out))
        self.assertEqual((info.returncode, info.stderr), (0, ""), info.stderr)
        self.assertIn("connected pieces: 1;", info.stdout)
        beside = self.beside(out, openings)
        self.assertIn(f'{beside["tetrahedra"]} tetrahedra', info.stdout.replace(",", ""))
        self.assertGreater(os.path.getsize(self.path(os.path.splitext(out)[0] + ".png")), 10000)
        self.assertGreaterEqual(self.number(r"([\d.]+) in the core\n"), core, done.stdout)
        self.assertLess(abs(self.number(r"mm³, ([-+][\d.]+) %")), 1.0, done.stdout)
        self.assertLess(self.number(r"in the mean \(([\d.]+) voxels"), 0.25, done.stdout)
        return beside

    def number(self, pattern):
        return float(re.search(pattern, self.said)[1])

    def beside(self, out, openings):
        with open(self.path(os.path.splitext(out)[0] + ".json"), encoding="utf-8") as file:
            beside = json.load(file)
        self.assertEqual(sorted(beside), ["branches", "openings", "tetrahedra", "vertices", "volume", "warnings"])
        names = [opening["name"] for opening in beside["openings"]]
        self.assertEqual(len(names), openings)
        ends = [b[key] for b in beside["branches"] for key in ("start", "end")]
        self.assertEqual(sorted(e for e in ends if not e.startswith("junction-")), sorted(names if openings > 1 else []))
        for branch in beside["branches"]:
            self.assertEqual(len(branch["points"]), len(branch["radii"]))
        return beside

    def expect_wall(self, out="out.h5"):
        """A wall grows on it."""
        grown = tunica("tunica-mesh", "wall", self.path(out), self.path("wall.h5"), "--surfaces", "lumen_wall", "--layers",
                       "media=0.66:1,adventitia=0.34:1", "--thickness-fraction", "0.15")
        self.assertEqual((grown.returncode, grown.stderr), (0, ""), grown.stderr)

    def expect_error(self, *words, parts, out="out.h5", picture=False):
        """One line that holds the parts, status 1, no mesh; a picture of the place where there is one."""
        done = self.run_lumen(*words, self.path(out))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        stem = os.path.splitext(out)[0]
        self.assertFalse(os.path.exists(self.path(out)) or os.path.exists(self.path(stem + ".json")))
        self.assertEqual(os.path.exists(self.path(stem + ".png")), picture)
        if picture:
            os.remove(self.path(stem + ".png"))


def run():
    fresh(SCRATCH)
    unittest.main(module="__main__", argv=sys.argv[:1])
