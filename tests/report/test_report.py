"""tunica-report on synthetic runs: test_report.py PROGRAM SCRATCH_FOLDER"""
import base64
import json
import os
import re
import sys
import unittest
from types import SimpleNamespace

import h5py
import numpy as np
from matplotlib import image

from synthetic_run import add_recovered_stress, write_case, write_run, write_solver_run

SCRATCH = sys.argv[2]
from program import report, started  # noqa: E402
from scratch import fresh  # noqa: E402
from report.case_tables import openings  # noqa: E402
from report.page import linear_solvers  # noqa: E402
from report.run_data import Run  # noqa: E402
from report.section import chosen_plane, fitted_plane, name_of_axis, section_axes  # noqa: E402

IN_SPACE = {"vessel.html"} | {f"space_{name}.png" for name in ("displacement", "von_mises", "pressure", "velocity")}
NO_VTK = "class=\"remark\">Pictures in space are drawn by Matplotlib"  # where it is not installed
TABLES = {"curves.png", "coupling.png", "iterations.png", "newton.png", "observables.png"}
ALL = IN_SPACE | TABLES | {"section_velocity.png", "section_pressure.png", "radial_displacement.png"}
OF_WALL = {"vessel.html", "space_displacement.png", "space_von_mises.png", "section_wall.png", "radial_displacement.png",
           "curves.png", "iterations.png", "newton.png", "observables.png"}
SOLVERS = {"newton.png", "krylov_fluid.png", "krylov_wall.png"}


def box(*sizes):
    """Points of a grid about the origin."""
    return np.array(np.meshgrid(*[np.linspace(-s, s, 5) for s in sizes])).reshape(3, -1).T


class SectionPlane(unittest.TestCase):
    def test_round_vessel_is_cut_across_x(self):
        self.assertTrue(np.allclose(section_axes(box(1, 1, 9)), np.eye(3)[[0, 1, 2]]))

    def test_flat_vessel_is_cut_where_it_shows_most(self):
        axes = section_axes(box(5, 1, 9))
        self.assertTrue(np.allclose(axes, np.eye(3)[[1, 0, 2]]))
        self.assertEqual([name_of_axis(axes[k], "along") for k in (1, 2)], ["x", "z"])

    def test_vessel_across_the_axes_is_followed(self):
        turn = np.array([[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]])
        axes = section_axes(box(1, 4, 9) @ turn.T + (50, 0, 0))
        self.assertTrue(np.allclose(axes[2], turn @ (0, 0, 1)))
        self.assertTrue(np.allclose(abs(axes[0] @ turn @ (1, 0, 0)), 1))
        self.assertEqual(name_of_axis(axes[2], "along"), "along")

    def test_plane_is_that_of_symmetry_or_the_middle(self):
        def tube(end):
            angle = np.linspace(-end, end, 25)
            circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
            return (circle[:, None] + np.linspace(-9, 9, 10)[:, None] * (0, 0, 1)).reshape(-1, 3)
        half = tube(np.pi / 2)
        for shift in (0, 0.5, 50):
            line = np.array([(shift + 0.4, 0, -9), (shift + 0.4, 0, 9)])
            self.assertAlmostEqual(fitted_plane(half + (shift, 0, 0), line).level, shift, places=4)
        points = tube(np.pi)
        for shift, level in ((0, 0), (0.01, 0), (0.5, 0.5), (1, 1), (50, 50), (-50, -50)):
            line = np.array([(shift, 0, -9), (shift, 0, 9)])
            self.assertAlmostEqual(fitted_plane(points + (shift, 0, 0), line).level, level, places=4)
            across = chosen_plane(points + (shift, 0, 0), line, np.array([0, 0, 1.0]))
            self.assertAlmostEqual(across.level, 0)

    def test_plane_follows_the_centreline_where_it_bends(self):
        t = np.linspace(0, np.pi / 2, 30)
        line = np.stack([0 * t, 9 * np.sin(t), 9 * np.cos(t)], axis=1)
        line[:, 0] = 5 + line[:, 1] / 3
        points = (line[:, None] + box(1, 1, 1)[None]).reshape(-1, 3)
        plane = fitted_plane(points, line)
        normal = np.array([1, -1 / 3, 0]) / np.linalg.norm([1, -1 / 3, 0])
        self.assertAlmostEqual(abs(plane.axes[0] @ normal), 1, places=6)
        self.assertTrue(np.allclose(line @ plane.axes[0], plane.level))

    def test_plane_is_the_one_that_is_chosen(self):
        points, line = box(1, 4, 9), np.array([(0.5, 0, -9), (0.5, 0, 9)])
        plane = chosen_plane(points, line, np.array([2.0, 0, 0]))
        self.assertTrue(np.allclose(plane.axes, np.eye(3)))
        self.assertAlmostEqual(plane.level, 0.5)
        plane = chosen_plane(points, line, np.array([0, 0, 3.0]), -2.0)
        self.assertTrue(np.allclose(plane.axes[[0, 2]], np.eye(3)[[2, 1]]))
        self.assertEqual(plane.level, -2.0)


