"""Surfaces become meshes, or are refused with their place: test_meshes.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import subprocess

import numpy as np

import cases
import named_faces
import shapes
from cases import LumenTest, tunica
from lumen import surface_files
from lumen.target import polydata


def write_stl(path, points, triangles):
    from vtkmodules.vtkIOGeometry import vtkSTLWriter
    writer = vtkSTLWriter()
    writer.SetInputData(polydata(points, triangles))
    writer.SetFileName(path)
    writer.Write()


class Meshes(LumenTest):
    def shape(self, name, voxel, **how):
        shapes.write(shapes.surface(shapes.lines_of(name), voxel, **how), self.path("in.stl"))
        return self.path("in.stl")

    def test_fork_with_caps_and_names(self):
        with open(self.path("names.csv"), "w", encoding="utf-8") as file:
            file.write("name,x,y,z\nroot,0,0,2\nleft,-6.1,0,25\n")
        beside = self.meshed(self.shape("fork", 0.4, closed=True), "--across", 6, "--names", self.path("names.csv"), openings=3)
        self.assertEqual([o["name"] for o in beside["openings"]], ["root", "left", "opening-3"])
        self.assertEqual(len(beside["branches"]), 3)
        for opening, radius in zip(beside["openings"], (2.0, 1.4, 1.2)):
            self.assertAlmostEqual(opening["radius"], radius, delta=0.1)
        self.assertLess(beside["openings"][0]["normal"][2], -0.99)
        self.expect_wall()

    def test_aneurysm(self):
        beside = self.meshed(self.shape("aneurysm", 0.4), "--across", 5, openings=4)
        self.assertEqual(len(beside["branches"]), 5)
        self.expect_wall()

    def test_rough_tube_in_cm_without_layers_as_gmsh(self):
        surface = surface_files.read(self.shape("tube", 0.4, noise=0.2))
        write_stl(self.path("in.stl"), 0.1 * surface.points, surface.triangles)
        self.meshed(self.path("in.stl"), "--scale", 10, "--layers", 0, "--size", 0.5, "--extend", 2, openings=2, out="out.msh")
        self.assertIn(", 0 in layers", self.said)

    def test_command_of_tunica_mesh_makes_a_mesh_once(self):
        surface = self.shape("tube", 0.5)
        done = tunica("tunica-mesh", "lumen", surface, self.path("out.h5"), "--across", "4", "--layers", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stderr)
        self.assertEqual(len(self.beside("out.h5", 2)["branches"]), 1)
        again = tunica("tunica-mesh", "lumen", surface, self.path("out.h5"))
        self.assertEqual(again.returncode, 1)
        self.assertIn("--overwrite replaces it", again.stderr)

    def test_tube_of_few_triangles_with_named_faces(self):
        """As drawn by CAD: triangles as long as the vessel, faces with numbers, their names in a file."""
        named_faces.write(self.path("in.vtp"))
        model = named_faces.write_model(self.path("model.mdl"), {1: "wall", 2: "upstream", 3: "downstream"})
        beside = self.meshed(self.path("in.vtp"), "--across", 5, "--names", model, openings=2)
        place = {o["name"]: o["centre"][2] for o in beside["openings"]}
        self.assertEqual(sorted(place), ["downstream", "upstream"])
        self.assertLess(abs(place["upstream"]) + abs(place["downstream"] - 30.0), 3.0)  # ends are cut a little shorter


class Refused(LumenTest):
    def test_surfaces_that_are_none_of_a_lumen(self):
        shapes.write(shapes.surface(shapes.fork(), 0.5), self.path("fork.stl"))
        fork = surface_files.read(self.path("fork.stl"))
        two = np.vstack([fork.triangles, fork.triangles + len(fork.points)])
        write_stl(self.path("two.stl"), np.vstack([fork.points, fork.points + [30.0, 0, 0]]), two)
        self.expect_error(self.path("two.stl"), parts=["2 pieces"], picture=True)
        middle = fork.points[fork.triangles].mean(axis=1)
        torn = (middle[:, 1] > 0.4) & (np.abs(middle[:, 2] - 8.0) < 1.5)
        write_stl(self.path("torn.stl"), fork.points, fork.triangles[~torn])
        self.expect_error(self.path("torn.stl"), parts=["torn open at", "8"], picture=True)
        pushed = fork.points.copy()
        pushed[(np.abs(pushed[:, 2] - 8.0) < 1.0) & (pushed[:, 0] > 0.0), 0] -= 4.5
        write_stl(self.path("crossing.stl"), pushed, fork.triangles)
        self.expect_error(self.path("crossing.stl"), parts=["crosses itself"], picture=True)

    def test_files_that_are_no_surfaces(self):
        for name, text in (("empty.stl", ""), ("text.stl", "hello\n" * 40), ("what.txt", "x")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
        self.expect_error(self.path("empty.stl"), parts=["empty.stl"])
        self.expect_error(self.path("text.stl"), parts=["text.stl"])
        self.expect_error(self.path("what.txt"), parts=['the ending is ".txt"', ".stl"])
        self.expect_error(self.path("txt.stl"), parts=["no such file", "text.stl"])
        self.expect_error("--acros", 3, self.path("text.stl"), parts=["--across"])
        self.expect_error(self.path("text.stl"), parts=["ends in .h5"], out="out.vtk")

    def test_ball_without_openings(self):
        from vtkmodules.vtkFiltersSources import vtkSphereSource
        ball = vtkSphereSource()
        ball.SetThetaResolution(24)
        ball.SetPhiResolution(24)
        ball.SetRadius(3.0)
        shapes.write(ball, self.path("ball.stl"))
        self.expect_error(self.path("ball.stl"), parts=["no opening is found"], picture=True)

    def test_program_of_another_place_is_named(self):
        done = subprocess.run([cases.PROGRAM, "--help"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        self.assertIn("--thinnest", done.stdout)


if __name__ == "__main__":
    cases.run()
