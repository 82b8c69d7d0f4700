# SPDX-License-Identifier: GPL-3.0-or-later
# Shared by the two inputs of ESyS-Particle: the packed discs between four elastic walls, and the timed run.
# The walls do not move; the cost of a step does not depend on it. The time step is a tenth of ours, because ESyS-
# Particle's bonds are unstable at ours.
# Source: ESyS-Particle tutorial (rot_compress.py, bingle_Runnable.py) and the documentation in the module.
import json
import math
import os
import statistics
import sys
import time

from esys.lsm import InteractionScalarFieldSaverPrms, LsmMpi, NRotElasticWallPrms, Runnable
from esys.lsm.geometry import SimpleSphere
from esys.lsm.util import BoundingBox, Vec3

with open(sys.argv[1]) as file:
    job = json.load(file)
WALLS = {"left": (0, 1), "right": (0, -1), "bottom": (1, 1), "top": (1, -1)}  # axis and direction of the normal


def make_simulation():
    """Makes the simulation. @return simulation with discs and walls; the discs"""
    radii = [radius for _, _, radius in job["discs"]]
    left, right, bottom, top = job["box"]
    sim = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
    sim.initNeighbourSearch(particleType="RotSphere", gridSpacing=2.5 * max(radii), verletDist=0.2 * min(radii))
    margin = max(radii)
    sim.setSpatialDomain(BoundingBox(Vec3(left - margin, bottom - margin, -margin), Vec3(right + margin, top + margin, margin)))
    sim.force2dComputations(True)
    sim.setTimeStepSize(job["time_step"] / 10)
    discs = [SimpleSphere(centre=Vec3(x, y, 0), radius=radius, id=number, tag=0, mass=job["density"] * math.pi * radius**2)
             for number, (x, y, radius) in enumerate(job["discs"])]
    sim.createParticles(discs)
    for (name, (axis, sense)), place in zip(WALLS.items(), job["box"]):
        point, normal = [0, 0, 0], [0, 0, 0]
        point[axis], normal[axis] = place, sense
        sim.createWall(name=name, posn=Vec3(*point), normal=Vec3(*normal))
        sim.createInteractionGroup(NRotElasticWallPrms(name=name + "_contact", wallName=name, normalK=job["normal_stiffness"]))
    return sim, discs


def processor_seconds_of_worker():
    """Processor time of the other rank, a child of the same mpirun, which does the stepping; this rank only controls it."""
    total = 0.0
    for entry in os.listdir("/proc"):
        try:
            fields = open(f"/proc/{entry}/stat").read().rpartition(")")[2].split() if entry.isdigit() else []
        except OSError:
            continue
        if fields and int(entry) != os.getpid() and int(fields[1]) == os.getppid():
            total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


class Clock(Runnable):
    """Records the time at the start of each step."""

    def __init__(self):
        Runnable.__init__(self)
        self.times, self.processor = [], 0.0

    def run(self):
        if len(self.times) == job["warm_up"]:
            self.processor = processor_seconds_of_worker()
        self.times.append(time.perf_counter())


def run_and_report(sim, groups):
    """groups: interactions between discs; their number is the number of contacts."""
    steps, last = job["steps"], job["warm_up"] + job["steps"]
    for group in groups:
        sim.createFieldSaver(InteractionScalarFieldSaverPrms(interactionName=group, fieldName="count", fileName=group + ".count", fileFormat="SUM",
                                                             beginTimeStep=last - 1, endTimeStep=last, timeStepIncr=last - 1))
    clock = Clock()
    sim.addPreTimeStepRunnable(clock)
    sim.setNumTimeSteps(last)
    sim.run()
    end, times = time.perf_counter(), clock.times[job["warm_up"]:]
    # Each rank spins while it waits for the other. On a busy machine, this is most of the worker's time. Then a single
    # step without waiting is a better measure, if it is shorter than a time slice of the scheduler.
    worker = processor_seconds_of_worker() - clock.processor
    undisturbed = steps * statistics.median(after - before for before, after in zip(times, times[1:]))
    contacts = sum(float(open(group + ".count").read().split()[-1]) for group in groups)
    print("\nRESULT " + json.dumps({"version": sim.getLsmVersion(), "steps": steps, "seconds": end - times[0],
                                    "processor_seconds": min(worker, undisturbed), "contacts": contacts}), flush=True)