class FlowSplit(unittest.TestCase):
    def test_shares_are_of_the_last_cycle(self):
        t = np.linspace(0, 16, 161)
        beat = np.where(t < 8, 5.0, 1.0) + np.sin(2 * np.pi * t / 8)  # mean 1 over the second cycle, from 8 to 16
        steps = {"time": list(t), "inflow_in_mm3_per_ms": list(beat), "inflow_out_left_mm3_per_ms": list(-0.75 * beat),
                 "inflow_out_right_mm3_per_ms": list(-0.25 * beat), "mean_pressure_in_kPa": list(10 + np.sin(2 * np.pi * t / 8))}
        begin, rows = openings(steps, 8.0)
        self.assertAlmostEqual(begin, 8.0)
        self.assertEqual([row[0] for row in rows], ["in", "out left", "out right"])
        self.assertTrue(np.allclose([row[1] for row in rows], (1, -0.75, -0.25), atol=1e-9))
        self.assertTrue(np.isnan(rows[0][2]))
        self.assertTrue(np.allclose([row[2] for row in rows[1:]], (0.75, 0.25)))
        self.assertTrue(np.allclose(rows[0][3:], (10, 9, 11)))
        self.assertAlmostEqual(openings(steps, None)[0], 0.0)


class LinearSolvers(unittest.TestCase):
    def test_each_preconditioner_has_a_row(self):
        table = {"step": [1.0] * 4, "field": ["wall"] * 4, "method": ["GCR"] * 4,
                 "preconditioner": ["multigrid", "vanka", "vanka", "direct"], "iterations": [30.0, 40.0, 44.0, 1.0],
                 "setup_seconds": [1.0, 2.0, 0.0, 8.0], "solve_seconds": [1.0] * 4, "converged": [0.0, 1.0, 0.0, 1.0]}
        rows = linear_solvers(SimpleNamespace(linear=table)).split("<tr>")[2:]
        cells = [re.findall("<td>(.*?)</td>", row) for row in rows]
        self.assertEqual([row[2:4] for row in cells], [["multigrid", "1"], ["vanka", "2"], ["direct", "1"]])
        self.assertEqual([float(row[4]) for row in cells], [30, 42, 1])  # iterations, in the mean
        self.assertEqual([row[-1] for row in cells], ["1", "1", "0"])  # not converged
        del table["preconditioner"]  # as runs of earlier versions have it
        self.assertEqual(linear_solvers(SimpleNamespace(linear=table)).count("<tr>"), 2)


