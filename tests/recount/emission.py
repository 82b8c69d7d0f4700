# SPDX-License-Identifier: GPL-3.0-or-later
"""Acoustic events: ae.csv against the breaks in events.csv, and the figures of the summary (specimens/emission/METHODS.md)."""

import math

import numpy as np

from model import rounding


def cluster(events, diameter, speed):
    """Groups breaks into events. @return lists of row numbers of events.csv, in the order in which the events began"""
    open_events, ended = [], []
    for k, (time, x, y) in enumerate(zip(events["time"], events["x"], events["y"])):
        place = np.array([x, y])
        ended += [one for one in open_events if time > one["end"]]
        open_events = [one for one in open_events if time <= one["end"]]
        own = next((one for one in open_events if np.hypot(*(place - one["centre"])) <= one["radius"]), None)
        if own is None:
            own = {"rows": []}
            open_events.append(own)
        own["rows"].append(k)
        places = np.column_stack([events["x"], events["y"]])[own["rows"]]
        own["centre"] = places.mean(axis=0)
        own["radius"] = diameter + np.hypot(*(places - own["centre"]).T).max()
        own["end"] = time + 2 * own["radius"] / speed
    return sorted(ended + open_events, key=lambda one: one["rows"][0])


def share_below(half, x):
    """Distribution function of χ² with 2 `half` degrees of freedom, by the series of the incomplete gamma function."""
    x, term, total, k = x / 2, 1 / half, 1 / half, half
    while term > total * 1e-17:
        k += 1
        term *= x / k
        total += term
    return total * math.exp(-x + half * math.log(x) - math.lgamma(half))


def quantile(half, share):
    low, high = 0.0, 2 * half + 20 * math.sqrt(4 * half) + 50
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if share_below(half, middle) < share else (low, middle)
    return (low + high) / 2


def distance_from_law(above):
    above = np.sort(above)
    n, below = len(above), -np.expm1(-above / above.mean())
    return max(np.max(np.arange(1, n + 1) / n - below), np.max(below - np.arange(n) / n))


def recount_b(r, magnitudes):
    names = "b_value."
    completeness = math.nan
    if len(magnitudes) >= 50:
        bins, counts = np.unique(np.floor(magnitudes / 0.1), return_counts=True)
        completeness = (bins[np.argmax(counts)] + 0.5) * 0.1 + 0.2
    r.key(names + "completeness", completeness)
    above = magnitudes[magnitudes > completeness] - completeness if completeness == completeness else magnitudes
    n = len(above)
    r.key(names + "events", n)
    r.key(names + "few", n < 200)
    b = error = low = high = math.nan
    if n >= 50 and not math.isnan(completeness):
        aki = math.log10(math.e) / above.mean()
        b = aki * (n - 1) / n
        error = math.log(10) * b * b * math.sqrt(np.sum((above - above.mean()) ** 2) / (n * (n - 1)))
        low, high = (aki * quantile(n, share) / (2 * n) for share in (0.025, 0.975))
        d = distance_from_law(above)
        r.key(names + "straight", bool((d - 0.2 / n) * (math.sqrt(n) + 0.26 + 0.5 / math.sqrt(n)) < 1.094))
    r.key(names + "b", b)
    r.key(names + "error", error)
    stated = [math.nan if end is None else end for end in r.summary["b_value"]["interval"]]
    r.rows(names + "interval", stated, [low, high], rounding * (abs(b) if b == b else 0.0))
    # The stated magnitude must be one of the tried ones, and no other one may give a smaller distance from a line.
    other, tried = r.summary["b_value"]["least_distance"], np.sort(magnitudes)
    if other["completeness"] is None:
        r.true(names + "least_distance: none of fewer than 50", len(magnitudes) < 50 and other["b"] is None)
        r.keys.add(names + "least_distance.events")
        return
    stride = (len(tried) - 50) // 64 + 1
    distances = [(distance_from_law(tried[tried > m] - m), m) for m in tried[: len(tried) - 50 : stride] if np.sum(tried > m) >= 50]
    if not distances:
        return
    least = min(distances)[0]
    # If the distances at two magnitudes differ only by rounding, either magnitude is accepted.
    best = min((m for d, m in distances if d <= least + 1e-12), key=lambda m: abs(m - other["completeness"]))
    r.key(names + "least_distance.completeness", best)
    above = tried[tried > best] - best
    r.key(names + "least_distance.events", len(above))
    r.key(names + "least_distance.b", math.log10(math.e) / above.mean() * (len(above) - 1) / len(above))


