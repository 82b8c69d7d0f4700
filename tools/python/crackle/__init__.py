# SPDX-License-Identifier: GPL-3.0-or-later
"""Bonded rock specimens, made and tested virtually: the words of the program `crackle`, with arrays and callbacks.

    result = crackle.test("specimens/guide_rock/circles_tension.toml")
    print(result, result.summary["peak_stress"], result.curve.axial_stress)
    crackle.plot(result, output="tension.svg")

A case is a dict, a TOML text or the path of a file; `case_keys()` lists its keys.

    pack, mesh, joints          specimens: circles, polygons of them, traces of joints
    check, elastic              what a test would give: estimates, the linear solution
    test, resume                one virtual test; call=f looks at it and drives it while it runs
    World                       a specimen that Python steps and loads itself
    campaign, calibrate         tables of tests on all processors; a rock's keys from its laboratory values
    envelope, plot, report      strength over confinement, figures, interactive pages
    view                        pages to look at particles
    read, read_case             what the program has written, and cases

help(crackle.test) and its likes tell of units, defaults and errors. What is wrong is an InputError, a run that goes
wrong an UnstableRun. Pages: specimens/python/README.md.
"""
try:
    from . import _engine
except ImportError:
    import importlib.machinery
    import os
    import sys

    _there = os.listdir(os.path.dirname(__file__))
    if any("_engine" + ending in _there for ending in importlib.machinery.EXTENSION_SUFFIXES):
        raise  # of this Python: something that the engine needs is missing
    _built = ", ".join(name for name in _there if name.startswith("_engine.") and ".so" in name) or "its engine"
    raise ImportError(f"crackle: found {sys.executable}, {sys.implementation.cache_tag}, expected the Python that "
                      f"{_built} was built for; Debian's is /usr/bin/python3") from None
from ._case import case_keys, read_case
from ._engine import Case, Particles, State
from ._errors import InputError, OutputError, UnstableRun
from ._results import Calibration, Campaign, Recording, Result, Table, read
from ._tests import (Elastic, calibrate, campaign, check, elastic, envelope, joints, mesh, pack, plot, report, resume,
                     test, view)
from ._world import World

__all__ = ["Calibration", "Campaign", "Case", "Elastic", "InputError", "OutputError", "Particles", "Recording",
           "Result", "State", "Table", "UnstableRun", "World", "calibrate", "campaign", "case_keys", "check", "elastic",
           "envelope", "joints", "mesh", "pack", "plot", "read", "read_case", "report", "resume", "test", "view"]
setattr(test, "__test__", False)  # no test of pytest's
