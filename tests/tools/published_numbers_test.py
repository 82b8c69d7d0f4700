#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tests/benchmarks/published_numbers: small studies write their pages, and results of another program are refused."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tests/benchmarks/published_numbers"
PROGRAM = os.environ["CRACKLE_PROGRAM"]


def study(name, out, *more, program=PROGRAM):
    words = [sys.executable, SCRIPT, name, "--crackle", program, "--out", out, "--kinds", "voronoi_tension", "--packings", "2", *more]
    return subprocess.run(words, capture_output=True, text=True)


class PublishedNumbers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def rows(self, name):
        with open(self.out / f"{name}.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_stated_errors_cover_a_ten_times_slower_run(self):
        done = study("stated", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("stated")
        self.assertEqual(len(rows), 2)
        for row in rows:
            self.assertGreater(float(row["stated_error"]), 0)
            self.assertEqual(int(row["covered"]), int(float(row["actual_difference"]) <= float(row["stated_error"])))
            self.assertGreater(int(row["steps_slow"]), 5 * int(row["steps"]))
        self.assertIn("| voronoi, tension |", (self.out / "stated.md").read_text())

    def test_moduli_agree_and_a_second_call_runs_nothing_anew(self):
        self.assertEqual(study("modulus", self.out).returncode, 0)
        for row in self.rows("modulus"):
            self.assertAlmostEqual(float(row["intact"]) / float(row["solve"]), 1, delta=0.005)
        before = {path: path.stat().st_mtime_ns for path in self.out.rglob("summary.json")}
        self.assertEqual(study("modulus", self.out).returncode, 0)
        self.assertEqual({path: path.stat().st_mtime_ns for path in self.out.rglob("summary.json")}, before)

    def test_strengths_by_four_drops_and_what_moves_them(self):
        done = study("strength", self.out, "--slow-packings-of", "voronoi_tension", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = self.rows("strength")
        for row in (first, second):
            summary = json.loads((self.out / f"voronoi_tension/{row['seed']}_as_shipped/summary.json").read_text())
            self.assertEqual(float(row["as_shipped_0.1"]), summary["peak_stress"], "the value of the program")
            self.assertEqual(float(row["as_shipped_largest"]), summary["largest_stress"])
            half = json.loads((self.out / f"voronoi_tension/{row['seed']}_half_step/summary.json").read_text())
            self.assertAlmostEqual(half["time_step_mean"] / summary["time_step_mean"], 0.5, delta=0.01)
            strengths = [float(row[f"as_shipped_{drop}"]) for drop in ("0.05", "0.1", "0.2", "0.5", "largest")]
            self.assertEqual(strengths, sorted(strengths), "a deeper drop finds no smaller maximum")
        self.assertEqual(second["slow_0.1"], "", "not run")
        self.assertNotEqual(first["slow_0.1"], "")
        self.assertIn("| voronoi, tension | 0.1 |", (self.out / "strength.md").read_text())

    def test_refuses_results_of_another_program(self):
        self.out.mkdir()
        (self.out / "program.sha256").write_text("another")
        done = study("modulus", self.out)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("results of another build", done.stderr)
        missing = study("modulus", self.out, program="nowhere/crackle")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("expected the built program", missing.stderr)


if __name__ == "__main__":
    unittest.main()
