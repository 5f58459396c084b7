"""cmake/public_headers.txt: every header is there, includes public ones alone, and is one that programs begin with or
what these need; and they are few enough to be read.

Usage: public_headers.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

MOST = 125
INCLUDE = re.compile(r'^\s*#\s*include\s+"(tunica/[^"]+)"', re.MULTILINE)


def sections(text):
    """The headers that programs begin with, and the others."""
    first, second = text.split("# What these include.")
    return [[line for line in part.splitlines() if line.startswith("tunica/")] for part in (first, second)]


def needed_by(root, headers):
    found, open_ones = set(), list(headers)
    while open_ones:
        header = open_ones.pop()
        if header not in found and (root / "src" / header).is_file():
            found.add(header)
            open_ones += INCLUDE.findall((root / "src" / header).read_text(encoding="utf-8"))
    return found


def faults(root):
    beginning, others = sections((root / "cmake" / "public_headers.txt").read_text(encoding="utf-8"))
    public = beginning + others
    yield from (f"{header} is not there" for header in public if not (root / "src" / header).is_file())
    yield from (f"{header} is listed twice" for header in sorted({h for h in public if public.count(h) > 1}))
    needed = needed_by(root, beginning)
    yield from (f"{header} is included by a public header and is none" for header in sorted(needed - set(public)))
    yield from (f"{header} is needed by none that programs begin with" for header in sorted(set(others) - needed))
    if len(public) > MOST:
        yield f"{len(public)} public headers, expected at most {MOST}"


if __name__ == "__main__":
    complaints = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(complaints) if complaints else "the list is whole")
    sys.exit(1 if complaints else 0)
