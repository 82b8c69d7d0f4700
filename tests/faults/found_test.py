# SPDX-License-Identifier: GPL-3.0-or-later
"""Regression tests: failing calls that were once handled wrongly. Each must be reported in one line, and the same command must then end as
if undisturbed."""

import os
import re
import tempfile
import unittest
from pathlib import Path

from failing_calls import attempt
from judgement import GOOD
from program import Program
from scenes import scenes

PROGRAM = Program(os.environ["CRACKLE_PROGRAM"], os.environ["INJECTED_FAULTS"])
# By scene: kind, file, mode and error of the failing call, and its offset from the first such call.
FOUND = {
    "campaign": (
        ("stat", r"out/packings/\w+\.crackle_tmp", "on", "EIO"),  # temporary files were made endlessly
        # The message stated an input/output error for every cause.
        ("write", r"out/campaign\.sqlite-shm", "once", "ENOSPC"),
        ("mmap", r"out/campaign\.sqlite-shm", "on", "ENOMEM"),
        ("truncate", r"out/campaign\.sqlite-shm", "on", "EPERM"),
        # The message named a missing file although the ledger exists.
        ("open", r"out/campaign\.sqlite-shm", "once", "EACCES"),
    ),
    "campaign, again": (
        # Unreadable pages were reported as damage, with exit code 2.
        ("read", r"out/campaign\.sqlite", "once", "EIO", 1),
        ("read", r"out/campaign\.sqlite", "on", "EIO", 1),
    ),
    "report of a campaign": (("stat", r"out/campaign\.sqlite", "on", "EIO", 4),),  # a failing disc was reported as a lack of permission
    "calibrate": (
        # If a folder could not be listed, its curves were left out of the page.
        ("opendir", r"out/fresh/curves", "once", "EMFILE"),
        ("readdir", r"out/fresh/curves", "once", "EIO"),
        ("mkdir", r"out/search/packings", "on", "EACCES", 1),  # the empty folder was then refused as a foreign one
    ),
    "run --continue": (
        ("read", r"out/energy\.dat", "once", "EIO"),  # its rows were truncated
        ("read", r"out/energy\.dat", "on", "EIO"),
    ),
}


class Found(unittest.TestCase):
    def test_each(self):
        for scene in scenes():
            if scene.name not in FOUND:
                continue
            with tempfile.TemporaryDirectory() as folder:
                origin, place = Path(folder).resolve() / "origin", Path(folder).resolve() / "place"
                scene.prepare(PROGRAM, origin)
                scene.restore(origin)
                calls = PROGRAM.calls(scene.command, origin).calls
                for kind, path, mode, error, *behind in FOUND[scene.name]:
                    with self.subTest(scene=scene.name, kind=kind, path=path, mode=mode):
                        call = [call for call in calls if call.kind == kind and re.fullmatch(path, call.path)][sum(behind)]
                        outcome, run = attempt(PROGRAM, scene, place, origin, {"call": kind, "at": call.number, "mode": mode, "errno": error})
                        print(f"  {kind} {call.number} {mode} {error}: {run.code} {run.err.strip()}")
                        self.assertTrue(run.calls, "the call was not reached")
                        self.assertIn(outcome.kind, GOOD, outcome.faults)


if __name__ == "__main__":
    unittest.main()
