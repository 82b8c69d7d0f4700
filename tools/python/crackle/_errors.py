# SPDX-License-Identifier: GPL-3.0-or-later
"""Failures, with the messages of the command line."""
from __future__ import annotations

import re


def tell(error: BaseException, text: str) -> None:
    """Adds a text to an exception: as its message where it is a bare Ctrl-C, for not every notebook shows notes."""
    if isinstance(error, KeyboardInterrupt) and not error.args:
        error.args = (text,)
    else:
        error.add_note(text)


_END = r"(?:, expected (?P<expected>[^;]*))?(?:; (?P<remedy>.*))?"
_FORMS = (
    # where: key: found X
    re.compile(r"(?:(?P<where>[^:\n]+(?::\d+)?): )?(?:(?P<key>[^:\n]+): )?found (?P<found>.*?)" + _END, re.DOTALL),
    # where: key needs what is not there, or has no room
    re.compile(r"(?:(?P<where>[^:\n]+(?::\d+)?): )?(?P<key>[\w.\[\]]+) (?P<found>(?:needs|cannot be given here)\b[^;]*)"
               + _END, re.DOTALL),
    # of the command line's parser
    re.compile(r"(?P<where>[^:\n]+): the argument \('(?P<found>.*)'\) for option '(?P<key>[^'\n]+)' is invalid"
               r"(?:, expected (?P<expected>.*))?(?: \((?P<remedy>see [^()]*)\))", re.DOTALL),
    # where: what is wrong with it
    re.compile(r"(?P<where>[^:\n]+(?::\d+)?): (?P<key>)(?P<found>.*?)" + _END, re.DOTALL),
)
# A beginning alone is a place, not a key: by its look, or by what was found there.
_PLACE = re.compile(r".*(:\d+|/.*|\.(toml|dat|csv|json|txt|svg|pdf|png|html|sqlite))|case|centres|particles", re.DOTALL)
_OF_A_PLACE = re.compile(r"(no such (file|folder)|results|there already|an input of the same command|a folder|a file)"
                         r"\b.*", re.DOTALL)


class InputError(ValueError):
    """Input that cannot be used. The text is the command line's: «file:line: key: found X, expected Y; what to do».

    Its parts are attributes, None where the text has no such part: where ("case.toml:14"; of a case given as a dict
    "case"), key ("material.cohesion", "--count"), found, expected, remedy.
    """

    def _part(self, name: str) -> str | None:
        for form in _FORMS:
            match = form.fullmatch(str(self))
            if match is not None:
                break
        else:
            return None
        parts = {part: text or None for part, text in match.groupdict().items()}
        alone = parts["where"] if parts["key"] is None else None  # one beginning: a place, a key, or an option
        if alone is not None and form is _FORMS[0]:
            if not (_PLACE.fullmatch(alone) or _OF_A_PLACE.fullmatch(parts["found"] or "")):
                parts["key"], parts["where"] = alone, None
        return parts[name]

    @property
    def where(self) -> str | None:
        """File and line, or what stands for the file."""
        return self._part("where")

    @property
    def key(self) -> str | None:
        """The key or option."""
        return self._part("key")

    @property
    def found(self) -> str | None:
        """What was found."""
        return self._part("found")

    @property
    def expected(self) -> str | None:
        """What was expected."""
        return self._part("expected")

    @property
    def remedy(self) -> str | None:
        """What to do."""
        return self._part("remedy")


class OutputError(InputError):
    """A place that cannot be written."""


class UnstableRun(RuntimeError):
    """A simulation that went wrong: not a number, runaway energy, a body that left the world.

    Attributes: step (steps done), body (id). What was written until then is kept.
    """

    step: int | None = None
    body: int | None = None
