# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts all faults into one build, each behind a switch that the environment sets: CRACKLE_FAULT=n, with n from 1 in the order of the list.

A fault's new text becomes a choice between new and old text. The choice is derived if only a number, a name or a whole statement differs.
Otherwise the fault has `switch = [part of the source, the same part with a choice]`, in which `@` stands for the switch."""

import re

header = """// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

static const int crackle_fault = [] {
    const char* number = std::getenv("CRACKLE_FAULT");
    return number != nullptr ? std::atoi(number) : 0;
}();

#define FAULT(number) (crackle_fault == (number))
"""
header_path = "tests/mutation/switch.hpp"

_token = re.compile(r'"(?:\\.|[^"\\])*"|\d[\w.]*|[A-Za-z_]\w*|->|::|<=|>=|==|!=|\+=|-=|&&|\|\||\+\+|--|<<|>>|\s+|.', re.S)
_number = r"[\d.]+(?:e\d+)?"
_name = r"[A-Za-z_]\w*"
_constant = re.compile(r"\s*(?:inline |static )*constexpr ")
_owner = re.compile(r"(?:[A-Za-z_]\w*(?:\[\w+\])?(?:\.|->|::))*$")  # what precedes a member's name


def _derived(old, new):
    """The choice between two texts that differ by a number, a name, or as whole statements; otherwise None."""
    before, after = _token.findall(old), _token.findall(new)
    first = 0
    while first < min(len(before), len(after)) and before[first] == after[first]:
        first += 1
    last = 0
    while last < min(len(before), len(after)) - first and before[-1 - last] == after[-1 - last]:
        last += 1
    head, tail = "".join(before[:first]), "".join(before[len(before) - last :])
    x = "".join(before[first : len(before) - last]).strip()
    y = "".join(after[first : len(after) - last]).strip()
    if x == "" and re.fullmatch(_number + r" \*", y):
        return f"{head}(@ ? {y[:-2]} : 1.0) * {tail}"
    if re.fullmatch(_number, x) and re.fullmatch(_number, y):
        return f"{head}(@ ? {y} : {x}){tail}"
    if re.fullmatch(_name, x) and re.fullmatch(_name, y):
        at = _owner.search(head).start()
        return f"{head[:at]}(@ ? {head[at:]}{y} : {head[at:]}{x}){tail}"
    old, new = old.strip(), new.strip()
    if not old.endswith(";") or old.count(";") > 1:
        return None
    if not new:
        return f"{{ if (!@) {{ {old} }} }}"
    if re.match(r"(return |[\w.\[\]>:-]+ (=|\+=|-=) |[\w.]+\()", old) and not old.startswith("const"):
        return f"{{ if (@) {{ {new} }} else {{ {old} }} }}"
    return None


def choices(faults, tree):
    """@return error messages; and by file the place of each choice: begin, end, text, name of the fault"""
    complaints, places = [], {}
    for number, fault in enumerate(faults, 1):
        part, choice = fault.get("switch") or (fault["old"], _derived(fault["old"], fault["new"]))
        text = (tree / fault["file"]).read_text(encoding="utf-8")
        if choice is None or text.count(part) != 1:
            complaints.append(f"{fault['id']}: found {'no way to switch it' if choice is None else f'{part!r} {text.count(part)} times'}, "
                              "expected `switch` with a part of the source that stands once")
            continue
        at = text.index(part)
        before = (text[max(0, at - 200) : at] + choice).split("@")[0]
        if _constant.match(re.split(r"[;\n]", before)[-1]):
            complaints.append(f"{fault['id']}: found a choice within `constexpr`, expected `switch` with `const`")
            continue
        places.setdefault(fault["file"], []).append((at, at + len(part), choice.replace("@", f"FAULT({number})"), fault["id"]))
    for changes in places.values():
        changes.sort()
        complaints += [f"{a[3]}, {b[3]}: found one within the other, expected `switch` of smaller parts"
                       for a, b in zip(changes, changes[1:]) if a[1] > b[0]]
    return complaints, places


def put_in(faults, tree):
    """Writes the sources of `tree` with every fault behind its switch."""
    for file, changes in choices(faults, tree)[1].items():
        text = (tree / file).read_text(encoding="utf-8")
        for begin, end, choice, _ in reversed(changes):
            text = text[:begin] + choice + text[end:]
        include = f'#include "{header_path}"\n'
        once = "#pragma once\n"
        text = text.replace(once, f"{once}\n{include}", 1) if once in text else include + text
        (tree / file).write_text(text, encoding="utf-8")
    (tree / header_path).write_text(header, encoding="utf-8")
