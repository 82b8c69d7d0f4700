#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recounts small tests of each kind, and falsifies files on purpose: the recount must find each fault."""

import json
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from cases import (  # noqa: E402
    area, bonded, cells, circles_every_step, cohesive, factors, friction, minerals, minerals_of_an_area, output, packing, pulled,
    rate, rock, scattered, squeezed, strengths, triangles, voronoi, wedges
)
from expected import figures_expected  # noqa: E402
from faced import FacedTests, WrongFaces  # noqa: E402
from jointed import JointedTests, WrongJoints  # noqa: E402
from recount import figures, recount  # noqa: E402
from results import Results as read  # noqa: E402
from results import Unreadable  # noqa: E402
from running import SoundFiles, WrongFiles, differences, differing, program, recounted, run, scratch  # noqa: E402


def circles():
    return run("circles", rock + squeezed + rate + output + "out_of_plane_thickness = 0.05\nslips = true\nemission = true\n", "--verify")


def cells_of_an_area_pulled():
    return run("cells_pulled", packing + area + strengths + cells + cohesive + scattered("weibull", 0.3) + pulled + output)


def circles_by_factors():
    return run("factors", rock + cohesive + factors + squeezed + rate + output)


def every_step_of_few(name, case):
    small, every = packing.replace("count = 80", "count = 24"), output.replace("frames = 12", "frames = 2000")
    return run("every_step_" + name, small + case + every)


def rubble():
    """Circles whose fragments wedge after the peak and carry more than before."""
    return run("rubble", rock + squeezed + "stop_at_share_of_peak = 0.3\n" + rate + output)


def cells_by_their_size():
    sizes = rock.replace("radius_min = 1.333e-2\nradius_max = 2.667e-2", "cell_diameter = 4.4e-2\ncell_spread = 0.15")
    return run("sized_cells", sizes + voronoi + squeezed + output)


def unloaded():
    turns, scatter = "unload_at_strain = [0.0003, 0.002, 0.003]\n", scattered("weibull", 0.3)
    return run("unloaded", packing + area + strengths + cells + cohesive + scatter + squeezed.replace("0.02", "0.01") + turns + output)


