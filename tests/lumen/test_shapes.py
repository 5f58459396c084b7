"""Many vessels, of random branches, radii, voxels and noise, none of which may fail: test_shapes.py PROGRAM PROGRAMS SCRATCH"""
import os
import unittest

import numpy as np

import cases
import shapes
from cases import LumenTest
from test_meshes import write_stl


class Shapes(LumenTest):
    def of_seed(self, seed):
        lines = shapes.of_seed(seed)
        how = {"closed": seed % 3 == 0, "grey": seed % 5 == 2, "noise": 0.4 if seed % 4 == 1 else 0.0, "seed": seed}
        shapes.write(shapes.surface(lines, lines[0][1][0] / (4, 6, 8, 10)[seed % 4], **how), self.path("in.stl"))
        done = self.run_lumen(self.path("in.stl"), self.path("out.h5"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def shipped(self, name, openings):
        import h5py
        with h5py.File(os.path.join(cases.TESTS, "..", "meshes", name), "r") as file:
            place = [text.decode() for text in file["surface_names"][:]].index("interface")
            write_stl(self.path("in.stl"), file["vertices"][:], file["triangles"][:][file["triangle_surface"][:] == place])
        self.meshed(self.path("in.stl"), openings=openings)
        self.expect_wall()

    def test_aneurysm_of_fine_voxels(self):
        shapes.write(shapes.surface(shapes.aneurysm(), 0.25, closed=True), self.path("in.stl"))
        self.meshed(self.path("in.stl"), openings=4)
        self.expect_wall()

    def test_forks_of_all_kinds(self):
        for k, (voxel, closed, grey) in enumerate(np.array(np.meshgrid((0.3, 0.5), (0, 1), (0, 1))).reshape(3, -1).T):
            path = self.path(f"in-{k}.stl")
            shapes.write(shapes.surface(shapes.fork(), voxel, bool(closed), bool(grey)), path)
            with self.subTest(voxel=voxel, closed=closed, grey=grey):
                self.meshed(path, "--overwrite", openings=3)


def add(name, work):
    setattr(Shapes, name, work)


for number in range(1, 25):
    add(f"test_seed_{number}", lambda self, seed=number: self.of_seed(seed))
for mesh, count in (("arch", 5), ("bend", 2), ("bifurcation", 3), ("bulge", 2), ("carotid", 3), ("tube-tiny", 2)):
    add(f"test_{mesh.replace('-', '_')}", lambda self, name=mesh + ".h5", ends=count: self.shipped(name, ends))


if __name__ == "__main__":
    unittest.TestCase.maxDiff = None
    cases.run()
