"""tunica-import on SimVascular's folders: test_simvascular.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import os
import shutil

import numpy as np

from cases import ImportTest, run
from samples import Column, flat_faces, write_simvascular, write_vtp, write_vtu

SIDES = ("x_low", "x_high", "y_low", "y_high")


class SimVascular(ImportTest):
    """The lower half of a column is the fluid, the upper one the wall; both as folders of their own, in cm."""

    def setUp(self):
        super().setUp()
        self.column = Column()
        self.fluid = self.write("lumen", 1, {"z_low": "inflow", "z_high": "wall"})
        self.wall = self.write("tissue", 2, {"z_low": "inner", "z_high": "top"})

    def write(self, name, region, names, move=0.0, cells=3):
        points, tets = Column(cells).part(region)
        named = {"cap" if side == "x_low" else names.get(side, side): triangles
                 for side, triangles in flat_faces(points, tets).items()}
        return write_simvascular(self.path(name), points / 10 + move, tets, named, seed=region)

    def volume(self, folder):
        return os.path.join(folder, "mesh-complete", "mesh-complete.mesh.vtu")

    def face(self, folder, name):
        return os.path.join(folder, "mesh-complete", "mesh-surfaces", name + ".vtp")

    def test_faces_have_the_names_of_their_files(self):
        mesh = self.imported(self.fluid, "--scale", "10")
        self.expect_sizes(mesh.volumes(), {"region-1": 1})
        self.expect_sizes(mesh.areas(), dict.fromkeys(("cap", "inflow", "wall", "x_high", "y_low", "y_high"), 1))
        same = self.imported(os.path.join(self.fluid, "mesh-complete") + "/", "--scale", "10", out="same.h5")
        self.assertTrue((same.tets == mesh.tets).all())

    def test_field_names_its_region(self):
        self.expect_sizes(self.imported("--wall", self.wall, "--scale", "10").volumes(), {"wall": 1})

    def test_unit_of_simvascular_is_asked_for(self):
        points, tets = self.column.part(1)
        folder = write_simvascular(self.path("large"), 3 * points, tets, {"z_low": flat_faces(points, tets)["z_low"]})
        self.assertIn("the vessel is 3 mm long: SimVascular's models mostly are in cm. If this one is, --scale 10",
                      self.run_import(folder, "--dry-run").stderr)

    def expect_joined(self, mesh, out="out.h5"):
        self.expect_sizes(mesh.volumes(), {"fluid": 1, "wall": 1}, 1e-4)
        self.expect_sizes(mesh.areas(), dict.fromkeys(
            ["inflow", "top", "interface", "fluid_cap", "wall_cap"] +
            [f"{field}_{side}" for side in ("x_high", "y_low", "y_high") for field in ("fluid", "wall")], 1), 1e-4)
        self.assertEqual(len(mesh.vertices), len(self.column.points))
        self.expect_conforming("fluid", "wall", "interface", out=out)

    def test_fluid_and_wall_are_joined_at_their_interface(self):
        self.expect_joined(self.imported("--fluid", self.fluid, "--wall", self.wall, "--scale", "10"))
        for text in ('18 of 18 triangles of "wall" are on the interface', '18 of 18 triangles of "inner"',
                     '18 faces between fluid and wall put into the surface "interface"'):
            self.assertIn(text, self.said)

    def test_rounded_vertices_are_joined_within_the_tolerance(self):
        moved = self.write("moved", 2, {"z_low": "inner", "z_high": "top"}, move=2e-6)
        both = ("--fluid", self.fluid, "--wall", moved, "--scale", "10")
        self.expect_joined(self.imported(*both))
        self.expect_error(*both, "--tolerance", "1e-6", out="x.h5",
                          parts=["lumen and ", "moved: fluid and wall have no vertex in common", "3.46e-05 mm"])
        self.expect_error(*both, "--tolerance", "0.5", parts=["a vertex has two of the other mesh"], out="x.h5")

    def test_file_and_folder_are_joined(self):
        points, tets = self.column.part(2)
        tissue = write_vtu(self.path("tissue.vtu"), points / 10, [(10, tets)], of_cells={
            "region": (3 + (points[tets].mean(axis=1)[:, 2] > 4 / 3)).astype(np.int32)})
        mesh = self.imported("--fluid", self.fluid, "--wall", tissue, "--scale", "10", "--split-angle", "40")
        self.expect_sizes(mesh.volumes(), {"fluid": 1, "wall-3": 1 / 3, "wall-4": 2 / 3})
        self.assertAlmostEqual(mesh.areas()["interface"], 1)
        self.expect_conforming("fluid", "wall-3,wall-4", "interface")

    def test_meshes_that_do_not_conform_are_refused(self):
        finer = self.write("finer", 2, {}, cells=4)
        done = self.run_import("--fluid", self.fluid, "--wall", finer, "--scale", "10", "out.h5")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("vertices in common, but no face", done.stderr)
        away = self.write("away", 2, {}, move=1.0)
        self.expect_error("--fluid", self.fluid, "--wall", away, "--scale", "10",
                          parts=["no vertex in common", "two meshes that conform"])

    def test_damaged_folders_are_one_line(self):
        face, volume = self.face(self.fluid, "inflow"), self.volume(self.fluid)
        points, tets = self.column.part(1)
        triangles = flat_faces(points, tets)["z_low"]
        cases = [(volume, lambda: os.remove(volume), ["lumen: no volume mesh", "mesh-complete.mesh.vtu"]),
                 # of another mesh, ten times as large
                 (face, lambda: write_vtp(face, points, triangles),
                  ["inflow.vtp: point 1, at", "away from all of the volume", "no GlobalNodeID", "another mesh?"]),
                 (face, lambda: write_vtp(face, points, triangles, of_points={
                     "GlobalNodeID": np.arange(len(points)) + 10 ** 6}),
                  ["inflow.vtp: point 1, at", "a GlobalNodeID that no point of the volume has"]),
                 (face, lambda: write_vtp(face, points, triangles, of_points={
                     "GlobalNodeID": np.arange(len(points)) + 1}),
                  ["inflow.vtp: point 1, at", "a GlobalNodeID of a point elsewhere"]),
                 (face, lambda: write_vtp(face, points / 10, triangles[:, [0, 1, 0]]),
                  ["inflow.vtp: triangle 0 has a vertex more than once"]),
                 (face, lambda: write_vtp(face, points, np.hstack([triangles, triangles[:, :1]])),
                  ["inflow.vtp: 18 polygons or strips that are no triangles"]),
                 (face, lambda: open(face, "w", encoding="utf-8").close(), ["inflow.vtp: VTK cannot read it"]),
                 (face, lambda: shutil.rmtree(os.path.dirname(face)), ["mesh-complete: no mesh-surfaces/*.vtp"])]
        shutil.copytree(self.fluid, self.path("good"))
        for damaged, damage, parts in cases:
            with self.subTest(parts=parts):
                shutil.rmtree(self.fluid)
                shutil.copytree(self.path("good"), self.fluid)
                damage()
                self.expect_error(self.fluid, parts=parts)

    def test_points_are_found_by_place_where_their_numbers_are_of_no_use(self):
        good, face = self.imported(self.fluid, "--scale", "10"), self.face(self.fluid, "inflow")
        points, tets = self.column.part(1)
        triangles = flat_faces(points, tets)["z_low"]
        used, own = np.unique(triangles, return_inverse=True)
        place = (points[used] / 10, own.reshape(-1, 3))
        shifted = (np.roll(used, 1) + 1).astype(np.int32)
        for k, (numbers, reason) in enumerate(((None, "no GlobalNodeID"), (shifted, "elsewhere"))):
            write_vtp(face, *place, of_points=None if numbers is None else {"GlobalNodeID": numbers.astype(np.int32)})
            mesh = self.imported(self.fluid, "--scale", "10", out=f"{k}.h5")
            self.assertTrue((mesh.triangles == good.triangles).all())
            self.assertTrue((mesh.triangle_surface == good.triangle_surface).all())
            self.assertIn("note     the points of inflow.vtp were found by their places", self.said)
            self.assertIn(reason, self.said)

    def test_surface_alone_is_refused(self):
        self.expect_error(self.face(self.fluid, "inflow"), parts=["inflow.vtp: a surface without a volume"])
        self.expect_error(self.wall, self.fluid, parts=["2 names after the mesh"])


if __name__ == "__main__":
    run()
