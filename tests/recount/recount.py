# SPDX-License-Identifier: GPL-3.0-or-later
"""Recomputes the figures of a test from its files, independently of the program: the code is written from the documents.

Prints a line per figure: name, stated value, recounted value, difference over tolerance. README.md explains the tolerances."""

import math
import re
import sys

try:
    import numpy as np
except ImportError:
    print("recount: found no numpy, expected Debian's python3-numpy; install it", file=sys.stderr)
    sys.exit(2)

from cycles import first_loading, recount_cycles, travel
from emission import recount_emission
from events import recount_events, recount_parting
from face_frames import recount_face_frame
from face_history import recount_face_history
from frames import recount_frame, recount_places
from history import holds_every_step, recount_history
from joints import Joints, recount_faces, recount_joints
from kinds import recount_kind
from loading_by_tolerance import by_tolerance
from measures import first, recount_measures, recount_rose
from model import Model, rounding
from peaks import find_fall
from results import Results, Unreadable
from slips import recount_slips
from specimen import recount_cells, recount_minerals, recount_packing, recount_specimen


absent = object()


class Recount:
    """Collects the comparisons as lines, and the compared keys of the summary."""

    def __init__(self, results):
        self.results, self.lines, self.keys = results, [], set()
        self.left = {}  # figures that cannot be recounted from the files, with the reason
        self.peak = None  # row of the peak, if all rows are written
        self.summary, self.curve, self.events = results.summary, results.curve, results.events
        # Rows from which peak, moduli and thresholds are determined, and the index of the peak among them.
        self.first_loading = first_loading(results, self.curve["axial_strain"])
        self.judged = {name: column[self.first_loading] for name, column in self.curve.items()}
        self.peak_judged = None
        self.uniaxial = self.summary["kind"] in ("compression", "tension", "biaxial")  # between platens

    def compare(self, name, stated, ours, tolerance):
        """@param tolerance  absolute"""
        if stated is None:
            stated = math.nan
        both_undefined = math.isnan(stated) and math.isnan(ours)
        difference = 0.0 if both_undefined or stated == ours else abs(stated - ours)
        holds = difference <= tolerance
        self.lines.append((name, stated, ours, difference, tolerance, holds))

    def key(self, name, ours, relative=rounding, floor=0.0):
        """Compares a figure of summary.json, and its value in Pa if there is one."""
        at = self.summary
        for part in re.findall(r"[^.\[\]]+", name):
            at = at.get(part, absent) if isinstance(at, dict) else at[int(part)] if isinstance(at, list) else absent
            if at is absent:
                return
        self.keys.add(name)
        if isinstance(at, (str, bool)) or isinstance(ours, (str, bool)):
            self.lines.append((name, at, ours, 0.0, 0.0, at == ours))
            return
        tolerance = max(relative * abs(ours), floor) if not math.isnan(ours) else 0.0
        self.compare(name, at, ours, tolerance)
        in_pascal = name + "_pa"
        if in_pascal in self.summary:
            self.keys.add(in_pascal)
            # In area units, stresses are already in Pa.
            by_area = self.results.key("material", "units", "point") == "area"
            over = 1.0 if by_area else self.results.key("output", "out_of_plane_thickness", 1.0)
            self.compare(in_pascal, self.summary[in_pascal], ours / over, tolerance / over)

    def leave(self, name, reason):
        """Records a figure that is not recounted, with the reason."""
        self.left[name] = reason

    def rows(self, name, stated, ours, tolerance):
        """Compares a column; the worst row is recorded."""
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


