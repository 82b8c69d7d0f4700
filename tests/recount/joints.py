# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints: the keys of each trace, the bodies that it separates, and its state (solver/MODEL.md 5.3, 5.4).

Which faces lie on traces is read from the first joints_*.vtp: no file holds the traces themselves."""

import math
from pathlib import PurePath

import numpy as np

from flat_faces import chord, line_of, part_in_box
from outlines import centroid

mechanics = (
    "bonded", "strength_factor", "tensile_strength", "cohesion", "friction_angle", "residual_friction_angle",
    "normal_stiffness", "shear_stiffness", "dilation_angle", "dilation_slip", "aperture",
)


class Joints:
    """Traces of a specimen, their keys, and the pairs of ids whose faces lie on them."""

    def __init__(self, results):
        self.traces = results.summary.get("traces") or []
        tables = {table["name"]: table for table in results.case.get("joint_set", [])}
        for number, table in enumerate(results.case.get("trace", []), 1):
            of_file = PurePath(table["file"]).stem if "file" in table else f"trace {number}"
            tables[table.get("name", of_file)] = table
        self.tables = tables
        keys = [{key: tables.get(t["source"], {}).get(key) for key in mechanics} for t in self.traces]
        self.keys = [{key: value for key, value in own.items() if value is not None} for own in keys]
        self.first = results.joints(results.frame_rows()[0]) if self.traces else None
        self.pairs = {}
        if self.first is not None:
            for a, b, trace in zip(self.first["body_i"], self.first["body_j"], self.first["trace"]):
                self.pairs[frozenset((int(a), int(b)))] = int(trace)

    def have_mechanics(self):
        return any(self.keys)

    def dilate(self):
        return any(own.get("dilation_angle") for own in self.keys)

    def parts(self, faces, deck):
        """The straight traces that have properties of their own. @param faces  Faces"""
        of_trace = np.asarray(self.first["trace"])
        return [part_in_box(k, faces, of_trace == k, self.tables[trace["source"]], deck, trace["length"])
                for k, trace in enumerate(self.traces) if self.keys[k]]

    def of(self, name, trace, otherwise):
        """Value of a key of each point's joint, or `otherwise` if the joint does not give it. @param trace  by point, -1 in the rock"""
        values = np.broadcast_to(np.asarray(otherwise, float), trace.shape).copy()
        for number, own in enumerate(self.keys):
            if name in own:
                values[trace == number] = own[name]
        return values


def sides_of_bodies(faces):
    """The pairs (trace, side) of each body that has a face on a trace; side is 0 or 1.

    @param faces  rows (trace, i, j, begin, end): seen from begin to end, i is on the right and j on the left"""
    sides = {}
    for trace in {face[0] for face in faces}:
        own = [face for face in faces if face[0] == trace]
        turned_round = {0: False}
        # Faces form a chain along a trace: each gets the direction of the nearest face whose direction is known.
        while len(turned_round) < len(own):
            apart, k, flip = min(
                (math.dist(own[a][3 + end_a], own[b][3 + end_b]), b, turned_round[a] ^ (end_a == end_b))
                for a in turned_round for b in range(len(own)) if b not in turned_round
                for end_a in (0, 1) for end_b in (0, 1)
            )
            turned_round[k] = flip
        for k, (_, i, j, _, _) in enumerate(own):
            right, left = (j, i) if turned_round[k] else (i, j)
            sides.setdefault(right, set()).add((trace, 0))
            sides.setdefault(left, set()).add((trace, 1))
    return sides


