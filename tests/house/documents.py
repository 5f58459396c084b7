#!/usr/bin/python3
"""What the documents say exists: the targets of their links, and the options and files on their
command lines of tunica-*.

Usage: documents.py ROOT FOLDER_OF_PROGRAMS
"""
import functools
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)")
FOREIGN = re.compile(r"[a-z][a-z+.-]*:")
FENCE = re.compile(r"^ *(```|~~~)")
INLINE = re.compile(r"`([^`]+)`")
PROGRAM = re.compile(r"(?:\S*/)?(tunica-[a-z]+)$")
END_OF_COMMAND = {"|", "||", "&&", ";", "&", ">", ">>", "<", "#"}
NOT_OURS = {"build", "results", ".git"}


def documents(root):
    for path in sorted(root.rglob("*.md")):
        if not NOT_OURS & set(path.relative_to(root).parts):
            yield path


def split(text):
    """(line number, whether it is code, line) of each line; a line of code with its continuations."""
    is_code, number, lines = False, 0, text.split("\n")
    while number < len(lines):
        first, line = number + 1, lines[number]
        if FENCE.match(line):
            is_code = not is_code
        while is_code and line.endswith("\\") and number + 1 < len(lines):
            number += 1
            line = line[:-1] + " " + lines[number]
        number += 1
        yield first, is_code, line


@functools.lru_cache(maxsize=None)
def anchors(path):
    """The names by which the headings of a document are reached."""
    names = set()
    for _, is_code, line in split(path.read_text(encoding="utf-8")):
        if not is_code and line.startswith("#"):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line.lstrip("#").strip()).lower()
            names.add(re.sub(r"[^\w\- ]", "", text).replace(" ", "-"))
    return names


def broken_link(path, target):
    if FOREIGN.match(target):
        return ""
    name, _, anchor = target.partition("#")
    file = path if not name else (path.parent / name)
    if not file.exists():
        return f"{target}: there is no such file"
    if anchor and file.suffix == ".md" and anchor not in anchors(file.resolve()):
        return f"{target}: {file.name} has no such heading"
    return ""


@functools.lru_cache(maxsize=None)
def help_of(*words):
    done = subprocess.run([*words, "--help"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", done.stdout)) | {"--help"}


def wrong_words(programs, root, words):
    """What is wrong with a command line from its program on."""
    program = programs / PROGRAM.match(words[0])[1]
    if not program.exists():
        return [f"{program.name}: there is no such program"]
    is_command = program.name == "tunica-mesh" and len(words) > 1 and words[1].isalpha()
    options = help_of(str(program), *words[1:2] if is_command else [])
    wrong = []
    for word in words[1:]:
        word = word.strip("\"'.,;:)")
        if word.startswith("--") and word.split("=")[0] not in options:
            wrong.append(f"{program.name} has no option {word.split('=')[0]}")
        if re.match(r"(xml|meshes)/[\w./-]+\.\w+$", word) and not (root / word).exists():
            wrong.append(f"{word}: there is no such file")
    return wrong


def commands(line):
    """The words of each command in a line of code, from the program on."""
    words = line.split()
    for start, word in enumerate(words):
        if PROGRAM.match(word):
            end = next((k for k in range(start, len(words)) if words[k] in END_OF_COMMAND), len(words))
            yield words[start:end]


def check(path, root, programs):
    for number, is_code, line in split(path.read_text(encoding="utf-8")):
        where = f"{path.relative_to(root)}:{number}: "
        for code in [line] if is_code else INLINE.findall(line):
            for words in commands(code):
                yield from (where + text for text in wrong_words(programs, root, words))
        for target in [] if is_code else LINK.findall(INLINE.sub("", line)):
            text = broken_link(path, target)
            if text:
                yield where + text


def main(root, programs):
    problems = [text for path in documents(root) for text in check(path, root, programs)]
    print("\n".join(problems + [f"{len(problems)} problem(s)"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
