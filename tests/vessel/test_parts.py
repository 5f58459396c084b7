"""The parts of tunica-vessel that need no other program: test_parts.py ROOT FOLDER_OF_PROGRAMS SCRATCH"""
import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

from vessel import branches, case_file, checkpoint, flow_shapes, folder, options, walls
from vessel.errors import BadInput
from vessel.mesh_file import Mesh, opening_of

ROOT = sys.argv[1]


def words(*more):
    return [os.path.join(ROOT, "README.md"), "--output", "never-made", *more]


class Options(unittest.TestCase):
    def refused(self, text, *more):
        with self.assertRaisesRegex(BadInput, text):
            options.read("about", words(*more))

    def test_bad_options_are_refused_with_the_nearest_name(self):
        self.refused('Did you mean "--pressure"', "--presure", "120/80")
        self.refused("diastolic < systolic", "--pressure", "80/120")
        self.refused("systolic/diastolic", "--pressure", "120")
        self.refused("no NAME=SHARE", "--splits", "opening-2")
        self.refused("at most 1", "--splits", "a=0.7,b=0.6")
        self.refused("Are these kPa", "--pressure", "16/10.6")
        self.refused("has two shares", "--splits", "a=0.3,a=0.4")
        self.refused("no NAME=SHARE", "--splits", "=0.4")
        self.refused('Did you mean "carotid"', "--wall", "carotis")
        self.refused("neither a number", "--flow", "never-made.csv")
        self.refused("scales the flow of a file", "--flow", "5", "--mean-flow", "5")
        self.refused("comes after", "--from", "run", "--to", "mesh")
        self.refused("expected more than", "--step", "0")


