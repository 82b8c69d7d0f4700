# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures that follow from the frames of a test: contacts, forces, stresses, energies, fragments, places of events.

`r` is a recount.Recount, `model` the specimen between its platens, `bonds` its bonded points at the start."""

import math

import numpy as np

from measures import recount_fragments
from model import dot, platen_depth, rounding, turned


touching_floor = 1e-14  # fraction of the height: whether bodies that rest on frictional platens touch them depends on rounding
least_sliding_force = 1e-9  # fraction of the mean strength


def recount_places(r, model, bonds, rows, what, e):
    """Compares places and orientations of events or slips with the bodies in the frames before and after each.

    @param what  their name  @param e  their table"""
    times, places = [], []
    for row in rows:
        p = r.results.particles(row)
        times.append(float(p["time"][0]))
        places.append(bodies_of(model, p)[1])
    circle = {b: radius for b, radius in zip(model.circle_body, model.circle_radius)}
    across = {frozenset((i, j)): normal for i, j, lap, normal in zip(bonds.i, bonds.j, bonds.lap, bonds.normal) if lap > 0}
    off, turned_by, allowed, allowed_turn = [], [], [], []
    for k in range(len(e["time"])):
        after = min(int(np.searchsorted(times, e["time"][k])), len(times) - 1)
        before = max(after - 1, 0)
        i, j = model.index[int(e["body_i"][k])], model.index[int(e["body_j"][k])]
        moved = max(math.dist(places[after][b], places[before][b]) for b in (i, j))
        at = np.array([e["x"][k], e["y"][k]])
        for b in (i, j):
            if b >= model.count:  # for platens, their face
                face = places[before][b, 1] + (1 if b == model.bottom else -1) * platen_depth * model.height / 2
                off.append(abs(at[1] - face))
                allowed.append(moved + 2 * model.thick)
                continue
            distance = math.dist(at, places[before][b])
            if frozenset((i, j)) in across:  # for flat faces, midway between the centres
                off.append(distance - math.dist(places[before][i], places[before][j]) / 2)
            elif b in circle:
                off.append(distance - circle[b])
            else:
                off.append(max(distance - model.reach[b], 0.0))
            allowed.append(moved + 2 * model.thick + model.reach_of_bonds)
        if not model.polygons:
            way = places[before][j] - places[before][i]
            if max(i, j) >= model.count:
                way = np.array([0.0, 1.0])
            way = across.get(frozenset((i, j)), way)
            difference = (e["orientation"][k] - math.atan2(way[1], way[0]) + math.pi / 2) % math.pi - math.pi / 2
            turned_by.append(difference)
            allowed_turn.append(1e-9 + 2 * moved / model.circle_radius.min())
    r.rows(f"{what}: place on the surfaces of both bodies", off, np.zeros(len(off)), allowed)
    if turned_by:
        r.rows(f"{what}: orientation along the centres", turned_by, np.zeros(len(turned_by)), allowed_turn)
    half = np.abs(e["orientation"]) <= math.pi / 2
    r.true(f"{what}: orientation in (-pi/2, pi/2]", np.all(half))


def match(model, points, frame, first_frame, bonds):
    """Index into `points` of each contact of a frame, found by pair and place; for bonds by their place at the start."""
    names = frame.contacts
    i = np.array([model.index[n] for n in names["body_i"]])
    j = np.array([model.index[n] for n in names["body_j"]])
    places = contact_places(model, frame)
    start_places = contact_places(model, first_frame)
    by_pair, start_by_pair = {}, {}
    for k, pair in enumerate(zip(points.i, points.j)):
        by_pair.setdefault(frozenset(pair), []).append(k)
    for k, pair in enumerate(zip(bonds.i, bonds.j)):
        start_by_pair.setdefault(frozenset(pair), []).append(k)
    key_of = {(a, b, c): k for k, (a, b, c) in enumerate(zip(points.i, points.element, points.j))}
    chosen = np.full(len(i), -1)
    of_bond = np.full(len(i), -1)
    taken = set()
    for k in range(len(i)):
        pair = frozenset((i[k], j[k]))
        if names["state"][k] != 4:
            own = [m for m in start_by_pair.get(pair, []) if m not in taken]
            if not own:
                continue
            # Two corners that meet make two points at one place; in the file, the body of the point's corner comes
            # first.
            m = min(own, key=lambda m: (bonds.i[m] != i[k], math.dist(bonds.position[m], start_places[k])))
            taken.add(m)
            of_bond[k] = m
            chosen[k] = key_of.get((bonds.i[m], bonds.element[m], bonds.j[m]), -1)
    used, floor = set(chosen), touching_floor * model.height
    moved = forces_by_history(model, points, np.zeros(len(points.i), bool))
    for k in np.flatnonzero(names["state"] == 4):
        near = by_pair.get(frozenset((i[k], j[k])), [])
        own = [m for m in near if (points.overlap[m] > points.rest[m] - floor or moved[m]) and m not in used]
        if own:
            chosen[k] = min(own, key=lambda m: (points.i[m] != i[k], math.dist(points.position[m], places[k])))
            used.add(chosen[k])
    return chosen, of_bond


def contact_places(model, frame):
    drawn = frame.contacts["points"][:, :2]
    count = len(frame.contacts["body_i"])
    if model.polygons:
        return drawn.reshape(count, 2, 2).mean(axis=1)
    return drawn[len(drawn) - count :]


def bodies_of(model, p):
    """Indices in the model of a frame's particles; then place, angle, velocity and rotation rate by body."""
    order = np.array([model.index[n] for n in p["id"]])
    places, velocity = model.centre.copy(), np.zeros((len(model.mass), 2))
    angle, spin = np.zeros(len(model.mass)), np.zeros(len(model.mass))
    places[order] += p["displacement"][:, :2]
    velocity[order] = p["velocity"][:, :2]
    angle[order], spin[order] = p["angle"], p["rotation_rate"]
    return order, places, angle, velocity, spin


