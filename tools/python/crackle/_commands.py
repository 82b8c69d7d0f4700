# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts keyword arguments to words of the command line, so that the program's own parser checks them."""
import os

from ._errors import InputError


def words_of(options):
    """Words of options: {"radius_min": 0.01, "force": True} gives --radius-min 0.01 --force; None and False are omitted."""
    words = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, (list, tuple)):
            words.append(option)
            words.extend(_word(name, one) for one in value)
        else:
            words.append(f"{option}={_word(name, value)}")
    return words


def _word(name, value):
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise InputError(f"{name}: found a {type(value).__name__}, expected a number or a text")
    return repr(value) if isinstance(value, float) else str(value)
