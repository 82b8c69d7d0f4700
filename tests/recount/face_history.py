# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks, losses and energies of faces, from a test with a row and a frame per step and without contact points (solver/MODEL.md 5.5 and 8).

Follows the pressures of the cells, the slip and the damage of broken faces from frame to frame; `r`, `model` and `bonds` as in face_frames.py.
Forces are positive in tension."""

import math
from dataclasses import dataclass, replace

import numpy as np

from face_frames import Laps, lap_pressure, relative_motion_of
from frames import bodies_of
from model import dot, rounding, turned

settled, most_rounds = 1e-15, 1000  # when slip and pressure after a break no longer change


@dataclass
class Contact:
    """A broken face at some pressure of its cells: force (N), moment (N m), closed length (m), stretch q_n (m), energies (J)."""

    force: float
    moment: float
    closed: float
    stretch: float
    energy: float
    pull: float  # energy of the tension that an undamaged face would bear
    whole: float  # energy of the edges without q


@dataclass
class Broken:
    """A broken face after a step: what the next step and its losses need."""

    in_shear: bool
    held: float  # 1 - D
    slip: float = 0.0  # m, u_p
    path: float = 0.0  # m, sum of all |Δu_p|
    glued: float = 0.0  # m, b_c: least closed length since a failure in shear
    pressure: float = 0.0  # Pa, late pressure of the next step
    opening: float = 0.0
    sliding: float = 0.0
    turn: float = 0.0
    half_lap: float = 0.0
    skewing: float = 0.0
    shear: float = 0.0
    slipped: float = 0.0  # m, increase of u_p in the step
    stretch: float = 0.0
    late: tuple = (0.0, 0.0, 0.0)  # p̄, F_n and M beyond those of the late pressure
    ends: float = 0.0
    pull: float = 0.0
    taken: float = 0.0
    whole: float = 0.0
    energy: float = 0.0


class Follower:
    """Follows all faces from step to step; losses are totals, J. @param order  rows of events.csv by face: of several breaks in one step,
    each changes the pressures at the next"""

    def __init__(self, model, bonds, order):
        self.model, self.bonds, self.order = model, bonds, order
        self.broken, self.breaks = {}, []
        self.friction = self.fracture = self.lag = self.dashpot = 0.0
        self.dilated = np.zeros(len(model.mass))
        self.dashpot_force = np.zeros((3, len(bonds.i)))
        self.forces = np.zeros((3, len(bonds.i)))

    def contact(self, k, pressure, held):
        """The broken face k at a pressure p̄ of its cells."""
        b, laps = self.bonds, self.laps
        a, turn, q = laps.lap[k] / 2, laps.turn[k], laps.q[k]
        stiffness, soft = b.kn[k] / b.length[k], b.length[k] / b.kn[k]
        opening = laps.opening[k] + pressure * soft
        force, moment, energy, closed = lap_pressure(stiffness, a, opening, turn)
        pull = 0.0
        if held > 0:
            kn, kphi = 2 * a * stiffness, 2 * a**3 * stiffness / 3
            pull = (kn * opening**2 + kphi * turn**2) / 2 - energy
            force += held * (kn * opening - force)
            moment += held * (kphi * turn - moment)
            energy += held * pull
            closed += held * (2 * a - closed)
        whole, force, moment, energy, closed = energy, q * force, q * moment, q * energy, q * closed
        stretch = (force - b.length[k] * pressure) / b.kn[k]
        stored = energy - soft * pressure * force + soft * b.length[k] * pressure**2 / 2
        return Contact(force, moment, closed, stretch, stored, q * pull, whole)

    def held_after(self, k, pressure, held):
        """1 - D after a step: from the residual tension on, it falls to 0 over softening_opening."""
        b, a, stiffness = self.bonds, self.laps.lap[k] / 2, self.bonds.kn[k] / self.bonds.length[k]
        stress = stiffness * (self.laps.opening[k] + pressure / stiffness + b.moment_share[k] * a * abs(self.laps.turn[k]))
        residual = b.left_tension[k] / b.length[k]
        if held == 0.0 or a == 0:
            return 0.0
        if stress <= residual:
            return held
        steepness = 1 - residual / (stiffness * b.softening_opening[k]) if b.softening_opening[k] > 0 else -math.inf
        return min(held, max(0.0, 1 - (1 - residual / stress) / steepness)) if steepness > 0 else 0.0

    def cohesion(self, k, path):
        """What is left of the cohesion after a slip, Pa."""
        b = self.bonds
        whole, residual = b.cohesion[k] / b.length[k], b.left_cohesion[k] / b.length[k]
        return residual if not path < b.softening_slip[k] else residual + (whole - residual) * (1 - path / b.softening_slip[k])

    def slide(self, k, trial, stiffness, force, glued, path):
        """Slip that brings a shear force to its limit. @return slip, remaining force, and the force that works against a falling cohesion"""
        b, size, rubbing = self.bonds, abs(trial), self.limit(k, force)
        before, residual = self.cohesion(k, path), b.left_cohesion[k] / b.length[k]
        slip = max(0.0, size - rubbing - before * glued) / stiffness
        if slip == 0.0:
            return 0.0, trial, 0.0
        if path < b.softening_slip[k] and glued > 0:
            fall = (b.cohesion[k] / b.length[k] - residual) / b.softening_slip[k] * glued
            longer = slip * stiffness / (stiffness - fall) if fall < stiffness else math.inf
            slip = longer if path + longer < b.softening_slip[k] else (size - rubbing - residual * glued) / stiffness
        after = self.cohesion(k, path + slip)
        return math.copysign(slip, trial), math.copysign(rubbing + after * glued, trial), ((before + after) / 2 - residual) * glued

    def ends(self, k, pressure, held):
        """Mean of ½ k w² at both ends of the lap, N."""
        a, d = self.laps.lap[k] / 2, self.laps.opening[k] + pressure * self.bonds.length[k] / self.bonds.kn[k]
        square = [(1.0 if w < 0 else held) * w * w for w in (d - a * self.laps.turn[k], d + a * self.laps.turn[k])]
        return self.laps.q[k] * self.bonds.kn[k] / self.bonds.length[k] * sum(square) / 4

    def state(self, k, face, contact, pressure, skewing):
        laps = self.laps
        return replace(face, opening=laps.opening[k], sliding=laps.sliding[k], turn=laps.turn[k], half_lap=laps.lap[k] / 2, skewing=skewing,
                       stretch=contact.stretch, ends=self.ends(k, pressure, face.held), pull=contact.pull, taken=1 - laps.q[k], whole=contact.whole)

    def limit(self, k, force):
        """Residual friction, N."""
        return self.bonds.residual_friction[k] * max(0.0, -force)

    def step(self, step, places, angle, velocity, spin, dt):
        """Follows all faces to the next frame. @return strain energy, J"""
        model, b = self.model, self.bonds
        motion = opening, sliding, turn, across, ways = b.motion(model, places, angle)
        self.laps = Laps(model, b, motion)
        late, stretch, slide = {}, opening.copy(), sliding.copy()
        for k, face in self.broken.items():
            held = self.held_after(k, face.pressure, face.held)
            late[k] = self.contact(k, face.pressure, held)
            if held == 0.0 and face.held > 0:  # the loss of a tension that ends needs its energy
                late[k].pull = self.contact(k, face.pressure, face.held).pull
            stretch[k], slide[k] = late[k].stretch, sliding[k] - face.slip
            self.fracture += (face.pull + late[k].pull) / 2 * (face.held - held)
            face.held = held
        dilated = b.dilations(model, stretch, slide)
        self.pressure = model.pressure_per_area * dilated
        way = relative_motion_of(b, (ways[0] + ways[1]) / 2, places, velocity, spin)
        rates = np.array([dot(way, across), dot(way, turned(across)), spin[b.j] - spin[b.i]])
        forces = np.array(b.forces(opening, sliding, turn, self.pressure))
        intact = np.ones(len(b.i), bool)
        intact[list(self.broken)] = False
        failing = sorted((k for k in self.beyond(forces) if intact[k]), key=lambda k: self.order.get(k, k))
        for k in failing:
            self.part(step, k, forces[:, k], dilated - self.dilated, dt * rates[:, k])
            stretch[k], slide[k] = self.broken[k].stretch, sliding[k] - self.broken[k].slip
        self.dilated = b.dilations(model, stretch, slide)
        forces = np.array(b.forces(opening, sliding, turn, self.pressure))
        mean, skewing = b.stretched(self.pressure)
        shares, sticks = np.ones(len(b.i)), np.ones(len(b.i), bool)
        for k, face in list(self.broken.items()):
            if k not in late:
                contact = self.contact(k, mean[k], face.held)
                forces[:, k] = contact.force, face.shear, contact.moment
            else:
                contact = self.rub(k, face, late[k], mean[k], skewing[k])
                forces[:, k] = contact.force, self.broken[k].shear, contact.moment
            shares[k] = contact.closed / b.length[k] if k in late else 0.0  # a face that breaks has no dashpots in this step
            sticks[k] = self.broken[k].slipped == 0.0
        self.lose_to_dashpots(shares, sticks, rates, dt)
        self.forces = forces
        intact[failing] = False
        stored = np.sum((b.kn * opening**2 + b.kt * sliding**2 + b.turning * turn**2)[intact]) / 2
        has = model.pressure_per_area > 0
        return stored + sum(face.energy for face in self.broken.values()) + np.sum(self.pressure[has] ** 2 / model.pressure_per_area[has]) / 2

    def beyond(self, forces):
        """Faces beyond their envelope."""
        b = self.bonds
        parts = forces[0] + 6 * b.moment_share * np.abs(forces[2]) / b.length > b.tensile
        return np.flatnonzero(~b.held & (parts | (np.abs(forces[1]) > b.limits(-forces[0]))))

    def part(self, step, k, forces, dilated, moved):
        """Breaks a face, and finds the pressures of its two cells again, alternately with the slip.

        @param dilated  m², change of A e of all cells in the step @param moved  of the face in the step"""
        b, model = self.bonds, self.model
        i, j, long = b.i[k], b.j[k], b.length[k]
        tension = (forces[0] + 6 * b.moment_share[k] * abs(forces[2]) / long) / b.tensile[k]
        limit = b.limits_of(np.array([k]), np.array([-forces[0]]))[0]
        in_shear = not (tension > 1 and (abs(forces[1]) <= limit or tension >= abs(forces[1]) / limit))
        per = model.pressure_per_area[[i, j]]
        by_stretch, by_slide = np.array([b.share_i[k], b.share_j[k]]), np.array([b.skew_i[k], -b.skew_j[k]])
        before = self.pressure[[i, j]].copy()
        opening, sliding, turn = (values[k] for values in (self.laps.opening, self.laps.sliding, self.laps.turn))
        whole = np.array(b.chosen([k]).forces(opening, sliding, turn, self.pressure))[:, 0]
        face = Broken(in_shear, self.held_after(k, by_stretch @ before, 1.0) if in_shear else 0.0)
        slip, pressure = 0.0, by_stretch @ before
        coupled = long * (by_stretch @ (per * by_stretch)), long * (by_stretch @ (per * by_slide)), long * (by_slide @ (per * by_slide))
        for _ in range(most_rounds):
            for _ in range(most_rounds):  # Newton's method for the pressure at this slip
                contact = self.contact(k, pressure, face.held)
                rest = pressure - by_stretch @ before - coupled[0] * (contact.stretch - opening) + coupled[1] * slip
                pressure -= rest / (1 + coupled[0] * (long - contact.closed) / b.kn[k])
                if abs(rest) <= settled * (abs(pressure) + abs(by_stretch @ before)):
                    break
            contact = self.contact(k, pressure, face.held)
            skewing = by_slide @ before + coupled[1] * (contact.stretch - opening) - coupled[2] * slip
            shear = b.kt[k] * (sliding - slip) + long * skewing
            face.glued = contact.closed if in_shear else 0.0
            stiffness = b.kt[k] + long * coupled[2]  # with the pressures' answer to slip
            more = self.slide(k, shear, stiffness, contact.force, face.glued, abs(slip))[0] if in_shear else shear / stiffness
            if abs(more) <= settled * (abs(sliding) + abs(slip)):
                break
            slip += more
        after = before + per * long * (by_stretch * (contact.stretch - opening) - by_slide * slip)
        face.slip, face.path = slip, abs(slip)
        face.energy = contact.energy + b.kt[k] * (sliding - slip) ** 2 / 2
        self.pressure[[i, j]] = np.where(per > 0, after, 0.0)

        def stored(pressures):
            return np.sum((pressures**2 / np.where(per > 0, per, 1.0))[per > 0]) / 2

        energy = (b.kn[k] * opening**2 + b.kt[k] * sliding**2 + b.turning[k] * turn**2) / 2 - face.energy + stored(before) - stored(after)
        self.fracture += energy
        # Half the work of what the face and its cells lose has been done in this step.
        own = long * (by_stretch * moved[0] + by_slide * moved[1])
        lost = whole - np.array([contact.force, shear, contact.moment])
        self.lag -= (lost @ moved + np.where(per > 0, before - after, 0.0) @ (dilated[[i, j]] - own)) / 2
        face = self.state(k, face, contact, pressure, skewing)
        face.pressure, face.shear = pressure, shear
        self.broken[k] = face
        self.breaks.append((step, k, energy, in_shear, forces[0], forces[1]))

    def rub(self, k, face, late, mean, skewing):
        """Slides a broken face in a step, and adds up its losses. @return its contact at the pressure of its cells"""
        b = self.bonds
        now = self.contact(k, mean, face.held)
        state = self.state(k, face, late, face.pressure, skewing)
        state.late = mean - face.pressure, now.force - late.force, now.moment - late.moment
        trial = b.kt[k] * (self.laps.sliding[k] - face.slip) + b.length[k] * skewing
        state.glued = min(face.glued, now.closed)
        state.slipped, state.shear, falling = self.slide(k, trial, b.kt[k], now.force, state.glued, face.path)
        state.slip, state.path = face.slip + state.slipped, face.path + abs(state.slipped)
        self.fracture += falling * abs(state.slipped)
        self.friction -= falling * abs(state.slipped)
        self.friction += ((face.shear + state.shear) * state.slipped + b.length[k] * (face.skewing + skewing) * (face.slipped - state.slipped)) / 2
        self.friction += (face.ends + state.ends) * (face.half_lap - state.half_lap) + (face.whole + state.whole) / 2 * (state.taken - face.taken)
        p, f, m = (x + y for x, y in zip(face.late, state.late))
        self.lag += (f * (state.opening - face.opening) + m * (state.turn - face.turn) - b.length[k] * p * (state.stretch - face.stretch)) / 2
        state.energy = late.energy + b.kt[k] * (self.laps.sliding[k] - state.slip) ** 2 / 2
        state.pressure = mean
        self.broken[k] = state
        return now

    def lose_to_dashpots(self, shares, sticks, rates, dt):
        """Dashpots act on the pressed part of a broken face, that of the shear spring while it sticks."""
        b = self.bonds
        force = np.array(b.dashpots(self.model)) * rates * shares
        force[1] *= sticks
        self.dashpot += dt / 2 * np.sum((self.dashpot_force + force) * rates)
        self.dashpot_force = force


def recount_face_history(r, model, bonds, rows):
    c, e = r.curve, r.events
    index = {frozenset(pair): k for k, pair in enumerate(zip(bonds.i.tolist(), bonds.j.tolist()))}
    pairs = [frozenset((model.index[int(a)], model.index[int(b)])) for a, b in zip(e["body_i"], e["body_j"])]
    follower = Follower(model, bonds, {index.get(pair): n for n, pair in enumerate(pairs)})
    stored, losses, speed, worst = [], [], [], np.zeros(2)
    for n, row in enumerate(rows):
        frame = r.results.frame(row)
        if np.any(frame.contacts["state"] == 4):
            r.leave("history of faces", "contact points have replaced a broken face")
            return
        _, places, angle, velocity, spin = bodies_of(model, frame.particles)
        stored.append(follower.step(c["step"][n], places, angle, velocity, spin, c["time"][n] - c["time"][n - 1] if n else 0.0))
        losses.append((follower.dashpot, follower.friction, follower.fracture, follower.lag))
        speed.append(velocity[model.top, 1])
        at = [index[frozenset((model.index[i], model.index[j]))] for i, j in zip(frame.contacts["body_i"], frame.contacts["body_j"])]
        seen = -np.asarray(frame.contacts["normal_force"]), np.asarray(frame.contacts["shear_force"])
        worst = np.maximum(worst, [np.abs(seen[m] - follower.forces[m][at]).max() for m in (0, 1)])
    losses = np.array(losses).T
    strength, scale = bonds.tensile.max(), max(np.max(np.abs(losses)), c["platen_work"][-1])
    r.compare("history: normal forces of faces in all frames", worst[0], 0, rounding * strength)
    r.compare("history: shear forces of faces in all frames", worst[1], 0, rounding * strength)
    r.rows("history: strain_energy of faces", c["strain_energy"], stored, rounding * scale)
    for name, ours in zip(("dashpot_loss", "friction_loss", "fracture_loss"), losses):
        r.rows(f"history: {name}", c[name], ours, rounding * scale)
    closing = (c["kinetic_energy"] - c["kinetic_energy"][0] + c["strain_energy"] - c["strain_energy"][0] + c["dashpot_loss"] + c["friction_loss"]
               + c["fracture_loss"] - c["platen_work"])
    r.rows("history: energy_error with the lag's loss", c["energy_error"], closing + losses[3], rounding * scale)
    r.left.pop("curve: energy_error after breaks", None)
    force = (c["stress_top"][1:] + c["stress_top"][:-1]) / 2 * model.width
    work = np.concatenate([[0.0], np.cumsum(force * np.diff(c["axial_strain"]) * model.height)])
    work += model.mass[model.top] / 2 * (np.array(speed) ** 2 - speed[0] ** 2)
    r.rows("history: platen_work", c["platen_work"], work, rounding * work[-1])
    stated = sorted((e["step"][k], index.get(pair, -1), k) for k, pair in enumerate(pairs))
    expected = sorted(follower.breaks)
    if [s[:2] for s in stated] != [x[:2] for x in expected]:
        r.true("history: steps and pairs of events.csv", False)
        return
    at = [s[2] for s in stated]
    unit = (bonds.tensile**2 / 2 / bonds.kn).max()
    r.rows("history: energy of breaks", np.asarray(e["energy"])[at], [x[2] for x in expected], 10 * rounding * unit)
    r.compare("history: mode of breaks", sum((e["mode"][k] == "shear") != x[3] for k, x in zip(at, expected)), 0, 0)
    r.rows("history: normal force of breaks", np.asarray(e["normal_force"])[at], [-x[4] for x in expected], rounding * strength)
    r.rows("history: shear force of breaks", np.asarray(e["shear_force"])[at], [x[5] for x in expected], rounding * strength)
