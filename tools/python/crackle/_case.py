# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads cases from dicts, TOML texts and files, and finds shipped files."""
from __future__ import annotations

import json
import math
import os
from typing import TYPE_CHECKING

from . import _engine
from ._errors import InputError

if TYPE_CHECKING:
    from ._tests import _Case, _Path


def _shipped_folder():
    """Folder that contains specimens/: PREFIX/share/crackle of an installed package, or the top of the sources."""
    here = os.path.dirname(os.path.abspath(__file__))
    parents = [here]
    for _ in range(6):
        parents.append(os.path.dirname(parents[-1]))
    candidates = [os.path.join(p, "share", "crackle") for p in parents] + parents
    for folder in candidates:
        if os.path.isdir(os.path.join(folder, "specimens", "guide_rock")):
            return folder
    return None


def given_or_shipped(path: _Path) -> str:
    """The path as given, or the shipped file if the path begins with "specimens/" and does not exist."""
    path = os.fspath(path)
    if os.path.exists(path) or not path.startswith("specimens/"):
        return path
    folder = _shipped_folder()
    shipped = os.path.join(folder, path) if folder else path
    return shipped if os.path.exists(shipped) else path


def _plain(value, name):
    """The value converted for JSON. Numbers and arrays of numpy become numbers and lists of Python."""
    if isinstance(value, dict):
        out = {}
        for key, inner in value.items():
            if not isinstance(key, str):
                raise InputError(f"case: {name}: found a key {key!r}, expected a text")
            inner = _plain(inner, f"{name}.{key}" if name else key)
            if inner is not None:
                out[key] = inner
        return out
    if isinstance(value, (list, tuple)):
        return [_plain(one, name) for one in value]
    if value is None or isinstance(value, (bool, str)):
        return value
    if hasattr(value, "tolist"):  # numpy's scalars and arrays
        return _plain(value.tolist(), name)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise InputError(f"case: {name}: found {value}, expected a whole number of 64 bits")
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise InputError(f"case: {name}: found {value}, expected a finite number")
        return value
    raise InputError(f"case: {name}: found a {type(value).__name__}, expected a number, a text, a list or a table")


def _is_text(case):
    """Whether a text is TOML rather than a path. A path may contain "=", too."""
    return "\n" in case or ("=" in case and not case.endswith(".toml") and not os.path.exists(case))


def read_case(case: _Case) -> _engine.Case:
    """Reads and checks a case.

    case: a dict of tables (None omits a key), a TOML text (with a line end or "="), or the path of a file. Keys,
    units and defaults are those of `crackle test --keys`. An `include` in a dict or text is relative to the current
    folder. Shipped cases are found as "specimens/...". Raises InputError for an invalid case.
    """
    return _read(case, _engine.read_case_text, _engine.read_case_file)


def read_joints(case: _Case) -> _engine.Joints:
    """Reads the joints of a case, or of a file or text that contains nothing else."""
    if isinstance(case, _engine.Case):
        return _engine.joints_of_case(case)
    return _read(case, _engine.read_joints_text, _engine.read_joints_file)


def _read(case, of_text, of_file):
    if isinstance(case, _engine.Case):
        return case
    if isinstance(case, dict):
        tables = _plain(case, "")
        if isinstance(tables.get("include"), str):
            tables["include"] = given_or_shipped(tables["include"])
        return of_text(json.dumps(tables, ensure_ascii=False), "case", True)
    if isinstance(case, str) and not case:
        raise InputError("case: found an empty text, expected a dict, a TOML text or the path of a file")
    if isinstance(case, str) and _is_text(case):
        return of_text(case, "case", False)
    if isinstance(case, (str, os.PathLike)):
        return of_file(given_or_shipped(case))
    raise InputError(f"case: found a {type(case).__name__}, expected a dict, a TOML text or the path of a file")


def case_keys() -> str:
    """All keys of a case with unit, default, range and a sentence: the text of `crackle test --keys`."""
    return _engine.case_keys()
