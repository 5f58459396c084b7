"""The tables of a beat in closed form, labels and the page in motion: test_clinical.py PROGRAM SCRATCH_FOLDER"""
import base64
import json
import os
import re
import subprocess
import sys
import unittest

import h5py
import numpy as np
from matplotlib import image

from synthetic_run import (AROUND, CROSS_SECTION, DELAY, INNER, LENGTH, MEAN_FLOW, PERIOD, PULSE, SWING, WIDENING, beat_flow,
                           oriented, rise, tube, write_beats)

PROGRAM, SCRATCH = sys.argv[1], sys.argv[2]
TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.append(TESTS)
from scratch import fresh  # noqa: E402
sys.path.insert(0, os.path.dirname(os.path.realpath(PROGRAM)))  # as the program does
from report import beat as beats  # noqa: E402
from report import clinical, flow_tables, parts, quality_tables, viewer, wall_tables  # noqa: E402
from report.run_data import Run  # noqa: E402
from report.section import Plane  # noqa: E402
from report.surfaces import Surface, area_vectors, boundary  # noqa: E402

LUMEN = AROUND * 2 * INNER * np.sin(np.pi / AROUND) * LENGTH  # area of the polygon's side
STRETCH = (1 + WIDENING) ** 2 - 1  # of the lumen, from diastole to systole