def recount_curve(r, joints):
    """Figures that follow from curve.csv alone."""
    c, case = r.curve, r.results.key
    r.rows("curve: axial_stress", c["axial_stress"], (c["stress_top"] + c["stress_bottom"]) / 2,
           1e-14 * (np.abs(c["stress_top"]) + np.abs(c["stress_bottom"])))
    closing = (c["kinetic_energy"] - c["kinetic_energy"][0] + c["strain_energy"] - c["strain_energy"][0]
               + c["dashpot_loss"] + c["friction_loss"] + c["fracture_loss"] - c["platen_work"]
               - c.get("confinement_work", 0))
    size = np.abs(c["kinetic_energy"]) + c["strain_energy"] + c["dashpot_loss"] + np.abs(c["platen_work"])
    if case("bond", "law") == "face":
        whole = c["bonds_broken"] == 0
        r.rows("curve: energy_error without breaks", c["energy_error"][whole], closing[whole], (1e-12 * size + 1e-16 * np.max(size))[whole])
        r.leave("curve: energy_error after breaks", "what broken faces lose to the lag of their pressures is in no column")
    elif joints.have_mechanics() and r.results.polygons is None:
        r.leave("curve: energy_error", "what the laps of flat faces change is in no column")
    elif case("numerics", "contact_law", "rounded") == "rounded":
        r.rows("curve: energy_error", c["energy_error"], closing, 1e-12 * size + 1e-16 * np.max(size))
    r.key("axial_strain_end", c["axial_strain"][-1])
    r.key("energy_closing_error", c["energy_error"][-1] / c["platen_work"][-1])
    r.key("simulated_time", c["time"][-1])
    r.key("steps", c["step"][-1])
    r.key("time_step_mean", c["time"][-1] / c["step"][-1])
    r.key("bonds_broken", c["bonds_broken"][-1])
    r.key("interfaces_lost", c["interfaces_lost"][-1])
    strain, stress, lateral = c["axial_strain"], c["axial_stress"], c["lateral_strain"]
    sense = -1.0 if case("loading", "kind") == "tension" else 1.0
    if r.uniaxial:
        r.key("area_strain_end", sense * strain[-1] - lateral[-1])
    if case("output", "curve_rows", 2000) < 2000:
        return  # peak and windows depend on rows that were not written
    way, more = travel(r.results, strain)
    judged = r.judged["axial_stress"]
    gone = way if case("loading", "control") == "lateral" else r.judged["axial_strain"]
    at_peak, dropped = find_fall(gone, judged, 1 - case("loading", "strength_drop", 0.1))
    _, end = find_fall(gone, judged, case("loading", "stop_at_share_of_peak", 0.5))
    failed = dropped is not None or end is not None
    r.key("failed", failed)
    if end is not None:
        r.key("ended_by", "failure")
        # The length of a drop is measured in travelled strain, which rows show exactly except at reversals between
        # them.
        r.compare("row at which failure is found", len(stress) - 1, r.first_loading[end], 2 if more else 0)
    else:
        r.true("ended_by: not failure", r.summary["ended_by"] != "failure" or more > 0)
    if at_peak is None:
        return
    r.peak_judged, r.peak = at_peak, int(r.first_loading[at_peak])
    peak, largest = r.peak, int(np.argmax(stress))
    r.key("largest_stress", stress[largest], 0.0)
    r.key("strain_at_largest_stress", strain[largest], 0.0)
    r.true("notice of a larger stress after the peak",
           any(notice.startswith("the largest stress") for notice in r.summary["notices"]) == (largest > peak))
    suffix = "" if failed else "_so_far"
    r.key("peak_stress" + suffix, stress[peak], 0.0)
    r.key("peak_strain" + suffix, strain[peak], 0.0)
    drawn = [f"frames/particles_{row:05d}.vtp" for row in r.results.frame_rows()]
    for name, frame in (("start", drawn[0]), ("peak", f"frames/particles_{peak:05d}.vtp"), ("end", drawn[-1])):
        r.key("frame_" + name, frame)
        r.true(f"frame_{name}: is there", frame in drawn)
    if r.uniaxial:
        r.key("area_strain_peak", sense * strain[peak] - lateral[peak])
    r.key("platen_out_of_balance",
          np.max(np.abs(c["stress_top"] - c["stress_bottom"])[: peak + 1]) / stress[peak])
    if r.uniaxial:
        recount_tangents(r, r.peak_judged, sense)
    if by_tolerance(r):
        r.key("axial_strain_rate", way[-1] / c["time"][-1], floor=more / c["time"][-1])
        p = case("confinement", "pressure", 0.0)
        r.key("viscous_stress_share", (stress[0] - p) / (stress[largest] - p))
    else:
        r.rows("curve: axial_strain of the rate", strain, case("loading", "axial_strain_rate") * c["time"],
               1e-9 * strain + 1e-15)
        r.key("axial_strain_rate", case("loading", "axial_strain_rate"), 0.0)


