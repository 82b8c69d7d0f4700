#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what DEMseg's guide states of its rock beside what six virtual tests of it measured.

  tools/compare_with_guide.py FOLDER

FOLDER holds circles_tension, circles_compression, delaunay_..., voronoi_..., each as `crackle test -o` left it; only their
summary.json is read. The guide's words are about one packing, and ratios vary with the packing: they are shown, not judged.
Judged is whether every test ended in failure of its specimen.

Exit codes: 0 all six have failed, 1 some have not (named), 2 a summary is missing or lacks a key.
"""
import json
import math
import sys
from pathlib import Path

SPECIMENS = ("circles", "delaunay", "voronoi")
LOADINGS = ("tension", "compression")

# The guide's limit values of the circle specimen, which its sentences refer to.
LIMIT_STRESS = 19.4e3  # N/m: mean back-tension over mean diameter, 0.774 kN / 4 cm
LIMIT_STRAIN = 0.0019
LIMIT_STIFFNESS = LIMIT_STRESS / LIMIT_STRAIN  # N/m


class BadInput(Exception):
    """What was found, what was expected, what to do."""


class Summary:
    """summary.json of one test. Units: N, m; stresses and moduli N/m."""

    def __init__(self, file):
        self.file = file
        try:
            self.keys = json.loads(file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise BadInput(f"{file}: file not found, expected the results of a test; make them with tools/quickstart") from None
        except (json.JSONDecodeError, UnicodeDecodeError) as error:
            raise BadInput(f"{file}: found broken JSON ({error}); run tools/quickstart again") from None
        if not isinstance(self.keys, dict) or not isinstance(self.keys.get("failed"), bool):
            raise BadInput(f"{file}: failed: found {self.keys.get('failed') if isinstance(self.keys, dict) else 'no object'}, "
                           "expected true or false")

    @property
    def failed(self):
        return self.keys["failed"]

    def number(self, key):
        value = self.keys.get(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise BadInput(f"{self.file}: {key}: found {json.dumps(value)}, expected a number")
        return value


def rows_of(tests):
    """Rows (what, the guide's word, measured) for the tests of read_tests()."""
    def strength(specimen, loading):
        """The guide's is the largest stress, whatever came before."""
        return tests[specimen, loading].number("largest_stress")

    def over_tension(specimen):
        return strength(specimen, "compression") / strength(specimen, "tension")

    def pulled(specimen, key):
        return tests[specimen, "tension"].number(key)

    tangent, young = "initial_tangent_modulus", "youngs_modulus"
    contacts, interfaces = "contacts_initial", "interfaces_initial"
    rows = [
        ("circles", None, None),
        ("  number", "304", f"{pulled('circles', 'particles'):.0f}"),
        ("  mean back-tension of a bond", "0.774 kN", f"{pulled('circles', 'mean_back_tension') / 1e3:.3f} kN"),
    ]
    for loading, name in (("tension", "pulled"), ("compression", "squeezed")):
        stiffness = tests["circles", loading].number(tangent)
        rows.append((f"  initial stiffness, {name}, over 19.4/0.0019 kN/m", "about 1/2",
                     f"{stiffness / LIMIT_STIFFNESS:.2f}   ({stiffness / 1e6:.2f} MN/m)"))
    rows += [
        ("  the same with every bond intact (sparse solve)", "",
         f"{pulled('circles', young) / LIMIT_STIFFNESS:.2f}   ({pulled('circles', young) / 1e6:.2f} MN/m)"),
        ("  tensile strength over 19.4 kN/m", "about 1/4",
         f"{strength('circles', 'tension') / LIMIT_STRESS:.2f}   ({strength('circles', 'tension') / 1e3:.2f} kN/m)"),
        ("  compressive strength over 19.4 kN/m", "about 1/2",
         f"{strength('circles', 'compression') / LIMIT_STRESS:.2f}   ({strength('circles', 'compression') / 1e3:.2f} kN/m)"),
        ("  compressive over tensile strength", "about 2", f"{over_tension('circles'):.1f}"),
        ("triangles", None, None),
        ("  number", "537 between centres alone", f"{pulled('delaunay', 'particles'):.0f}"),
        ("  contact points over the circles'", "about 10 (element pairs)",
         f"{pulled('delaunay', contacts) / pulled('circles', contacts):.1f}   "
         f"({pulled('delaunay', contacts):.0f} over {pulled('circles', contacts):.0f})"),
        ("  interfaces over the circles'", "",
         f"{pulled('delaunay', interfaces) / pulled('circles', interfaces):.1f}   "
         f"({pulled('delaunay', interfaces):.0f} over {pulled('circles', interfaces):.0f})"),
        ("  initial stiffness over the circles', pulled", "about sqrt(10) = 3.2",
         f"{pulled('delaunay', tangent) / pulled('circles', tangent):.2f}"),
        ("  the same with every bond intact (sparse solve)", "",
         f"{pulled('delaunay', young) / pulled('circles', young):.2f}"),
        ("  strain at tensile strength", "about 0.002", f"{tests['delaunay', 'tension'].number('strain_at_largest_stress'):.5f}"),
        ("  compressive over tensile strength", "about 10", f"{over_tension('delaunay'):.1f}"),
        ("Voronoi polygons", None, None),
        ("  contact points over the triangles'", "1.2 (element pairs)",
         f"{pulled('voronoi', contacts) / pulled('delaunay', contacts):.2f}   "
         f"({pulled('voronoi', contacts):.0f} over {pulled('delaunay', contacts):.0f})"),
        ("  compressive strength over the triangles'", "larger",
         f"{strength('voronoi', 'compression') / strength('delaunay', 'compression'):.2f}   "
         f"({strength('voronoi', 'compression') / 1e3:.1f} over {strength('delaunay', 'compression') / 1e3:.1f} kN/m)"),
        ("  compressive over tensile strength", "more than the triangles'", f"{over_tension('voronoi'):.1f}"),
    ]
    return rows


def read_tests(folder):
    return {(specimen, loading): Summary(folder / f"{specimen}_{loading}" / "summary.json")
            for specimen in SPECIMENS for loading in LOADINGS}


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        asked = arguments in (["-h"], ["--help"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        return 0 if asked else 2
    try:
        tests = read_tests(Path(arguments[0]))
        rows = rows_of(tests)
    except BadInput as error:
        print(f"compare_with_guide: {error}", file=sys.stderr)
        return 2
    first = max(len(row[0]) for row in rows)
    second = max(len(row[1] or "") for row in rows)
    print(f"{'':{first}}  {'the guide':{second}}  measured")
    for what, guide, measured in rows:
        print(what if guide is None else f"{what:{first}}  {guide:{second}}  {measured}")
    print("Contact points are those of the rounded law, the guide counts element pairs (numerics.contact_law = \"demseg\"); ratios vary with the packing.")

    intact = [f"{specimen}_{loading}" for (specimen, loading), test in tests.items() if not test.failed]
    if intact:
        print(f"Not failed: {', '.join(intact)} (of these the values above are the largest so far)")
        return 1
    print("All six specimens have failed.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
