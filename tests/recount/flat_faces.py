# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat faces of circles at straight traces (solver/MODEL.md 5.4): which circle has which part of a trace, and where two faces meet."""

import math
from dataclasses import dataclass

import numpy as np

depth_in_diameters = 2.0  # in diameters of the largest circle: distance from a trace up to which circles have a face
farthest_reach = 3.0  # radii on each side
fewest_neighbours, neighbour_gap, rounds = 2, 0.3, 4  # a circle is held by a side if it has this many neighbours there; gap over the mean radius


@dataclass
class Part:
    """A straight trace."""

    trace: int
    begin: np.ndarray
    along: np.ndarray  # unit vector
    length: float
    from_outside: bool
    to_outside: bool


def line_of(faces, own, table, deck):
    """A point of the straight trace on which faces lie, its direction, and the error of the direction.

    @param faces  joints.Faces  @param own  its faces  @param table  of the case  @return None if the trace is bent"""
    ends = np.concatenate([faces.middle[own] - faces.along[own] / 2, faces.middle[own] + faces.along[own] / 2])
    last = ends[np.argmax(np.hypot(*(ends - ends[0]).T))]
    at = ends[np.argmax(np.hypot(*(ends - last).T))]
    along = (last - at) / np.hypot(*(last - at))
    if np.abs(np.cross(along, ends - at)).max() > 1e-9 * (deck.width + deck.height) + 4 * faces.rounding:
        return None
    off = 4 * faces.rounding / np.hypot(*(last - at))
    exact = line_of_case(table)
    if exact is None or np.abs(np.cross(exact[1], ends - exact[0])).max() > 1e-9 * (deck.width + deck.height) + 4 * faces.rounding:
        return at, along, off
    return *exact, np.finfo(float).eps


def line_of_case(table):
    """Line of a joint set through a given point, or of a trace with two points; otherwise None."""
    points = table.get("points", [])
    if len(points) == 4:
        at, way = np.array(points[:2]), np.array(points[2:]) - points[:2]
        return at, way / np.hypot(*way)
    if "through" in table and table.get("orientation", "fixed") == "fixed":
        angle = math.radians(table["angle"])
        return np.array(table["through"]), np.array([math.cos(angle), math.sin(angle)])
    return None


def chord(at, along, deck):
    """Where a line enters and leaves the box, as distances along it, m."""
    low, high = -math.inf, math.inf
    for x, way, least, most in ((at[0], along[0], deck.x1, deck.x2), (at[1], along[1], deck.y1, deck.y2)):
        if way != 0.0:
            a, b = sorted(((least - x) / way, (most - x) / way))
            low, high = max(low, a), min(high, b)
    return low, high


def part_in_box(trace, faces, own, table, deck, stated):
    """The straight trace on which these faces lie; None if they do not determine its position and ends.

    @param stated  its length in the box, m"""
    line = line_of(faces, own, table, deck) if own.any() else None
    if line is None or line[2] > 1e-12 / (deck.width + deck.height):
        return None
    at, along, _ = line
    low, high = chord(at, along, deck)
    fine = 1e-9 * (deck.width + deck.height)
    if abs(high - low - stated) <= fine:
        return Part(trace, at + low * along, along, high - low, True, True)
    spots = np.concatenate([(faces.middle[own] + side * faces.along[own] / 2 - at) @ along for side in (-1, 1)])
    if abs(np.ptp(spots) - stated) <= fine:
        return Part(trace, at + spots.min() * along, along, np.ptp(spots),
                    abs(spots.min() - low) <= fine, abs(spots.max() - high) <= fine)
    return None


