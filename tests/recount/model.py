# SPDX-License-Identifier: GPL-3.0-or-later
"""The specimen between its platens: masses, contact points, laws, small-strain solution (solver/MODEL.md 2 to 7).

Written from the documents, not from the program. Values are arrays over bodies or contact points, in SI units, per unit thickness."""

import math
from dataclasses import dataclass

import numpy as np

from flat_faces import lay_faces, meetings
from joints import sides_of_bodies
from outlines import clump_centre, outset, polygon_moments

# Relative rounding error of sums of thousands of terms, and of overlaps, which are 1e-4 of the coordinates they are
# computed from.
rounding = 1e-9
shear_correction = {"voronoi": 0.30, "delaunay": 0.79}  # c_κ of faces by the kind of mesh
platen_width, platen_depth = 2.0, 0.05  # fractions of the specimen's width and height (specimens/setup/METHODS.md)


def dot(a, b):
    return np.einsum("ij,ij->i", a, b)


def turned(v):
    """By +90 degrees."""
    return np.stack([-v[:, 1], v[:, 0]], axis=1)


def moduli(youngs_modulus, poissons_ratio, stiffness_ratio, c):
    """E_c and λ (Pa) of faces, and κ = k_t/k_n (solver/MODEL.md 5.5). @param stiffness_ratio  k_n/k_t; None for cells without pressure
    @param c  c_κ"""
    e, nu = youngs_modulus, poissons_ratio
    if stiffness_ratio is None:  # λ = 0: (1 + ν)(1 - c x²) = (1 - ν)(1 + x) with x = (1 - κ)/(1 + κ)
        a = (1 + nu) * c
        x = (math.sqrt((1 - nu) ** 2 + 8 * a * nu) - (1 - nu)) / (2 * a)
        return e / (1 - nu), 0.0, (1 - x) / (1 + x)
    kappa = 1 / stiffness_ratio
    contact = 2 * e / ((1 + nu) * (1 + kappa) * (1 - c * ((1 - kappa) / (1 + kappa)) ** 2))
    return contact, e / (2 * (1 - nu)) - contact / 2, kappa


def single(values):
    """The value rounded to single precision."""
    return values.astype(np.float32).astype(float)


def unset(points):
    """Properties of Points besides their geometry, with the values for rock in point units."""
    count = len(points)
    return np.ones(count), np.ones(count), np.full(count, math.nan), np.full(count, -1), np.zeros(count)


def together(*parts):
    """Combines points of several kinds into one table."""
    return Points(*(np.concatenate([getattr(p, name) for p in parts]) for name in Points.__dataclass_fields__))


@dataclass
class Points:
    """Contact points between an element (circle or corner) of body i and body j."""

    i: np.ndarray
    element: np.ndarray
    j: np.ndarray
    overlap: np.ndarray  # m
    normal: np.ndarray  # from i to j
    position: np.ndarray  # m
    share: np.ndarray  # fraction of the material's stiffness, solver/MODEL.md 4.5; 1 in point units
    shear_share: np.ndarray  # fraction of the shear stiffness, which joints change separately
    lap: np.ndarray  # m, for the flat faces of two circles; NaN for other points
    trace: np.ndarray  # index of the trace that the point crosses, or -1 in the rock
    rest: np.ndarray  # m, force-free overlap of a point that has never been bonded

    def fields(self):
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    def chosen(self, which):
        return type(self)(**{name: values[which] for name, values in self.fields().items()})

    def keys(self):
        return list(zip(self.i.tolist(), self.element.tolist(), self.j.tolist()))


