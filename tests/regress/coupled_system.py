"""The preconditioners of xml/monolithic/solvers.xml on the coupled system of another program:
tests/data/coupled-system.

Usage: coupled_system.py FOLDER_OF_PROGRAMS SCRATCH
"""
import gzip
import pathlib
import sys
import xml.etree.ElementTree as xml

from runs import ROOT, Run, Verdict, command, entry, fresh, table

DATA = ROOT / "tests" / "data" / "coupled-system"
# Iterations to 1e-8 at most.
MOST = {
    "nodal ILU 3+3": 3, "nodal ILU 1+1": 8, "nodal ILU 2+2": 5, "Vanka 1+1": 10, "Vanka 2+2": 7,
    "Vanka 6+6, cycles alone": 6, "node pairs 1+1": 17, "node pairs 2+2": 11, "Braess-Sarazin 2+2": 13, "block, two scales": 13,
    "ILU(0), FGMRES": 19, "ILU(1), FGMRES": 9,
}


def case():
    """Its settings, but for those that must know wall from lumen."""
    solvers = entry(xml.parse(ROOT / "xml" / "monolithic" / "solvers.xml").getroot(), "Solvers")
    settings = entry(solvers, "System")
    settings.set("name", "Settings")
    for setting in [one for one in settings if one.get("name") not in MOST]:
        settings.remove(setting)
    root = xml.Element("ParameterList", name="Case")
    system = xml.SubElement(root, "ParameterList", name="System")
    for name in ("A", "B1T", "B2", "C", "rhs"):
        xml.SubElement(system, "Parameter", name=name, type="string", value=f"{name}.mtx")
    xml.SubElement(system, "Parameter", name="node map", type="string", value="nodes.txt")
    xml.SubElement(system, "Parameter", name="C factor", type="double", value="-1")
    xml.SubElement(root, "ParameterList", name="Solvers").append(settings)
    return xml.tostring(root, encoding="unicode")


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    for path in DATA.glob("*.gz"):
        (folder / path.stem).write_bytes(gzip.decompress(path.read_bytes()))
    (folder / "case.xml").write_text(case())
    for ranks in (1, 4):
        run = Run(command(programs / "tunica-solvers", ["case.xml", "--output", f"on-{ranks}"], ranks),
                  folder)
        if not verdict.claim(run.status == 0, f"{ranks} ranks: ends with 0 ({run.seconds:.1f} s)"):
            print(run.out + run.err)
            continue
        rows = table(folder / f"on-{ranks}" / "solvers.csv")
        for name, iterations, end in zip(rows["setting"], rows["iterations"], rows["verdict"]):
            # Without levels the parts of the ranks know nothing of each other.
            more = 0 if ranks == 1 else MOST[name] if name.startswith("ILU") else 2
            most = MOST[name] + more
            verdict.claim(end == "converged" and iterations <= most,
                          f"{ranks} ranks, {name}: {iterations:.0f} iterations, at most {most}")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
