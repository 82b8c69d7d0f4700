#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tests/benchmarks/rock_numbers: a small study of size writes its page, its figure and consistent rows; bad input is refused."""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tests/benchmarks/rock_numbers"


def study(name, out, *more, program=os.environ["CRACKLE_PROGRAM"]):
    return subprocess.run([sys.executable, SCRIPT, name, "--crackle", program, "--out", out, *more], capture_output=True, text=True)


class RockNumbers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def test_size_has_moduli_and_strengths_of_both_units(self):
        done = study("rock_size", self.out, "--cells", "40", "100", "--packings", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.out / "rock_size.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["units"], row["cells"]) for row in rows], [(u, c) for c in ("40", "100") for u in ("area", "point") for _ in range(2)])
        for row in rows:
            # The modulus is between half the contact modulus and the contact modulus; the strength is more than 1 MPa
            # with bonds of 15 MPa.
            self.assertGreater(float(row["youngs_modulus"]), 77e9 / 2)
            self.assertLess(float(row["youngs_modulus"]), 77e9)
            self.assertGreater(float(row["tensile_strength"]), 1e6)
            self.assertLess(abs(float(row["closing_error"])), 1e-3)
        self.assertIn("| area | 40 | 2 |", (self.out / "rock_size.md").read_text())
        self.assertIn("</svg>", (self.out / "rock_size.svg").read_text())

    def test_refuses_sizes_that_make_no_line(self):
        done = study("rock_size", self.out, "--cells", "40")
        self.assertEqual(done.returncode, 2)
        self.assertIn("found one number, expected at least two", done.stderr)
        missing = study("rock_size", self.out, program="nowhere/crackle")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("expected the built program", missing.stderr)


if __name__ == "__main__":
    unittest.main()
