#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tests/benchmarks/instruction_sets with fake programs: medians, ratios, counts for each kind, messages."""
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[1] / "benchmarks" / "instruction_sets"

# Reports a rate of BASE for circles and a tenth of it for polygons, multiplied by 1, 2 and 9 in the first, second and
# third run.
PROGRAM = """#!/usr/bin/python3
import os, pathlib, sys
words = sys.argv[1:]
def after(option):
    begin = words.index(option) + 1
    end = next((k for k in range(begin, len(words)) if words[k].startswith("-")), len(words))
    return words[begin:end]
runs = pathlib.Path(__file__).with_suffix(".runs")
kinds = after("--kinds")
if kinds == ["circles"]:
    runs.write_text((runs.read_text() if runs.exists() else "") + "x")
times = [1, 2, 9][len(runs.read_text()) - 1]
base = float(os.environ.get("BASE", "1e6"))
rows = [(kind, count) for kind in kinds for count in after("--counts")]
head = "scene,particles,threads,contacts_per_particle,particle_steps_per_second,bare_kernel_per_second,bytes_per_particle,steps_per_list"
lines = [f"{kind},{count},1,2,{base * times * (1 if kind == 'circles' else 0.1)},{2e7 if kind == 'circles' else 0},{600 + times},0" for
kind, count in rows]
(pathlib.Path(after("-o")[0]) / "throughput.csv").write_text("# Made by `x` on a made-up machine. triad.\\n" + "\\n".join([head] + lines) + "\\n")
"""


class InstructionSets(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("one", "two"):
            path = Path(self.folder.name) / name
            path.write_text(PROGRAM)
            path.chmod(0o755)

    def call(self, *words):
        return subprocess.run([SCRIPT, *words], capture_output=True, text=True, cwd=self.folder.name)

    def rows(self, text):
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("| ")][2:]

    def test_medians_and_ratios(self):
        done = self.call("a=./one", "b=BASE=4e6 ./two", "--counts", "300", "5000", "--most-polygons", "300")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows(done.stdout)
        self.assertEqual([row[:3] for row in rows], [[kind, count, label] for kind, count in (("circles", "300"), ("circles", "5000"), ("delaunay", "300"),
                                                                                             ("voronoi", "300")) for label in "ab"])
        self.assertEqual(rows[0][3:], ["2.0", "1.00", "20.0", "0.10", "601"])  # the rate is that of the second of three runs, the memory that of the first
        self.assertEqual(rows[1][3:], ["8.0", "4.00", "20.0", "0.40", "601"])
        self.assertEqual(rows[4][3:], ["0.2", "1.00", "–", "–", "601"])
        self.assertNotIn("the machine's", done.stdout)
        self.assertIn("on a made-up machine", done.stdout)

    def test_few_rounds_are_said_to_be_few(self):
        done = self.call("a=./one", "--counts", "300", "--rounds", "1", "-o", "table.md")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertIn("differences below a quarter are the machine's", (Path(self.folder.name) / "table.md").read_text())

    def test_wrong_words_and_programs_are_named(self):
        for words, said in ((["nothing"], "'nothing': expected LABEL=COMMAND"), (["a=BASE=1"], "expected LABEL=COMMAND"), (["a=./none"], "No such file"),
                            (["a=/bin/false"], "ended with 1")):
            done = self.call(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
