# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes the figures of a test again from what it has left, by another program written from the documents.

A line a figure: name, as stated, as recounted, difference over tolerance. What each tolerance is: README.md."""

import math
import sys

try:
    import numpy as np
except ImportError:
    print("recount: found no numpy, expected Debian's python3-numpy; install it", file=sys.stderr)
    sys.exit(2)

from bonds import make_bonds
from frames import recount_frame, recount_places, rest_after, touching_floor
from history import holds_every_step, recount_history
from loading_by_tolerance import by_tolerance, recount_start
from model import Model, rounding
from peaks import find_fall
from results import Results, Unreadable
from slips import recount_slips


# Of a strength: what a force may grow in a step. At 0.8 of the stable one the stiffest motion turns by 106 degrees.
one_step = 0.5
# Of the energy of all breaks: the mean of what their forces grew in the last step.
mean_step = 0.1


class Recount:
    """Lines of what was compared, and which keys of the summary were."""

    def __init__(self, results):
        self.results, self.lines, self.keys = results, [], set()
        self.peak = None  # row of the peak, where all rows are written
        self.summary, self.curve, self.events = results.summary, results.curve, results.events

    def compare(self, name, stated, ours, tolerance):
        """@param tolerance  absolute"""
        if stated is None:
            stated = math.nan
        both_undefined = math.isnan(stated) and math.isnan(ours)
        difference = 0.0 if both_undefined or stated == ours else abs(stated - ours)
        holds = difference <= tolerance
        self.lines.append((name, stated, ours, difference, tolerance, holds))

    def key(self, name, ours, relative=rounding, floor=0.0):
        """A figure of summary.json, and the same in Pa where there is one."""
        at = self.summary
        for part in name.split("."):
            if not isinstance(at, dict) or part not in at:
                return
            at = at[part]
        self.keys.add(name)
        if isinstance(at, (str, bool)) or isinstance(ours, (str, bool)):
            self.lines.append((name, at, ours, 0.0, 0.0, at == ours))
            return
        tolerance = max(relative * abs(ours), floor) if not math.isnan(ours) else 0.0
        self.compare(name, at, ours, tolerance)
        in_pascal = name + "_pa"
        if in_pascal in self.summary:
            self.keys.add(in_pascal)
            # In area units stresses are in Pa as they are.
            by_area = self.results.key("material", "units", "point") == "area"
            over = 1.0 if by_area else self.results.key("output", "out_of_plane_thickness", 1.0)
            self.compare(in_pascal, self.summary[in_pascal], ours / over, tolerance / over)

    def rows(self, name, stated, ours, tolerance):
        """A column: the worst row stands for all."""
        stated, ours = np.asarray(stated, float), np.asarray(ours, float)
        tolerance = np.broadcast_to(tolerance, stated.shape)
        if stated.shape != ours.shape:
            self.lines.append((name + " (rows)", len(stated), len(ours), 0.0, 0.0, False))
            return
        if not len(stated):
            return
        difference = np.where(np.isnan(stated) & np.isnan(ours), 0.0, np.abs(stated - ours))
        excess = np.where(np.isnan(difference), np.inf, difference - tolerance)
        worst = int(np.argmax(excess))
        self.lines.append(
            (f"{name} [{worst} of {len(stated)}]", stated[worst], ours[worst], difference[worst],
             float(tolerance[worst]), bool(excess[worst] <= 0))
        )

    def true(self, name, holds):
        self.lines.append((name, "holds" if holds else "does not hold", "holds", 0.0, 0.0, bool(holds)))


def slope(x, y):
    return np.sum((x - x.mean()) * (y - y.mean())) / np.sum((x - x.mean()) ** 2)


def recount_curve(r):
    """What follows from curve.csv alone."""
    c, case = r.curve, r.results.key
    r.rows("curve: axial_stress", c["axial_stress"], (c["stress_top"] + c["stress_bottom"]) / 2,
           1e-14 * np.abs(c["axial_stress"]) + 1e-12)
    closing = (c["kinetic_energy"] - c["kinetic_energy"][0] + c["strain_energy"] - c["strain_energy"][0]
               + c["dashpot_loss"] + c["friction_loss"] + c["fracture_loss"] - c["platen_work"])
    size = np.abs(c["kinetic_energy"]) + c["strain_energy"] + c["dashpot_loss"] + np.abs(c["platen_work"])
    if case("numerics", "contact_law", "rounded") == "rounded":
        r.rows("curve: energy_error", c["energy_error"], closing, 1e-12 * size + 1e-18)
    r.key("axial_strain_end", c["axial_strain"][-1])
    r.key("energy_closing_error", c["energy_error"][-1] / c["platen_work"][-1])
    r.key("simulated_time", c["time"][-1])
    r.key("steps", c["step"][-1])
    r.key("time_step_mean", c["time"][-1] / c["step"][-1])
    r.key("bonds_broken", c["bonds_broken"][-1])
    r.key("interfaces_lost", c["interfaces_lost"][-1])
    strain, stress, lateral = c["axial_strain"], c["axial_stress"], c["lateral_strain"]
    sense = 1.0 if case("loading", "kind") == "compression" else -1.0
    r.key("area_strain_end", sense * strain[-1] - lateral[-1])
    if case("output", "curve_rows", 2000) < 2000:
        return  # peak and windows are those of rows that were not written
    peak, dropped = find_fall(strain, stress, 1 - case("loading", "strength_drop", 0.1))
    _, end = find_fall(strain, stress, case("loading", "stop_at_share_of_peak", 0.5))
    failed = dropped is not None or end is not None
    r.key("failed", failed)
    if end is not None:
        r.key("ended_by", "failure")
        r.compare("row at which failure is found", len(stress) - 1, end, 0)
    else:
        r.true("ended_by: not failure", r.summary["ended_by"] != "failure")
    if peak is None:
        return
    r.peak, largest = peak, int(np.argmax(stress))
    r.key("largest_stress", stress[largest], 0.0)
    r.key("strain_at_largest_stress", strain[largest], 0.0)
    r.true("notice of a larger stress after the peak",
           any("the largest stress" in notice for notice in r.summary["notices"]) == (largest > peak))
    suffix = "" if failed else "_so_far"
    r.key("peak_stress" + suffix, stress[peak], 0.0)
    r.key("peak_strain" + suffix, strain[peak], 0.0)
    drawn = [f"frames/particles_{row:05d}.vtp" for row in r.results.frame_rows()]
    for name, frame in (("start", drawn[0]), ("peak", f"frames/particles_{peak:05d}.vtp"), ("end", drawn[-1])):
        r.key("frame_" + name, frame)
        r.true(f"frame_{name}: is there", frame in drawn)
    r.key("area_strain_peak", sense * strain[peak] - lateral[peak])
    r.key("platen_out_of_balance",
          np.max(np.abs(c["stress_top"] - c["stress_bottom"])[: peak + 1]) / stress[peak])
    rising = np.arange(peak + 1)
    early = rising[strain[: peak + 1] <= strain[peak] / 20]
    first = np.argmax(stress[: peak + 1] >= 0.4 * stress[peak])
    last = np.argmax(stress[: peak + 1] >= 0.6 * stress[peak])
    for name, ratio, window in (
        ("initial_tangent_modulus", "initial_poissons_ratio", early),
        ("tangent_modulus_50", "tangent_50_poissons_ratio", np.arange(first, last + 1)),
    ):
        few = len(window) < 3
        r.key(name, math.nan if few else slope(strain[window], stress[window]))
        r.key(ratio, math.nan if few else sense * slope(strain[window], lateral[window]))
    if len(early) >= 3:
        w = "initial_tangent_window."
        r.key(w + "rows", len(early))
        r.key(w + "strain_to", strain[early[-1]])
        r.key(w + "bonds_broken", c["bonds_broken"][early[-1]] - c["bonds_broken"][early[0]])
        r.key(w + "points_sliding", c["points_sliding"][early[-1]])
        if {int(early[0]), int(early[-1])} <= set(r.results.frame_rows()):  # states 3 and 4: touching without a bond
            loose = [np.sum(r.results.frame(row).contacts["state"] >= 3) for row in (early[0], early[-1])]
            r.key(w + "contacts_gained", int(loose[1]) - int(loose[0]))
    if by_tolerance(r):
        r.key("axial_strain_rate", strain[-1] / c["time"][-1])
        r.key("viscous_stress_share", stress[0] / stress[largest])
    else:
        r.rows("curve: axial_strain of the rate", strain, case("loading", "axial_strain_rate") * c["time"],
               1e-9 * strain + 1e-15)
        r.key("axial_strain_rate", case("loading", "axial_strain_rate"), 0.0)


def recount_packing(r):
    """packing.* from the circles between their walls (specimens/METHODS.md 1)."""
    deck = r.results.circles
    if deck is None or "packing" not in r.summary:
        return
    circles = np.concatenate([b.circles for b in deck.bodies])
    x, y, radius = circles.T
    box, solid = deck.width * deck.height, np.sum(math.pi * radius**2)
    r.key("packing.void_ratio", (box - solid) / solid)
    stiffness = deck.materials[-1]["normal_stiffness"]  # [material]'s, behind the minerals'
    apart = np.hypot(x[:, None] - x, y[:, None] - y)
    overlap = radius[:, None] + radius - apart
    i, j = np.nonzero(np.triu(overlap > 0, 1))
    between = overlap[i, j]
    walls = [radius - (x - deck.x1), radius - (deck.x2 - x), radius - (y - deck.y1), radius - (deck.y2 - y)]
    left, right, bottom, top = (np.where(w > 0, w, 0.0) for w in walls)
    ends = np.concatenate([bottom[bottom > 0], top[top > 0]])
    r.key("packing.mean_overlap", np.concatenate([between, ends]).mean())
    r.key("packing.coordination", 2 * len(between) / len(x))
    touches = np.bincount(np.concatenate([i, j]), minlength=len(x)) + sum(w > 0 for w in (left, right, bottom, top))
    r.key("packing.floating", int(np.sum(touches == 0)))
    r.key("packing.coordination_of_carrying", touches.sum() / np.sum(touches > 0))
    stress_x = stiffness * (left.sum() + right.sum()) / 2 / deck.height
    stress_y = stiffness * (bottom.sum() + top.sum()) / 2 / deck.width
    r.key("packing.stress_x", stress_x)
    r.key("packing.stress_y", stress_y)
    r.key("packing.anisotropy", abs(stress_x - stress_y) / (stress_x + stress_y), floor=1e-9)
    force = np.zeros((len(x), 2))
    n = np.stack([x[j] - x[i], y[j] - y[i]], 1) / apart[i, j][:, None]
    np.add.at(force, i, -n * between[:, None])
    np.add.at(force, j, n * between[:, None])
    force += np.stack([left - right, bottom - top], 1)
    all_walls = np.concatenate([w[w > 0] for w in (left, right, bottom, top)])
    mean = np.concatenate([between, all_walls]).mean()
    # A residue of cancelling forces: places carry rounding of 1e-16 of the box.
    r.key("packing.unbalanced", np.hypot(*force.T).max() / mean, floor=20 * 1e-16 * deck.height / mean)


def recount_minerals(r, model):
    """Shares and grains of each mineral, and what it is made of (specimens/METHODS.md 3)."""
    stated, case = r.summary.get("minerals", []), r.results.case
    r.true("minerals: as many as the case has", len(stated) == len(model.minerals))
    material, area = model.material[: model.count], model.area[: model.count]
    grain = area.max() / area.sum()
    assign = r.results.key("minerals", "assign")
    rest = 1 - sum(m.get("area_share", 0.0) for m in model.minerals)
    for k, (m, s) in enumerate(zip(model.minerals, stated)):
        name, mine = f"minerals[{k}]", material == k
        share = area[mine].sum() / area.sum()
        asked = m.get("area_share", rest if assign in ("random", "size") else None)
        r.true(f"{name}.name", s["name"] == m["name"])
        r.compare(f"{name}.grains", s["grains"], mine.sum(), 0)
        r.compare(f"{name}.area_share_reached", s["area_share_reached"], share, rounding)
        r.true(f"{name}.area_share: stated where asked", (s["area_share"] is None) == (asked is None))
        if asked is not None:
            r.compare(f"{name}.area_share", s["area_share"], asked, rounding)
        if assign in ("random", "size"):
            r.compare(f"{name}: asked by whole grains", share, asked, grain)
        for key, value in model.deck.materials[k].items():
            given = m.get(key, case.get("material", {}).get(key))
            if given is not None:
                r.compare(f"{name}: {key} of its grains", value, given, 0)
    if assign == "size":
        largest = [[area[material == k].min(initial=math.inf), area[material == k].max(initial=0)] for k in range(len(stated))]
        r.true("minerals: larger grains have those listed first",
               all(a[0] >= b[1] * (1 - rounding) for a, b in zip(largest, largest[1:])))
    if assign == "labels":
        lines = [line.strip() for line in (r.results.folder / case["minerals"]["labels"]).read_text().splitlines()]
        labels = [line for line in lines if line and not line.startswith("#")]
        names = [m["name"] for m in model.minerals]
        wanted = [names.index(one) if one in names else int(one) - 1 for one in labels]
        r.true("minerals: as labelled", wanted == list(material))


def recount_cells(r):
    """packing.cell_* from the polygons, each set outwards by the depth of the inset (specimens/METHODS.md 2)."""
    if "cell_diameter" not in r.summary.get("packing", {}):
        return
    depth = r.results.key("mesh", "inset", r.results.key("mesh", "thick") / 2)
    diameter = []
    for body in r.results.polygons.bodies:
        p = body.corners
        edge = np.roll(p, -1, 0) - p
        after = np.stack([edge[:, 1], -edge[:, 0]], 1) / np.hypot(*edge.T)[:, None]
        before = np.roll(after, 1, 0)
        q = p + depth * (before + after) / (1 + np.sum(before * after, 1))[:, None]
        area = np.sum(q[:, 0] * np.roll(q[:, 1], -1) - q[:, 1] * np.roll(q[:, 0], -1)) / 2
        diameter.append(math.sqrt(4 * area / math.pi))
    diameter = np.array(diameter)
    # An edge that the inset took leaves a corner too far out: some depth squared of one cell in ten.
    lost = 0.1 * (depth / diameter.mean()) ** 2
    r.key("packing.cell_diameter", diameter.mean(), lost + 1e-9)
    r.key("packing.cell_spread", diameter.std() / diameter.mean(), 30 * lost + 1e-9)


def recount_specimen(r, model):
    """Counts, bonds, modulus and stable step of the specimen between its platens. @return its bonds"""
    s = r.summary
    r.key("kind", r.results.key("loading", "kind"))
    r.key("platens", r.results.key("loading", "platens"))
    r.key("bond_law", r.results.key("bond", "law", "back_tension"))
    r.key("material_units", r.results.key("material", "units", "point"))
    r.key("initial_width", model.width)
    r.key("initial_height", model.height)
    r.key("particles", model.count)
    r.key("platen_bottom_id", model.ids[model.bottom])
    r.key("platen_top_id", model.ids[model.top])
    if model.polygons:
        r.key("segments", sum(len(b.corners) for b in model.deck.bodies))
        if r.results.circles is not None:
            r.key("seeds", len(r.results.circles.bodies))
        triangles = all(len(b.corners) == 3 for b in model.deck.bodies)
        r.key("specimen", r.results.key("mesh", "kind", "delaunay" if triangles else "voronoi"))
        r.key("bond_thick", model.thick)
    else:
        r.key("specimen", "circles")
    points = model.points(model.centre, np.zeros(len(model.mass)))
    bonds = make_bonds(model, points)
    r.key("bonds_initial", len(bonds.i))
    bonded = set(bonds.keys())
    loose = np.array([d for key, d in zip(points.keys(), points.overlap.tolist()) if key not in bonded])
    floor = touching_floor * model.height if model.frictional else 0.0
    fewest, most = len(bonds.i) + np.sum(loose > floor), len(bonds.i) + np.sum(loose > -floor)
    r.compare("contacts_initial", s["contacts_initial"], (fewest + most) / 2, (most - fewest) / 2)
    r.keys.add("contacts_initial")
    pairs = {(min(a, b), max(a, b)) for a, b in zip(bonds.i, bonds.j)}
    r.key("interfaces_initial", len(pairs))
    tension = model.normal_stiffness(bonds) * bonds.overlap
    # Gaps and overlaps cancel.
    tiny = 1e-15 * model.height
    r.key("mean_bond_overlap", bonds.overlap.mean(), floor=rounding * np.abs(bonds.overlap).mean() + tiny)
    scale = rounding * np.abs(tension).mean() + tiny * model.normal_stiffness(bonds).mean()
    r.key("mean_back_tension", tension.mean(), floor=scale)
    r.key("mean_back_tension_interface", tension.sum() / len(pairs), floor=scale * len(tension) / len(pairs))
    r.key("bonds_unbreakable", int(np.sum(bonds.held)))
    glued = r.results.key("loading", "platens") == "glued"
    r.key("grip", r.results.key("loading", "grip", 0.0) * model.height if glued else 0.0)
    if model.coulomb and not np.all(bonds.held):
        r.key("mean_tensile_strength", bonds.tensile[~bonds.held].mean())
        r.key("mean_cohesion", bonds.cohesion[~bonds.held].mean())
    if s.get("youngs_modulus"):
        density = model.mass[: model.count].sum() / (model.width * model.height)
        r.key("wave_transit_time", model.height / math.sqrt(s["youngs_modulus"] / density))
    if model.frictional or len(model.mass) > 1500:
        return bonds
    stiffness, damping = model.matrices(bonds, model.centre)
    free = np.arange(3 * model.count)
    solution = np.zeros(3 * len(model.mass))
    solution[3 * model.top + 1] = -model.sense * model.height  # axial strain 1
    scale = np.diag(stiffness)[free]
    scale = 1 / np.sqrt(np.where(scale > 0, scale, scale.max()))
    scaled = scale[:, None] * stiffness[np.ix_(free, free)] * scale
    load = -scale * (stiffness[free] @ solution)
    values, vectors = np.linalg.eigh(scaled)
    regular = values > 1e-11  # floating bodies and mechanisms move without a force
    solution[free] = scale * (vectors[:, regular] @ ((vectors[:, regular].T @ load) / values[regular]))
    force = stiffness @ solution
    stress = (force[3 * model.bottom + 1] - force[3 * model.top + 1]) / 2 / model.width * model.sense
    strained = -solution[3 * model.top + 1] / model.height * model.sense
    # The eigenvectors of the softest motions carry the rounding of the stiffest, 1e-16 over the smallest eigenvalue.
    r.key("youngs_modulus", stress / strained, 1e-7)
    if by_tolerance(r):
        loose = np.abs(scale[:, None] * vectors[:, ~regular]).reshape(model.count, -1).max(axis=1, initial=0.0)
        recount_start(r, model, bonds, solution, stress / strained, loose <= 1e-6 * scale.max())
    bottom, top = model.axial_gauge(bonds)
    if len(bottom) and len(top):
        length = model.centre[top, 1].mean() - model.centre[bottom, 1].mean()
        growth = solution[3 * top + 1].mean() - solution[3 * bottom + 1].mean()
        r.key("gauge_modulus", stress / (-model.sense * growth / length), 1e-6)
    else:
        r.key("gauge_modulus", math.nan)
    left, right = model.gauge()
    if left and right and (r.results.circles is None or not model.polygons or r.results.key("mesh", "kind") == "voronoi"):
        length = model.centre[right, 0].mean() - model.centre[left, 0].mean()
        growth = solution[3 * np.array(right)].mean() - solution[3 * np.array(left)].mean()
        r.key("poissons_ratio", model.sense * growth / length, 1e-6)
    if s.get("numerical_errors") is not None and r.results.key("numerics", "contact_law", "rounded") == "rounded":
        root = np.concatenate([np.repeat(model.mass[: model.count, None], 2, 1), model.inertia[: model.count, None]], 1)
        root = 1 / np.sqrt(root.ravel())
        k = root[:, None] * stiffness[np.ix_(free, free)] * root
        c = root[:, None] * damping[np.ix_(free, free)] * root
        step = s["stable_time_step"]

        def stable(dt):
            try:
                np.linalg.cholesky(4 * np.eye(len(free)) - 2 * dt * c - dt * dt * k)
            except np.linalg.LinAlgError:
                return False
            return True

        r.true("stable_time_step: stable", stable(step))
        r.true("stable_time_step: unstable two millionths above", not stable(step * (1 + 2e-6)))
        r.keys.add("stable_time_step")
        if r.results.key("numerics", "time_step") is None:
            r.key("time_step_over_stable", s["time_step"] / step)
    return bonds


def recount_events(r, model, bonds):
    """Every row of events.csv against the bonds, the curve, and each other."""
    e, c = r.events, r.curve
    count = len(e["time"])
    r.key("bonds_broken", count)
    if not count:
        return
    r.true("events: in the order of steps", np.all(np.diff(e["step"]) >= 0))
    r.rows("curve: bonds_broken of events", c["bonds_broken"],
           np.searchsorted(e["step"], c["step"], side="right"), 0)
    last = np.asarray(e["last_of_interface"])
    r.rows("curve: interfaces_lost of events", c["interfaces_lost"],
           [np.sum(last[: np.searchsorted(e["step"], step, side="right")]) for step in c["step"]], 0)
    mean_step = c["time"][-1] / c["step"][-1]
    row = np.clip(np.searchsorted(c["step"], e["step"]), 1, len(c["step"]) - 1)
    inside = (e["step"] - c["step"][row - 1]) / np.maximum(c["step"][row] - c["step"][row - 1], 1)
    width = c["axial_strain"][row] - c["axial_strain"][row - 1]
    guess = c["axial_strain"][row - 1] + inside * width
    if r.results.key("loading", "axial_strain_rate") is not None:
        guess = r.results.key("loading", "axial_strain_rate") * e["time"]
        r.rows("events: axial_strain", e["axial_strain"], guess, 1e-9 * guess + 1e-15)
    else:
        r.rows("events: axial_strain", e["axial_strain"], guess, np.abs(width) + 1e-12)
    r.rows("events: time", e["time"], c["time"][row - 1] + inside * (c["time"][row] - c["time"][row - 1]),
           2 * mean_step)
    left = {}
    for k in np.flatnonzero(~bonds.held):
        left.setdefault(frozenset((model.ids[bonds.i[k]], model.ids[bonds.j[k]])), []).append(k)
    friction = model.friction(bonds)
    in_shear = np.array([model.coulomb and m == "shear" for m in e["mode"]])

    def limit(m, k):
        """Strength that bond m would have shown in row k."""
        return bonds.cohesion[m] + friction[m] * e["normal_force"][k] if in_shear[k] else bonds.tensile[m]

    strength, ours_last, of_bond = [], [], []
    for k in range(count):
        own = left.get(frozenset((int(e["body_i"][k]), int(e["body_j"][k]))), [])
        m = min(own, key=lambda m: abs(limit(m, k) - e["strength"][k]), default=-1)
        of_bond.append(m)
        if m < 0:
            strength.append(math.nan)
            ours_last.append(math.nan)
            continue
        own.remove(m)
        strength.append(limit(m, k))
        ours_last.append(0)
    # The last of an interface is the last row of its pair, once no bond of the pair is left.
    final = {frozenset((int(a), int(b))): k for k, (a, b) in enumerate(zip(e["body_i"], e["body_j"]))}
    for pair, k in final.items():
        if left.get(pair) == [] and not held_between(model, bonds, pair):
            ours_last[k] = 1
    r.compare("events: rows of pairs that have no bond left", of_bond.count(-1), 0, 0)
    r.rows("events: strength", e["strength"], strength, 1e-9 * np.abs(strength))
    r.rows("events: last_of_interface", e["last_of_interface"], ours_last, 0)
    if model.coulomb:
        recount_envelope(r, model, bonds, np.array(of_bond), in_shear)
        shear = in_shear
    else:
        force = np.hypot(e["normal_force"], e["shear_force"])
        # Normal and shear force are kept in single precision.
        # 0: it never carried half its strength, since it broke from one step to the next.
        r.true("events: forces at half the strength or more, or 0",
               np.all((force >= 0.5 * e["strength"] * (1 - 1e-6)) | (force == 0)))
        shear = (np.asarray(e["slid"]) == 1) & (np.abs(e["shear_force"]) > np.abs(e["normal_force"]))
        r.compare("events: rows with another mode", sum((m == "shear") != s for m, s in zip(e["mode"], shear)), 0, 0)
    r.key("bonds_broken_after_sliding", int(np.sum(e["slid"])))
    r.key("bonds_broken_in_shear", int(np.sum(shear)))
    r.key("bonds_broken_in_tension", int(np.sum(~shear)))
    if r.peak is not None:
        to_peak = np.asarray(e["step"]) <= c["step"][r.peak]
        r.key("bonds_broken_in_shear_to_peak", int(np.sum(shear & to_peak)))
        r.key("bonds_broken_in_tension_to_peak", int(np.sum(~shear & to_peak)))
    r.compare("fracture_loss of events", c["fracture_loss"][-1], np.sum(e["energy"]), 1e-12 * np.sum(np.abs(e["energy"])))


def held_between(model, bonds, pair):
    i, j = (model.index[name] for name in pair)
    return bool(np.any(bonds.held & (((bonds.i == i) & (bonds.j == j)) | ((bonds.i == j) & (bonds.j == i)))))


def recount_envelope(r, model, bonds, of_bond, in_shear):
    """Rows of coulomb bonds: forces when they failed, limits exceeded, energies (solver/MODEL.md 5.2)."""
    e = r.events
    known = of_bond >= 0
    m, in_shear = of_bond[known], in_shear[known]
    normal, shear = e["normal_force"][known], np.abs(e["shear_force"][known])
    tensile, limit = bonds.tensile[m], bonds.cohesion[m] + model.friction(bonds)[m] * normal
    parts, shears = -normal >= tensile * (1 - rounding), shear >= limit - rounding * bonds.cohesion[m]
    r.compare("events: rows within both limits", int(np.sum(~(parts | shears))), 0, 0)
    # Of two limits exceeded in one step the way decides, which only a frame a step holds (history.py).
    r.compare("events: rows with another mode", int(np.sum(np.where(in_shear, ~shears, ~parts))), 0, 0)
    r.compare("events: coulomb bonds that slid", int(np.sum(e["slid"])), 0, 0)
    over = np.where(in_shear, shear - limit, -normal - tensile)
    r.rows("events: force beyond the limit", over, np.zeros(len(over)), one_step * (bonds.tensile + bonds.cohesion).mean())
    r.true("events: no energy below 0", np.all(np.asarray(e["energy"]) >= 0))
    kn, ks = model.normal_stiffness(bonds)[m], model.shear_stiffness(bonds)[m]
    kept = np.maximum(0.0, normal + kn * (bonds.overlap[m] - rest_after(model, bonds.overlap[m])))
    rubs = np.minimum(shear, model.residual_friction(bonds)[m] * kept)
    stored = (normal**2 - kept**2) / 2 / kn + (shear**2 - rubs**2) / 2 / ks
    # The account takes the mean force of the last step: at most as much beyond as the force grew in it.
    size = (np.abs(normal) + kept) ** 2 / 2 / kn + shear**2 / 2 / ks
    energy = np.asarray(e["energy"])[known]
    r.rows("events: energy of the forces", energy, stored, size)
    r.compare("events: energy of all their forces", energy.sum(), stored.sum(), mean_step * size.sum())


def recount_parting(r, model):
    """The largest crack: broken bonds that share particles or a platen, and where it lies (specimens/METHODS.md 3)."""
    e, s = r.events, r.summary
    pairs = [(model.index[int(a)], model.index[int(b)]) for a, b in zip(e["body_i"], e["body_j"])]
    if not pairs:
        r.true("failed_at and largest_crack: null without a break", s["failed_at"] is None and s["largest_crack"] is None)
        return
    group = {}
    for pair in pairs:
        joined = set(pair).union(*(group.get(b, ()) for b in pair))
        group.update((b, joined) for b in joined)
    cracks = {}
    for i, j in pairs:
        own = [b for b in (i, j) if b < model.count]
        cracks.setdefault(min(group[i]), []).append((np.mean(model.centre[own, 1]) - model.deck.y1, len(own) < 2))
    most = max(len(crack) for crack in cracks.values())
    found = []  # of two alike either may be named
    for crack in cracks.values():
        if len(crack) == most:
            height, of_platen = np.mean([c[0] for c in crack]), sum(c[1] for c in crack)
            within = min(height, model.height - height) < s["grip"]
            found.append((height, of_platen, "platen" if 2 * of_platen >= most else "grip" if within else "gauge"))
    stated = s["largest_crack"]
    height, of_platen, place = min(found, key=lambda f: abs(f[0] - stated["height"]))
    r.key("largest_crack.bonds", most)
    r.key("largest_crack.of_platen", of_platen)
    r.key("largest_crack.height", height)
    r.key("failed_at", place)


def recount_given(r, model):
    """What the case gives or a rule derives from it."""
    for table, name in (("loading", "rate_tolerance"), ("output", "out_of_plane_thickness")):
        if r.results.key(table, name) is not None:
            r.key(name, r.results.key(table, name), 0.0)
    if r.results.circles is not None and "packing" in r.summary:
        r.key("seed", r.results.key("packing", "seed"), 0.0)
        radii = np.concatenate([b.circles[:, 2] for b in r.results.circles.bodies])
        scale = r.summary["packing"].get("radius_scale")
        least, most = r.results.key("packing", "radius_min"), r.results.key("packing", "radius_max")
        if scale is not None and least is not None and most is not None:
            r.true("packing.radius_scale: radii within its multiples of those asked",
                   least * scale * (1 - 1e-12) <= radii.min() and radii.max() <= most * scale * (1 + 1e-12))
            r.keys.add("packing.radius_scale")
    if not model.polygons:
        r.key("bond_thick", r.results.key("bond", "thick", model.circle_radius[: model.count].mean() / 10))
    if r.summary["step_seconds"] > 0:
        rate = r.summary["particles"] * r.summary["steps"] / r.summary["step_seconds"]
        r.key("particle_steps_per_second", rate)
    given, stable = r.results.key("numerics", "time_step"), r.summary.get("stable_time_step")
    if given is not None:
        r.key("time_step", given, 0.0)
    elif stable is not None and "time_step_over_stable" in r.summary:
        r.key("time_step", r.summary["time_step_over_stable"] * stable)
    if stable is not None and "stable_time_step" in r.keys:
        r.true("time_step_bound: not above the stable step", r.summary["time_step_bound"] <= stable * (1 + 1e-9))
        r.keys.add("time_step_bound")
    errors = r.summary.get("numerical_errors") or {}
    for name in ("peak_stress", "peak_strain"):
        if name in errors and r.summary["energy_closing_error"] is not None:
            r.key(f"numerical_errors.{name}.energy_closing", abs(r.summary["energy_closing_error"]))


def recount_errors(r):
    """Stated errors from the companions' own results (specimens/METHODS.md 7)."""
    errors = r.summary.get("numerical_errors") or {}
    if "companions" not in errors or not r.summary.get("failed"):
        return
    if "time_step" not in errors["companions"]["half_rate"]:
        raise Unreadable(f"{r.results.folder}/summary.json: found companions without their time_step, expected one each; "
                         "these are results of an older version: run the test again with --verify")
    asked = {"half_time_step": (0.5, 1, 1), "half_rate": (1, 0.5, 1), "half_damping": (1, 1, 0.5),
             "double_damping": (1, 1, 2)}
    at_a_rate = r.results.key("loading", "axial_strain_rate") is not None
    for name, (step, rate, damping) in asked.items():
        run = errors["companions"][name]
        label = f"companion {name}: "
        # More damping lowers the stable step, less raises it: theirs is not compared.
        if damping == 1:
            over = run["time_step"] / r.summary["time_step_mean"]
            # The bound of a mean over rows moves where contacts open and close otherwise.
            r.compare(label + "time step over the test's", over, step, 0.02 * step)
        # By tolerance the rate follows what breaks, between 0.15 and 1 of its limit.
        over = run["axial_strain_rate"] / r.summary["axial_strain_rate"]
        r.compare(label + "rate over the test's", over, rate, 1e-3 * rate if at_a_rate else 0.4 * rate)
        if run["damping"] is not None:  # the test has some
            r.compare(label + "damping over the test's", run["damping"], damping, 1e-12)
    peak = {"peak_stress": r.summary["peak_stress"], "peak_strain": r.summary["peak_strain"]}
    runs = errors["companions"]
    for name, value in peak.items():
        half_step, half_rate = runs["half_time_step"][name], runs["half_rate"][name]
        spread = np.std([value, half_step, half_rate], ddof=1)
        step, rate = abs(half_step - value) / value, abs(half_rate - value) / value
        r.key(f"numerical_errors.{name}.time_step", step)
        r.key(f"numerical_errors.{name}.rate", rate)
        r.key(f"numerical_errors.{name}.damping",
              max(abs(runs[k][name] - value) / value for k in ("half_damping", "double_damping")))
        resolution = errors[name]["resolution"]
        if r.peak:
            row, column = r.peak, r.curve["axial_stress" if name == "peak_stress" else "axial_strain"]
            r.key(f"numerical_errors.{name}.resolution", abs(column[row] - column[row - 1]) / value)
        stated = math.hypot(resolution, max(3 * rate, 2.92 * math.sqrt(2) * spread / value))
        r.key(f"numerical_errors.{name}.stated", stated, 1e-3)  # 2.92 stands for 2.91999
    for part in ("time_step", "rate", "damping", "resolution"):
        r.key(f"numerical_errors.youngs_modulus.{part}", 0.0)
    moved = {name: max(errors[name]["time_step"], errors[name]["rate"]) for name in peak}
    r.key("peak_converged", bool(moved["peak_stress"] <= 0.03 and moved["peak_strain"] <= 0.1))