def relative_motion(q, places, velocity, spin):
    """Lever arms of both bodies to each point, and the velocity of i relative to j there."""
    arm_i, arm_j = q.position - places[q.i], q.position - places[q.j]
    way = (velocity[q.i] + turned(arm_i) * spin[q.i][:, None]) - (velocity[q.j] + turned(arm_j) * spin[q.j][:, None])
    return arm_i, arm_j, way


def force_scale(model, bonds):
    """Force to which rounding errors are relative, N."""
    return bonds.tensile.mean()


def sliding_scale(model, bonds):
    """Mean tensile strength of the coulomb bonds that can break, or mean back-tension, N."""
    if not model.coulomb:
        return np.mean(model.normal_stiffness(bonds) * bonds.overlap)
    return 0.0 if np.all(bonds.held) else bonds.tensile[~bonds.held].mean()


def forces_by_history(model, q, bonded):
    """Points whose force-free overlap has changed: flat faces, which rotate, and joints, which dilate as they slide."""
    dilates = model.joints.of("dilation_angle", q.trace, 0.0) > 0
    return ~np.isnan(q.lap) | (dilates & ~bonded)


def recount_by_history(r, model, bonds, label, q, bonded, angle, stated, normal, kn, places):
    """Checks what is known about the forces of such points. @param stated, normal  N, force in the file, and force for an unchanged
    force-free overlap"""
    flat, found = ~np.isnan(q.lap), stated - normal
    turned_only, slid_open = flat & bonded, ~flat & forces_by_history(model, q, bonded)
    if turned_only.any():
        # To first order, the rotation of both circles closes their faces.
        tangent = turned(q.normal)
        offset, before = (dot(at[q.j] - at[q.i], tangent) for at in (places, model.centre))
        # They may have rotated back and forth, at most as far as any circle.
        room = np.abs(offset - before)[turned_only].max() * (np.abs(angle[q.i]) + np.abs(angle[q.j]))[turned_only].max()
        closed = kn * before * (angle[q.i] + angle[q.j]) / 2
        r.rows(label + "normal_force of bonded flat faces, by their turn", found[turned_only], -closed[turned_only],
               (kn * (room + 1e-15 * model.height))[turned_only])
    if slid_open.any():
        least, rise, slip = (values[slid_open] for values in (
            found, np.tan(np.radians(model.joints.of("dilation_angle", q.trace, 0.0))),
            model.joints.of("dilation_slip", q.trace, math.inf)))
        beyond = np.maximum(0.0, np.maximum(-least, least - kn[slid_open] * rise * slip))
        r.rows(label + "normal_force within what dilation can add", beyond, 0 * beyond, rounding * force_scale(model, bonds))
        r.leave("frames: normal_force of faces that dilate", "how far they have slid is in no frame")
    if np.any(flat & ~bonded):
        r.leave("frames: normal_force of flat faces without a bond", "what their circles have turned by as they touched is in no frame")


