# SPDX-License-Identifier: GPL-3.0-or-later
"""On a full disc (a small tmpfs), a campaign, a test and a page end with exit code 4 and one line; once there is room, the same work succeeds."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

from places import MOST, NotHere, PAGE, mounted, unmounted
from program import Program, contents
from scenes import CASE

PROGRAM = Program(os.environ["CRACKLE_PROGRAM"], os.environ["INJECTED_FAULTS"])
PLAN = """title = "Two packings"
[[test]]
case = "case.toml"
[packings]
count = 2
[run]
keep = "curves"
"""
FULL = ("No space left on device", "database or disk is full", "disk I/O error")


class FullDisc(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.place = Path(self.scratch.name)
        self.work, self.disc = self.place / "work", self.place / "work/disc"
        self.disc.mkdir(parents=True)
        (self.work / "case.toml").write_text(CASE.replace("RATE", "0.1"))
        (self.work / "plan.toml").write_text(PLAN)

    def on_larger_and_larger_discs(self, words, go_on, answer):
        """Repeats `words` on larger and larger discs until they succeed. go_on: command run once there is room; answer: result that is
        compared with an undisturbed run."""
        self.assertEqual(PROGRAM.run(words, self.place).code, 0)
        expected = answer()
        shutil.rmtree(self.disc)
        self.disc.mkdir()
        failed, pages = 0, 1
        while True:
            try:
                mounted(self.disc, pages * PAGE)
            except NotHere as reason:
                self.skipTest(str(reason))
            try:
                run = PROGRAM.run(words, self.place)
                if run.code == 0:
                    break
                failed += 1
                self.assertEqual(run.code, 4, f"{pages} pages: {run.err}")
                self.assertEqual(run.err.count("\n"), 1, run.err)
                self.assertIn("disc/", run.err, "names a file")
                self.assertTrue(any(cause in run.err for cause in FULL), run.err)
                mounted(self.disc, MOST, again=True)
                again = PROGRAM.run(next(way for way in go_on if "--resume" not in way or (self.disc / "out/checkpoint").exists()), self.place)
                self.assertEqual(again.code, 0, f"{pages} pages: {again.err}")
                self.assertEqual(answer(), expected, f"{pages} pages")
            finally:
                unmounted(self.disc)
            pages += max(1, pages // 3)
        self.assertGreater(failed, 2)

    def test_under_a_ledger(self):
        words = "campaign plan.toml -o disc/out --workers 2 -q"
        self.on_larger_and_larger_discs(words, [words], lambda: PROGRAM.run("campaign show disc/out --csv", self.place).out)

    def test_under_a_test(self):
        words = "test case.toml -o disc/out -q"
        self.on_larger_and_larger_discs(words, ["test --resume disc/out -q", words], lambda: contents(self.disc))

    def test_under_a_page(self):
        self.assertEqual(PROGRAM.run("test case.toml -o out -q", self.place).code, 0)
        words = "report out -o disc/page.html -q"
        self.on_larger_and_larger_discs(words, [words], lambda: contents(self.disc))


if __name__ == "__main__":
    unittest.main()
