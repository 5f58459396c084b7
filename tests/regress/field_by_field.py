"""xml/monolithic/solvers.xml on the tiny tube: what solves the coupled system field by field, beside what
solves it as one, on several ranks.

Usage: field_by_field.py FOLDER_OF_PROGRAMS SCRATCH [--long]
"""
import pathlib
import sys

from runs import LONG, ROOT, Run, Verdict, command, fresh, table, write_case

CASE = ROOT / "xml" / "monolithic" / "solvers.xml"
TINY = ["--set", f"Mesh/file={ROOT / 'meshes' / 'tube-tiny.h5'}"]
WHOLE, TURN, BOTH = "nodal ILU 2+2", "fields in turn, a cycle each", "fields that overlap, a cycle each"
SOLVED, FACSI = "fields that overlap, solved to 0.1", "FaCSI, SIMPLE in the lumen"
BLOCK, VANKA, PAIRS = "block, two scales", "Vanka 2+2", "node pairs 2+2"
OTHERS = ["BGS(AMG), RILUK(1)", "BGS(AMG), Chebyshev(3) in the wall", "AMG(BGS), RILUK(1)",
          "AMG(BGS), Chebyshev(3) in the wall"]


def counts(verdict, programs, folder, ranks):
    words = ["case.xml", "--output", f"on-{ranks}", *TINY]
    run = Run(command(programs / "tunica-solvers", words, ranks), folder)
    if not verdict.claim(run.status == 0, f"{ranks} ranks: ends with 0 ({run.seconds:.1f} s)"):
        print(run.out + run.err)
        return {}
    rows = table(folder / f"on-{ranks}" / "solvers.csv")
    for name, end in zip(rows["setting"], rows["verdict"]):
        verdict.claim(end == "converged", f"{ranks} ranks, {name}: {end}")
    return dict(zip(rows["setting"], rows["iterations"]))


def lacks_a_part(verdict, programs, folder):
    """A smoother whose fields leave unknowns as they are is refused, and the part is named."""
    write_case(CASE, folder / "lacking.xml", {"System": [WHOLE, OTHERS[2]]})
    text = (folder / "lacking.xml").read_text()
    whole = '"{wall, interface}"'
    verdict.claim(text.count(whole) == 1, f"the case has one field with {whole}")
    (folder / "lacking.xml").write_text(text.replace(whole, '"{wall}"'))
    run = Run(command(programs / "tunica-solvers", ["lacking.xml", "--output", "lacking", *TINY]), folder)
    ends = table(folder / "lacking" / "solvers.csv")["verdict"]
    verdict.claim(run.status == 0 and ends[0] == "converged" and
                  'no entry of "Fields" has the part "interface"' in ends[1],
                  f"fields without the interface: {ends[1]}")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    write_case(CASE, folder / "case.xml", {"System": [WHOLE, TURN, BOTH, SOLVED, FACSI, BLOCK, VANKA, PAIRS] + OTHERS})
    lacks_a_part(verdict, programs, folder)
    alone = counts(verdict, programs, folder, 1)
    if not alone:
        return verdict.status()
    # What the added mass costs where the fields take turns, and what an overlap saves.
    verdict.claim(2 * alone[BOTH] < alone[TURN], f"in turn {alone[TURN]:.0f}, with overlap {alone[BOTH]:.0f}")
    verdict.claim(alone[BOTH] <= alone[WHOLE] + 2, f"as a whole {alone[WHOLE]:.0f}")
    verdict.claim(alone[SOLVED] <= alone[BOTH], f"fields solved to 0.1: {alone[SOLVED]:.0f}")
    verdict.claim(alone[TURN] <= alone[FACSI] <= alone[TURN] + 6, f"the wall's own block: {alone[FACSI]:.0f}")
    verdict.claim(alone[BLOCK] <= 2 * alone[TURN], f"velocity and pressure: {alone[BLOCK]:.0f}")
    verdict.claim(alone[PAIRS] <= alone[VANKA], f"pairs of nodes {alone[PAIRS]:.0f}, Vanka {alone[VANKA]:.0f}")
    for ranks in (2, 4) if LONG else (4,):
        found = counts(verdict, programs, folder, ranks)
        for name in (TURN, BOTH, SOLVED, FACSI, BLOCK, VANKA):
            verdict.claim(abs(found.get(name, 0) - alone[name]) <= 2,
                          f"{ranks} ranks, {name}: {found.get(name)}, alone {alone[name]:.0f}")
        # Pairs of two ranks are cut.
        verdict.claim(0 < found.get(PAIRS, 0) <= 2 * alone[PAIRS], f"{ranks} ranks, {PAIRS}: {found.get(PAIRS)}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
