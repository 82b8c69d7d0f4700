#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small tests of each kind, recounted; and files made wrong on purpose, each of which the recount must find."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
from recount import figures, recount  # noqa: E402
from results import Unreadable  # noqa: E402

program = os.environ["CRACKLE_PROGRAM"]
scratch = Path(tempfile.mkdtemp(prefix="recount"))

rock = """
[packing]
count = 80
height_to_width = 2.0
radius_min = 1.333e-2
radius_max = 2.667e-2
mean_overlap = 7.74e-5
seed = 3
[material]
density = 2500.0
normal_stiffness = 1.0e7
shear_stiffness = 2.5e6
friction_angle = 27.0
damping_ratio = 0.2
"""
output = '[output]\nframe_precision = "double"\nframes = 12\n'
voronoi = '[mesh]\nkind = "voronoi"\nthick = 1e-3\n[bond]\nthick = 1.08e-3\n'
triangles = '[mesh]\nkind = "delaunay"\nboundary = "domain"\nthick = 1e-3\n[bond]\nthick = 1.08e-3\n'
between_seeds = triangles.replace('boundary = "domain"\n', "")
squeezed = '[loading]\nkind = "compression"\nmax_axial_strain = 0.02\n'
pulled = '[loading]\nkind = "tension"\nmax_axial_strain = 0.005\n'
rate = "axial_strain_rate = 0.02\n"
friction = 'platens = "frictional"\nplaten_friction_angle = 15.0\n'


# Figures of a test of circles squeezed at a rate with companions.
figures_expected = """
axial_strain_end axial_strain_rate bond_thick bonds_broken bonds_broken_after_sliding bonds_broken_in_shear
bonds_broken_in_tension bonds_initial contacts_initial ended_by energy_closing_error failed initial_height
initial_poissons_ratio initial_tangent_modulus initial_tangent_modulus_pa initial_tangent_window.bonds_broken
initial_tangent_window.points_sliding initial_tangent_window.rows initial_tangent_window.strain_to initial_width
interfaces_initial interfaces_lost kind mean_back_tension mean_back_tension_interface mean_bond_overlap
numerical_errors.peak_strain.damping numerical_errors.peak_strain.energy_closing
numerical_errors.peak_strain.rate numerical_errors.peak_strain.stated numerical_errors.peak_strain.time_step
numerical_errors.peak_stress.damping numerical_errors.peak_stress.energy_closing numerical_errors.peak_stress.rate
numerical_errors.peak_stress.stated numerical_errors.peak_stress.time_step out_of_plane_thickness packing.anisotropy
packing.coordination packing.coordination_of_carrying packing.floating packing.mean_overlap packing.radius_scale
packing.stress_x packing.stress_y packing.unbalanced packing.void_ratio frame_end frame_peak frame_start particles
particle_steps_per_second peak_converged peak_strain peak_stress peak_stress_pa platen_bottom_id platen_out_of_balance platen_top_id poissons_ratio seed simulated_time specimen
stable_time_step steps tangent_50_poissons_ratio tangent_modulus_50 tangent_modulus_50_pa time_step time_step_bound
time_step_mean time_step_over_stable youngs_modulus youngs_modulus_pa
"""


def run(name, case, *options):
    """Runs a case once. @return its folder"""
    folder = scratch / name
    if not folder.exists():
        file = scratch / f"{name}.toml"
        file.write_text(case)
        subprocess.run([program, "test", "-q", str(file), "-o", str(folder), *options], check=True)
    return folder


def circles():
    return run("circles", rock + squeezed + rate + output + "out_of_plane_thickness = 0.05\n", "--verify")


def cells():
    sizes = rock.replace("radius_min = 1.333e-2\nradius_max = 2.667e-2", "cell_diameter = 4.4e-2\ncell_spread = 0.15")
    return run("sized_cells", sizes + voronoi + squeezed + output)


def differing(folder):
    return [line[0] for line in recount(folder).lines if not line[5]]


