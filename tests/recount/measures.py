# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures that follow from a test's whole curve, its breaks and its fragments (specimens/measures/METHODS.md)."""

import math

import numpy as np

from model import rounding


def regression(x, y):
    """Slope of y over x by least squares, and the root mean square of the residuals."""
    if len(x) < 3:
        return math.nan, math.nan
    line = np.polynomial.Polynomial.fit(x, y, 1)
    return line.convert().coef[1], math.sqrt(np.mean((line(x) - y) ** 2))


def first(holds):
    found = np.flatnonzero(holds)
    return int(found[0]) if len(found) else None


def recount_moduli(r, at_peak, strain, stress, lateral, sense):
    """Moduli in the ISRM's windows and beyond the peak, from the columns of the judged rows. @param at_peak  row of the peak among them"""
    peak, rising = stress[at_peak], stress[: at_peak + 1]
    windows = []
    for k in range(71):
        begin, end = first(rising >= k / 100 * peak), first(rising >= (k / 100 + 0.3) * peak)
        windows.append(slice(begin, (at_peak if end is None else end) + 1))
    windows = [w for w in windows if w.stop - w.start >= 3]
    left = [regression(strain[w], stress[w])[1] for w in windows]
    # If a line fits two windows equally well apart from rounding, either is accepted.
    alike = [w for w, misfit in zip(windows, left) if misfit <= min(left) * (1 + 1e-6)]
    stated = r.summary["average_modulus"]
    slopes = [(regression(strain[w], stress[w])[0], sense * regression(strain[w], lateral[w])[0]) for w in alike]
    modulus, ratio = min(slopes, key=lambda s: abs(s[0] - stated)) if slopes else (math.nan, math.nan)
    r.key("average_modulus", modulus, 1e-8)
    r.key("average_poissons_ratio", ratio, 1e-8)
    half = first(rising >= peak / 2)
    shortening = strain[half] - strain[0]
    r.key("secant_modulus_50", (stress[half] - stress[0]) / shortening if shortening > 0 else math.nan)
    r.key("secant_50_poissons_ratio", sense * (lateral[half] - lateral[0]) / shortening if shortening > 0 else math.nan, floor=1e-15)
    begin, end = first(stress[at_peak :] <= 0.9 * peak), first(stress[at_peak :] <= 0.6 * peak)
    fall = math.nan
    if end is not None and r.summary["failed"]:
        window = slice(at_peak + begin, at_peak + end + 1)
        fall = regression(strain[window], stress[window])[0]
        if not fall < 0:
            fall = math.nan
    r.key("post_peak_modulus", fall, 1e-8)
    modulus = r.summary["youngs_modulus"]
    r.key("brittleness_index", math.nan if modulus is None else 1 - modulus / fall, 1e-8)


def recount_stick(stress, broken, peak):
    """Where the number of breaks changes its slope, from bilinear fits with many trial places. @return the best place, and the distance
    between trial places"""
    largest = np.maximum.accumulate(stress)
    more = np.diff(broken, prepend=0) > 0
    if np.sum(largest[more] <= 0.8 * peak) < 10:
        return math.nan, 0.0
    x = np.linspace(0, 0.8 * peak, 201)
    bursts = np.diff(broken, prepend=0)
    count = np.array([bursts[largest <= place].sum() for place in x])
    places = np.linspace(x[1], x[-3], 2001)

    def left(place):
        columns = np.column_stack([np.ones_like(x), x / peak, np.maximum(0, x - place) / peak])
        return np.sum((columns @ np.linalg.lstsq(columns, count, rcond=None)[0] - count) ** 2)

    misfit = [left(place) for place in places]
    return places[int(np.argmin(misfit))], places[1] - places[0]


def recount_opening(stress, lateral, compliance):
    """Where the lateral strain begins to exceed the elastic one by a parabola, from fits with many trial places. Columns up to the largest area
    strain. @return the best place, and the distance between the program's places"""
    rise = np.maximum.accumulate(stress)
    levels = np.linspace(stress[0], rise[-1], 201)
    if not rise[-1] > stress[0]:
        return math.nan, 0.0
    fresh = np.flatnonzero(np.append(True, np.diff(rise) > 0))  # rows in which the stress is larger than ever before
    reached = np.searchsorted(rise[fresh], levels).clip(0, len(fresh) - 1)
    row = fresh[reached]
    before = np.maximum(row - 1, 0)
    part = np.where(row > before, (levels - stress[before]) / np.where(row > before, stress[row] - stress[before], 1.0), 0.0)
    beyond = lateral[before] + part * (lateral[row] - lateral[before]) - lateral[0] - compliance * (levels - stress[0])
    places = np.linspace(levels[0], levels[-4], 1971)
    misfit = []
    for place in places:
        parabola = np.maximum(0.0, levels - place) ** 2
        parabola /= parabola.max()
        opens = np.dot(parabola, beyond) / np.dot(parabola, parabola)
        misfit.append(np.sum((beyond - opens * parabola) ** 2) if opens > 0 else math.inf)
    best = int(np.argmin(misfit))
    return (places[best] if math.isfinite(misfit[best]) else math.nan), levels[1] - levels[0]


