# SPDX-License-Identifier: GPL-3.0-or-later
# What ESyS-Particle's two inputs share: the discs between four elastic walls as packed, and the timed run.
# Nothing moves the walls: at rest a step costs the same. The time step is a tenth of ours, at which the bonds of ESyS-Particle are not stable.
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
WALLS = {"left": (0, 1), "right": (0, -1), "bottom": (1, 1), "top": (1, -1)}  # axis and sense of the normal


def make_simulation():
    """The simulation with its discs and walls; the discs."""
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
    """Seconds of the other rank, a child of the same mpirun: it does the stepping, this one gives the orders."""
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
    """Reads the time at the start of each step."""

    def __init__(self):
        Runnable.__init__(self)
        self.times, self.processor = [], 0.0

    def run(self):
        if len(self.times) == job["warm_up"]:
            self.processor = processor_seconds_of_worker()
        self.times.append(time.perf_counter())


def run_and_report(sim, groups):
    """`groups`: interactions between discs, whose numbers are the contacts."""
    steps, last = job["steps"], job["warm_up"] + job["steps"]
    for group in groups:
        sim.createFieldSaver(InteractionScalarFieldSaverPrms(interactionName=group, fieldName="count", fileName=group + ".count", fileFormat="SUM",
                                                             beginTimeStep=last - 1, endTimeStep=last, timeStepIncr=last - 1))
    clock = Clock()
    sim.addPreTimeStepRunnable(clock)
    sim.setNumTimeSteps(last)
    sim.run()
    end, times = time.perf_counter(), clock.times[job["warm_up"]:]
    # Either rank spins while it waits for the other. Where others have the processors, that is most of the worker's time. A
    # step without such a wait is then the better measure, if it is shorter than a turn of the scheduler.
    worker = processor_seconds_of_worker() - clock.processor
    undisturbed = steps * statistics.median(after - before for before, after in zip(times, times[1:]))
    contacts = sum(float(open(group + ".count").read().split()[-1]) for group in groups)
    print("\nRESULT " + json.dumps({"version": sim.getLsmVersion(), "steps": steps, "seconds": end - times[0],
                                    "processor_seconds": min(worker, undisturbed), "contacts": contacts}), flush=True)