def recount_frame(r, model, bonds, frame, first, row):
    """Forces, stresses, energies and fragments of one frame. @param row  its row in the curve, or None if it was not written"""
    label = f"frame {frame.row}: "
    p = frame.particles
    order, places, angle, velocity, spin = bodies_of(model, p)
    asked = r.results.key("output", "frame_precision", "single")
    r.true(label + f"points in {asked} precision", p["points"].dtype == (np.float64 if asked == "double" else np.float32))
    points = model.points(places, angle)
    chosen, of_bond = match(model, points, frame, first, bonds)
    state = frame.contacts["state"]
    r.compare(label + "contacts without a partner", int(np.sum((chosen < 0) & ((state < 2) | (state > 2)))), 0, 0)
    # Whether faces touch after their force-free overlap has changed depends on the history.
    moved = forces_by_history(model, points, np.zeros(len(points.i), bool))
    known = (chosen < 0) | ~moved[chosen]
    bonded_once, beyond = set(bonds.keys()), points.overlap - points.rest
    loose = np.array([d for key, d, own in zip(points.keys(), beyond.tolist(), moved) if not own and key not in bonded_once])
    by_rounding = int(np.sum(np.abs(loose) <= touching_floor * model.height)) if model.frictional else 0
    r.compare(label + "contacts without a bond", int(np.sum((state == 4) & known)), int(np.sum(loose > 0)), by_rounding)
    parted = np.flatnonzero((chosen >= 0) & ((state == 2) | (state == 3)) & known)
    beyond = points.overlap[chosen[parted]] - model.rest_after(bonds.overlap[of_bond[parted]])
    r.compare(label + "broken bonds that touch again", int(np.sum((state == 3) & known)), int(np.sum(beyond > 0)),
              int(np.sum(np.abs(beyond) <= 2e-15 * model.height)))
    if model.coulomb or np.any(bonds.held):
        sticking = model.coulomb | bonds.held[of_bond[state == 1]]
        r.compare(label + "bonds at a limit that stick without one", int(np.sum(sticking)), 0, 0)
        gone = bonds.held[of_bond[(state == 2) | (state == 3)]]
        r.compare(label + "broken bonds that never break", int(np.sum(gone)), 0, 0)
    acting = (chosen >= 0) & (state != 2)
    q = points.chosen(chosen[acting])
    bond = of_bond[acting]
    bonded = (bond >= 0) & (state[acting] < 2)
    for name in ("share", "shear_share"):  # the laps of flat faces change once they are not bonded
        setattr(q, name, np.where(bonded, getattr(bonds, name)[bond], getattr(q, name)))
    rest = np.where(bonded, bonds.overlap[bond], np.where(bond >= 0, model.rest_after(bonds.overlap[bond]), q.rest))
    kn, ks = model.normal_stiffness(q), model.shear_stiffness(q)
    tension = force_scale(model, bonds)
    normal = kn * (q.overlap - rest)
    stated = np.asarray(frame.contacts["normal_force"])[acting]
    by_history = forces_by_history(model, q, bonded)
    recount_by_history(r, model, bonds, label, q, bonded, angle, stated, normal, kn, places)
    normal = np.where(by_history, stated, normal)
    r.rows(label + "normal_force", stated, normal, rounding * tension)
    shear = np.asarray(frame.contacts["shear_force"])[acting].copy()
    # The shear force in the file acts on its body_i. Its sign is the same here, even if body_i is our j.
    if model.coulomb:
        limit = np.where(bonded, math.inf, model.residual_friction(q) * normal)
    else:
        limit = np.where(bonded & bonds.held[bond], math.inf, model.friction(q) * kn * q.overlap)
    r.true(label + "shear within the Coulomb limit", np.all(np.abs(shear) <= limit + rounding * tension))
    arm_i, arm_j, relative = relative_motion(q, places, velocity, spin)
    cn, cs = model.dashpots(q)
    tangent = turned(q.normal)
    normal_all = normal + cn * dot(relative, q.normal)
    slides = np.abs(shear) >= limit * (1 - rounding) - 1e-15 * model.height * kn
    sticks = ~slides
    counted = np.abs(shear) > least_sliding_force * sliding_scale(model, bonds)
    shear_all = shear - np.where(sticks, cs * dot(relative, tangent), 0.0)
    force = -q.normal * normal_all[:, None] + tangent * shear_all[:, None]  # force on i
    total, moment = np.zeros_like(velocity), np.zeros(len(spin))
    for body, arm, sign in ((q.i, arm_i, 1.0), (q.j, arm_j, -1.0)):
        np.add.at(total, body, sign * force)
        np.add.at(moment, body, sign * (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]))
    stress_top, stress_bottom = (model.sense * total[model.top, 1] / model.width,
                                 -model.sense * total[model.bottom, 1] / model.width)
    fine = rounding * tension * math.sqrt(len(kn)) / model.width
    r.compare(label + "axial_stress", frame.axial_stress, (stress_top + stress_bottom) / 2, fine)
    strain = model.sense * -p["displacement"][list(p["id"]).index(model.ids[model.top]), 1] / model.height
    confined = r.summary["kind"] == "biaxial"  # strains are measured from the application of the pressure, displacements from bonding
    if not confined:
        r.compare(label + "axial_strain", frame.axial_strain, strain, 1e-14)
    # The particles' mean stress contains only the forces of the springs, without the back-tension.
    springs = -q.normal * normal[:, None] + tangent * shear[:, None]
    sums = np.zeros((len(spin), 3))
    for body, arm, sign in ((q.i, arm_i, 1.0), (q.j, arm_j, -1.0)):
        f = sign * springs
        sym = np.stack([arm[:, 0] * f[:, 0], arm[:, 1] * f[:, 1],
                        (arm[:, 0] * f[:, 1] + arm[:, 1] * f[:, 0]) / 2], 1)
        np.add.at(sums, body, -sym / model.area[body][:, None])
    compare_stresses(r, model, label, p, order, sums, tension)
    recount_pieces(r, model, label, frame, order)
    if row is None:
        return
    c = r.curve
    r.compare(label + "curve: axial_stress", c["axial_stress"][row], (stress_top + stress_bottom) / 2, fine)
    r.compare(label + "curve: stress_top", c["stress_top"][row], stress_top, fine)
    r.compare(label + "curve: stress_bottom", c["stress_bottom"][row], stress_bottom, fine)
    spring = np.sum(normal**2 / kn / 2 + np.where(ks > 0, shear**2 / np.where(ks > 0, ks, 1) / 2, 0))
    # Forces and energies of the consistent integrator contain corrections at the points, which are in no file.
    leapfrog = r.results.key("numerics", "integrator", "leapfrog") == "leapfrog"
    if leapfrog:
        r.compare(label + "curve: strain_energy", c["strain_energy"][row], spring,
                  rounding * (spring + tension**2 / kn.mean()))
    if leapfrog and (not confined or row == 0):  # the membrane's forces, which are part of a kick, are in no file
        recount_kinetic(r, model, label, row, velocity, spin, total, moment)
    if leapfrog:
        # A bond that breaks in shear in this step drops to the limit; it counts as a break, not as sliding.
        breaking = int(np.sum(r.events["step"] == c["step"][row])) if model.coulomb and len(r.events["step"]) else 0
        # The program stores rotations as cosine and sine, but frames contain the angle; the two differ by up to one
        # rounding per step. At a stiff point this exceeds the rounding of the shear force, so whether it is at its
        # limit is not certain.
        arm = np.maximum(np.hypot(*arm_i.T), np.hypot(*arm_j.T))
        apart = np.finfo(float).eps * c["step"][row] * arm * kn
        unsure = counted & sticks & (np.abs(shear) >= limit - apart)
        # Nothing moves or slides before the first step.
        sliding = int(np.sum(slides & counted)) if row > 0 else 0
        r.compare(label + "curve: points_sliding", c["points_sliding"][row], sliding, breaking + int(np.sum(unsure)))
    slid = int(np.sum(state == 1)) + int(np.sum(np.asarray(r.events["slid"])[: events_up_to(r, frame)]))
    r.compare(label + "curve: bonds_slid", c["bonds_slid"][row], slid, 0)
    if confined:
        return
    recount_gauges(r, model, bonds, label, row, places)


