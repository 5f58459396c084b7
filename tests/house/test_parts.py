"""The parts that can be installed alone need no mesh, no HDF5 and no METIS, in headers and links.

Usage: test_parts.py BUILD CMAKE SCRATCH
"""
import pathlib
import re
import subprocess
import sys

BUILD, CMAKE, SCRATCH = sys.argv[1:4]
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from scratch import fresh  # noqa: E402
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)
TARGET = re.compile(r"Tunica::(\w+)")
# What a part may link and whose headers it may include, beside the standard library's.
PARTS = {"smoothers": ({"base", "algebra", "smoothers", "klu2_repair", "trilinos"},
                       r"(malloc\.h|mpi\.h|Teuchos|Tpetra|Kokkos|Ifpack2|Amesos2|Trilinos)"),
         "multigrid": ({"base", "algebra", "smoothers", "klu2_repair", "trilinos", "params", "multigrid"},
                       r"(malloc\.h|mpi\.h|Teuchos|Tpetra|Kokkos|Ifpack2|Amesos2|Trilinos|MueLu|Xpetra)")}


def problems_of(part, prefix):
    targets, foreign = PARTS[part]
    include = prefix / "include"
    headers = sorted((include / "tunica" / part).rglob("*.hpp"))
    if not headers:
        yield f"no header of {part}/ is installed"
    for header in sorted(include.rglob("*.hpp")):
        for name in INCLUDE.findall(header.read_text(encoding="utf-8")):
            is_known = (include / name).exists() if name.startswith("tunica/") else (
                "." not in name or re.match(foreign, name))
            if not is_known:
                yield f"{header.relative_to(include)} includes {name}"
    exported = sorted(prefix.rglob("Tunica-*.cmake"))
    if not exported:
        yield "no target is exported"
    for file in exported:
        text = file.read_text(encoding="utf-8")
        for name in sorted(set(TARGET.findall(text)) - targets):
            yield f"{file.name} names Tunica::{name}"
        if re.search("hdf5|metis|nlohmann", text, re.IGNORECASE):
            yield f"{file.name} links HDF5, METIS or a parser of JSON"


def main():
    count = 0
    for part in PARTS:
        prefix = fresh(pathlib.Path(SCRATCH) / part)
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", prefix, "--component", part],
                       check=True, stdout=subprocess.DEVNULL)
        for problem in problems_of(part, prefix):
            print(f"{part}: {problem}")
            count += 1
    print(f"{count} problem(s)")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
