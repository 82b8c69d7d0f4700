# SPDX-License-Identifier: GPL-3.0-or-later
from ._case import case_keys, read_case
from ._engine import Case, Particles, State
from ._errors import InputError, OutputError, UnstableRun
from ._results import Calibration, Campaign, Recording, Result, Table, read
from ._tests import (Elastic, calibrate, campaign, check, elastic, envelope, joints, mesh, pack, plot, report, resume,
                     test)
from ._world import World

__all__ = ["Calibration", "Campaign", "Case", "Elastic", "InputError", "OutputError", "Particles", "Recording",
           "Result", "State", "Table", "UnstableRun", "World", "calibrate", "campaign", "case_keys", "check", "elastic",
           "envelope", "joints", "mesh", "pack", "plot", "read", "read_case", "report", "resume", "test"]
test.__test__ = False  # no test of pytest's
