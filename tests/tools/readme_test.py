#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the README says is so: its commands run, its tables name what the program writes, its links lead somewhere.

  CRACKLE_PROGRAM    the program
Blocks marked `sh` run in their order in one shell, in an empty folder that has the project's specimens/ and the built program
where the README expects them; then those marked `python`, as one script in the same folder. Commands of blocks marked `sh ci`
must stand in .ci/run.
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
README = (TOP / "README.md").read_text(encoding="utf-8")
PROGRAM = Path(os.environ["CRACKLE_PROGRAM"]).resolve()


def blocks(mark):
    return re.findall(rf"^```{mark}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def table(heading):
    """First cells of the table that follows the line beginning with `heading`, each without its backquotes."""
    start = README.index("\n" + heading)
    rows = re.search(r"\n\n((?:\|.*\n)+)", README[start:]).group(1).splitlines()[2:]
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row.split("|")[1])]


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.folder / "specimens").symlink_to(TOP / "specimens")
        (cls.folder / "build" / "release").mkdir(parents=True)
        (cls.folder / "build" / "release" / "tools").symlink_to(PROGRAM.parent)
        cls.run_of_commands = subprocess.run(["bash", "-eux", "-c", "\n".join(blocks("sh"))], cwd=cls.folder, capture_output=True,
                                             text=True, check=False, stdin=subprocess.DEVNULL)
        print(cls.run_of_commands.stdout, cls.run_of_commands.stderr, sep="")
        cls.run_of_python = subprocess.run([sys.executable, "-c", "\n".join(blocks("python"))], cwd=cls.folder, capture_output=True,
                                           text=True, check=False, stdin=subprocess.DEVNULL)
        print(cls.run_of_python.stdout, cls.run_of_python.stderr, sep="")

    def test_its_commands_run(self):
        self.assertGreaterEqual(len(blocks("sh")), 6)
        self.assertEqual(self.run_of_commands.returncode, 0)
        for made in ("out/in_gm.dat", "out/in_gm_volo.dat", "out/pulled/summary.json", "out/squeezed/curve.csv",
                     "out/report.html", "out/triangle/output.dat"):
            self.assertTrue((self.folder / made).is_file(), f"{made}: found nothing, expected what the README's commands make")

    def test_its_python_runs(self):
        self.assertGreaterEqual(len(blocks("python")), 2)
        self.assertEqual(self.run_of_python.returncode, 0, self.run_of_python.stderr)
        self.assertNotEqual(self.run_of_python.stdout, "")

    def test_its_commands_for_ci_stand_in_ci(self):
        script = (TOP / ".ci" / "run").read_text(encoding="utf-8")
        commands = [line.split("#")[0].strip() for block in blocks("sh ci") for line in block.splitlines()]
        self.assertGreaterEqual(len(commands), 2)
        for command in commands:
            self.assertRegex(script, rf"(?m)^[^#\n]*{re.escape(command)}\b", f"«{command}» is not run by .ci/run")

    def test_columns_are_those_of_the_files(self):
        for name in ("curve", "events"):
            with (self.folder / "out" / "squeezed" / f"{name}.csv").open(encoding="utf-8", newline="") as file:
                columns = next(csv.reader(file))
            self.assertCountEqual(table(f"`{name}.csv`:"), columns)

    def test_keys_are_in_the_summary(self):
        summary = json.loads((self.folder / "out" / "squeezed" / "summary.json").read_text(encoding="utf-8"))
        for key in table("`summary.json`, "):
            self.assertIn(key, summary)

    def test_files_are_those_of_a_test(self):
        for name in table("`crackle test CASE.toml -o OUT` leaves"):
            self.assertTrue((self.folder / "out" / "squeezed" / name).exists(), f"{name}: not among a test's results")

    def test_arrays_are_those_of_the_frames(self):
        for name in ("particles", "contacts", "cracks"):
            file = min((self.folder / "out" / "squeezed" / "frames").glob(f"{name}_*.vtp"))
            cells = ElementTree.parse(file).find("PolyData/Piece/CellData")
            self.assertCountEqual(table(f"Arrays of `{name}`:"), [array.get("Name") for array in cells])

    def test_commands_are_those_of_the_program(self):
        told = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        commands = re.findall(r"^  (\w+)  +\w", told, re.MULTILINE)
        self.assertCountEqual([row.split()[1] for row in table("## Commands")], commands)

    def test_links_lead_somewhere(self):
        links = re.findall(r"\]\(([^)#]+)\)", README)
        self.assertGreaterEqual(len(links), 3)
        for link in links:
            self.assertTrue((TOP / link).exists(), f"{link}: found nothing")


if __name__ == "__main__":
    unittest.main()
