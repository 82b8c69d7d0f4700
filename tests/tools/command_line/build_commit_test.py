#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tools/command_line/build_commit.cmake in generated checkouts: which commit it names, and when it writes."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[3] / "tools" / "command_line" / "build_commit.cmake"
CMAKE = os.environ.get("CMAKE_PROGRAM", "cmake")
GIT = shutil.which("git") or ""
# Settings and folders of the caller's git have no effect.
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")} | {
    "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
UNKNOWN = "unknown: built without git or outside of a git checkout"


@unittest.skipUnless(GIT, "git is not installed")
class BuildCommit(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.sources = self.folder / "sources"
        self.sources.mkdir()
        self.output = self.folder / "build_commit.cpp"

    def git(self, *words):
        done = subprocess.run([GIT, "-C", str(self.sources), "-c", "user.name=nobody", "-c", "user.email=nobody@example.org", *words],
                              capture_output=True, text=True, check=True, env=ENVIRONMENT)
        return done.stdout.strip()

    def commit(self):
        """Makes a checkout with one commit. @return its name"""
        self.git("init", "-q")
        (self.sources / "file").write_text("one\n", encoding="utf-8")
        self.git("add", "file")
        self.git("commit", "-q", "-m", "One file")
        return self.git("rev-parse", "HEAD")

    def named(self, sources=None, git=GIT):
        subprocess.run([CMAKE, f"-DGIT={git}", f"-DSOURCES={sources or self.sources}", f"-DOUTPUT={self.output}", "-P", str(SCRIPT)], check=True, env=ENVIRONMENT)
        return re.search(r'build_commit = "(.*)";', self.output.read_text(encoding="utf-8"))[1]

    def test_names_the_commit_of_the_checkout(self):
        self.assertEqual(self.named(), UNKNOWN)
        name = self.commit()
        self.assertEqual(self.named(), name[:12])

    def test_says_where_tracked_files_have_changed(self):
        name = self.commit()[:12]
        (self.sources / "new").write_text("untracked\n", encoding="utf-8")
        self.assertEqual(self.named(), name)
        (self.sources / "file").write_text("two\n", encoding="utf-8")
        self.assertEqual(self.named(), name + ", with changes")

    def test_names_none_where_there_is_none(self):
        self.git("init", "-q")  # no commit yet
        self.assertEqual(self.named(), UNKNOWN)
        self.commit()
        self.assertEqual(self.named(git=""), UNKNOWN)
        self.assertEqual(self.named(git="GIT_EXECUTABLE-NOTFOUND"), UNKNOWN)
        self.assertEqual(self.named(git=str(self.folder / "none")), UNKNOWN)

    def test_names_no_commit_of_a_checkout_around_it(self):
        self.commit()
        inner = self.sources / "inner"
        inner.mkdir()
        self.assertEqual(self.named(sources=inner), UNKNOWN)

    def test_writes_only_what_has_changed(self):
        self.commit()
        self.named()
        long_ago = 1_000_000_000
        os.utime(self.output, (long_ago, long_ago))
        self.named()
        self.assertEqual(self.output.stat().st_mtime, long_ago)
        (self.sources / "file").write_text("two\n", encoding="utf-8")
        self.named()
        self.assertGreater(self.output.stat().st_mtime, long_ago)


if __name__ == "__main__":
    unittest.main()
