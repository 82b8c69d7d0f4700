# SPDX-License-Identifier: GPL-3.0-or-later
"""Crackle: bonded rock specimens, made and tested virtually in two dimensions.

    import crackle
    result = crackle.test("specimens/guide_rock/circles_tension.toml")
    result.curve.axial_stress.max(), result.summary["peak_stress"]

Words, keys, units and defaults are those of the command line: `crackle COMMAND --help`, crackle.case_keys().
Lengths in m, stresses in N/m (Pa with material.units = "area"), angles in rad unless stated.
"""
from ._case import case_keys, read_case
from ._engine import Case, Particles, State
from ._errors import InputError, OutputError, UnstableRun
from ._results import Calibration, Campaign, Recording, Result, Table, read
from ._tests import (Elastic, calibrate, campaign, check, elastic, envelope, mesh, pack, plot, report, resume, test)
from ._world import World

__all__ = ["Calibration", "Campaign", "Case", "Elastic", "InputError", "OutputError", "Particles", "Recording", "Result",
           "State", "Table", "UnstableRun", "World", "calibrate", "campaign", "case_keys", "check", "elastic", "envelope",
           "mesh", "pack", "plot", "read", "read_case", "report", "resume", "test"]
test.__test__ = False  # no test of pytest's
