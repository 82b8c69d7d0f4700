# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests with joints, for recount_test.py: every kind of test that can have joints, and all kinds of particles."""

from cases import (
    area, cells, cohesive, dilating, friction, gaps, joint, joint_of_few, jointed, minerals_of_an_area, open_faces, output, packing,
    a_row_a_step, pulled, rock, scattered, squeezed, strengths, touching, voronoi, weak, weaker, wedges, wide_gaps
)
from running import recounted, run

scatter = scattered("weibull", 0.3)
pressed = squeezed.replace('"compression"', '"biaxial"') + "[confinement]\npressure = 2e6\n"
loose_faces = "frames: normal_force of flat faces without a bond"
traces = (
    '[joints]\nseed = 1\n[[trace]]\nname = "bent"\npoints = [0.0, 0.1, 0.12, 0.2, 0.2556010546140942, 0.4]\n' + weak
    + '[[trace]]\nname = "across"\npoints = [0.05, 0.4, 0.2, 0.1]\n' + open_faces
)


def weak_cells():
    return run("joint_weak_cells", jointed + cells + cohesive + scatter + squeezed + output + joint + weak)


def weak_circles():
    return run("joint_weak_circles", jointed + touching + scatter + squeezed + output + joint + weak)


class JointedTests:
    def left(self, folder):
        return set(recounted(folder).left)

    def test_a_weak_joint_through_cells(self):
        self.agrees(weak_cells(), 340)
        self.assertEqual(self.left(weak_cells()), set())

    def test_open_faces_of_cells_slide_and_dilate(self):
        folder = run("joint_open_cells", jointed + wide_gaps + cohesive + squeezed + output + joint + open_faces + dilating)
        self.agrees(folder, 260)
        self.assertEqual(self.left(folder), {"frames: normal_force of faces that dilate"})

    def test_a_bent_trace_and_one_across_it_among_triangles(self):
        folder = run("joint_traces", jointed + wedges + cohesive + squeezed + friction + output + traces)
        self.agrees(folder, 350)
        self.assertEqual(self.left(folder), {"traces[0].length", "traces[1].length"})

    def test_welded_traces_of_back_tension_bonds(self):
        self.agrees(run("joint_welded", rock + voronoi + squeezed + output + joint), 380)

    def test_a_joint_between_minerals(self):
        keys = "strength_factor = 0.3\nfriction_angle = 20.0\nnormal_stiffness = 1e12\n"
        text = jointed + cells + cohesive + squeezed + output + joint + keys + minerals_of_an_area
        self.agrees(run("joint_minerals", text), 330)

    def test_joints_that_are_pulled(self):
        flat = joint.replace("60.0", "20.0") + weak
        self.agrees(run("joint_pulled_cells", jointed + cells + cohesive + scatter + pulled + output + flat), 280)
        self.agrees(run("joint_pulled_circles", jointed + touching + pulled + output + flat), 280)
        # In tension, open faces carry no force.
        self.agrees(run("joint_pulled_gaps", jointed + wedges + cohesive + pulled + output + gaps + open_faces), 280)

    def test_joints_under_a_pressure(self):
        open_joint = joint + open_faces
        self.agrees(run("joint_pressed_cells", jointed + wide_gaps + cohesive + pressed + output + open_joint), 380)
        self.agrees(run("joint_walls", jointed + wide_gaps + cohesive + pressed + 'side = "walls"\n' + output + open_joint), 130)

    def test_a_joint_in_direct_shear(self):
        box = packing.replace("height_to_width = 2.0", "width = 0.6\nheight = 0.4").replace("count = 80\n", "")
        level = joint.replace("60.0", "0.0").replace("0.128, 0.256", "0.3, 0.2")
        loading = '[loading]\nkind = "direct_shear"\nmax_axial_strain = 0.005\nnormal_stress = 1e6\n'
        self.agrees(run("joint_sheared", box + area + strengths + cells + cohesive + loading + output + level + weak), 90)

    def test_flat_faces_of_circles(self):
        self.agrees(weak_circles(), 300)
        self.assertEqual(self.left(weak_circles()), {"curve: energy_error", "events: energy of flat faces", loose_faces})
        folder = run("joint_open_circles", jointed + touching + squeezed + output + gaps + open_faces + "aperture = 1e-5\n")
        self.agrees(folder, 350)
        self.assertIn(loose_faces, self.left(folder))

    def test_circles_at_traces_that_no_file_says_the_ends_of(self):
        text = jointed + touching + squeezed + output.replace("double", "single") + gaps + open_faces
        folder = run("joint_single", text)
        self.agrees(folder, 130)
        self.assertIn("bonds, events and frames", self.left(folder))

    def test_every_step_of_joints(self):
        for name, count, text, strain, speed in (
            ("triangles", 10, wedges + cohesive + joint_of_few + weaker + dilating, 0.0005, 10.0),
            ("cells", 16, wide_gaps + cohesive + joint_of_few + open_faces + dilating, 0.0005, 5.0),
            ("circles", 24, touching + joint_of_few + weaker, 0.001, 1.0),
            ("open_circles", 24, touching + joint_of_few + open_faces, 0.0005, 1.0),
        ):
            few = packing.replace("count = 80", f"count = {count}") + area + strengths
            loading = squeezed.replace("0.02", str(strain)) + f"axial_strain_rate = {speed}\n"
            with self.subTest(case=name):
                r = self.agrees(run("joint_every_step_" + name, few + text + loading + a_row_a_step), 380)
                self.assertTrue(any("history" in line[0] for line in r.lines), "a frame per step")
                if name in ("triangles", "circles"):
                    self.assertGreater(r.summary["bonds_broken_on_joints"], 0)
                else:
                    self.assertGreater(r.curve["friction_loss"][-1], 0.0)


