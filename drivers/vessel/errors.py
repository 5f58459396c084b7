"""What ends the program before its end, and the exit statuses that belong to it."""
import difflib


class BadInput(Exception):
    """The input is not what was expected; the text is for the user. Exit status 1."""


class NotConverged(Exception):
    """The goals were not reached; the text says by how much and what to change. Exit status 2."""


def nearest(word, words):
    """A hint for a name that does not exist: the nearest that does, otherwise all of them."""
    near = difflib.get_close_matches(word, words, 1)
    return f'Did you mean "{near[0]}"?' if near else "Expected one of: " + ", ".join(words) + "."
