#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that a difference is reported with its first row and column, between two results and against the record."""

import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest

loader = importlib.machinery.SourceFileLoader("same_bytes", str(pathlib.Path(__file__).resolve().parent / "same_bytes"))
same_bytes = importlib.util.module_from_spec(importlib.util.spec_from_loader("same_bytes", loader))
loader.exec_module(same_bytes)

TABLE = ["# made by a test", "strain,stress,breaks"] + [f"{k},{2 * k},{k // 7}" for k in range(100)]


def changed(row, text):
    return TABLE[:row] + [text] + TABLE[row + 1 :]


class Differences(unittest.TestCase):
    def test_of_two_tables_name_row_and_column(self):
        self.assertIsNone(same_bytes.difference("curve.csv", TABLE, list(TABLE)))
        self.assertEqual(same_bytes.difference("curve.csv", TABLE, changed(42, "40,81,5")), "curve.csv: row 43, column stress: expected 80, got 81")
        self.assertEqual(same_bytes.difference("curve.csv", TABLE, TABLE[:-1]), "curve.csv: 101 rows, expected 102")

    def test_of_rows_without_a_header_name_the_field(self):
        self.assertEqual(same_bytes.difference("cont.dat", ["1 2 3", "4 5 6"], ["1 2 3", "4 5 7"]), "cont.dat: row 2, column 3: expected 6, got 7")

    def test_from_the_record_name_rows_and_columns(self):
        record = same_bytes.record_of(TABLE)
        self.assertIsNone(same_bytes.recorded_difference("curve.csv", record, TABLE))
        found = same_bytes.recorded_difference("curve.csv", record, changed(42, "40,81,5"))
        self.assertRegex(found, r"^curve.csv: first differs in rows (\d+) to (\d+), columns stress$")
        first, last = (int(word) for word in found.split("rows ")[1].split(",")[0].split(" to "))
        self.assertLessEqual(first, 43)
        self.assertGreaterEqual(last, 43)
        self.assertLessEqual(last - first, len(TABLE) // same_bytes.PREFIXES + 1)

    def test_of_files_are_named(self):
        self.assertEqual(same_bytes.compared({"a": ["1"], "b": []}, {"a": ["1"], "c": []}), "files: no b, c is new")

    def test_of_frames_are_seen_whatever_their_compression(self):
        import base64
        import zlib

        def frame(numbers, level):
            packed = zlib.compress(numbers, level)
            header = b"".join(n.to_bytes(8, "little") for n in (1, 32768, len(numbers), len(packed)))
            text = base64.b64encode(header).decode() + base64.b64encode(packed).decode()
            return f'<DataArray type="Float64" Name="ux" format="binary">{text}</DataArray>'

        numbers = bytes(range(256)) * 8
        self.assertNotEqual(frame(numbers, 1), frame(numbers, 9))
        self.assertEqual(same_bytes.frame_rows(frame(numbers, 1)), same_bytes.frame_rows(frame(numbers, 9)))
        self.assertNotEqual(same_bytes.frame_rows(frame(numbers, 1)), same_bytes.frame_rows(frame(numbers[:-1] + b"x", 1)))

    def test_recorded_anew_of_one_scene_leave_the_others(self):
        record = {"a": {"x": ["1", "old", ""]}, "b": {"x": ["1", "old", ""], "y": ["2", "old", ""]}, "gone": {"x": ["1", "old", ""]}}
        self.assertEqual(same_bytes.with_the_others([["b", "x", "1", "new", ""]], record, ["a", "b"]), [["a", "x", "1", "old", ""], ["b", "x", "1", "new", ""]])

    def test_of_the_run_are_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "summary.json"
            path.write_text('{"peak_stress": 2.5, "wall_seconds": 3.0, "packing": {"overlap": 1e-5}}')
            self.assertEqual(same_bytes.rows_of(path), ["peak_stress = 2.5", "packing.overlap = 1e-05"])
            path = pathlib.Path(folder) / "case.toml"
            path.write_text('# Resolved case of crackle 0.2.0: every value.\ntitle = "crackle 0.2.0: a"\n')
            self.assertEqual(same_bytes.rows_of(path), ["# Resolved case of crackle: every value.", 'title = "crackle 0.2.0: a"'])
            path = pathlib.Path(folder) / "checkpoint"

            def checkpoint(case, state):
                data = b"crackle test checkpoint 1\n" + (64).to_bytes(8, "little") + case * 64 + state
                path.write_bytes(data + same_bytes.digest(data, 64).encode())
                return same_bytes.rows_of(path)

            self.assertEqual(checkpoint(b"a", b"state"), checkpoint(b"b", b"state"))
            self.assertNotEqual(checkpoint(b"a", b"state"), checkpoint(b"a", b"stats"))
            self.assertNotEqual(checkpoint(b"a", b"state"), checkpoint(b"a", b"states"))


if __name__ == "__main__":
    unittest.main()
