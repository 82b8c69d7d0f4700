# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of specimens that are bonded by faces: pressures of cells, forces of intact and broken faces, stresses, energies.

`r`, `model` and `frame` as in frames.py; `bonds` are the faces (bonded_faces.py). Forces of faces are positive in tension."""

import math
from dataclasses import dataclass

import numpy as np

from frames import bodies_of, compare_stresses, contact_places, recount_gauges, recount_kinetic, recount_pieces, relative_motion
from model import dot, rounding, turned

turned_enough, turned_away = 0.02, 0.04  # rad: rotations between which points replace a broken face
least_singular = 1e-6  # smallest singular value, over the largest, at which forces determine pressures
single = 2.0**-24  # relative rounding of the shares of points, which are stored in single precision
least_of_points = 1e-6  # smallest fraction of its stiffness that a point between two bodies with a face has
late = 0.1  # largest change of the pressure at an open face in one step, as a fraction of it


def lap_pressure(stiffness, half_lap, opening, turn):
    """Force (N), moment (N m), energy (J) of the pressure between two edges, and the length over which they press (m), per metre.

    @param stiffness  k_n/L, N/m²"""
    a, d, phi = half_lap, opening, abs(turn)
    if a <= 0 or d - a * phi >= 0:
        return 0.0, 0.0, 0.0, 0.0
    if d + a * phi <= 0:
        kn, kphi = 2 * a * stiffness, 2 * a**3 * stiffness / 3
        return kn * d, kphi * turn, (kn * d * d + kphi * turn * turn) / 2, 2 * a
    b = a - d / phi
    force = -stiffness * phi * b * b / 2
    return force, math.copysign(-force * (a - b / 3), turn), stiffness * phi * phi * b**3 / 6, b


def share_of_face(length, lap, turn, thick):
    """q: the share of the pressure that a broken face bears. The rest is borne by contact points."""
    across = min(2 * thick, length)
    return min(1.0, lap / across) * min(1.0, max(0.0, (turned_away - abs(turn)) / (turned_away - turned_enough)))


class Laps:
    """Broken faces at one moment, by index: what depends only on the places of their bodies."""

    def __init__(self, model, bonds, motion):
        self.opening, self.sliding, self.turn = (values.tolist() for values in motion[:3])
        self.length, self.kn = bonds.length.tolist(), bonds.kn.tolist()
        rigid = (bonds.j >= model.count).tolist()
        self.lap = [long if whole else max(0.0, long - abs(slid)) for long, whole, slid in zip(self.length, rigid, self.sliding)]
        self.q = [share_of_face(*each, model.thick) for each in zip(self.length, self.lap, self.turn)]

    def contact(self, k, pressure):
        """Force, moment, energy Ψ with the factor q, and closed length without it. @param pressure  p̄, Pa"""
        stiffness = self.kn[k] / self.length[k]
        force, moment, energy, closed = lap_pressure(stiffness, self.lap[k] / 2, self.opening[k] + pressure / stiffness, self.turn[k])
        q = self.q[k]
        return q * force, q * moment, q * energy, closed


@dataclass
class Pressures:
    """Pressures of the bodies, Pa, as far as a frame determines them."""

    value: np.ndarray
    known: np.ndarray  # true if the frame determines it
    error: np.ndarray  # Pa, by rounding of the forces in the frame


def pressures_of(model, bonds, motion, intact, normal, shear):
    """Pressures of cells. If all faces of a cell are intact, their motion determines it, otherwise the forces of the intact ones.

    @param normal, shear  N, forces in the frame"""
    opening, sliding = motion[:2]
    pressure = model.pressure_per_area * bonds.dilations(model, opening, sliding)
    known, error = np.ones(len(pressure), bool), np.zeros(len(pressure))
    asked = np.zeros(len(pressure), bool)
    asked[bonds.i[~intact]] = asked[bonds.j[~intact]] = True
    asked &= model.pressure_per_area > 0
    cells = np.flatnonzero(asked)
    if not len(cells):
        return Pressures(pressure, known, error)
    beside = np.flatnonzero(intact & (asked[bonds.i] | asked[bonds.j]))
    column = np.full(len(pressure), -1)
    column[cells] = np.arange(len(cells))
    matrix, right = np.zeros((2 * len(beside), len(cells))), []
    right = np.concatenate([(normal - bonds.kn * opening)[beside], (shear - bonds.kt * sliding)[beside]])
    for first, weights in ((0, (bonds.share_i, bonds.share_j)), (len(beside), (bonds.skew_i, -bonds.skew_j))):
        for body, weight in zip((bonds.i[beside], bonds.j[beside]), weights):
            own = (bonds.length * weight)[beside]
            unknown = column[body] >= 0
            at = first + np.arange(len(beside))
            np.add.at(matrix, (at[unknown], column[body[unknown]]), own[unknown])
            right[at[~unknown]] -= own[~unknown] * pressure[body[~unknown]]
    known[cells] = False
    if len(beside):
        left, sizes, modes = np.linalg.svd(matrix, full_matrices=False)
        kept = sizes > least_singular * sizes.max()
        modes = modes[kept]
        pressure[cells] = modes.T @ ((left[:, kept].T @ right) / sizes[kept])
        known[cells] = (modes**2).sum(axis=0) > 1 - rounding
        error[cells] = np.sqrt(((modes / sizes[kept, None]) ** 2).sum(axis=0)) * rounding * bonds.tensile.mean()
    return Pressures(pressure, known, error)


def faces_in(model, bonds, contacts):
    """State of each face in a frame, its forces (N, tension positive), and the rows of other contacts."""
    index = {frozenset(pair): k for k, pair in enumerate(zip(bonds.i.tolist(), bonds.j.tolist()))}
    rows = np.flatnonzero(contacts["state"] != 4)
    at = np.array([index[frozenset((model.index[contacts["body_i"][k]], model.index[contacts["body_j"][k]]))] for k in rows], int)
    state, normal, shear = np.full(len(bonds.i), -1), np.zeros(len(bonds.i)), np.zeros(len(bonds.i))
    state[at], normal[at], shear[at] = contacts["state"][rows], -np.asarray(contacts["normal_force"])[rows], np.asarray(contacts["shear_force"])[rows]
    return state, normal, shear, np.flatnonzero(contacts["state"] == 4)


def points_in(model, frame, rows, points):
    """Index into `points` of each contact without a bond, by pair and place."""
    places, by_pair, used, found = contact_places(model, frame), {}, set(), []
    for k, pair in enumerate(zip(points.i.tolist(), points.j.tolist())):
        by_pair.setdefault(frozenset(pair), []).append(k)
    for row in rows:
        i, j = (model.index[frame.contacts[name][row]] for name in ("body_i", "body_j"))
        own = [k for k in by_pair.get(frozenset((i, j)), []) if k not in used]
        best = min(own, key=lambda k: (points.i[k] != i, math.dist(points.position[k], places[row])), default=-1)
        used.add(best)
        found.append(best)
    return np.array(found, int)


def failed_in_shear(r, model, bonds):
    """Whether each face breaks in shear at some time."""
    pairs = {frozenset((model.index[int(a)], model.index[int(b)])) for a, b, mode in zip(r.events["body_i"], r.events["body_j"], r.events["mode"])
             if mode == "shear"}
    return np.array([frozenset(pair) in pairs for pair in zip(bonds.i.tolist(), bonds.j.tolist())], bool)


def keeps_tension(r, model, bonds, laps, contact, mean):
    """Whether each face would bear a tension if it has not been damaged since its failure in shear."""
    lap, opening, turn = (np.array(values) for values in (laps.lap, laps.opening, laps.turn))
    stiffness = bonds.kn / bonds.length
    bent = stiffness * (opening + mean / stiffness + bonds.moment_share * lap / 2 * np.abs(turn))
    unsure = (bonds.left_tension > 0) | (bent <= 0)
    return failed_in_shear(r, model, bonds) & (contact[:, 3] < lap) & unsure & (lap > 0)


def beyond_envelope(bonds, normal, shear, moment, scale):
    """Which faces are beyond their tensile or shear strength. @param normal, shear, moment  N and N m, tension positive"""
    parts = normal + 6 * bonds.moment_share * np.abs(moment) / bonds.length > bonds.tensile + rounding * scale
    return ~bonds.held & (parts | (np.abs(shear) > bonds.limits(-normal) + rounding * scale))


def relative_motion_of(bonds, middle, places, velocity, spin):
    """Velocity of body j relative to i at each face, m/s."""
    i, j = bonds.i, bonds.j
    return velocity[j] + turned(middle - places[j]) * spin[j][:, None] - velocity[i] - turned(middle - places[i]) * spin[i][:, None]


def recount_face_frame(r, model, bonds, frame, row):
    """Forces, stresses, energies and fragments of one frame. @param row  its row in the curve, or None if it was not written"""
    label = f"frame {frame.row}: "
    p = frame.particles
    order, places, angle, velocity, spin = bodies_of(model, p)
    motion = opening, sliding, turn, across, ways = bonds.motion(model, places, angle)
    state, normal, shear, loose = faces_in(model, bonds, frame.contacts)
    r.compare(label + "faces without a row", int(np.sum(state < 0)), 0, 0)
    intact, scale = state == 0, bonds.tensile.mean()
    cells = pressures_of(model, bonds, motion, intact, normal, shear)
    mean, skewing = bonds.stretched(cells.value)
    error = bonds.length * (np.abs(bonds.share_i) * cells.error[bonds.i] + np.abs(bonds.share_j) * cells.error[bonds.j])
    ours = bonds.forces(opening, sliding, turn, cells.value)
    r.rows(label + "normal_force of intact faces", -normal[intact], -ours[0][intact], rounding * scale)
    r.rows(label + "shear_force of intact faces", shear[intact], ours[1][intact], rounding * scale)
    r.compare(label + "intact faces beyond their envelope", int(np.sum(beyond_envelope(bonds, normal, shear, ours[2], scale)[intact])), 0, 0)
    laps, broken = Laps(model, bonds, motion), np.flatnonzero(~intact)
    known = cells.known[bonds.i] & cells.known[bonds.j]
    contact = np.zeros((len(state), 4))
    for k in broken:
        contact[k] = laps.contact(k, mean[k])
    asked = broken[known[broken]]
    if len(asked) < len(broken):
        r.leave("frames: broken faces of cells without intact ones, and energies then", "the pressures of these cells are in no file")
    pull = keeps_tension(r, model, bonds, laps, contact, mean)
    settled = intact | (known & ~pull)
    if np.any(pull[asked]):
        r.leave("frames: faces that may keep a tension, and energies then", "how far a face has been damaged is in no frame")
        asked = asked[~pull[asked]]
    r.rows(label + "normal_force of broken faces", -normal[asked], -contact[asked, 0], rounding * (scale + np.abs(normal[asked])) + error[asked])
    touching = np.abs(contact[asked, 0]) > error[asked] + rounding * scale
    r.compare(label + "broken faces that press again", int(np.sum(state[asked[touching]] != 3)), 0, 0)
    # Cohesion acts after a failure in shear only, and only if slip has not used it up.
    limit = bonds.residual_friction * np.maximum(0.0, -normal) + np.where(bonds.softens & failed_in_shear(r, model, bonds), bonds.cohesion, 0.0)
    r.compare(label + "broken faces beyond their friction", int(np.sum((np.abs(shear) > limit * (1 + rounding) + rounding * scale)[broken])), 0, 0)

    # Forces on the bodies: faces first, then contact points.
    points = model.points(places, angle)
    chosen = points_in(model, frame, loose, points)
    r.compare(label + "contacts without a partner", int(np.sum(chosen < 0)), 0, 0)
    loose, q = loose[chosen >= 0], points.chosen(chosen[chosen >= 0])
    stated, rubbing = (np.asarray(frame.contacts[name])[loose] for name in ("normal_force", "shear_force"))
    of_face = {frozenset(pair): k for k, pair in enumerate(zip(bonds.i.tolist(), bonds.j.tolist()))}
    face = np.array([of_face.get(frozenset(pair), -1) for pair in zip(q.i.tolist(), q.j.tolist())], int)
    kn, ks, free = model.normal_stiffness(q), model.shear_stiffness(q), face < 0
    r.rows(label + "normal_force of contacts without a face", stated[free], (kn * q.overlap)[free], rounding * scale)
    # A force-free overlap of points that replace a face only reduces their force.
    share = np.maximum(least_of_points, 1 - np.where(intact, 1.0, laps.q)[face])
    most = np.where(free, math.inf, share * kn * np.maximum(0.0, q.overlap))
    r.compare(label + "points that bear more than their share of a face", int(np.sum(np.abs(stated) > most * (1 + 2 * single) + rounding * scale)), 0, 0)
    sure = np.ones(len(model.mass), bool)
    sure[q.i[~free]] = sure[q.j[~free]] = False
    dashed = bonds.dashpots(model)
    middle = (ways[0] + ways[1]) / 2
    tangent = turned(across)
    way = relative_motion_of(bonds, middle, places, velocity, spin)
    # The pressed part of a broken face keeps its dashpots, that of the shear spring while it sticks.
    acts = np.where(intact, 1.0, laps.q * contact[:, 3] / bonds.length)
    slides = ~intact & (np.abs(shear) >= limit * (1 - rounding))
    rates = dot(way, across), dot(way, tangent), spin[bonds.j] - spin[bonds.i]
    damped = [share * c * rate for share, c, rate in zip((acts, np.where(slides, 0.0, acts), acts), dashed, rates)]
    moment = np.where(intact, ours[2], contact[:, 1])
    springs = across * normal[:, None] + tangent * shear[:, None]
    face_force = springs + across * damped[0][:, None] + tangent * damped[1][:, None]
    cn, cs = model.dashpots(q)
    arm_i, arm_j, relative = relative_motion(q, places, velocity, spin)
    along = turned(q.normal)
    friction = model.residual_friction(q) * np.maximum(0.0, stated)
    sticks = np.abs(rubbing) < friction * (1 - rounding)
    point_springs = -q.normal * stated[:, None] + along * rubbing[:, None]
    dragged = cn * dot(relative, q.normal), np.where(sticks, cs * dot(relative, along), 0.0)
    point_force = point_springs - q.normal * dragged[0][:, None] - along * dragged[1][:, None]
    total, torque, sums = np.zeros_like(velocity), np.zeros(len(spin)), np.zeros((len(spin), 3))
    for bodies, at, force, spring, turns in ((((bonds.i, 1.0), (bonds.j, -1.0)), middle, face_force, springs, moment + damped[2]),
                                             (((q.i, 1.0), (q.j, -1.0)), q.position, point_force, point_springs, np.zeros(len(q.i)))):
        for body, sign in bodies:
            arm = at - places[body]
            np.add.at(total, body, sign * force)
            np.add.at(torque, body, sign * (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0] + turns))
            f = sign * spring
            sym = np.stack([arm[:, 0] * f[:, 0], arm[:, 1] * f[:, 1], (arm[:, 0] * f[:, 1] + arm[:, 1] * f[:, 0]) / 2], 1)
            np.add.at(sums, body, -sym / model.area[body][:, None])
    stress_top, stress_bottom = model.sense * total[model.top, 1] / model.width, -model.sense * total[model.bottom, 1] / model.width
    fine = rounding * scale * math.sqrt(len(state)) / model.width
    held = sure[model.top] and sure[model.bottom] and np.all(settled[bonds.j >= model.count])
    if held:
        r.compare(label + "axial_stress", frame.axial_stress, (stress_top + stress_bottom) / 2, fine)
    if not np.all(sure):
        for figure in ("normal_force, axial_stress and stresses", "strain_energy and kinetic_energy"):
            r.leave(f"frames: {figure} where points replace a face", "the overlap at which they were listed is in no frame")
    compare_stresses(r, model, label, p, order[sure[order]], sums, scale, sure[order])
    recount_pieces(r, model, label, frame, order)
    if row is None:
        return
    c = r.curve
    if held:
        r.compare(label + "curve: stress_top", c["stress_top"][row], stress_top, fine)
        r.compare(label + "curve: stress_bottom", c["stress_bottom"][row], stress_bottom, fine)
    confined = r.summary["kind"] == "biaxial"
    if not confined:
        recount_gauges(r, model, bonds, label, row, places)
    if not (np.all(sure) and np.all(settled)):
        return
    stored = np.where(intact, bonds.kn * opening**2 + bonds.kt * sliding**2 + bonds.turning * turn**2, 0.0) / 2
    soft = bonds.length / bonds.kn
    bent = (shear - bonds.length * skewing) ** 2 / bonds.kt / 2
    stored += np.where(intact, 0.0, contact[:, 2] - soft * mean * contact[:, 0] + soft * bonds.length * mean**2 / 2 + bent)
    has = model.pressure_per_area > 0
    pressed = np.sum(cells.value[has] ** 2 / model.pressure_per_area[has]) / 2
    springs = np.sum(stated**2 / kn + rubbing**2 / ks) / 2
    lag = late * np.sum((soft * bonds.length * mean**2)[~intact])
    energy = stored.sum() + pressed + springs
    r.compare(label + "curve: strain_energy", c["strain_energy"][row], energy, rounding * (energy + scale**2 / bonds.kn.mean()) + lag)
    if confined and row > 0:
        r.leave("frames: kinetic_energy under a pressure", "the membrane's forces, which are part of a kick, are in no file")
    elif np.any(r.events["step"] == c["step"][row]):
        r.leave("frames: kinetic_energy in the step of a break", "the pressures before it are in no frame")
    else:
        recount_kinetic(r, model, label, row, velocity, spin, total, torque)