class Report(unittest.TestCase):
    def folder(self, name):
        return os.path.join(SCRATCH, name)

    def expect_page(self, folder, figures):
        with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
            page = file.read()
        links = set(re.findall(r'(?:src|href)="([^"]+)"', page))
        self.assertEqual(links, figures)
        for name in links - {"vessel.html"}:
            self.expect_picture(os.path.join(folder, name))
        return page

    def expect_picture(self, path):
        pixels = image.imread(path)[:, :, :3]
        self.assertGreater(min(pixels.shape[:2]), 300, path)
        self.assertGreater((pixels.min(axis=2) < 0.9).mean(), 0.005, path)  # not blank
        self.assertGreater(pixels.std(), 0.03, path)

    def expect_one_line(self, folder, text, *options):
        result = report(folder, *options)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(text, result.stderr)

    def test_coupled_run_gives_every_figure(self):
        run = write_run(self.folder("coupled"))
        result = report(run)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = self.expect_page(os.path.join(run, "report"), ALL)
        for text in ("1.90", "GMRES", "assembly", "coupling iteration", "Open MPI"):
            self.assertIn(text, page)
        self.assertNotIn("class=\"remark\"", page.replace(NO_VTK, ""))
        self.expect_viewer(run)

    def expect_viewer(self, run):
        """One file with all in it."""
        with open(os.path.join(run, "report", "vessel.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(re.findall(r"(?:src|href)=", text), [])
        data = json.loads(re.search(r'type="application/json">(.*?)</script>', text, re.S).group(1))
        self.assertEqual([s["name"] for s in data["surfaces"]], ["wall", "lumen"])
        self.assertEqual(data["times"], [0, 2, 4, 6, 8, 10, 12])
        for surface in data["surfaces"]:
            numbers = np.frombuffer(base64.b64decode(surface["points"]["data"]), "<u2")
            triangles = np.frombuffer(base64.b64decode(surface["triangles"]), "<u4")
            self.assertEqual(triangles.max(), len(numbers) // 3 - 1)
            self.assertEqual(len(surface["moves"]), 7)
        labels = [field["label"] for field in data["surfaces"][0]["fields"]]
        self.assertEqual(labels, ["displacement [mm]", "von Mises stress [kPa]"])

    def test_without_display_matplotlib_draws_and_the_page_says_so(self):
        """Of a run of one step, too, which has one output to show."""
        run = write_run(self.folder("no_display"), steps=1)
        result = started(run, PATH="/nowhere")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with open(os.path.join(run, "report", "index.html"), encoding="utf-8") as file:
            self.assertIn("drawn by Matplotlib", file.read())
        pictures = IN_SPACE - {"vessel.html"}
        self.assertEqual(pictures & set(os.listdir(os.path.join(run, "report"))), pictures)
        for name in pictures:
            self.expect_picture(os.path.join(run, "report", name))

    def test_options_and_further_arrays_of_the_fluid_are_shown(self):
        """All that is chosen by options, in one page: times, step, factor, plane and folder."""
        run = write_run(self.folder("further"), stress_at_cells=True)
        output = self.folder("elsewhere")
        write_case(os.path.join(run, "case.xml"), period=400)
        with h5py.File(os.path.join(run, "fields.h5"), "a") as file:
            for step in (s for s in file if s.startswith("step_")):
                points = file["fluid/points"][:]
                file[f"{step}/fluid/wall_shear_stress"] = 0.002 * points[:, [1, 0, 2]]
                file[f"{step}/fluid/my_number"] = points[:, 2]
                file[f"{step}/fluid/time_averaged_wss"] = 0.002 + 0 * points[:, 2]
        result = report(run, "--plane", "y", "--times", "4,8.3", "--step", "5", "--magnify", "3", "--output", output)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = self.expect_page(output, ALL | {f"space_{name}.png" for name in (
            "wall_shear_stress", "my_number", "time_averaged_wss")})
        for text in ("magnified 3 times", "step 5", "Wall shear stress on the interface", "My number on the interface",
                     "at the last output shown; from two sides. It is averaged from 0 to 8 ms, less than one period of 400 ms"):
            self.assertIn(text, page)

    def test_case_and_periodicity_are_tables(self):
        run = write_run(self.folder("periodic"))
        write_case(os.path.join(run, "case.xml"), period=4)
        self.assertEqual(report(run, "--no-fields").returncode, 0)
        page = self.expect_page(os.path.join(run, "report"), TABLES)
        for text in ("Flow split", "<td>inlet</td>", "Has it become periodic?", "inflow inlet [mm³/ms]", "viscosity", "iterations of each step"):
            self.assertIn(text, page)

    def test_killed_run_gives_what_it_has_left(self):
        """Of a fluid alone, whose figures are those that make sense."""
        run = write_run(self.folder("killed"), grids=("fluid",))
        with open(os.path.join(run, "run.json"), "w", encoding="utf-8") as file:
            json.dump({"program": "tunica-fsi", "status": "running", "ranks": 4}, file)
        with open(os.path.join(run, "steps.csv"), "a", encoding="utf-8") as file:
            file.write("25,12.5,1,7")  # the row that was being written
        with h5py.File(os.path.join(run, "fields.h5"), "a") as file:
            told = "".join(f"fields.h5:/{s}/fluid/velocity\n" for s in file if s.startswith("step_"))
            file.create_group("step_000028").attrs["time"] = 14.0
            file["step_000028/fluid/velocity"] = np.zeros((3, 3))
            file.create_group("step_000032")
        with open(os.path.join(run, "fields.xdmf"), "w", encoding="utf-8") as file:
            file.write(told)
        result = report(run)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = self.expect_page(os.path.join(run, "report"),
                                {"vessel.html", "space_pressure.png", "space_velocity.png", "section_velocity.png",
                                 "section_pressure.png", "curves.png", "iterations.png", "newton.png", "observables.png"})
        self.assertIn("going on, or was killed", page)
        self.assertIn("24 steps · t = 12 ms", page)
        before = len(Run(run).outputs)
        with h5py.File(os.path.join(run, "fields.h5"), "a") as file:  # finished, but the XDMF lags behind
            file["step_000036/fluid/velocity"] = np.zeros((3, 3))
            file["step_000036/fluid/velocity"].attrs["centre"] = "node"
            file["step_000036"].attrs["time"] = 18.0
        self.assertEqual([name for _, name in Run(run).outputs][before:], ["step_000036"])

    def test_what_is_missing_is_a_remark(self):
        cases = [({"run.json": "{\"status\":", "newton.csv": None, "fields.h5": None},
                  ("not valid JSON", "newton.csv is missing", "fields.h5 is missing"), TABLES - {"newton.png"}),
                 ({"coupling.csv": "", "fields.h5": "no HDF5"}, ("coupling.csv is empty", "not a readable HDF5"),
                  TABLES - {"coupling.png"}),
                 ({"steps.csv": "step,time\n"}, ("has not finished a step",), None),
                 ({"steps.csv": ""}, ("steps.csv is empty",), None)]
        for i, (damage, texts, figures) in enumerate(cases):
            with self.subTest(damage=damage):
                run = write_run(self.folder(f"partial{i}"))
                for name, content in damage.items():
                    self.put(run, name, content)
                result = report(run, *([] if "fields.h5" in damage else ["--no-fields"]))  # their figures take long
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                with open(os.path.join(run, "report", "index.html"), encoding="utf-8") as file:
                    page = file.read()
                for text in texts:
                    self.assertIn(text, page)
                if figures is not None:
                    self.expect_page(os.path.join(run, "report"), figures)

    @staticmethod
    def put(run, name, content):
        os.remove(os.path.join(run, name))
        if content is not None:
            with open(os.path.join(run, name), "w", encoding="utf-8") as file:
                file.write(content)

    def test_recovered_stress_has_a_table_and_pictures(self):
        run = write_run(self.folder("recovered"), grids=("wall",), stress_at_cells=True)
        add_recovered_stress(run)
        self.assertEqual(report(run, "--times", "12").returncode, 0)
        more = {"space_largest_principal_stress.png", "space_stress_error.png"}
        page = self.expect_page(os.path.join(run, "report"), more | OF_WALL)
        rows = [re.findall(r"<td>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", page, re.S)]
        first = next(row for row in rows if row[:2] == ["far", "largest principal stress"])
        self.assertEqual((first[3], first[4].split(", ")[2], first[6]), ("6", "50", "4"))
        self.assertGreater(float(first[2]), 5.9)  # 99 % of 25 to 50 mm, by halves of a slice of 1.25 mm
        for row in (["near", "25.0 %"], ["far", "5.0 %"]):
            self.assertIn(row, rows)

    def test_wall_alone_gives_the_figures_that_make_sense(self):
        wall = write_run(self.folder("wall"), grids=("wall",))
        self.assertEqual(report(wall, "--times", "4,12").returncode, 0)
        self.expect_page(os.path.join(wall, "report"), OF_WALL)

    def test_bad_folder_is_one_line_and_status_1(self):
        self.expect_one_line(self.folder("nowhere"), "is not a folder")
        os.makedirs(self.folder("empty"))
        self.expect_one_line(self.folder("empty"), "run.json is missing")

    def test_bad_file_is_one_line_and_status_1(self):
        cases = [("run.json", None, "run.json is missing"), ("linear.csv", "a,b\n", "the first column")]
        for i, (name, content, text) in enumerate(cases):
            with self.subTest(name=name, content=content):
                run = write_run(self.folder(f"bad{i}"))
                self.put(run, name, content)
                self.expect_one_line(run, text)

    def test_bad_option_is_one_line_and_status_1(self):
        run = write_run(self.folder("bad_options"))
        self.expect_one_line(run, "--times", "--times", "a,b")
        self.expect_one_line(run, "--step 99", "--step", "99")
        self.expect_one_line(run, "--magnify", "--magnify", "-1")
        self.expect_one_line(run, "--plane w: expected x, y, z", "--plane", "w")
        self.expect_one_line(run, "--plane 0,0,0: expected", "--plane", "0,0,0")
        self.expect_one_line(run, "is beside the vessel, which reaches from -6.2", "--plane", "x=50")
        self.expect_one_line(run, "unknown option", "--unknown")
        self.expect_one_line(run, "cannot write", "--output", os.path.join(run, "run.json"))

    def test_paper_stands_beside_what_was_run(self):
        paper = self.folder("paper")
        for mesh, items in (("coarse", ("pulse-artery-aitken", "newton-mooney-rivlin-increment", "speed")),
                            ("fine", ("pulse-artery-iqn-ils",))):
            for item in items:
                run = write_run(os.path.join(paper, mesh, item))
                with open(os.path.join(run, "item.json"), "w", encoding="utf-8") as file:
                    json.dump({"commit": "0123456789abcdef", "processor": "A Processor"}, file)
        write_solver_run(os.path.join(paper, "coarse", "krylov-fluid"), fields=("fluid",))
        os.makedirs(os.path.join(paper, "fine", "amg-artery"))  # has just begun
        result = report("--paper", paper)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with open(os.path.join(paper, "report", "RESULTS.md"), encoding="utf-8") as file:
            page = file.read()
        # One of the 24 steps did not converge.
        for text in ("| 2 | 6.2e-03 | 1.8e-03 | 1 | 1.8e-04 | 8.1e-07 | 13 |", "| artery | Aitken | coarse | 23 of 72 |",
                     "| artery | IQN-ILS | fine |", "paper P_L, BiCGStab", "0123456789 | A Processor"):
            self.assertIn(text, page)
        images = re.findall(r"!\[[^]]*\]\(([^)]+)\)", page)
        self.assertEqual(set(images), {"figures/" + name for name in (
            "coupling-counts.png", "coupling-artery.png", "state-artery.png", "newton-krylov-fluid.png",
            "krylov-fluid.png")})
        for name in images:
            self.assertTrue(os.path.exists(os.path.join(paper, "report", name)), name)

    def test_paper_without_runs_is_one_line_and_status_1(self):
        os.makedirs(self.folder("no_paper"))
        self.expect_one_line(self.folder("no_paper"), "holds no run", "--paper")
        self.expect_one_line(self.folder("no_paper"), "--step does not fit", "--paper", "--step", "2")

    def test_solvers_give_newton_and_krylov_figures(self):
        run = write_solver_run(self.folder("solvers"))
        result = report(run)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = self.expect_page(os.path.join(run, "report"), SOLVERS)
        for text in ("step 1, coupling iteration 2", "paper P_L, BiCGStab", "200 (cap)", "9,072 unknowns, 2 ranks"):
            self.assertIn(text, page)

    def test_solvers_of_coupled_and_foreign_systems_have_figures(self):
        coupled = write_solver_run(self.folder("coupled_solvers"), fields=("system",))
        self.assertEqual(report(coupled).stderr, "")
        self.expect_page(os.path.join(coupled, "report"), {"newton.png", "krylov_system.png"})
        foreign = write_solver_run(self.folder("foreign_solvers"), fields=("system",))
        os.remove(os.path.join(foreign, "newton.csv"))
        path = os.path.join(foreign, "solvers.json")
        with open(path, encoding="utf-8") as file:
            choice = json.load(file)
        del choice["step"], choice["coupling iteration"]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(choice, file)
        self.assertEqual(report(foreign).stderr, "")
        self.expect_page(os.path.join(foreign, "report"), {"krylov_system.png"})

    def test_solvers_of_several_folders_stand_side_by_side(self):
        coarse = write_solver_run(self.folder("coarse"))
        fine = write_solver_run(self.folder("fine"), unknowns=60500, growth=3, fields=("fluid",))
        same = write_solver_run(self.folder("same_mesh"))
        result = report(coarse, fine, same)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = self.expect_page(os.path.join(coarse, "report"), SOLVERS)
        for text in ("9,072 unknowns", "60,500 unknowns", "coarse", "same_mesh", ">84<"):
            self.assertIn(text, page)
        width = {n: image.imread(os.path.join(coarse, "report", f"krylov_{n}.png")).shape[1] for n in ("fluid", "wall")}
        self.assertGreater(width["fluid"], 1.2 * width["wall"])  # three panels and two
        result = report(fine)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.expect_page(os.path.join(fine, "report"), SOLVERS - {"krylov_wall.png"})

    def test_folders_that_do_not_compare_are_one_line_and_status_1(self):
        solvers, run = write_solver_run(self.folder("some_solvers")), write_run(self.folder("no_solvers"))
        other = write_solver_run(self.folder("other_iteration"), coupling_iteration=1)
        self.expect_one_line(solvers, "no solvers.csv", run)
        self.expect_one_line(run, "no solvers.csv", solvers)
        self.expect_one_line(solvers, "is not a folder", self.folder("nowhere"))
        self.expect_one_line(solvers, "expected the same", other)
        self.expect_one_line(solvers, "--step does not fit", "--step", "1")
        with open(os.path.join(other, "solvers.csv"), "w", encoding="utf-8") as file:
            file.write("field,newton_step\n")
        self.expect_one_line(other, "has no rows")
        os.remove(os.path.join(solvers, "newton.csv"))
        self.expect_one_line(solvers, "newton.csv is missing")


if __name__ == "__main__":
    fresh(SCRATCH)
    unittest.main(argv=sys.argv[:1])
