# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of bodies: areas, centroids, outlines moved outwards."""

import numpy as np


def cross(a, b):
    """Vector product of two vectors in the plane; for single vectors much faster than numpy's."""
    return a[0] * b[1] - a[1] * b[0]


def polygon_moments(corners):
    """Area, centroid and polar second moment about the centroid of a polygon, by Green's theorem."""
    shift = corners.mean(axis=0)
    x, y = (corners - shift).T
    u, v = np.roll(x, -1), np.roll(y, -1)
    cross = x * v - u * y
    area = cross.sum() / 2
    cx, cy = ((x + u) * cross).sum() / (6 * area), ((y + v) * cross).sum() / (6 * area)
    about_shift = (cross * (x * x + x * u + u * u + y * y + y * v + v * v)).sum() / 12
    return area, shift + (cx, cy), about_shift - area * (cx * cx + cy * cy)


def outset(corners, by):
    """A convex outline, counter-clockwise, with every edge moved outwards."""
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.hypot(*along.T)[:, None]
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    before = np.roll(out, 1, axis=0)
    return corners + by * (before + out) / (1 + np.einsum("ij,ij->i", before, out))[:, None]


def clump_centre(circles):
    """@param circles  rows x, y, radius"""
    area = circles[:, 2] ** 2
    return (area[:, None] * circles[:, :2]).sum(axis=0) / area.sum() if len(area) > 1 else circles[0, :2]


def centroid(body):
    return polygon_moments(body.corners)[1] if body.circles is None else clump_centre(body.circles)
