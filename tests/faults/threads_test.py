# SPDX-License-Identifier: GPL-3.0-or-later
"""If the system refuses threads, the work is done on fewer with the same bytes, and a notice states this."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

from program import Program, contents
from scenes import CASE, DECKS, PACK

PROGRAM = Program(os.environ["CRACKLE_PROGRAM"], os.environ["INJECTED_FAULTS"])
SEVERAL = len(os.sched_getaffinity(0)) > 1  # with a single processor, no threads are started that could be refused


class RefusedThreads(unittest.TestCase):
    def compared(self, words, made):
        """Contents of `made` after `words`, without faults and with every thread refused."""
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            left = []
            for faults in ({}, {"call": "thread", "at": 1, "mode": "on"}):
                shutil.rmtree(place / "work", ignore_errors=True)
                (place / "work").mkdir()
                (place / "work/case.toml").write_text(CASE.replace("RATE", "0.1"))
                shutil.copytree(DECKS / "controlled_segment_force", place / "work/deck")
                done = PROGRAM.run(words, place, **faults)
                self.assertEqual(done.code, 0, done.err)
                if faults and SEVERAL:
                    self.assertTrue(done.calls, "no thread was requested")
                    self.assertRegex(done.err, "1 of 2 threads are used: the operating system allows this process only 1")
                left.append({name: data for name, data in contents(place / "work").items() if name.startswith(made)})
            self.assertEqual(left[0].keys(), left[1].keys())
            for name, data in left[0].items():
                if not name.endswith("summary.json"):  # states the number of threads
                    self.assertEqual(data, left[1][name], name)

    def test_of_a_deck(self):
        self.compared("run deck -o out --threads 2 --steps 400", "out/")

    def test_of_a_packing(self):
        self.compared(f"{PACK} -o made.dat --threads 2", "made.dat")

    def test_of_a_test(self):
        self.compared("test case.toml -o out --threads 2", "out/")


if __name__ == "__main__":
    unittest.main()
