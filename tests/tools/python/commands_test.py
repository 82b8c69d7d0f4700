#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that functions have the same files, numbers, options and error messages as the commands."""
import inspect
import json
import os
import re
import signal
import sqlite3
import threading
import time
import unittest
from contextlib import closing
from pathlib import Path

import numpy

import crackle
from crackle import _engine
from small import CASE, PLAN, ROCK_KEYS, ROCK_KINDS, TOP, InScratch, program, rock_case, small, toml, write_rock

PACKING = dict(count=60, radius_min=0.01333, radius_max=0.02667, mean_overlap=7.74e-5)
WORDS = ("--count", 60, "--radius-min", 0.01333, "--radius-max", 0.02667, "--mean-overlap", 7.74e-5)
# Options that Python functions do not need.
OF_A_TERMINAL = {"quiet", "verbose", "help", "keys", "files", "json", "dry-run"}


class Options(unittest.TestCase):
    """Functions have a keyword for each option of their command, and no others."""

    def test_keywords_are_the_options(self):
        others = {"pack": set(), "mesh": set(), "joints": set(), "elastic": {"bonds", "force"},
                  "test": {"resume", "check"}, "campaign": set(), "calibrate": set(), "envelope": set(),
                  "plot": {"guide", "format"}, "report": set(), "view": set()}
        for command, left_out in others.items():
            options = {option[0] for option in _engine.options(command)} - OF_A_TERMINAL - left_out
            parameters = inspect.signature(getattr(crackle, command)).parameters
            keywords = {name.replace("_", "-") for name, parameter in parameters.items()
                        if parameter.kind is not parameter.VAR_POSITIONAL} - {"progress", "call", "every"}
            operand = {"mesh": "particles", "joints": "case", "elastic": "case", "test": "case", "campaign": "plan",
                       "calibrate": "rock"}
            self.assertEqual(keywords - {operand.get(command)}, options, command)

    def test_an_unknown_keyword_is_refused(self):
        with self.assertRaises(TypeError):
            crackle.pack(cuont=5)
        with self.assertRaises(crackle.InputError) as refused:
            _engine.pack(["--cuont=5"], None)
        self.assertIn("did you mean --count?", str(refused.exception))


