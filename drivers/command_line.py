"""What the command lines of the programs in Python share: a wrong option is bad input, told in one line."""
import argparse
import difflib


class Parser(argparse.ArgumentParser):
    """bad: the exception that tells of the program's bad input, with exit status 1."""

    def __init__(self, bad, **words):
        super().__init__(allow_abbrev=False, **words)
        self._bad = bad

    def error(self, message):
        raise self._bad(message)

    def refuse(self, words):
        """Names what was meant by the first word that is no option."""
        near = difflib.get_close_matches(words[0].split("=")[0], self._option_string_actions, 1)
        hint = f'Did you mean "{near[0]}"?' if near else "--help lists the options."
        self.error(f'unknown option "{words[0]}". {hint}')
