"""Names of regions and surfaces: those of a file of names, and one for each in the end."""
import shlex

import numpy as np

from .raw import BadMesh, hint

EXPECTED = 'expected "region OLD NEW" or "surface OLD NEW", where OLD is a name or a number'


def read(path):
    """(kind, old, new) of each line; # begins a comment."""
    try:
        with open(path, encoding="utf-8-sig") as file:  # perhaps with a byte-order mark, as of spreadsheets
            lines = file.read().splitlines()
    except UnicodeDecodeError as error:
        raise BadMesh(f"{path}: cannot be read as a file of names: it is not UTF-8. Save it as that.") from error
    except OSError as error:
        raise BadMesh(f"{path}: cannot be read as a file of names: {error}") from error
    wishes = []
    for number, line in enumerate(lines, 1):
        try:
            words = shlex.split(line, comments=True)
        except ValueError as error:
            raise BadMesh(f"{path}:{number}: {error}, {EXPECTED}") from error
        if words and (len(words) != 3 or words[0] not in ("region", "surface") or not words[2]):
            raise BadMesh(f"{path}:{number}: \"{line.strip()}\", {EXPECTED}")
        if words:
            wishes.append(tuple(words))
    return wishes


def settle(tags, kind):
    """A name for each that has elements, in order of the numbers; those of one name become one."""
    given = [name or f"{kind}-{number}" for name, number in zip(tags.names, tags.ids)]
    has_elements = np.bincount(tags.of[tags.of >= 0], minlength=len(given)) > 0
    order = [k for k in sorted(range(len(given)), key=lambda k: tags.ids[k]) if has_elements[k]]
    names = list(dict.fromkeys(given[k] for k in order))
    position = np.array([names.index(name) if name in names else -1 for name in given] + [-1])  # none stays none
    ids = [next(tags.ids[k] for k in order if given[k] == name) for name in names]
    if len(set(ids)) != len(ids) or min(ids, default=0) < 0:
        ids = list(range(1, len(ids) + 1))
    tags.of, tags.names, tags.ids = position[tags.of], names, ids


def matching(path, tags, kind, old):
    if old in tags.names:
        return tags.names.index(old)
    if old.isdigit() and int(old) in tags.ids:
        return tags.ids.index(int(old))
    there = f"It has {', '.join(tags.names) or 'none'}."
    raise BadMesh(f'{path}: the mesh has no {kind} "{old}". {hint(old, tags.names, there)}')


def apply(wishes, path, tags, kind):
    """Renames settled tags. Two of the same new name become one."""
    renamed = list(tags.names)
    for _, old, new in (wish for wish in wishes if wish[0] == kind):
        renamed[matching(path, tags, kind, old)] = new
    tags.names = renamed
    settle(tags, kind)
