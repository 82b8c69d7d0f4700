# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks: compares rows of events.csv with the bonds, the curve and each other; `r`, `model` and `bonds` as in frames.py."""

import math

import numpy as np

from cycles import turns_round
from model import rounding

# Fraction of a strength by which a force can grow in a step. At 0.8 of the stable step, the phase of the stiffest mode
# advances by 106 degrees per step.
one_step = 0.5
# Mean growth of the forces in the last step, as a fraction of the energy of all breaks; for single breaks it scatters
# by one_step.
mean_step = 0.1


def recount_events(r, model, bonds):
    """Compares every row of events.csv with the bonds, the curve, and the other rows."""
    e, c = r.events, r.curve
    count = len(e["time"])
    r.key("bonds_broken", count)
    if not count:
        return
    r.true("events: in the order of steps", np.all(np.diff(e["step"]) >= 0))
    r.rows("curve: bonds_broken of events", c["bonds_broken"],
           np.searchsorted(e["step"], c["step"], side="right"), 0)
    last = np.asarray(e["last_of_interface"])
    r.rows("curve: interfaces_lost of events", c["interfaces_lost"],
           [np.sum(last[: np.searchsorted(e["step"], step, side="right")]) for step in c["step"]], 0)
    mean_step = c["time"][-1] / c["step"][-1]
    row = np.clip(np.searchsorted(c["step"], e["step"]), 1, len(c["step"]) - 1)
    inside = (e["step"] - c["step"][row - 1]) / np.maximum(c["step"][row] - c["step"][row - 1], 1)
    width = c["axial_strain"][row] - c["axial_strain"][row - 1]
    guess = c["axial_strain"][row - 1] + inside * width
    if r.results.key("loading", "axial_strain_rate") is not None:
        guess = r.results.key("loading", "axial_strain_rate") * e["time"]
        r.rows("events: axial_strain", e["axial_strain"], guess, 1e-9 * guess + 1e-15)
    else:
        # If the platen reverses between two rows, their distance is smaller than the travelled strain.
        apart = np.abs(np.diff(c["axial_strain"])).max() if turns_round(r.results) else np.abs(width)
        r.rows("events: axial_strain", e["axial_strain"], guess, apart + 1e-12)
    r.rows("events: time", e["time"], c["time"][row - 1] + inside * (c["time"][row] - c["time"][row - 1]),
           2 * mean_step)
    left = {}
    for k in np.flatnonzero(~bonds.held):
        left.setdefault(frozenset((model.ids[bonds.i[k]], model.ids[bonds.j[k]])), []).append(k)
    friction = model.friction(bonds)
    in_shear = np.array([(model.coulomb or model.by_faces) and m == "shear" for m in e["mode"]])

    def limit(m, k):
        """Strength that bond m would have in row k."""
        if model.by_faces:
            return bonds.limits(np.full(len(bonds.i), e["normal_force"][k]))[m] if in_shear[k] else bonds.tensile[m]
        return bonds.cohesion[m] + friction[m] * e["normal_force"][k] if in_shear[k] else bonds.tensile[m]

    strength, ours_last, of_bond = [], [], []
    for k in range(count):
        own = left.get(frozenset((int(e["body_i"][k]), int(e["body_j"][k]))), [])
        m = min(own, key=lambda m: abs(limit(m, k) - e["strength"][k]), default=-1)
        of_bond.append(m)
        if m < 0:
            strength.append(math.nan)
            ours_last.append(math.nan)
            continue
        own.remove(m)
        strength.append(limit(m, k))
        ours_last.append(0)
    # The last break of an interface is the last row of its pair, provided that no bond of the pair is left.
    final = {frozenset((int(a), int(b))): k for k, (a, b) in enumerate(zip(e["body_i"], e["body_j"]))}
    for pair, k in final.items():
        if left.get(pair) == [] and not held_between(model, bonds, pair):
            ours_last[k] = 1
    r.compare("events: rows of pairs that have no bond left", of_bond.count(-1), 0, 0)
    r.rows("events: strength", e["strength"], strength, 1e-9 * np.abs(strength))
    r.rows("events: last_of_interface", e["last_of_interface"], ours_last, 0)
    if model.coulomb:
        recount_envelope(r, model, bonds, np.array(of_bond), in_shear)
        shear = in_shear
    elif model.by_faces:
        recount_faces_envelope(r, model, bonds, np.array(of_bond), in_shear)
        shear = in_shear
    else:
        force = np.hypot(e["normal_force"], e["shear_force"])
        # Normal and shear force are kept in single precision.
        # They are 0 if the bond never carried half its strength because it broke from one step to the next.
        r.true("events: forces at half the strength or more, or 0",
               np.all((force >= 0.5 * e["strength"] * (1 - 1e-6)) | (force == 0)))
        shear = (np.asarray(e["slid"]) == 1) & (np.abs(e["shear_force"]) > np.abs(e["normal_force"]))
        r.compare("events: rows with another mode", sum((m == "shear") != s for m, s in zip(e["mode"], shear)), 0, 0)
    r.key("bonds_broken_after_sliding", int(np.sum(e["slid"])))
    r.key("bonds_broken_in_shear", int(np.sum(shear)))
    r.key("bonds_broken_in_tension", int(np.sum(~shear)))
    if r.peak is not None:
        to_peak = np.asarray(e["step"]) <= c["step"][r.peak]
        r.key("bonds_broken_in_shear_to_peak", int(np.sum(shear & to_peak)))
        r.key("bonds_broken_in_tension_to_peak", int(np.sum(~shear & to_peak)))
    if model.joints.traces:
        traces = [model.trace_of(model.index[int(a)], model.index[int(b)]) for a, b in zip(e["body_i"], e["body_j"])]
        r.rows("events: trace", e["trace"], traces, 0)
    taken = np.sum(e["energy"])
    if model.by_faces and np.any(in_shear):  # later, slip and opening use up what a failure in shear leaves
        r.true("fracture_loss: at least that of events", c["fracture_loss"][-1] >= taken * (1 - 1e-12))
    else:
        r.compare("fracture_loss of events", c["fracture_loss"][-1], taken, 1e-12 * np.sum(np.abs(e["energy"])))


