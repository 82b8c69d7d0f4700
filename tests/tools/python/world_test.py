#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests worlds that Python steps: the same motion as in the program, arrays that view the engine's memory, changes of bonds and laws
between steps, and errors instead of crashes."""
import gc
import subprocess
import sys
import threading
import time
import unittest
from pathlib import Path

import numpy

import crackle
from small import CASE, InScratch, small


class Worlds(InScratch):
    def test_stepping_in_calls_is_stepping_at_once(self):
        one, other = crackle.World(CASE), crackle.World(CASE)
        one.step(5000)
        for _ in range(50):
            views = other.bodies, other.pairs, other.shear_forces  # kept while the world steps
            other.step(100)
        self.assertEqual(one.state_hash(), other.state_hash())
        self.assertEqual((one.steps, other.steps), (5000, 5000))
        self.assertGreater(views[0]["y"].sum(), 0.0)

    def test_a_world_moves_as_the_programs_test(self):
        seen = {}

        def look(state):
            seen[state.steps] = (state.state_hash(), state.row()["axial_stress"])
        crackle.test(CASE, every=500, call=look)
        world = crackle.World(CASE)
        for step in sorted(seen)[:8]:
            world.step(step - world.steps)
            self.assertEqual(world.row()["axial_stress"], seen[step][1])
        self.assertGreater(len(seen), 8)

    def test_own_loading_follows_the_modulus(self):
        world = crackle.World(CASE)
        linear = crackle.elastic(CASE)
        target = 0.5 * linear["first_slip"]["strain"]  # below the strain of the first slip, the linear solution is exact
        world.platen_speed = 5e-5 * target * world.length / world.time_step
        while world.axial_strain < target:
            world.step(100)
        world.platen_speed = 0.0
        world.step(100_000)  # comes to rest, except for unbonded particles
        row = world.row()
        self.assertEqual((row["bonds_slid"], row["bonds_broken"]), (0, 0))
        self.assertAlmostEqual(row["axial_stress"] / (linear["youngs_modulus"] * row["axial_strain"]), 1.0, delta=1e-3)

    def test_threads_change_nothing(self):
        one, other = crackle.World(CASE), crackle.World(CASE, threads=2)
        one.step(3000)
        other.step(1000)
        other.threads = 1
        other.step(2000)
        self.assertEqual(one.state_hash(), other.state_hash())

    def test_events_are_the_programs(self):
        result = crackle.test(CASE, "out")
        world = crackle.World(CASE)
        while len(world.events) < len(result.events.step):
            world.step(1000)
        events = world.events[:len(result.events.step)]
        numpy.testing.assert_array_equal(events["step"], result.events.step)
        numpy.testing.assert_array_equal(events["position"]["x"], result.events.x)


class Arrays(InScratch):
    def test_views_are_the_engines_memory(self):
        world = crackle.World(CASE)
        one, other = world.bodies, world.bodies
        self.assertEqual(one.__array_interface__["data"][0], other.__array_interface__["data"][0])
        self.assertFalse(one.flags.owndata)
        self.assertEqual(one.dtype.itemsize, 64)
        self.assertEqual(one.dtype.names, ("x", "y", "vx", "vy", "omega", "shape", "angle"))

    def test_views_are_read_only(self):
        world = crackle.World(CASE)
        for array in (world.bodies, world.names, world.masses, world.forces, world.bonds, world.pairs, world.laws,
                      world.shear_forces, world.bond_overlaps):
            with self.assertRaises(ValueError):
                array[0] = array[0]

    def test_a_view_outlives_its_world(self):
        world = crackle.World(CASE)
        view, copy = world.bodies, world.bodies.copy()
        world.step(100)
        late = world.bodies
        late_copy = late.copy()
        del world
        gc.collect()
        numpy.zeros(10**6)  # reuses freed memory
        self.assertEqual(view.tobytes(), copy.tobytes())
        self.assertEqual(late.tobytes(), late_copy.tobytes())
        self.assertNotEqual(view.tobytes(), late.tobytes())

    def test_a_second_view_outlives_the_first(self):
        world = crackle.World(CASE)
        first, second = world.bodies, world.bodies
        copy = first.copy()
        world.step(10)
        del first
        gc.collect()
        self.assertEqual(second.tobytes(), copy.tobytes())

    def test_views_of_results_and_particles_outlive_them(self):
        result = crackle.test(CASE)
        stress, events = result.curve.axial_stress, result.events.energy
        sums = stress.sum(), events.sum()
        particles = crackle.pack(count=100, radius_min=0.01, radius_max=0.02, mean_overlap=1e-5)
        circles, copy = particles.circles, particles.circles.copy()
        del result, particles
        gc.collect()
        self.assertEqual((stress.sum(), events.sum()), sums)
        self.assertEqual(circles.tobytes(), copy.tobytes())

    def test_forces_balance_inside(self):
        world = crackle.World(CASE)
        world.step(500)
        inner = world.masses["inverse_mass_x"] > 0.0
        forces = world.forces
        total = numpy.array([forces["fx"][inner].sum(), forces["fy"][inner].sum()])
        driven = numpy.array([forces["fx"][~inner].sum(), forces["fy"][~inner].sum()])
        scale = numpy.abs(world.contacts()["normal_force"]).sum()
        self.assertLess(numpy.abs(total + driven).max(), 1e-12 * scale)  # forces cancel, except for rounding

    def test_contacts_are_those_of_the_world(self):
        world = crackle.World(CASE)
        contacts = world.contacts()
        self.assertEqual(contacts["bonded"].sum(), world.bonds_initial)
        normals = contacts["normal"]
        numpy.testing.assert_allclose(numpy.hypot(normals["x"], normals["y"]), 1.0, atol=1e-12)
        names, bodies = world.names, world.bodies
        numpy.testing.assert_array_equal(names["id"][contacts["body_i"]], contacts["id_i"])
        between = contacts["id_j"] > 0
        radii = bodies["shape"][:, 0]
        circles = between & (radii[contacts["body_i"]] > 0) & ~numpy.isin(contacts["id_j"], world.platens) \
            & ~numpy.isin(contacts["id_i"], world.platens)
        i, j = contacts["body_i"][circles], contacts["body_j"][circles]
        apart = numpy.hypot(bodies["x"][j] - bodies["x"][i], bodies["y"][j] - bodies["y"][i])
        numpy.testing.assert_allclose(radii[i] + radii[j] - apart, contacts["overlap"][circles], atol=1e-14)
        # The contact point is halfway between both surfaces, half the overlap inside the surface of i.
        way = radii[i] - 0.5 * contacts["overlap"][circles]
        for axis in ("x", "y"):
            numpy.testing.assert_allclose(contacts["position"][axis][circles], bodies[axis][i] + way * normals[axis][circles],
                                          atol=1e-12)
            numpy.testing.assert_allclose(normals[axis][circles] * apart, bodies[axis][j] - bodies[axis][i], atol=1e-14)
        numpy.testing.assert_array_equal(names["id"][contacts["body_j"]][between], contacts["id_j"][between])
        self.assertEqual(world.index(int(names["id"][3])), 3)

    def test_a_state_has_the_numbers_of_its_case(self):
        summary = crackle.test(CASE).summary
        world = crackle.World(CASE)
        top, before = world.index(world.platens[-1]), world.bodies.copy()
        world.step(2000)
        self.assertEqual((world.section, world.length), (summary["initial_width"], summary["initial_height"]))
        self.assertEqual(world.platens, [summary["platen_bottom_id"], summary["platen_top_id"]])
        self.assertEqual((world.bonds_initial, world.bonds_broken), (summary["bonds_initial"], world.row()["bonds_broken"]))
        rate = CASE["loading"]["axial_strain_rate"]
        self.assertAlmostEqual(world.platen_speed / (rate * world.length), 1.0, delta=1e-12)
        self.assertAlmostEqual(world.axial_strain / (rate * world.time), 1.0, delta=1e-9)
        self.assertAlmostEqual((world.bodies["y"][top] - before["y"][top]) / (world.axial_strain * world.length), 1.0, delta=1e-6)
        self.assertAlmostEqual(world.time / (2000 * world.time_step), 1.0, delta=0.05)  # the time step follows its bound
        self.assertAlmostEqual(world.forces["fy"][top] / (-world.row()["stress_top"] * world.section), 1.0, delta=1e-12)
        discs = ~numpy.isin(world.names["id"], world.platens)
        radius = world.bodies["shape"][discs, 0]
        numpy.testing.assert_allclose(world.masses["mass"][discs], 2500.0 * numpy.pi * radius ** 2, rtol=1e-12)

    def test_contacts_have_what_the_points_have(self):
        world = crackle.World(small(loading={"kind": "compression", "axial_strain_rate": 0.02}))
        world.step(6000)
        contacts = world.contacts()
        points = {(int(pair["body_i"]), int(pair["body_j"])): k for k, pair in enumerate(world.pairs)}
        at = numpy.array([points[int(one["body_i"]), int(one["body_j"])] for one in contacts])
        flags = world.bonds["flags"][at]
        for name, flag in (("touching", 1), ("bonded", 2), ("sliding", 4)):
            numpy.testing.assert_array_equal(contacts[name], (flags & flag) != 0, name)
        numpy.testing.assert_array_equal(contacts["bond_overlap"], world.bond_overlaps[at])
        bonded = contacts[contacts["bonded"]]
        self.assertTrue((bonded["bond_overlap"] != bonded["overlap"]).any(), "bodies have moved")
        # A body's force is the sum over its points of the forces of springs and back-tension; positive shear is along
        # the normal turned left by 90 degrees.
        normal, shear = contacts["normal_force"], contacts["shear_force"]
        nx, ny = contacts["normal"]["x"], contacts["normal"]["y"]
        self.assertGreater(numpy.abs(shear).sum(), 0.05 * numpy.abs(normal).sum())
        numpy.testing.assert_allclose(shear, world.shear_forces[at], atol=1e-3 * numpy.abs(shear).max())
        stiffness = float(world.laws["normal_stiffness"][0])
        circles = bonded[~numpy.isin(bonded["id_i"], world.platens) & ~numpy.isin(bonded["id_j"], world.platens)]
        numpy.testing.assert_allclose(circles["normal_force"], stiffness * (circles["overlap"] - circles["bond_overlap"]),
                                      atol=1e-2 * numpy.abs(circles["normal_force"]).max())

    def test_the_first_arrays_of_several_threads(self):
        # The first array imports numpy, which releases the interpreter's lock.
        done = subprocess.run([sys.executable, "-c", f"""
