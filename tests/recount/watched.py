#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes watched.md: which test checks each figure that a user can read.

  tests/recount/watched.py --write    writes the table
  tests/recount/watched.py            exits with 1 if the table is stale, a row is empty, or a named test does not exist

Figures are read from the sources that declare them, and those of summary.json from FILES.md. The figures that the recount compares are in differences.md; tests of the others are listed in elsewhere.toml."""

import fnmatch
import re
import sys
import tomllib
from pathlib import Path

here, top = Path(__file__).resolve().parent, Path(__file__).resolve().parents[2]


def source(name):
    return (top / name).read_text(encoding="utf-8")


def all_of(pattern, name):
    return re.findall(pattern, source(name), re.MULTILINE | re.DOTALL)


def words(list_of_strings):
    return re.findall(r'"([\w.]+)"', list_of_strings)


def summary():
    keys = source("specimens/results/FILES.md").partition("\n## `summary.json`")[2].partition("\n## ")[0]
    return re.findall(r"^\| `([\w.\[\]*]+)`", keys, re.MULTILINE)


def curve():
    return all_of(r'\{\{?"(\w+)", ', "specimens/observers/curve.cpp")


def emission():
    return all_of(r'\{\{"(\w+)", ', "specimens/emission/acoustic_event.cpp")


def campaign():
    table = "specimens/campaign/point_table.cpp"
    head = all_of(r'"(,planned,.*?)\\n"', table)[0]
    return re.findall(r"\w+", re.sub(r'"\s*"', "", head))


def ledger():
    return ["row", "test", *words(all_of(r"behind_axes\{(.*?)\};", "specimens/campaign/point_table.cpp")[0])]


def page():
    data = "tools/page/page_data.cpp"
    names = all_of(r'\badd(?:_row)?\("([\w.]+)"', data) + all_of(r'add_field\(block, "(\w+)"', data)
    for part, listed in all_of(r'real\("(\w+\.)", [^{]*\{([^}]*)\}', data):
        names += [part + name for name in words(listed)]
    for listed, part in all_of(r'for \(const char\* name : \{([^}]*)\}\)\s*block\.add\(std::string\("(\w+\.)"\)', data):
        names += [part + name for name in words(listed)]
    names += ["events." + name for name in all_of(r'\bflag\("(\w+)"', data)]
    for table, of in (("tools/campaign/page/campaign_page.cpp", "campaign"), ("tools/calibrate/calibration_page.cpp", "calibration")):
        names += [f"{of}: {head}" for head in all_of(r"<th(?: class=[^>]*)?>([^<{]+)</th>", table)]
    return names


def axes():
    names = []
    for header in sorted((top / "tools" / "plot").glob("*.hpp")) + [top / "tools" / "joints" / "joint_panels.hpp"]:
        names += re.findall(r"^(?:plot::)?Panel (\w+)\(", header.read_text(encoding="utf-8"), re.MULTILINE)
    return names


def python():
    names = []
    for file in ("particles", "results"):
        for function, body in all_of(r"^py::(?:dict|list) (\w+)\((.*?)^\}", f"tools/python/{file}.cpp"):
            of = re.findall(r'(?:\ball|\bone)\[(?:py::str\()?"(\w+)"|\bput\("(\w+)"', body)
            names += [f"{function}.{a or b}" for a, b in of]
    state = "tools/python/state.cpp"
    names += ["contacts." + name for listed in all_of(r"CRACKLE_FIELDS\(([^)]*)\)", state) for name in re.findall(r"\w+", listed)]
    names += ["state." + name for name in all_of(r'\.def_property(?:_readonly)?\(\s*"(\w+)"', state)]
    return names


sections = {"summary": ("summary.json", summary), "curve": ("curve.csv", curve), "emission": ("ae.csv", emission),
            "campaign": ("Table of a campaign's points", campaign), "ledger": ("A campaign's ledger", ledger),
            "page": ("The report's page", page), "axes": ("Panels of figures", axes), "python": ("Arrays of Python", python)}


def recounted():
    """Figures that the recount compares with a value. In names, [] replaces a number, and * one of several names."""
    found = {}
    for name, tests in re.findall(r"^\| (.+?) \| (\d+) \|", (here / "differences.md").read_text(encoding="utf-8"), re.MULTILINE):
        found[re.sub(r"\[\d+\]", "[]", name)] = int(tests)
    return found


def watched_by_recount(section, figure, known):
    names = {"summary": [figure, figure.replace("*", "?*")], "curve": [f"curve: {figure}", f"curve: {figure} *", f"frames: curve: {figure}", f"history: {figure}"],
             "emission": [f"ae: {figure}", f"ae: {figure} *"]}.get(section, [])
    names += [name + end for name in names if section == "summary" for end in (":*", ".*") if end == ":*"]
    # In patterns, [[] is a bracket.
    return sum(tests for name, tests in known.items() if any(fnmatch.fnmatchcase(name, one.replace("[]", "[[]]")) for one in names))


def tests_there_are():
    found = set()
    for file in (top / "tests").rglob("*.cpp"):
        text = file.read_text(encoding="utf-8")
        found |= {f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", text, re.MULTILINE)}
    for file in (top / "tests").rglob("*_test.py"):
        suite = ""
        for kind, name in re.findall(r"^(class| +def) (\w+)", file.read_text(encoding="utf-8"), re.MULTILINE):
            if kind == "class":
                suite = name
            else:
                found.add(f"{file.stem}: {suite}.{name}")
    return found


def table():
    """@return text of watched.md, complaints"""
    elsewhere = tomllib.loads((here / "elsewhere.toml").read_text(encoding="utf-8"))
    known, tests, complaints, used = recounted(), tests_there_are(), [], set()
    lines = ["# Which test watches each figure", "",
             "Made by `tests/recount/watched.py --write`: figures by the sources that declare them; «recount (n)» is compared with a value in n of the recount's tests ([differences.md](differences.md)), other tests are named in",
             "[elsewhere.toml](elsewhere.toml). `ctest -R Watched` fails where a row is empty or this page is stale."]
    for section, (title, names) in sections.items():
        lines += ["", f"## {title}", "", "| figure | watched by |", "| --- | --- |"]
        all_names = list(dict.fromkeys(names()))
        for figure in all_names:
            if any(other.startswith((figure + ".", figure + "[]")) for other in all_names):
                continue  # a table, whose figures follow
            by, times = [], watched_by_recount(section, figure, known)
            if times:
                by.append(f"recount ({times})")
            fitting = [one for one in elsewhere.get(section, {}) if fnmatch.fnmatchcase(figure, one.replace("[]", "[[]]"))]
            if fitting:
                pattern = max(fitting, key=len)  # the most specific pattern counts
                named = elsewhere[section][pattern]
                used.add((section, pattern))
                by += [named] if isinstance(named, str) else named
            complaints += [f"{title}: {figure}: found no test that watches it, expected one" for _ in [0] if not by]
            lines.append(f"| {figure} | {', '.join(by)} |")
    for section, patterns in elsewhere.items():
        for pattern, named in patterns.items():
            if (section, pattern) not in used:
                complaints.append(f"elsewhere.toml: [{section}] \"{pattern}\": found no such figure")
            for one in [named] if isinstance(named, str) else named:
                if one not in tests:
                    complaints.append(f"elsewhere.toml: [{section}] \"{pattern}\": found no test {one}")
    return "\n".join(lines) + "\n", complaints


def main(arguments):
    text, complaints = table()
    page_file = here / "watched.md"
    if arguments == ["--write"]:
        page_file.write_text(text, encoding="utf-8")
    elif arguments:
        print(__doc__)
        return 2
    elif not page_file.is_file() or page_file.read_text(encoding="utf-8") != text:
        complaints.append("watched.md: found another table, expected that of tests/recount/watched.py --write")
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