def recount_thresholds(r, strain, stress, lateral, broken):
    """Crack initiation and damage of a compression. Columns up to the peak."""
    peak = stress[-1]
    one = math.nan if broken[-1] == 0 else stress[first(broken >= 0.01 * broken[-1])]
    r.key("crack_initiation.first_percent", one, 0.0)
    knee, apart = recount_stick(stress, broken, peak)
    r.key("crack_initiation.count_break", knee, 0.0, apart)
    stated = {name: math.nan if value is None else value for name, value in r.summary["crack_initiation"].items() if name != "count_interval"}
    low, high = (math.nan if end is None else end for end in r.summary["crack_initiation"]["count_interval"])
    r.true("crack_initiation.count_interval: within what was loaded", math.isnan(low) or 0 <= low <= high <= 0.8 * peak)
    shrunk = strain - lateral
    damage = half = where = reversal = departed = farthest = compliant = opened = math.nan
    step = 0.0
    at = 0 if np.any(np.isnan(lateral)) else int(np.argmax(shrunk))
    if at >= 9:
        near = np.flatnonzero(shrunk >= shrunk[0] + 0.98 * (shrunk[at] - shrunk[0]))
        ends = stress[: near[0] + 1].max(), stress[: near[-1] + 1].max()
        damage, half, reversal = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2, stress[at]
        where = strain[first(stress >= damage)]
        rows = slice(0, at + 1)
        chord = lateral[0] + (lateral[at] - lateral[0]) * (stress[rows] - stress[0]) / (stress[at] - stress[0])
        farthest = stress[int(np.argmax(chord - lateral[rows]))]
        modulus, ratio = r.summary["youngs_modulus"], r.summary["poissons_ratio"]
        if modulus is not None and ratio is not None:
            p = r.results.key("confinement", "pressure", 0.0)
            inelastic = (shrunk - (1 - ratio) * (stress - p) / modulus)[rows]
            quiet = first(stress[rows] >= p + 0.25 * (peak - p))
            quiet = at + 1 if quiet is None else quiet
            if quiet >= 10:
                band = inelastic[:quiet].mean() - 3 * inelastic[:quiet].std(ddof=1)
                inside = np.flatnonzero(~(inelastic[quiet:] < band))
                after = quiet + (int(inside[-1]) + 1 if len(inside) else 0)
                departed = stress[after] if after <= at else math.nan
            if broken[at] > 0:
                opened, step = recount_opening(stress[rows], lateral[rows], ratio / modulus)
                compliant = stress[int(np.argmax(1.2 * ratio / modulus * (stress - stress[0])[rows] - lateral[rows]))]
    initiation = math.nan if r.summary["crack_initiation_stress"] is None else r.summary["crack_initiation_stress"]
    r.key("crack_initiation_stress", opened, 0.0, step)
    r.key("crack_initiation_over_peak", initiation / peak)
    r.key("crack_initiation_error", abs(initiation - stated["lateral_compliance"]))
    r.key("crack_damage_stress", damage, 1e-15)
    r.key("crack_damage_error", half, 1e-9)
    r.key("crack_damage_reversal", reversal, 0.0)
    r.key("crack_damage_strain", where, 0.0)
    r.key("crack_damage_over_peak", damage / peak)
    r.key("crack_initiation.lateral_compliance", compliant, 0.0)
    r.key("crack_initiation.crack_strain", departed, 0.0)
    r.key("crack_initiation.lateral_strain", farthest, 0.0)
    known = [x for x in (one, stated["count_break"], departed, farthest, compliant, initiation) if not math.isnan(x)]
    r.key("crack_initiation.spread", max(known) - min(known) if len(known) > 1 else math.nan)


def recount_energies(r):
    c = r.curve
    for name, row in (("energy_at_peak", r.peak), ("energy_at_end", len(c["step"]) - 1)):
        if row is None:
            continue
        work = c["platen_work"][row] + (c["confinement_work"][row] if "confinement_work" in c else 0)
        r.key(name + ".work", work, 0.0)
        for part, column in (("strain", "strain_energy"), ("kinetic", "kinetic_energy")):
            r.key(f"{name}.{part}", (c[column][row] - c[column][0]) / work if work else math.nan)
        for part in ("friction", "fracture", "dashpot"):
            r.key(f"{name}.{part}", c[part + "_loss"][row] / work if work else math.nan)