class Faces:
    """Faces on traces before loading, from the lines of the first frame, and their motion since then."""

    def __init__(self, r, joints):
        self.r, self.file = r, joints.first
        self.ids = [(int(a), int(b)) for a, b in zip(self.file["body_i"], self.file["body_j"])]
        deck = r.results.specimen
        self.centre = {b.id: centroid(b) for b in deck.bodies}
        places, points = self._places(r.results.frame_rows()[0]), self.file["points"][:, :2]
        # Frames contain lines at the mean of the positions to which both bodies carry them; this is undone here.
        begin, end = points[0::2].astype(float), points[1::2].astype(float)
        self.middle, self.along = np.zeros_like(begin), np.zeros_like(begin)
        for k, pair in enumerate(self.ids):
            turn = sum(rotation(places[b][1]) for b in pair) / 2
            moved = sum(places[b][0] - rotation(places[b][1]) @ self.centre[b] for b in pair) / 2
            self.middle[k] = np.linalg.solve(turn, (begin[k] + end[k]) / 2 - moved)
            self.along[k] = np.linalg.solve(turn, end[k] - begin[k])
        self.length = np.hypot(*self.along.T)
        self.rounding = np.finfo(points.dtype).eps * (deck.width + deck.height)  # m, of a place

    def _places(self, row):
        """Centroid and rotation since loading began, by id."""
        p = self.r.results.particles(row)
        return {int(b): (self.centre[int(b)] + way[:2], turn)
                for b, way, turn in zip(p["id"], p["displacement"], p["angle"]) if int(b) in self.centre}

    def motion(self, row):
        """Opening and slip of each face, and their rounding error, m."""
        places = self._places(row)
        opening, slip, off = (np.zeros(len(self.ids)) for _ in range(3))
        for k, (i, j) in enumerate(self.ids):
            carried = [places[b][0] + rotation(places[b][1]) @ (self.middle[k] - self.centre[b]) for b in (i, j)]
            t = rotation((places[i][1] + places[j][1]) / 2) @ self.along[k] / self.length[k]
            apart = carried[1] - carried[0]
            opening[k], slip[k] = apart @ (t[1], -t[0]), apart @ t
            turns = abs(places[i][1] - places[j][1])
            off[k] = self.rounding * (turns + 2 * np.hypot(*apart) / self.length[k]) + 4e-16 * np.abs(self.middle[k]).sum()
        return opening, slip, off

    def state(self, row):
        """State of each face by its bonds: 0 if one is intact, 2 if all are broken, 4 if it never had one."""
        contacts = self.r.results.contacts(row)
        bonds = {}
        for a, b, state in zip(contacts["body_i"], contacts["body_j"], contacts["state"]):
            if state < 4:
                bonds.setdefault(frozenset((int(a), int(b))), []).append(state)
        own = [bonds.get(frozenset(pair), []) for pair in self.ids]
        return np.array([4 if not states else 0 if min(states) < 2 else 2 for states in own])


