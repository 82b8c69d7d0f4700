# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces between bonded polygons: geometry before the inset, springs, pressures of cells, strengths (solver/MODEL.md 5.5).

The polygons are moved outwards by half the gap. An edge that the inset has removed is missing, as in the program; there the cells lap a
little and have no face."""

import math
from dataclasses import dataclass

import numpy as np

from bonds import Bonds, factors
from model import dot, turned
from outlines import cross, outset, polygon_moments

least_distance = 0.2  # least h as a fraction of its mean; a reference point nearer to a free side or platen gives way to the centroid
free, lower, upper = -1, -2, -3  # in place of a neighbour: nothing, the lower and the upper end of the box
shortest = 1e-9  # fraction of the square root of a cell's area: shorter faces are rounding
along_one_line = 1e-7  # fraction of a cell by which two edges of one face may lie apart


@dataclass
class FaceBonds(Bonds):
    """Faces; `normal` points from i to j, `position` is the middle. Platens are always body j."""

    length: np.ndarray  # m
    kn: np.ndarray  # N/m
    kt: np.ndarray  # N/m
    share_i: np.ndarray  # s_i, s_j: shares of a cell's pressure
    share_j: np.ndarray
    skew_i: np.ndarray  # offset of the middle from each reference point along the tangent, over h
    skew_j: np.ndarray
    tan_friction: np.ndarray  # tan φ
    tan_beyond: np.ndarray  # tan φ2
    knee: np.ndarray  # Pa
    moment_share: np.ndarray  # β
    residual_friction: np.ndarray  # tan φ_r
    left_cohesion: np.ndarray  # N, cohesion after a failure in shear
    softening_slip: np.ndarray  # m, u_c, over which the cohesion falls
    softening_opening: np.ndarray  # m, w_c, over which the tensile strength after a failure in shear falls
    left_tension: np.ndarray  # N, tensile strength after a failure in shear

    @property
    def turning(self):
        """k_φ, N m."""
        return self.kn * self.length**2 / 12

    @property
    def softens(self):
        """Whether faces keep a cohesion after a failure in shear, if only over some slip."""
        return (self.softening_slip > 0) | (self.left_cohesion > 0)

    def motion(self, model, centre, angle):
        """δ_n, δ_t (m) and δ_φ (rad) of all faces, their normals, and the places of their middles on both bodies."""
        ways = []
        for body in (self.i, self.j):
            c, s = np.cos(angle[body]), np.sin(angle[body])
            arm = self.position - model.centre[body]
            ways.append(centre[body] + np.stack([c * arm[:, 0] - s * arm[:, 1], s * arm[:, 0] + c * arm[:, 1]], 1))
        mean = (angle[self.i] + angle[self.j]) / 2
        c, s = np.cos(mean), np.sin(mean)
        normal = np.stack([c * self.normal[:, 0] - s * self.normal[:, 1], s * self.normal[:, 0] + c * self.normal[:, 1]], 1)
        apart = ways[1] - ways[0]
        return dot(apart, normal), dot(apart, turned(normal)), angle[self.j] - angle[self.i], normal, ways

    def dilations(self, model, opening, sliding):
        """A e of every cell without its free sides, m²; platens have none."""
        total = np.zeros(len(model.mass))
        np.add.at(total, self.i, self.length * (self.share_i * opening + self.skew_i * sliding))
        np.add.at(total, self.j, self.length * (self.share_j * opening - self.skew_j * sliding))
        return total

    def stretched(self, pressure):
        """p̄ and τ of all faces, Pa, from the pressures of the bodies."""
        i, j = pressure[self.i], pressure[self.j]
        return self.share_i * i + self.share_j * j, self.skew_i * i - self.skew_j * j

    def forces(self, opening, sliding, turn, pressure):
        """F_n (tension positive), F_t and M of intact faces, N and N m. @param pressure  of the bodies, Pa"""
        mean, skewing = self.stretched(pressure)
        return self.kn * opening + self.length * mean, self.kt * sliding + self.length * skewing, self.turning * turn

    def forces_of(self, model, motion):
        """F_n, F_t and M of intact faces for small motions of the bodies. @param motion  rows x, y, rotation"""
        rows, _ = self.rows(model)
        both = np.concatenate([motion[self.i], motion[self.j]], axis=1)
        opening, sliding, turn = (np.einsum("fk,fk->f", g, both) for g in rows)
        return self.forces(opening, sliding, turn, model.pressure_per_area * self.dilations(model, opening, sliding))

    def rows(self, model):
        """Derivatives of δ_n, δ_t and δ_φ with respect to the displacements of both bodies, and where these are."""
        places = np.concatenate([3 * self.i[:, None] + np.arange(3), 3 * self.j[:, None] + np.arange(3)], axis=1)
        found = []
        for direction in (self.normal, turned(self.normal)):
            found.append(np.concatenate([
                sign * np.column_stack([direction, dot(turned(self.position - model.centre[body]), direction)])
                for body, sign in ((self.i, -1.0), (self.j, 1.0))], axis=1))
        found.append(np.tile([0.0, 0.0, -1.0, 0.0, 0.0, 1.0], (len(self.i), 1)))
        return found, places

    def dashpots(self, model):
        """c_n, c_t (N s/m) and c_φ (N m s), by the damping ratio of both materials."""
        held = self.j >= model.count
        mass, inertia = (np.where(held, m[self.i], m[self.i] * m[self.j] / (m[self.i] + m[self.j])) for m in (model.mass, model.inertia))
        ratio = model.series_of("ratio", self)
        return tuple(2 * ratio * np.sqrt(k * m) for k, m in ((self.kn, mass), (self.kt, mass), (self.turning, inertia)))

    def matrices(self, model):
        """Stiffness and damping matrices for all 3 N displacements, including the pressures of the cells."""
        size = 3 * len(model.mass)
        rows, places = self.rows(model)
        flat = (places[:, :, None] * size + places[:, None, :]).ravel()
        stiffness, damping = np.zeros(size * size), np.zeros(size * size)
        for g, k, c in zip(rows, (self.kn, self.kt, self.turning), self.dashpots(model)):
            outer = g[:, :, None] * g[:, None, :]
            stiffness += np.bincount(flat, (k[:, None, None] * outer).ravel(), size * size)
            damping += np.bincount(flat, (c[:, None, None] * outer).ravel(), size * size)
        weights = np.zeros((len(model.mass), size))
        for body, share, skew in ((self.i, self.share_i, self.skew_i), (self.j, self.share_j, -self.skew_j)):
            own = self.length[:, None] * (share[:, None] * rows[0] + skew[:, None] * rows[1])
            np.add.at(weights, (np.repeat(body, 6), places.ravel()), own.ravel())
        stiffness = stiffness.reshape(size, size) + weights.T @ (model.pressure_per_area[:, None] * weights)
        return stiffness, damping.reshape(size, size)

    def limits(self, compression):
        """Strength in shear, N. @param compression  N, negative in tension"""
        s = compression / self.length
        strength = self.tan_friction * np.minimum(s, self.knee) + self.tan_beyond * np.maximum(0.0, s - self.knee)
        return self.cohesion + self.length * strength

    def limits_of(self, rows, compression):
        """Strength in shear of some faces, N."""
        return self.chosen(rows).limits(compression)

    def load_to_failure(self, normal, shear, moment):
        """Factor on these forces at which each face fails. @param normal, shear  N, tension positive @param moment  N m"""
        tension = normal + 6 * self.moment_share * np.abs(moment) / self.length
        with np.errstate(divide="ignore", invalid="ignore"):
            parting = np.where(tension > 0, self.tensile / tension, math.inf)

            def sliding(cohesion, friction):
                rise = np.abs(shear) + friction * normal
                return np.where(rise > 0, cohesion / rise, math.inf)

            near = sliding(self.cohesion, self.tan_friction)
            far = sliding(self.cohesion + np.where(np.isinf(self.knee), 0.0, (self.tan_friction - self.tan_beyond) * self.knee * self.length),
                          self.tan_beyond)
            beyond = (normal < 0) & (np.where(np.isinf(near), 1e200, near) * -normal > self.knee * self.length)
        load = np.minimum(parting, np.where(beyond, far, near))
        load[self.held] = math.inf
        return load


def from_outlines(model):
    """Cells as rows (begin, end, neighbour), and their reference points: circumcentres of triangles, otherwise centroids. The polygons are
    moved outwards by half the gap; faces are where their edges lie on each other."""
    deck, by = model.deck, model.mesh_gap / 2
    outlines = [outset(b.corners, by) for b in deck.bodies]
    begins, ends = np.concatenate(outlines), np.concatenate([np.roll(o, -1, axis=0) for o in outlines])
    owner = np.repeat(np.arange(len(outlines)), [len(o) for o in outlines])
    low, high = (np.array([f(o, axis=0) for o in outlines]) for f in (np.min, np.max))
    cells, tolerance = [], along_one_line * math.sqrt(model.area[: model.count].mean())
    for k in range(len(outlines)):
        rows = []
        near = ((low <= high[k] + tolerance) & (high >= low[k] - tolerance)).all(axis=1)
        near[k] = False
        others = np.flatnonzero(near[owner])
        for a, b in zip(begins[owner == k], ends[owner == k]):
            long = math.dist(a, b)
            to = (b - a) / long
            c, d = begins[others] - a, ends[others] - a
            beside = np.maximum(np.abs(to[0] * c[:, 1] - to[1] * c[:, 0]), np.abs(to[0] * d[:, 1] - to[1] * d[:, 0])) <= tolerance
            start, stop = np.maximum(0.0, d @ to), np.minimum(long, c @ to)
            beside &= stop - start > tolerance
            covered = list(zip(start[beside].tolist(), stop[beside].tolist(), owner[others[beside]].tolist()))
            wall = next((n for n, y in ((lower, deck.y1), (upper, deck.y2)) if max(abs(a[1] - y), abs(b[1] - y)) <= tolerance), free)
            at = 0.0
            for start, stop, m in sorted(covered) + [(long, long, None)]:
                if start - at > tolerance:
                    rows.append((a + at * to, a + start * to, wall))
                if m is not None:
                    rows.append((a + start * to, a + stop * to, m))
                at = max(at, stop)
        cells.append(rows)
    points = np.array([circumcentre(o) if len(o) == 3 else polygon_moments(o)[1] for o in outlines])
    return cells, points


def circumcentre(triangle):
    a = triangle[0]
    b, c = triangle[1] - a, triangle[2] - a
    return a + np.array([c[1] * (b @ b) - b[1] * (c @ c), b[0] * (c @ c) - c[0] * (b @ b)]) / (2 * cross(b, c))


@dataclass
class Edges:
    """Parts of outlines before the inset: faces between i and j, or free sides of i (j is then -1)."""

    i: np.ndarray
    j: np.ndarray
    middle: np.ndarray  # m
    normal: np.ndarray  # out of i
    length: np.ndarray  # m


def split_edges(model, cells, area):
    """@return faces, each once, and free sides"""
    platens = {} if model.frictional else {lower: model.bottom, upper: model.top}
    found, sides = [], []
    for k, rows in enumerate(cells):
        for a, b, other in rows:
            long, other = math.dist(a, b), platens.get(other, other)
            if long <= shortest * math.sqrt(area[k]) or 0 <= other < k:
                continue
            out = np.array([b[1] - a[1], a[0] - b[0]]) / long
            (found if other >= 0 else sides).append((k, max(other, -1), (a + b) / 2, out, long))
    return (Edges(*(np.array([row[c] for row in rows]) for c in range(5))) for rows in (found, sides))


def make_faces(model):
    """All faces of the specimen and its platens. Sets model.pressure_per_area, λ/(A + λ Σ L h_b/E_c) in Pa/m², 0 for platens."""
    cells, points = from_outlines(model)
    if model.results.key("mesh", "kind") == "voronoi":
        points = np.array([b.circles[0, :2] for b in model.results.circles.bodies])
    area, centroid = (np.array(values) for values in zip(*(polygon_moments(np.array([a for a, _, _ in rows]))[:2] for rows in cells)))
    faces, sides = split_edges(model, cells, area)
    contact, pressure, kappa = (np.array([model.materials[m][name] for m in model.material]) for name in ("face_modulus", "pressure_modulus", "shear_share"))
    i, j, held = faces.i, faces.j, faces.j >= model.count
    at_i, at_j = points[i], points[np.where(held, 0, j)]
    to_i, to_j = dot(faces.middle - at_i, faces.normal), np.where(held, 0.0, dot(at_j - faces.middle, faces.normal))
    least = least_distance * (to_i + to_j)[~held].mean()
    near = held & (to_i < least)
    at_i = np.where(near[:, None], centroid[i], at_i)
    to_i = np.where(near, dot(faces.middle - at_i, faces.normal), to_i)
    # A distance h that is raised changes D, but not the distances of the reference points.
    soft = 1 / contact[i], 1 / contact[np.where(held, i, j)]
    series = np.where(to_i + to_j < least, least * (soft[0] + soft[1]) / 2, to_i * soft[0] + to_j * soft[1])
    across = [np.where(held, 0.0, dot(faces.middle - at, turned(faces.normal)) * s / series) for at, s in zip((at_i, at_j), soft)]
    model.pressure_per_area = np.zeros(len(model.mass))
    inside = slice(0, model.count)
    model.pressure_per_area[inside] = pressure[inside] / (area + pressure[inside] * softness_of_sides(sides, points, centroid, least, contact, model.count))
    kn, none, ids = faces.length / series, np.zeros(len(i)), np.array(model.ids)
    factor = factors(model.results, ids[i], ids[j])
    return FaceBonds(
        i=i, element=np.zeros(len(i), int), j=j, overlap=none, normal=faces.normal, position=faces.middle, share=none, shear_share=none,
        lap=np.full(len(i), math.nan), trace=np.full(len(i), -1), rest=none, held=never_breaks(model, faces), length=faces.length,
        kn=kn, kt=kn * np.where(held, kappa[i], np.sqrt(kappa[i] * kappa[np.where(held, i, j)])), share_i=to_i * soft[0] / series,
        share_j=to_j * soft[1] / series, skew_i=across[0], skew_j=across[1], **strengths(model, faces, factor))


def softness_of_sides(sides, points, centroid, least, contact, count):
    """Σ L h_b/E_c of the free sides of each cell, m²/Pa."""
    total = np.zeros(count)
    away, inner = (dot(sides.middle - at[sides.i], sides.normal) for at in (points, centroid))
    np.add.at(total, sides.i, sides.length * np.where(away < least, inner, away) / contact[sides.i])
    return total


def never_breaks(model, faces):
    """Which faces are those of glued platens, or lie within the grips."""
    depth, y = model.results.key("loading", "grip", 0.0) * model.height, faces.middle[:, 1]
    beyond = (faces.j >= model.count) | (y < model.deck.y1 + depth) | (y > model.deck.y2 - depth)
    return beyond & (model.results.key("loading", "platens") == "glued")


def strengths(model, faces, factor):
    """Strengths and constants of faces: those of the pair of minerals, or the weaker of two materials; faces on platens have those of the
    cell. @param factor  random, for T and C"""
    held = faces.j >= model.count
    other = np.where(held, faces.i, faces.j)

    def weaker(name, take=np.minimum):
        values = np.array([model.materials[m][name] for m in model.material], float)
        mixed = take(values[faces.i], values[other])
        return np.where(held, mixed, model.overridden(name, faces, mixed))

    tensile, cohesion = (factor * weaker(name) for name in ("tensile_strength", "cohesion"))
    tangents = {of: np.tan(np.radians(weaker(name))) for of, name in (
        ("tan_friction", "friction_angle"), ("tan_beyond", "friction_angle_beyond"), ("residual_friction", "residual_friction_angle"))}
    return tangents | {
        "tensile": faces.length * tensile, "cohesion": faces.length * cohesion, "knee": weaker("friction_knee"),
        "moment_share": weaker("moment_share", np.maximum), "softening_slip": weaker("softening_slip"), "softening_opening": weaker("softening_opening"),
        "left_cohesion": faces.length * np.minimum(weaker("residual_cohesion"), cohesion),
        "left_tension": faces.length * np.minimum(weaker("residual_tensile_strength"), tensile)}