class Recount(JointedTests, FacedTests, SoundFiles, unittest.TestCase):
    def test_circles_squeezed_at_a_rate_with_a_thickness_and_companions(self):
        self.agrees(circles(), 200)

    def test_every_figure_is_recounted_but_those_that_no_file_holds(self):
        r = recounted(circles())
        left = {name for name in figures(r.summary) - r.keys if ".companions." not in name}
        self.assertEqual(left, {
            "initial_tangent_window.contacts_gained",  # needs a frame at the last row of the window
            "numerical_errors.youngs_modulus.stated",  # the residual of the linear solve
            "list_builds", "threads",
            "step_seconds", "wall_seconds",
        })
        self.assertEqual(set(figures_expected.split()) - r.keys, set(), "figures that the summary lacks")

    def test_pieces_that_carry_more_than_the_specimen(self):
        folder = rubble()
        summary = json.loads((folder / "summary.json").read_text())
        self.assertGreater(summary["largest_stress"], 1.5 * summary["peak_stress"], "a case to which the rule applies")
        self.agrees(folder, 200)

    def test_circles_pulled_by_tolerance_between_glued_platens(self):
        self.agrees(run("pulled", rock + pulled + output), 150)

    def test_default_frames_in_single_precision(self):
        self.agrees(run("plain", rock + pulled + bonded), 150)

    def test_voronoi_polygons_squeezed_by_tolerance(self):
        self.agrees(run("voronoi", rock + voronoi + squeezed + output), 150)

    def test_voronoi_polygons_pulled_at_a_rate(self):
        self.agrees(run("voronoi_pulled", rock + voronoi + pulled + rate + output), 150)

    def test_circles_and_cells_under_a_pressure(self):
        for name, mesh, side in (("confined", "", ""), ("confined_cells", voronoi, ""), ("walls", "", 'side = "walls"\n'),
                                 ("walls_cells", voronoi, 'side = "walls"\n')):
            text = rock + mesh + squeezed.replace('"compression"', '"biaxial"') + "[confinement]\npressure = 2e3\n" + side + output
            self.assertIn("biaxial", text)
            self.agrees(run(name, text), 80 if side else 200)  # the recount's model has no walls

    def test_cells_that_are_not_between_platens(self):
        """Only section, length and toughness are recounted, with separate formulas; bonds and frames are not."""
        box = "[packing]\nwidth = {}\nheight = {}\nradius_min = 1.333e-2\nradius_max = 2.667e-2\nmean_overlap = 7.74e-5\nseed = 3\n"
        for kind, width, height, keys, shape in (
                ("brazilian", 0.6, 0.6, "half_angle = 12.0\n", ""), ("bending", 1.3, 0.25, "", ""),
                ("bending", 1.3, 0.25, "", "[shape]\nnotch = 0.1\n"), ("scb", 0.8, 0.4, "span = 0.6\n", ""),
                ("direct_shear", 0.6, 0.4, "normal_stress = 1e6\n", ""),
                ("direct_shear", 0.6, 0.4, "normal_stress = 1e6\nnormal_stiffness = 1e9\n", "")):
            loading = f'[loading]\nkind = "{kind}"\nmax_axial_strain = 0.01\n' + keys
            text = box.format(width, height) + area + strengths + cells + cohesive + shape + loading + output
            with self.subTest(kind=kind, shape=shape):
                folder = run(kind + ("_notched" if shape else "_sprung" if "stiffness" in keys else ""), text)
                self.agrees(folder, 40)
                r = recounted(folder)
                self.assertLessEqual({"stress_section", "strain_length", "valid"}, r.keys)
                self.assertEqual("stiffness" in keys, "normal_stress_end" in r.keys)
                notched = shape or kind == "scb"
                self.assertEqual(bool(notched), any(key.startswith("fracture_toughness") for key in r.keys))

    def test_cells_of_a_size_asked_for(self):
        self.agrees(cells_by_their_size(), 100)
        self.assertLessEqual({"packing.cell_diameter", "packing.cell_spread"}, recounted(cells_by_their_size()).keys)

    def test_triangles_between_frictional_platens(self):
        self.agrees(run("triangles", rock + triangles + squeezed + friction + output), 100)

    def test_cells_of_micrometres(self):
        # With grains of 4 micrometres, fragments have areas of about 1e-11 m2.
        tiny = packing.replace("1.333e-2", "1.333e-6").replace("2.667e-2", "2.667e-6").replace("7.74e-5", "7.74e-9")
        small_cells = cells.replace("thick = 1e-3", "thick = 1e-7")
        case = tiny + area + strengths + small_cells + cohesive + scattered("weibull", 0.3) + squeezed + output
        self.agrees(run("micrometres", case), 300)

    def test_errors_of_crack_initiation(self):
        """Compares the errors for a specimen with enough breaks to have a crack initiation."""
        shipped = Path(__file__).parents[2] / "specimens/guide_rock/delaunay_compression.toml"
        folder = run("verified_triangles", f'include = "{shipped}"\n[packing]\ncount = 40\n' + output, "--verify")
        r = recounted(folder)
        self.assertIsNotNone(r.summary["crack_initiation_stress"])
        self.agrees(folder, 250)
        self.assertLessEqual({f"numerical_errors.crack_initiation_stress.{part}" for part in ("rate", "time_step", "stated")}, r.keys)

    def test_triangles_pulled_by_tolerance(self):
        self.agrees(run("triangles_pulled", rock + triangles + pulled + output), 150)

    def test_guides_law(self):
        self.agrees(run("demseg", rock + voronoi + pulled + bonded + '[numerics]\ncontact_law = "demseg"\n' + output), 20)

    def test_consistent_integrator(self):
        self.agrees(run("consistent", rock + squeezed + '[numerics]\nintegrator = "consistent"\n' + output), 100)

    def test_every_step_of_circles_and_polygons(self):
        for name, case, speed in (("pulled", pulled + bonded, 0.2), ("squeezed", squeezed, 0.2), ("glued", pulled, 0.2),
                                  ("cells", voronoi + pulled + bonded, 0.2), ("glued_cells", voronoi + pulled, 0.2),
                                  ("frictional", triangles + squeezed.replace("0.02", "0.003") + friction, 0.5)):
            quick = case + f"axial_strain_rate = {speed}\n"
            text = rock.replace("count = 80", "count = 30") + quick + output.replace("frames = 12", "frames = 2000")
            with self.subTest(case=name):
                folder = run("every_step_" + name, text)
                r = recounted(folder)
                self.assertTrue(any("history" in line[0] for line in r.lines), "a frame per step")
                if name == "frictional":
                    self.assertIn("initial_tangent_window.contacts_gained", r.keys)
                    self.assertGreater(r.summary["initial_tangent_window"]["contacts_gained"], 0)
                self.agrees(folder, 180)

    def test_cells_of_an_area_with_weibull_strengths_pulled_between_glued_platens(self):
        self.agrees(cells_of_an_area_pulled(), 200)

    def test_cells_of_an_area_between_frictional_platens(self):
        for angle in ("30.0", "15.0"):  # above and below the residual friction angle
            platens = squeezed + friction.replace("15.0", angle)
            self.agrees(run("cells_frictional_" + angle, packing + area + strengths + cells + cohesive + platens + output), 200)

    def test_cells_with_strengths_a_point_within_grips(self):
        text = rock + "tensile_strength = 2000.0\ncohesion = 6000.0\n" + cells + cohesive + "gap = 2.0e-4\n"
        held = 'platens = "glued"\ngrip = 0.15\n'
        self.agrees(run("cells_grips", text + squeezed.replace("0.02", "0.05") + held + output), 200)

    def test_triangles_of_an_area_with_normal_strengths_and_a_thickness(self):
        text = packing + area + strengths + wedges + cohesive + scattered("normal", 0.4)
        self.agrees(run("wedges", text + squeezed + output + "out_of_plane_thickness = 0.05\n"), 200)

    def test_circles_with_factors_and_bonds_at_gaps(self):
        self.agrees(circles_by_factors(), 200)

    def test_circles_of_an_area_with_back_tension(self):
        self.agrees(run("circles_area", packing + area + squeezed + output), 200)

    def test_cells_part_at_platens_that_are_bonded(self):
        folder = run("cells_bonded", packing + area + strengths + cells + cohesive + pulled + bonded + output)
        self.agrees(folder, 150)
        self.assertEqual(json.loads((folder / "summary.json").read_text())["failed_at"], "platen")

    def test_every_step_of_coulomb_bonds(self):
        weak = strengths.replace("1.0e7", "0.5e7").replace("3.0e7", "0.5e7")
        for name, case in (
            ("cells", area + strengths + cells + cohesive + scattered("weibull", 0.3) + pulled + "axial_strain_rate = 0.8\n"),
            ("frictional", area + weak + cells + cohesive + squeezed.replace("0.02", "0.006") + "axial_strain_rate = 3.0\n"
             + friction.replace("15.0", "30.0")),
            ("circles", circles_every_step),
        ):
            with self.subTest(case=name):
                folder = every_step_of_few("coulomb_" + name, case)
                self.assertTrue(any("history" in line[0] for line in recounted(folder).lines), "a frame per step")
                self.agrees(folder, 180)

    def test_rate_rule_of_every_step(self):
        for name, case in (("pulled", pulled), ("squeezed", squeezed), ("cells", voronoi + squeezed)):
            text = rock.replace("count = 80", "count = 30") + case + output + "curve_rows = 99998\n"
            with self.subTest(case=name):
                folder = run("rule_" + name, text)
                r = recounted(folder)
                self.assertIn("strain_share_above_tolerance", r.keys)
                self.assertGreater(r.summary["strain_share_above_tolerance"], 0.0, "the rule changed the rate")
                self.agrees(folder, 100)

    def test_companions_are_the_tests_that_they_say(self):
        small = rock.replace("count = 80", "count = 30")
        step = "[numerics]\ntime_step = 1e-4\n"
        for loading, slower in ((squeezed + rate, ("rate = 0.02", "rate = 0.01")),
                                (squeezed + "rate_tolerance = 0.01\n", ("= 0.01\n", "= 0.0025\n"))):
            text = small + loading + step
            kind = "rate" if rate in loading else "tolerance"
            of = read(run(f"verified_{kind}", text, "--verify"))
            for name, own in (("half_time_step", text.replace("1e-4", "0.5e-4")), ("half_rate", text.replace(*slower)),
                              ("half_damping", text.replace("ratio = 0.2", "ratio = 0.1")),
                              ("double_damping", text.replace("ratio = 0.2", "ratio = 0.4").replace(step, ""))):
                other = read(run(f"{kind}_{name}", own))
                stated = of.summary["numerical_errors"]["companions"][name]
                for figure, from_summary in (("peak_stress", "peak_stress"), ("peak_strain", "peak_strain"), ("steps", "steps"),
                                             ("time_step", "time_step_mean"), ("axial_strain_rate", "axial_strain_rate"),
                                             ("ended_by", "ended_by"), ("crack_initiation_stress", "crack_initiation_stress"),
                                             ("crack_damage_stress", "crack_damage_stress")):
                    expected = other.summary[from_summary]
                    with self.subTest(kind=kind, companion=name, figure=figure):
                        if figure == "axial_strain_rate":  # computed from rows here, but given in the case there
                            self.assertAlmostEqual(stated[figure], expected, delta=1e-9 * expected)
                        else:
                            self.assertEqual(stated[figure], expected)
                strain, theirs = of.curve["axial_strain"], other.curve["axial_strain"]
                after = (strain >= of.summary["peak_strain"]) & (strain <= min(strain[-1], theirs[-1]))
                apart = np.abs(np.interp(strain[after], theirs, other.curve["axial_stress"]) - of.curve["axial_stress"][after])
                expected = apart.mean() / of.summary["peak_stress"]
                with self.subTest(kind=kind, companion=name, figure="post_peak_difference"):
                    self.assertGreater(after.sum(), 5, "rows after the peak")
                    self.assertAlmostEqual(stated["post_peak_difference"], expected, delta=1e-9)

    def test_platens_that_turn_round(self):
        r = self.agrees(unloaded(), 380)
        cycles = r.summary["cycles"]
        self.assertEqual(cycles[0]["modulus"], r.summary["youngs_modulus"], "nothing broke or slid")
        self.assertNotEqual(cycles[2]["damage"], 0.0, "a bond had broken")
        self.assertLessEqual({f"cycles[2].{name}" for name in cycles[2]}, r.keys)
        loading = squeezed.replace("0.02", "0.01") + 'control = "lateral"\n'
        self.agrees(run("lateral", packing + area + strengths + cells + cohesive + loading + output), 350)
        at_stresses = squeezed.replace("0.02", "0.01") + "unload_at_stress = [2e3, 4e3]\nunload_to = 0.3\n"
        self.agrees(run("unloaded_at_stresses", rock + voronoi + at_stresses + output), 350)

    def test_minerals(self):
        labels = scratch / "labels.txt"
        labels.write_text("".join(("1\n", "mica\n", "feldspar\n")[k % 3] for k in range(80)))
        by_labels = minerals.replace("seed = 5", f'assign = "labels"\nlabels = "{labels}"')
        for name, case in (("drawn", rock + minerals + squeezed + rate), ("sizes", rock + voronoi + pulled +
                           minerals.replace("seed = 5", 'assign = "size"')), ("labelled", rock + by_labels + squeezed)):
            with self.subTest(assign=name):
                folder = run("minerals_" + name, case + output)
                self.assertGreater(len([1 for line in recounted(folder).lines if line[0].startswith("minerals")]), 20)
                self.agrees(folder, 150)
        text = rock.replace("count = 80", "count = 30") + minerals + pulled + "axial_strain_rate = 0.2\n"
        self.agrees(run("minerals_every_step", text + output.replace("frames = 12", "frames = 2000")), 180)

    def test_minerals_with_coulomb_bonds(self):
        self.agrees(run("minerals_factors", rock + cohesive + factors + squeezed + rate + minerals + output), 200)
        given = "tensile_strength = 2000.0\ncohesion = 6000.0\nresidual_friction_angle = 10.0\n"
        self.agrees(run("minerals_cells", rock + given + cells + cohesive + squeezed + friction + minerals + output), 200)
        two = '[minerals]\nseed = 5\n[[mineral]]\nname = "mica"\narea_share = 0.5\nfriction_angle = 30.0\n[[mineral]]\nname = "rest"\n'
        self.agrees(run("minerals_area", packing + area + strengths + cells + cohesive + squeezed + two + output), 200)
        for name, loading in (("pulled", pulled), ("squeezed", squeezed + friction)):
            text = packing + area + strengths + cells + cohesive + scattered("weibull", 0.2) + loading + minerals_of_an_area
            with self.subTest(minerals_of_an_area=name):
                self.agrees(run("minerals_stated_" + name, text + output), 200)

    def test_wrong_shares_of_minerals_are_found(self):
        folder = run("minerals_drawn", rock + minerals + squeezed + rate + output)
        wrong = scratch / "minerals_wrong"
        shutil.copytree(folder, wrong)
        summary = json.loads((folder / "summary.json").read_text())
        summary["minerals"][0]["area_share_reached"] += 1e-6
        summary["minerals"][2]["grains"] += 1
        (wrong / "summary.json").write_text(json.dumps(summary))
        self.assertEqual(sorted(differing(recount(wrong))), ["minerals[0].area_share_reached", "minerals[2].grains"])

    def test_restarted(self):
        folder, case = scratch / "restarted", scratch / "restarted.toml"
        case.write_text(rock.replace("count = 80", "count = 300") + squeezed + output)
        process = subprocess.Popen([program, "test", "-q", str(case), "-o", str(folder)], stderr=subprocess.DEVNULL)
        while process.poll() is None:
            if len(list(folder.glob("frames/particles_*.vtp"))) > 2:
                process.send_signal(signal.SIGINT)
                break
            time.sleep(0.002)
        process.wait()
        self.assertTrue(json.loads((folder / "summary.json").read_text())["interrupted"], "stopped during the run")
        subprocess.run([program, "test", "-q", "--resume", str(folder)], check=True)
        self.agrees(folder, 150)


