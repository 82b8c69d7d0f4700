#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results read from their folders: numbers as they were written, figures and pages as the program draws them."""
import base64
import csv
import json
import re
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

import crackle
from small import CASE, InScratch, program, small, toml


class Results(InScratch):
    @classmethod
    def setUpClass(cls):
        cls.result = crackle.test(CASE)

    def test_tables_are_the_files(self):
        for name, table in (("curve", self.result.curve), ("events", self.result.events)):
            with open(Path(self.result.folder) / f"{name}.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file))
            self.assertEqual(list(table), rows[0])
            for k, column in enumerate(rows[0]):
                written = [row[k] for row in rows[1:]]
                if column == "mode":
                    written = [{"tension": 0.0, "shear": 1.0}[word] for word in written]
                numpy.testing.assert_array_equal(table[column], numpy.array(written, dtype=float))
                self.assertFalse(table[column].flags.writeable)
        self.assertEqual(self.result.summary, json.loads((Path(self.result.folder) / "summary.json").read_text()))
        self.assertIsNone(self.result.slips)
        with self.assertRaises(AttributeError) as refused:
            self.result.curve.stress
        self.assertIn("axial_stress", str(refused.exception))

    def test_pandas_takes_a_table(self):
        import pandas
        frame = pandas.DataFrame(self.result.curve)
        read = pandas.read_csv(Path(self.result.folder) / "curve.csv", float_precision="round_trip")
        self.assertEqual(list(frame.columns), list(read.columns))
        numpy.testing.assert_array_equal(frame.axial_stress, read.axial_stress)
        self.assertEqual(frame.axial_stress.max(), self.result.curve.axial_stress.max())

    def test_frames_move_with_the_platens(self):
        recording = self.result.recording
        self.assertEqual(recording.frames[0]["roles"], ["start"])
        end = recording.frame("end")
        cells = recording.cells
        self.assertEqual(len(end.uy), len(cells.id))
        moved = end.uy[cells.platen]
        strain = recording.frames[-1]["axial_strain"]
        # Single precision of the points in a frame.
        numpy.testing.assert_allclose(moved.max() - moved.min(), strain * self.result.summary["initial_height"],
                                      rtol=1e-3)
        self.assertEqual((end.bond_state == 2).sum(), self.result.summary["bonds_broken"])
        self.assertEqual(len(recording.bonds.i), self.result.summary["bonds_initial"])
        with self.assertRaises(IndexError):
            recording.frame(1000)
        with self.assertRaises(crackle.InputError):
            recording.frame("middle")

    def test_a_result_shows_itself(self):
        svg = self.result._repr_svg_()
        ElementTree.fromstring(svg)
        self.assertIn("<svg", svg)
        shown = self.result._repr_html_()
        self.assertIn("iframe srcdoc", shown)
        image = re.search(r'<img src="data:image/svg\+xml;base64,([^"]+)">', shown).group(1)
        ElementTree.fromstring(base64.b64decode(image))
        self.assertIn("strength", shown)
        self.assertIn("circles, tension: strength", repr(self.result))
        self.assertIn("<table>", self.result.curve._repr_html_())
        self.assertIn("rows of axial_strain", repr(self.result.curve))

    def test_figures_are_the_programs(self):
        crackle.plot(self.result, output="by_python.svg", what="curve", width=90)
        words = ("-o", "by_program.svg", "--what", "curve", "--width", 90)
        self.assertEqual(program("plot", self.result.folder, *words).returncode, 0)

        def drawn(text):  # cairo counts its surfaces
            return re.sub(r"(surface|glyph|clip|image|source|mask)-?[0-9]+(-[0-9]+)?", r"\1", text)
        by_program = drawn(Path("by_program.svg").read_text())
        self.assertEqual(drawn(Path("by_python.svg").read_text()), by_program)
        self.assertEqual(drawn(self.result.figure("curve", width=90)), by_program)
        with self.assertRaises(crackle.InputError) as refused:
            crackle.plot(self.result, output="by_python.svg", what="curve")
        self.assertIn("--force", str(refused.exception))
        crackle.report(self.result, output="page.html", title="One test")
        self.assertIn("crackle report", Path("page.html").read_text()[:200])

    def test_particles_show_themselves(self):
        packed = crackle.pack(count=60, radius_min=0.01, radius_max=0.02, mean_overlap=1e-5)
        meshed = crackle.mesh(packed, kind="voronoi", thick=1e-4)
        for shown in (packed, meshed):
            self.assertIn("iframe srcdoc", shown._repr_html_())
        crackle.view(packed, meshed, self.result, output="view.html", title="Three")
        self.assertIn('"title":"Three"', Path("view.html").read_text())
        with self.assertRaises(crackle.InputError) as refused:
            crackle.plot(packed, output="figure.svg")
        self.assertIn("results: found a Particles", str(refused.exception))

    def test_what_is_read_is_what_lies_there(self):
        self.assertIsInstance(crackle.read(self.result.folder), crackle.Result)
        packed = crackle.pack(count=60, radius_min=0.01, radius_max=0.02, mean_overlap=1e-5, output="in_gm.dat")
        self.assertEqual(len(crackle.read("in_gm.dat")), len(packed))
        self.assertEqual(program("run", "specimens/demseg/circle", "-o", "deck", "-q").returncode, 0)
        run = crackle.read("deck")
        self.assertIsInstance(run, crackle.Recording)
        self.assertGreater(len(run.frames), 1)
        Path("empty").mkdir()
        for wrong in ("nothing", "empty"):
            with self.assertRaises(crackle.InputError):
                crackle.read(wrong)

    def test_a_damaged_folder_is_refused(self):
        crackle.test(small(loading={"max_axial_strain": 2e-4}), "out")
        curve = Path("out/curve.csv")
        curve.write_bytes(curve.read_bytes().replace(b"0", b"1", 1))
        with self.assertRaises(crackle.InputError) as refused:
            crackle.read("out")
        self.assertIn("curve.csv", str(refused.exception))


if __name__ == "__main__":
    unittest.main()