def recount_emission(r, model):
    """Compares every row of ae.csv with its breaks and its own moments, and the summary with the rows."""
    a, e, s = r.results.emission, r.events, r.summary.get("emission")
    if a is None:
        r.true("emission: null without ae.csv", s is None and r.summary.get("b_value") is None)
        return
    density = model.mass[: model.count].sum() / (model.width * model.height)
    speed = math.sqrt(r.summary["youngs_modulus"] / (2 * (1 + r.summary["poissons_ratio"])) / density)
    if model.polygons:
        areas = model.mass[: model.count] / np.array([model.materials[b.material]["density"] for b in model.deck.bodies])
        diameter = np.mean(np.sqrt(4 * areas / math.pi))
    else:
        diameter = np.mean([math.sqrt(np.sum(4 * b.circles[:, 2] ** 2)) for b in model.deck.bodies])
    r.key("emission.density", density)
    r.key("emission.shear_wave_speed", speed)
    r.key("emission.radius", diameter)
    r.key("emission.window", 2 * diameter / speed)
    ratios = {m["ratio"] for m in model.materials}
    if len(ratios) == 1 and None not in ratios:
        r.key("emission.damping_ratio", ratios.pop(), 1e-6)  # stored shares are in single precision
    count = len(a["time"])
    r.key("emission.events", count)
    xx, xy, yy = (np.asarray(a["moment_" + part], float) for part in ("xx", "xy", "yy"))
    half, mean = np.hypot((xx - yy) / 2, xy), (xx + yy) / 2
    moment = np.sqrt(((mean + half) ** 2 + (mean - half) ** 2) / 2)
    r.rows("ae: scalar_moment", a["scalar_moment"], moment, rounding * moment)
    thickness = r.results.key("output", "out_of_plane_thickness", 1.0) if model.by_area else 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        magnitude = np.where(moment > 0, 2 / 3 * np.log10(thickness * moment) - 6, math.nan)
        energy = np.asarray(a["energy"], float)
        of_energy = np.where(energy > 0, 2 / 3 * np.log10(thickness * energy) - 3.2, math.nan)
        percent = 100 * 2 * mean / (2 * np.abs(mean) + 2 * half)
    # The accuracy of a magnitude is that of a logarithm.
    r.rows("ae: moment_magnitude", a["moment_magnitude"], magnitude, 1e-12)
    r.rows("ae: energy_magnitude", a["energy_magnitude"], of_energy, 1e-12)
    r.rows("ae: isotropic", a["isotropic"], percent, 1e-9)
    types = np.where(np.isnan(percent), "none", np.where(percent > 30, "opening", np.where(percent < -30, "closing", "shear")))
    r.compare("ae: rows of another type", sum(stated != ours for stated, ours in zip(a["type"], types)), 0, 0)
    known = magnitude[~np.isnan(magnitude)]
    r.key("emission.without_moment", count - len(known))
    r.key("emission.largest_magnitude", known.max() if len(known) else math.nan, floor=1e-12)
    for name in ("opening", "shear", "closing"):
        r.key("emission." + name, np.sum(types == name) / len(known) if len(known) else math.nan)
    r.rows("ae: rise_time within the duration", np.maximum(0, np.asarray(a["rise_time"], float) - a["duration"]), np.zeros(count),
           1e-12 * np.asarray(a["duration"], float))
    recount_b(r, known)
    if r.summary["interrupted"]:
        return  # events that are still open have no row yet
    clusters = cluster(e, r.summary["emission"]["radius"], r.summary["emission"]["shear_wave_speed"])
    r.compare("ae: events of the breaks", count, len(clusters), 0)
    r.compare("ae: breaks", np.sum(a["breaks"]), len(e["time"]), 0)
    taken = np.sum(e["energy"]) if len(e["time"]) else 0.0
    r.compare("ae: energy of all breaks", np.sum(energy), taken, 1e-12 * abs(taken))
    if count != len(clusters) or not count:
        return
    # Rows are in the order in which events ended; events that ended in the same step are identified by their places.
    rows = np.lexsort((a["y"], a["x"], a["time"]))
    clusters.sort(key=lambda one: (e["time"][one["rows"][0]], *one["centre"]))
    size = model.width + model.height

    def of(column):
        return np.asarray(a[column], float)[rows]

    r.rows("ae: time", of("time"), [e["time"][one["rows"][0]] for one in clusters], 0)
    r.rows("ae: axial_strain", of("axial_strain"), [e["axial_strain"][one["rows"][0]] for one in clusters], 0)
    r.rows("ae: breaks of an event", of("breaks"), [len(one["rows"]) for one in clusters], 0)
    r.rows("ae: breaks_in_shear", of("breaks_in_shear"), [sum(e["mode"][k] == "shear" for k in one["rows"]) for one in clusters], 0)
    r.rows("ae: energy", of("energy"), [np.sum(e["energy"][one["rows"]]) for one in clusters], 1e-12 * of("energy") + 1e-300)
    for k, name in enumerate(("x", "y")):
        r.rows("ae: " + name, of(name), [one["centre"][k] for one in clusters], 1e-13 * size)
    r.rows("ae: radius", of("radius"), [one["radius"] for one in clusters], 1e-12 * size)
    r.rows("ae: duration", of("duration"), [one["end"] - e["time"][one["rows"][0]] for one in clusters], 1e-9 * of("duration"))
