#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests results that are read from folders: the numbers are those of the files, and figures and pages those of the program."""
import base64
import contextlib
import csv
import json
import re
import sqlite3
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy

import crackle
from small import CASE, TOP, InScratch, program, small, toml

sys.path.insert(0, str(TOP / "tests" / "recount"))
from results import Results as Results_of_recount  # noqa: E402  written from the documents, not from the program


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
        # Points in a frame have single precision.
        numpy.testing.assert_allclose(moved.max() - moved.min(), strain * self.result.summary["initial_height"],
                                      rtol=1e-3)
        self.assertEqual((end.bond_state == 2).sum(), self.result.summary["bonds_broken"])
        self.assertEqual(len(recording.bonds.i), self.result.summary["bonds_initial"])
        with self.assertRaises(IndexError):
            recording.frame(1000)
        with self.assertRaises(crackle.InputError):
            recording.frame("middle")

    def test_arrays_of_a_frame_are_those_of_its_files(self):
        squeezed = crackle.test(small(loading={"kind": "compression", "axial_strain_rate": 0.05, "max_axial_strain": 0.05,
                                               "stop_at_share_of_peak": 0.05}))
        recording = squeezed.recording
        end, ids = recording.frame(len(recording.frames) - 1), recording.cells.id
        row = int(re.search(r"particles_(\d+)", recording.frames[-1]["file"]).group(1))
        written = Results_of_recount(squeezed.folder)
        particles, contacts = written.particles(row), written.contacts(row)
        numpy.testing.assert_array_equal(ids, particles["id"])
        for name in ("angle", "rotation_rate", "stress_xx", "stress_yy", "stress_xy", "fragment"):
            numpy.testing.assert_array_equal(end[name], particles[name], name)
        for k, name in enumerate(("vx", "vy")):
            numpy.testing.assert_array_equal(end[name], particles["velocity"][:, k], name)
        outlines = {body.id: body for body in written.specimen.bodies}
        inside = ~recording.cells.platen
        self.assertEqual(set(ids[~inside]), {squeezed.summary["platen_bottom_id"], squeezed.summary["platen_top_id"]})
        for k in numpy.flatnonzero(inside):
            x, y, radius = outlines[int(ids[k])].circles[0]
            numpy.testing.assert_allclose([recording.cells[name][k] for name in ("x", "y", "radius")], [x, y, radius], rtol=1e-6)
            self.assertEqual((recording.cells.material[k], len(recording.cells.outline[k])), (1, 0))
        for name in ("time", "axial_strain", "axial_stress"):
            self.assertEqual(recording.frames[-1][name], float(particles[name][0]), name)
        self.assertEqual(recording.frames[-1]["roles"], ["end"])
        # Bonds come first, followed by other contacts.
        bonds = squeezed.summary["bonds_initial"]
        self.assertEqual(len(end.bond_state), bonds)
        self.assertGreater(len(contacts["state"]), bonds + 2, "some contacts are not bonds")
        numpy.testing.assert_array_equal(end.bond_state, contacts["state"][:bonds])
        numpy.testing.assert_array_equal(ids[recording.bonds.i], contacts["body_i"][:bonds])
        numpy.testing.assert_array_equal(ids[recording.bonds.j], contacts["body_j"][:bonds])
        numpy.testing.assert_array_equal(ids[numpy.asarray(end.contact_i, int)], contacts["body_i"][bonds:])
        numpy.testing.assert_array_equal(ids[numpy.asarray(end.contact_j, int)], contacts["body_j"][bonds:])
        for name in ("normal_force", "shear_force"):
            numpy.testing.assert_array_equal(end["bond_" + name], contacts[name][:bonds], name)
            numpy.testing.assert_array_equal(end["contact_" + name], contacts[name][bonds:], name)
        for k, name in enumerate(("contact_x", "contact_y")):
            places = contacts["points"][-len(contacts["state"]):]  # after those of the particles
            numpy.testing.assert_allclose(end[name], places[bonds:, k], rtol=1e-6)

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

        def drawn(text):  # cairo numbers its surfaces
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
        step = run.frames[1]["time"] / run.frames[1]["step"]
        self.assertAlmostEqual(run.frames[-1]["time"] / (run.frames[-1]["step"] * step), 1.0, delta=1e-12)
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