def held_between(model, bonds, pair):
    i, j = (model.index[name] for name in pair)
    return bool(np.any(bonds.held & (((bonds.i == i) & (bonds.j == j)) | ((bonds.i == j) & (bonds.j == i)))))


def recount_envelope(r, model, bonds, of_bond, in_shear):
    """Rows of coulomb bonds: forces at failure, exceeded limits, energies (solver/MODEL.md 5.2)."""
    e = r.events
    known = of_bond >= 0
    m, in_shear = of_bond[known], in_shear[known]
    normal, shear = e["normal_force"][known], np.abs(e["shear_force"][known])
    tensile, limit = bonds.tensile[m], bonds.cohesion[m] + model.friction(bonds)[m] * normal
    parts, shears = -normal >= tensile * (1 - rounding), shear >= limit - rounding * bonds.cohesion[m]
    r.compare("events: rows within both limits", int(np.sum(~(parts | shears))), 0, 0)
    # If both limits are exceeded in one step, the mode depends on the path within the step, which only a frame per step
    # shows (history.py).
    r.compare("events: rows with another mode", int(np.sum(np.where(in_shear, ~shears, ~parts))), 0, 0)
    r.compare("events: coulomb bonds that slid", int(np.sum(e["slid"])), 0, 0)
    over = np.where(in_shear, shear - limit, -normal - tensile)
    r.rows("events: force beyond the limit", over, np.zeros(len(over)), one_step * (bonds.tensile + bonds.cohesion).mean())
    r.true("events: no energy below 0", np.all(np.asarray(e["energy"]) >= 0))
    # The rotation of flat faces is in no file; history.py follows it.
    at_rest = np.isnan(bonds.lap[m])
    if not at_rest.all():
        r.leave("events: energy of flat faces", "what their circles have turned by is in no file")
    known[known], m, normal, shear = at_rest, m[at_rest], normal[at_rest], shear[at_rest]
    kn, ks = model.normal_stiffness(bonds)[m], model.shear_stiffness(bonds)[m]
    kept = np.maximum(0.0, normal + kn * (bonds.overlap[m] - model.rest_after(bonds.overlap[m])))
    rubs = np.minimum(shear, model.residual_friction(bonds)[m] * kept)
    stored = (normal**2 - kept**2) / 2 / kn + (shear**2 - rubs**2) / 2 / ks
    # The energy account uses the mean force of the last step, so it differs by at most the growth of the force in it.
    size = (np.abs(normal) + kept) ** 2 / 2 / kn + shear**2 / 2 / ks
    energy = np.asarray(e["energy"])[known]
    r.rows("events: energy of the forces", energy, stored, size)
    r.compare("events: energy of all their forces", energy.sum(), stored.sum(),
              mean_step * size.sum() + one_step * math.sqrt(np.sum(size**2)))


