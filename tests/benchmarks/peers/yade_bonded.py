# SPDX-License-Identifier: GPL-3.0-or-later
# YADE, bonded discs squeezed between two bonded platens: JCFpm, its jointed cohesive frictional particle model. Run by compare_peers:
#   yade -n -x -j1 yade_bonded.py JOB.json
# A contact of the packing with the overlap d0 becomes a bond, free of force at its initial distance, as our back-
# tension bond. It has k_n, k_s, tensile strength k_n d0 and shear strength mu (k_n d0 + f_n). Differences: a JCFpm bond
# breaks under shear where ours slides; local damping of 0.2 replaces dashpots.
# With "stop_below" in the job, the run ends when the stress has fallen below this share of its peak; it is checked every "look_every" steps.
# Source: YADE's documentation, class reference: JCFpmMat, JCFpmPhys, Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM.
import math

from yade import *
from yade import utils
from yade_discs import add_discs, bottom, job, left, report, right, run_timed, top

stiffness, shear, friction = job["normal_stiffness"], job["shear_stiffness"], job["friction"]


def material(radius):
    # The stiffness of a contact is the harmonic mean of modulus times radius; with these moduli, new contacts have k_n
    # too. The strengths hold until each bond gets its own below.
    return O.materials.append(JCFpmMat(type=1, young=stiffness / radius, poisson=shear / stiffness, density=job["density"],
                                       frictionAngle=math.atan(friction), tensileStrength=1e30, cohesion=1e30))


add_discs(material, job["strain_a_step"])
mean_radius = sum(radius for _, _, radius in job["discs"]) / len(job["discs"])
lower, upper = (O.bodies.append(utils.wall((0, y, 0), axis=1, material=material(mean_radius))) for y in (bottom, top))
O.bodies[upper].state.vel = (0, -job["strain_a_step"] / job["time_step"] * (top - bottom), 0)

law = Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)], [law]),
    NewtonIntegrator(damping=0.2),
]
O.dt = job["time_step"]
O.step()
bonds = [contact.phys for contact in O.interactions if contact.phys.isCohesive]
for bond in bonds:
    bond.kn, bond.ks = stiffness, shear
    bond.FnMax, bond.FsMax = stiffness * bond.initD, friction * stiffness * bond.initD

peak = 0.0


def look():
    global peak
    stress = (O.forces.f(upper)[1] - O.forces.f(lower)[1]) / 2 / (right - left)
    peak = max(peak, stress)
    if stress < job["stop_below"] * peak:
        O.pause()


if "stop_below" in job:
    O.engines += [PyRunner(iterPeriod=job["look_every"], command="look()")]
result = run_timed()
report(result | {"bonds": len(bonds), "broken": law.nbTensCracks + law.nbShearCracks, "peak_stress": peak})
