"""The commands of the pages: fenced blocks of the language sh, and the mark in the line above each of them, a comment that
readers do not see:

    <!-- run: NAME -->        the test NAME types the block as it stands
    <!-- not run: REASON -->  nobody does, and why
"""
import collections
import re

Block = collections.namedtuple("Block", "page line kind name text")

FENCED = re.compile(r"^(?:<!-- (run|not run): (.+?) -->\n)?( *)```(\S*)[^\n]*\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
SHELLS = {"sh", "bash", "shell", "console"}


def fenced(root, page):
    """(language, Block) of every fenced block of a page, whose kind and name are "" without a mark."""
    text = (root / page).read_text(encoding="utf-8")
    for found in FENCED.finditer(text):
        line = text.count("\n", 0, found.start(3)) + 1
        yield found[4], Block(page, line, found[1] or "", found[2] or "", found[5])


def blocks(root, page):
    """The commands of a page in their order."""
    return [block for language, block in fenced(root, page) if language in SHELLS]


def blocks_of(root, page, test):
    """Those that a test runs."""
    return [block for block in blocks(root, page) if (block.kind, block.name) == ("run", test)]
