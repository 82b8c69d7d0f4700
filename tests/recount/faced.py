# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests with faces, for recount_test.py: both kinds of cells, all platens, with and without pressures of the cells, one up to rubble. Where
every step is recounted, they are short: no contact points have replaced a broken face yet."""

import numpy as np
from cases import (
    by_faces, cells, faces, faces_of_minerals, faces_without_pressure, friction, output, packing, pulled, scattered, softening, squeezed, wedges
)
from running import run


def a_frame_a_step(name, case):
    small, every = packing.replace("count = 80", "count = 24"), output.replace("frames = 12", "frames = 2000")
    return run("every_step_" + name, small + case + every)


def faces_squeezed():
    """Faces up to some breaks; no point has replaced a broken face yet."""
    short = squeezed.replace("0.02", "0.0021")
    return run("faces_squeezed", packing + faces + cells + by_faces + scattered("weibull", 0.2) + short + output)


def every_step_of_faces():
    case = faces + cells + by_faces + scattered("weibull", 0.2) + squeezed.replace("0.02", "0.003") + "axial_strain_rate = 1.0\n"
    return a_frame_a_step("faces", case)


class FacedTests:
    def test_faces(self):
        r = self.agrees(faces_squeezed(), 280)
        self.assertGreater(r.summary["bonds_broken_in_shear"], 0)
        self.assertGreater(r.summary["bonds_broken_in_tension"], 0)
        for name, rock_of, shape, loading, more in (
                ("pulled", faces, cells, pulled, ""), ("without_pressure", faces_without_pressure, cells, squeezed.replace("0.02", "0.003"), ""),
                ("wedges", faces, wedges, squeezed.replace("0.02", "0.0025"), ""),
                ("minerals", faces, cells, squeezed.replace("0.02", "0.0015"), faces_of_minerals),
                ("to_rubble", faces, cells, squeezed.replace("0.02", "0.006"), ""),
                ("frictional", faces, cells, squeezed.replace("0.02", "0.0021") + friction, ""),
                ("confined", faces, cells, squeezed.replace("0.02", "0.002").replace('"compression"', '"biaxial"'), "[confinement]\npressure = 1e6\n")):
            with self.subTest(faces=name):
                text = packing + rock_of + shape + by_faces + scattered("weibull", 0.2) + loading + more + output
                r = self.agrees(run("faces_" + name, text), 220)
                self.assertGreater(r.summary["bonds_broken"], 2)
                if name != "frictional":
                    self.assertIn("youngs_modulus", r.keys)

    def test_every_step_of_faces(self):
        own = faces_without_pressure + cells + by_faces + scattered("weibull", 0.2)
        weak = faces.replace("cohesion = 5e6", "cohesion = 3.6e6") + cells + by_faces
        soft = faces + softening + cells + by_faces + scattered("weibull", 0.2)
        for name, folder in (("squeezed", every_step_of_faces()), ("without_pressure", a_frame_a_step(
                "faces_without_pressure", own + squeezed.replace("0.02", "0.0035") + "axial_strain_rate = 1.0\n")),
                             ("softening", a_frame_a_step("faces_softening", soft + squeezed.replace("0.02", "0.0033") + "axial_strain_rate = 1.0\n")),
                             ("pulled", a_frame_a_step("faces_pulled", weak + pulled.replace("0.005", "0.0008") + "axial_strain_rate = 0.5\n"))):
            with self.subTest(faces=name):
                r = self.agrees(folder, 150)
                self.assertTrue(any("history: energy of breaks" in line[0] for line in r.lines), "breaks that are followed")
                self.assertNotIn("curve: energy_error after breaks", r.left)
                if name == "softening":
                    self.assertGreater(r.curve["fracture_loss"][-1], 1.1 * np.sum(r.events["energy"]), "what slip and opening use up")


class WrongFaces:
    def test_figures_of_faces(self):
        halved = lambda column: [str(float(value) / 2) for value in column]  # noqa: E731
        other = {"shear": "tension", "tension": "shear"}
        for file, column, change, figure in (
                ("events.csv", "strength", halved, "events: strength"), ("events.csv", "mode", lambda words: [other[word] for word in words], "events: rows with another mode"),
                ("events.csv", "body_j", lambda ids: [ids[-1]] + ids[1:], "events"), ("events.csv", "normal_force", halved, "events"),
                ("events.csv", "slid", lambda column: ["1"] + column[1:], "events: faces that slid"),
                ("curve.csv", "strain_energy", halved, "curve: strain_energy"), ("curve.csv", "kinetic_energy", halved, "curve: kinetic_energy"),
                ("curve.csv", "stress_bottom", halved, "curve: stress_bottom"), ("curve.csv", "energy_error", lambda column: ["1"] * len(column), "curve: energy_error without breaks")):
            with self.subTest(column=column):
                self.found(self.spoil_column(file, column, change, faces_squeezed()), figure)
        for name in ("youngs_modulus", "poissons_ratio", "gauge_modulus", "mean_tensile_strength", "mean_cohesion", "bonds_initial", "interfaces_initial",
                     "contacts_initial", "stable_time_step"):

            def change(summary, name=name):
                summary[name] *= 1.00001

            with self.subTest(figure=name):
                self.found(self.spoil_summary(change, faces_squeezed()), name)

        def shorter(summary):
            summary["crack_rose"]["tension_to_peak"]["length"] *= 0.999

        self.found(self.spoil_summary(shorter, faces_squeezed()), "crack_rose.tension_to_peak.length")

    def test_losses_and_single_breaks_of_faces(self):
        more = lambda values: [str(float(value) * 1.00001) for value in values]  # noqa: E731
        for file, columns in (("curve.csv", ("dashpot_loss", "friction_loss", "fracture_loss", "platen_work", "strain_energy", "energy_error")),
                              ("events.csv", ("energy", "normal_force", "shear_force"))):
            for column in columns:
                figure = column if file == "curve.csv" else column.replace("_", " ") + " of breaks"
                with self.subTest(column=column):
                    self.found(self.spoil_column(file, column, more, every_step_of_faces()), "history: " + figure)
        other = {"shear": "tension", "tension": "shear"}
        found = self.spoil_column("events.csv", "mode", lambda words: words[:-1] + [other[words[-1]]], every_step_of_faces())
        self.found(found, "history: mode of breaks")

    def test_other_constants_of_faces(self):
        """The results of one law do not pass for those of another."""
        for key, value, wrong, figure in (
                ("youngs_modulus", "10000000000.0", "10010000000.0", "normal_force of intact faces"),
                ("poissons_ratio", "0.26", "0.261", "shear_force of intact faces"), ("stiffness_ratio", "1.6", "1.61", "youngs_modulus"),
                ("damping_ratio", "0.2", "0.201", "stable_time_step"), ("friction_knee", "3000000.0", "3100000.0", "events: strength"),
                ("friction_angle_beyond", "15.0", "16.0", "events: strength"), ("moment_share", "0.7", "0.9", "intact faces beyond their envelope"),
                ("residual_friction_angle", "15.0", "14.0", "broken faces beyond their friction"), ("strength_cv", "0.2", "0.21", "events: strength")):

            def what(folder, key=key, value=value, wrong=wrong):
                text = (folder / "case.toml").read_text()
                self.assertIn(f"{key} = {value} ", text)
                (folder / "case.toml").write_text(text.replace(f"{key} = {value} ", f"{key} = {wrong} "))

            with self.subTest(key=key):
                self.found(self.spoilt(what, faces_squeezed()), figure)