def recount_tangents(r, peak, sense):
    """Moduli of the curve before the peak, for a test between platens. @param peak  its index among the judged rows"""
    c = r.judged
    strain, stress, lateral = c["axial_strain"], c["axial_stress"], c["lateral_strain"]
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
        ends = r.first_loading[early[[0, -1]]]
        if set(ends.tolist()) <= set(r.results.frame_rows()):  # states 3 and 4: touching, without a bond
            loose = [np.sum(r.results.contacts(row)["state"] >= 3) for row in ends]
            r.key(w + "contacts_gained", int(loose[1]) - int(loose[0]))


def recount_given(r, model):
    """Figures that the case gives or that follow from it."""
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
    errors = r.summary.get("numerical_errors") or {}
    for name in ("peak_stress", "peak_strain", "crack_initiation_stress", "crack_damage_stress"):
        if name in errors and r.summary["energy_closing_error"] is not None:
            r.key(f"numerical_errors.{name}.energy_closing", abs(r.summary["energy_closing_error"]))


def recount_lengths(r):
    """Sizes of the files listed in the summary; the program checks their hashes."""
    for name, stated in r.summary.get("files", {}).items():
        figure = f"files.{name}.bytes"
        r.compare(figure, stated["bytes"], (r.results.folder / name).stat().st_size, 0)
        r.keys.add(figure)


def number(value):
    return math.nan if value is None else value


def recount_errors(r):
    """Stated errors, from the companions' results (specimens/loading/METHODS.md)."""
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
        # Damping changes the stable step, so the steps of companions with other damping are not compared.
        if damping == 1:
            over = run["time_step"] / r.summary["time_step_mean"]
            # The bound, and so the mean step, changes if contacts open and close differently.
            r.compare(label + "time step over the test's", over, step, 0.02 * step)
        # With a tolerance, breaks change the rate between 0.15 and 1 of its limit.
        over = run["axial_strain_rate"] / r.summary["axial_strain_rate"]
        r.compare(label + "rate over the test's", over, rate, 1e-3 * rate if at_a_rate else 0.4 * rate)
        if run["damping"] is not None:  # the test has damping
            r.compare(label + "damping over the test's", run["damping"], damping, 1e-12)
    peak = {"peak_stress": r.summary["peak_stress"], "peak_strain": r.summary["peak_strain"]}
    thresholds = {name: number(r.summary[name]) for name in ("crack_initiation_stress", "crack_damage_stress") if name in errors}
    runs = {run: {name: number(own[name]) for name in {**peak, **thresholds}} for run, own in errors["companions"].items()}
    for name, value in {**peak, **thresholds}.items():
        half_step, half_rate = runs["half_time_step"][name], runs["half_rate"][name]
        spread = np.std([value, half_step, half_rate], ddof=1)
        step, rate = abs(half_step - value) / value, abs(half_rate - value) / value
        r.key(f"numerical_errors.{name}.time_step", step)
        r.key(f"numerical_errors.{name}.rate", rate)
        r.key(f"numerical_errors.{name}.damping",
              max(abs(runs[k][name] - value) / value for k in ("half_damping", "double_damping")))
        resolution = number(errors[name]["resolution"])
        column = r.curve["axial_strain" if name == "peak_strain" else "axial_stress"]
        row = r.peak if name in peak else first(column >= value)  # for a threshold, the first row that reaches it
        if r.peak:
            r.key(f"numerical_errors.{name}.resolution", abs(column[row] - column[row - 1]) / value if row else math.nan if math.isnan(value) else 0.0)
        stated = math.hypot(resolution, max(3 * rate, 2.92 * math.sqrt(2) * spread / value))
        r.key(f"numerical_errors.{name}.stated", stated, 1e-3)  # 2.92 stands for 2.91999
    for part in ("time_step", "rate", "damping", "resolution"):
        r.key(f"numerical_errors.youngs_modulus.{part}", 0.0)
    moved = {name: max(errors[name]["time_step"], errors[name]["rate"]) for name in peak}
    r.key("peak_converged", bool(moved["peak_stress"] <= 0.03 and moved["peak_strain"] <= 0.1))


