# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions with the messages of the command line."""
from __future__ import annotations

import re


def printable(text: str) -> str:
    """The text with control characters spelled out, since a terminal would execute them."""
    def spelled(found):
        code = ord(found.group())
        return f"\\x{code:02x}" if code < 0x20 else f"\\u{code:04x}"
    return re.sub(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", spelled, text)


def tell(error: BaseException, text: str) -> None:
    """Adds a note to an exception. A KeyboardInterrupt without a message gets it as its message, since some notebooks hide notes."""
    if isinstance(error, KeyboardInterrupt) and not error.args:
        error.args = (text,)
    else:
        error.add_note(text)


_END = r"(?:, expected (?P<expected>[^;]*))?(?:; (?P<remedy>.*))?"
_FORMS = (
    # where: key: found X
    re.compile(r"(?:(?P<where>[^:\n]+(?::\d+)?): )?(?:(?P<key>[^:\n]+): )?found (?P<found>.*?)" + _END, re.DOTALL),
    # where: key needs another key, or cannot be given here
    re.compile(r"(?:(?P<where>[^:\n]+(?::\d+)?): )?(?P<key>[\w.\[\]]+) (?P<found>(?:needs|cannot be given here)\b[^;]*)"
               + _END, re.DOTALL),
    # message of the command-line parser
    re.compile(r"(?P<where>[^:\n]+): the argument \('(?P<found>.*)'\) for option '(?P<key>[^'\n]+)' is invalid"
               r"(?:, expected (?P<expected>.*))?(?: \((?P<remedy>see [^()]*)\))", re.DOTALL),
    # where: what is wrong
    re.compile(r"(?P<where>[^:\n]+(?::\d+)?): (?P<key>)(?P<found>.*?)" + _END, re.DOTALL),
)
# A single name before «found» is a place rather than a key if it matches _PLACE, or if the text found matches _OF_A_PLACE.
_PLACE = re.compile(r".*(:\d+|/.*|\.(toml|dat|csv|json|txt|svg|pdf|png|html|sqlite))|case|centres|particles", re.DOTALL)
_OF_A_PLACE = re.compile(r"(no such (file|folder)|results|there already|an input of the same command|a folder|a file)"
                         r"\b.*", re.DOTALL)


class InputError(ValueError):
    """Invalid input. The message is that of the command line: «file:line: key: found X, expected Y; what to do».

    The parts of the message are attributes, or None if the message has no such part: where ("case.toml:14"; "case" for a
    dict), key ("material.cohesion", "--count"), found, expected, remedy.
    """

    def __init__(self, text: str) -> None:
        super().__init__(printable(text))

    def _part(self, name: str) -> str | None:
        for form in _FORMS:
            match = form.fullmatch(str(self))
            if match is not None:
                break
        else:
            return None
        parts = {part: text or None for part, text in match.groupdict().items()}
        alone = parts["where"] if parts["key"] is None else None  # the only name before «found»: a place, a key, or an option
        if alone is not None and form is _FORMS[0]:
            if not (_PLACE.fullmatch(alone) or _OF_A_PLACE.fullmatch(parts["found"] or "")):
                parts["key"], parts["where"] = alone, None
        return parts[name]

    @property
    def where(self) -> str | None:
        """File and line, or the name of the input."""
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
    """A file or folder that cannot be written."""


class SystemFailure(RuntimeError):
    """A failure of the operating system, such as a full disk, lack of memory or too many open files. The same call may succeed later."""


class UnstableRun(RuntimeError):
    """A simulation that became unstable: a value is not a number, the energy grows without bound, or a body left the domain.

    Attributes: step (number of steps done), body (id). Results written before that are kept.
    """

    step: int | None = None
    body: int | None = None
