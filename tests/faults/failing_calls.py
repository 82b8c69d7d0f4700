# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes each call of each kind fail, once or from then on, and sends signals at each write."""

import random
import re

from judgement import judge
from program import ERRORS

FIRST, BEYOND = 200, 50  # all of the first 200 calls of a kind, and 50 of the others
SIGNALS = ("KILL", "TERM", "HUP", "INT", "PIPE", "XFSZ")


def kinds_of(calls):
    """{kind: its calls}"""
    found = {}
    for call in calls:
        found.setdefault(call.kind, []).append(call)
    return found


def chosen(calls, quick):
    """The calls of one kind that are made to fail. quick: the first on each file (names that differ in numbers count as one), and the last."""
    if quick:
        firsts = {}
        for call in calls:
            firsts.setdefault(re.sub(r"\d+", "", call.path), call.number)
        return sorted({*firsts.values(), calls[-1].number})
    numbers = [call.number for call in calls]
    beyond = numbers[FIRST:]
    return numbers[:FIRST] + sorted(random.Random(1).sample(beyond, min(BEYOND, len(beyond))))


def plans_of_calls(scene, calls, quick, only=None):
    """Faults to try: [(kind, path, {name: value})]."""
    plans = []
    for kind, own in kinds_of(calls).items():
        if only and kind not in only:
            continue
        for place, number in enumerate(chosen(own, quick)):
            path = own[number - 1].path
            for mode in ("once", "on"):
                if kind == "thread" and (number, mode) != (1, "on"):  # a limit on threads stays in effect
                    continue
                if quick and kind != "thread" and (mode == "on") != (place % 3 == 0):
                    continue
                plans.append((kind, path, {"call": kind, "at": number, "mode": mode, "errno": ERRORS[kind][mode == "on"]}))
    return plans


def plans_of_signals(scene, calls, quick):
    own = kinds_of(calls).get("write", [])
    numbers = [call.number for call in own][:FIRST]
    plans = []
    for place, number in enumerate(numbers):
        for which, name in enumerate(SIGNALS):
            # A few of each signal, spread over the writes.
            if quick and (place % 12 != 2 * which or len(plans) >= 24):
                continue
            plans.append((name, own[number - 1].path, {"call": "write", "at": number, "signal": name}))
    return plans


def attempt(program, scene, place, origin, faults):
    """Runs and judges one disturbed command. place: folder of the run; origin: where the scene was prepared"""
    scene.restore(place, origin)
    run = program.run(scene.command, place, **faults)
    return judge(program, scene, place, run, faults.get("errno"), faults.get("signal")), run
