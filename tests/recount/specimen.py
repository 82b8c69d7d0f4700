# SPDX-License-Identifier: GPL-3.0-or-later
"""The bonded specimen before loading: packing, minerals, cells, contacts, stable step; `r` and `model` as in frames.py."""

import math

import numpy as np

from bonded_faces import make_faces
from bonds import make_bonds
from frames import touching_floor
from loading_by_tolerance import by_tolerance, recount_start
from model import rounding, together
from outlines import outset, polygon_moments


def recount_packing(r):
    """Figures packing.*, from the circles between their walls (specimens/packing/METHODS.md)."""
    deck = r.results.circles
    if deck is None or "packing" not in r.summary:
        return
    circles = np.concatenate([b.circles for b in deck.bodies])
    x, y, radius = circles.T
    box, solid = deck.width * deck.height, np.sum(math.pi * radius**2)
    r.key("packing.void_ratio", (box - solid) / solid)
    stiffness = deck.materials[-1]["normal_stiffness"]  # that of [material], which follows the minerals
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
    # This is a residual of cancelling forces; coordinates have rounding errors of 1e-16 of the box.
    r.key("packing.unbalanced", np.hypot(*force.T).max() / mean, floor=20 * 1e-16 * deck.height / mean)


def recount_minerals(r, model):
    """Area share, grains and material of each mineral (specimens/making/METHODS.md)."""
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
    """Figures packing.cell_*, from the polygons after moving their edges outwards by the depth of the inset (specimens/making/METHODS.md)."""
    if "cell_diameter" not in r.summary.get("packing", {}):
        return
    depth = r.results.key("mesh", "inset", r.results.key("mesh", "thick") / 2)
    diameter = []
    for body in r.results.polygons.bodies:
        area = polygon_moments(outset(body.corners, depth))[0]
        diameter.append(math.sqrt(4 * area / math.pi))
    diameter = np.array(diameter)
    # If the inset has removed an edge, moving outwards gives a corner that is too far out; about one cell in ten gains
    # an area of depth squared.
    lost = 0.1 * (depth / diameter.mean()) ** 2
    r.key("packing.cell_diameter", diameter.mean(), lost + 1e-9)
    r.key("packing.cell_spread", diameter.std() / diameter.mean(), 30 * lost + 1e-9)


def stable(model, stiffness, damping, step):
    """Whether leapfrog is stable with this step, by solver/MODEL.md 7."""
    root = np.concatenate([np.repeat(model.mass[: model.count, None], 2, 1), model.inertia[: model.count, None]], 1)
    root = 1 / np.sqrt(root.ravel())
    free = np.arange(len(root))
    k, c = (root[:, None] * matrix[np.ix_(free, free)] * root for matrix in (stiffness, damping))
    try:
        np.linalg.cholesky(4 * np.eye(len(root)) - 2 * step * c - step * step * k)
    except np.linalg.LinAlgError:
        return False
    return True


def leave_loose(r, name):
    for suffix in ("", "_pa"):
        if name + suffix in r.summary:
            r.leave(name + suffix, "a particle that it is read from moves without a force")


