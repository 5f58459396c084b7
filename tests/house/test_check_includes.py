"""cmake/check_includes finds what it is there for, on small trees made for the purpose.

Usage: test_check_includes.py SOURCE_FOLDER
"""
import os
import subprocess
import sys
import tempfile

CHECK = os.path.join(sys.argv[1], "cmake", "check_includes")
CLEAN = {"src/base/error.hpp": "#pragma once\n#include <string>\n",
         "src/base/types.hpp": "#pragma once\n#include <Tpetra_Map.hpp>\nusing Map = Tpetra::Map<>;\n",
         "src/kernels/tet4.hpp": '#pragma once\n#include "base/error.hpp"\n',
         "src/linear/ilu.hpp": '#pragma once\n#include "base/types.hpp"\n',
         "src/app/run.cpp": '// Tpetra::Map in a comment\n#include "linear/ilu.hpp"\n'}
CASES = {
    "nothing": ({}, None),
    "an upward include": ({"src/base/error.hpp": '#include "app/run.hpp"\n', "src/app/run.hpp": ""},
                          "src/base/error.hpp:1: base/ includes app/"),
    "an include of no folder of ours": ({"src/app/run.cpp": '\n#include "run.hpp"\n'}, "src/app/run.cpp:2:"),
    "MPI in a kernel": ({"src/kernels/tet4.hpp": "#include <mpi.h>\n"}, "src/kernels/tet4.hpp:1: kernels/ knows neither"),
    "Trilinos in a law": ({"src/materials/law.cpp": "#include <Teuchos_RCP.hpp>\n"}, "src/materials/law.cpp:1:"),
    "Trilinos in a kernel, through a header of ours": (
        {"src/kernels/tet4.hpp": '#include "base/types.hpp"\n'}, "src/kernels/tet4.hpp:1: kernels/ knows neither"),
    "physics in a solver": ({"src/linear/ilu.hpp": '#include "kernels/tet4.hpp"\n'}, "src/linear/ilu.hpp:1: linear/ knows no physics"),
    "Tpetra in the application": ({"src/app/run.cpp": "Tpetra::Map<> m;\n"}, "src/app/run.cpp:1: names Tpetra"),
    "a folder out of order": ({"src/extras/x.hpp": ""}, "src/extras/x.hpp:1: the folder extras/"),
    "a long header": ({"src/base/error.hpp": "\n" * 151}, "src/base/error.hpp:151: 151 lines"),
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