class Ledgers(InScratch):
    """A small campaign or calibration, in a folder whose name contains characters with a meaning in URIs."""

    def setUp(self):
        super().setUp()
        self.folder = Path("a ?#%41").absolute()
        self.folder.mkdir()
        with contextlib.closing(sqlite3.connect(self.folder / "campaign.sqlite")) as ledger:
            ledger.executescript("""
                PRAGMA application_id = 0x43524b4c;
                CREATE TABLE point(number); CREATE TABLE plan(row); CREATE TABLE meta(key, value);
                CREATE TABLE test(identity TEXT, state TEXT, name TEXT, stress REAL);
                INSERT INTO test VALUES ('1a', 'done', 'one', 1.5), ('2b', 'done', 'two', 2.5);
                CREATE VIEW results AS SELECT name, stress FROM test;""")
        self.campaign = crackle.read(self.folder)

    def test_a_query_reads(self):
        self.assertEqual(self.campaign.results, {"name": ["one", "two"], "stress": [1.5, 2.5]})
        self.assertEqual(self.campaign.query("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 3)"
                                             " SELECT sum(i * stress) AS s FROM n JOIN test").s, [24.0])
        self.assertEqual(self.campaign.query("PRAGMA table_info(test)").name, ["identity", "state", "name", "stress"])

    def test_a_query_does_nothing_but_read(self):
        before = (self.folder / "campaign.sqlite").read_bytes()
        for sql in (f"ATTACH '{self.folder}/other.sqlite' AS other", f"VACUUM INTO '{self.folder}/copy.sqlite'",
                    "PRAGMA user_version = 3", "PRAGMA journal_mode = WAL", "PRAGMA wal_checkpoint", "DELETE FROM test",
                    "CREATE TEMP TABLE other(x)", "BEGIN", "SELECT load_extension('other')", "SELECT 1; DELETE FROM test",
                    "no SQL", ""):
            with self.subTest(sql=sql), self.assertRaises(crackle.InputError) as refused:
                self.campaign.query(sql)
            self.assertIn("expected", str(refused.exception))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["campaign.sqlite"])
        self.assertEqual((self.folder / "campaign.sqlite").read_bytes(), before)

    def test_damaged_files_are_refused(self):
        ledger = self.folder / "campaign.sqlite"
        whole = ledger.read_bytes()
        for bytes in (b"no ledger" * 100, whole[:4096] + b"\xff" * (len(whole) - 4096), b""):
            ledger.write_bytes(bytes)
            with self.subTest(bytes=bytes[:9]), self.assertRaises(crackle.InputError) as refused:
                self.campaign.results
            self.assertIn("campaign.sqlite", str(refused.exception))
        ledger.unlink()
        with self.assertRaises(crackle.InputError):
            self.campaign.results
        for bytes in (b"", b"{", b"[1]", b"\xff{}", b"[" * 200000, b'{"a":' + b"1" * 5000 + b"}", b'{"a":NaN}'):
            (self.folder / "calibration.json").write_bytes(bytes)
            with self.subTest(bytes=bytes[:9]), self.assertRaises(crackle.InputError) as refused:
                crackle.read(self.folder)
            self.assertIn("calibration.json", str(refused.exception))
        (self.folder / "calibration.json").write_text("{}", encoding="utf-8")
        for bytes in (b"\xff", None):
            page = self.folder / "calibration.html"
            page.unlink() if bytes is None else page.write_bytes(bytes)
            with self.subTest(page=bytes), self.assertRaises(crackle.InputError) as refused:
                crackle.read(self.folder).page()
            self.assertIn("calibration.html", str(refused.exception))

    def test_no_command_of_a_terminal_is_shown(self):
        hostile = "a\x1b]0;b\x07\x9bc\x7f"
        for shown in (str(crackle.InputError(hostile)), repr(crackle.Table({hostile: []})),
                      repr(crackle.Campaign(hostile))):
            self.assertIn("a\\x1b]0;b\\x07\\u009bc\\u007f", shown)
            self.assertTrue(shown.isprintable())


if __name__ == "__main__":
    unittest.main()
