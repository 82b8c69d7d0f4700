#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that all files state the same version; tests tools/package/debian_changelog on CHANGELOG.md and on generated texts."""
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
SCRIPT = TOP / "tools" / "package" / "debian_changelog"

GOOD = """# Changes

Words that a package does not need.

## [Unreleased]

### Added

- Not out yet.

## [1.2.0] - 2024-02-29

### Added

- One `key` more ([how](page.md)).

### Fixed

- A sentence that is long enough to be continued on a line of its own
  in the file.

## [1.1.0] - 2023-12-04

### Added

- All of it.
"""
EXPECTED = """crackle (1.2.0) unstable; urgency=medium

  [ Added ]
  * One key more (how).

  [ Fixed ]
  * A sentence that is long enough to be continued on a line of its own in the
    file.

 -- Crackle maintainers <crackle@example.org>  Thu, 29 Feb 2024 12:00:00 +0000

crackle (1.1.0) unstable; urgency=medium

  [ Added ]
  * All of it.

 -- Crackle maintainers <crackle@example.org>  Mon, 04 Dec 2023 12:00:00 +0000
"""


def text_of(name):
    return (TOP / name).read_text(encoding="utf-8")


def converted(path):
    return subprocess.run([str(SCRIPT), str(path)], capture_output=True, text=True, check=False)


class Versions(unittest.TestCase):
    def test_are_the_same_in_every_file(self):
        version = re.search(r"^project\(crackle VERSION (\S+) ", text_of("CMakeLists.txt"), re.MULTILINE)[1]
        newest = re.search(r"^## \[(\d[^]]*)\] - (\S+)$", text_of("CHANGELOG.md"), re.MULTILINE)
        citation = text_of("CITATION.cff")
        self.assertEqual(newest[1], version)
        self.assertEqual(re.search(r"^version: (\S+)$", citation, re.MULTILINE)[1], version)
        self.assertEqual(re.search(r"^date-released: (\S+)$", citation, re.MULTILINE)[1], newest[2])
        minor = ".".join(version.split(".")[:2])
        self.assertIn(f"find_package(crackle {minor} REQUIRED)", text_of("tests/package/example/CMakeLists.txt"))


class DebianChangelog(unittest.TestCase):
    def of(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "CHANGES"
            path.write_text(text, encoding="utf-8")
            return converted(path)

    def test_has_an_entry_a_release(self):
        done = self.of(GOOD)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, EXPECTED)

    def test_of_the_project_has_every_line(self):
        done = converted(TOP / "CHANGELOG.md")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("\n  * "), text_of("CHANGELOG.md").count("\n- "))
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 80)

    def refused(self, old, new, *words):
        self.assertIn(old, GOOD)
        done = self.of(GOOD.replace(old, new))
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_refuses_what_it_would_get_wrong(self):
        self.refused("## [1.2.0] - 2024-02-29", "## 1.2.0", ":11: found '## 1.2.0', expected '## [1.2.3] - YYYY-MM-DD'")
        self.refused("2024-02-29", "2023-02-29", ":11:", "expected a valid date")
        self.refused("2023-12-04", "2024-12-04", ":22:", "expected a date no later than 2024-02-29")
        self.refused("### Fixed", "### Mended", ":17: found '### Mended', expected one of Added, Changed")
        self.refused("### Added\n\n- All of it.", "- All of it.", ":24:", "expected a group such as '### Added' above it")
        self.refused("- All of it.", "All of it.", "found nothing below 1.1.0")
        self.refused(GOOD, "# Changes\n", "found no release")
        done = converted(TOP / "none.md")
        self.assertEqual(done.returncode, 2)
        self.assertIn("none.md", done.stderr)


if __name__ == "__main__":
    unittest.main()
