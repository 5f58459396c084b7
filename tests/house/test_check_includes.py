"""cmake/check_includes finds what it is there for, on small trees made for the purpose.

Usage: test_check_includes.py SOURCE_FOLDER
"""
import os
import subprocess
import sys
import tempfile

CHECK = os.path.join(sys.argv[1], "cmake", "check_includes")
CLEAN = {"src/tunica/base/error.hpp": "#pragma once\n#include <string>\n",
         "src/tunica/base/types.hpp": "#pragma once\n#include <Tpetra_Map.hpp>\nusing Map = Tpetra::Map<>;\n",
         "src/tunica/kernels/tet4.hpp": '#pragma once\n#include "tunica/base/error.hpp"\n',
         "src/tunica/linear/ilu.hpp": '#pragma once\n#include "tunica/base/types.hpp"\n',
         "src/tunica/app/run.cpp": '// Tpetra::Map in a comment\n#include "tunica/linear/ilu.hpp"\n'}
CASES = {
    "nothing": ({}, None),
    "an upward include": ({"src/tunica/base/error.hpp": '#include "tunica/app/run.hpp"\n', "src/tunica/app/run.hpp": ""},
                          "src/tunica/base/error.hpp:1: base/ includes app/"),
    "an include of no folder of ours": ({"src/tunica/app/run.cpp": '\n#include "run.hpp"\n'}, "src/tunica/app/run.cpp:2:"),
    "MPI in a kernel": ({"src/tunica/kernels/tet4.hpp": "#include <mpi.h>\n"}, "src/tunica/kernels/tet4.hpp:1: kernels/ knows neither"),
    "Trilinos in a law": ({"src/tunica/materials/law.cpp": "#include <Teuchos_RCP.hpp>\n"}, "src/tunica/materials/law.cpp:1:"),
    "Trilinos in a kernel, through a header of ours": (
        {"src/tunica/kernels/tet4.hpp": '#include "tunica/base/types.hpp"\n'}, "src/tunica/kernels/tet4.hpp:1: kernels/ knows neither"),
    "physics in a solver": ({"src/tunica/linear/ilu.hpp": '#include "tunica/kernels/tet4.hpp"\n'}, "src/tunica/linear/ilu.hpp:1: linear/ includes kernels/, which"),
    "Tpetra in the application": ({"src/tunica/app/run.cpp": "Tpetra::Map<> m;\n"}, "src/tunica/app/run.cpp:1: names Tpetra"),
    "a line that no caller can take": ({"src/tunica/app/run.cpp": "std::cout << 1;\n"}, "src/tunica/app/run.cpp:1: writes to a standard stream"),
    "a line by printf": ({"src/tunica/app/run.cpp": 'printf("1");\n'}, "src/tunica/app/run.cpp:1: writes to a standard stream"),
    "a text by snprintf": ({"src/tunica/app/run.cpp": 'std::snprintf(a, 1, "1");\n'}, None),
    "physics in the smoothers": ({"src/tunica/smoothers/vanka/x.hpp": '#include "tunica/mesh/m.hpp"\n', "src/tunica/mesh/m.hpp": ""},
                                 "src/tunica/smoothers/vanka/x.hpp:1: smoothers/ includes mesh/"),
    "files in an installed part that it must do without": (
        {"src/tunica/multigrid/muelu/x.hpp": '#include "tunica/io/f.hpp"\n', "src/tunica/io/f.hpp": ""},
        "src/tunica/multigrid/muelu/x.hpp:1: multigrid/ belongs to the part multigrid"),
    "an upward include within a folder": (
        {"src/tunica/multigrid/galerkin/x.hpp": '#include "tunica/multigrid/muelu/y.hpp"\n', "src/tunica/multigrid/muelu/y.hpp": ""},
        "src/tunica/multigrid/galerkin/x.hpp:1: multigrid/galerkin/ includes muelu/"),
    "a crowded folder": ({f"src/tunica/base/x{k}.hpp": "" for k in range(39)}, "src/tunica/base:1: 41 files"),
    "a folder out of order": ({"src/tunica/extras/x.hpp": ""}, "src/tunica/extras/x.hpp:1: the folder extras/"),
    "a long header": ({"src/tunica/base/error.hpp": "\n" * 151}, "src/tunica/base/error.hpp:151: 151 lines"),
    "a long source": ({"tests/unit/test_x.cpp": "\n" * 401}, "tests/unit/test_x.cpp:401: 401 lines"),
}


def output_for(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, name)), exist_ok=True)
            with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                file.write(text)
        run = subprocess.run([CHECK, root], capture_output=True, text=True, check=False)
        return run.returncode, run.stdout + run.stderr


def main():
    failures = []
    for claim, (changes, violation) in CASES.items():
        status, text = output_for({**CLEAN, **changes})
        expected = (1, violation) if violation else (0, "0 violation(s)")
        if status != expected[0] or expected[1] not in text:
            failures.append(f"{claim}: expected {expected}, found {status} and:\n{text}")
    print("\n".join(failures + [f"{len(CASES)} cases, {len(failures)} failed"]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
