# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes bonded rock specimens and tests them: the commands of the program `crackle`, with arrays and callbacks.

    result = crackle.test("specimens/guide_rock/circles_tension.toml")
    print(result, result.summary["peak_stress"], result.curve.axial_stress)
    crackle.plot(result, output="tension.svg")

A case is a dict, a TOML text or the path of a file; `case_keys()` lists its keys.

    pack, mesh, joints          circles, polygons made from them, traces of joints
    specimen                    the particles of a case, before they are bonded
    check, elastic              estimates of a test's results, the linear solution
    test, resume                one virtual test; call=f observes and controls it while it runs
    World                       a specimen that is stepped and loaded from Python
    campaign, calibrate         tables of tests on all processors; a rock's keys from its laboratory values
    envelope, plot, report      strength against confinement, figures, interactive pages
    view                        pages that show particles
    read, read_case             results written by the program, and cases

The functions' help texts, such as help(crackle.test), state units, defaults and errors. Invalid input raises InputError; a run
that becomes unstable raises UnstableRun. Documentation: specimens/python/README.md.
"""
try:
    from . import _engine
except ImportError:
    import importlib.machinery
    import os
    import sys

    _there = os.listdir(os.path.dirname(__file__))
    if any("_engine" + ending in _there for ending in importlib.machinery.EXTENSION_SUFFIXES):
        raise  # the engine was built for this Python, but one of its libraries is missing
    _built = ", ".join(name for name in _there if name.startswith("_engine.") and ".so" in name) or "its engine"
    raise ImportError(f"crackle: found {sys.executable}, {sys.implementation.cache_tag}, expected the Python that "
                      f"{_built} was built for; Debian's is /usr/bin/python3") from None
from ._case import case_keys, read_case
from ._engine import Case, Particles, State
from ._errors import InputError, OutputError, SystemFailure, UnstableRun
from ._results import Calibration, Campaign, Recording, Result, Table, read
from ._tests import (Elastic, calibrate, campaign, check, elastic, envelope, joints, mesh, pack, plot, report, resume,
                     specimen, test, view)
from ._world import World

__all__ = ["Calibration", "Campaign", "Case", "Elastic", "InputError", "OutputError", "Particles", "Recording",
           "Result", "State", "SystemFailure", "Table", "UnstableRun", "World", "calibrate", "campaign", "case_keys",
           "check", "elastic", "envelope", "joints", "mesh", "pack", "plot", "read", "read_case", "report", "resume",
           "specimen", "test", "view"]
setattr(test, "__test__", False)  # pytest must not collect it as a test