class WrongJoints:
    """Changes the keys of a joint that the recount reads, and figures of traces: each must be found."""

    def differs_by(self, key, value, figure, sound):
        def what(folder):
            text = (folder / "case.toml").read_text()
            before = [line for line in text.splitlines() if line.startswith(key + " = ")][-1]
            (folder / "case.toml").write_text(text.replace(before, f"{key} = {value}"))

        with self.subTest(key=key):
            self.found(self.spoilt(what, sound), figure)

    def test_keys_of_joints(self):
        for key, value, figure in (("tensile_strength", 2.1e6, "mean_tensile_strength"), ("cohesion", 6.1e6, "mean_cohesion"),
                                   ("friction_angle", 31.0, "events: strength"), ("residual_friction_angle", 19.0, "Coulomb limit"),
                                   ("normal_stiffness", 1.01e12, "youngs_modulus"), ("shear_stiffness", 4.1e11, "youngs_modulus")):
            for sound in (weak_cells(), weak_circles()):
                if (key, sound) != ("residual_friction_angle", weak_circles()):  # nothing slides in that test
                    self.differs_by(key, value, figure, sound)

    def test_figures_of_traces(self):
        moved = ("slip", "opening", "largest_slip", "largest_opening", "failed_share")
        own = {"length": 1.001, "length_of_faces": 1.001, "faces": 2, "bonded_share": 0.9}

        def change(summary):
            for name in moved:
                summary["joints"][0]["at_end"][name] *= 0.999
                summary["traces"][0]["at_peak"][name] *= 0.999
            for name, factor in own.items():
                summary["traces"][0][name] *= factor

        expected = {f"joints[0].at_end.{name}" for name in moved} | {f"traces[0].at_peak.{name}" for name in moved}
        expected |= {f"traces[0].{name}" for name in own}
        for sound in (weak_cells(), weak_circles()):
            with self.subTest(folder=sound.name):
                self.assertLessEqual(expected, set(self.spoil_summary(change, sound)))

    def test_breaks_on_joints(self):
        def change(summary):
            summary["bonds_broken_on_joints"] += 1
            summary["bonds_broken_in_rock_to_peak"] += 1

        self.assertEqual(self.spoil_summary(change, weak_cells()), ["bonds_broken_in_rock_to_peak", "bonds_broken_on_joints"])
        rock_alone = lambda column: ["-1"] * len(column)  # noqa: E731
        found = self.spoil_column("events.csv", "trace", rock_alone, weak_cells())
        for figure in ("events: trace", "bonds_broken_on_joints", "cracks: trace"):
            self.found(found, figure)
