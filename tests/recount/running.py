# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs and recounts each test once, and falsifies copies of its files on purpose."""

import functools
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from differences import Differences
from recount import recount

program = os.environ.get("CRACKLE_PROGRAM", Path(__file__).parents[2] / "build/release/tools/crackle")
scratch = Path(tempfile.mkdtemp(prefix="recount"))
differences = Differences()


def run(name, case, *options):
    """Runs a case once. @return its folder"""
    folder = scratch / name
    if not folder.exists():
        file = scratch / f"{name}.toml"
        file.write_text(case)
        subprocess.run([program, "test", "-q", str(file), "-o", str(folder), *options], check=True)
    return folder


@functools.cache
def recounted(folder):
    """Recount of a folder that does not change."""
    return recount(folder)


def differing(r):
    return {line[0] for line in r.lines if not line[5]}


class SoundFiles:
    """Checks of unchanged files."""

    def agrees(self, folder, fewest):
        r = recounted(folder)
        differences.take(folder.name, r.lines)
        for name, stated, ours, difference, tolerance, holds in r.lines:
            with self.subTest(folder=folder.name, figure=name):
                self.assertTrue(holds, f"expected {ours} within {tolerance:.1e}, got {stated}, error {difference:.1e}")
        self.assertGreaterEqual(len(r.lines), fewest, "figures recounted")
        print(f"{folder.name}: {len(r.lines)} figures")
        return r


class WrongFiles:
    """Puts faults into copies of correct results (sound() by default), as a faulty program could write them."""

    def spoilt(self, what, sound=None):
        """@return figures that differ after the change, but not before"""
        folder, sound = scratch / "spoilt", sound or self.sound()
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(sound, folder)
        what(folder)
        return sorted(differing(recount(folder)) - differing(recounted(sound)))

    def spoil_summary(self, change, sound=None):
        def what(folder):
            summary = json.loads((folder / "summary.json").read_text())
            change(summary)
            (folder / "summary.json").write_text(json.dumps(summary))

        return self.spoilt(what, sound)

    def spoil_column(self, file, column, change, sound=None):
        def what(folder):
            lines = [line.split(",") for line in (folder / file).read_text().splitlines()]
            k = lines[0].index(column)
            values = change([line[k] for line in lines[1:]])
            for line, value in zip(lines[1:], values):
                line[k] = value
            (folder / file).write_text("".join(",".join(line) + "\n" for line in lines))

        return self.spoilt(what, sound)

    def found(self, differing_figures, word):
        self.assertTrue(any(word in figure for figure in differing_figures), f"expected {word}, got {differing_figures}")