class Tube(unittest.TestCase):
    """Two beats of a tube that widens as a whole."""

    @classmethod
    def setUpClass(cls):
        cls.folder = write_beats(os.path.join(SCRATCH, "tube"))
        goal = {"goal": {"systolic": 120 * 0.133322, "diastolic": 75 * 0.133322}, "splits": {"outlet": 0.8}, "assumed": ["A told assumption."]}
        with open(os.path.join(cls.folder, "vessel.json"), "w", encoding="utf-8") as file:
            json.dump(goal, file)
        cls.run_ = Run(cls.folder)
        cls.clinic = clinical.of_run(cls.run_)
        cls.tables = {table.title: table for table in cls.clinic.tables}

    def row(self, title, first):
        return next(row for row in self.tables[title].rows if row[0] == first)

    def near(self, text, value, part=1e-2):
        self.assertLess(abs(float(text.split()[0]) / value - 1), part, text)

    def test_pressures_are_in_mmhg_against_the_goal(self):
        row = self.row("Pressures", "inlet (in)")
        self.assertEqual(row[1:8], ["120.0", "80.0", "40.0", "100.0", "120/75, pulse 45", "+0.0 %, +6.7 %", "16.00/10.67"])
        drop = 40 * np.sin(np.pi * DELAY / PERIOD)  # two waves of 20 mmHg apart by a delay
        self.near(self.row("Pressures", "outlet")[9], drop)

    def test_flows_are_in_litres_per_minute_with_their_shares(self):
        row = self.row("Flows", "inlet (in)")
        self.assertEqual(row[1:4], ["83.3", "5", f"{MEAN_FLOW * (1 + SWING):.3g}"])
        self.assertEqual(self.row("Flows", "outlet")[2], "5")
        self.assertEqual(self.row("Flows", "outlet")[5:], ["100.0 %", "80.0 %", "+25.0 %"])

    def test_windkessels_are_in_units_of_the_clinic(self):
        self.assertEqual(self.row("Windkessels", "outlet")[1:6], ["1", "9", "0.1", "0.9", "0"])

    def test_waves_have_the_speed_of_their_delay_and_of_bramwell_and_hill(self):
        row = self.row("Pulse wave velocity, from foot to foot", "outlet")
        self.near(row[1], LENGTH, 1e-3)
        self.near(row[2], DELAY)
        self.near(row[3], LENGTH / DELAY)
        row = self.row("Distensibility, and pulse wave velocity from it", "inlet to outlet")
        self.near(row[3], 1000 * STRETCH / 40)
        self.near(row[4], STRETCH / PULSE)
        self.near(row[5], np.sqrt(PULSE / (1.06 * STRETCH)))

    def test_delay_is_that_of_one_pulse_where_the_beat_begins_between_its_feet(self):
        """The steepest rise is a quarter of a beat after its begin."""
        until = round((1.25 * PERIOD + DELAY / 2) / self.run_.steps["time"][0])
        cut = {name: values[:until] for name, values in self.run_.steps.items()}
        table = flow_tables.pulse_waves(beats.Beat(cut, PERIOD), {"outlet": LENGTH})
        self.near(table.rows[0][2], DELAY, 0.1)

    def test_areas_of_low_and_of_turning_shear_stress_are_those_of_linear_fields(self):
        row = self.row("Shear stress at the wall, averaged over time", "inlet to outlet")
        self.near(row[1], LUMEN, 1e-3)
        self.near(row[2], 0.5)  # Pa
        self.near(row[4], 0.4 * LUMEN, 1e-3)
        self.assertEqual((row[5], row[8]), ("40.0 %", "60.0 %"))
        self.near(row[7], 0.6 * LUMEN, 1e-3)
        self.near(row[9], 1.5, 0.02)  # 1/Pa, by rings of points

    def test_peaks_have_their_place_and_time(self):
        row = self.row("Peak shear stress at the wall", "inlet to outlet")
        self.near(row[1], 1.0)
        self.assertEqual((row[2], row[5], row[6].split(", ")[2], row[7]), (f"{PERIOD / 2:g}", "2", f"{LENGTH:g}", f"{PERIOD / 2:g}"))

    def test_strain_and_widening_are_those_of_the_radius(self):
        row = self.row("Displacement and strain of the wall", "inlet to outlet")
        self.near(row[1], WIDENING * INNER)
        self.near(row[2], WIDENING * INNER)
        self.assertEqual((row[4], row[5], row[6]), ("2.00 %",) * 3)

    def test_change_of_the_shear_stress_between_beats_is_seen(self):
        self.near(self.row("Does the beat repeat itself?", "wall shear stress")[1], 10.0, 0.06)
        self.assertLess(float(self.row("Does the beat repeat itself?", "pressure at inlet")[1].split()[0]), 1e-6)

    def test_budgets_close(self):
        self.near(self.row("Budget of mass", "enters")[1], MEAN_FLOW * PERIOD / 1000)
        self.assertLess(abs(float(self.row("Budget of mass", "missing")[1])), 1e-3)
        swing = CROSS_SECTION * LENGTH * STRETCH / 1000
        self.near(self.row("Budget of mass", "the vessel takes up and gives back")[1], swing)
        mean = 80 + 20  # mmHg; both swing together
        power = (mean * MEAN_FLOW + 0.5 * 20 * SWING * MEAN_FLOW) * 0.133322
        self.near(self.row("Budget of energy", "mean power of pressure at inlet, mW")[1], power)
        times = np.linspace(0, PERIOD, 1000, endpoint=False)
        cube_by_square = (beat_flow(times) ** 3 / (CROSS_SECTION * (1 + WIDENING * rise(times)) ** 2) ** 2).mean()
        kinetic = 0.5 * 1.06 * cube_by_square * PERIOD / 1000
        self.near(self.row("Budget of energy", "kinetic energy that flows in at inlet")[1], kinetic)

    def test_quality_and_assumptions_are_told(self):
        row = self.row("Openings", "inlet")
        self.assertEqual((row[1], row[2]), (f"{np.sqrt(CROSS_SECTION / np.pi):.2f}", f"{CROSS_SECTION:.1f}"))
        through = next(row for row in self.tables["Mesh and wall"].rows if row[0].startswith("elements through the wall"))
        self.assertEqual(through[1], "2, 2")
        told = " ".join(self.tables["Assumed"].rows)
        for text in ("A told assumption.", "3.5 mPa s", "at 80 mmHg", "media holzapfel", "flow rate"):
            self.assertIn(text, told)
        self.assertIn("elements across inlet, outlet", " ".join(self.tables["Doubtful"].rows))

    def test_page_in_motion_shows_the_last_beat_with_labels(self):
        name = viewer.write(self.run_, self.clinic, self.clinic.parts.surfaces, self.folder, (1.0, Plane(np.eye(3), 0.0)))
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            text = file.read()
        data = json.loads(re.search(r'type="application/json">(.*?)</script>', text, re.S).group(1))
        self.assertEqual((data["times"][0], data["times"][-1], len(data["times"])), (0.0, PERIOD, 21))
        places = {label["name"]: np.round(label["place"], 6).tolist() for label in data["labels"]}
        self.assertEqual(places, {"inlet": [0, 0, 0], "outlet": [0, 0, LENGTH]})
        lumen = data["surfaces"][1]
        numbers = np.frombuffer(base64.b64decode(lumen["moves"][10]["data"]), "<u2")
        most = lumen["moves"][10]["low"] + numbers.max() / 65535 * (lumen["moves"][10]["high"] - lumen["moves"][10]["low"])
        self.assertAlmostEqual(most, WIDENING * INNER, places=5)

    def test_program_writes_page_summary_and_pdf(self):
        output = os.path.join(SCRATCH, "report")
        image.imsave(os.path.join(self.folder, "lumen.png"), np.zeros((30, 40)))
        done = subprocess.run([PROGRAM, self.folder, "--no-fields", "--pdf", "--output", output], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(os.path.join(output, "index.html"), encoding="utf-8") as file:
            page = file.read()
        for text in ("The beat, in the units of the clinic", "<h3>Windkessels</h3>", "120/75, pulse 45", "beat_pressures.png", 'src="lumen.png"'):
            self.assertIn(text, page)
        with open(os.path.join(output, "summary.md"), encoding="utf-8") as file:
            self.assertIn("| inlet (in) | 120.0 | 80.0 | 40.0 | 100.0 | 120/75, pulse 45 |", file.read())
        with open(os.path.join(output, "report.pdf"), "rb") as file:
            book = file.read()
        self.assertEqual(book[:4], b"%PDF")
        pictures = len([name for name in os.listdir(output) if name.endswith(".png")])
        self.assertGreater(len(re.findall(rb"/Type /Page\b(?!s)", book)), pictures)


class FluidAlone(unittest.TestCase):
    def test_caps_are_where_there_is_no_shear_stress(self):
        """An outlet whose pressure is not known has flow and area."""
        folder = write_beats(os.path.join(SCRATCH, "fluid"))
        with h5py.File(os.path.join(folder, "fields.h5"), "r+") as file:
            points = file["fluid/points"][:]
            is_wall = np.hypot(points[:, 0], points[:, 1]) > INNER - 1e-9
            del file["wall"]
            for step in (name for name in file if name.startswith("step_")):
                del file[f"{step}/wall"]
                file[f"{step}/fluid/time_averaged_wss"][:] = is_wall * 1e-3 * (0.2 + points[:, 2] / LENGTH)
        run = Run(folder)
        run.steps = {name: values for name, values in run.steps.items() if "pressure_outlet" not in name}
        tables = {table.title: table for table in clinical.of_run(run).tables}
        self.assertEqual(tables["Pressures"].rows[1], ["outlet"] + ["–"] * 9)
        row = tables["Shear stress at the wall, averaged over time"].rows[0]
        self.assertEqual((row[0], row[5]), ("inlet to outlet", "20.0 %"))
        self.assertAlmostEqual(float(row[1]) / LUMEN, 1.0, places=3)
        self.assertEqual([row[0] for row in tables["Openings"].rows], ["inlet", "outlet"])
        self.assertNotIn("Distensibility, and pulse wave velocity from it", tables)


class Pieces(unittest.TestCase):
    def test_area_below_and_above_a_level_is_exact(self):
        corners = np.array([[0.0, 1.0, 0.0]])  # x on the unit triangle
        for level, below in ((-0.1, 0.0), (0.5, 0.375), (0.9, 0.495), (1.5, 0.5)):
            self.assertAlmostEqual(parts.area_where([0.5], corners, level, False), below)
            self.assertAlmostEqual(parts.area_where([0.5], corners, level, True), 0.5 - below)
        self.assertAlmostEqual(parts.area_where([1.0], np.array([[0.0, 1.0, 3.0]]), 2.0, False), 1 - 1 / 6)

    def test_foot_of_a_ramp_is_where_it_begins(self):
        times = np.arange(0.0, 801.0, 5.0)
        values = 10 + np.clip((times - 203.0) / 100, 0, 1) - np.clip((times - 400) / 400, 0, 1)
        self.assertAlmostEqual(beats.foot(times, values, 0.0), 203.0, delta=1.5)

    def test_strain_is_that_of_the_longest_direction(self):
        x = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        stretched = x @ np.diag([1.1, 0.9, 1.0])
        self.assertAlmostEqual(wall_tables.strain(x, stretched, np.array([[0, 1, 2]]))[0], 0.1)

    def test_way_through_a_bend_is_that_of_its_axis(self):
        points, tets = tube([1.7, 3.4, INNER], True)
        angle, out = points[:, 2] / 30.0, 30.0 + points[:, 0]
        bent = np.column_stack([out * np.cos(angle), points[:, 1], out * np.sin(angle)])
        faces, _ = boundary(bent, oriented(points, tets))
        side = (np.hypot(points[:, 0], points[:, 1]) > INNER - 1e-9)[faces].all(axis=1) & (np.ptp(points[faces][:, :, 2], axis=1) > 1e-9)
        centres = {"begin": bent[(points == (0, 0, 0)).all(axis=1)][0], "end": bent[np.hypot(points[:, 0], points[:, 1]) < 1e-9][-1]}
        found = parts.way_lengths(bent, tets, Surface(bent, faces[side]), centres)
        self.assertAlmostEqual(found["end"] / LENGTH, 1.0, delta=0.02)

    def test_branches_of_a_fork_have_the_names_of_their_openings(self):
        fork = Fork(os.path.join(os.path.dirname(TESTS), "meshes", "bifurcation.h5"))
        beat = fork.beat()
        found = parts.Parts(fork, beat)
        self.assertEqual({branch.name for branch in found.branches},
                         {"inlet to junction-1", "junction-1 to outlet_left", "junction-1 to outlet_right"})
        for name in beat.openings():
            centre = fork.points[np.unique(fork.cap(name))].mean(axis=0)
            self.assertLess(np.linalg.norm(found.ends[name].points.mean(axis=0) - centre), 1e-9, name)
            self.assertIn(name, found.branch_at(centre))
        self.assertTrue((found.of_triangle >= 0).all())
        self.assertEqual(sum(len(branch.tets) for branch in found.branches), len(fork.tets))

    def test_elements_through_a_wall_are_counted(self):
        points, tets = tube([INNER, 5.4, 5.8, 6.2], False)
        radius = np.hypot(points[:, 0], points[:, 1])
        inner, outer = np.flatnonzero(radius < INNER + 1e-9), np.flatnonzero(radius > 6.2 - 1e-9)
        self.assertEqual(set(quality_tables.layers_through(points, tets, inner, outer)), {3})

    def test_thinned_surface_has_nearly_its_area(self):
        points, tets = tube([1.7, 3.4, INNER], True)
        faces, _ = boundary(points, oriented(points, tets))
        part = Surface(points, faces)
        thin = viewer.Thinned(part, len(part.nodes) // 3)
        self.assertLessEqual(len(thin.nodes), len(part.nodes) // 3)
        self.assertTrue(np.allclose(thin.points, points[thin.nodes]))
        area = lambda s: np.linalg.norm(area_vectors(s.points, s.triangles), axis=1).sum()  # noqa: E731
        self.assertAlmostEqual(area(thin) / area(part), 1.0, delta=0.1)

    def test_labels_of_the_page_do_not_overlap(self):
        with open(os.path.join(os.path.dirname(os.path.realpath(PROGRAM)), "report", "viewer.html"), encoding="utf-8") as file:
            function = file.read().split("// --- labels ---")[1].split("// --- end of labels ---")[0]
        random = np.random.default_rng(7)
        for width, height, count in ((900, 500, 12), (400, 300, 8), (120, 60, 6)):
            anchors = np.column_stack([random.normal(width / 2, 30, count), random.normal(height / 2, 20, count)]).tolist()
            sizes, taken = [[70, 18]] * count, [[width - 60, 5, 55, 50]]
            script = f"{function}\nprint(JSON.stringify(labelPlaces({anchors}, {sizes}, {taken}, {width}, {height})));"
            path = os.path.join(SCRATCH, "labels.js")
            with open(path, "w", encoding="utf-8") as file:
                file.write(script)
            found = json.loads(subprocess.run(["duk", path], capture_output=True, text=True, check=True).stdout)
            boxes = [box for box in found if box] + taken
            if width > 200:
                self.assertEqual(len(boxes), count + 1)
            for k, (x, y, w, h) in enumerate(boxes):
                self.assertTrue(0 <= x and x + w <= width and 0 <= y and y + h <= height)
                for u, v, a, b in boxes[:k]:
                    self.assertTrue(x + w <= u or u + a <= x or y + h <= v or v + b <= y)


class Fork:
    """A run of one output with the mesh of a fork, and pressure and flow by which its openings are told apart."""

    names = ("inlet", "outlet_left", "outlet_right")

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points, tets, region = file["vertices"][:], file["tets"][:].astype(int), file["tet_region"][:]
            regions, surfaces = ([n.decode() for n in file[key][:]] for key in ("region_names", "surface_names"))
            triangles, of = file["triangles"][:].astype(int), file["triangle_surface"][:]
        self.tets = tets[region == regions.index("fluid")]
        self.meshes = {"fluid": (self.points, self.tets), "wall": (self.points, tets[region != regions.index("fluid")])}
        self.caps = {name: triangles[of == surfaces.index(name)] for name in self.names}
        self.outputs = [(800.0, "step_000001")]

    def grids(self):
        return list(self.meshes)

    def mesh(self, grid):
        return self.meshes[grid]

    def displacement(self, group, grid):
        return np.zeros_like(self.points)

    def nodal(self, group, grid, name):
        if name == "pressure":
            return self.points @ (0.01, 0.02, -0.03)
        return np.outer(self.points @ (0.3, 0.2, 0.5), [0.1, 0.2, 0.3])

    def cap(self, name):
        return self.caps[name]

    def beat(self):
        """Made of the caps by their names, as steps.csv has them; the largest flow is made to enter at the inlet."""
        steps = {"time": [200.0, 400.0, 600.0, 800.0]}
        for name, cap in self.caps.items():
            vectors = area_vectors(self.points, cap)
            sizes = np.linalg.norm(vectors, axis=1)
            pressure = self.nodal("", "fluid", "pressure")[cap].mean(axis=1)
            steps[f"area_{name}_mm2"] = [sizes.sum()] * 4
            steps[f"mean_pressure_{name}_kPa"] = [np.average(pressure, weights=sizes)] * 4
            steps[f"inflow_{name}_mm3_per_ms"] = [1.0 if name == "inlet" else -0.5] * 4
        return beats.Beat(steps, 800.0)


if __name__ == "__main__":
    fresh(SCRATCH)
    unittest.main(argv=sys.argv[:1])