def events_up_to(r, frame):
    """Number of rows of events.csv up to the time of a frame."""
    return int(np.sum(r.events["time"] <= frame.time * (1 + 1e-12))) if len(r.events["time"]) else 0


def compare_stresses(r, model, label, p, order, sums, force, rows=slice(None)):
    """Mean stresses in particles. @param sums  by body, Pa @param force  N, scale of rounding @param rows  of the frame that are compared"""
    sums[model.count :] = 0.0
    size = force / model.reach[: model.count].min()
    for k, name in enumerate(("stress_xx", "stress_yy", "stress_xy")):
        r.rows(label + name, p[name][rows], sums[order, k], 10 * rounding * size)


def recount_pieces(r, model, label, frame, order):
    """Fragments, and the broken bonds of a frame against events.csv. @param order  indices in the model of the frame's particles"""
    state = frame.contacts["state"]
    # Fragments are particles joined by intact bonds, numbered by decreasing area, then by lowest id.
    root = list(range(model.count))

    def find(a):
        while root[a] != a:
            root[a] = root[root[a]]
            a = root[a]
        return a

    intact = state < 2
    for a, b in zip(frame.contacts["body_i"][intact], frame.contacts["body_j"][intact]):
        a, b = model.index[a], model.index[b]
        if a < model.count and b < model.count:
            root[find(a)] = find(b)
    groups = {}
    for k in range(model.count):
        groups.setdefault(find(k), []).append(k)
    all_area = model.area[: model.count].sum()  # areas that differ only by rounding count as equal
    ranked = sorted(groups.values(), key=lambda g: (-round(sum(model.area[k] for k in g) / all_area, 12), min(model.ids[k] for k in g)))
    number = np.full(len(model.mass), -1)
    for n, group in enumerate(ranked):
        number[group] = n
    r.rows(label + "fragment", frame.particles["fragment"], number[order], 0)
    if frame.time == r.curve["time"][-1]:
        r.key("fragments", len(ranked))
        r.key("largest_fragment_share", model.area[ranked[0]].sum() / all_area)
        recount_fragments(r, model, [model.area[group].sum() for group in ranked])
    broken = int(np.sum((state == 2) | (state == 3)))
    by_events = events_up_to(r, frame)
    r.compare(label + "broken bonds of events.csv", broken, by_events, 0)
    for name in ("time", "energy", "strength", "orientation", "body_i", "body_j", *(("trace",) if model.joints.traces else ())):
        drawn = frame.cracks.get("polygon time" if name == "time" else name, [])  # the first array of this name is the time of the frame
        r.rows(label + f"cracks: {name} of events.csv", drawn, r.events[name][:by_events], 0)
    shears = [float(mode == "shear") for mode in r.events["mode"][:by_events]]
    r.rows(label + "cracks: mode of events.csv", frame.cracks.get("mode", []), shears, 0)
    gone = sorted(tuple(sorted(pair)) for pair in zip(frame.contacts["body_i"][(state == 2) | (state == 3)],
                                                      frame.contacts["body_j"][(state == 2) | (state == 3)]))
    rows = [(int(a), int(b)) for a, b in zip(r.events["body_i"], r.events["body_j"])][:by_events]
    r.true(label + "broken pairs are those of events.csv", gone == sorted(tuple(sorted(pair)) for pair in rows))