class Refuses(unittest.TestCase):
    def test_folders_without_frames_or_rows(self):
        for word, spoil in (("frame", lambda folder: shutil.rmtree(folder / "frames")),
                            ("row", lambda folder: (folder / "curve.csv").write_text("step,time\n0,0\n"))):
            folder = scratch / "lacking"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(circles(), folder)
            spoil(folder)
            with self.subTest(lacking=word), self.assertRaisesRegex(Unreadable, f"found (no|fewer than two) {word}.*expected"):
                recount(folder)


class FaultsAreFound(WrongJoints, WrongFaces, WrongFiles, unittest.TestCase):
    sound = staticmethod(circles)

    def test_second_body_of_an_event(self):
        found = self.spoil_column("events.csv", "body_j", lambda column: [column[-1]] + column[1:])
        self.found(found, "events")

    def test_place_and_orientation_of_events(self):
        self.found(self.spoil_column("events.csv", "x", lambda column: column[1:] + column[:1]), "events: place")
        more = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        self.found(self.spoil_column("events.csv", "orientation", more), "events: orientation")

    def test_strain_of_row_0_in_every_event(self):
        self.found(self.spoil_column("events.csv", "axial_strain", lambda column: ["0"] * len(column)), "axial_strain")

    def test_slips(self):
        more = lambda column: [str(float(value) * 1.001) for value in column]  # noqa: E731
        self.found(self.spoil_column("slips.csv", "shear_force", more), "slips: shear force")
        late = lambda column: [str(int(value) + 1000) for value in column]  # noqa: E731
        self.found(self.spoil_column("slips.csv", "step", late), "bonds_slid of slips")
        self.found(self.spoil_column("slips.csv", "x", lambda column: column[1:] + column[:1]), "slips: place")
        more = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        self.found(self.spoil_column("slips.csv", "orientation", more), "slips: orientation")

    def test_acoustic_events(self):
        halved = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        for column, figure in (("scalar_moment", "ae: scalar_moment"), ("moment_magnitude", "ae: moment_magnitude"),
                               ("moment_xx", "ae: scalar_moment"), ("energy", "ae: energy"), ("x", "ae: x"),
                               ("radius", "ae: radius"), ("duration", "ae: duration")):
            with self.subTest(column=column):
                self.found(self.spoil_column("ae.csv", column, halved), figure)
        more = lambda column: [str(int(column[0]) + 1)] + column[1:]  # noqa: E731
        self.found(self.spoil_column("ae.csv", "breaks", more), "ae: breaks")
        other = lambda column: ["closing" if word == "opening" else word for word in column]  # noqa: E731
        self.found(self.spoil_column("ae.csv", "type", other), "ae: rows of another type")
        for name in ("events", "opening", "largest_magnitude", "shear_wave_speed", "density", "damping_ratio", "window"):

            def change(summary, name=name):
                summary["emission"][name] = 1.01 * summary["emission"][name] + 0.01

            with self.subTest(figure=name):
                self.found(self.spoil_summary(change), "emission." + name)

        def count(summary):
            summary["b_value"]["events"] += 1

        self.found(self.spoil_summary(count), "b_value.events")

    def test_strength_and_energy_of_events(self):
        halved = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        self.found(self.spoil_column("events.csv", "strength", halved), "strength")
        self.found(self.spoil_column("events.csv", "energy", halved), "fracture_loss")

    def test_one_break_after_sliding_too_many(self):
        def change(summary):
            summary["bonds_broken_after_sliding"] += 1

        self.found(self.spoil_summary(change), "bonds_broken_after_sliding")

    def test_stress_in_pascal_times_the_thickness(self):
        def change(summary):
            summary["peak_stress_pa"] = summary["peak_stress"] * 0.05

        self.found(self.spoil_summary(change), "peak_stress_pa")

    def test_shares_and_stated_errors_divided_by_ten(self):
        for path in (
            ("energy_closing_error",),
            ("platen_out_of_balance",),
            ("packing", "coordination"),
            ("packing", "anisotropy"),
            ("numerical_errors", "peak_stress", "stated"),
            ("numerical_errors", "peak_strain", "damping"),
        ):

            def change(summary, path=path):
                for part in path[:-1]:
                    summary = summary[part]
                summary[path[-1]] /= 10

            with self.subTest(figure=".".join(path)):
                self.found(self.spoil_summary(change), ".".join(path))

    def test_figures_of_cycles(self):
        def change(summary):
            for name in summary["cycles"][2]:
                summary["cycles"][2][name] *= 1.001

        names = recounted(unloaded()).summary["cycles"][2]
        self.assertEqual(self.spoil_summary(change, unloaded()), sorted("cycles[2]." + name for name in names))

    def test_cells_measured_without_their_gaps(self):
        for name, off in (("cell_diameter", 1.01), ("cell_spread", 1.03)):

            def what(folder, name=name, off=off):
                summary = json.loads((folder / "summary.json").read_text())
                summary["packing"][name] *= off
                (folder / "summary.json").write_text(json.dumps(summary))

            with self.subTest(figure=name):
                self.assertEqual(self.spoilt(what, cells_by_their_size()), ["packing." + name])

    def test_peak_one_row_late(self):
        curve = (circles() / "curve.csv").read_text().splitlines()
        head = curve[0].split(",")
        strain = [float(line.split(",")[head.index("axial_strain")]) for line in curve[1:]]
        peak = json.loads((circles() / "summary.json").read_text())["peak_strain"]
        late = curve[1 + strain.index(peak) + 1].split(",")

        def change(summary):
            summary["peak_stress"] = float(late[head.index("axial_stress")])
            summary["peak_strain"] = float(late[head.index("axial_strain")])

        found = self.spoil_summary(change)
        self.found(found, "peak_stress")
        self.found(found, "peak_strain")

    def test_figures_of_the_other_peak(self):
        def strength(summary):
            summary["peak_stress"], summary["peak_strain"] = summary["largest_stress"], summary["strain_at_largest_stress"]

        def area(summary):
            for name in ("peak", "end"):
                summary[f"area_strain_{name}"] *= -1

        def damage(summary):
            summary["bonds_broken_in_tension_to_peak"] = summary["bonds_broken_in_tension"]
            summary["fragments"] += 1
            summary["largest_fragment_share"] *= 0.99
            summary["notices"] = [notice for notice in summary["notices"] if "largest stress" not in notice]

        for change, figures_found in ((strength, ("peak_stress", "peak_strain")), (area, ("area_strain_peak", "area_strain_end")),
                                      (damage, ("bonds_broken_in_tension_to_peak", "fragments", "largest_fragment_share", "notice"))):
            found = self.spoil_summary(change, rubble())
            for figure in figures_found:
                with self.subTest(figure=figure):
                    self.found(found, figure)

    def test_companion_at_the_full_step_rate_or_damping(self):
        for name, figure in (("half_time_step", "time_step"), ("half_rate", "axial_strain_rate"),
                             ("half_damping", "damping"), ("double_damping", "damping")):

            def change(summary, name=name, figure=figure):
                run = summary["numerical_errors"]["companions"][name]
                run[figure] *= 2 if name.startswith("half") else 0.5

            with self.subTest(companion=name):
                self.found(self.spoil_summary(change), "companion " + name)

    def test_companion_of_another_peak(self):
        def change(summary):
            summary["numerical_errors"]["companions"]["half_rate"]["peak_stress"] *= 1.01

        self.found(self.spoil_summary(change), "numerical_errors.peak_stress")

    def test_gauge_of_all_side_particles(self):
        widened = lambda column: [str(1.01 * float(value)) for value in column]  # noqa: E731
        self.found(self.spoil_column("curve.csv", "lateral_strain", widened), "lateral_strain")

    def test_losses_and_single_energies_of_a_frame_a_step(self):
        text = rock.replace("count = 80", "count = 30") + pulled + bonded + "axial_strain_rate = 0.2\n"
        sound = run("every_step_pulled", text + output.replace("frames = 12", "frames = 2000"))
        more = lambda values: [str(float(value) * 1.001) for value in values]  # noqa: E731
        for file, columns in (("curve.csv", ("dashpot_loss", "friction_loss", "platen_work")),
                              ("events.csv", ("energy", "normal_force", "shear_force"))):
            for column in columns:
                figure = column if file == "curve.csv" else column.replace("_", " ") + " of breaks"
                with self.subTest(column=column):
                    self.found(self.spoil_column(file, column, more, sound), "history: " + figure)

    def test_strength_without_its_random_factor(self):
        mean = json.loads((circles_by_factors() / "summary.json").read_text())["mean_back_tension"]
        found = self.spoil_column("events.csv", "strength", lambda column: [str(mean)] * len(column), circles_by_factors())
        self.found(found, "events: strength")

    def test_modes_swapped(self):
        other = {"shear": "tension", "tension": "shear"}
        found = self.spoil_column("events.csv", "mode", lambda column: [other[word] for word in column], circles_by_factors())
        self.found(found, "events: rows with another mode")

    def test_energy_of_coulomb_bonds_halved(self):
        halved = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        self.found(self.spoil_column("events.csv", "energy", halved, circles_by_factors()), "events: energy of all")

    def test_largest_crack_grip_and_strengths_of_the_summary(self):
        for name, value in (("failed_at", "grip"), ("failed_at", None), ("grip", 0.0), ("bonds_unbreakable", 0),
                            ("gauge_modulus", 1.001), ("mean_tensile_strength", 1.001), ("bond_law", "back_tension"),
                            ("material_units", "point"), ("platens", "bonded"), ("peak_stress_pa", 20.0)):

            def change(summary, name=name, value=value):
                summary[name] = summary[name] * value if isinstance(value, float) else value

            with self.subTest(figure=name, value=value):
                self.found(self.spoil_summary(change, cells_of_an_area_pulled()), name)

        def fewer(summary):
            summary["largest_crack"]["bonds"] -= 1

        self.found(self.spoil_summary(fewer, cells_of_an_area_pulled()), "largest_crack.bonds")

    def test_gauge_strain_as_far_as_the_platens(self):
        lines = (cells_of_an_area_pulled() / "curve.csv").read_text().splitlines()
        whole = [line.split(",")[0] for line in lines[1:]]
        found = self.spoil_column("curve.csv", "gauge_strain", lambda column: whole, cells_of_an_area_pulled())
        self.found(found, "gauge_strain")

    def test_single_breaks_of_coulomb_bonds(self):
        sound = every_step_of_few("coulomb_circles", circles_every_step)
        more = lambda values: [str(float(value) * 1.001) for value in values]  # noqa: E731
        for column in ("energy", "normal_force", "shear_force"):
            with self.subTest(column=column):
                found = self.spoil_column("events.csv", column, more, sound)
                self.found(found, f"history: {column.replace('_', ' ')} of breaks")

        def last(words):
            return words[:-1] + ["tension" if words[-1] == "shear" else "shear"]

        self.found(self.spoil_column("events.csv", "mode", last, sound), "history: mode of breaks")

    def test_energies_and_sliding_points_of_the_curve(self):
        for column in ("strain_energy", "kinetic_energy", "points_sliding", "bonds_slid", "stress_top"):
            with self.subTest(column=column):
                more = lambda values: [str(float(value) * 1.001 + 1) for value in values]  # noqa: E731
                self.found(self.spoil_column("curve.csv", column, more), column)


if __name__ == "__main__":
    table = Path(sys.argv.pop()) if "--differences" in sys.argv[1:-1] else None
    if table:
        sys.argv.remove("--differences")
    try:
        done = unittest.main(exit=False).result
        if table and done.wasSuccessful():
            differences.write(table)
        sys.exit(not done.wasSuccessful())
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
