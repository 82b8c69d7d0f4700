# SPDX-License-Identifier: GPL-3.0-or-later
"""What depends on history, from a test with a row and a frame a step: shear forces, losses, work, energies of breaks.

Follows every contact point from frame to frame by solver/MODEL.md 4, 5 and 8; `r`, `model` and `bonds` as in frames.py."""

import math

import numpy as np

from frames import bodies_of, relative_motion
from model import dot, rounding, turned

single = 1e-7  # relative, of numbers kept in single precision: forces of events, dashpots' of the step before


def holds_every_step(r, rows):
    """Whether each step has its row and its frame, and the model followed here is the one that ran."""
    return (
        len(rows) == len(r.curve["step"])
        and bool(np.all(np.diff(r.curve["step"]) == 1))
        and r.results.key("numerics", "integrator", "leapfrog") == "leapfrog"
    )


class Point:
    """A contact point: shear spring, dashpots, and what its bond remembers."""

    def __init__(self, rest=None):
        self.rest = rest  # overlap at bonding, None without a bond
        self.shear = self.normal_dashpot = self.shear_dashpot = 0.0
        self.slid = False
        self.strong = (0.0, 0.0)


def moment(model, r, row, dt):
    """Contact points of a frame: their keys, overlaps, closing and slip rates, laws; and the frame's own contacts."""
    frame = r.results.frame(row)
    _, places, angle, velocity, spin = bodies_of(model, frame.particles)
    q = model.points(places, angle)
    arm_i, arm_j, way = relative_motion(q, places, velocity, spin)
    tangent = turned(q.normal)
    # Over a step an arm turns by w = spin dt; what a turn of both bodies as one moves along the face is w x arm less
    # w^2/2 arm, since places are those at the end.
    half = dt / 2
    slip = dot(way, tangent) + half * (spin[q.i] ** 2 * dot(arm_i, tangent) - spin[q.j] ** 2 * dot(arm_j, tangent))
    columns = (q.overlap, dot(way, q.normal), slip, model.normal_stiffness(q),
               model.shear_stiffness(q), model.friction(q), *model.dashpots(q))
    keys = list(zip(q.i.tolist(), q.element.tolist(), q.j.tolist()))
    return frame, dict(zip(keys, zip(*(column.tolist() for column in columns))))


def follow(points, key, values, dt, breaks):
    """One point through one step. @return friction and dashpot loss, J"""
    overlap, closing, slip, kn, ks, friction, cn, cs = values
    point = points.get(key)
    if point is None:
        if overlap <= 0:
            return 0.0, 0.0
        point = points[key] = Point()
    trial = point.shear - ks * slip * dt
    if overlap <= 0:
        dashpot = dt / 2 * (point.normal_dashpot * closing + point.shear_dashpot * slip)
        del points[key]
        taken = point.shear * trial / 2 / ks if ks > 0 else 0.0
        if point.rest is None:
            return taken, dashpot
        opening = overlap - point.rest
        breaks.append((key, kn / 2 * (opening - closing * dt) * opening + taken, point))
        return 0.0, dashpot
    limit = friction * kn * overlap
    slides = abs(trial) > limit or limit <= 0
    shear = math.copysign(limit, trial) if slides else trial
    lost = (point.shear + shear) / 2 * (trial - shear) / ks if slides and ks > 0 else 0.0
    normal_dashpot, shear_dashpot = cn * closing, 0.0 if slides else cs * slip
    dashpot = dt / 2 * ((point.normal_dashpot + normal_dashpot) * closing + (point.shear_dashpot + shear_dashpot) * slip)
    point.shear, point.normal_dashpot, point.shear_dashpot = shear, normal_dashpot, shear_dashpot
    point.slid |= slides
    if point.rest is not None:
        normal = kn * (overlap - point.rest)
        if math.hypot(normal, shear) >= kn * point.rest / 2:
            point.strong = (normal, shear)
    return lost, dashpot


def recount_history(r, model, bonds, rows):
    c, e = r.curve, r.events
    points = {
        (int(i), int(element), int(j)): Point(rest)
        for i, element, j, rest in zip(bonds.i, bonds.element, bonds.j, bonds.overlap)
    }
    friction, dashpot, speed, breaks = [], [], [], []
    strength = (model.normal_stiffness(bonds) * bonds.overlap).max()
    worst = 0.0
    for n, row in enumerate(rows):
        dt = c["time"][n] - c["time"][n - 1] if n else 0.0
        frame, found = moment(model, r, row, dt)
        lost = [follow(points, key, found[key], dt, breaks) for key in sorted(found)]
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
        ours = sorted((*sorted((i, j)), abs(point.shear)) for (i, _, j), point in points.items())
        if [d[:2] for d in drawn] != [o[:2] for o in ours]:
            worst = math.inf
        else:
            worst = max([worst, *(abs(d[2] - o[2]) for d, o in zip(drawn, ours))])
    r.compare("history: shear forces of all frames", worst, 0, rounding * strength)
    scale = max(dashpot[-1], friction[-1], c["platen_work"][-1])
    r.rows("history: dashpot_loss", c["dashpot_loss"], dashpot, single * scale)
    r.rows("history: friction_loss", c["friction_loss"], friction, rounding * scale)
    # The upper platen moves alone; the speed that its drive gives it brings its kinetic energy.
    force = (c["stress_top"][1:] + c["stress_top"][:-1]) / 2 * model.width
    work = np.concatenate([[0.0], np.cumsum(force * np.diff(c["axial_strain"]) * model.height)])
    work += model.mass[model.top] / 2 * (np.array(speed) ** 2 - speed[0] ** 2)
    r.rows("history: platen_work", c["platen_work"], work, rounding * work[-1])
    # Breaks of one step stand in the order of the points: by pair and strength here.
    stated = sorted(
        (*sorted((model.index[int(e["body_i"][k])], model.index[int(e["body_j"][k])])), e["strength"][k], k)
        for k in range(len(e["time"]))
    )
    expected = sorted(
        ((*sorted((key[0], key[2])), point.rest, k) for k, (key, _, point) in enumerate(breaks))
    )
    if [s[:2] for s in stated] != [x[:2] for x in expected]:
        r.true("history: pairs of events.csv", False)
        return
    at, ours = [s[3] for s in stated], [breaks[x[3]] for x in expected]
    energy = 0.5 * strength * bonds.overlap.max()
    r.rows("history: energy of breaks", np.asarray(e["energy"])[at], [b[1] for b in ours], 10 * rounding * energy)
    r.rows("history: slid of breaks", np.asarray(e["slid"])[at], [float(b[2].slid) for b in ours], 0)
    r.rows("history: normal force of breaks", np.asarray(e["normal_force"])[at], [b[2].strong[0] for b in ours], single * strength)
    r.rows("history: shear force of breaks", np.abs(np.asarray(e["shear_force"])[at]),
           [abs(b[2].strong[1]) for b in ours], single * strength)