def recount_measures(r):
    recount_energies(r)
    if r.peak is None:
        return
    c, at_peak, compressed = r.judged, r.peak_judged, r.summary["kind"] != "tension"
    columns = [c[name] for name in ("axial_strain", "axial_stress", "lateral_strain")]
    recount_moduli(r, at_peak, *columns, 1.0 if compressed else -1.0)
    if compressed:
        recount_thresholds(r, *(column[: at_peak + 1] for column in (*columns, c["bonds_broken"])))


def recount_rose(r, model, bonds):
    """Directions of cracks between particles. Their lengths only if all are circles, whose faces are as long as the smaller diameter, or have
    faces."""
    e, s = r.events, r.summary["crack_rose"]
    if r.peak is None:
        return
    after = e["time"] > r.curve["time"][r.peak]
    shear = np.array([mode == "shear" for mode in e["mode"]], bool)
    pairs = [(model.index[int(a)], model.index[int(b)]) for a, b in zip(e["body_i"], e["body_j"])]
    inside = np.array([max(pair) < model.count for pair in pairs], bool)
    laps = {frozenset((i, j)): lap for i, j, lap in zip(bonds.i, bonds.j, bonds.lap) if lap > 0}
    faces = {frozenset((i, j)): long for i, j, long in zip(bonds.i, bonds.j, bonds.length)} if model.by_faces else {}
    for name, own in (("tension_to_peak", ~shear & ~after), ("shear_to_peak", shear & ~after),
                      ("tension_after", ~shear & after), ("shear_after", shear & after)):
        own = np.flatnonzero(own & inside) if len(pairs) else np.array([], int)
        label = f"crack_rose.{name}."
        r.key(label + "cracks", len(own))
        if model.polygons and not model.by_faces:
            continue
        length = np.array([faces.get(frozenset(pairs[k]), math.nan) if model.by_faces else
                           laps.get(frozenset(pairs[k]), 2 * min(model.circle_radius[list(pairs[k])])) for k in own])
        angle = np.asarray(e["orientation"])[own] + math.pi / 2
        r.key(label + "length", float(length.sum()))
        mean = np.sum(length * np.exp(2j * angle)) if len(own) else complex(math.nan, math.nan)
        share = abs(mean) / length.sum() if len(own) else math.nan
        r.key(label + "resultant", share, floor=1e-14)
        direction = math.degrees(np.angle(mean) / 2) % 180 if len(own) else math.nan
        stated = s[name]["direction"]
        if len(own) and stated is not None and abs(stated - direction) > 90:
            direction += math.copysign(180, stated - direction)  # 0 and 180 degrees are the same direction
        r.key(label + "direction", direction, floor=1e-9)
        if len(own):
            n = length.sum() ** 2 / np.sum(length**2)
            z = n * share**2
            r.key(label + "rayleigh", min(1.0, max(0.0, math.exp(-z) * (1 + (2 * z - z * z) / (4 * n)))), floor=1e-12)
        bins = np.histogram(np.degrees(angle) % 180, bins=np.arange(0, 190, 10), weights=length)[0]
        r.rows(label + "lengths", s[name]["lengths"], bins, rounding * max(length.sum(), 1e-300))


def recount_fragments(r, model, areas):
    """D50, and the Rosin-Rammler distribution of sizes. @param areas  of the fragments at the end, m2"""
    areas = np.sort(np.asarray(areas))
    sizes = np.sqrt(4 * areas / math.pi)
    passed = np.concatenate([[0.0], np.cumsum(areas)])
    k = first(passed[1:] >= areas.sum() / 2)
    share = (areas.sum() / 2 - passed[k]) / areas[k]
    r.key("fragment_size_median", sizes[0] if k == 0 else sizes[k - 1] + share * (sizes[k] - sizes[k - 1]))
    least = math.sqrt(8 * areas.sum() / model.count / math.pi)
    kept = sizes >= least * (1 - 1e-12)
    r.key("fragment_rosin_rammler.fragments", int(kept.sum()))
    size, exponent = (r.summary["fragment_rosin_rammler"][name] for name in ("size", "exponent"))
    if exponent is None:
        return
    # The stated parameters must maximise the likelihood: changes by 0.1 % may not increase it.
    weight, x = areas[kept] / areas[kept].sum(), sizes[kept]

    def likelihood(size, n):
        return np.sum(weight * (np.log(n / size) + (n - 1) * np.log(x / size) - (x / size) ** n + (least / size) ** n))

    best = likelihood(size, exponent)
    for a, b in ((1.001, 1), (0.999, 1), (1, 1.001), (1, 0.999), (1.001, 0.999), (0.999, 1.001)):
        r.true(f"fragment_rosin_rammler: likelier than at {a} of its size, {b} of its exponent",
               likelihood(a * size, b * exponent) <= best)
    r.keys.update({"fragment_rosin_rammler.size", "fragment_rosin_rammler.exponent"})
