# SPDX-License-Identifier: GPL-3.0-or-later
"""Which points are bonded, their shares of faces, and their strengths (solver/MODEL.md 4.5 and 5)."""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from model import Points, single
from outlines import cross, outset

least_facing = 0.9  # minus the cosine between edges that face each other, which are parallel in a mesh
least_lap, flush = 0.01, 1e-9  # fractions of the mean radius; flush: rounding of flat faces that touch without overlap
facing_share = 1e-6  # fraction of bond.thick: rounding for touching faces of an open joint
parallel_within = 1e-6  # sine of the angle between edges on the same trace: rounding of corners
overhang = 0.05  # fraction of bond.thick: largest gap at which corners of polygons are bonded, if bond.gap is not given
_all_bits = (1 << 64) - 1


@dataclass
class Bonds(Points):
    """Bonded points; `overlap` is δ0."""

    held: np.ndarray  # true if it never breaks and never slides
    tensile: np.ndarray  # N, T; for back-tension k_n δ0
    cohesion: np.ndarray  # N, C; for back-tension μ k_n δ0


def mixed(x):
    """SplitMix64 (Steele, Lea, Flood 2014)."""
    x = (x + 0x9E3779B97F4A7C15) & _all_bits
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & _all_bits
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & _all_bits
    return x ^ (x >> 31)


def root_between(f, low, high):
    """Root of a monotonic function, by bisection."""
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

    # A normal distribution with mean 1 and standard deviation s is truncated at 0 and then scaled to a mean of 1.
    def truncated(s):
        ratio = NormalDist().pdf(1 / s) / NormalDist().cdf(1 / s)
        mean = 1 + s * ratio
        return mean, s * math.sqrt(1 - ratio / s - ratio * ratio) / mean

    s = root_between(lambda x: truncated(x)[1] - cv, 0.5e-4, 1e3)
    mean, below = truncated(s)[0], NormalDist().cdf(-1 / s)
    return lambda p: (1 + s * NormalDist().inv_cdf(below + p * (1 - below))) / mean


def factors(results, ids_a, ids_b):
    """Random strength factor of each pair of bodies."""
    distribution = results.key("bond", "strength_distribution", "none")
    if distribution == "none":
        return np.ones(len(ids_a))
    quantile = quantile_of(distribution, results.key("bond", "strength_cv"))
    seed = mixed(results.key("bond", "strength_seed") & _all_bits)

    def one(a, b):
        bits = mixed(seed ^ (min(a, b) << 32 | max(a, b)))
        return quantile(((bits >> 11) + 0.5) * 2.0**-53)

    return np.array([one(int(a), int(b)) for a, b in zip(ids_a, ids_b)])


@dataclass
class Face:
    """The face between two bodies; the first body is the one with the smaller id."""

    length: float  # m
    distance: float  # m, between the centroids; for a platen from the centroid to the middle of the gap
    begin: np.ndarray  # along the edge of the first body, in the middle of the gap
    end: np.ndarray
    parallel: bool  # whether both edges are parallel


def face(model, i, j, gap):
    """The face between two bodies; None if no edges face each other. @param i  the body with the smaller id"""
    best = None
    outlines = [outset(model.centre[b] + model.outline[b, : model.corner_count[b]], gap / 2) for b in (i, j)]
    for k, a in enumerate(outlines[0]):
        to = outlines[0][(k + 1) % len(outlines[0])] - a
        long = math.hypot(*to)
        to = to / long
        for m, b in enumerate(outlines[1]):
            other = outlines[1][(m + 1) % len(outlines[1])] - b
            if to @ other > -least_facing * math.hypot(*other) or abs(cross(to, b + other / 2 - a)) > gap:
                continue
            start, stop = max(0.0, to @ (b + other - a)), min(long, to @ (b - a))
            if stop > start and (best is None or stop - start > best[0]):
                best = (stop - start, b, other / math.hypot(*other), a + start * to, a + stop * to, to)
    if best is None:
        return None
    length, at, along, begin, end, to = best  # a platen is always the second body
    held = j >= model.count
    distance = abs(cross(along, model.centre[i] - at)) if held else math.dist(model.centre[i], model.centre[j])
    return Face(length, distance, begin, end, abs(cross(to, along)) < parallel_within)


def faces_of(model, p):
    """Faces of the pairs of polygons to which these points belong, by pair, with the smaller id first."""
    found = {}
    for pair, own in by_pairs(p).items() if model.polygons else ():
        i, j = sorted(pair, key=lambda b: model.ids[b])
        # Corners may overhang, so the smallest gap is that of the faces.
        one = face(model, i, j, np.min(model.thick - p.overlap[own]))
        if one is not None:
            found[i, j] = one
    return found


