# SPDX-License-Identifier: GPL-3.0-or-later
"""Which points are bonded, their share of a face, and what they stand (solver/MODEL.md 4.5 and 5)."""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from model import Points

least_facing = 0.9  # minus the cosine between edges that face each other: those of a mesh lie parallel
overhang = 0.05  # of bond.thick: gap at which corners of polygons are still bonded, if bond.gap is not given
_all_bits = (1 << 64) - 1


@dataclass
class Bonds(Points):
    """Bonded points; `overlap` is δ0."""

    held: np.ndarray  # never breaks and never slides
    tensile: np.ndarray  # N, T; by back-tension k_n δ0
    cohesion: np.ndarray  # N, C; by back-tension μ k_n δ0


def mixed(x):
    """SplitMix64 (Steele, Lea, Flood 2014)."""
    x = (x + 0x9E3779B97F4A7C15) & _all_bits
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & _all_bits
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & _all_bits
    return x ^ (x >> 31)


def root_between(f, low, high):
    """By bisection of a monotonous function."""
    rises = f(high) > f(low)
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if (f(middle) > 0) == rises else (middle, high)
    return (low + high) / 2


def quantile_of(distribution, cv):
    """Quantile function of a random factor of mean 1."""
    if distribution == "lognormal":
        s = math.sqrt(math.log1p(cv * cv))
        return lambda p: math.exp(s * NormalDist().inv_cdf(p) - s * s / 2)
    if distribution == "weibull":
        def excess(m):
            return math.exp(math.lgamma(1 + 2 / m) - 2 * math.lgamma(1 + 1 / m)) - 1 - cv * cv

        m = root_between(excess, 0.2, 1e5)
        return lambda p: (-math.log1p(-p)) ** (1 / m) / math.gamma(1 + 1 / m)

    # A normal distribution of mean 1 and deviation s before it is truncated at 0, then scaled to a mean of 1.
    def truncated(s):
        ratio = NormalDist().pdf(1 / s) / NormalDist().cdf(1 / s)
        mean = 1 + s * ratio
        return mean, s * math.sqrt(1 - ratio / s - ratio * ratio) / mean

    s = root_between(lambda x: truncated(x)[1] - cv, 0.5e-4, 1e3)
    mean, below = truncated(s)[0], NormalDist().cdf(-1 / s)
    return lambda p: (1 + s * NormalDist().inv_cdf(below + p * (1 - below))) / mean


def factors(results, ids_a, ids_b):
    """Random factor of each pair of bodies' ids."""
    distribution = results.key("bond", "strength_distribution", "none")
    if distribution == "none":
        return np.ones(len(ids_a))
    quantile = quantile_of(distribution, results.key("bond", "strength_cv"))
    seed = mixed(results.key("bond", "strength_seed") & _all_bits)

    def one(a, b):
        bits = mixed(seed ^ (min(a, b) << 32 | max(a, b)))
        return quantile(((bits >> 11) + 0.5) * 2.0**-53)

    return np.array([one(int(a), int(b)) for a, b in zip(ids_a, ids_b)])


def outset(corners, by):
    """A convex outline, counter-clockwise, with every edge moved outwards."""
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.hypot(*along.T)[:, None]
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    before = np.roll(out, 1, axis=0)
    return corners + by * (before + out) / (1 + np.einsum("ij,ij->i", before, out))[:, None]


def face(model, i, j, gap):
    """Length in which two bodies face each other and the distance of their centroids across it; None if nowhere.

    @param i  the one with the smaller id"""
    best = None
    outlines = [outset(model.centre[b] + model.outline[b, : model.corner_count[b]], gap / 2) for b in (i, j)]
    for k, a in enumerate(outlines[0]):
        to = outlines[0][(k + 1) % len(outlines[0])] - a
        long = math.hypot(*to)
        to = to / long
        for m, b in enumerate(outlines[1]):
            other = outlines[1][(m + 1) % len(outlines[1])] - b
            if to @ other > -least_facing * math.hypot(*other) or abs(np.cross(to, b + other / 2 - a)) > gap:
                continue
            length = min(long, to @ (b - a)) - max(0.0, to @ (b + other - a))
            if length > 0 and (best is None or length > best[0]):
                best = (length, b, other / math.hypot(*other))
    if best is None:
        return None
    length, at, along = best  # of a platen, which is the second, its own line
    if j >= model.count:
        return length, abs(np.cross(along, model.centre[i] - at))
    return length, math.dist(model.centre[i], model.centre[j])


def share_faces(model, p):
    """Shares of bonded points: of the stiffness, and of the length that strengths in Pa act on, m."""
    stiffness, length = p.share.copy(), model.lengths(p)
    if not model.polygons:
        return stiffness, length
    by_pair = {}
    for k, pair in enumerate(zip(p.i.tolist(), p.j.tolist())):
        by_pair.setdefault(frozenset(pair), []).append(k)
    for own in by_pair.values():
        # Corners overhang: the least gap is that of the faces. Edges lie over those of the body with the smaller id.
        i, j = sorted((int(p.i[own[0]]), int(p.j[own[0]])), key=lambda b: model.ids[b])
        found = face(model, i, j, np.min(model.thick - p.overlap[own]))
        if found is not None:
            stiffness[own] = found[0] / found[1] / len(own)
            length[own] = found[0] / len(own)
    return stiffness, length


def single(values):
    """As kept in single precision."""
    return values.astype(np.float32).astype(float)


def make_bonds(model, points):
    """Bonded points of the specimen at rest, among all that come near. The model learns their shares."""
    case = model.results.key
    gap = np.zeros(len(points.i))
    if model.coulomb and model.polygons:
        gap += case("bond", "gap", overhang * model.thick)
    on_platen = (points.i >= model.count) | (points.j >= model.count)
    if model.coulomb and not model.polygons:
        radius = np.zeros(len(model.mass))
        radius[model.circle_body] = model.circle_radius
        gap = np.where(on_platen, 0.0, case("bond", "range", 0.0) * (radius[points.i] + radius[points.j]) / 2)
    p = points.chosen((points.overlap + gap > 0) & ~(on_platen & model.frictional))
    length = np.ones(len(p.i))
    if model.by_area:
        p.share, length = share_faces(model, p)
        p.share = single(p.share)
        model.remember_shares(p)
    held = np.zeros(len(p.i), bool)
    if case("loading", "platens") == "glued":
        depth = case("loading", "grip", 0.0) * model.height
        y = p.position[:, 1]
        held = (p.i >= model.count) | (p.j >= model.count) | (y < model.deck.y1 + depth) | (y > model.deck.y2 - depth)
    tension = model.normal_stiffness(p) * p.overlap
    if not model.coulomb:
        return Bonds(**p.fields(), held=held, tensile=tension, cohesion=model.friction(p) * tension)
    ids = np.array(model.ids)
    each = single(length * factors(model.results, ids[p.i], ids[p.j]))
    given = {}
    for name, factor in (("tensile_strength", "tensile_factor"), ("cohesion", "cohesion_factor")):
        times = case("bond", factor)
        given[name] = each * (model.weaker(name, p) if times is None else times * tension.mean())
    return Bonds(**p.fields(), held=held, tensile=given["tensile_strength"], cohesion=given["cohesion"])
