"""Each public header compiles by itself in a program that knows the installed package alone. Most include types.hpp, whose
headers of Trilinos take longer than all the rest: for these it is compiled once, before them.

Usage: public_headers.py SOURCE BUILD CMAKE
"""
import pathlib
import re
import sys
import tempfile

from installation import CMAKE, Verdict, install_and_move, must

TYPES = "tunica/base/types.hpp"
INCLUDE = re.compile(r'^\s*#\s*include\s+["<](tunica/[^">]+)[">]', re.MULTILINE)
PROJECT = """cmake_minimum_required(VERSION 3.21)
project(headers LANGUAGES CXX)
find_package(Tunica REQUIRED COMPONENTS fsi)
foreach(kind alone typed)
  file(GLOB sources ${{CMAKE_CURRENT_SOURCE_DIR}}/${{kind}}/*.cpp)
  add_library(${{kind}} OBJECT ${{sources}})
  target_link_libraries(${{kind}} PRIVATE Tunica::fsi)
  target_compile_options(${{kind}} PRIVATE -O0)
endforeach()
target_precompile_headers(typed PRIVATE <{types}>)
""".format(types=TYPES)


def included(root, header, found):
    """All of ours that a header includes, by others too."""
    for name in INCLUDE.findall((root / header).read_text(encoding="utf-8")):
        if name not in found:
            found.add(name)
            included(root, name, found)
    return found


def write_project(project, root, headers):
    """The number of headers that types.hpp is compiled for beforehand."""
    for kind in ("alone", "typed"):
        (project / kind).mkdir(parents=True)
    for header in headers:
        kind = "typed" if TYPES in included(root, header, set()) else "alone"
        (project / kind / (header.replace("/", "_")[:-4] + ".cpp")).write_text(f"#include <{header}>\n")
    (project / "CMakeLists.txt").write_text(PROJECT)
    return len(list((project / "typed").iterdir()))


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-headers-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("fsi", scratch)
        root, project = prefix / "include", scratch / "project"
        headers = sorted(str(path.relative_to(root)) for path in root.rglob("*.hpp"))
        typed = write_project(project, root, headers)
        must([CMAKE, "-S", project, "-B", scratch / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"], scratch)
        print(must([CMAKE, "--build", scratch / "build", "-j", "2"], scratch)[-200:])
        objects = len(list((scratch / "build").rglob("*.cpp.o")))
        verdict.claim(len(headers) > 80 and objects == len(headers),
                      f"{objects} of {len(headers)} headers compile alone, {typed} of them after what types.hpp includes")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
