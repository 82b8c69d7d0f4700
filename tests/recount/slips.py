# SPDX-License-Identifier: GPL-3.0-or-later
"""First slips of bonded points, if the test wrote slips.csv; `r`, `model` and `bonds` as in frames.py."""

import math

import numpy as np

from model import rounding


def recount_slips(r, model, bonds):
    """Compares the rows with the curve, and each with one bond, whose limit is friction times the sum of normal force and back-tension."""
    rows, c = r.results.slips, r.curve
    if rows is None:
        return
    count = len(rows["step"])
    r.rows("curve: bonds_slid of slips", c["bonds_slid"], np.searchsorted(rows["step"], c["step"], side="right"), 0)
    if not count:
        return
    r.true("slips: in the order of steps", np.all(np.diff(rows["step"]) >= 0))
    left = {}
    for k in np.flatnonzero(~bonds.held):
        left.setdefault(frozenset((model.ids[bonds.i[k]], model.ids[bonds.j[k]])), []).append(k)
    friction, tension = model.friction(bonds), model.normal_stiffness(bonds) * bonds.overlap
    limits = []
    for a, b, normal, shear in zip(rows["body_i"], rows["body_j"], rows["normal_force"], np.abs(rows["shear_force"])):
        own = left.get(frozenset((int(a), int(b))), [])
        found = [(abs(friction[m] * (tension[m] + normal) - shear), m) for m in own]
        if not found:
            limits.append(math.nan)
            continue
        m = min(found)[1]
        own.remove(m)
        limits.append(friction[m] * (tension[m] + normal))
    r.rows("slips: shear force at the limit", np.abs(rows["shear_force"]), limits, rounding * tension.mean())
