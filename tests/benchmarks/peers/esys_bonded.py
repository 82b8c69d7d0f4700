# SPDX-License-Identifier: GPL-3.0-or-later
# ESyS-Particle, bonded discs: rotational elastic-brittle bonds, and friction after they break. Run by compare_peers:
#   mpirun -np 2 esysparticle esys_bonded.py JOB.json
# Touching discs are bonded with k_n and k_s, without stiffness in bending and torsion. Such a bond is free of force
# when the discs just touch, not at their initial distance, so walls hold the packing's pressure. All bonds have the
# same strength, which is never reached.
# Source: ESyS-Particle tutorial (rot_compress.py) and the documentation in the module: RotBondPrms, RotFrictionPrms.
from esys.lsm import RotBondPrms, RotFrictionPrms
from esys.lsm.geometry import ConnectionFinder
from esys_discs import job, make_simulation, run_and_report

sim, discs = make_simulation()
stiffness, shear, friction = job["normal_stiffness"], job["shear_stiffness"], job["friction"]
strength = stiffness * 0.01 * min(radius for _, _, radius in job["discs"])  # force of an overlap of a hundredth of the smallest radius
sim.createConnections(ConnectionFinder(maxDist=0.0, bondTag=1, pList=discs))
sim.createInteractionGroup(RotBondPrms(name="bonds", normalK=stiffness, shearK=shear, torsionK=0.0, bendingK=0.0, normalBrkForce=strength,
                                       shearBrkForce=friction * strength, torsionBrkForce=1.0, bendingBrkForce=1.0, tag=1, scaling=False))
sim.createInteractionGroup(RotFrictionPrms(name="friction", normalK=stiffness, dynamicMu=friction, staticMu=friction, shearK=shear, scaling=False))
sim.createExclusion("bonds", "friction")
run_and_report(sim, ["bonds", "friction"])
