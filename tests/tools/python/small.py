# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by the tests of the module: a small rock, the program, the shipped specimens."""
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
    """The small case with changed keys."""
    case = copy.deepcopy(CASE)
    for table, keys in tables.items():
        if isinstance(keys, dict):
            case.setdefault(table, {}).update(keys)
        else:
            case[table] = keys
    return case


# Two rates on two packings.
PLAN = """
title = "Two seeds"
[[test]]
name = "tension"
case = "case.toml"
[[axis]]
key = "loading.axial_strain_rate"
values = [0.02, 0.04]
[packings]
count = 2
"""

# A rock of a hundred circles with known keys, and the kinds of its tests.
ROCK_KEYS = {"material.contact_modulus": 2e10, "material.stiffness_ratio": 2.5}
ROCK_KINDS = {"compression": 0.03, "tension": 0.008}


def rock_case(kind):
    return {"packing": {"count": 100, "radius_min": 1.0e-3, "radius_max": 1.66e-3, "mean_overlap": 2.0e-6},
            "material": {"density": 2600.0, "units": "area", "contact_modulus": 2e10, "stiffness_ratio": 2.5,
                         "friction_angle": 30.0, "residual_friction_angle": 20.0, "tensile_strength": 1e7,
                         "cohesion": 2e7, "damping_ratio": 0.2},
            "bond": {"law": "coulomb", "range": 0.1, "strength_distribution": "weibull", "strength_cv": 0.3,
                     "strength_seed": 1},
            "loading": {"kind": kind, "max_axial_strain": ROCK_KINDS[kind]}}


def write_rock(targets):
    """Writes compression.toml, tension.toml, and rock.toml, in which the elastic keys are free and the targets are those of the compression test."""
    for kind in ROCK_KINDS:
        Path(kind + ".toml").write_text(toml(rock_case(kind)), encoding="utf-8")
    lines = ['title = "Circles"']
    lines += [f'[[test]]\ncase = "{kind}.toml"' for kind in ROCK_KINDS]
    lines += [f'[[target]]\ntest = "compression"\nfigure = "{figure}"\nvalue = {value!r}\ntolerance = 0.01'
              for figure, value in targets.items()]
    lines += ['[[free]]\nkey = "material.contact_modulus"\nfrom = 2e9\nto = 2e11',
              '[[free]]\nkey = "material.stiffness_ratio"\nfrom = 1\nto = 10',
              "[packings]\nfit = 4\npolish = 4\nfresh = 4"]
    Path("rock.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")


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
    """Runs each test in an empty folder of its own."""

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
