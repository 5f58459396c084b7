"""The network of tunica-vessel against closed forms: test_network.py ROOT FOLDER_OF_PROGRAMS SCRATCH"""
import unittest

import numpy as np

from vessel import correction, presets, thin_wall, tuning
from vessel.errors import NotConverged
from vessel.network import Branch, Network, Windkessel, beat_of

PERIOD, COUNT = 800.0, 200
TIME = np.arange(COUNT) * PERIOD / COUNT
RIGID = 1e-12  # a branch that is next to nothing
PLAIN = [Branch("in", "out", RIGID, RIGID, RIGID)]


def inflow(mean=80.0):
    """Four harmonics."""
    phase = 2 * np.pi * TIME / PERIOD
    return mean * (1 + np.sin(phase) + 0.5 * np.cos(2 * phase) - 0.3 * np.sin(3 * phase) + 0.1 * np.cos(4 * phase))


class Periodic(unittest.TestCase):
    def test_circuit_of_one_outlet_decays_as_rc(self):
        w = Windkessel(0.01, 500.0, 1.2)
        network = Network(PLAIN, "in", {"out": w})
        for time in (50.0, PERIOD, 3 * PERIOD):
            left = (network.monodromy(time) @ network.settle([1.0]))[network.circuits()][0]
            self.assertAlmostEqual(left, np.exp(-time / (w.distal * w.capacitance)), delta=2e-4)

    def test_windkessel_has_the_impedance_of_its_three_elements(self):
        w = Windkessel(0.05, 700.0, 1.0, 0.4)
        network = Network(PLAIN, "in", {"out": w})
        p = network.periodic(inflow(), PERIOD)[:, network.node["in"]]
        Q, omega = np.fft.rfft(inflow()), 2j * np.pi * np.arange(COUNT // 2 + 1) / PERIOD
        expected = np.fft.irfft(Q * (w.proximal + w.distal / (1 + omega * w.distal * w.capacitance)), COUNT) + w.distal_pressure
        np.testing.assert_allclose(p, expected, rtol=1e-8)

    def test_transient_ends_in_the_periodic_state(self):
        network = Network([Branch("in", "out", 0.02, 0.3, 50.0)], "in", {"out": Windkessel(0.05, 200.0, 1.0)})
        x = network.periodic(inflow(), PERIOD)
        pushed = network.transient(np.zeros(len(x[0])), PERIOD, inflow())[-2]  # from nothing, with all of the inflow
        left = network.monodromy(PERIOD * (COUNT - 1) / COUNT) @ x[0]
        np.testing.assert_allclose(pushed, x[-1] - left, rtol=0.01)

    def test_branch_adds_its_resistance_and_inertance(self):
        branch, w = Branch("in", "out", 0.02, 0.3, RIGID), Windkessel(0.05, 700.0, 1.0)
        network = Network([branch], "in", {"out": w})
        x = network.periodic(inflow(), PERIOD)
        fall = x[:, network.node["in"]] - x[:, network.node["out"]]
        Q, omega = np.fft.rfft(inflow()), 2j * np.pi * np.arange(COUNT // 2 + 1) / PERIOD
        expected = np.fft.irfft(Q * (branch.resistance + omega * branch.inertance), COUNT)
        np.testing.assert_allclose(fall, expected, atol=1e-8)

    def test_mean_flow_divides_by_the_resistances(self):
        network = Network([Branch("in", "a", 0.1, 0.1, 10.0), Branch("in", "b", 0.3, 0.1, 5.0)], "in",
                          {"a": Windkessel(0.1, 300.0, 0.8), "b": Windkessel(0.2, 100.0, 1.5)})
        splits = beat_of(network, network.periodic(inflow(), PERIOD)).splits
        self.assertAlmostEqual(splits["a"], 2.0 / 3.0, places=9)

    def test_loop_of_two_ways_carries_flow_as_parallel_resistances(self):
        ways = [Branch("in", "a", 0.2, 0.1, 1.0), Branch("in", "a", 0.6, 0.1, 1.0)]
        network = Network(ways, "in", {"a": Windkessel(0.1, 300.0, 0.8)})
        x = network.periodic(np.full(COUNT, 10.0), PERIOD)
        self.assertAlmostEqual(x[0, network.node["in"]], 10.0 * (0.15 + 0.9), places=9)


GOAL = tuning.Goal(16.0, 10.67, {"a": 0.7, "b": 0.3})


def problem_of(inlet_flow=None, impedances=(0.09, 0.2)):
    pieces = [Branch("in", "fork", 2e-4, 0.05, 400.0),
              Branch("fork", "a", 5e-4, 0.05, 200.0), Branch("fork", "b", 1e-3, 0.1, 100.0)]
    systole = np.where(TIME < 270, np.sin(np.pi * TIME / 270) ** 2, 0.0)
    flow = systole * 80.0 / systole.mean() if inlet_flow is None else inlet_flow
    return tuning.Problem(pieces, "in", dict(zip("ab", impedances)), flow, PERIOD, 0.08)


class Tuned(unittest.TestCase):
    def test_network_reaches_pressures_and_shares(self):
        windkessels, share = tuning.tune(problem_of(), GOAL)
        beat = beat_of(*tuning.solve(problem_of(), windkessels))
        self.assertAlmostEqual(beat.systolic, 16.0, places=3)
        self.assertAlmostEqual(beat.diastolic, 10.67, places=3)
        self.assertAlmostEqual(beat.splits["a"], 0.7, places=4)
        for name, w in windkessels.items():
            self.assertLessEqual(w.proximal, share * (w.proximal + w.distal) * (1 + 1e-9), name)

    def test_proximal_resistance_is_the_impedance_where_the_pulse_permits(self):
        problem = problem_of(impedances=(0.004, 0.008))
        windkessels, _ = tuning.tune(problem, GOAL)
        self.assertEqual({name: w.proximal for name, w in windkessels.items()}, problem.impedances)

    def test_pulse_that_the_vessel_swallows_is_refused_with_its_size(self):
        with self.assertRaisesRegex(NotConverged, "the largest is about"):
            tuning.tune(problem_of(inflow(2.0)), GOAL)

    def test_murray_divides_what_is_not_given(self):
        openings = [{"name": name, "radius": radius} for name, radius in (("in", 5.0), ("a", 2.0), ("b", 1.0), ("c", 1.0))]
        self.assertEqual(tuning.murray(openings, "in", {}), {"a": 0.8, "b": 0.1, "c": 0.1})
        self.assertEqual(tuning.murray(openings, "in", {"a": 0.5}), {"a": 0.5, "b": 0.25, "c": 0.25})


class Corrected(unittest.TestCase):
    """A network with other losses plays the vessel in three dimensions."""

    def true_beat(self, windkessels, begin):
        pieces = [Branch(p.start, p.end, 8 * p.resistance, 1.3 * p.inertance, 0.8 * p.compliance)
                  for p in problem_of().pieces]
        network = Network(pieces, "in", windkessels)
        x = network.periodic(problem_of().inflow, PERIOD)
        missing = [begin[name] - x[0, network.circuits()][k] for k, name in enumerate(network.outlets)]
        away = network.deviation(missing, PERIOD, COUNT)
        beat = beat_of(network, x + away[:-1], x[0] + away[-1])
        return {"windkessels": windkessels, "circuits begin": begin,
                "measured": {"systolic": beat.systolic, "diastolic": beat.diastolic, "splits": beat.splits,
                             "circuits end": beat.circuits_end}}

    def test_second_corrected_beat_has_the_goals_and_repeats_itself(self):
        problem = problem_of()
        windkessels, share = tuning.tune(problem, GOAL)
        begin = beat_of(*tuning.solve(problem, windkessels)).circuits
        for _ in range(3):
            beat = self.true_beat(windkessels, begin)
            chosen = correction.choose(problem, GOAL, share, beat, 0.002)
            windkessels, begin = chosen.windkessels, chosen.circuits
        last = self.true_beat(windkessels, begin)["measured"]
        self.assertLess(max(map(abs, correction.errors(GOAL, last).values())), 0.002)
        self.assertLess(max(abs(last["circuits end"][name] - begin[name]) for name in begin), 0.01 * 5.33)


class ThinWall(unittest.TestCase):
    def test_neo_hookean_tube_widens_as_its_closed_form(self):
        # s = c (l^2 - l^-2), ds/d ln l = 2 c (l^2 + l^-2)
        layers = {"wall": {"share": 1.0, "keys": {"law": "neo-hookean", "c10": 100.0}}}
        h, p = 0.2, 10.0
        s = p / h / 100.0
        square = 0.5 * (s + np.sqrt(s * s + 4))
        self.assertAlmostEqual(thin_wall.stretch_under(layers, h, p), np.sqrt(square), places=5)
        self.assertAlmostEqual(thin_wall.stiffness(layers, h, p), h * (200.0 * (square + 1 / square) - 2 * p / h), places=2)

    def test_presets_widen_as_their_source_says(self):
        for name, wall in presets.PRESETS.items():
            found = thin_wall.stiffness(wall["layers"], wall["thickness"], 10.67)
            self.assertAlmostEqual(found / presets.olufsen(wall["radius"]), 1.0, delta=0.03, msg=name)


if __name__ == "__main__":
    unittest.main(argv=["test_network"])
