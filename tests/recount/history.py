# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures that depend on history, from a test with a row and a frame per step: shear forces, losses, work, energies of breaks.

Follows every contact point from frame to frame by solver/MODEL.md 4, 5 and 8; `r`, `model` and `bonds` as in frames.py."""

import math
from typing import NamedTuple

import numpy as np

from frames import bodies_of, match, relative_motion, touching_floor
from model import dot, rounding, turned

# Relative tolerance of numbers stored in single precision: forces of back-tension events, dashpot forces of the
# previous step.
single = 1e-7


def holds_every_step(r, rows):
    """Whether every step has a row and a frame, and the test used the integrator that is followed here."""
    return (
        len(rows) == len(r.curve["step"])
        and bool(np.all(np.diff(r.curve["step"]) == 1))
        and r.results.key("numerics", "integrator", "leapfrog") == "leapfrog"
    )


class Values(NamedTuple):
    """State and constants of a contact point in a frame, in m, m/s, N/m, N s/m."""

    overlap: float
    closing: float
    slip: float
    kn: float
    ks: float
    friction: float
    cn: float
    cs: float
    rest: float  # force-free overlap of a point without a bond, before it slides
    dilation: float  # tangent of the dilation angle
    dilation_slip: float
    lap: float  # overlap of flat faces, otherwise NaN
    turning: float  # m, closure of flat faces by rotation in the step
    aperture: float


class Point:
    """A contact point: shear spring, dashpots, and the history of its bond."""

    def __init__(self, bond=None, rest=0.0):
        self.bond = bond  # index of the bond, or None
        self.rest = rest  # force-free overlap, m
        self.shear = self.normal_dashpot = self.shear_dashpot = 0.0
        self.slid = self.in_shear = False
        self.lap = math.nan  # m, overlap of flat faces without a bond
        self.failing = (0.0, 0.0)  # N, normal and shear force for events.csv


def settle_rounding(model, q, frame, first, bonds):
    """Sets the sign of overlaps at the level of rounding so that these points touch exactly if they do in the frame."""
    open_question = np.abs(q.overlap) <= touching_floor * model.height
    if not model.frictional or not np.any(open_question):
        return
    chosen, _ = match(model, q, frame, first, bonds)
    touches = np.zeros(len(q.i), bool)
    touches[chosen[(chosen >= 0) & (frame.contacts["state"] == 4)]] = True
    size = np.maximum(np.abs(q.overlap), np.finfo(float).tiny)
    q.overlap = np.where(open_question, np.where(touches, size, -size), q.overlap)


def moment(model, r, bonds, row, first, dt):
    """The frame, and its contact points by key, with overlaps, closing and slip rates, and constants."""
    frame = r.results.frame(row)
    _, places, angle, velocity, spin = bodies_of(model, frame.particles)
    q = model.points(places, angle)
    settle_rounding(model, q, frame, first, bonds)
    arm_i, arm_j, way = relative_motion(q, places, velocity, spin)
    tangent = turned(q.normal)
    # A lever arm rotates by w = spin dt in a step. Places are those at the end of the step, so a point moves by w x arm
    # minus w^2/2 arm.
    half = dt / 2
    slip = dot(way, tangent) + half * (spin[q.i] ** 2 * dot(arm_i, tangent) - spin[q.j] ** 2 * dot(arm_j, tangent))
    # Closure of flat faces by the rotation of their two circles, evaluated at the middle of the step.
    offset = dot(places[q.j] - places[q.i], tangent)
    turning = half * (offset + half * dot(velocity[q.i] - velocity[q.j], tangent)) * (spin[q.i] + spin[q.j])
    joint = [model.joints.of(name, q.trace, 0.0) for name in ("dilation_angle", "aperture")]
    columns = (q.overlap, dot(way, q.normal), slip, model.normal_stiffness(q),
               model.shear_stiffness(q), model.residual_friction(q) if model.coulomb else model.friction(q),
               *model.dashpots(q), q.rest, np.tan(np.radians(joint[0])), model.joints.of("dilation_slip", q.trace, math.inf),
               q.lap, turning, joint[1])
    return frame, dict(zip(q.keys(), (Values(*row) for row in zip(*(column.tolist() for column in columns)))))


def share_to_limit(before, now):
    """Fraction of a step after which the remaining strength is exhausted."""
    if now > 0:
        return math.inf
    return max(0.0, before / (before - now)) if before > now else 0.0


class Follower:
    """Follows all contact points from step to step. touching: Point by key; breaks: (step, key, energy, Point)."""

    def __init__(self, model, bonds):
        self.coulomb = model.coulomb
        self.touching = {key: Point(k, rest) for k, (key, rest) in enumerate(zip(bonds.keys(), bonds.overlap.tolist()))}
        self.rest_after = dict(zip(bonds.keys(), model.rest_after(bonds.overlap).tolist()))
        self.bonded = list(zip(*(column.tolist() for column in (
            model.normal_stiffness(bonds), model.shear_stiffness(bonds), *model.dashpots(bonds)))))
        self.rests = {}  # m, force-free overlaps of joint faces that have slid or rotated
        self.slid = {}  # m, slip of faces that dilate
        self.laps, self.met = bonds.lap.tolist(), model.met
        self.held = bonds.held.tolist()
        self.strength = list(zip(bonds.tensile.tolist(), bonds.cohesion.tolist(), model.friction(bonds).tolist()))
        self.broken, self.breaks = set(), []

    def follow(self, step, key, values, dt):
        """Follows one point through one step. @return friction and dashpot loss, J"""
        flat = not math.isnan(values.lap)
        point = self.touching.get(key)
        lost = 0.0
        if flat and point is not None and point.bond is not None:
            kn, ks, cn, cs = self.bonded[point.bond]  # the lap of bonded faces does not change
            values = values._replace(kn=kn, ks=ks, cn=cn, cs=cs)
        elif point is not None and point.bond is None and values.dilation > 0:
            lost = self._dilate(key, point, values, dt)
        if flat:
            self._follow_faces(key, point, values)
        overlap, closing, slip, kn, ks, friction, cn, cs = values[:8]
        if point is None:
            rest = self.rests.get(key, values.rest)
            if overlap <= rest or (flat and values.lap <= 0):
                self._rest_apart(key, values, rest)
                return 0.0, 0.0
            point = self.touching[key] = Point(rest=rest)
            point.lap = values.lap
        trial = point.shear - ks * slip * dt
        opening = overlap - point.rest
        holds = point.bond is not None and self.held[point.bond]
        if point.bond is not None and not holds:
            if self.coulomb:
                if self._fails(point, kn * opening, trial):
                    return 0.0, self._break_coulomb(step, key, point, values, dt)
                holds = True
            elif overlap <= 0:
                # A force whose sign changed within the step has passed through zero.
                normal, shear = max(0.0, (opening - closing * dt) * opening), max(0.0, point.shear * trial)
                energy = kn / 2 * normal + (shear / 2 / ks if ks > 0 else 0.0)
                self._part(step, key, energy, point)
                return 0.0, self._release(key, point, closing, slip, dt)
        elif point.bond is None and (opening <= 0 or (flat and values.lap <= 0)):
            self._rest_apart(key, values, point.rest)
            return lost + (point.shear * trial / 2 / ks if ks > 0 else 0.0), self._release(key, point, closing, slip, dt)
        limit = math.inf if holds else friction * kn * (opening if self.coulomb else overlap)
        slides = abs(trial) > limit or limit <= 0
        shear = math.copysign(limit, trial) if slides else trial
        lost += (point.shear + shear) / 2 * (trial - shear) / ks if slides and ks > 0 else 0.0
        normal_dashpot, shear_dashpot = cn * closing, 0.0 if slides else cs * slip
        dashpot = dt / 2 * ((point.normal_dashpot + normal_dashpot) * closing + (point.shear_dashpot + shear_dashpot) * slip)
        point.shear, point.normal_dashpot, point.shear_dashpot = shear, normal_dashpot, shear_dashpot
        point.slid |= slides
        if point.bond is not None and not self.coulomb:
            normal = kn * opening
            if math.hypot(normal, shear) >= kn * point.rest / 2:
                point.failing = (normal, shear)
        return lost, dashpot

    def _dilate(self, key, point, values, dt):
        """Opens a face that slides (solver/MODEL.md 5.3). @return energy that the opening adds to the friction loss, J"""
        opening, left = values.overlap - point.rest, values.dilation_slip - self.slid.get(key, 0.0)
        excess = abs(point.shear - values.ks * values.slip * dt) - values.friction * values.kn * opening
        if opening <= 0 or left <= 0 or excess <= 0:
            return 0.0
        way = min(left, excess / (values.ks + values.friction * values.kn * values.dilation))
        rise = way * values.dilation
        point.rest -= rise
        self.slid[key] = self.slid.get(key, 0.0) + way
        return -values.kn / 2 * (max(0.0, opening - values.closing * dt) + opening + rise) * rise

    def _follow_faces(self, key, point, values):
        """Flat faces close by the rotation of their circles; without a bond, their lap changes too (solver/MODEL.md 5.4)."""
        if point is None:
            return
        point.rest += values.turning
        if point.bond is None and values.lap > 0:
            point.shear *= values.lap / point.lap
            point.lap = values.lap

    def _rest_apart(self, key, values, rest):
        """Stores the force-free overlap for the next contact. Flat faces that first met during loading lose what rotation added, down to
        the aperture."""
        stays = math.isnan(values.lap) or self.met(key)
        self.rests[key] = rest if stays else max(values.aperture, min(rest, values.overlap))

    def _part(self, step, key, energy, point):
        self.broken.add(key)
        self.breaks.append((step, key, energy, point))

    def _release(self, key, point, closing, slip, dt):
        del self.touching[key]
        return dt / 2 * (point.normal_dashpot * closing + point.shear_dashpot * slip)

    def _slack(self, point, normal, shear):
        """Remaining tensile and shear strength, N."""
        tensile, cohesion, friction = self.strength[point.bond]
        return tensile + normal, cohesion + friction * normal - abs(shear)

    def _fails(self, point, normal, shear):
        return min(self._slack(point, normal, shear)) <= 0

    def _break_coulomb(self, step, key, point, values, dt):
        """Breaks a bond, which continues as a contact without a bond if it still overlaps. @return dashpot loss, J"""
        overlap, closing, slip, kn, ks, friction, cn, _ = values[:8]
        opening = overlap - point.rest
        before = opening - closing * dt
        trial = point.shear - ks * slip * dt
        was, now = self._slack(point, kn * before, point.shear), self._slack(point, kn * opening, trial)
        point.in_shear = share_to_limit(was[1], now[1]) < share_to_limit(was[0], now[0])
        point.failing = (kn * opening, trial)
        rest = self.rests[key] = max(point.rest, 0.0)
        left = max(0.0, overlap - rest)
        shear = math.copysign(min(abs(trial), friction * kn * left), trial)
        normal, slider = kn / 2 * (before + left) * (opening - left), (point.shear + shear) / 2 * (trial - shear) / ks
        energy = max(0.0, normal) + max(0.0, slider)
        self._part(step, key, energy, point)
        dashpot = self._release(key, point, closing, slip, dt)
        if left > 0:
            after = self.touching[key] = Point(rest=rest)
            after.lap = self.laps[point.bond]
            after.shear, after.normal_dashpot = shear, cn * closing
            dashpot += dt / 2 * after.normal_dashpot * closing
        return dashpot


def recount_history(r, model, bonds, rows):
    c, e = r.curve, r.events
    points = Follower(model, bonds)
    friction, dashpot, speed = [], [], []
    strength = bonds.tensile.max()
    worst, first = 0.0, r.results.frame(rows[0])
    for n, row in enumerate(rows):
        dt = c["time"][n] - c["time"][n - 1] if n else 0.0
        frame, found = moment(model, r, bonds, row, first, dt)
        lost = [points.follow(c["step"][n], key, found[key], dt) for key in sorted(found)]
        friction.append(sum(pair[0] for pair in lost) + (friction[-1] if n else 0.0))
        speed.append(frame.particles["velocity"][list(frame.particles["id"]).index(model.ids[model.top]), 1])
        dashpot.append(sum(pair[1] for pair in lost) + (dashpot[-1] if n else 0.0))
        names = frame.contacts
        acting = names["state"] != 2
        drawn = sorted(
            (*sorted((model.index[i], model.index[j])), abs(force))
            for i, j, force in zip(names["body_i"][acting], names["body_j"][acting],
                                   np.asarray(names["shear_force"])[acting].tolist())
        )
        ours = sorted((*sorted((i, j)), abs(point.shear)) for (i, _, j), point in points.touching.items())
        if [d[:2] for d in drawn] != [o[:2] for o in ours]:
            worst = math.inf
        else:
            worst = max([worst, *(abs(d[2] - o[2]) for d, o in zip(drawn, ours))])
    r.compare("history: shear forces of all frames", worst, 0, rounding * strength)
    scale = max(dashpot[-1], friction[-1], c["platen_work"][-1])
    r.rows("history: dashpot_loss", c["dashpot_loss"], dashpot, single * scale)
    r.rows("history: friction_loss", c["friction_loss"], friction, rounding * scale)
    # Only the upper platen moves. The work includes the kinetic energy that its drive gives it.
    force = (c["stress_top"][1:] + c["stress_top"][:-1]) / 2 * model.width
    work = np.concatenate([[0.0], np.cumsum(force * np.diff(c["axial_strain"]) * model.height)])
    work += model.mass[model.top] / 2 * (np.array(speed) ** 2 - speed[0] ** 2)
    r.rows("history: platen_work", c["platen_work"], work, rounding * work[-1])
    # Breaks of one step are in the order of the points; here they are sorted by pair and energy.
    stated = sorted(
        (*sorted((model.index[int(e["body_i"][k])], model.index[int(e["body_j"][k])])), e["step"][k], e["energy"][k], k)
        for k in range(len(e["time"]))
    )
    expected = sorted(
        (*sorted((key[0], key[2])), step, energy, k) for k, (step, key, energy, _) in enumerate(points.breaks)
    )
    if [s[:3] for s in stated] != [x[:3] for x in expected]:
        r.true("history: pairs of events.csv", False)
        return
    at, ours = [s[4] for s in stated], [points.breaks[x[4]] for x in expected]
    energy = (bonds.tensile**2 / 2 / model.normal_stiffness(bonds)).max()
    r.rows("history: energy of breaks", np.asarray(e["energy"])[at], [b[2] for b in ours], 10 * rounding * energy)
    parted = [b[3] for b in ours]
    r.rows("history: slid of breaks", np.asarray(e["slid"])[at], [float(p.slid) for p in parted], 0)
    if model.coulomb:
        r.compare("history: mode of breaks", sum((e["mode"][k] == "shear") != p.in_shear for k, p in zip(at, parted)), 0, 0)
    kept = (rounding if model.coulomb else single) * strength
    r.rows("history: normal force of breaks", np.asarray(e["normal_force"])[at], [p.failing[0] for p in parted], kept)
    r.rows("history: shear force of breaks", np.abs(np.asarray(e["shear_force"])[at]),
           [abs(p.failing[1]) for p in parted], kept)
