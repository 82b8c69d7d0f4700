# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests where commands write: the same files for all forms of a path, no change of foreign files, and an error of one line if that is not
possible."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["CRACKLE_PROGRAM"]
SOURCES = Path(__file__).resolve().parents[3]
PACK = "pack --count 30 --radius-min 0.013 --radius-max 0.026 --mean-overlap 7.74e-5 -q"
CASE = """[packing]
count = 30
radius_min = 0.013
radius_max = 0.026
mean_overlap = 7.74e-5
[material]
density = 2500
normal_stiffness = 1e7
shear_stiffness = 2.5e6
friction_angle = 27
damping_ratio = 0.2
[loading]
kind = "tension"
axial_strain_rate = 0.1
max_axial_strain = 0.004
[output]
curve_rows = 50
frames = 3
"""
PLAN = """title = "Two packings"
[[test]]
case = "case.toml"
[packings]
count = 2
[run]
keep = "curves"
"""
ROCK = """[[test]]
case = "case.toml"
[[target]]
test = "case"
figure = "youngs_modulus"
value = 1e7
[[free]]
key = "material.normal_stiffness"
from = 5e6
to = 2e7
"""
JOINTED = CASE + "[[trace]]\npoints = [0.05, 0.05, 0.15, 0.2]\n"
# Commands that write a file: extension and words.
FILES = {
    "pack": ("dat", PACK + " -o"), "mesh": ("dat", "mesh in_gm.dat --kind voronoi --thick 1e-3 -q -o"),
    "elastic": ("csv", "elastic case.toml -q --bonds"), "view": ("html", "view in_gm.dat -q -o"),
    "report": ("html", "report out -q -o"), "report of a campaign": ("html", "report campaign -q -o"),
    "plot": ("svg", "plot out -q -o"), "plot of a campaign": ("svg", "plot campaign -q -o"), "plot of a deck": ("svg", "plot ran -q -o"),
    "joints": ("svg", "joints jointed.toml --box-width 0.1 --box-height 0.1 -q -o"), "traces": ("csv", "joints jointed.toml --box-width 0.1 --box-height 0.1 -q --traces"),
}
# Commands that fill a folder.
FOLDERS = {"test": "test case.toml -q -o", "run": "run deck -q -o", "campaign": "campaign plan.toml -q -o"}
PAGES = ("view", "report", "report of a campaign")


def crackle(words, folder, *more):
    done = subprocess.run([PROGRAM, *words.split(), *more], cwd=folder, capture_output=True)
    return done.returncode, done.stderr.decode(errors="replace")


def held(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file() and not path.is_symlink()}


class Outputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.made = Path(cls.scratch.name) / "made"
        cls.made.mkdir()
        for name, text in (("case.toml", CASE), ("plan.toml", PLAN), ("rock.toml", ROCK), ("jointed.toml", JOINTED)):
            (cls.made / name).write_text(text)
        shutil.copytree(SOURCES / "specimens/demseg/circle", cls.made / "deck")
        (cls.made / "deck/README.md").unlink(missing_ok=True)
        for words in (PACK + " -o in_gm.dat", "test case.toml -o out -q", "campaign plan.toml -o campaign -q", "run deck -o ran -q"):
            code, said = crackle(words, cls.made)
            if code != 0:
                raise RuntimeError(f"crackle {words}: {said}")

    def setUp(self):
        self.work = Path(self.scratch.name) / "work"
        shutil.rmtree(self.work, ignore_errors=True)
        shutil.copytree(self.made, self.work)

    def refused(self, words, says, *more):
        before = held(self.work)
        code, said = crackle(words, self.work, *more)
        self.assertEqual(code, 2, f"crackle {words} {more}: {said}")
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn(says, said, f"crackle {words}")
        self.assertEqual(held(self.work), before, f"crackle {words}")

    def test_files_have_any_name(self):
        for command, (extension, words) in FILES.items():
            contents = set()
            for made in self.work.glob(f"*.{extension}"):
                if not (self.made / made.name).exists():
                    made.unlink()
            for name in (f"x.{extension}", f"./y.{extension}", str(self.work / f"z.{extension}"), f"with blanks.{extension}",
                         os.fsdecode(b"\xff\xfe.") + extension, f"deck/../up.{extension}"):
                with self.subTest(command=command, name=name):
                    code, said = crackle(words, self.work, name)
                    self.assertEqual(code, 0, said)
                    contents.add((self.work / name).read_bytes())
            self.assertEqual(len(contents), 1, command)
            self.assertNotIn(b"", contents, command)
        self.assertEqual(list(self.work.rglob("*.crackle_tmp")), [])

    def test_folders_have_any_name(self):
        for command, words in FOLDERS.items():
            for number, name in enumerate(("x", "./y", "slash/", str(self.work / "whole"), "with blanks", os.fsdecode(b"\xff\xfe"), "deep/er/x")):
                name = name.replace("x", f"x{command}") if name.endswith("x") else f"{command}{number}/{name}" if not name.startswith("/") else name + command
                with self.subTest(command=command, name=name):
                    code, said = crackle(words, self.work, name)
                    self.assertEqual(code, 0, said)
                    self.assertGreater(len(held(self.work / name)), 0)
                    self.assertEqual(list((self.work / name).rglob("*.crackle_tmp")), [])

    def test_a_folders_name_is_no_files(self):
        for command, (extension, words) in FILES.items():
            with self.subTest(command=command):
                self.refused(words, "expected svg" if extension == "svg" else "the name of a folder", f"absent.{extension}/")
                (self.work / f"folder.{extension}").mkdir(exist_ok=True)
                if command != "mesh":  # which chooses the file's name in an existing folder
                    self.refused(words, "found a folder", f"folder.{extension}")

    def test_links_are_not_followed(self):
        stranger = Path(self.scratch.name) / "stranger"
        for command, (extension, words) in FILES.items():
            with self.subTest(command=command):
                stranger.write_text("mine\n")
                name = f"linked_{command.replace(' ', '_')}.{extension}"
                (self.work / name).symlink_to(stranger)
                self.refused(words, "found a symbolic link", name)
                if command not in PAGES:
                    self.refused(words, "found a symbolic link", name, "--force")
                (self.work / name).unlink()
                for suffix in (".tmp", ".new", ".crackle_tmp"):
                    (self.work / (name + suffix)).symlink_to(stranger)
                code, said = crackle(words, self.work, name)
                self.assertEqual(code, 0, said)
                self.assertEqual(stranger.read_text(), "mine\n")
        for name in ("curve.csv.tmp", "summary.json.tmp", "case.toml.tmp", "probe.tmp"):
            (self.work / "out" / name).symlink_to(stranger)
        self.assertEqual(crackle("test case.toml -o out --force -q", self.work)[0], 0)
        self.assertEqual(crackle("run deck -o ran --force -q", self.work)[0], 0)
        self.assertEqual(stranger.read_text(), "mine\n")

    def test_devices_are_not_replaced(self):
        os.mkfifo(self.work / "pipe")  # not a real device, since a faulty program would replace it
        self.refused(PACK + " --force -o pipe", "found a device or a pipe")
        self.assertTrue((self.work / "pipe").is_fifo())

    def test_foreign_folders_are_refused(self):
        (self.work / "mine").mkdir()
        (self.work / "mine/curve.csv").write_text("my one line\n")
        for words in (*FOLDERS.values(), "calibrate rock.toml -q -o"):
            with self.subTest(words=words):
                self.refused(words, "mine: found curve.csv, expected a new or empty folder", "mine")
        for words in ("test case.toml -q --force -o", "run deck -q --force -o"):
            self.refused(words, "mine: found curve.csv", "mine")

    def test_folders_of_inputs_are_refused(self):
        for words in ("test case.toml -q -o", "test case.toml -q --force -o", "campaign plan.toml -q -o", "calibrate rock.toml -q -o"):
            for above in (".", "./", str(self.work), str(self.work.parent), "deck/.."):  # "/" is tested by output_path_test.cpp, which writes nothing
                with self.subTest(words=words, above=above):
                    self.refused(words, "in this folder, expected a folder for results only", above)
        self.refused("run deck -q -o", "expected a new or empty folder", ".")

    def test_a_decks_foreign_files_are_not_replaced(self):
        (self.work / "deck/events.csv").write_text("when,where\n1,2\n")
        self.refused("run deck -q --force", "deck/events.csv:1: found 'when,where', expected an output of an earlier run")
        (self.work / "deck/events.csv").unlink()
        self.assertEqual(crackle("run deck -q", self.work)[0], 0)
        self.assertEqual(crackle("run deck -q --force", self.work)[0], 0)

    def test_a_calibrations_folder_keeps_a_users_case(self):
        (self.work / "done/cases").mkdir(parents=True)
        (self.work / "done/cases/mine.toml").write_text(CASE)
        self.refused("calibrate rock.toml -q -o done", "done: found cases, expected a new or empty folder")

    def test_an_end_within_one_step_is_said(self):
        (self.work / "short.toml").write_text(CASE.replace("max_axial_strain = 0.004", "max_axial_strain = 1e-9"))
        code, said = crackle("test short.toml -o short", self.work)
        self.assertEqual(code, 0, said)
        self.assertIn("beyond loading.max_axial_strain = 1e-09", (self.work / "short/summary.json").read_text())
        done = subprocess.run([PROGRAM, "test", "--check", "short.toml"], cwd=self.work, capture_output=True, text=True)
        self.assertIn("steps, so the test overshoots it", done.stdout)
        self.assertNotIn("beyond loading.max_axial_strain", (self.work / "out/summary.json").read_text())

    def test_an_unfinished_test_is_neither_lost_nor_left_aside(self):
        shutil.copytree(self.work / "out", self.work / "out.new")
        (self.work / "out.new/replaces-older-results").write_text("")
        shutil.rmtree(self.work / "out.new/frames")
        self.refused("test case.toml -o out -q --force", "out.new: found an unfinished test that was to replace out, expected no such test; resume it with "
                                                         "`crackle test --resume out.new`, or remove out.new to start again")
        code, said = crackle("test --resume out.new -q", self.work)
        self.assertEqual(code, 0, said)
        self.assertFalse((self.work / "out.new").exists())


if __name__ == "__main__":
    unittest.main()