def recount(folder):
    r = Recount(Results(folder))
    recount_curve(r)
    recount_packing(r)
    recount_cells(r)
    if r.results.key("numerics", "contact_law", "rounded") == "rounded" or r.results.polygons is None:
        model = Model(r.results)
        if model.minerals:
            recount_minerals(r, model)
        bonds = recount_specimen(r, model)
        recount_given(r, model)
        recount_events(r, model, bonds)
        recount_slips(r, model, bonds)
        recount_parting(r, model)
        rows = r.results.frame_rows()
        if len(r.events["time"]):
            recount_places(r, model, rows)
        if holds_every_step(r, rows):
            recount_history(r, model, bonds, rows)
        first = r.results.frame(rows[0])
        picked = sorted({rows[round(k * (len(rows) - 1) / 6)] for k in range(7)})
        for row in picked:
            frame = r.results.frame(row)
            at = np.flatnonzero(np.abs(r.curve["time"] - frame.time) <= 1e-12 * max(frame.time, 1e-300))
            recount_frame(r, model, bonds, frame, first, int(at[0]) if len(at) else None)
    recount_errors(r)
    return r


def shown(value):
    return f"{value:.9g}" if isinstance(value, (int, float, np.floating, np.integer)) and not isinstance(value, bool) else str(value)


def figures(table, before=""):
    """Names of all numbers of the summary."""
    names = set()
    for name, value in table.items():
        if isinstance(value, dict):
            names |= figures(value, before + name + ".")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            names.add(before + name)
    return names


def main(arguments):
    if len(arguments) != 1 or arguments[0] in ("-h", "--help"):
        print("Usage: tools/recount OUT\n\nComputes the figures of the test in OUT again from its files; exits 1 if one differs.")
        return 0 if arguments and arguments[0] in ("-h", "--help") else 2
    try:
        r = recount(arguments[0])
    except Unreadable as error:
        print(f"recount: {error}", file=sys.stderr)
        return 2
    wide = max(len(line[0]) for line in r.lines)
    for name, stated, ours, difference, tolerance, holds in r.lines:
        print(f"{'ok    ' if holds else 'DIFFERS'} {name:{wide}}  {shown(stated):>17}  {shown(ours):>17}  "
              f"{difference:.1e} of {tolerance:.1e}")
    print("not recounted: " + ", ".join(sorted(figures(r.summary) - r.keys)))
    bad = sum(not line[5] for line in r.lines)
    print(f"recount: {len(r.lines)} figures, {bad} differ")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
