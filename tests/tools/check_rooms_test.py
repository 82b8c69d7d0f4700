#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tools/check_rooms on generated trees: each fault is reported with file and line, and a tree without faults passes."""

import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "check_rooms"

GOOD = {
    "tools/rooms.md": "| room | holds | may include |\n| --- | --- | --- |\n| solver/low | bricks | |\n| solver/high | roof | solver/low |\n",
    "solver/CMakeLists.txt": "add_library(s high/roof.cpp)\ntarget_sources(s PUBLIC FILE_SET HEADERS FILES low/brick.hpp high/roof.hpp)\n",
    "solver/low/brick.hpp": "// Bricks.\n// Tested by tests/solver/high/roof_test.cpp.\n",
    "solver/high/roof.hpp": '#include "solver/low/brick.hpp"\n',
    "solver/high/roof.cpp": '#include "solver/high/roof.hpp"\n',
    "tests/solver/high/roof_test.cpp": '#include "solver/high/roof.hpp"\n',
}


class CheckRooms(unittest.TestCase):
    def checked(self, files=None):
        """Exit code and output for GOOD with these files replaced."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in (GOOD | (files or {})).items():
                file = Path(folder) / path
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
            run = subprocess.run([str(SCRIPT), "--tree", folder], capture_output=True, text=True)
            return run.returncode, run.stdout

    def expect_fault(self, files, *words):
        code, out = self.checked(files=files)
        self.assertEqual(code, 1, out)
        for word in words:
            self.assertIn(word, out)

    def test_a_tree_without_faults_passes(self):
        code, out = self.checked()
        self.assertEqual(code, 0, out)
        self.assertIn("nothing found", out)

    def test_an_arrow_outside_the_table(self):
        self.expect_fault({"tools/rooms.md": GOOD["tools/rooms.md"].replace("roof | solver/low", "roof | ")},
                          "solver/high/roof.hpp:1: includes solver/low/brick.hpp, but solver/high may not include solver/low")

    BENCH = {"tools/rooms.md": GOOD["tools/rooms.md"] + "| tests/bench/scenes | scenes | solver/high |\n",
             "tests/bench/scenes/house.hpp": '#include "solver/high/roof.hpp"\n',
             "tests/bench_tests/scenes/house_test.cpp": '#include "tests/bench/scenes/house.hpp"\n'}

    def test_the_program_in_tests_has_rooms_and_tests(self):
        code, out = self.checked(self.BENCH)
        self.assertEqual(code, 0, out)
        self.expect_fault(self.BENCH | {"tools/rooms.md": GOOD["tools/rooms.md"]}, "tests/bench/scenes: a folder with sources has no row")
        self.expect_fault({path: text for path, text in self.BENCH.items() if not path.endswith("_test.cpp")}, "no tests/bench_tests/scenes/house_test.cpp")

    def test_nothing_outside_tests_includes_what_lies_in_it(self):
        table = self.BENCH["tools/rooms.md"] + "| tools/plot | figures | tests/bench/scenes |\n"
        plot = '// Tested by tests/solver/high/roof_test.cpp.\n#include "tests/bench/scenes/house.hpp"\n'
        self.expect_fault(self.BENCH | {"tools/rooms.md": table, "tools/plot/plot.cpp": plot},
                          "tools/plot/plot.cpp:2: includes tests/bench/scenes/house.hpp, but nothing outside tests/ may include what lies in it")

    def test_an_arrow_that_no_source_has(self):
        self.expect_fault({"solver/high/roof.hpp": "// Roof.\n"}, "may include solver/low, but none of its sources does")

    def test_a_circle_of_rooms_and_of_units(self):
        self.expect_fault({"solver/low/brick.hpp": GOOD["solver/low/brick.hpp"] + '#include "solver/high/roof.hpp"\n'},
                          "a cycle of rooms: solver/high -> solver/low -> solver/high", "a cycle of units")

    def test_too_many_units(self):
        many = {f"solver/low/b{k}.hpp": GOOD["solver/low/brick.hpp"] for k in range(15)}
        self.expect_fault(many, "solver/low: 16 units, expected at most 15")

    def test_a_loose_source_and_a_folder_without_a_row(self):
        self.expect_fault({"solver/loose.hpp": GOOD["solver/low/brick.hpp"]}, "solver/loose.hpp: a source outside a room")
        self.expect_fault({"solver/attic/box.hpp": GOOD["solver/low/brick.hpp"]}, "solver/attic: a folder with sources has no row")

    def test_an_outsider_that_includes_an_internal_header(self):
        files = {"solver/CMakeLists.txt": GOOD["solver/CMakeLists.txt"].replace("low/brick.hpp ", ""),
                 "tools/rooms.md": GOOD["tools/rooms.md"] + "| tools/plot | figures | solver/low |\n",
                 "tools/plot/plot.cpp": '// Tested by tests/solver/high/roof_test.cpp.\n#include "solver/low/brick.hpp"\n'}
        self.expect_fault(files, "tools/plot/plot.cpp:2: includes solver/low/brick.hpp, which is internal to solver/")

    def test_a_unit_without_a_test(self):
        self.expect_fault({"solver/low/brick.hpp": "// Bricks.\n"}, "no tests/solver/low/brick_test.cpp")
        self.expect_fault({"solver/low/brick.hpp": "// Tested by tests/solver/lost_test.cpp.\n"}, "tests/solver/lost_test.cpp, which does not exist")

    def test_a_page_or_comment_that_names_what_is_gone(self):
        self.expect_fault({"README.md": "See solver/low/mortar.hpp.\n"}, "README.md:1: names solver/low/mortar.hpp, which does not exist")
        self.expect_fault({"solver/high/roof.cpp": GOOD["solver/high/roof.cpp"] + "// see mortar.hpp\n"}, "names mortar.hpp, which does not exist")


if __name__ == "__main__":
    unittest.main()
