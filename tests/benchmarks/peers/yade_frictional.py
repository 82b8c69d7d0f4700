# SPDX-License-Identifier: GPL-3.0-or-later
# YADE, frictional discs held by four walls as packed, nothing bonded: linear springs, Coulomb limit. Run by compare_peers:
#   yade -n -x -j1 yade_frictional.py JOB.json
# The walls do not move; the cost of a step does not depend on it.
# Source: YADE's documentation, class reference: Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack.
import math

from yade import *
from yade import utils
from yade_discs import add_discs, bottom, job, left, report, right, run_timed, top

rock = O.materials.append(FrictMat(density=job["density"], frictionAngle=math.atan(job["friction"])))
add_discs(lambda radius: rock)
for axis, places in ((0, (left, right)), (1, (bottom, top))):
    for place in places:
        O.bodies.append(utils.wall((place, place, 0), axis=axis, material=rock))


def everywhere(value):
    return MatchMaker(algo="val", val=value)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=everywhere(job["normal_stiffness"]), ks=everywhere(job["shear_stiffness"]))],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.2),
]
O.dt = job["time_step"]
O.step()
report(run_timed())