def share_trace(foot, distance, radius, length):
    """The part of a trace that belongs to each circle of one side, by their power diagram: the lower envelope of lines."""
    at_begin = foot**2 + distance**2 - radius**2
    envelope = []  # circles, and where their parts begin
    for k in sorted(range(len(foot)), key=lambda k: (foot[k], at_begin[k])):
        if envelope and foot[envelope[-1][0]] == foot[k]:
            continue
        start = 0.0
        while envelope:
            last, since = envelope[-1]
            start = (at_begin[k] - at_begin[last]) / (foot[k] - foot[last]) / 2
            if start > since:
                break
            envelope.pop()
        if not envelope:
            start = 0.0
        if start < length:
            envelope.append((k, start))
    ends = [start for _, start in envelope[1:]] + [length]
    return {k: (start, end) for (k, start), end in zip(envelope, ends)}


def take_sides(foot, height, radius):
    """@return which circles lie on the right of a trace, after circles have changed sides, and which are held by their side"""
    apart = np.hypot(foot[:, None] - foot, height[:, None] - height)
    beside = (apart <= (1 + neighbour_gap / 2) * (radius[:, None] + radius)) & ~np.eye(len(foot), dtype=bool)
    right, gone_over = height < 0, np.zeros(len(foot), bool)
    for _ in range(rounds):
        alike = right[:, None] == right
        own, others = np.sum(beside & alike, axis=1), np.sum(beside & ~alike, axis=1)
        held = own >= fewest_neighbours
        over = ~gone_over & ~held & (others >= fewest_neighbours)
        if not over.any():
            break
        right, gone_over = right ^ over, gone_over | over
    return right, held


@dataclass
class FlatFaces:
    """Faces on one straight part: bodies, their sides, and the ends of each face along the trace, m from the body's centre. height is the
    centre's distance from the trace."""

    part: Part
    body: np.ndarray
    right: np.ndarray
    start: np.ndarray
    stop: np.ndarray
    height: np.ndarray


def lay_faces(model, part):
    circle, radius = np.arange(model.count), np.zeros(len(model.mass))
    radius[model.circle_body] = model.circle_radius
    depth = depth_in_diameters * 2 * model.circle_radius.max()
    away = model.centre[circle] - part.begin
    foot, height = away @ part.along, np.cross(part.along, away)
    first = -depth if part.from_outside else 0.0
    last = part.length + (depth if part.to_outside else 0.0)
    near = (np.abs(height) <= depth) & (foot >= first) & (foot <= last)
    body, foot, height = circle[near], foot[near], height[near]
    r = radius[body]
    right, held = take_sides(foot, height, r)
    distance = np.where(right, -height, height)  # negative for circles that have changed sides
    start, stop, at = -r, r.copy(), np.minimum(r, distance)
    start[held & (foot > part.length)] = (part.length - foot)[held & (foot > part.length)]
    stop[held & (foot < 0)] = -foot[held & (foot < 0)]
    start[~held] = stop[~held] = 0.0
    for side in (False, True):
        own = np.flatnonzero(held & (right == side))
        for k, (a, b) in share_trace(foot[own], distance[own], r[own], part.length).items():
            m, reach = own[k], farthest_reach * r[own[k]]
            start[m], stop[m] = np.clip((a - foot[m], b - foot[m]), -reach, reach)
            at[m] = distance[m]
    return FlatFaces(part, body, right, start, stop, at)


def meetings(faces, centre):
    """All pairs of faces on opposite sides: bodies, overlap, lap (m, negative if they are apart), normal, place."""
    a, b = np.flatnonzero(~faces.right), np.flatnonzero(faces.right)
    a, b = (grid.ravel() for grid in np.meshgrid(a, b, indexing="ij"))
    i, j = faces.body[a], faces.body[b]
    way = centre[j] - centre[i]
    along = way @ faces.part.along
    normal = np.array([faces.part.along[1], -faces.part.along[0]])  # points from the left side to the right
    lap = np.minimum(faces.stop[a], along + faces.stop[b]) - np.maximum(faces.start[a], along + faces.start[b])
    overlap = faces.height[a] + faces.height[b] - way @ normal
    return i, j, overlap, lap, np.broadcast_to(normal, way.shape), (centre[i] + centre[j]) / 2
