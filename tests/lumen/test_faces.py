"""Surfaces whose faces have numbers keep the names of their caps: test_faces.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import os

import cases
import named_faces
from importer.raw import BadMesh
from lumen import caps, names, subdivide, surface_files


def silent(_):
    pass


class Faces(cases.LumenTest):
    def named(self, path="in.vtp", of_faces=None):
        """Place of each cap by its name, as make.opened() finds them."""
        surface = subdivide.evened(surface_files.read(self.path(path), of_faces))
        return {name: round(float(place[2]), 6) for name, place in caps.taken_off(surface, silent)[1]}

    def test_names_in_the_file(self):
        named_faces.write(self.path("in.vtp"), texts=("wall", "upstream", "downstream"))
        self.assertEqual(self.named(), {"upstream": 0, "downstream": 30})

    def test_numbers_alone_name_the_caps(self):
        for array in ("ModelFaceID", "CellEntityIds", "CapID"):
            named_faces.write(self.path("in.vtp"), array=array, numbers=(-1, 5, 7))
            self.assertEqual(self.named(), {"surface-5": 0, "surface-7": 30})

    def test_names_of_a_model_beside_the_file(self):
        named_faces.write(self.path("in.vtp"))
        named_faces.write_model(self.path("in.mdl"), {1: "wall_aorta", 2: "inflow", 3: "cap_aorta"})
        self.assertEqual(self.named(), {"inflow": 0, "cap_aorta": 30})

    def test_names_of_a_script_beside_the_file(self):
        named_faces.write(self.path("in.vtp"))
        with open(self.path("in.vtp.facenames"), "w", encoding="utf-8") as file:
            file.write("global gPolyDataFaceNames\nset gPolyDataFaceNamesInfo(timestamp) {today}\n"
                       "set gPolyDataFaceNames(1) {wall}\nset gPolyDataFaceNames(2) {in flow}\nset gPolyDataFaceNames(3) out\n")
        self.assertEqual(self.named(), {"in flow": 0, "out": 30})

    def test_names_of_the_files_of_faces(self):
        """mesh-complete.exterior.vtp and a file for each face, which has the same number."""
        named_faces.write(self.path("in.vtp"))
        os.makedirs(self.path("mesh-surfaces"))
        for k, name in enumerate(("wall", "cap_in", "cap_out")):
            named_faces.write(self.path("mesh-surfaces", name + ".vtp"), faces=(k,))
        self.assertEqual(self.named(), {"cap_in": 0, "cap_out": 30})

    def test_names_of_a_given_file_come_first(self):
        named_faces.write(self.path("in.vtp"), texts=("wall", "upstream", "downstream"))
        given = named_faces.write_model(self.path("other.mdl"), {2: "mine"})
        wishes, of_faces = names.wanted(given, 10.0)
        self.assertIsNone(wishes)
        self.assertEqual(self.named(of_faces=of_faces), {"mine": 0, "surface-3": 30})

    def test_files_without_names_are_refused(self):
        with open(self.path("bad.mdl"), "w", encoding="utf-8") as file:
            file.write("<model> <face id='x'/> </model>")
        with open(self.path("empty.facenames"), "w", encoding="utf-8") as file:
            file.write("global gPolyDataFaceNames\n")
        for path, part in (("bad.mdl", "cannot be read as a model"), ("empty.facenames", "names no faces"),
                           ("none.mdl", "cannot be read as names")):
            with self.assertRaisesRegex(BadMesh, part):
                names.wanted(self.path(path), 1.0)
        named_faces.write(self.path("in.vtp"), array="temperature")
        with self.assertRaisesRegex(BadMesh, "its faces have no numbers"):
            self.named(of_faces={1: "wall"})


if __name__ == "__main__":
    cases.run()