def share_faces(model, p, faces):
    """Sets the stiffness shares of bonded points. @return length on which a strength in Pa acts, m"""
    flat = ~np.isnan(p.lap)
    length, distance, count = np.where(flat, 1.0, model.lengths(p)), model.distances(p), np.ones(len(p.i))
    own = by_pairs(p)
    for pair, found in faces.items():
        of_pair = own.get(frozenset(pair), [])
        length[of_pair], distance[of_pair], count[of_pair] = found.length, found.distance, len(of_pair)
    left, left_of_shear = model.across_joint(p, distance)
    lap = np.where(flat, p.lap, 1.0)  # shares of flat faces are stored per metre of lap
    p.share = single(length / distance / count * left) * lap
    p.shear_share = p.share * single(np.sqrt(left_of_shear / left)) ** 2
    return length / count * lap


def faces_on_traces(model, p, faces):
    """Middle (m) and length of each face that is listed as on a trace, by the ids of its bodies."""
    found = {}
    for pair, own in by_pairs(p).items():
        ids = frozenset(model.ids[b] for b in pair)
        if ids in model.joints.pairs:
            one = faces.get(tuple(sorted(pair, key=lambda b: model.ids[b])))
            found[ids] = p.position[own].mean(axis=0), p.lap[own].sum() if one is None else one.length
    return found


def by_pairs(p):
    """Indices of the points of each pair of bodies."""
    pairs = {}
    for k, pair in enumerate(zip(p.i.tolist(), p.j.tolist())):
        pairs.setdefault(frozenset(pair), []).append(k)
    return pairs


def make_bonds(model, points):
    """Bonded points of the specimen at rest, selected from all points that come near. The model stores the properties that these keep."""
    case = model.results.key
    gap = np.zeros(len(points.i))
    if model.coulomb and model.polygons:
        gap += case("bond", "gap", overhang * model.thick)
    on_platen = (points.i >= model.count) | (points.j >= model.count)
    if model.coulomb and not model.polygons:
        radius = np.zeros(len(model.mass))
        radius[model.circle_body] = model.circle_radius
        gap = np.where(on_platen, 0.0, case("bond", "range", 0.0) * (radius[points.i] + radius[points.j]) / 2)
    flat = ~np.isnan(points.lap)
    if flat.any():
        radii = radius[points.i] + radius[points.j]
        gap = np.where(flat, np.where(points.lap > least_lap * radii / 2, flush * radii, -radii), gap)
    p = points.chosen((points.overlap + gap > 0) & ~(on_platen & model.frictional))
    ids, length = np.array(model.ids), np.ones(len(p.i))
    faces = faces_of(model, p) if model.by_area or model.joints.traces else {}
    model.learn_faces(faces)
    if model.polygons:
        p.trace = np.array([model.trace_of(i, j) for i, j in zip(p.i.tolist(), p.j.tolist())], int)
    is_open = model.joints.of("bonded", p.trace, 1.0) == 0
    # Overhanging corners have the properties of contacts that form later.
    facing = ~is_open | ~np.isnan(p.lap) | (p.overlap >= -facing_share * model.thick)
    p, is_open, length = p.chosen(facing), is_open[facing], length[facing]
    if model.by_area:
        length = share_faces(model, p, faces)
    p.rest = np.where(is_open, p.overlap + model.joints.of("aperture", p.trace, 0.0), model.rest_after(p.overlap))
    model.keep(p)
    model.on_traces = faces_on_traces(model, p, faces)
    model.closed = p.chosen(is_open & (model.sense > 0) & (model.joints.of("aperture", p.trace, 0.0) == 0))
    p, length = p.chosen(~is_open), length[~is_open]
    held = np.zeros(len(p.i), bool)
    if case("loading", "platens") == "glued":
        depth = case("loading", "grip", 0.0) * model.height
        y = p.position[:, 1]
        held = (p.i >= model.count) | (p.j >= model.count) | (y < model.deck.y1 + depth) | (y > model.deck.y2 - depth)
    tension = model.normal_stiffness(p) * p.overlap
    if not model.coulomb:
        return Bonds(**p.fields(), held=held, tensile=tension, cohesion=model.friction(p) * tension)
    each = single(length * factors(model.results, ids[p.i], ids[p.j]))
    given = {}
    for name, factor in (("tensile_strength", "tensile_factor"), ("cohesion", "cohesion_factor")):
        times = case("bond", factor)
        rock = model.weaker(name, p) if times is None else np.full(len(each), times * tension.mean())
        given[name] = each * model.strength(name, p, rock)
    return Bonds(**p.fields(), held=held, tensile=given["tensile_strength"], cohesion=given["cohesion"])
