# SPDX-License-Identifier: GPL-3.0-or-later
# Shared by the two inputs of YADE: discs as spheres that stay in their plane, with the mass and inertia of discs of
# unit thickness, and the timed run.
import json
import math
import sys
import time

import yade.config
from yade import O, utils

with open(sys.argv[1]) as file:
    job = json.load(file)
left, right, bottom, top = job["box"]


def add_discs(material, strain_a_step=0.0):
    """material: returns the material's index for a radius. Initial velocities are those of a block between platens that close by this
    length per step, so loading causes no shock."""
    for x, y, radius in job["discs"]:
        state = O.bodies[O.bodies.append(utils.sphere((x, y, 0), radius, material=material(radius)))].state
        state.mass = job["density"] * math.pi * radius**2
        state.inertia = (state.mass * radius**2 / 2,) * 3
        state.blockedDOFs = "zXY"
        state.vel = (0, -strain_a_step / job["time_step"] * (y - bottom), 0)


def run_timed():
    """The results that compare_peers reads, except those of the model."""
    if job["warm_up"]:  # O.run takes 0 steps as no limit
        O.run(job["warm_up"], wait=True)
    begin, start, processor = O.iter, time.perf_counter(), time.process_time()
    O.run(job["steps"], wait=True)
    seconds, processor = time.perf_counter() - start, time.process_time() - processor
    return {"version": yade.config.version, "steps": O.iter - begin, "seconds": seconds, "processor_seconds": processor,
            "contacts": O.interactions.countReal()}


def report(result):
    print("\nRESULT " + json.dumps(result), flush=True)
