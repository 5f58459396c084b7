"""The parts of tunica-vessel that need no other program: test_parts.py ROOT FOLDER_OF_PROGRAMS SCRATCH"""
import argparse
import os
import re
import sys
import tempfile
import unittest

import h5py
import numpy as np

from lumens import lumen_of
from vessel import beats, branches, case_file, checkpoint, flow_shapes, folder, lumen, options, plan, run, tune, walls
from vessel.errors import BadInput, NotConverged
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


class Ends(unittest.TestCase):
    def test_ends_that_hold_nothing_across_a_plane_are_warned_of(self):
        def told(*normals):
            return case_file.slide_lines({"openings": [{"normal": normal} for normal in normals]})
        self.assertEqual(told([1, 0, 0], [0, 1, 0], [0, 0, 1]), [])
        self.assertIn("--ends clamped", told([0, 0, -1], [-0.57, 0, 0.82], [0.57, 0, 0.82])[0])
        self.assertIn("--ends clamped", told([0, 0, -1], [0, 0, 1])[0])

    def test_prestress_that_is_not_found_names_the_ends(self):
        with tempfile.TemporaryDirectory() as where:
            one = folder.Folder(where, {})
            folder.write_atomically(one.file(run.LOG), "tunica-fsi: the prestress, at 10 of 10.7 kPa: steps do not get shorter\n")
            for ends, reason in (("slide", "--ends clamped --from case"), ("clamped", "continues from the last checkpoint")):
                with self.assertRaisesRegex(NotConverged, reason):
                    run.check_status(2, one, argparse.Namespace(ends=ends))


class Repetition(unittest.TestCase):
    def test_change_of_the_shear_stress_is_that_of_fields_at_the_same_times(self):
        table = {"step": np.arange(1, 25), "time": 100.0 * np.arange(1, 25), "step_size": np.full(24, 100.0)}
        with tempfile.TemporaryDirectory() as where:
            path = os.path.join(where, "fields.h5")
            with h5py.File(path, "w") as file:
                for step, size in zip((8, 9, 10, 12, 14, 16, 18, 20, 22, 24), (0, 7, 0, 2, 4, 2, 1, 2, 4.2, 2)):
                    file[f"step_{step:06d}/fluid/wall_shear_stress"] = size * np.ones((5, 3))
            self.assertAlmostEqual(beats.shear_change(path, table, 3, 800.0), 0.2 / 4.2)  # the first steps jump
            table["time"][16:] += 7.0  # other times: nothing is compared
            self.assertIsNone(beats.shear_change(path, table, 3, 800.0))
            self.assertIsNone(beats.shear_change(path + "-none", table, 3, 800.0))

    def test_beat_repeats_itself_by_pressure_and_shear(self):
        for change, shear, expected in ((None, None, False), (0.005, None, True), (0.005, 0.02, False), (0.02, 0.005, False),
                                        (0.005, 0.005, True)):
            self.assertEqual(run.is_periodic({"change": change, "shear change": shear}), expected)


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


    def test_refused_surface_leaves_its_picture_and_no_record(self):
        def refuse(_words, _log):
            folder.write_atomically(os.path.join(self.path, "draft-lumen.png"), "picture")
            raise BadInput("two.stl: 2 pieces")
        one = self.opened()
        programs = argparse.Namespace(must=refuse)
        wanted = argparse.Namespace(lumen="two.stl", scale=None, size=None, across=None, layers=None)
        with self.assertRaisesRegex(BadInput, "2 pieces. The place is shown in .*refused.png"):
            lumen.make(one, wanted, programs)
        one.abandon()
        self.assertEqual(os.listdir(self.path), ["refused.png"])
        self.finish(self.opened(), "mesh", "lumen.h5", "")  # another surface may follow
        self.last.abandon()
        self.assertIn("stages.json", os.listdir(self.path))


class Units(unittest.TestCase):
    def check(self, radius, scale=None):
        lumen.check_speed({"name": "in", "radius": radius, "area": np.pi * radius ** 2},
                          argparse.Namespace(lumen="arch.stl", scale=scale, mean_inflow=83.3))

    def test_surface_in_cm_is_refused_unless_its_unit_is_given(self):
        self.check(12.5)
        self.check(1.25, 1.0)
        with self.assertRaisesRegex(BadInput, "at 17 m/s.*--scale 10 converts"):
            self.check(1.25)

    def test_cost_is_that_of_tunica_check(self):
        with open(os.path.join(ROOT, "src", "tunica", "judge", "cost.cpp"), encoding="utf-8") as file:
            theirs = {name: float(value) for name, value in re.findall(r"(\w+) = ([-+.e0-9]+)[,;]", file.read())}
        self.assertEqual((theirs["program"], theirs["seconds_per_tetrahedron"], theirs["shared"]),
                         (plan.MB_OF_PROGRAM, plan.SECONDS_A_TETRAHEDRON, plan.SHARED))
        self.assertAlmostEqual((theirs["per_fluid"] + theirs["per_wall"]) / 2, plan.MB_A_TETRAHEDRON)


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
    def test_every_number_of_a_case_says_where_it_came_from(self):
        outlet = {"split": 1.0, "proximal resistance": 0.1, "capacitance": 500.0, "distal resistance": 1.0, "distal pressure": 0.0,
                  "initial pressure": 10.0, "characteristic impedance": 0.2}
        for kind, more in (("aorta", ["--ends", "slide", "--tissue", "3"]), ("cerebral", [])):
            with tempfile.TemporaryDirectory() as where:
                wanted = options.read("about", [__file__, "--output", where, "--wall", kind, *more])
                one = folder.Folder(where, {})
                folder.write_json(one.file(walls.TABLE), walls.read_wall(wanted))
                folder.write_json(one.file(lumen.TABLE), {"openings": [{"name": "in"}, {"name": "out"}]})
                folder.write_json(one.file(tune.TABLE), {"period": 800.0, "inlet": "in", "inflow": "drawn", "mean flow": 80.0,
                                                         "goal": {"systolic": 16.0, "diastolic": 10.7}, "outlets": {"out": outlet}})
                text = case_file.text_of(one, wanted)
            body = re.sub(r'<ParameterList name="\w+">  <!--.*?</ParameterList>', "", text, flags=re.S)  # said of a list
            bare = [line for line in body.split("\n") if re.search('type="double"|"profile"|"clamped"', line) and "<!--" not in line]
            self.assertEqual(bare, [])
            self.assertEqual(text.count("Olufsen"), 2 if more else 1)
            self.assertEqual(text.count("option tissue"), 1 if more else 0)

    def test_comments_of_a_case_have_no_two_hyphens(self):
        out = case_file.Writer("by --flow")
        out.put("x", 1.5, "see --flow my--curve.csv")
        self.assertEqual(out.text().count("--"), 4)


if __name__ == "__main__":
    unittest.main(argv=["test_parts"])
