# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinds of test without two parallel platens: the reference of their stress and strain, and figures at the peak. Their bonds and frames are
not recounted."""
import math

import numpy as np

from measures import recount_energies

default_notch = 0.5  # notch length of a half disc over its radius
default_span = {"bending": 4.0, "scb": 0.8}  # span over the depth (bending), over the diameter (scb)
default_half_angle = 10.0  # degrees


def hondros(alpha):
    """Stress at the centre of a disc over 2P/(πD) by uniform pressure over arcs of half angle alpha, rad."""
    return (math.sin(2 * alpha) - alpha) / math.sin(alpha)


def notched_beam(a):
    """f(a/W) of ASTM E399 for S = 4W."""
    return 3 * math.sqrt(a) * (1.99 - a * (1 - a) * (2.15 - 3.93 * a + 2.7 * a**2)) / (2 * (1 + 2 * a) * (1 - a) ** 1.5)


def half_disc(b, s):
    """Y' of ISRM 2014. @param b a/R @param s span over diameter"""
    return -1.297 + 9.516 * s - (0.47 + 16.457 * s) * b + (1.071 + 34.401 * s) * b**2


def recount_kind(r):
    recount_energies(r)
    key, s, kind = r.results.key, r.summary, r.summary["kind"]
    width, height = s["initial_width"], s["initial_height"]
    suffix = "" if s["failed"] else "_so_far"
    peak = r.curve["axial_stress"][r.peak] if r.peak is not None else math.nan
    intensity = None  # stress intensity factor K_I over the nominal stress
    if kind == "brazilian":
        alpha = math.radians(key("loading", "half_angle", default_half_angle))
        even = key("loading", "platens") != "frictional" or key("loading", "jaws", "arc") == "arc"
        section, length = math.pi * width / 2 / (hondros(alpha) if even else 1.0), width
        r.key("initial_height", width)
    elif kind == "bending":
        span = key("loading", "span", default_span[kind] * height)
        r.key("span", span)
        section, length = 2 * height**2 / (3 * span), span**2 / (6 * height)
        notch = key("shape", "notch")
        if notch is not None:
            intensity = 2 / 3 * math.sqrt(height) * notched_beam(notch / height)
            r.key("notch", notch)
    elif kind == "scb":
        span = key("loading", "span", default_span[kind] * width)
        r.key("span", span)
        section, length = width, width / 2
        r.key("initial_height", width / 2)
        notch = key("shape", "notch", default_notch * width / 2)
        intensity = half_disc(2 * notch / width, span / width) * math.sqrt(math.pi * notch)
        r.key("notch", notch)
    elif kind != "direct_shear":
        raise ValueError(f"found a test of the kind {kind}, which the recount does not know")
    else:
        section = length = width
        normal = key("loading", "normal_stress")
        r.key("normal_stress", normal)
        recount_box(r, height, length, normal * width, key("loading", "normal_stiffness", 0.0) * width)
    r.key("stress_section", section)
    r.key("strain_length", length)
    if r.peak is not None:
        r.key("peak_force" + suffix, peak * section)
        if intensity is not None:
            r.key("fracture_toughness" + suffix, r.curve["axial_stress"].max() * intensity)


def recount_box(r, height, length, force, spring):
    """@param force N, pressing the upper half box down  @param spring N/m, by which the force grows with the rise"""
    c = r.curve
    rise = c["lateral_strain"] * height
    r.key("dilation_end", rise[-1])
    if spring > 0.0:
        r.key("normal_stress_end", (force + spring * rise[-1]) / length)
        if r.peak is not None:
            r.key("normal_stress_at_peak" + ("" if r.summary["failed"] else "_so_far"), (force + spring * rise[r.peak]) / length)
    # The work of the normal force is minus its mean times the rise, up to the rounding of a sum over steps.
    r.rows("curve: confinement_work", c["confinement_work"], -(force + 0.5 * spring * rise) * rise,
           1e-9 * (force + spring * np.max(np.abs(rise))) * np.max(np.abs(rise)) + 1e-12 * np.abs(c["platen_work"]) + 1e-15 * np.max(np.abs(c["platen_work"])))
    if r.summary["ended_by"] == "max_axial_strain":
        r.key("residual_stress", c["axial_stress"][c["axial_strain"] >= 0.9 * c["axial_strain"][-1]].mean())
    if r.peak is None:
        return
    at, c = c["axial_strain"][r.peak], r.judged
    near = np.abs(c["axial_strain"] - at) <= 0.1 * at
    if near.sum() >= 3:
        slope = np.polyfit(c["axial_strain"][near] * length, c["lateral_strain"][near] * height, 1)[0]
        r.key("dilation_angle_at_peak", math.degrees(math.atan(slope)), floor=1e-6)
