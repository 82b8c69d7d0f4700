# SPDX-License-Identifier: GPL-3.0-or-later
# What YADE's two inputs share: discs as spheres that stay in their plane, with the mass and inertia of discs of unit thickness, and the timed run.
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
    """`material` gives the index of one for a radius. Velocities as of a block between platens that close by this length a step: loading sends no shock."""
    for x, y, radius in job["discs"]:
        state = O.bodies[O.bodies.append(utils.sphere((x, y, 0), radius, material=material(radius)))].state
        state.mass = job["density"] * math.pi * radius**2
        state.inertia = (state.mass * radius**2 / 2,) * 3
        state.blockedDOFs = "zXY"
        state.vel = (0, -strain_a_step / job["time_step"] * (y - bottom), 0)


def run_timed():
    """What compare_peers reads, without what only the model knows."""
    if job["warm_up"]:  # to O.run, 0 means without end
        O.run(job["warm_up"], wait=True)
    begin, start, processor = O.iter, time.perf_counter(), time.process_time()
    O.run(job["steps"], wait=True)
    seconds, processor = time.perf_counter() - start, time.process_time() - processor
    return {"version": yade.config.version, "steps": O.iter - begin, "seconds": seconds, "processor_seconds": processor,
            "contacts": O.interactions.countReal()}


def report(result):
    print("\nRESULT " + json.dumps(result), flush=True)
