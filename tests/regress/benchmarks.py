"""xml/benchmarks on its coarse meshes: what the reference values are missed by there, and that this falls. By day in
larger and fewer steps in time than on the page: what the meshes do is more.

Usage: benchmarks.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import argparse
import math
import pathlib
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

from runs import LONG, ROOT, Verdict, fresh

REPRODUCE = ROOT / "xml" / "benchmarks" / "reproduce"


def program():
    loader = SourceFileLoader("reproduce", str(REPRODUCE))
    module = module_from_spec(spec_from_loader("reproduce", loader))
    loader.exec_module(module)
    return module


def in_fewer_steps(benchmark, step_size, steps):
    settings = benchmark.settings
    benchmark.settings = lambda *of: {**settings(*of), "Time/step size": step_size, "Time/steps": steps}


def check_channel(verdict, reproduce, wanted):
    """Its wall alone, of second order, and as it swings."""
    channel = reproduce.CollapsibleChannel(wanted)
    channel.variants_of = lambda _: channel.variants
    if not LONG:
        settings = channel.settings
        longer = {"Time/step size": 25, "Time/steps": 40}
        channel.settings = lambda level, variant: {**settings(level, variant), **({} if variant else longer)}
        channel.levels = [0.5]
    channel.run()
    coarse, fine = channel.levels[0], 2 * channel.levels[0]
    channel.run_one(fine, "static")
    within(verdict, channel, coarse, {"static, ½": 0.04, "static, ¼": 0.07, "time": 0.02, "trough": 0.04, "": 0.1} if LONG else
           {"static, ¼": 0.26, "time": 0.04, "": 0.17})
    one, two = (abs(channel.static(m)[1] / channel.exact - 1) for m in (coarse, fine))
    verdict.claim(one / two > 3.5, f"the wall alone, {100 * two:.2f} % off, is {one / two:.1f} times as good on the finer mesh")
    return channel


def check_pulse(verdict, reproduce, wanted):
    """Without thin layers at the wall it is drawn along, by half of this motion if the force on it lacks the subscales' inertia."""
    pulse = reproduce.PressurePulse(wanted)
    pulse.layers = lambda _: {}
    in_fewer_steps(pulse, 0.1, 58)
    pulse.levels = [1]
    pulse.run()
    error = pulse.errors(1)["least u_z"]
    verdict.claim(abs(error) < 0.17, f"pressure-pulse, without layers, least u_z: {100 * error:+.2f} %, of 17 %")


def check_swing(verdict, reproduce, wanted):
    """A beam that swings by itself, on a coarse mesh: too far, as the flow there separates from few triangles."""
    beam = reproduce.SwingingBeam(wanted)
    beam.levels, beam.cases = [0.5], ("fsi3",)
    beam.variants_of = lambda _: beam.cases
    beam.run()
    within(verdict, beam, 0.5, {"Hz": 0.04, "": 0.7})
    change = beam.swing(0.5, "fsi3")["change"]
    verdict.claim(abs(change) < 0.02, f"swinging-beam: within the last periods the amplitude changes by {100 * change:+.2f} %")


def check_flap(verdict, reproduce, wanted):
    """A flap that a body force bends far: too stiff with two elements through it. By night between jets, too, on a mesh whose flap bends
    as much less without them."""
    flap = reproduce.SiliconeFlap(wanted)
    flap.levels = [0.5]
    flap.run_one(0.5, "alone")
    tip = flap.centreline(0.5, "alone")[0][-1]
    verdict.claim(-0.28 < tip / flap.exact["tip without flow"] - 1 < 0, f"silicone-flap, without flow: {tip:.2f} mm of 29.5")
    if LONG:
        flap.run()
        within(verdict, flap, 0.5, {"tip without flow": 0.28, "tip": 0.12})


def check_flows(verdict, reproduce, wanted):
    """Between rigid walls, on the coarsest meshes of the page."""
    for kind, bands in ((reproduce.Nozzle, {"": 0.07}), (reproduce.Cylinder, {"lift": 0.6, "pressure": 0.06, "": 0.012})):
        flow = kind(wanted)
        flow.levels = [1]
        flow.run()
        within(verdict, flow, 1, bands)
        yield flow


def within(verdict, benchmark, level, bands):
    for name, error in benchmark.errors(level).items():
        band = next(value for part, value in bands.items() if part in name)
        verdict.claim(abs(error) < band, f"{benchmark.name}, level {level}, {name}: {100 * error:+.2f} %, of {100 * band:g} %")


def main(programs, folder):
    programs = pathlib.Path(programs).resolve()
    folder = fresh(folder)
    verdict = Verdict()
    reproduce = program()
    wanted = argparse.Namespace(programs=str(programs), output=str(folder), finest=1)
    obstacle, tube, beam = reproduce.Obstacle(wanted), reproduce.ElasticTube(wanted), reproduce.TurekHron(wanted)
    channel = check_channel(verdict, reproduce, wanted)
    check_pulse(verdict, reproduce, wanted)
    if LONG:
        check_swing(verdict, reproduce, wanted)
    check_flap(verdict, reproduce, wanted)
    flows = [*check_flows(verdict, reproduce, wanted)]
    wanted.finest = 2
    ring = reproduce.Ring(wanted)
    ring.variants = ("1",)
    ring.frequency = {"1": ring.frequency["1"]}
    if not LONG:
        in_fewer_steps(ring, 2 * math.pi / ring.frequency["1"] / 100, 150)  # half a period of load, one to be fitted
        in_fewer_steps(tube, 50e3 / 60, 4 * 60)  # four periods, of which the last counts
        beam.levels = [0.5]
    for benchmark in (obstacle, tube, ring, beam):
        benchmark.run()
    within(verdict, obstacle, 1, {"displacement": 0.03, "force": 0.08})
    within(verdict, tube, 1, {"": 0.035 if LONG else 0.04})
    within(verdict, ring, 2, {"": 0.025})
    if LONG:
        within(verdict, beam, 1, {"u_y": 0.03, "": 0.01})
    else:
        within(verdict, beam, 0.5, {"u_y": 0.15, "": 0.03})
    one, two = (abs(ring.errors(m)["mass ratio 1"]) for m in (1, 2))
    verdict.claim(math.log2(one / two) > 1.9, f"the ring's frequency has order {math.log2(one / two):.2f}")
    k = tube.wave.k * 1e3
    verdict.claim(abs(k - (0.1439783707 - 0.0207265897j)) < 1e-9, f"the wave number is {k:.10f}, as published")
    reproduce.write_page([obstacle, tube, ring, beam, channel, *flows], str(folder))
    verdict.claim((folder / "RESULTS.md").stat().st_size > 1500 and (folder / "figures" / "errors.png").exists(),
                  "a page and its figure are written")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
