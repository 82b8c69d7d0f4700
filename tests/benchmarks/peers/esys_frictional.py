# SPDX-License-Identifier: GPL-3.0-or-later
# ESyS-Particle, frictional discs, nothing bonded: linear springs, Coulomb limit, rolling free. Run by compare_peers:
#   mpirun -np 2 esysparticle esys_frictional.py JOB.json
# Source: the documentation in the module: RotFrictionPrms.
from esys.lsm import RotFrictionPrms
from esys_discs import job, make_simulation, run_and_report

sim, _ = make_simulation()
sim.createInteractionGroup(RotFrictionPrms(name="friction", normalK=job["normal_stiffness"], dynamicMu=job["friction"], staticMu=job["friction"],
                                           shearK=job["shear_stiffness"], scaling=False))
run_and_report(sim, ["friction"])
