"""The recovered stress of walls that bend against what it is known to be (xml/stress, short form).

Usage: nodal_stress.py FOLDER_OF_PROGRAMS SCRATCH
"""
import pathlib
import sys

from runs import ROOT, Verdict, fresh

sys.path.insert(0, str(ROOT / "xml" / "stress"))
from stress_cases import SECTIONS, Found, run  # noqa: E402

# Section, elements over the thickness, variant, ranks; most error of the peak [%]: of the recovered stress; least one of
# the elements' mean at its vertex, without which there would be nothing to show.
CASES = [("round", 2, "default", 1, 5.0, 6.0), ("round", 4, "default", 2, 2.0, 3.5), ("oval", 4, "default", 1, 3.0, 10.0),
         ("oval", 4, "linear", 2, 12.0, 20.0)]


def main(programs, scratch):
    programs, folder, verdict = pathlib.Path(programs).resolve(), fresh(scratch), Verdict()
    for name, n, variant, ranks, most, least in CASES:
        place = str(folder / f"{name}-{n}-{variant}")
        status = run(str(programs), place, name, n, variant, ranks)
        verdict.claim(status == 0, f"{name}, {n} elements over the thickness, {variant}: ends with {status}")
        if status != 0:
            continue
        found, peak = Found(place), SECTIONS[name].stresses[0]
        _, mean, recovered = (100.0 * (s / peak.value - 1.0) for s in found.stress_at(peak))
        verdict.claim(abs(recovered) < most, f"the greatest hoop stress as it is recovered is off by {recovered:.1f} %")
        verdict.claim(abs(mean) > least, f"the mean of the elements by {mean:.1f} %")
        verdict.claim(0.0 < found.estimated_error() < 0.5, f"estimated error {100.0 * found.estimated_error():.1f} %")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