def recount_kinetic(r, model, label, row, velocity, spin, total, moment, unsure=0.0):
    """Kinetic energy of a row, from the velocities half a step before and all forces. @param unsure  J, by what the files do not say"""
    c = r.curve
    free = slice(0, model.count)

    def kinetic_after(kick):
        middle = velocity[free] + kick / 2 * total[free] / model.mass[free, None]
        middle_spin = spin[free] + kick / 2 * moment[free] / model.inertia[free]
        own = model.mass[free] * dot(middle, middle) + model.inertia[free] * middle_spin**2
        return (own.sum() + np.sum(model.mass[model.count :] * dot(velocity, velocity)[model.count :])) / 2

    # If the time step changes, only its mean between two rows is known; at the start there has been no kick.
    steps = np.diff(c["time"]) / np.diff(c["step"])
    before, after = steps[max(row - 1, 0)], steps[min(row, len(steps) - 1)]
    kinetic = kinetic_after((before + after) / 2 if row > 0 else 0.0)
    either = abs(kinetic_after(before) - kinetic_after(after)) if row > 0 else 0.0
    if row == len(steps) and np.ptp(steps) > rounding * before:
        either += abs(kinetic_after(1.01 * before) - kinetic)  # the length of the next step is in no file
    r.compare(label + "curve: kinetic_energy", c["kinetic_energy"][row], kinetic, 1e-6 * kinetic + either + unsure)


def recount_gauges(r, model, bonds, label, row, places):
    """Lateral and gauge strain of a row."""
    c = r.curve
    left, right = model.gauge()
    by_seeds = model.polygons and r.results.key("mesh", "kind") == "delaunay" and r.results.key("mesh", "boundary") == "seeds"
    if left and right and not by_seeds:
        length = model.centre[right, 0].mean() - model.centre[left, 0].mean()
        now = places[right, 0].mean() - places[left, 0].mean()
        r.compare(label + "curve: lateral_strain", c["lateral_strain"][row], now / length - 1, 1e-13)
    bottom, top = model.axial_gauge(bonds)
    if len(bottom) and len(top):
        length = model.centre[top, 1].mean() - model.centre[bottom, 1].mean()
        now = places[top, 1].mean() - places[bottom, 1].mean()
        r.compare(label + "curve: gauge_strain", c["gauge_strain"][row], -model.sense * (now / length - 1), 1e-13)
    else:
        r.compare(label + "curve: gauge_strain", c["gauge_strain"][row], math.nan, 0)
