"""The parts of tunica-import: test_parts.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import os
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[1])))  # as the program does
from importer import faces, meshio_files, names, places, summary  # noqa: E402
from importer.raw import BadMesh, Tags  # noqa: E402

TET = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])


class Faces(unittest.TestCase):
    def test_two_tetrahedra_have_seven_faces_of_which_one_is_inside(self):
        found = faces.Faces("two", TET, np.array([[0, 1, 2, 3], [1, 4, 2, 3]]))
        self.assertEqual((found.count, int(found.is_outer.sum())), (7, 6))
        self.assertEqual(found.sorted[~found.is_outer].tolist(), [[1, 2, 3]])
        self.assertEqual(found.find(np.array([[3, 1, 2], [0, 1, 4]])).tolist(),
                         [int(np.flatnonzero(~found.is_outer)[0]), -1])

    def test_normals_of_outer_faces_point_outward(self):
        found = faces.Faces("one", TET, np.array([[0, 1, 2, 3]]))
        normal = faces.normals(TET, found.outward)
        from_centre = TET[found.outward].mean(axis=1) - TET[:4].mean(axis=0)
        self.assertTrue((np.einsum("ij,ij->i", normal, from_centre) > 0).all())

    def test_folded_and_repeated_tetrahedra_are_refused(self):
        with self.assertRaisesRegex(BadMesh, "same side"):
            faces.Faces("folded", np.vstack([TET, [0.1, 0.1, 0.5]]), np.array([[0, 1, 2, 3], [0, 1, 2, 5]]))
        with self.assertRaisesRegex(BadMesh, "three tetrahedra"):
            faces.Faces("thrice", TET, np.array([[0, 1, 2, 3]] * 3))

    def test_components_are_those_of_a_search(self):
        a, b = np.random.default_rng(7).integers(0, 300, (2, 200))
        label = faces.components(300, a, b)
        expected = np.arange(300)
        for _ in range(300):
            for i, j in zip(a, b):
                expected[i] = expected[j] = min(expected[i], expected[j])
        self.assertEqual(label.tolist(), expected.tolist())

    def test_long_chain_is_one_component(self):
        chain = np.arange(100000)
        self.assertEqual(faces.components(len(chain), chain[1:], chain[:-1]).max(), 0)

    def test_cube_has_six_patches(self):
        corners = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
        tets = np.array([[0, 4, 6, 7], [0, 6, 2, 7], [0, 2, 3, 7], [0, 3, 1, 7], [0, 1, 5, 7], [0, 5, 4, 7]])
        tets[faces.six_volumes(corners, tets) < 0] = tets[faces.six_volumes(corners, tets) < 0][:, [0, 1, 3, 2]]
        outside = faces.Faces("cube", corners, tets)
        triangles = outside.outward[outside.is_outer]
        part = np.zeros(len(triangles), dtype=int)
        self.assertEqual(np.bincount(faces.patches(corners, triangles, part, 40.0)).tolist(), [2] * 6)
        self.assertEqual(np.bincount(faces.patches(corners, triangles, part, 91.0)).tolist(), [12])


class Places(unittest.TestCase):
    def test_pairs_are_those_of_all_distances(self):
        random = np.random.default_rng(3)
        a, b = random.random((150, 3)), random.random((130, 3)) - 0.2
        near = np.linalg.norm(a[:, None] - b[None], axis=2) <= 0.15
        self.assertEqual(places.pairs_within(a, b, 0.15).tolist(), np.argwhere(near).tolist())

    def test_twins_differ_in_the_last_digits_only(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1e-12, 0], [1, 1e-3, 0]])
        self.assertEqual(places.twins(points).tolist(), [[1, 2]])

    def test_least_distance_of_two_clouds(self):
        a = np.random.default_rng(1).random((100, 3))
        self.assertAlmostEqual(places.nearest(a, a[7:8] + (0, 0, 1e-4)), 1e-4)


class Names(unittest.TestCase):
    def test_meshes_that_share_an_ending_with_one_that_is_read_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh")
            for content, program in ((b'(0 "grid")\n', "Fluent"), (b"\n(2 3)\n", "Fluent"),
                                     (b"MFEM mesh v1.0\n", "MFEM"),
                                     (b"5 2 7\n0 0 0 1\n", "FreeFem"), (b"FoamFile\n{\n", "OpenFOAM")):
                with open(path, "wb") as file:
                    file.write(content)
                with self.assertRaisesRegex(BadMesh, program):
                    meshio_files.check_foreign(path)
            for content in (b"$MeshFormat\n", b"MeshVersionFormatted 2\n", b"*HEADING\n(1 2)\n", b"$ comment\n"):
                with open(path, "wb") as file:
                    file.write(content)
                meshio_files.check_foreign(path)

    def test_files_of_names_may_begin_with_a_byte_order_mark(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "names.txt")
            with open(path, "w", encoding="utf-8-sig", newline="") as file:
                file.write("surface 3 in\r\nregion 1 wall\r\n")
            self.assertEqual(names.read(path), [("surface", "3", "in"), ("region", "1", "wall")])
            with open(path, "w", encoding="utf-16") as file:
                file.write("surface 3 in\n")
            with self.assertRaisesRegex(BadMesh, "not UTF-8"):
                names.read(path)

    def test_tags_of_numbers_keep_their_order_and_names(self):
        tags = Tags.of_numbers([7, 3, 0, 7], {3: "wall"}, untagged=0)
        names.settle(tags, "region")
        self.assertEqual((tags.names, tags.ids, tags.of.tolist()), (["wall", "region-7"], [3, 7], [1, 0, -1, 1]))

    def test_two_of_one_name_become_one(self):
        tags = Tags.of_numbers([1, 2, 3], {1: "a", 2: "b", 3: "c"})
        names.apply([("surface", "3", "a"), ("region", "b", "x")], "names.txt", tags, "surface")
        self.assertEqual((tags.names, tags.of.tolist()), (["a", "b"], [0, 1, 0]))

    def test_unknown_name_is_refused_with_the_nearest(self):
        with self.assertRaisesRegex(BadMesh, 'no surface "inlett". Did you mean "inlet"?'):
            names.apply([("surface", "inlett", "x")], "f", Tags.of_numbers([1], {1: "inlet"}), "surface")


class Extent(unittest.TestCase):
    def test_text_has_three_digits_of_the_longest(self):
        self.assertEqual(summary.extent_text([3.0, 3.0, 15.0]), "3.0 x 3.0 x 15.0 mm")
        self.assertEqual(summary.extent_text([0.003, 0.003, 0.015]), "0.0030 x 0.0030 x 0.0150 mm")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
