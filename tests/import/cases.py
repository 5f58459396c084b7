"""What the tests of tunica-import share: its runs, and a folder for each test."""
import os
import subprocess
import sys
import unittest

import samples

PROGRAM, PROGRAMS, SCRATCH = sys.argv[1:4]
TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path += [TESTS, os.path.join(TESTS, "..", "xml")]
from forked import Program  # noqa: E402
from pages import ENVIRONMENT  # noqa: E402
from scratch import fresh  # noqa: E402

IN_FORKS = Program(PROGRAM, "h5py", "meshio", "vtkmodules.vtkIOExodus", "vtkmodules.vtkIOLegacy", "vtkmodules.vtkIOXML")


def tunica(program, *words):
    """A finished run of one of the other programs."""
    return subprocess.run([os.path.join(PROGRAMS, program), *map(str, words)], capture_output=True, text=True,
                          env=ENVIRONMENT)


class ImportTest(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.join(SCRATCH, self.id().split(".")[-1])
        os.makedirs(self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def run_import(self, *words):
        return IN_FORKS.run(words, cwd=self.folder)

    def imported(self, *words, out="out.h5"):
        """The mesh; it has passed the checks of tunica-mesh, too."""
        done = self.run_import(*words, self.path(out))
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stderr)
        self.said = done.stdout
        info = tunica("tunica-mesh", "info", self.path(out))
        self.assertEqual((info.returncode, info.stderr), (0, ""), info.stderr)
        return samples.Mesh(self.path(out))

    def expect_conforming(self, fluid, wall, interface, out="out.h5"):
        info = tunica("tunica-mesh", "info", self.path(out), "--fluid", fluid, "--wall", wall, "--interface", interface)
        self.assertIn("the interface conforms", info.stdout, info.stderr)

    def expect_error(self, *words, parts, out="out.h5"):
        """One line that holds the parts, status 1, and nothing is left behind."""
        before = sorted(os.listdir(self.folder))
        done = self.run_import(*words, self.path(out))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def expect_sizes(self, found, expected, relative=1e-6):
        self.assertEqual(set(found), set(expected))
        for name, value in expected.items():
            self.assertAlmostEqual(found[name] / value, 1, delta=relative, msg=name)


def run():
    fresh(SCRATCH)
    unittest.main(module="__main__", argv=sys.argv[:1])