import sys, threading
sys.path.insert(0, {str(Path(__file__).parent)!r})
import crackle
from small import CASE
worlds = [crackle.World(CASE) for _ in range(4)]
all_there = threading.Barrier(len(worlds))
def look(world):
    all_there.wait()
    world.bodies
    world.row()
assert "numpy" not in sys.modules
threads = [threading.Thread(target=look, args=(world,)) for world in worlds]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print("looked")
"""], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (0, "looked\n"), done.stderr)


class Faces(InScratch):
    def test_faces_add_up_to_the_force_on_each_grain(self):
        world = crackle.World({
            "packing": {"width": 0.02, "height": 0.03, "radius_min": 1e-3, "radius_max": 1.5e-3, "mean_overlap": 1e-6},
            "mesh": {"kind": "voronoi"},
            "material": {"density": 2600.0, "units": "area", "youngs_modulus": 70e9, "poissons_ratio": 0.25, "stiffness_ratio": 1.6,
                         "friction_angle": 40.0, "tensile_strength": 10e6, "cohesion": 40e6, "damping_ratio": 0.0},
            "bond": {"law": "face"},
            "loading": {"kind": "tension", "axial_strain_rate": 1.0, "max_axial_strain": 0.01}})
        self.assertEqual(len(world.contacts()), 0)
        world.platen_speed = 20.0  # m/s, of which some faces break
        while world.bonds_broken < 5:
            world.step(100)
        faces, bodies = world.faces(), world.bodies
        self.assertEqual(len(faces), world.bonds_initial)
        self.assertEqual((~faces["bonded"]).sum(), world.bonds_broken)
        normal = numpy.stack([faces["normal"]["x"], faces["normal"]["y"]], axis=1)
        force = faces["shear_force"][:, None] * normal[:, ::-1] * [-1, 1] - faces["normal_force"][:, None] * normal
        arm = numpy.stack([faces["position"]["x"], faces["position"]["y"]], axis=1)
        total, torque = numpy.zeros((len(bodies), 2)), numpy.zeros(len(bodies))
        for body, sign in ((faces["body_i"], 1), (faces["body_j"], -1)):
            numpy.add.at(total, body, sign * force)
            away = arm - numpy.stack([bodies["x"][body], bodies["y"][body]], axis=1)
            numpy.add.at(torque, body, sign * (away[:, 0] * force[:, 1] - away[:, 1] * force[:, 0] + faces["moment"]))
        largest = numpy.abs(force).max()
        self.assertGreater(largest, 1e3)
        for got, expected, scale in ((total[:, 0], world.forces["fx"], 1.0), (total[:, 1], world.forces["fy"], 1.0),
                                     (torque, world.forces["torque"], 0.02)):
            self.assertLess(numpy.abs(got - expected).max() / scale / largest, 1e-9)

    def test_a_world_of_discs_has_no_faces(self):
        self.assertEqual(len(crackle.World(CASE).faces()), 0)


class Changes(InScratch):
    def unbonded(self):
        """@return world of a packing, ids of the two discs with the largest overlap, their contact"""
        particles = crackle.pack(count=40, radius_min=0.01, radius_max=0.02, mean_overlap=1e-4)
        world = crackle.World(particles, walls=False)
        contacts = world.contacts()
        deepest = contacts[numpy.argmax(contacts["overlap"])]
        i, j = int(deepest["id_i"]), int(deepest["id_j"])
        return world, i, j, deepest

    def all_pairs(self, world):
        ids = sorted(int(one) for one in world.names["id"])
        return [(a, b) for a in ids for b in ids if a < b]

    def test_an_added_bond_holds_and_breaks_at_its_back_tension(self):
        world, i, j, contact = self.unbonded()
        self.assertEqual(world.add_bond(i, j), 1)
        self.assertEqual(world.add_bond(i, j), 0, "the pair is already bonded")
        self.assertEqual((world.bonds_initial, world.bonds_broken), (1, 0))
        bonded = world.contacts()
        bonded = bonded[bonded["bonded"]][0]
        self.assertEqual(bonded["normal_force"], 0.0)
        self.assertEqual(bonded["bond_overlap"], contact["overlap"])
        # All other bodies are fixed, and j is pulled along the normal with a small displacement per step.
        for body in world.names["id"]:
            world.drive(int(body), 0.0, 0.0)  # may rotate
        nx, ny = float(bonded["normal"]["x"]), float(bonded["normal"]["y"])
        speed = 1e-4 * bonded["overlap"] / world.time_step
        world.drive(j, speed * nx, speed * ny)
        world.step(9_990)
        self.assertEqual(len(world.events), 0)
        pull = world.contacts()
        pull = pull[pull["bonded"]][0]["normal_force"]
        stiffness = float(world.laws["normal_stiffness"][0])
        # Back-tension: f = -k (δ0 - δ); the bond breaks at δ = 0, with a force of k δ0.
        self.assertAlmostEqual(pull / (-stiffness * 0.999 * contact["overlap"]), 1.0, delta=2e-4)
        world.step(20)
        self.assertEqual(len(world.events), 1)
        self.assertAlmostEqual(world.events["strength"][0], stiffness * contact["overlap"], delta=1e-9)
        self.assertEqual({world.events["body_i"][0], world.events["body_j"][0]}, {i, j})

    def test_a_bond_as_strong_as_it_overlaps_spans_no_gap(self):
        world, *_ = self.unbonded()
        touching = len(world.contacts())
        with self.assertRaises(crackle.InputError) as refused:
            world.add_bonds(self.all_pairs(world), gap=2e-3)
        self.assertEqual(refused.exception.key, "gap")
        self.assertIn('bond.law = "coulomb"', refused.exception.remedy)
        self.assertEqual(world.bonds_initial, 0)
        self.assertEqual(world.add_bonds(self.all_pairs(world)), touching)
        world.step(1)
        self.assertEqual(world.bonds_broken, 0)

    def test_a_gap_is_bonded_where_it_is_asked_for(self):
        world = crackle.World(small(material={"units": "area", "normal_stiffness": None, "shear_stiffness": None,
                                              "contact_modulus": 2e10, "stiffness_ratio": 2.5, "tensile_strength": 1e7,
                                              "cohesion": 5e7}, bond={"law": "coulomb"}))
        before = world.bonds_initial
        added = world.add_bonds(self.all_pairs(world), gap=2e-3)
        self.assertGreater(added, 0)
        self.assertEqual(world.bonds_initial, before + added)
        self.assertLess(world.contacts()["bond_overlap"].min(), 0.0)
        world.step(1)
        self.assertEqual(world.bonds_broken, 0)

    def test_a_stiffer_law_makes_a_shorter_step(self):
        world = crackle.World(CASE)
        before, energy = world.time_step, world.bonds_initial
        world.set_property("normal_stiffness", 4.0e7)
        self.assertEqual(world.laws["normal_stiffness"][0], 4.0e7)
        # All normal springs become four times as stiff, which reduces the time step to half at most.
        self.assertLess(world.time_step, 0.75 * before)
        self.assertGreaterEqual(world.time_step, 0.5 * before)
        self.assertEqual(world.bonds_initial, energy)
        world.step(1000)
        world.set_property("friction_angle", 10.0)
        self.assertAlmostEqual(world.laws["friction"][0], numpy.tan(numpy.radians(10.0)), delta=1e-15)

    def test_a_stiffer_world_is_that_of_a_stiffer_case(self):
        stiff = small(material={"normal_stiffness": 2.0e7, "shear_stiffness": 5.0e6})
        world = crackle.World(CASE)
        world.set_property("normal_stiffness", 2.0e7)
        world.set_property("shear_stiffness", 5.0e6)
        other = crackle.World(stiff)
        for name in ("normal_stiffness", "shear_stiffness", "friction"):
            self.assertEqual(world.laws[name][0], other.laws[name][0], name)
        numpy.testing.assert_allclose(world.laws["normal_damping_ratio_term"][0],
                                      other.laws["normal_damping_ratio_term"][0], rtol=1e-15)
        numpy.testing.assert_allclose(world.time_step, other.time_step, rtol=1e-9)

    def test_what_cannot_be_changed(self):
        world = crackle.World(CASE)
        for wrong, words in ((("stiffness", 1.0), "expected one of normal_stiffness"),
                             (("normal_stiffness", 0.0), "> 0"), (("normal_stiffness", float("nan")), "found nan"),
                             (("friction_angle", 90.0), "< 90"), (("cohesion", 1e3), 'expected bond.law = "coulomb"'),
                             (("normal_stiffness", 1e7, (1, 9)), "materials 1 and 9"),
                             (("normal_stiffness", 1e7, (0, 1)), "materials 0 and 1")):
            with self.assertRaises(crackle.InputError, msg=wrong) as refused:
                world.set_property(*wrong)
            self.assertIn(words, str(refused.exception))
        hash_before = world.state_hash()
        for wrong in (lambda: world.add_bond(10**6, 1), lambda: world.add_bond(1, 1), lambda: world.drive(10**6, 0.0),
                      lambda: world.drive(1, float("inf")), lambda: world.drive(1, ("push", 1.0)),
                      lambda: world.step(-1),
                      lambda: world.add_bonds([(1, 2)], gap=-1.0), lambda: world.index(-7),
                      lambda: setattr(world, "threads", 0), lambda: setattr(world, "platen_speed", float("nan"))):
            with self.assertRaises(crackle.InputError):
                wrong()
        for wrong in (lambda: world.step("many"), lambda: world.drive("top"), lambda: world.step(1.5)):
            with self.assertRaises(TypeError):
                wrong()
        self.assertEqual(world.state_hash(), hash_before)

    def test_a_drive_that_is_none_is_named(self):
        world = crackle.World(CASE)
        before = world.state_hash()
        for wrong in (["push", 1.0], ["force"], ("force", "much"), "fast", (1, 2), {}, ("force", float("nan"))):
            with self.assertRaises(crackle.InputError, msg=wrong) as refused:
                world.drive(1, 0.0, wrong)
            self.assertEqual((refused.exception.key, refused.exception.found), ("y", repr(wrong)))
        self.assertEqual(world.state_hash(), before)
        world.drive(1, ["force", 1.0], ("force", 2.0), None)

    def test_notices_of_the_specimen_are_there(self):
        world = crackle.World(CASE)
        self.assertEqual(repr(world), "<crackle.World: 62 bodies, 0 of 97 bonds broken, 0 steps>")
        self.assertEqual(len(world.notices), 1)
        self.assertIn("inertia and dashpots carry part of the stress", world.notices[0])
        world.platen_speed = 0.5 * world.platen_speed
        self.assertIn("since a strain of 0", world.notices[-1])

    def test_particles_have_no_platens(self):
        world, *_ = self.unbonded()
        for use in (lambda: world.platen_speed, lambda: world.row(), lambda: world.axial_strain, lambda: world.platens):
            with self.assertRaises(crackle.InputError) as refused:
                use()
            self.assertIn("without platens", str(refused.exception))

    def test_a_platen_that_is_not_driven_at_a_speed_takes_none(self):
        world = crackle.World(CASE)
        speed, platen = world.platen_speed, world.platens[-1]
        for drive in (None, ("force", 0.0)):
            world.drive(platen, 0.0, drive, 0.0)
            with self.assertRaises(crackle.InputError) as refused:
                world.platen_speed = speed
            self.assertIn("driven at a given velocity", str(refused.exception))
        world.drive(platen, 0.0, 0.0, 0.0)
        world.platen_speed = speed
        self.assertEqual(world.platen_speed, speed)

    def test_a_world_has_no_test_to_stop(self):
        with self.assertRaises(crackle.InputError) as refused:
            crackle.World(CASE).stop()
        self.assertEqual(refused.exception.key, "stop")

    def test_a_world_that_goes_wrong_says_so(self):
        world = crackle.World(CASE)
        world.drive(int(world.names["id"][10]), ("force", 1e9))
        with self.assertRaises(crackle.UnstableRun) as unstable:
            world.step(100_000)
        self.assertGreater(unstable.exception.step, 0)
        self.assertEqual(unstable.exception.body, world.names["id"][10])
        self.assertEqual(len(world.bodies), 62)  # the bodies can still be read

    def test_two_threads_on_one_world(self):
        world = crackle.World(small(packing={"count": 300}))
        thread = threading.Thread(target=lambda: world.step(20_000))
        thread.start()
        refused = 0
        while thread.is_alive():
            try:
                world.bodies
            except RuntimeError as error:
                self.assertIn("another thread is stepping", str(error))
                self.assertIn("crackle.World: ", repr(world))
                refused += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(refused, 0)
        self.assertEqual(world.steps, 20_000)


if __name__ == "__main__":
    unittest.main()
