#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tools/compare_with_guide.py on generated summaries: ratios, exit codes, error messages."""
import json
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "tools" / "compare_with_guide.py"

# Values for which all ratios differ.
STRENGTH = {"circles": (4.85e3, 9.7e3), "delaunay": (20e3, 220e3), "voronoi": (30e3, 480e3)}
STIFFNESS = {"circles": 5.0e6, "delaunay": 16.0e6, "voronoi": 20.0e6}
CONTACTS = {"circles": 700, "delaunay": 3500, "voronoi": 4900}
INTERFACES = {"circles": 690, "delaunay": 828, "voronoi": 900}
PARTICLES = {"circles": 304, "delaunay": 612, "voronoi": 304}


def summary(specimen, loading):
    return {"failed": True, "kind": loading, "specimen": specimen, "largest_stress": STRENGTH[specimen][loading == "compression"],
            "strain_at_largest_stress": 0.00211, "peak_stress": 1e3, "peak_strain": 0.001, "initial_tangent_modulus": STIFFNESS[specimen], "youngs_modulus": 1.5 * STIFFNESS[specimen],
            "contacts_initial": CONTACTS[specimen], "interfaces_initial": INTERFACES[specimen], "particles": PARTICLES[specimen],
            "mean_back_tension": 774.0}


class Comparison(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for specimen in STRENGTH:
            for loading in ("tension", "compression"):
                self.write(specimen, loading, summary(specimen, loading))

    def write(self, specimen, loading, keys):
        place = self.folder / f"{specimen}_{loading}"
        place.mkdir(exist_ok=True)
        (place / "summary.json").write_text(json.dumps(keys), encoding="utf-8")

    def compare(self, *arguments):
        done = subprocess.run([sys.executable, PROGRAM, *(arguments or [self.folder])], capture_output=True, text=True, check=False)
        print(done.stdout, done.stderr, sep="")
        return done

    def line_of(self, lines, section, what):
        start = lines.index(section)
        for line in lines[start + 1:]:
            if not line.startswith("  "):
                break
            if line.startswith(f"  {what}  "):
                return line
        self.fail(f"no line «{what}» under «{section}»")

    def test_all_failed_is_success(self):
        done = self.compare()
        self.assertEqual(done.returncode, 0)
        self.assertIn("All six specimens have failed.", done.stdout)

    def test_means_of_packings_stand_beside(self):
        (self.folder / "campaign").mkdir()
        with sqlite3.connect(self.folder / "campaign" / "campaign.sqlite") as ledger:
            keys = [key for key in summary("circles", "tension") if key not in ("kind", "specimen")]
            ledger.execute(f"CREATE TABLE results(test, seed, variant, state, {', '.join(keys)})")
            for seed, factor in ((1, 1.0), (2, 2.0), (3, 3.0), (4, 100.0)):
                for specimen in STRENGTH:
                    for loading in ("tension", "compression"):
                        figures = summary(specimen, loading)
                        figures["largest_stress"] *= factor if loading == "compression" else 1.0
                        # One test of the fourth packing is unfinished, so means exclude it. Companions are not counted
                        # as tests.
                        state = "crashed" if (seed, specimen, loading) == (4, "voronoi", "tension") else "done"
                        for variant, scale in (("as_asked", 1.0), ("half_step", 7.0)):
                            figures["largest_stress"] *= scale
                            ledger.execute(f"INSERT INTO results VALUES({', '.join('?' * (len(keys) + 4))})",
                                           [f"{specimen}_{loading}", seed, variant, state, *(figures[key] for key in keys)])
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertTrue(lines[0].endswith("3 packings"), lines[0])
        line = self.line_of(lines, "circles", "compressive over tensile strength")
        self.assertTrue(line.endswith("4.0 ± 2.0"), line)

    def test_ratios_stand_beside_the_guides_words(self):
        expected = [
            ("circles", "initial stiffness, pulled, over 19.4/0.0019 kN/m", "about 1/2", "0.49 "),  # 5e6 / (19.4e3/0.0019)
            ("circles", "the same with every bond intact (sparse solve)", "", "0.73 "),
            ("circles", "tensile strength over 19.4 kN/m", "about 1/4", "0.25 "),
            ("circles", "compressive strength over 19.4 kN/m", "about 1/2", "0.50 "),
            ("circles", "compressive over tensile strength", "about 2", " 2.0"),
            ("triangles", "number", "537", " 612"),
            ("triangles", "contact points over the circles'", "about 10", " 5.0 "),
            ("triangles", "interfaces over the circles'", "", " 1.2 "),
            ("triangles", "initial stiffness over the circles', pulled", "3.2", " 3.20"),
            ("triangles", "strain at tensile strength", "about 0.002", " 0.00211"),
            ("triangles", "compressive over tensile strength", "about 10", " 11.0"),
            ("Voronoi polygons", "contact points over the triangles'", "1.2", " 1.40 "),
            ("Voronoi polygons", "compressive strength over the triangles'", "larger", " 2.18 "),
            ("Voronoi polygons", "compressive over tensile strength", "more", " 16.0"),
        ]
        lines = self.compare().stdout.splitlines()
        for section, what, guide, number in expected:
            with self.subTest(section=section, what=what):
                line = self.line_of(lines, section, what)
                self.assertIn(guide, line)
                self.assertIn(number, line)

    def test_a_specimen_that_has_not_failed_is_named(self):
        keys = summary("voronoi", "compression")
        keys["failed"] = False
        for key in ("peak_stress", "peak_strain"):
            keys[f"{key}_so_far"] = keys.pop(key)
        self.write("voronoi", "compression", keys)
        done = self.compare()
        self.assertEqual(done.returncode, 1)
        self.assertIn("Not failed: voronoi_compression", done.stdout)
        self.assertNotIn("All six", done.stdout)

    def test_bad_input_ends_in_one_message(self):
        file = self.folder / "delaunay_tension" / "summary.json"
        keys = summary("delaunay", "tension")
        for text, expected in [
                (None, "file not found"),
                ("{", "malformed JSON"),
                ("[]", "failed: found no object, expected true or false"),
                (json.dumps({**keys, "failed": "yes"}), "failed: found yes, expected true or false"),
                (json.dumps({**keys, "initial_tangent_modulus": None}), "initial_tangent_modulus: found null, expected a number"),
        ]:
            with self.subTest(expected=expected):
                file.unlink(missing_ok=True)
                if text is not None:
                    file.write_text(text, encoding="utf-8")
                done = self.compare()
                self.assertEqual(done.returncode, 2)
                self.assertIn(expected, done.stderr)
                self.assertIn(str(file), done.stderr)
                self.assertEqual(done.stdout, "")

    def test_wrong_use_shows_how(self):
        self.assertEqual(self.compare("--help").returncode, 0)
        self.assertEqual(self.compare("a", "b").returncode, 2)


if __name__ == "__main__":
    unittest.main()
