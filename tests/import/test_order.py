"""tunica-import puts meshes in order: test_order.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import math
import os
import re

import numpy as np

import samples
from cases import ImportTest, run, tunica
from samples import Column, flat_faces, write_vtu

RADIUS, MEDIA, ADVENTITIA, LENGTH, AROUND = 1.43, 0.26, 0.13, 18.0, 12


def polygon(radius):
    """Area of the regular polygon that a tube's section is."""
    return AROUND / 2 * radius ** 2 * math.sin(2 * math.pi / AROUND)


def mantle(radius):
    return AROUND * 2 * radius * math.sin(math.pi / AROUND) * LENGTH


class Order(ImportTest):
    def column(self, name="column.vtu", **changes):
        column = Column()
        content = {"points": column.points, "tets": column.tets, "region": column.region, **changes}
        return write_vtu(self.path(name), content["points"], [(10, content["tets"])],
                         of_cells={"region": content["region"].astype(np.int32)})

    def test_bare_column_gets_an_outside_and_an_interface(self):
        with open(self.path("names.txt"), "w", encoding="utf-8") as file:
            file.write("# old new\nregion 1 fluid\nregion region-2 'the wall'\nsurface surface-0 outside\n")
        mesh = self.imported(self.column(), "--names", "names.txt")
        self.expect_sizes(mesh.volumes(), {"fluid": 1, "the wall": 1}, 1e-12)
        self.expect_sizes(mesh.areas(), {"outside": 10, "interface": 1}, 1e-12)
        self.expect_conforming("fluid", "the wall", "interface")
        for text in ("extent   1.00 x 1.00 x 2.00 mm", "volume 1 mm^3", "area 10 mm^2"):
            self.assertIn(text, self.said)

    def test_fluid_by_another_name_gets_an_interface(self):
        mesh = self.imported(self.column())
        self.assertIn("no region is called \"fluid\"", self.said)
        self.assertEqual(mesh.surfaces, ["surface-0"])
        mesh = self.imported(self.column(), "--fluid-regions", "region-2", out="named.h5")
        self.expect_sizes(mesh.areas(), {"surface-0": 10, "interface": 1}, 1e-12)

    def test_split_separates_the_sides_of_a_column(self):
        areas = self.imported(self.column(), "--split-angle", "40").areas()
        self.expect_sizes(areas, {f"surface-{k}": 1 for k in range(1, 11)}, 1e-12)

    def test_split_separates_caps_and_walls_of_a_tube(self):
        tunica("tunica-mesh", "tube", self.path("tube.h5"))
        tunica("tunica-mesh", "convert", self.path("tube.h5"), self.path("tube.vtu"))
        tube = samples.Mesh(self.path("tube.h5"))
        bare = write_vtu(self.path("bare.vtu"), tube.vertices, [(10, tube.tets)],
                         of_cells={"region": tube.tet_region})
        areas = self.imported(bare, "--split-angle", "40", "--fluid-regions", "region-0").areas()
        middle, outer = RADIUS + MEDIA, RADIUS + MEDIA + ADVENTITIA
        caps = (polygon(RADIUS), polygon(middle) - polygon(RADIUS), polygon(outer) - polygon(middle))
        expected = [mantle(outer)] + sorted(caps * 2, reverse=True)
        self.assertAlmostEqual(areas.pop("interface"), mantle(RADIUS), places=9)
        self.assertEqual(list(areas), [f"surface-{k}" for k in range(1, 8)])
        self.assertTrue(np.allclose(list(areas.values()), expected, rtol=1e-9))

    def test_tetrahedra_of_either_orientation_become_positive(self):
        column = Column()
        mixed = column.tets.copy()
        mixed[::2] = mixed[::2][:, [1, 0, 2, 3]]
        mesh = self.imported(self.column(tets=mixed), "--names", os.devnull)
        self.expect_sizes(mesh.volumes(), {"region-1": 1, "region-2": 1}, 1e-12)
        self.assertIn(f"{len(mixed[::2])} of {len(mixed)} tetrahedra turned round", self.said)

    def test_points_without_tetrahedra_are_dropped(self):
        column = Column()
        points = np.vstack([[[9.0, 9, 9]], column.points, [[-9.0, 0, 0]]])
        mesh = self.imported(self.column(points=points, tets=column.tets + 1))
        self.assertEqual(mesh.vertices.tolist(), column.points.tolist())
        self.assertIn("2 points that belong to no tetrahedron dropped", self.said)

    def test_twins_are_reported_and_merged(self):
        column = Column()
        (points, tets), (above, tets_above) = column.part(1), column.part(2)
        apart = self.column(points=np.vstack([points, above]), tets=np.vstack([tets, tets_above + len(points)]),
                            region=np.repeat([1, 2], [len(tets), len(tets_above)]))
        self.assertEqual(self.imported(apart).areas().keys(), {"surface-0"})
        self.assertIn("16 vertices stand at the place of another", self.said)
        mesh = self.imported(apart, "--merge", "--fluid-regions", "region-1", out="merged.h5")
        self.expect_sizes(mesh.areas(), {"surface-0": 10, "interface": 1}, 1e-12)
        self.assertEqual(len(mesh.vertices), len(column.points))
        self.assertNotIn("two surfaces", self.said)
        self.expect_error(apart, "--merge", "--tolerance", "0.5", parts=["would lose a vertex"], out="x.h5")

    def test_merged_face_is_left_to_the_first_of_its_surfaces(self):
        column = Column()
        parts = [column.part(1), column.part(2)]
        shift = len(parts[0][0])
        touching = np.vstack([flat_faces(*parts[0])["z_high"], flat_faces(*parts[1])["z_low"] + shift])
        count = len(column.tets)
        content = np.vstack([parts[0][0], parts[1][0]]), [
            (10, np.vstack([parts[0][1], parts[1][1] + shift])), (5, touching)]
        apart = write_vtu(self.path("apart.vtu"), *content, of_cells={
            "region": np.repeat([1, 2, 0], [count // 2, count // 2, len(touching)]).astype(np.int32),
            "surface": np.repeat([0, 7, 8], [count, len(touching) // 2, len(touching) // 2]).astype(np.int32)})
        mesh = self.imported(apart, "--merge")
        self.expect_sizes(mesh.areas(), {"surface-7": 1, "surface-0": 10}, 1e-12)
        self.assertIn('18 faces belong to two surfaces, as to "surface-7" and "surface-8"', self.said)

    def test_fluid_and_wall_that_touch_in_an_edge_are_reported(self):
        points = np.array([[0.0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
        self.imported(self.column(points=points, tets=np.array([[0, 2, 3, 1], [0, 4, 5, 1]]),
                                  region=np.array([1, 2])), "--fluid-regions", "region-1")
        self.assertIn("fluid and wall touch in 2 vertices without a common face, the first at (0, 0, 0)", self.said)

    def test_lengths_are_scaled_and_doubted(self):
        metres = self.column(points=0.001 * Column().points)
        done = self.run_import(metres, "--dry-run")
        self.assertEqual(done.returncode, 0)
        self.assertIn("0.002 mm long: is this in m? try --scale 1000", done.stderr)
        self.assertEqual(os.listdir(self.folder), ["column.vtu"])
        self.expect_sizes(self.imported(metres, "--scale", "1000").volumes(), {"region-1": 1, "region-2": 1})
        done = self.run_import(metres, "--dry-run", "--scale", "1e7")
        self.assertIn("the vessel is 20000 mm long: is this in µm? try --scale 10000", done.stderr)

    def test_wrong_meshes_are_one_line(self):
        column = Column()
        flat = column.points.copy()
        flat[column.tets[5][3]] = flat[column.tets[5][:3]].mean(axis=0)
        nan = column.points.copy()
        nan[4, 1] = np.nan
        wrong = column.tets.copy()
        wrong[3, 2] = wrong[3, 1]
        cases = [(dict(points=flat), "flat"), (dict(points=nan), "point 4 has a coordinate"),
                 (dict(tets=wrong), "tetrahedron 3 has a vertex more than once"),
                 (dict(tets=np.vstack([column.tets] * 3), region=np.tile(column.region, 3)), "three tetrahedra")]
        for k, (changes, text) in enumerate(cases):
            with self.subTest(text=text):
                self.expect_error(self.column(f"wrong{k}.vtu", **changes), parts=[f"wrong{k}.vtu: ", text])
        # VTK itself does not survive writing such a vertex everywhere
        far = write_vtu(self.path("far.vtu"), column.points, [(10, column.tets)], mode="ascii none",
                        of_cells={"region": column.region.astype(np.int32)})
        with open(far, encoding="utf-8") as file:
            head, numbers = re.split(r"(?<=Name=\"connectivity\")", file.read())
        with open(far, "w", encoding="utf-8") as file:
            file.write(head + re.sub(r">\s*\d+", ">\n 1000000", numbers, count=1))
        self.expect_error(far, parts=["far.vtu: ", "tetrahedron 0 has vertex"])

    def test_results_are_overwritten_only_on_request(self):
        self.column()
        with open(self.path("out.h5"), "w", encoding="utf-8") as file:
            file.write("mine")
        self.expect_error(self.path("column.vtu"), parts=["out.h5: is there already", "--overwrite"])
        with open(self.path("out.h5"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")
        self.imported(self.path("column.vtu"), "--overwrite")
        self.assertEqual(sorted(os.listdir(self.folder)), ["column.vtu", "out.h5"])
        os.remove(self.path("out.h5"))

    def test_wrong_words_are_one_line(self):
        mesh = self.column()
        for words, parts in ((("--scal", "2"), ['Did you mean "--scale"?']), (("--scale", "0"), ["--scale is 0"]),
                             (("--split-angle", "200"), ["--split-angle is 200", "less than 180"]),
                             (("--names", "nowhere.txt"), ["nowhere.txt", "file of names"]),
                             (("--region-array", "regoin"), ["column.vtu", 'Did you mean "region"?']),
                             (("second.vtu",), ["2 names after the mesh"])):
            with self.subTest(words=words):
                self.expect_error(mesh, *words, parts=parts)
        with open(self.path("names.txt"), "w", encoding="utf-8") as file:
            file.write("region 1 fluid\nregoin 2 wall\n")
        self.expect_error(mesh, "--names", "names.txt", parts=["names.txt:2: ", '"region OLD NEW"'])
        self.expect_error(mesh, parts=["no such folder"], out="nowhere/out.h5")
        self.expect_error(mesh, parts=["ends in .h5"], out="out.vtu")
        self.expect_error("nowhere.vtu", parts=["nowhere.vtu: there is no such file or folder"])


class Scale(ImportTest):
    """Mesh / scale of a case is the other way to mm."""

    def test_case_scales_what_the_import_did_not(self):
        tunica("tunica-mesh", "tube", self.path("tube.h5"))
        self.run_import("tube.h5", "metres.h5", "--scale", "0.001")
        case = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "xml", "pulse-tiny.xml")
        words = [case, "--set", "Mesh/file=" + self.path("metres.h5")]
        done = tunica("tunica-check", *words)
        self.assertIn("mesh: 0.0035 x 0.0035 x 0.0180 mm", done.stdout)
        self.assertIn('0.0180 mm: is it in m? See "Mesh / scale".', done.stderr)
        done = tunica("tunica-check", *words, "--set", "Mesh/scale=1000")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("mesh: 3.5 x 3.5 x 18.0 mm", done.stdout)
        for program in ("tunica-check", "tunica-fsi"):
            done = tunica(program, *words, "--set", "Mesh/scale=1000", "--dry-run")
            self.assertIn("mesh: 3.5 x 3.5 x 18.0 mm", done.stdout)


if __name__ == "__main__":
    run()
