# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the module share: a small rock, the program, the shipped specimens."""
import copy
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
PROGRAM = os.environ["CRACKLE_PROGRAM"]

CASE = {
    "title": "Sixty circles",
    "packing": {"count": 60, "radius_min": 0.01333, "radius_max": 0.02667, "mean_overlap": 7.74e-5, "seed": 1},
    "material": {"density": 2500.0, "normal_stiffness": 1.0e7, "shear_stiffness": 2.5e6, "friction_angle": 27.0,
                 "damping_ratio": 0.2},
    "loading": {"kind": "tension", "platens": "bonded", "axial_strain_rate": 0.002, "max_axial_strain": 0.002},
    "output": {"curve_rows": 200, "frames": 4},
}


def small(**tables):
    """The small case with keys of its tables changed."""
    case = copy.deepcopy(CASE)
    for table, keys in tables.items():
        if isinstance(keys, dict):
            case.setdefault(table, {}).update(keys)
        else:
            case[table] = keys
    return case


def toml(case):
    lines = [f"{key} = {value!r}".replace("'", '"') for key, value in case.items() if not isinstance(value, dict)]
    for table, keys in case.items():
        if isinstance(keys, dict):
            lines.append(f"[{table}]")
            lines += [f"{key} = {str(value).lower() if isinstance(value, bool) else repr(value)}".replace("'", '"')
                      for key, value in keys.items()]
    return "\n".join(lines) + "\n"


def program(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)


class InScratch(unittest.TestCase):
    """In an empty folder of its own."""

    def setUp(self):
        self._before = os.getcwd()
        self._scratch = tempfile.TemporaryDirectory()
        os.chdir(self._scratch.name)

    def tearDown(self):
        os.chdir(self._before)
        self._scratch.cleanup()

    def assert_same_results(self, one, other, names=("curve.csv", "events.csv")):
        for name in names:
            self.assertEqual((Path(one) / name).read_bytes(), (Path(other) / name).read_bytes(), name)
        frames = sorted(path.name for path in (Path(one) / "frames").iterdir())
        self.assertEqual(frames, sorted(path.name for path in (Path(other) / "frames").iterdir()))
        for name in frames:
            written, same = (Path(folder) / "frames" / name for folder in (one, other))
            self.assertEqual(written.read_bytes(), same.read_bytes(), name)