def recount(folder):
    r = Recount(Results(folder))
    joints = Joints(r.results)
    recount_curve(r, joints)
    known = [claim["holds"] for claim in r.summary["validity"]]
    r.true("valid: as its claims", r.summary["valid"] is (False if False in known else None if None in known else True))
    r.keys.add("valid")
    recount_cycles(r)
    faces = recount_joints(r, joints)
    if not r.uniaxial:
        recount_kind(r)
        recount_lengths(r)
        return r
    recount_measures(r)
    if r.summary["kind"] == "biaxial":
        r.key("confining_pressure", r.results.key("confinement", "pressure"), 0.0)
        if r.peak is not None:
            suffix = "" if r.summary["failed"] else "_so_far"
            r.key("deviator_stress" + suffix, r.curve["axial_stress"][r.peak] - r.results.key("confinement", "pressure"))
        r.key("confining_side", r.results.key("confinement", "side", "membrane"))
        if r.summary["confining_side"] == "membrane":
            r.key("membrane.work", r.curve["confinement_work"][-1], 0.0)
        else:  # the model has no walls, so only the curve is recounted
            recount_packing(r)
            recount_lengths(r)
            return r
    recount_packing(r)
    recount_cells(r)
    if r.results.key("numerics", "contact_law", "rounded") == "rounded" or r.results.polygons is None:
        recount_model(r, joints, faces)
    recount_errors(r)
    return r


def recount_model(r, joints, faces):
    """Figures that follow from the specimen between its platens. @param faces  faces on traces, from joints.py"""
    model = Model(r.results, joints)
    recount_lengths(r)
    if model.by_faces and joints.traces:
        r.leave("bonds, events and frames", "faces on traces are not recounted")
        return
    if joints.have_mechanics() and not model.polygons:
        parts = joints.parts(faces, model.deck)
        if None in parts:
            r.leave("bonds, events and frames", f"where {joints.traces[parts.index(None)]['source']} bends or ends is in no file; "
                    'a straight trace through the box, or frame_precision = "double", says it')
            return
        model.lay_flat_faces(parts)
    if model.minerals:
        recount_minerals(r, model)
    rows = r.results.frame_rows()
    r.every_step = holds_every_step(r, rows)
    bonds = recount_specimen(r, model)
    if faces is not None:
        recount_faces(r, model, faces)
    recount_given(r, model)
    recount_events(r, model, bonds)
    recount_slips(r, model, bonds)
    recount_parting(r, model)
    recount_rose(r, model, bonds)
    recount_emission(r, model)
    for what, table in (("events", r.events), ("slips", r.results.slips)):
        if table is not None and len(table["time"]):
            recount_places(r, model, bonds, rows, what, table)
    if r.every_step:
        (recount_face_history if model.by_faces else recount_history)(r, model, bonds, rows)
    first = r.results.frame(rows[0])
    picked = sorted({rows[round(k * (len(rows) - 1) / 6)] for k in range(7)})
    for row in picked:
        frame = r.results.frame(row)
        at = np.flatnonzero(np.abs(r.curve["time"] - frame.time) <= 1e-12 * max(frame.time, 1e-300))
        at = int(at[0]) if len(at) else None
        if model.by_faces:
            recount_face_frame(r, model, bonds, frame, at)
        else:
            recount_frame(r, model, bonds, frame, first, at)


def shown(value):
    return f"{value:.9g}" if isinstance(value, (int, float, np.floating, np.integer)) and not isinstance(value, bool) else str(value)


def figures(table, before=""):
    """Names of all figures in the summary."""
    names = set()
    for name, value in table.items():
        if isinstance(value, dict):
            names |= figures(value, before + name + ".")
        elif isinstance(value, list):
            for k, entry in enumerate(value):
                names |= figures(entry, f"{before}{name}[{k}].") if isinstance(entry, dict) else set()
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
    for name, reason in r.left.items():
        print(f"left    {name}: {reason}")
    print("not recounted: " + ", ".join(sorted(figures(r.summary) - r.keys - set(r.left))))
    bad = sum(not line[5] for line in r.lines)
    print(f"recount: {len(r.lines)} figures, {bad} differ" + (f", {len(r.left)} left" if r.left else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
