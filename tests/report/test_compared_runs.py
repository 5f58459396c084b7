"""tunica-report on several ordinary runs: test_compared_runs.py PROGRAM SCRATCH_FOLDER"""
import csv
import os
import re
import sys
import unittest

from synthetic_run import write_case, write_run

SCRATCH = sys.argv[2]
from program import report, started  # noqa: E402
from scratch import fresh  # noqa: E402

COLUMN = "max_displacement_wall_mm"


def scaled(run, factor, every=1):
    """The run with larger displacements, and with fewer steps."""
    path = os.path.join(run, "steps.csv")
    with open(path, newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    place = heading.index(COLUMN)
    for row in rows:
        row[place] = float(row[place]) * factor
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([heading, *rows[::every]])
    return run


def cells(page, first):
    """Of the row of a table that begins with that."""
    row = re.search(rf"<tr><td>{re.escape(first)}</td>(.*?)</tr>", page)[1]
    return re.findall(r"<td>(.*?)</td>", row)


class ComparedRuns(unittest.TestCase):
    def folder(self, *names):
        return os.path.join(SCRATCH, *names)

    def page(self, folder):
        with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
            return file.read()

    def test_curves_of_runs_are_on_one_page_that_leaves_their_reports_alone(self):
        runs = [write_run(self.folder(name)) for name in ("one", "two")]
        result = started(*runs)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue(os.path.getsize(os.path.join(runs[0], "comparison", "curves.png")) > 10000)
        self.assertFalse(os.path.exists(os.path.join(runs[0], "report")))
        page = self.page(os.path.join(runs[0], "comparison"))
        self.assertEqual(cells(page, "inflow inlet [mm³/ms]")[-1], "0")
        self.assertIn("None of those", page)

    def test_distance_is_in_parts_of_the_range_of_the_first_run(self):
        first, second = write_run(self.folder("first")), scaled(write_run(self.folder("second")), 2.0)
        output = self.folder("out")
        self.assertEqual(report(first, second, "--output", output).returncode, 0)
        page = self.page(output)
        one, two, apart = map(float, cells(page, "max displacement wall [mm]"))
        self.assertAlmostEqual(two, 2 * one, delta=1e-3 * two)
        self.assertGreater(apart, 600)  # 0.12 + 0.01 sin s: the largest value is 6.5 times the range
        self.assertLess(apart, 660)

    def test_runs_of_other_steps_and_three_of_one_name_are_compared(self):
        runs = [write_run(self.folder(str(k), "same"), steps=24 - 4 * k) for k in range(3)]
        scaled(runs[1], 1.0, every=2)
        self.assertEqual(report(*runs).returncode, 0)
        page = self.page(os.path.join(runs[0], "comparison"))
        self.assertIn("at 8 ms", page)  # the shortest has 16 steps of 0.5 ms
        self.assertEqual(len(cells(page, "max displacement wall [mm]")), 5)

    def test_parameters_that_differ_are_named(self):
        runs = [write_run(self.folder(name)) for name in ("slow", "fast")]
        for run, period in zip(runs, (8, 4)):
            write_case(os.path.join(run, "case.xml"), period)
        self.assertEqual(report(*runs).returncode, 0)
        page = self.page(os.path.join(runs[0], "comparison"))
        self.assertEqual(cells(page, "Fluid / Surfaces / inlet / Amplitude / period"), ["8", "4"])
        self.assertNotIn("viscosity", page)

    def test_what_does_not_compare_is_one_line_and_status_1(self):
        run, empty = write_run(self.folder("some")), write_run(self.folder("none"), steps=0)
        for words, text in (((run, empty), "no finished step"), ((run, self.folder("nowhere")), "is not a folder"),
                            ((run, run, "--step", "1"), "--step does not fit several runs"),
                            ((run, run, "--vtu"), "--vtu does not fit several runs")):
            with self.subTest(words=words):
                result = report(*words)
                self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
                self.assertIn(text, result.stderr)


if __name__ == "__main__":
    fresh(SCRATCH)
    unittest.main(argv=sys.argv[:1])