def rotation(angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def recount_joints(r, joints):
    """The figures of traces for any kind of test: the state of every face follows from the places of its two bodies (specimens/joints/METHODS.md)."""
    if not joints.traces:
        return None
    sources = [trace["source"] for trace in joints.traces]
    r.true("joints: sources of the case", set(sources) <= set(joints.tables))
    r.compare("joints: as many as sources", len(r.summary["joints"]), len(set(sources)), 0)
    recount_breaks(r)
    faces = Faces(r, joints)
    of_trace, length = np.asarray(faces.file["trace"]), faces.length
    rows = r.results.frame_rows()
    for row in sorted({rows[round(k * (len(rows) - 1) / 6)] for k in range(7)}):
        stated, (opening, slip, off) = r.results.joints(row), faces.motion(row)
        label = f"frame {row}: joints: "
        r.rows(label + "opening", stated["opening"], opening, off)
        r.rows(label + "slip", stated["slip"], slip, off)
        r.rows(label + "state", stated["state"], faces.state(row), 0)
        r.rows(label + "trace", stated["trace"], of_trace, 0)
    moments = [("at_end", rows[-1])]
    if r.summary.get("frame_peak"):
        moments.insert(0, ("at_peak", int(r.summary["frame_peak"].split("_")[1].split(".")[0])))
    had_bond = faces.state(rows[0]) != 4
    moved = {name: (*faces.motion(row), faces.state(row)) for name, row in moments}
    groups = [(f"traces[{k}].", of_trace == k) for k in range(len(sources))]
    for k, entry in enumerate(r.summary["joints"]):
        own = [number for number, source in enumerate(sources) if source == entry["source"]]
        groups.append((f"joints[{k}].", np.isin(of_trace, own)))
        r.key(f"joints[{k}].traces", len(own))
        r.key(f"joints[{k}].length", sum(joints.traces[n]["length"] for n in own))
    # The error of a length is that of its two ends.
    fine = max(1e-9, 4 * faces.rounding / length.min()) if len(length) else 0.0
    for name, own in groups:
        whole, bonded = length[own].sum(), length[own & had_bond].sum()
        r.key(name + "faces", int(own.sum()))
        r.key(name + "length_of_faces", whole, fine)
        r.key(name + "bonded_share", bonded / whole if whole else math.nan, fine)
        if name.startswith("traces"):
            recount_length(r, faces, name + "length", own, joints.tables[r.summary["traces"][int(name[7:-2])]["source"]])
        for moment, (opening, slip, off, state) in moved.items():
            label, at = name + moment + ".", math.nan
            r.key(label + "failed_share", length[own & (state == 2)].sum() / bonded if bonded else math.nan, fine)
            for what, value in (("opening", opening[own]), ("slip", slip[own])):
                largest = at if not whole else value.max() if what == "opening" else value[np.argmax(np.abs(value))]
                mean = np.sum(length[own] * value) / whole if whole else at
                floor = off[own].max(initial=0.0)
                r.key(label + what, mean, 0.0, floor + fine * np.abs(value).max(initial=0.0))
                r.key(label + "largest_" + what, largest, 0.0, floor)
    return faces


def recount_faces(r, model, faces):
    """Compares the lines of the first frame with the bonded specimen. @param faces  as from recount_joints()"""
    pairs = [frozenset(pair) for pair in faces.ids]
    r.true("faces on traces: each between bodies that face each other", all(pair in model.on_traces for pair in pairs))
    known = [k for k, pair in enumerate(pairs) if pair in model.on_traces]
    ours = [model.on_traces[pairs[k]] for k in known]
    fine = 8 * faces.rounding + 1e-9 * faces.length.max(initial=0.0)
    r.rows("faces on traces: length", faces.length[known], [length for _, length in ours], fine)
    if model.polygons:
        for k, name in enumerate("xy"):
            r.rows("faces on traces: middle along " + name, faces.middle[known, k], [middle[k] for middle, _ in ours], fine)


def recount_length(r, faces, name, own, table):
    """Length of a trace through the whole box, from the line on which its faces lie. @param table  of the case"""
    deck = r.results.specimen
    whole = table.get("length", "persistent") == "persistent" and ("spacing" in table or "number" in table)
    line = line_of(faces, own, table, deck) if whole and own.any() else None
    if line is None:
        r.leave(name, "no file holds the traces")
        return
    low, high = chord(*line[:2], deck)
    # An error of the direction moves the point where the line leaves the box, the more the flatter they intersect.
    steep = np.abs(line[1])
    r.key(name, high - low, 1e-9, line[2] * (high - low) / steep[steep > 0].min())


def recount_breaks(r):
    """Breaks on joints and in the rock, by the column of events.csv."""
    on_joint, steps = np.asarray(r.events["trace"], float) >= 0, np.asarray(r.events["step"], float)
    moments = [("", np.ones(len(steps), bool))]
    if r.peak is not None:
        moments.append(("_to_peak", steps <= r.curve["step"][r.peak]))
    for suffix, until in moments:
        r.key("bonds_broken_on_joints" + suffix, int(np.sum(on_joint & until)))
        r.key("bonds_broken_in_rock" + suffix, int(np.sum(~on_joint & until)))