class Particles(InScratch):
    def test_a_packing_is_the_programs(self):
        self.assertEqual(program("pack", *WORDS, "-o", "a.dat", "-q").returncode, 0)
        made = crackle.pack(**PACKING, output="b.dat")
        self.assertEqual(Path("a.dat").read_bytes(), Path("b.dat").read_bytes())
        self.assertEqual(made.text(), Path("a.dat").read_text())
        self.assertEqual(len(made), 60)
        circles = made.circles
        self.assertEqual(made.facts["circles"], 60)
        x1, x2, y1, y2 = made.domain
        area = numpy.pi * (circles["radius"] ** 2).sum()
        self.assertAlmostEqual(((x2 - x1) * (y2 - y1) - area) / area, made.facts["void_ratio"], delta=1e-12)
        # Overlaps of all pairs and walls, computed directly.
        x, y, radius = circles["centre"]["x"], circles["centre"]["y"], circles["radius"]
        apart = radius[:, None] + radius[None, :] - numpy.hypot(x[:, None] - x[None, :], y[:, None] - y[None, :])
        touches = (apart > 0) & ~numpy.eye(60, dtype=bool)
        walls = {name: numpy.maximum(radius - way, 0.0)
                 for name, way in (("left", x - x1), ("right", x2 - x), ("bottom", y - y1), ("top", y2 - y))}
        of_walls = sum((overlap > 0).sum() for overlap in walls.values())
        carrying = (touches.any(axis=1) | numpy.any([overlap > 0 for overlap in walls.values()], axis=0)).sum()
        facts = made.facts
        self.assertEqual(facts["contacts"], touches.sum() // 2)
        self.assertEqual(facts["floating"], 60 - carrying)
        self.assertAlmostEqual(facts["coordination"], touches.sum() / 60, delta=1e-12)
        self.assertAlmostEqual(facts["coordination_of_carrying"], (touches.sum() + of_walls) / carrying, delta=1e-12)
        self.assertNotEqual(facts["coordination"], facts["coordination_of_carrying"])
        of_x = (walls["left"].sum() + walls["right"].sum()) / (y2 - y1)
        of_y = (walls["bottom"].sum() + walls["top"].sum()) / (x2 - x1)
        self.assertAlmostEqual(facts["stress_x"] / facts["stress_y"], of_x / of_y, delta=1e-9)
        self.assertNotEqual(facts["stress_x"], facts["stress_y"])
        self.assertAlmostEqual(facts["anisotropy"], abs(of_x - of_y) / (of_x + of_y), delta=1e-9)
        self.assertEqual((facts["radius_min"], facts["radius_max"]), (radius.min(), radius.max()))
        self.assertEqual((facts["width"], facts["height"]), (x2 - x1, y2 - y1))
        self.assertEqual(facts["radius_scale"], 1.0, "the given count is kept")
        pairs = numpy.triu(numpy.where(touches, apart, 0.0))
        overlaps = {"all": [pairs[pairs > 0], *(one[one > 0] for one in walls.values())],
                    "platens'": [pairs[pairs > 0], *(walls[name][walls[name] > 0] for name in ("bottom", "top"))]}
        mean = {name: numpy.concatenate(each).mean() for name, each in overlaps.items()}
        self.assertAlmostEqual(facts["mean_overlap"] / mean["platens'"], 1.0, delta=1e-9)
        # Forces divided by the mean force, for a stiffness of 1.
        way = numpy.hypot(x[:, None] - x[None, :], y[:, None] - y[None, :]) + numpy.eye(60)
        push = numpy.where(touches, apart / way, 0.0)
        force_x = (push * (x[:, None] - x[None, :])).sum(axis=1) + walls["left"] - walls["right"]
        force_y = (push * (y[:, None] - y[None, :])).sum(axis=1) + walls["bottom"] - walls["top"]
        unbalanced = numpy.hypot(force_x, force_y).max() / mean["all"]
        self.assertLess(abs(facts["residual"] - unbalanced), 1e-9)
        self.assertGreater(facts["residual"], 0.0)
        self.assertEqual(facts["notices"], [])
        with self.assertRaises(crackle.InputError) as refused:
            crackle.pack(**PACKING, output="b.dat")
        self.assertIn("--force", str(refused.exception))
        again = crackle.read("b.dat")
        numpy.testing.assert_array_equal(again.circles["radius"], circles["radius"])

    def test_a_mesh_is_the_programs(self):
        packed = crackle.pack(**PACKING, output="in.dat")
        for kind in ("voronoi", "delaunay"):
            words = ("--kind", kind, "--thick", 1e-3, "-o", f"{kind}.dat", "-q")
            self.assertEqual(program("mesh", "in.dat", *words).returncode, 0)
            made = crackle.mesh(packed, kind=kind, thick=1e-3)
            self.assertEqual(made.text(), Path(f"{kind}.dat").read_text())
            self.assertEqual(crackle.mesh("in.dat", kind=kind, thick=1e-3).text(), made.text())
            bodies, corners = made.bodies, made.vertices
            self.assertEqual(bodies["vertex_count"].sum(), len(corners))
            self.assertTrue(bodies["closed"].all())
            self.assertEqual(made.facts["cells"], len(made))
            # Areas, edges and angles of the outlines.
            area, edges, angles = 0.0, [], []
            for body in bodies:
                own = corners[body["first_vertex"]:body["first_vertex"] + body["vertex_count"]]
                place = own["x"] + 1j * own["y"]
                side, before = numpy.roll(place, -1) - place, place - numpy.roll(place, 1)
                area += abs(0.5 * (place.conj() * numpy.roll(place, -1)).imag.sum())
                edges += list(abs(side))
                angles += list(180.0 - abs(numpy.degrees(numpy.angle(side / before))))
            self.assertAlmostEqual(made.facts["area_after_inset"] / area, 1.0, delta=1e-12)
            self.assertLess(made.facts["area_after_inset"], 0.97 * made.facts["area_before_inset"])
            self.assertAlmostEqual(made.facts["shortest_edge"] / min(edges), 1.0, delta=1e-9)
            self.assertAlmostEqual(made.facts["smallest_angle"], min(angles), delta=1e-6)
            self.assertEqual((made.facts["segments"], made.facts["cells_destroyed"]), (len(edges), 0))

    def test_a_specimen_is_the_tests(self):
        for mesh, kind in (({}, "circles"), ({"kind": "voronoi", "thick": 1e-3}, "polygons")):
            case = small(loading={"max_axial_strain": 1e-5}, **({"mesh": mesh, "bond": {"thick": 1.1e-3}} if mesh else {}))
            crackle.test(case, f"out_{kind}")
            made = crackle.specimen(case)
            self.assertEqual(made.text(), Path(f"out_{kind}", f"specimen_{kind}.dat").read_text())
            self.assertEqual(len(made.vertices) > 0, kind == "polygons")
        with self.assertRaises(crackle.InputError) as refused:
            crackle.specimen(small(packing={"mean_overlap": 0.5}))
        self.assertIn("packing.mean_overlap", str(refused.exception))

    def test_a_mesh_of_centres(self):
        centres = numpy.array([[-0.25, 0.5], [0.25, 0.5], [0.25, 1.5], [-0.25, 1.5]])
        made = crackle.mesh(centres, kind="voronoi", thick=0.0, domain=(-0.5, 0.5, 0.0, 2.0), density=2000.0)
        self.assertEqual(len(made), 4)
        self.assertAlmostEqual(made.facts["area_before_inset"], 2.0, delta=1e-12)

    def test_refusals_are_the_programs(self):
        for options, words in ((dict(count=5, radius_min=0.1), ("--count", 5, "--radius-min", 0.1)),
                               (dict(count=60, radius_min=0.1, radius_max=0.2),
                                ("--count", 60, "--radius-min", 0.1, "--radius-max", 0.2)),
                               ({**PACKING, "seed": -1}, (*WORDS, "--seed=-1"))):
            with self.assertRaises(crackle.InputError) as refused:
                crackle.pack(**options)
            self.assertEqual(f"crackle: {refused.exception}\n", program("pack", *words, "-o", "none.dat").stderr)
        packed = crackle.pack(**PACKING)
        for options in (dict(kind="hexagonal", thick=0.0), dict(kind="voronoi", thick=1.0)):
            with self.assertRaises(crackle.InputError):
                crackle.mesh(packed, **options)
        for wrong in (5, [1.0, 2.0], [("a", "b")]):
            with self.assertRaises(crackle.InputError):
                crackle.mesh(wrong, kind="voronoi", thick=0.0)

    def test_what_is_there_is_judged_before_the_work_and_inputs_stay(self):
        Path("curve.csv").write_text("size,passing_by_mass\n0.02,0\n0.04,100\n", encoding="utf-8")
        sieved = dict(count=20, sieve="curve.csv", mean_overlap=1e-5)

        def worked(kind, text, share):
            raise AssertionError("packed first")
        Path("out.dat").touch()
        with self.assertRaises(crackle.InputError) as refused:
            crackle.pack(**sieved, output="out.dat", progress=worked)
        self.assertIn("--force", str(refused.exception))
        with self.assertRaises(crackle.InputError) as refused:
            crackle.pack(**sieved, output="curve.csv", force=True)
        self.assertIn("an input of the same command", str(refused.exception))
        packed = crackle.pack(**sieved, output="in.dat")
        Path("joints.toml").write_text('[[trace]]\nfile = "traces.txt"\n', encoding="utf-8")
        Path("traces.txt").write_text("-0.02 0.05 0.02 0.06\n", encoding="utf-8")
        for particles, joints, output in (("in.dat", None, "in.dat"), ("in.dat", None, "./in.dat"),
                                          (packed, "joints.toml", "joints.toml"),
                                          ("in.dat", "joints.toml", "joints.toml"),
                                          (packed, "joints.toml", "traces.txt"),
                                          ([[0.0, 1.0]], "joints.toml", "joints.toml")):
            before = Path(output).read_bytes()
            with self.assertRaises(crackle.InputError) as refused:
                crackle.mesh(particles, kind="delaunay", thick=1e-4, joints=joints, output=output, force=True)
            self.assertIn("an input of the same command", str(refused.exception))
            self.assertEqual(Path(output).read_bytes(), before)
        with self.assertRaises(crackle.InputError) as refused:
            crackle.mesh("in.dat", kind="none", thick=1e-4, output="out.dat")
        self.assertIn("found an existing file", str(refused.exception))

    def test_joints_of_a_mesh_are_told_of(self):
        packed = crackle.pack(**PACKING, output="in.dat")
        x1, x2, y1, y2 = packed.domain
        Path("joints.toml").write_text('[[trace]]\nfile = "traces.txt"\n', encoding="utf-8")
        Path("traces.txt").write_text(f"{x1!r} {0.4 * y2!r} {x2!r} {0.6 * y2!r}\n", encoding="utf-8")
        words = ("--kind", "delaunay", "--thick", 1e-4, "--joints", "joints.toml")
        told = program("mesh", "in.dat", *words, "-o", "mesh.dat")
        self.assertEqual(told.returncode, 0, told.stderr)
        made = crackle.mesh(packed, kind="delaunay", thick=1e-4, joints="joints.toml")
        self.assertEqual(made.text(), Path("mesh.dat").read_text())
        self.assertTrue(any("m of traces are" in notice for notice in made.facts["notices"]), made.facts["notices"])
        self.assertEqual(told.stdout.splitlines()[-len(made.facts["notices"]):], made.facts["notices"])

    def test_ctrl_c_is_heard_while_packing(self):
        def raise_it(kind, text, share):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            crackle.pack(count=20000, radius_min=0.01, radius_max=0.02, mean_overlap=1e-5, progress=raise_it)

    def test_ctrl_c_ends_meshing(self):
        centres = numpy.random.default_rng(1).random((300_000, 2))
        begun = []

        def tell(kind, text, share):
            if kind == "progress" and text.endswith("meshing 300000 centres"):
                begun.append(time.process_time())

        def seconds(**more):
            """Meshing is interrupted."""
            begun.clear()
            try:
                crackle.mesh(centres, kind="voronoi", thick=0.0, domain=(0, 1, 0, 1), **more)
            finally:
                spent = time.process_time() - begun[0]
            return spent
        whole = seconds(progress=tell)

        def interrupt(kind, text, share):
            tell(kind, text, share)
            if begun:
                threading.Timer(0.06, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            seconds(progress=interrupt, output="mesh.dat")
        self.assertLess(time.process_time() - begun[0], 0.6 * whole)
        self.assertFalse(Path("mesh.dat").exists())


class Solutions(InScratch):
    def test_elastic_is_the_programs(self):
        Path("case.toml").write_text(toml(CASE), encoding="utf-8")
        told = json.loads(program("elastic", "case.toml", "--json", "--modes", 3).stdout)
        found = crackle.elastic(CASE, modes=3)
        self.assertEqual({**found, "seconds": 0}, {**told, "seconds": 0})
        self.assertEqual(len(found.bonds), told["bonds"])
        first = found.bonds[numpy.argmin(found.bonds["break_strain"])]
        self.assertEqual({first["body_i"], first["body_j"]},
                         {told["first_break"]["body_i"], told["first_break"]["body_j"]})
        self.assertEqual(found.notices, [])
        confined = small(loading={"kind": "biaxial"}, confinement={"pressure": 100.0})
        self.assertIn("without confining pressure", crackle.elastic(confined).notices[0])
        for wrong in (dict(strain=0.0), dict(strain=float("nan")), dict(modes=-1)):
            with self.assertRaises(crackle.InputError):
                crackle.elastic(CASE, **wrong)

    def test_joints_are_the_programs(self):
        case = str(TOP / "specimens" / "jointed" / "two_sets.toml")
        told = program("joints", case, "--json", "--seed", 7, "--traces", "by_program.txt")
        self.assertEqual(told.returncode, 0, told.stderr)
        found = crackle.joints("specimens/jointed/two_sets.toml", seed=7, traces="by_python.txt", output="map.svg")
        self.assertEqual(found, json.loads(told.stdout))
        self.assertGreater(found["blocks"], 1)
        self.assertEqual(Path("by_python.txt").read_bytes(), Path("by_program.txt").read_bytes())
        self.assertIn("<svg", Path("map.svg").read_text())
        of_dict = crackle.joints({"include": "specimens/jointed/two_sets.toml", "joints": {"seed": 7}})
        self.assertEqual(of_dict, found)
        for of_none in (CASE, toml(CASE)):
            with self.assertRaises(crackle.InputError) as refused:
                crackle.joints(of_none)
            self.assertIn("case: found no [[joint_set]]", str(refused.exception))
        with self.assertRaises(crackle.InputError) as refused:
            crackle.joints("specimens/jointed/two_sets.toml", output="map.svg")
        self.assertIn("found an existing file", str(refused.exception))

    def test_check_is_the_programs(self):
        Path("case.toml").write_text(toml(CASE), encoding="utf-8")
        told = json.loads(program("test", "--check", "case.toml", "--json").stdout)
        found = crackle.check(CASE)
        self.assertEqual(found.keys(), told.keys())
        for key in ("youngs_modulus", "bonds", "first_break", "strength_estimate", "time_step", "units"):
            self.assertEqual(found[key], told[key], key)


class Tables(InScratch):
    def test_a_campaign_is_the_programs(self):
        Path("case.toml").write_text(toml(CASE), encoding="utf-8")
        Path("plan.toml").write_text(PLAN, encoding="utf-8")
        made = program("campaign", "plan.toml", "-o", "by_program", "-q")
        if made.returncode == 2:
            self.fail(made.stderr)
        found = crackle.campaign("plan.toml", "by_python", workers=2)
        results = found.results
        self.assertEqual(len(results.peak_stress), 4)
        other = sqlite3.connect("by_program/campaign.sqlite").execute("SELECT peak_stress FROM results").fetchall()
        self.assertEqual(sorted(results.peak_stress), sorted(row[0] for row in other))
        self.assertEqual(crackle.read("by_python").query("SELECT count(*) AS n FROM results").n, [4])
        self.assertIn("<svg", found.figure())
        points = found.points("peak_stress", "bonds_broken")
        self.assertEqual((points.figure, points.test), (["peak_stress", "bonds_broken"] * 2, ["tension"] * 4))
        self.assertEqual(points["loading.axial_strain_rate"], [0.02, 0.02, 0.04, 0.04])
        for point in (0, 2):
            of_point = [stress for stress, rate in zip(results.peak_stress, results["loading.axial_strain_rate"])
                        if rate == points["loading.axial_strain_rate"][point]]
            self.assertAlmostEqual(points.mean[point], numpy.mean(of_point), delta=1e-9)
        with self.assertRaises(crackle.InputError) as refused:
            crackle.campaign("none.toml", "by_python")
        self.assertFalse(hasattr(refused.exception, "__notes__"))
        with closing(sqlite3.connect("by_python/campaign.sqlite")) as ledger, ledger:
            ledger.execute("UPDATE figures SET peak_stress = 2 * peak_stress WHERE rowid = 1")
        campaign = crackle.read("by_python")
        for read in (lambda: campaign.results, campaign.points, campaign.figure):
            with self.assertRaisesRegex(crackle.InputError, r"row \d \(tension, .*found values that differ from those recorded"):
                read()
        self.assertEqual(crackle.campaign("plan.toml", "by_python", workers=2).results.peak_stress, results.peak_stress)

    def test_an_envelope_is_the_programs(self):
        for seed in (1, 2):
            for pressure in (0, 500, 1500):
                case = {"include": "specimens/guide_rock/circles_compression.toml",
                        "packing": {"seed": seed, "count": 100},
                        "loading": {"axial_strain_rate": 0.1, "max_axial_strain": 0.03},
                        "output": {"frames": 1, "curve_rows": 200}}
                if pressure > 0:
                    case["loading"]["kind"] = "biaxial"
                    case["confinement"] = {"pressure": pressure}
                crackle.test(case, f"out/{seed}_{pressure}")
        folders = sorted(str(path) for path in Path("out").iterdir())
        told = program("envelope", *folders, "--json")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(crackle.envelope(*folders), json.loads(told.stdout))
        crackle.envelope(*(crackle.read(folder) for folder in folders), output="envelope.svg")
        self.assertIn("<svg", Path("envelope.svg").read_text())
        with self.assertRaises(crackle.InputError) as refused:
            crackle.envelope(folders[0])
        self.assertEqual(f"crackle: {refused.exception}\n", program("envelope", folders[0], "--json").stderr)

    def test_a_calibration_is_the_programs(self):
        # The target values are means over the packings of the search, for a rock with known keys.
        solved = [crackle.elastic(rock_case("compression") | {"packing": {**rock_case("compression")["packing"],
                                                                          "seed": seed}}) for seed in range(1, 5)]
        write_rock({figure: float(numpy.mean([one[figure] for one in solved]))
                    for figure in ("youngs_modulus", "poissons_ratio")})
        found = crackle.calibrate("rock.toml", "by_python", workers=2)
        told = program("calibrate", "rock.toml", "-o", "by_program", "--workers", 2)
        self.assertIn(told.returncode, (0, 1), told.stderr)
        self.assertEqual(sorted(found.cases), sorted(ROCK_KINDS))
        written = ["rock.toml", *(f"cases/{kind}.toml" for kind in ROCK_KINDS)]
        for name in written:
            self.assertEqual(Path("by_python", name).read_bytes(), Path("by_program", name).read_bytes(), name)
        tables = [re.sub(r"\([^()]* of a processor\)", "", Path(folder, "calibration.txt").read_text())
                  for folder in ("by_python", "by_program")]
        self.assertEqual(*tables)
        for key, value in ROCK_KEYS.items():
            reached = next(one for one in found.outcome["keys"] if one["key"] == key)
            self.assertAlmostEqual(reached["value"] / value, 1.0, delta=0.01, msg=key)
        self.assertEqual(crackle.read_case(found.cases["tension"]).kind, "tension")
        self.assertIn("<html", found.page())
        self.assertEqual(crackle.read("by_python").outcome, found.outcome)

    def test_a_calibration_is_refused_as_the_program_does(self):
        Path("rock.toml").write_text("title = 'none'\n", encoding="utf-8")
        with self.assertRaises(crackle.InputError) as refused:
            crackle.calibrate("rock.toml", "out")
        self.assertEqual(f"crackle: {refused.exception}\n", program("calibrate", "rock.toml", "-o", "out").stderr)


if __name__ == "__main__":
    unittest.main()