class Model:
    """The bodies in the order of the particle file, followed by the lower and the upper platen."""

    def __init__(self, results, joints):
        self.results = results
        deck = results.specimen
        self.deck = deck
        self.polygons = deck.bodies[0].corners is not None
        self.width, self.height = deck.width, deck.height
        self.materials = [dict(m) for m in deck.materials]
        self.by_area = results.key("material", "units", "point") == "area"
        law = results.key("bond", "law", "back_tension")
        self.coulomb, self.by_faces = law == "coulomb", law == "face"
        self.minerals = results.case.get("mineral", [])
        for k, m in enumerate(self.materials):
            own = self.minerals[k] if k < len(self.minerals) else {}
            m["ratio"] = own.get("damping_ratio", results.key("material", "damping_ratio"))
            if self.by_faces:
                self._set_face_law(m, own)
            elif self.by_area:  # Pa
                modulus, ratio = (own.get(key, results.key("material", key)) for key in ("contact_modulus", "stiffness_ratio"))
                m["normal_stiffness"], m["shear_stiffness"] = modulus, modulus / ratio
            stated = results.key("material", "residual_friction_angle", m["friction_angle"])
            m["residual_friction_angle"] = own.get("residual_friction_angle", stated)
            for strength in ("tensile_strength", "cohesion"):
                m[strength] = own.get(strength, results.key("material", strength, 0.0))
        self.pairs = self._named_pairs()
        inset = results.key("mesh", "inset")
        self.mesh_gap = 2 * inset if inset else results.key("mesh", "thick", deck.thick)
        self.thick = results.summary["bond_thick"] if not self.polygons else results.key("bond", "thick", self.mesh_gap)
        self.reach_of_bonds = self._reach_of_bonds()
        self._kept = {}  # for points that were bonded or open at the start: share, shear share, trace, force-free overlap
        self.joints = joints
        self.sides, self.flat_faces, self.parted = {}, [], set()
        self.frictional = results.key("loading", "platens") == "frictional"
        self.sense = -1.0 if results.key("loading", "kind") == "tension" else 1.0
        largest = max(b.id for b in deck.bodies)
        self.ids = [b.id for b in deck.bodies] + [largest + 1, largest + 2]
        self.index = {name: k for k, name in enumerate(self.ids)}
        self.count = len(deck.bodies)
        self.bottom, self.top = self.count, self.count + 1
        self._place_platens()
        self._measure()

    def _set_face_law(self, m, own):
        """Sets the moduli and constants of faces in a material. @param own  its table in the case, which overrides [material]"""
        def given(key, otherwise=None):
            return own.get(key, self.results.key("material", key, otherwise))

        kind = self.results.key("mesh", "kind", "voronoi")
        m["face_modulus"], m["pressure_modulus"], m["shear_share"] = moduli(
            given("youngs_modulus"), given("poissons_ratio"), given("stiffness_ratio"), shear_correction[kind])
        m["normal_stiffness"], m["shear_stiffness"] = m["face_modulus"], m["face_modulus"] * m["shear_share"]
        for name in ("residual_cohesion", "residual_tensile_strength", "softening_slip", "softening_opening"):
            m[name] = given(name, 0.0)
        m["friction_knee"] = given("friction_knee", math.inf)
        m["friction_angle_beyond"], m["moment_share"] = given("friction_angle_beyond", m["friction_angle"]), given("moment_share", 0.0)

    def _reach_of_bonds(self):
        """Largest gap that is bonded, m."""
        if not self.coulomb or self.polygons:
            return 0.0
        return self.results.key("bond", "range", 0.0) * max(b.circles[:, 2].max() for b in self.deck.bodies)

    def _named_pairs(self):
        """For each [[mineral_pair]], the indices of its two materials, and its keys."""
        names = [m["name"] for m in self.minerals]
        pairs = []
        for table in self.results.case.get("mineral_pair", []):
            if self.by_area and "contact_modulus" in table:
                modulus = table["contact_modulus"]
                table = table | {"normal_stiffness": modulus, "shear_stiffness": modulus / table["stiffness_ratio"]}
            pairs.append(([names.index(name) for name in table["between"]], table))
        return pairs

    def _place_platens(self):
        deck = self.deck
        if self.polygons:
            low = min(b.corners[:, 1].min() for b in deck.bodies)
            high = max(b.corners[:, 1].max() for b in deck.bodies)
        else:
            low = min((b.circles[:, 1] - b.circles[:, 2]).min() for b in deck.bodies)
            high = max((b.circles[:, 1] + b.circles[:, 2]).max() for b in deck.bodies)
        gap = self.mesh_gap

        def offset(depth):
            if not self.polygons:
                return self.thick
            return gap / 2 if depth <= gap else gap - depth

        if self.frictional:
            y1, y2 = low - self.thick, high + self.thick
        else:
            y1, y2 = deck.y1 - offset(low - deck.y1), deck.y2 + offset(deck.y2 - high)
        middle, half, depth = (deck.x1 + deck.x2) / 2, platen_width * self.width / 2, platen_depth * self.height
        left, right = middle - half, middle + half
        self.platen_corners = [
            np.array([(right, y1), (left, y1), (left, y1 - depth), (right, y1 - depth)]),
            np.array([(left, y2), (right, y2), (right, y2 + depth), (left, y2 + depth)]),
        ]
        # The material of [material] follows those of the minerals.
        material = len(self.minerals) if self.minerals else self.deck.bodies[0].material
        if self.frictional:
            friction = dict(self.materials[material])
            angle = self.results.key("loading", "platen_friction_angle")
            friction["friction_angle"] = friction["residual_friction_angle"] = angle
            self.materials.append(friction)
            material = len(self.materials) - 1
        self.material = np.array([b.material for b in self.deck.bodies] + [material] * 2)

    def _measure(self):
        """Masses, centroids, outlines; `circles` rows (body, radius) and `outline` padded with the last corner."""
        area, inertia, centre, reach = [], [], [], []
        outlines, self.circle_body, self.circle_at, self.circle_radius = {}, [], [], []
        shapes = [(b.circles, b.corners) for b in self.deck.bodies] + [(None, c) for c in self.platen_corners]
        for k, (circles, corners) in enumerate(shapes):
            if circles is not None:
                a, c = math.pi * circles[:, 2] ** 2, clump_centre(circles)
                d2 = ((circles[:, :2] - c) ** 2).sum(axis=1)
                area.append(a.sum())
                inertia.append((a * (circles[:, 2] ** 2 / 2 + d2)).sum())
                self.circle_body += [k] * len(a)
                self.circle_at += list(circles[:, :2] - c)
                self.circle_radius += list(circles[:, 2])
                reach.append((np.sqrt(d2) + circles[:, 2]).max())
            else:
                a, c, second = polygon_moments(corners)
                area.append(a)
                inertia.append(second)
                outlines[k] = corners - c
                reach.append(np.hypot(*(corners - c).T).max())
            centre.append(c)
        self.area, self.centre, self.reach = np.array(area), np.array(centre), np.array(reach)
        density = np.array([self.materials[m]["density"] for m in self.material])
        self.mass, self.inertia = density * self.area, density * np.array(inertia)
        self.circle_body, self.circle_radius = np.array(self.circle_body, int), np.array(self.circle_radius)
        self.circle_at = np.array(self.circle_at).reshape(-1, 2)
        most = max((len(o) for o in outlines.values()), default=1)
        self.outline = np.zeros((len(self.mass), most, 2))
        self.corner_count = np.zeros(len(self.mass), int)
        for k, corners in outlines.items():
            self.outline[k] = np.concatenate([corners, np.repeat(corners[-1:], most - len(corners), axis=0)])
            self.corner_count[k] = len(corners)

    # laws of contacts between two bodies (solver/MODEL.md, section 4)

    def _pair(self, name, i, j):
        value = np.array([m[name] for m in self.materials])
        return value[self.material[i]], value[self.material[j]]

    @staticmethod
    def _series(a, b):
        return np.where(a + b > 0, 2 * a * b / np.where(a + b > 0, a + b, 1), 0.0)

    def series_of(self, name, p):
        """Value of two materials in series."""
        return self._series(*self._pair(name, p.i, p.j))

    def overridden(self, name, p, value):
        """Replaces values by those of [[mineral_pair]] tables."""
        a, b = self.material[p.i], self.material[p.j]
        for (c, d), table in self.pairs:
            if name in table:
                value = np.where(((a == c) & (b == d)) | ((a == d) & (b == c)), table[name], value)
        return value

    def _whole(self, name, p):
        """Stiffness of a pair of materials, before shares."""
        return self.overridden(name, p, self._series(*self._pair(name, p.i, p.j)))

    def normal_stiffness(self, p):
        return self._whole("normal_stiffness", p) * p.share

    def shear_stiffness(self, p):
        return self._whole("shear_stiffness", p) * p.shear_share

    def friction(self, p):
        return np.tan(np.radians(self._friction_angle(p)))

    def residual_friction(self, p):
        """Friction of contacts without a bond; the residual angle is limited to the friction angle."""
        angle = self.joints.of("friction_angle", p.trace, self.weaker("residual_friction_angle", p))
        angle = self.joints.of("residual_friction_angle", p.trace, angle)
        return np.tan(np.radians(np.minimum(angle, self._friction_angle(p))))

    def _friction_angle(self, p):
        return self.joints.of("friction_angle", p.trace, self.weaker("friction_angle", p))

    def strength(self, name, p, rock):
        """Strength of points, which joints may replace or multiply by a factor. @param rock  tensile_strength or cohesion of the rock"""
        return self.joints.of(name, p.trace, self.joints.of("strength_factor", p.trace, 1.0) * rock)

    def across_joint(self, p, distance):
        """Fractions of normal and shear stiffness that remain in series with a joint's stiffness. @param distance  m, over which the rock's
        modulus acts"""
        left = []
        for name in ("normal_stiffness", "shear_stiffness"):
            own = self.joints.of(name, p.trace, math.inf)
            left.append(1 / (1 + self._whole(name, p) / (own * distance)))
        return left

    def weaker(self, name, p):
        """The smaller value of two materials, unless a table of the pair gives one."""
        return self.overridden(name, p, np.minimum(*self._pair(name, p.i, p.j)))

    def _root_term(self, name, p):
        """2 h sqrt(k) of two materials in series. If the pair has a stiffness of its own, only the two h are in series."""
        (h_i, h_j), (k_i, k_j) = self._pair("ratio", p.i, p.j), self._pair(name, p.i, p.j)
        term = self._series(2 * h_i * np.sqrt(k_i), 2 * h_j * np.sqrt(k_j))
        own = self.overridden(name, p, np.full(len(p.i), np.nan))
        share = p.share if name == "normal_stiffness" else p.shear_share
        return np.where(np.isnan(own), term, 2 * self._series(h_i, h_j) * np.sqrt(own)) * np.sqrt(share)

    def rest_after(self, overlap):
        """Force-free overlap of a broken bond with the initial overlap δ0, m."""
        return np.maximum(overlap, 0.0) if self.coulomb else np.zeros_like(overlap)

    # shares of an area, solver/MODEL.md 4.5

    def lengths(self, p):
        """L of contacts that form later, m."""
        between = self.corner_count[p.i] + self.corner_count[p.j] == 0
        radius = np.zeros(len(self.mass))
        radius[self.circle_body] = self.circle_radius
        length = 2 * np.where(between, np.minimum(radius[p.i], radius[p.j]), radius[p.i])
        for k in np.flatnonzero(self.corner_count[p.i]):
            outline = self.outline[p.i[k], : self.corner_count[p.i[k]]]
            corner = outline[p.element[k]]
            neighbours = [outline[(p.element[k] + turn) % len(outline)] for turn in (-1, 1)]
            length[k] = sum(math.dist(corner, other) for other in neighbours) / 2
        return length

    def distances(self, p):
        """l of contacts that form later, m."""
        radius = np.sqrt(self.area / math.pi)
        radius[self.count :] = 0.0  # platens
        return radius[p.i] + radius[p.j]

    def _set_properties(self, p):
        """Sets shares, traces and force-free overlaps, as for contacts that form later, or as stored by keep()."""
        flat = ~np.isnan(p.lap)
        p.trace = np.array([self._trace_between(i, j) for i, j in zip(p.i.tolist(), p.j.tolist())], int)
        p.trace[flat] = -1 - p.element[flat]
        p.rest = self.joints.of("aperture", p.trace, 0.0)
        if self.by_area:
            distance = self.distances(p)
            left, left_of_shear = self.across_joint(p, distance)
            # Shares of flat faces are stored per metre of lap.
            p.share = single(np.where(flat, 1.0, self.lengths(p)) / distance * left) * np.where(flat, np.maximum(p.lap, 0.0), 1.0)
            p.shear_share = p.share * single(np.sqrt(left_of_shear / left)) ** 2
        for k, key in enumerate(p.keys()):
            if key in self._kept:
                p.rest[k] = self._kept[key][3]
                if not flat[k]:
                    p.share[k], p.shear_share[k], p.trace[k] = self._kept[key][:3]

    def keep(self, points):
        """Stores the properties of points that are bonded or open at the start; they never change. For flat faces, only the force-free
        overlap is used."""
        self._kept |= dict(zip(points.keys(), zip(points.share, points.shear_share, points.trace, points.rest)))

    # joints, solver/MODEL.md 5.3

    def met(self, key):
        """Whether a point was bonded or open at the start."""
        return key in self._kept

    def learn_faces(self, faces):
        """Stores which bodies lie on which sides of traces. @param faces  by pair of bodies, from bonds.faces_of()"""
        on_traces = []
        for (i, j), found in faces.items():
            trace = self.joints.pairs.get(frozenset((self.ids[i], self.ids[j])))
            # A body may reach past a slender cell to a face on the trace; then the edges are not parallel.
            if trace is not None and found.parallel:
                on_traces.append((trace, j, i, found.begin, found.end))
        self.sides = sides_of_bodies(on_traces)

    def trace_of(self, i, j):
        """Trace between two bodies."""
        return self.joints.pairs.get(frozenset((self.ids[i], self.ids[j])), self._trace_between(i, j))

    def _trace_between(self, i, j):
        """The first trace with faces of the two bodies on opposite sides, or -1."""
        others = self.sides.get(j, ())
        return min((trace for trace, side in self.sides.get(i, ()) if (trace, 1 - side) in others), default=-1)

    def dashpots(self, p):
        if self.materials[0]["ratio"] is None:
            return tuple(self._series(*self._pair(name, p.i, p.j)) for name in ("normal_damping", "shear_damping"))
        held_i, held_j = p.i >= self.count, p.j >= self.count
        mi, mj = self.mass[p.i], self.mass[p.j]
        mass = np.where(held_j, mi, np.where(held_i, mj, mi * mj / (mi + mj)))
        return tuple(self._root_term(name, p) * np.sqrt(mass) for name in ("normal_stiffness", "shear_stiffness"))

    # contact points, solver/MODEL.md 3

    def near(self, centre, beyond):
        """Pairs of bodies i < j whose bounding circles (for platens, their faces) are closer than `beyond`."""
        order = np.argsort(centre[: self.count, 0])
        x, pairs = centre[order, 0], []
        widest = self.reach[: self.count].max()
        for k, a in enumerate(order):
            end = np.searchsorted(x, x[k] + self.reach[a] + widest + beyond)
            others = order[k + 1 : end]
            apart = np.hypot(*(centre[others] - centre[a]).T) - self.reach[others] - self.reach[a]
            pairs += [(min(a, b), max(a, b)) for b in others[apart <= beyond]]
        half = platen_depth * self.height / 2
        for platen in (self.bottom, self.top):
            apart = np.abs(centre[: self.count, 1] - centre[platen, 1]) - half - self.reach[: self.count]
            pairs += [(a, platen) for a in np.flatnonzero(apart <= beyond)]
        return np.array(pairs, int).reshape(-1, 2)

    def points(self, centre, angle):
        """All contact points of bodies at these positions whose surfaces are close, whether they touch or not."""
        c, s = np.cos(angle), np.sin(angle)
        rotation = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)
        pairs = self.near(centre, 2 * self.thick + 0.05 * self.reach[: self.count].mean() + self.reach_of_bonds)
        found = []
        own = [[] for _ in self.mass]
        for e, b in enumerate(self.circle_body):
            own[b].append(e)
        at = centre[self.circle_body] + np.einsum("eij,ej->ei", rotation[self.circle_body], self.circle_at)
        # Circle against circle, circle against outline, corner against outline.
        cc = [(a, ea, b, eb) for a, b in pairs if (a, b) not in self.parted for ea in own[a] for eb in own[b]]
        for faces in self.flat_faces:
            found.append(self._flat_points(faces, centre))
        if cc:
            a, ea, b, eb = np.array(cc).T
            way = at[eb] - at[ea]
            apart = np.hypot(*way.T)
            n = way / apart[:, None]
            d = self.circle_radius[ea] + self.circle_radius[eb] - apart
            place = at[ea] + n * (self.circle_radius[ea] - d / 2)[:, None]
            found.append(Points(a, ea * len(at) + eb, b, d, n, place, *unset(a)))
        outline = centre[:, None] + np.einsum("bij,bkj->bki", rotation, self.outline)
        co = [(x, e, y) for a, b in pairs for x, y in ((a, b), (b, a)) if self.corner_count[y] for e in own[x]]
        if co:
            a, e, b = np.array(co).T
            distance, out, _ = self._to_outline(at[e], outline[b])
            r = self.circle_radius[e]
            d = r + self.thick - distance
            found.append(Points(a, e, b, d, -out, at[e] - out * (r - d / 2)[:, None], *unset(a)))
        vo = [
            (x, k, y)
            for a, b in pairs
            for x, y in ((a, b), (b, a))
            if self.corner_count[y]
            for k in range(self.corner_count[x])
        ]
        if vo:
            a, k, b = np.array(vo).T
            corner = outline[a, k]
            distance, out, closest = self._to_outline(corner, outline[b])
            found.append(Points(a, k, b, self.thick - distance, -out, (corner + closest) / 2, *unset(a)))
        points = together(*found)
        self._set_properties(points)
        return points

    def lay_flat_faces(self, parts):
        """Gives circles at these straight traces their flat faces. Two circles on opposite sides of a trace meet only at these faces."""
        self.flat_faces = [lay_faces(self, part) for part in parts]
        for faces in self.flat_faces:
            i, j = meetings(faces, self.centre)[:2]
            self.parted |= set(zip(np.minimum(i, j).tolist(), np.maximum(i, j).tolist()))

    def _flat_points(self, faces, centre):
        i, j, overlap, lap, normal, place = (values for values in meetings(faces, centre))
        near = np.minimum(lap, overlap) > -self.circle_radius.min()
        p = Points(i, np.full(len(i), -1 - faces.part.trace), j, overlap, normal, place, *unset(i)).chosen(near)
        p.lap = lap[near]
        return p

    @staticmethod
    def _to_outline(place, outline):
        """Signed distance from convex outlines (negative inside), its gradient, the closest point of each outline."""
        begin, end = outline, np.roll(outline, -1, axis=1)
        edge = end - begin
        length2 = (edge**2).sum(-1)
        real = length2 > 0
        safe = np.where(real, length2, 1.0)
        away = place[:, None] - begin
        share = np.clip((away * edge).sum(-1) / safe, 0, 1)
        foot = begin + share[..., None] * edge
        way = place[:, None] - foot
        distance = np.where(real, np.hypot(way[..., 0], way[..., 1]), np.inf)
        outward = np.stack([edge[..., 1], -edge[..., 0]], -1) / np.sqrt(safe)[..., None]
        beyond = np.where(real, (away * outward).sum(-1), -np.inf)
        inside = (beyond <= 0).all(axis=1)
        rows = np.arange(len(place))
        nearest = np.where(inside, beyond.argmax(axis=1), distance.argmin(axis=1))
        near_distance = distance[rows, nearest]
        gradient = way[rows, nearest] / np.where(near_distance > 0, near_distance, 1)[:, None]
        flat = inside | (near_distance == 0)
        gradient = np.where(flat[:, None], outward[rows, nearest], gradient)
        signed = np.where(inside, beyond[rows, nearest], near_distance)
        closest = np.where(inside[:, None], place - signed[:, None] * gradient, foot[rows, nearest])
        return signed, gradient, closest

    # small strain, solver/MODEL.md 7 and 10

    def matrices(self, p, centre):
        """Stiffness and damping matrices for all 3 N displacements (x, y, rotation of each body): sums of k g gᵀ and c g gᵀ over the points.

        g: derivatives of the overlap, or of the slip between i and j, with respect to the displacements of both bodies."""
        size = 3 * len(self.mass)
        places = np.concatenate([3 * p.i[:, None] + np.arange(3), 3 * p.j[:, None] + np.arange(3)], axis=1)
        stiffness, damping = np.zeros(size * size), np.zeros(size * size)
        flat = (places[:, :, None] * size + places[:, None, :]).ravel()
        along = [p.normal, turned(p.normal)]
        springs, dashpots = (self.normal_stiffness(p), self.shear_stiffness(p)), self.dashpots(p)
        for direction, k, c in zip(along, springs, dashpots):
            g = [
                sign * np.stack([*direction.T, dot(turned(p.position - centre[body]), direction)], axis=1)
                for body, sign in ((p.i, 1.0), (p.j, -1.0))
            ]
            g = np.concatenate(g, axis=1)
            outer = g[:, :, None] * g[:, None, :]
            stiffness += np.bincount(flat, (k[:, None, None] * outer).ravel(), size * size)
            damping += np.bincount(flat, (c[:, None, None] * outer).ravel(), size * size)
        return stiffness.reshape(size, size), damping.reshape(size, size)

    def axial_gauge(self, bonds):
        """Indices of the bonded particles within half a mean particle of the lower and upper end of the gauge length."""
        outer = (self.results.key("loading", "grip") or 0.1) * self.height
        half = math.sqrt(self.width * self.height / self.count) / 2
        y, carries = self.centre[: self.count, 1], np.zeros(len(self.mass), bool)
        carries[bonds.i] = carries[bonds.j] = True
        near = [np.abs(y - end) <= half for end in (self.deck.y1 + outer, self.deck.y2 - outer)]
        return [np.flatnonzero(own & carries[: self.count]) for own in near]

    def gauge(self):
        """Indices of the left and right side particles with centres in the middle half of the height."""
        deck, middle = self.results.circles, (self.deck.y1 + self.deck.y2) / 2
        tolerance = 1e-6 * self.width
        chosen = []
        for side in ("left", "right"):
            if not self.polygons:
                touches = [
                    any((x - deck.x1 if side == "left" else deck.x2 - x) < r for x, _, r in b.circles)
                    for b in self.deck.bodies
                ]
            else:
                # Meshed cells had an edge at the side. If the inset has removed it, the outset cell extends beyond the
                # side.
                by = self.mesh_gap / 2 if self.results.key("mesh", "kind") else 0.0

                def inward(corners, side=side):
                    return corners[:, 0] - self.deck.x1 if side == "left" else self.deck.x2 - corners[:, 0]

                away = [inward(outset(b.corners, by)) for b in self.deck.bodies]
                nearest = 0.0 if by else min(a.min() for a in away)
                touches = [np.sum(a <= nearest + tolerance) >= 2 or a.min() < nearest - tolerance for a in away]
            chosen.append(
                [k for k in range(self.count) if touches[k] and abs(self.centre[k, 1] - middle) <= self.height / 4]
            )
        return chosen
