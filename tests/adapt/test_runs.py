"""Runs whose meshes are made anew, and go on there: test_runs.py SOURCE PROGRAMS SCRATCH"""
import os
import re
import subprocess
import sys
import types
import unittest

import h5py
import numpy as np
from scipy.spatial import Delaunay

from adapt import errors
from lumen import core, remesh, rims as of_rims, surface as base, volume

SOURCE, PROGRAMS, SCRATCH = sys.argv[1:4]
sys.path.append(os.path.join(SOURCE, "xml"))
from pages import ENVIRONMENT, columns_of  # noqa: E402
from scratch import fresh  # noqa: E402
from tubes import pipe  # noqa: E402

CASE = os.path.join(SOURCE, "xml", "poiseuille.xml")


def entry(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def listed(name, *entries):
    return f'<ParameterList name="{name}">{"".join(entries)}</ParameterList>'


def condition(surface, kind, *more):
    return listed(surface, entry("condition", "string", kind), *more)


LAYER = (entry("law", "string", "neo-hookean"), entry("c10", "double", 30))
COUPLED = listed(
    "Case", listed("Mesh", entry("file", "string", "vessel.h5")),
    listed("Time", entry("step size", "double", 1), entry("steps", "int", 2)),
    listed("Fluid", entry("density", "double", 1), entry("viscosity", "double", 0.0035),
           listed("Surfaces", condition("inlet", "pressure", entry("pressure", "double", 1)),
                  condition("outlet", "pressure", entry("pressure", "double", 0)), condition("interface", "interface"))),
    listed("Wall", listed("Layers", listed("media", *LAYER), listed("adventitia", *LAYER)),
           listed("Surfaces", condition("wall_inlet", "clamped"), condition("wall_outlet", "clamped"),
                  condition("interface", "interface"))))


def program(name, *words):
    return subprocess.run([os.path.join(PROGRAMS, name), *map(str, words)], capture_output=True, text=True, cwd=SCRATCH, env=ENVIRONMENT,
                          check=False)


def path(name):
    return os.path.join(SCRATCH, name)


class Runs(unittest.TestCase):
    def must(self, name, *words):
        done = program(name, *words)
        self.assertEqual(done.returncode, 0, f"{name} {words}: {done.stdout}{done.stderr}")
        return done.stdout

    def refused(self, part, *words):
        done = program("tunica-mesh", "adapt", *words)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stdout + done.stderr)
        self.assertIn(part, done.stderr)

    def test_blood_alone(self):
        """A tube without layers: the new mesh is as round, has the names and about the number, and the flow goes on."""
        self.must("tunica-mesh", "tube", "tube.h5", "--radius", 1.43, "--length", 8, "--around", 12, "--axial", 10, "--rings", 2, "--wall",
                  "off")
        settings = ["--set", "Mesh/file=" + path("tube.h5"), "--set", "Fluid/Surfaces/inlet/pressure=1e-3"]
        self.must("tunica-fluid", CASE, "--output", "run", *settings)
        said = self.must("tunica-mesh", "adapt", "run", "new.h5", "--layers", 1).replace(",", "")
        told, made = (float(re.search(pattern, said)[1]) for pattern in (r"about (\d+) tetrahedra", r"(\d+) tetrahedra wanted"))
        self.assertAlmostEqual(made / told, 1.0, delta=0.2)
        with h5py.File(path("new.h5")) as file, h5py.File(path("tube.h5")) as old:
            names = [name.decode() for name in file["surface_names"][:]]
            self.assertEqual(sorted(names), ["inlet", "interface", "outlet"])
            wall = np.unique(file["triangles"][:][file["triangle_surface"][:] == names.index("interface")])
            radius = np.linalg.norm(file["vertices"][:][wall][:, :2], axis=1)
            self.assertAlmostEqual(len(file["tets"]) / len(old["tets"]), 1.0, delta=0.2)
            self.assertLess(np.abs(radius - 1.43).max(), 0.03)  # chords of the run's twelve sides are 0.049 off
            self.assertIn("origin", file)
        self.must("tunica-fluid", "new.xml", "--output", "next", "--steps", 1)
        before, after = (columns_of(path(name))["inflow_outlet_mm3_per_ms"][-1] for name in ("run", "next"))
        self.assertAlmostEqual(after / before, 1.0, delta=0.1)
        self.refused("is there already", "run", "new.h5")

    def test_blood_and_wall(self):
        """The wall is grown again as it was, and the coupled run goes on."""
        self.must("tunica-mesh", "tube", "lumen.h5", "--radius", 1.43, "--length", 8, "--around", 12, "--axial", 8, "--rings", 2, "--wall", "off")
        self.must("tunica-mesh", "wall", "lumen.h5", "vessel.h5", "--surfaces", "interface", "--layers", "media=0.26:2,adventitia=0.13:1",
                  "--interface", "interface")
        with open(path("coupled.xml"), "w", encoding="utf-8") as file:
            file.write(COUPLED)
        self.must("tunica-fsi", "coupled.xml", "--output", "pulse")
        self.must("tunica-mesh", "adapt", "pulse", "wider.h5", "--layers", 0, "--tetrahedra", 3000)
        with h5py.File(path("wider.h5")) as file, h5py.File(path("vessel.h5")) as old:
            for kind in ("surface_names", "region_names"):
                self.assertEqual(sorted(file[kind][:]), sorted(old[kind][:]))
            outer = np.unique(file["triangles"][:][file["triangle_surface"][:] == list(file["surface_names"][:]).index(b"outer")])
            self.assertAlmostEqual(float(np.linalg.norm(file["vertices"][:][outer][:, :2], axis=1).mean()), 1.82, delta=0.03)
            for region, elements in ((b"media", 2), (b"adventitia", 1)):
                count = int((file["tet_region"][:] == list(file["region_names"][:]).index(region)).sum())
                on = int((file["triangle_surface"][:] == list(file["surface_names"][:]).index(b"interface")).sum())
                self.assertEqual(count, 3 * elements * on)
        self.must("tunica-fsi", "wider.xml", "--output", "further", "--steps", 1)

    def test_sizes_are_those_of_a_known_function(self):
        """A tube whose elements are to be 0.2 mm wide at one end and 0.5 mm at the other: their number is that of the integral."""
        tube, wanted = pipe(around=40, along=60, radius=1.5, length=6.0), lambda points: 0.2 + 0.05 * points[:, 2]
        rims = [of_rims.measured(tube.points, loop, np.array([0.0, 0.0, sign]))
                for loop, sign in zip(base.loops(tube.triangles), (-1.0, 1.0))]
        wall = remesh.Remesher(tube, rims, wanted(tube.points)).run(lambda text: None)
        box = np.array([[x, y, z] for x in (-2.0, 2.0) for y in (-2.0, 2.0) for z in (0.0, 6.0)])
        around = core.Sizes(box, Delaunay(box).simplices, wanted(box))
        own = [of_rims.measured(wall.points, loop, np.array([0.0, 0.0, -1.0 if wall.points[loop[0], 2] < 3.0 else 1.0]))
               for loop in base.loops(wall.triangles)]
        mesh = volume.fill(wall, own, volume.Wish(np.full(len(wall.points), 0.1), around), np.full(len(wall.points), 1.5),
                           types.SimpleNamespace(layers=0, growth=1.0, surface="tube"), types.SimpleNamespace(stage=print, warn=print))
        parts = 10.0 * (0.2 ** -2 - 0.5 ** -2)  # the integral of 1/h^3 along the tube
        self.assertAlmostEqual(len(mesh.tets) / (np.pi * 1.5 ** 2 * parts / errors.OF_TETRAHEDRON), 1.0, delta=0.2)
        self.assertAlmostEqual(len(mesh.wall) / (2 * np.pi * 1.5 * 20.0 * (1 / 0.2 - 1 / 0.5) / errors.OF_TRIANGLE), 1.0, delta=0.2)

    def test_what_cannot_be_done_is_said_in_one_line(self):
        self.refused("not a folder", "nowhere", "other.h5")
        os.makedirs(path("empty"), exist_ok=True)
        self.refused("run.json", "empty", "other.h5")
        self.refused("ends in .h5", "run", "other.msh")
        self.must("tunica-solid", os.path.join(SOURCE, "xml", "block.xml"), "--output", "solid", "--steps", 1)
        self.refused("a wall alone", "solid", "other.h5")
        self.refused('Did you mean "--factor"?', "run", "other.h5", "--facto", 2)


if __name__ == "__main__":
    fresh(SCRATCH)
    unittest.main(argv=sys.argv[:1])
