"""Each public header compiles by itself in a program that knows the installed package alone.

Usage: public_headers.py SOURCE BUILD CMAKE
"""
import pathlib
import sys
import tempfile

from installation import CMAKE, Verdict, install_and_move, must

PROJECT = """cmake_minimum_required(VERSION 3.21)
project(headers LANGUAGES CXX)
find_package(Tunica REQUIRED COMPONENTS fsi)
file(GLOB sources ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
add_library(headers OBJECT ${sources})
target_link_libraries(headers PRIVATE Tunica::fsi)
target_compile_options(headers PRIVATE -O0 -fsyntax-only)
"""


def main():
    verdict = Verdict()
    with tempfile.TemporaryDirectory(prefix="tunica-headers-") as folder:
        scratch = pathlib.Path(folder)
        prefix = install_and_move("fsi", scratch)
        project = scratch / "project"
        project.mkdir()
        headers = sorted(path.relative_to(prefix / "include") for path in (prefix / "include").rglob("*.hpp"))
        for header in headers:
            (project / (str(header).replace("/", "_")[:-4] + ".cpp")).write_text(f"#include <{header}>\n")
        (project / "CMakeLists.txt").write_text(PROJECT)
        must([CMAKE, "-S", project, "-B", scratch / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"], scratch)
        print(must([CMAKE, "--build", scratch / "build", "-j", "2"], scratch)[-200:])
        verdict.claim(len(headers) > 80, f"{len(headers)} headers compile alone")
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main())
