"""The tables of a run's budget: test_budget.py PROGRAM"""
import os
import sys
import unittest

PROGRAM = sys.argv[1]
sys.path.insert(0, os.path.dirname(os.path.realpath(PROGRAM)))  # as the program does
from report import budget_tables  # noqa: E402


def record(mass, losses=0.01):
    """Of a run that lost these parts of its mass and its work of 4 kPa mm^3."""
    return {"status": "done",
            "budget": {"mass": [mass * 7, 7.0, mass, 1e-6], "energy": [0.0, 4.0, 0.0, 1e-6], "losses": [4 * losses, 4.0, losses, 0.05]},
            "budget verdicts": {"mass": "mass: solvers lost or gained some of 7 mm^3 that flowed: x, within 1e-06",
                                "energy": "energy: solvers left 0 of 4 kPa mm^3 of work: 0, within 1e-06",
                                "losses": "losses: the scheme took some of 4 kPa mm^3 of work: x, within 0.05"},
            "budget of energy [kPa mm^3]": {"load_power": 3.0, "viscous_power": -1.0, "power_error": 0.0, "energy_change": 2.0}}


class Budget(unittest.TestCase):
    def test_each_total_has_its_verdict(self):
        verdicts, energies = budget_tables.tables(record(1e-9, losses=0.1))
        self.assertEqual([(row[0], row[2], row[4]) for row in verdicts.rows],
                         [("mass", "1.0e-09", "kept"), ("energy", "0.0e+00", "kept"), ("losses", "1.0e-01", "NOT KEPT")])
        self.assertEqual(verdicts.rows[0][1], "solvers lost or gained some of 7 mm^3 that flowed")
        self.assertEqual(energies.rows[0][1:], ["3", "75 %"])

    def test_energies_sum_to_zero_and_nothing_is_left_out(self):
        energies = budget_tables.tables(record(1e-9))[1]
        self.assertEqual([row[0] for row in energies.rows], [budget_tables.TERMS[name] for name in ("load_power", "viscous_power", "energy_change")])
        self.assertEqual(sum(float(row[1]) for row in energies.rows), 0.0)

    def test_only_what_solvers_leave_is_an_alarm(self):
        self.assertEqual(budget_tables.alarm(record(1e-9, losses=0.5)), "")
        self.assertIn("OF MASS (2.0E-06", budget_tables.alarm(record(2e-6)).upper())
        self.assertNotIn("energy", budget_tables.alarm(record(2e-6)))

    def test_total_that_is_no_number_is_an_alarm(self):
        lost = record(1e-9)
        lost["budget"]["mass"][2] = None  # as JSON has it
        self.assertIn("mass (no number", budget_tables.alarm(lost))
        self.assertEqual(budget_tables.tables(lost)[0].rows[0][4], "NOT KEPT")

    def test_run_without_budget_has_no_tables(self):
        self.assertEqual(budget_tables.tables({"status": "done"}), [])
        self.assertEqual(budget_tables.alarm({"status": "done"}), "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
