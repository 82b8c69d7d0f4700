# SPDX-License-Identifier: GPL-3.0-or-later
"""The first rate, the first velocities, and the rates that the rule gives for a curve with a row per step (specimens/loading/METHODS.md).

`r`, `model` and `bonds` as in frames.py; `solution` is the motion for an axial strain of 1, by model.py."""

import math

import numpy as np

from cycles import first_share
from model import dot, turned

looks_a_transit = 20
slowest_share = 0.15  # fraction of the first rate


def by_tolerance(r):
    return r.results.key("loading", "rate_tolerance") is not None and r.results.key("loading", "axial_strain_rate") is None


def yield_strain(r, model, bonds, motion):
    """Axial strain at which one bonded point in fifty has slid or broken; unbreakable ones do not count."""
    if model.by_faces:
        each = np.sort(bonds.load_to_failure(*bonds.forces_of(model, motion)))
        return min(each[len(each) // 50], r.results.key("loading", "max_axial_strain"))

    def at(body):
        arm = bonds.position - model.centre[body]
        return motion[body, :2] + turned(arm) * motion[body, 2:]

    way = at(bonds.i) - at(bonds.j)
    closing, slipping = dot(way, bonds.normal), np.abs(dot(way, turned(bonds.normal)))
    friction, kn, ks = model.friction(bonds), model.normal_stiffness(bonds), model.shear_stiffness(bonds)
    # A coulomb bond breaks at its envelope; a back-tension bond slides at a limit of the same form.
    margin = friction * kn * closing - ks * slipping
    with np.errstate(divide="ignore"):
        parting = np.where(closing < 0, -bonds.tensile / (kn * closing), math.inf)
        sliding = np.where((margin < 0) & (ks * slipping > 0), -bonds.cohesion / margin, math.inf)
    parting[bonds.held] = sliding[bonds.held] = math.inf
    first = np.sort(np.minimum(parting, sliding))[len(closing) // 50]
    return min(first, r.results.key("loading", "max_axial_strain"))


def recount_start(r, model, bonds, solution, modulus, elastic):
    """Checks the rate and the velocities of the first frame, and the rate rule if every step has a row.

    @param elastic  which bodies the solution moves"""
    motion = solution.reshape(-1, 3)
    first = yield_strain(r, model, bonds, motion)
    transit = model.height / math.sqrt(modulus / (model.mass[: model.count].sum() / (model.width * model.height)))
    limit = math.sqrt(r.results.key("loading", "rate_tolerance")) * first / transit
    if np.all(np.diff(r.curve["step"]) == 1):
        follow_rule(r, model, loading_energy(model, motion, elastic), modulus, first, transit)
    p = r.results.particles(r.results.frame_rows()[0])
    order = np.array([model.index[n] for n in p["id"]])
    if p["time"][0] > 0:
        return
    limit *= first_share(r.results, limit, first, transit, modulus)
    expected = limit * motion
    kept = np.concatenate([elastic, [True, True]])[order]
    size = np.abs(expected[:, :2]).max()
    # The softest modes contain the rounding errors of the stiffest, as for Poisson's ratio.
    r.compare("first rate by tolerance", np.abs(p["velocity"][order == model.top, 1])[0] / model.height, limit, 1e-6 * limit)
    r.rows("first velocities along x", p["velocity"][kept, 0], expected[order[kept], 0], 1e-6 * size)
    r.rows("first velocities along y", p["velocity"][kept, 1], expected[order[kept], 1], 1e-6 * size)
    turns = expected[order[kept], 2]
    r.rows("first rotation rates", p["rotation_rate"][kept], turns, 1e-6 * np.abs(turns).max())


def loading_energy(model, motion, elastic):
    """Kinetic energy of uniform loading at a rate of 1/s; bodies without bonds move in proportion to their height."""
    motion = motion.copy()
    loose = np.flatnonzero(~elastic)
    low, high = model.centre[model.bottom, 1], model.centre[model.top, 1]
    motion[loose] = 0.0
    motion[loose, 1] = -model.sense * model.height * (model.centre[loose, 1] - low) / (high - low)
    return np.sum(model.mass * (motion[:, 0] ** 2 + motion[:, 1] ** 2) + model.inertia * motion[:, 2] ** 2) / 2


def follow_rule(r, model, energy_per_rate, modulus, first, transit):
    """The rate of every step from the curve's stresses and energies, and the summary's figures about rates."""
    c, tolerance = r.curve, r.results.key("loading", "rate_tolerance")
    root = math.sqrt(tolerance)
    stress_floor = modulus * first
    energy_floor = stress_floor * first / 2 * model.width * model.height
    rate = limit = root * first / transit
    imbalance = share = largest = above = next_look = 0.0
    rates = []
    for n in range(len(c["time"]) - 1):  # nothing moves after the last row
        drift = c["time"][n] - c["time"][n - 1] if n else 0.0
        largest = max(largest, abs(c["axial_stress"][n]))
        now = (c["stress_top"][n] - c["stress_bottom"][n]) / max(largest, stress_floor)
        imbalance += min(1.0, drift / transit) * (now - imbalance)
        if c["time"][n] >= next_look:
            beyond = max(0.0, c["kinetic_energy"][n] - rate**2 * energy_per_rate)
            share += (beyond / max(c["strain_energy"][n], energy_floor) - share) / looks_a_transit
            error = max(abs(imbalance), share)
            if error > tolerance:
                above += rate * transit / looks_a_transit
            push = -math.log(max(error / tolerance, 1e-300))
            change = min(max(root * push, -4 * root), root) / looks_a_transit
            rate = min(max(rate * math.exp(change), slowest_share * limit), limit)
            next_look = c["time"][n] + transit / looks_a_transit
        rates.append(rate)
    rates = np.array(rates)
    # Strains contain the rounding of the platen's position, and the scales of the rule that of the solution.
    seen = np.diff(c["axial_strain"]) / np.diff(c["time"])
    r.rows("rate of every step by the rule", seen, rates, 1e-6 * limit + 1e-15 / np.diff(c["time"]))
    for which, stated, ours in zip(("slowest", "fastest"), r.summary["axial_strain_rate_range"], (rates.min(), rates.max())):
        r.compare(f"axial_strain_rate_range: {which}", stated, ours, 1e-6 * limit)
    r.key("strain_share_above_tolerance", above / c["axial_strain"][-1], 1e-6)