def recount_contacts(r, model, bonds):
    """Contact points when loading begins; those between bodies with a common face are only listed once it has broken."""
    bonded = set(bonds.keys())
    points = model.points(model.centre, np.zeros(len(model.mass)))  # with the properties that bonding has set
    beyond = points.overlap - points.rest
    unbonded = np.array([key not in bonded for key in points.keys()]) & ~(points.lap <= 0)
    if model.by_faces:
        with_face = set(map(frozenset, zip(bonds.i.tolist(), bonds.j.tolist())))
        unbonded &= np.array([frozenset(pair) not in with_face for pair in zip(points.i.tolist(), points.j.tolist())])
    # Whether flat faces touch at the start depends on rounding.
    floor = touching_floor * model.height * (model.frictional | ~np.isnan(points.lap))
    fewest, most = (len(bonds.i) + np.sum(unbonded & (beyond > side * floor)) for side in (1, -1))
    r.compare("contacts_initial", r.summary["contacts_initial"], (fewest + most) / 2, (most - fewest) / 2)
    r.keys.add("contacts_initial")


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
    bonds = make_faces(model) if model.by_faces else make_bonds(model, model.points(model.centre, np.zeros(len(model.mass))))
    r.key("bonds_initial", len(bonds.i))
    recount_contacts(r, model, bonds)
    pairs = {(min(a, b), max(a, b)) for a, b in zip(bonds.i, bonds.j)}
    r.key("interfaces_initial", len(pairs))
    tension = model.normal_stiffness(bonds) * bonds.overlap
    # In a mesh, gaps and overlaps nearly cancel.
    tiny = 1e-15 * model.height
    r.key("mean_bond_overlap", bonds.overlap.mean(), floor=rounding * np.abs(bonds.overlap).mean() + tiny)
    scale = rounding * np.abs(tension).mean() + tiny * model.normal_stiffness(bonds).mean()
    r.key("mean_back_tension", tension.mean(), floor=scale)
    r.key("mean_back_tension_interface", tension.sum() / len(pairs), floor=scale * len(tension) / len(pairs))
    r.key("bonds_unbreakable", int(np.sum(bonds.held)))
    glued = r.results.key("loading", "platens") == "glued"
    r.key("grip", r.results.key("loading", "grip", 0.0) * model.height if glued else 0.0)
    if (model.coulomb or model.by_faces) and not np.all(bonds.held):
        r.key("mean_tensile_strength", bonds.tensile[~bonds.held].mean())
        r.key("mean_cohesion", bonds.cohesion[~bonds.held].mean())
    if s.get("youngs_modulus"):
        density = model.mass[: model.count].sum() / (model.width * model.height)
        r.key("wave_transit_time", model.height / math.sqrt(s["youngs_modulus"] / density))
    if model.frictional or len(model.mass) > 1500:
        return bonds
    stiffness, damping = bonds.matrices(model) if model.by_faces else model.matrices(together(bonds, model.closed), model.centre)
    free = np.arange(3 * model.count)
    solution = np.zeros(3 * len(model.mass))
    solution[3 * model.top + 1] = -model.sense * model.height  # axial strain 1
    scale = np.diag(stiffness)[free]
    scale = 1 / np.sqrt(np.where(scale > 0, scale, scale.max()))
    scaled = scale[:, None] * stiffness[np.ix_(free, free)] * scale
    load = -scale * (stiffness[free] @ solution)
    values, vectors = np.linalg.eigh(scaled)
    regular = values > 1e-11  # floating bodies and mechanisms can move without a force
    solution[free] = scale * (vectors[:, regular] @ ((vectors[:, regular].T @ load) / values[regular]))
    force = stiffness @ solution
    stress = (force[3 * model.bottom + 1] - force[3 * model.top + 1]) / 2 / model.width * model.sense
    strained = -solution[3 * model.top + 1] / model.height * model.sense
    # The eigenvectors of the softest modes contain rounding errors of the stiffest, 1e-16 over the smallest eigenvalue.
    if stress * model.width < 1e-9 * strained * model.height * model.normal_stiffness(bonds).max():
        stress = math.nan  # no bonds connect the platens
    r.key("youngs_modulus", stress / strained, 1e-7)
    loose = np.abs(scale[:, None] * vectors[:, ~regular]).reshape(model.count, -1).max(axis=1, initial=0.0)
    elastic = loose <= 1e-6 * scale.max()
    if by_tolerance(r) and not math.isnan(stress):
        recount_start(r, model, bonds, solution, stress / strained, elastic)
    bottom, top = model.axial_gauge(bonds)
    if not np.all(elastic[np.concatenate([bottom, top])]):
        leave_loose(r, "gauge_modulus")
    elif len(bottom) and len(top):
        length = model.centre[top, 1].mean() - model.centre[bottom, 1].mean()
        growth = solution[3 * top + 1].mean() - solution[3 * bottom + 1].mean()
        r.key("gauge_modulus", stress / (-model.sense * growth / length), 1e-6)
    else:
        r.key("gauge_modulus", math.nan)
    left, right = model.gauge()
    if not np.all(elastic[left + right]):
        leave_loose(r, "poissons_ratio")
    elif left and right and (r.results.circles is None or not model.polygons or r.results.key("mesh", "kind") == "voronoi"):
        length = model.centre[right, 0].mean() - model.centre[left, 0].mean()
        growth = solution[3 * np.array(right)].mean() - solution[3 * np.array(left)].mean()
        r.key("poissons_ratio", model.sense * growth / length + 0 * stress, 1e-6)
    if s.get("numerical_errors") is not None and r.results.key("numerics", "contact_law", "rounded") == "rounded":
        step = s["stable_time_step"]
        r.true("stable_time_step: stable", stable(model, stiffness, damping, step))
        r.true("stable_time_step: unstable two millionths above", not stable(model, stiffness, damping, step * (1 + 2e-6)))
        r.keys.update({"stable_time_step", "time_step_bound"})
        if not model.by_faces and len(model.closed.i):  # faces of open joints carry forces only after the first step
            stiffness, damping = model.matrices(bonds, model.centre)
        r.true("time_step_bound: stable for what bears when loading begins", stable(model, stiffness, damping, s["time_step_bound"]))
        if r.results.key("numerics", "time_step") is None:
            r.key("time_step_over_stable", s["time_step"] / step)
    return bonds
