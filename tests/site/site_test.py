#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that the site builds without warnings, contains all pages, and has only links to existing files and anchors.

  tests/site/site_test.py           with the program and the Python module of build/release
  CRACKLE_BUILD=DIR tests/site/site_test.py    with those of another build
"""
import os
import re
import subprocess
import sys
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

TOP = Path(__file__).resolve().parents[2]
SITE = TOP / "build" / "site"
BUILD = Path(os.environ.get("CRACKLE_BUILD", TOP / "build" / "release")).resolve()


class Page(HTMLParser):
    """Anchors, links and pictures of a page."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.links |= {attributes[name] for name in ("href", "src") if attributes.get(name)}


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([TOP / "tools/site", "--build", BUILD], capture_output=True, text=True, check=False)
        assert done.returncode == 0 and "left out" not in done.stdout, done.stdout + done.stderr
        cls.pages = {path: Page(path) for path in SITE.rglob("*.html")}

    def text(self, name):
        return (SITE / name).read_text(encoding="utf-8")

    def test_every_page_and_public_header_of_the_tree_is_there(self):
        tracked = subprocess.run(["git", "ls-files", "*.md"], cwd=TOP, capture_output=True, text=True, check=True).stdout.split()
        expected = [name for name in tracked if not name.startswith(".")]
        for library in ("solver", "mesher", "specimens"):
            listed = (TOP / library / "CMakeLists.txt").read_text(encoding="utf-8").split("FILE_SET")[1]
            expected += [f"{library}/{name}" for name in re.findall(r"^    (\S+\.hpp)$", listed, re.MULTILINE)]
        self.assertGreater(len(expected), 250)
        self.assertEqual([name for name in expected if not (SITE / name).with_suffix(".html").is_file()], [])

    def test_functions_of_the_libraries_have_anchors_and_sources(self):
        page = self.text("solver/linear/elastic.html")
        for expected in ("crackle13solve_elastic", "J, ½uᵀKu", "Small-strain solution of a bonded specimen", "InputError if nothing is prescribed"):
            self.assertIn(expected, page)

    def test_the_module_has_all_its_names(self):
        names = subprocess.run(["/usr/bin/python3", "-c", "import crackle; print(*crackle.__all__)"], capture_output=True, text=True,
                               check=True, env={**os.environ, "PYTHONPATH": str(BUILD / "python")}).stdout.split()
        anchors = self.pages[SITE / "reference/python.html"].anchors
        self.assertEqual([name for name in names if f"crackle.{name}" not in anchors], [])

    def test_reference_is_what_the_program_prints(self):
        program = BUILD / "tools" / "crackle"
        anchors = self.pages[SITE / "reference/keys.html"].anchors
        for command in ("test", "campaign", "calibrate"):
            printed = subprocess.run([program, command, "--keys"], capture_output=True, text=True, check=True).stdout
            keys = re.findall(r"^  (\w+) ", printed, re.MULTILINE)
            self.assertGreater(len(keys), 10)
            page = self.text("reference/keys.html")
            self.assertEqual([key for key in keys if f'<span class="pre">{key}</span>' not in page], [])
            what = {"test": "case", "campaign": "plan", "calibrate": "rock"}[command]
            self.assertEqual([key for key in keys if not any(name.startswith(f"{what}-") and name.endswith(key) for name in anchors)], [])
        page = self.text("reference/keys.html")
        self.assertIn("case-packing-seed", anchors)
        self.assertRegex(page, r"(?s)radius_median.{0,400}needs sizes = \W+(quot;)?lognormal")
        self.assertRegex(page, r"(?s)case-material-contact_modulus.{0,400}needs units = \W+(quot;)?area")
        page = self.text("reference/commands.html")
        for expected in ("crackle-calibrate", "130 interrupted", "--verify", "--magnify"):
            self.assertIn(expected, page)

    def test_links_lead_to_files_and_anchors(self):
        count = 0
        for path, page in self.pages.items():
            for link in page.links:
                parts = urlsplit(link)
                if parts.scheme or parts.netloc:
                    continue
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                count += 1
                self.assertTrue(target.is_file(), f"{path.relative_to(SITE)}: {link}: found no such file")
                if parts.fragment and target in self.pages:
                    self.assertIn(unquote(parts.fragment), self.pages[target].anchors | {""}, f"{path.relative_to(SITE)}: {link}")
        self.assertGreater(count, 10000)

    def test_search_knows_pages_and_functions(self):
        index = self.text("searchindex.js")
        for expected in ("solver/MODEL", "solver/linear/elastic", "solve_elastic", "rate_tolerance"):
            self.assertIn(expected, index)


if __name__ == "__main__":
    sys.exit(unittest.main())