def recount_faces_envelope(r, model, bonds, of_bond, in_shear):
    """Rows of faces: forces at failure, exceeded limits, modes (solver/MODEL.md 5.5). The moment is in no file; it only adds to tension."""
    e = r.events
    known = of_bond >= 0
    m, in_shear = of_bond[known], in_shear[known]
    normal, shear = np.asarray(e["normal_force"])[known], np.abs(np.asarray(e["shear_force"])[known])
    tensile, limit, bends = bonds.tensile[m], bonds.limits_of(m, normal), bonds.moment_share[m] > 0
    # Forces in the file and limits are rounded differently.
    slips, parts = shear >= limit - rounding * bonds.cohesion[m], -normal >= tensile * (1 - rounding)
    r.compare("events: rows within both limits", int(np.sum(~(slips | parts | (bends & ~in_shear)))), 0, 0)
    # The larger multiple of the strength decides.
    by_tension = -normal * np.maximum(0.0, limit) - shear * tensile
    fine = rounding * tensile * np.maximum(limit, shear)
    wrong = np.where(in_shear, ~slips | (by_tension > fine), ~bends & (~parts | (by_tension < -fine)))
    r.compare("events: rows with another mode", int(np.sum(wrong)), 0, 0)
    r.compare("events: faces that slid", int(np.sum(e["slid"])), 0, 0)
    over = np.where(in_shear, shear - limit, np.where(bends, np.maximum(0.0, -normal - tensile), -normal - tensile))
    r.rows("events: force beyond the limit", over, np.zeros(len(over)), one_step * (bonds.tensile + bonds.cohesion).mean())
    r.true("events: no energy below 0", np.all(np.asarray(e["energy"]) >= 0))
    if not r.every_step:
        r.leave("events: energy of faces", "moments and pressures of the cells are in no file; a frame per step gives them")
        if np.any(bends & ~in_shear):
            r.leave("events: tension of faces with a moment_share", "moments are in no file; a frame per step gives them")


def recount_parting(r, model):
    """The largest crack: broken bonds that share particles or a platen, and where it lies (specimens/setup/METHODS.md)."""
    e, s = r.events, r.summary
    pairs = [(model.index[int(a)], model.index[int(b)]) for a, b in zip(e["body_i"], e["body_j"])]
    if not pairs:
        r.true("failed_at and largest_crack: null without a break", s["failed_at"] is None and s["largest_crack"] is None)
        return
    group = {}
    for pair in pairs:
        joined = set(pair).union(*(group.get(b, ()) for b in pair))
        group.update((b, joined) for b in joined)
    cracks = {}
    for i, j in pairs:
        own = [b for b in (i, j) if b < model.count]
        cracks.setdefault(min(group[i]), []).append((np.mean(model.centre[own, 1]) - model.deck.y1, len(own) < 2))
    most = max(len(crack) for crack in cracks.values())
    found = []  # all cracks of the largest size; either of two is accepted
    for crack in cracks.values():
        if len(crack) == most:
            height, of_platen = np.mean([c[0] for c in crack]), sum(c[1] for c in crack)
            within = min(height, model.height - height) < s["grip"]
            found.append((height, of_platen, "platen" if 2 * of_platen >= most else "grip" if within else "gauge"))
    stated = s["largest_crack"]
    height, of_platen, place = min(found, key=lambda f: abs(f[0] - stated["height"]))
    r.key("largest_crack.bonds", most)
    r.key("largest_crack.of_platen", of_platen)
    r.key("largest_crack.height", height)
    r.key("failed_at", place)
