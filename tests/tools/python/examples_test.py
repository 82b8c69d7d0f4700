#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that the examples of specimens/python run and print the expected output, which is given at the end of each file in lines that begin
with #>."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

from small import TOP, InScratch

EXAMPLES = sorted((TOP / "specimens" / "python").glob("*.py"))


class Examples(InScratch):
    def test_there_are_five(self):
        self.assertEqual(len(EXAMPLES), 5)

    def run_of(self, name):
        import_it = [sys.executable, "-c", "import matplotlib"]
        if name == "paper_figure.py" and subprocess.run(import_it, capture_output=True, check=False).returncode != 0:
            self.skipTest("no matplotlib (tools/install_packages test)")
        script = TOP / "specimens" / "python" / name
        done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False, env=os.environ)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = [line[3:] for line in script.read_text(encoding="utf-8").splitlines() if line.startswith("#> ")]
        self.assertGreater(len(expected), 0)
        self.assertEqual(done.stdout.splitlines(), expected)

    def test_paper_figure_is_drawn(self):
        self.run_of("paper_figure.py")
        self.assertGreater(Path("paper_figure.pdf").stat().st_size, 10_000)


for example in EXAMPLES:
    if example.name != "paper_figure.py":
        setattr(Examples, "test_" + example.stem, lambda self, name=example.name: self.run_of(name))


if __name__ == "__main__":
    unittest.main()
