# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whose platen reverses (specimens/setup/METHODS.md): travelled strain, first loading, figures of cycles."""

import math

import numpy as np

unload_to = 0.1  # fraction of the stress at which unloading begins, if loading.unload_to is not given
creep = 0.05  # fraction of the largest rate
failing = 0.005  # share of the bonds; if more break during an unloading, the specimen failed and has no modulus


def unloads(results):
    return any(results.key("loading", name) is not None for name in ("unload_at_strain", "unload_at_stress"))


def turns_round(results):
    return unloads(results) or results.key("loading", "control") == "lateral"


def first_loading(results, strain):
    """Rows whose strain is larger than in all earlier rows; all rows if the test is not unloaded."""
    if not unloads(results):
        return np.arange(len(strain))
    farthest = np.maximum.accumulate(np.concatenate([[-math.inf], strain[:-1]]))
    return np.flatnonzero(strain > farthest)


def travel(results, strain):
    """Strain travelled back and forth up to each row, and the most that reversals between rows can add to it."""
    steps = np.diff(strain, prepend=strain[0])
    turns = int(np.sum(steps[1:] * steps[:-1] < 0)) if turns_round(results) else 0
    return np.cumsum(np.abs(steps)), 2 * turns * np.abs(steps).max()


def first_share(results, limit, first, transit, modulus):
    """Share of the largest rate at which a test begins if its first reversal is near. @param first  strain at which bonds yield"""
    if not unloads(results):
        return 1.0
    at = results.key("loading", "unload_at_strain")
    way = at[0] if at else results.key("loading", "unload_at_stress")[0] / modulus
    acceleration = 2 * results.key("loading", "rate_tolerance") * first / transit**2
    return min(1.0, max(creep, math.sqrt(1.4 * acceleration * way) / limit))


def recount_cycles(r):
    """Figures of each unloading and reloading, from all rows."""
    if not unloads(r.results):
        return
    c = r.curve
    strain, stress = c["axial_strain"], c["axial_stress"]
    found, turn = [], 0
    while turn + 1 < len(strain):
        if strain[turn + 1] >= strain[turn]:
            turn += 1
            continue
        stop = turn + 1
        while stop + 1 < len(strain) and strain[stop + 1] <= strain[stop]:
            stop += 1
        while stop + 1 < len(strain) and strain[stop + 1] >= strain[stop] and strain[stop] <= strain[turn]:
            stop += 1
        found.append((turn, stop))
        turn = stop
    r.compare("cycles: as many as the platen turns back", len(r.summary["cycles"]), len(found), 0)
    sense = -1.0 if r.summary["kind"] == "tension" else 1.0
    whole = r.summary.get("youngs_modulus") or r.summary.get("nominal_modulus") or math.nan
    size = 1.0
    for name in ("stress_section", "strain_length") if not r.uniaxial else ("initial_width", "initial_height"):
        size *= r.summary[name]
    for k, (turn, stop) in enumerate(found[: len(r.summary["cycles"])]):
        label, rows = f"cycles[{k}].", slice(turn, stop + 1)
        low = turn + int(np.argmin(strain[rows]))
        way, drop = strain[turn] - strain[low], stress[turn] - stress[low]
        modulus, stated = drop / way, r.summary["cycles"][k]["modulus"]
        still = not (c["bonds_broken"][stop] or np.any(c["bonds_slid"][rows]) or np.any(c["points_sliding"][rows]))
        # Rows do not show whether contacts formed; if nothing else changed, either modulus is accepted.
        elastic = still and stated == whole
        unbalanced = sum(abs(c["stress_top"][row] - c["stress_bottom"][row]) / 2 for row in (turn, low))
        r.key(label + "strain", strain[turn], 0.0)
        r.key(label + "stress", stress[turn], 0.0)
        r.key(label + "low_strain", strain[low], 0.0)
        r.key(label + "low_stress", stress[low], 0.0)
        modulus = whole if elastic else modulus
        if c["bonds_broken"][low] - c["bonds_broken"][turn] > failing * r.summary["bonds_initial"]:
            modulus = math.nan
        r.key(label + "modulus", modulus)
        known = 1.0 if modulus == modulus else math.nan
        r.key(label + "modulus_error", 0.0 if elastic else known * unbalanced / abs(drop))
        lateral = c["lateral_strain"]
        r.key(label + "poissons_ratio", known * sense * (lateral[turn] - lateral[low]) / way if r.uniaxial else math.nan)
        r.key(label + "damage", 1 - modulus / whole if c["bonds_broken"][stop] else 0.0, floor=1e-12)
        r.key(label + "permanent_strain", 0.0 if elastic else strain[low] - stress[low] / modulus, floor=1e-12 * strain[turn])
        again = stop + 1 < len(strain) and strain[stop + 1] < strain[stop]
        loop = 0.0 if again or strain[stop] > strain[turn] else math.nan
        for a in range(turn, stop):
            to = min(strain[a + 1], strain[turn])
            if strain[a + 1] != strain[a]:
                at = stress[a] + (stress[a + 1] - stress[a]) * (to - strain[a]) / (strain[a + 1] - strain[a])
                loop += (stress[a] + at) / 2 * (to - strain[a])
        r.key(label + "loss", loop * size, floor=1e-12 * abs(stress[turn]) * way * size)
