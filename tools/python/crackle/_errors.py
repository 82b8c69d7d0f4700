# SPDX-License-Identifier: GPL-3.0-or-later
"""Failures, with the messages of the command line."""
import re

_PARTS = re.compile(
    r"(?:(?P<where>[^:\n]+(?::\d+)?): )?(?:(?P<key>[^:\n]+): )?found (?P<found>.*?)"
    r"(?:, expected (?P<expected>[^;]*))?(?:; (?P<remedy>.*))?", re.DOTALL)


class InputError(ValueError):
    """Input that cannot be used. The text is the command line's: «file:line: key: found X, expected Y; what to do».

    Its parts are attributes, None where the text has no such part: where ("case.toml:14"; of a case given as a dict
    "case"), key ("material.cohesion"), found, expected, remedy.
    """

    def _part(self, name):
        match = _PARTS.fullmatch(str(self))
        if match is None:
            return None
        parts = match.groupdict()
        if parts["key"] is None and parts["where"] is not None:  # one beginning alone: a key, or an option
            parts["key"], parts["where"] = parts["where"], None
        return parts[name]

    where = property(lambda self: self._part("where"), doc="file and line, or what stands for the file")
    key = property(lambda self: self._part("key"), doc="the key or option")
    found = property(lambda self: self._part("found"), doc="what was found")
    expected = property(lambda self: self._part("expected"), doc="what was expected")
    remedy = property(lambda self: self._part("remedy"), doc="what to do")


class OutputError(InputError):
    """A place that cannot be written."""


class UnstableRun(RuntimeError):
    """A simulation that went wrong: not a number, runaway energy, a body that left the world.

    Attributes: step (steps done), body (id). What was written until then is kept.
    """

    step = None
    body = None