class Flow(unittest.TestCase):
    def read(self, text, heart_rate=None):
        with tempfile.TemporaryDirectory() as where:
            path = os.path.join(where, "flow.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            return flow_shapes.read_curve(path, heart_rate)

    def test_curve_of_a_file_is_its_spline_in_ml_per_s(self):
        t = np.linspace(0, 0.8, 17)
        rows = "\n".join(f"{a},{1.2 + 0.6 * np.sin(2 * np.pi * a / 0.8)}" for a in t)
        samples, period = self.read("time (s), flow (l/min)\n" + rows)
        self.assertEqual((period, len(samples)), (800.0, flow_shapes.SAMPLES))
        self.assertAlmostEqual(samples.mean(), 20.0, places=3)
        self.assertAlmostEqual(samples.max(), 30.0, delta=0.01)

    def test_doubtful_curves_are_refused(self):
        rows = [f"{50 * k} {10 + (k % 4)}" for k in range(16)]
        for text, reason in (("\n".join(rows), "closes the beat"), ("0 1\n1 2\n", "five or more"),
                             ("\n".join(f"{0.05 * k} {10 + k % 2}" for k in range(17)), "Are these seconds"),
                             ("\n".join(rows[:5] + ["oops 1"]), "line 6"), ("\n".join(rows[:5] + rows[3:]), "must grow")):
            with self.assertRaisesRegex(BadInput, reason):
                self.read(text)

    def test_beat_begins_at_the_foot_of_its_wave(self):
        for shape in flow_shapes.SHAPES:
            samples, period = flow_shapes.built_in(shape, 50.0, 800.0)
            samples = flow_shapes.foot_first(np.roll(samples, 77))
            self.assertAlmostEqual(samples.mean(), 50.0, places=6, msg=shape)
            rise = samples[:int(np.argmax(samples)) + 1]
            self.assertLess(rise[0], samples.min() + 0.35 * np.ptp(samples), shape)
            self.assertTrue((np.diff(rise[:5]) >= 0).all(), shape)

    def test_spline_is_that_of_a_sine(self):
        t = np.arange(24) * 800.0 / 24
        at = np.linspace(-100, 1000, 57)
        found = flow_shapes.periodic_spline(t, np.sin(2 * np.pi * t / 800), 800.0, at)
        np.testing.assert_allclose(found, np.sin(2 * np.pi * at / 800), atol=1e-4)


class Walls(unittest.TestCase):
    def test_bad_files_are_refused_with_the_key(self):
        key = '<Parameter name="{}" value="{}"/>'
        layer = f'<ParameterList name="Layers"><ParameterList name="w">{key}</ParameterList></ParameterList>'
        top = key + layer.format("c10", 100)
        for text, reason in ((top.format("thicknes", 0.1), 'Did you mean "thickness"'), (top.format("thickness", 0), "positive"),
                             (top.format("shape", "aorte"), 'Did you mean "aorta"'), (layer.format("c1O", 5), 'Did you mean "c10"'),
                             (layer.format("law", "neohookean"), 'Did you mean "neo-hookean"'),
                             (layer.format("c10", "much"), "a number"),
                             ("", "Layers is empty"), ("<", "no valid XML")):
            with tempfile.TemporaryDirectory() as where, self.assertRaisesRegex(BadInput, reason):
                path = os.path.join(where, "wall.xml")
                folder.write_atomically(path, f'<ParameterList name="Wall">{text}</ParameterList>')
                walls.read_file(path)


class Steps(unittest.TestCase):
    def test_beat_has_a_whole_number_of_steps_and_of_outputs(self):
        for period, longest in ((800.0, 5.0), (800.0, 40.0), (857.142857, 5.0), (666.7, 3.0)):
            steps = case_file.steps_of(period, longest)
            self.assertEqual(steps % case_file.FIELDS, 0)
            self.assertLessEqual(period / steps, longest * (1 + 1e-9))
            self.assertLess(period / steps, 1.01 * longest) if longest == 40.0 else None


class Folders(unittest.TestCase):
    def setUp(self):
        self.where = tempfile.TemporaryDirectory()
        self.addCleanup(self.where.cleanup)
        self.last = None
        self.addCleanup(self.close)
        self.path = os.path.join(self.where.name, "case")

    def opened(self, first=None, **changed):
        mine = {name: None for name in options.STAGE_OF}
        found = folder.Folder(self.path, {**mine, "wall": "aorta", "pressure": "120/80", **changed})
        found.accept(first)
        self.close()
        found.begin()
        self.last = found
        return found

    def close(self):
        if self.last:
            self.last.close()

    def finish(self, one, stage, name, text):
        folder.write_atomically(one.file(name), text)
        one.finish(stage, (), (name,), 1.0)

    def test_other_options_are_refused_unless_what_they_change_is_made_anew(self):
        one = self.opened()
        self.finish(one, "wall", "vessel.h5", "wall")
        self.opened(pressure="130/80")  # nothing depends on it yet
        with self.assertRaisesRegex(BadInput, "--wall aorta, not carotid.*--from wall"):
            self.opened(wall="carotid")
        with self.assertRaisesRegex(BadInput, "--from wall"):
            self.opened("tune", wall="carotid")
        self.opened("wall", wall="carotid")

    def test_edited_result_is_kept_and_what_follows_is_made_anew(self):
        one = self.opened()
        self.finish(one, "wall", "wall.json", "{}")
        folder.write_atomically(one.file("windkessels.json"), "{}")
        one.finish("tune", ("wall.json",), ("windkessels.json",), 1.0)
        self.assertTrue(one.is_done("wall", ()) and one.is_done("tune", ("wall.json",)))
        folder.write_atomically(one.file("wall.json"), "{ }")
        self.assertTrue(one.is_done("wall", ()))
        self.assertEqual(one.edited("wall"), ["wall.json"])
        self.assertFalse(one.is_done("tune", ("wall.json",)))

    def test_folder_in_which_another_works_is_refused(self):
        one = self.opened()
        with self.assertRaisesRegex(BadInput, "another tunica-vessel works there"):
            folder.Folder(self.path, one.words).begin()

    def test_foreign_folder_is_left_alone(self):
        os.makedirs(self.path)
        folder.write_atomically(os.path.join(self.path, "thesis.tex"), "")
        with self.assertRaisesRegex(BadInput, "was not made by tunica-vessel"):
            self.opened()


class Branches(unittest.TestCase):
    def test_fork_has_three_branches_of_its_radii(self):
        with tempfile.TemporaryDirectory() as where:
            path = os.path.join(where, "lumen.h5")
            lumen_of(os.path.join(ROOT, "meshes", "bifurcation.h5"), path)
            mesh = Mesh(path)
        openings = [opening_of(mesh, name) for name in ("inlet", "outlet_left", "outlet_right")]
        self.assertLess(max(np.dot(openings[0]["normal"], o["normal"]) for o in openings[1:]), 0)  # all point outward
        found = {(b["start"], b["end"]): b for b in branches.find(mesh, openings, "inlet")}
        self.assertEqual(set(found), {("inlet", "junction-1"), ("junction-1", "outlet_left"), ("junction-1", "outlet_right")})
        for (start, end), branch in found.items():
            by_name = {o["name"]: o["radius"] for o in openings}
            tip = by_name.get(end, by_name.get(start))
            self.assertAlmostEqual(np.median(branch["radii"]) / tip, 1.0, delta=0.15, msg=end)


def lumen_of(source, target):
    """The region fluid of a mesh with a wall, on its own."""
    with h5py.File(source) as file:
        regions, surfaces = ([name.decode() for name in file[key][:]] for key in ("region_names", "surface_names"))
        tets = file["tets"][:][file["tet_region"][:] == regions.index("fluid")]
        kept = [name for name in surfaces if name in ("inlet", "interface") or name.startswith("outlet")]
        triangles = file["triangles"][:]
        of = file["triangle_surface"][:]
        vertices = file["vertices"][:]
    used = np.unique(tets)
    number = np.full(len(vertices), -1)
    number[used] = np.arange(len(used))
    chosen = np.isin(of, [surfaces.index(name) for name in kept])
    with h5py.File(target, "w") as out:
        out.attrs["format"] = np.bytes_("tunica-mesh 1")
        out["vertices"], out["tets"] = vertices[used], number[tets].astype("i4")
        out["tet_region"] = np.zeros(len(tets), dtype="i4")
        out["triangles"] = number[triangles[chosen]].astype("i4")
        out["triangle_surface"] = np.array([kept.index(surfaces[k]) for k in of[chosen]], dtype="i4")
        for kind, names in (("region", ["fluid"]), ("surface", ["lumen_wall" if name == "interface" else name for name in kept])):
            out[kind + "_ids"] = np.arange(1, len(names) + 1, dtype="i4")
            out[kind + "_names"] = np.array(names, dtype="S32")


class Checkpoints(unittest.TestCase):
    def test_file_that_is_not_as_known_is_left_alone(self):
        with tempfile.TemporaryDirectory() as where:
            path = os.path.join(where, "checkpoint-000001.h5")
            with h5py.File(path, "w") as file:
                file["number_names"] = np.array([b"fluid/windkessel at out", b"run/time"])
                file["number_counts"], file["numbers"] = np.array([2, 1], dtype="i4"), np.array([1.0, 2.0, 800.0])
                for name in ("text_names", "texts", "array_names", "array_checksums"):
                    file[name] = np.array([b"x"])
                file["array_columns"], file["head_checksum"] = np.array([1], dtype="i4"), np.array([b"0" * 16])
            self.assertEqual(checkpoint.time_of(path), 800.0)
            self.assertFalse(checkpoint.set_circuits(path, {"out": 3.0}))
            with h5py.File(path, "r+") as file:
                checkpoint.write_strings(file["head_checksum"], [checkpoint.checksum(file)])
            for _ in range(2):
                self.assertTrue(checkpoint.set_circuits(path, {"out": 3.0}))
                with h5py.File(path) as file:
                    self.assertEqual(file["numbers"][:].tolist(), [3.0, 4.0, 800.0])
            self.assertEqual(os.listdir(where), ["checkpoint-000001.h5"])

    def test_hash_is_that_of_its_reference(self):
        self.assertEqual(checkpoint.fnv(b"foobar"), 0x85944171F73967E8)


class Comments(unittest.TestCase):
    def test_comments_of_a_case_have_no_two_hyphens(self):
        out = case_file.Writer("by --flow")
        out.put("x", 1.5, "see --flow my--curve.csv")
        self.assertEqual(out.text().count("--"), 4)


if __name__ == "__main__":
    unittest.main(argv=["test_parts"])