class Recount(unittest.TestCase):
    def agrees(self, folder, fewest):
        r = recount(folder)
        for name, stated, ours, difference, tolerance, holds in r.lines:
            with self.subTest(folder=folder.name, figure=name):
                self.assertTrue(holds, f"expected {ours} within {tolerance:.1e}, got {stated}, error {difference:.1e}")
        self.assertGreaterEqual(len(r.lines), fewest, "figures recounted")
        print(f"{folder.name}: {len(r.lines)} figures")

    def test_circles_squeezed_at_a_rate_with_a_thickness_and_companions(self):
        self.agrees(circles(), 200)

    def test_every_figure_is_recounted_but_those_that_no_file_holds(self):
        r = recount(circles())
        left = {name for name in figures(r.summary) - r.keys if ".companions." not in name}
        self.assertEqual(left, {
            "initial_tangent_window.contacts_gained",  # needs every step
            "numerical_errors.peak_strain.resolution", "numerical_errors.peak_stress.resolution",  # only bounded
            *(f"numerical_errors.youngs_modulus.{name}" for name in
              ("damping", "rate", "resolution", "stated", "time_step")),  # the solve's own residual
            "list_builds", "threads",
            "step_seconds", "wall_seconds",
        })
        self.assertEqual(set(figures_expected.split()) - r.keys, set(), "figures that the summary lacks")

    def test_circles_pulled_by_tolerance(self):
        self.agrees(run("pulled", rock + pulled + output), 150)

    def test_default_frames_in_single_precision(self):
        self.agrees(run("plain", rock + pulled), 150)

    def test_voronoi_polygons_squeezed_by_tolerance(self):
        self.agrees(run("voronoi", rock + voronoi + squeezed + output), 150)

    def test_voronoi_polygons_pulled_at_a_rate(self):
        self.agrees(run("voronoi_pulled", rock + voronoi + pulled + rate + output), 150)

    def test_cells_of_a_size_asked_for(self):
        self.agrees(cells(), 100)
        self.assertLessEqual({"packing.cell_diameter", "packing.cell_spread"}, recount(cells()).keys)

    def test_triangles_between_frictional_platens(self):
        self.agrees(run("triangles", rock + triangles + squeezed + friction + output), 100)

    def test_triangles_between_seeds(self):
        self.agrees(run("seeds", rock + between_seeds + pulled + output), 150)

    def test_guides_law(self):
        self.agrees(run("demseg", rock + voronoi + pulled + '[numerics]\ncontact_law = "demseg"\n' + output), 20)

    def test_consistent_integrator(self):
        self.agrees(run("consistent", rock + squeezed + '[numerics]\nintegrator = "consistent"\n' + output), 100)

    def test_every_step_of_circles_and_polygons(self):
        for name, case, speed in (("pulled", pulled, 0.2), ("squeezed", squeezed, 0.2), ("cells", voronoi + pulled, 0.2),
                                  ("frictional", triangles + squeezed.replace("0.02", "0.003") + friction, 1.0)):
            quick = case + f"axial_strain_rate = {speed}\n"
            text = rock.replace("count = 80", "count = 30") + quick + output.replace("frames = 12", "frames = 2000")
            with self.subTest(case=name):
                folder = run("every_step_" + name, text)
                self.assertTrue(any("history" in line[0] for line in recount(folder).lines), "a frame a step")
                self.agrees(folder, 180)

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
        self.assertTrue(json.loads((folder / "summary.json").read_text())["interrupted"], "stopped in between")
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


class FaultsAreFound(unittest.TestCase):
    """Each a fault as a program might have it, put into the files of a test that agrees."""

    def spoilt(self, what, sound=None):
        folder = scratch / "spoilt"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(sound or circles(), folder)
        what(folder)
        return differing(folder)

    def spoil_summary(self, change):
        def what(folder):
            summary = json.loads((folder / "summary.json").read_text())
            change(summary)
            (folder / "summary.json").write_text(json.dumps(summary))

        return self.spoilt(what)

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

    def test_second_body_of_an_event(self):
        found = self.spoil_column("events.csv", "body_j", lambda column: [column[-1]] + column[1:])
        self.found(found, "events")

    def test_place_and_orientation_of_events(self):
        self.found(self.spoil_column("events.csv", "x", lambda column: column[1:] + column[:1]), "events: place")
        more = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        self.found(self.spoil_column("events.csv", "orientation", more), "events: orientation")

    def test_strain_of_row_0_in_every_event(self):
        self.found(self.spoil_column("events.csv", "axial_strain", lambda column: ["0"] * len(column)), "axial_strain")

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

    def test_cells_measured_without_their_gaps(self):
        for name, off in (("cell_diameter", 1.01), ("cell_spread", 1.03)):

            def what(folder, name=name, off=off):
                summary = json.loads((folder / "summary.json").read_text())
                summary["packing"][name] *= off
                (folder / "summary.json").write_text(json.dumps(summary))

            with self.subTest(figure=name):
                self.assertEqual(self.spoilt(what, cells()), ["packing." + name])

    def test_peak_one_row_late(self):
        curve = (circles() / "curve.csv").read_text().splitlines()
        head = curve[0].split(",")
        stress = [float(line.split(",")[head.index("axial_stress")]) for line in curve[1:]]
        late = curve[1 + stress.index(max(stress)) + 1].split(",")

        def change(summary):
            summary["peak_stress"] = float(late[head.index("axial_stress")])
            summary["peak_strain"] = float(late[head.index("axial_strain")])

        found = self.spoil_summary(change)
        self.found(found, "peak_stress")
        self.found(found, "peak_strain")

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
        text = rock.replace("count = 80", "count = 30") + pulled + "axial_strain_rate = 0.2\n"
        sound = run("every_step_pulled", text + output.replace("frames = 12", "frames = 2000"))
        more = lambda values: [str(float(value) * 1.001) for value in values]  # noqa: E731
        for file, columns in (("curve.csv", ("dashpot_loss", "friction_loss", "platen_work")),
                              ("events.csv", ("energy", "normal_force", "shear_force"))):
            for column in columns:
                figure = column if file == "curve.csv" else column.replace("_", " ") + " of breaks"
                with self.subTest(column=column):
                    self.found(self.spoil_column(file, column, more, sound), "history: " + figure)

    def test_energies_and_sliding_points_of_the_curve(self):
        for column in ("strain_energy", "kinetic_energy", "points_sliding", "stress_top"):
            with self.subTest(column=column):
                more = lambda values: [str(float(value) * 1.001 + 1) for value in values]  # noqa: E731
                self.found(self.spoil_column("curve.csv", column, more), column)


if __name__ == "__main__":
    try:
        unittest.main()
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
