#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what DEMseg's guide states about its example rock with the results of six virtual tests.

  tools/compare_with_guide.py FOLDER

FOLDER contains the output folders of `crackle test`: circles_tension, circles_compression, delaunay_..., voronoi_...; only
their summary.json is read. If FOLDER/campaign has the same tests on several packings (specimens/plans/guide_rock.toml), means
and standard deviations are printed as well. The guide describes a single packing, and ratios vary with the packing. They are
therefore printed without a verdict; the exit code states only whether all specimens failed.

Exit codes: 0 all six specimens failed, 1 some did not (they are named), 2 a summary is missing or lacks a key.
"""
import json
import math
import sqlite3
import statistics
import sys
from pathlib import Path

SPECIMENS = ("circles", "delaunay", "voronoi")
LOADINGS = ("tension", "compression")

# Limit values of the circle specimen in the guide, to which its statements refer.
LIMIT_STRESS = 19.4e3  # N/m: mean back-tension over mean diameter, 0.774 kN / 4 cm
LIMIT_STRAIN = 0.0019
LIMIT_STIFFNESS = LIMIT_STRESS / LIMIT_STRAIN  # N/m


class BadInput(Exception):
    """An error whose message states what was found, what was expected, and a remedy."""


class Figures:
    """Values from the summary.json of one test, by key. Units: N, m; stresses and moduli N/m."""

    def __init__(self, place, keys):
        self.place, self.keys = place, keys

    @property
    def failed(self):
        return self.keys["failed"]

    def number(self, key):
        value = self.keys.get(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise BadInput(f"{self.place}: {key}: found {json.dumps(value)}, expected a number")
        return value


def read_summary(file):
    try:
        keys = json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise BadInput(f"{file}: file not found, expected the results of a test; make them with tools/quickstart") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise BadInput(f"{file}: found malformed JSON ({error}); run tools/quickstart again") from None
    if not isinstance(keys, dict) or not isinstance(keys.get("failed"), bool):
        raise BadInput(f"{file}: failed: found {keys.get('failed') if isinstance(keys, dict) else 'no object'}, "
                       "expected true or false")
    return Figures(file, keys)


def read_packings(file):
    """Tests of each packing whose six tests are all finished; empty if there is no campaign."""
    if not file.is_file():
        return []
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as ledger:
        ledger.row_factory = sqlite3.Row
        rows = [dict(row) for row in ledger.execute("SELECT * FROM results WHERE state = 'done' AND variant = 'as_asked'")]
    packings = {}
    for row in rows:
        specimen, _, loading = row["test"].partition("_")
        packings.setdefault(row["seed"], {})[specimen, loading] = Figures(file, row)
    return [tests for tests in packings.values() if len(tests) == len(SPECIMENS) * len(LOADINGS)]


def rows_of(tests):
    """Table rows for six tests: name, statement of the guide, value, number of decimals, unit, values it is computed from."""
    def strength(specimen, loading):
        """The strength as the guide defines it: the largest stress of the test."""
        return tests[specimen, loading].number("largest_stress")

    def over_tension(specimen):
        return strength(specimen, "compression") / strength(specimen, "tension")

    def pulled(specimen, key):
        return tests[specimen, "tension"].number(key)

    def points(specimen, other, key):
        return f"{pulled(specimen, key):.0f} over {pulled(other, key):.0f}"

    tangent, young = "initial_tangent_modulus", "youngs_modulus"
    contacts, interfaces = "contacts_initial", "interfaces_initial"
    rows = [
        ("circles",),
        ("  number", "304", pulled("circles", "particles"), 0, "", ""),
        ("  mean back-tension of a bond", "0.774 kN", pulled("circles", "mean_back_tension") / 1e3, 3, " kN", ""),
    ]
    for loading, name in (("tension", "pulled"), ("compression", "squeezed")):
        stiffness = tests["circles", loading].number(tangent)
        rows.append((f"  initial stiffness, {name}, over 19.4/0.0019 kN/m", "about 1/2", stiffness / LIMIT_STIFFNESS, 2, "",
                     f"{stiffness / 1e6:.2f} MN/m"))
    rows += [
        ("  the same with every bond intact (sparse solve)", "", pulled("circles", young) / LIMIT_STIFFNESS, 2, "",
         f"{pulled('circles', young) / 1e6:.2f} MN/m"),
        ("  tensile strength over 19.4 kN/m", "about 1/4", strength("circles", "tension") / LIMIT_STRESS, 2, "",
         f"{strength('circles', 'tension') / 1e3:.2f} kN/m"),
        ("  compressive strength over 19.4 kN/m", "about 1/2", strength("circles", "compression") / LIMIT_STRESS, 2, "",
         f"{strength('circles', 'compression') / 1e3:.2f} kN/m"),
        ("  compressive over tensile strength", "about 2", over_tension("circles"), 1, "", ""),
        ("triangles",),
        ("  number", "537 between centres alone", pulled("delaunay", "particles"), 0, "", ""),
        ("  contact points over the circles'", "about 10 (element pairs)",
         pulled("delaunay", contacts) / pulled("circles", contacts), 1, "", points("delaunay", "circles", contacts)),
        ("  interfaces over the circles'", "", pulled("delaunay", interfaces) / pulled("circles", interfaces), 1, "",
         points("delaunay", "circles", interfaces)),
        ("  initial stiffness over the circles', pulled", "about sqrt(10) = 3.2",
         pulled("delaunay", tangent) / pulled("circles", tangent), 2, "", ""),
        ("  the same with every bond intact (sparse solve)", "", pulled("delaunay", young) / pulled("circles", young), 2, "", ""),
        ("  strain at tensile strength", "about 0.002", pulled("delaunay", "strain_at_largest_stress"), 5, "", ""),
        ("  compressive over tensile strength", "about 10", over_tension("delaunay"), 1, "", ""),
        ("Voronoi polygons",),
        ("  contact points over the triangles'", "1.2 (element pairs)",
         pulled("voronoi", contacts) / pulled("delaunay", contacts), 2, "", points("voronoi", "delaunay", contacts)),
        ("  compressive strength over the triangles'", "larger",
         strength("voronoi", "compression") / strength("delaunay", "compression"), 2, "",
         f"{strength('voronoi', 'compression') / 1e3:.1f} over {strength('delaunay', 'compression') / 1e3:.1f} kN/m"),
        ("  compressive over tensile strength", "more than the triangles'", over_tension("voronoi"), 1, "", ""),
    ]
    return rows


def read_tests(folder):
    return {(specimen, loading): read_summary(folder / f"{specimen}_{loading}" / "summary.json")
            for specimen in SPECIMENS for loading in LOADINGS}


def table_of(rows, of_packings):
    """Lines of the printed table. of_packings: a list of rows for each packing."""
    lines = [["", "the guide", "measured"] + ([f"{len(of_packings)} packings"] if of_packings else [])]
    for k, row in enumerate(rows):
        if len(row) == 1:
            lines.append([row[0]])
            continue
        what, guide, value, digits, unit, made_of = row
        line = [what, guide, f"{value:.{digits}f}{unit}" + (f"   ({made_of})" if made_of else "")]
        if of_packings:
            values = [other[k][2] for other in of_packings]
            scatter = statistics.stdev(values) if len(values) > 1 else math.nan
            line.append(f"{statistics.mean(values):.{digits}f} ± {scatter:.{digits}f}{unit}")
        lines.append(line)
    widths = [max(len(line[k]) for line in lines if len(line) > k) for k in range(len(lines[0]))]
    return ["  ".join(f"{word:{width}}" for word, width in zip(line, widths)).rstrip() for line in lines]


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        asked = arguments in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        return 0 if asked else 2
    try:
        folder = Path(arguments[0])
        tests = read_tests(folder)
        packings = read_packings(folder / "campaign" / "campaign.sqlite")
        lines = table_of(rows_of(tests), [rows_of(packing) for packing in packings])
    except (BadInput, sqlite3.Error) as error:
        print(f"compare_with_guide: {error}", file=sys.stderr)
        return 2
    print("\n".join(lines))
    if packings:
        print("Measured: the shipped packing; packings: mean ± standard deviation.")
    print("Contact points are those of the rounded law, the guide counts element pairs (numerics.contact_law = \"demseg\"); ratios vary with the packing.")

    whole = [name for packing in packings for name, test in packing.items() if not test.failed]
    if whole:
        print(f"On the packings, {len(whole)} tests did not fail; their values are the largest so far.")
    intact = [f"{specimen}_{loading}" for (specimen, loading), test in tests.items() if not test.failed]
    if intact:
        print(f"Not failed: {', '.join(intact)} (their values above are the largest so far)")
        return 1
    print("All six specimens have failed.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
