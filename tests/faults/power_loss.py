# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulates a loss of power after each operation of a command, from its trace (disc.py), and then what a user does next."""

import random

from disc import Disc, read_trace
from judgement import REFUSED, SAID, UNMENDED, Outcome, went_on, worst_of
from program import Run, put

SURE = (("lost", "lost"), ("lost", "kept"), ("kept", "lost"))  # (data, names)
BY_CHANCE = 200


def trace_of(program, scene, place, origin):
    scene.restore(place, origin)
    file = place / "trace"
    program.run(scene.command, place, trace=file)
    return read_trace(file, place / "work")


def states(before, operations, quick):
    """The different folders that a loss of power may leave: [(number of operations before it, what was lost, {name: bytes})]."""
    disc, chance = Disc(before), random.Random(1)
    moments = sorted(chance.choices(range(1, len(operations) + 1), k=BY_CHANCE // 10 if quick else BY_CHANCE))
    seen, found = set(), []

    def add(moment, what, files):
        key = hash(tuple(sorted(files.items())))
        if key not in seen:
            seen.add(key)
            found.append((moment, what, files))
    every = max(1, len(operations) // 8) if quick else 1
    for moment, operation in enumerate(operations, 1):
        disc.do(operation)
        if moment % every == 0 or moment == len(operations):
            for data, names in SURE:
                add(moment, f"data {data}, names {names}", disc.after_loss(data, names))
        for _ in range(moments.count(moment)):
            add(moment, "by chance", disc.after_loss("chance", "chance", chance))
    return found


def attempt(program, scene, place, files):
    """Judges what the commands that a user runs next make of such a folder."""
    put(place / "work", files)
    stopped = Run(scene.command, 130 if scene.further else -9, "", "")  # a user first tries --continue
    faults = went_on(program, scene, place, stopped, files)
    if not faults:
        return Outcome(SAID)
    # A folder may lose the file that marks its owner; the message then states what to do.
    faults = [(REFUSED if kind == UNMENDED and ("move" in words or "choose another" in words) else kind, words) for kind, words in faults]
    return Outcome(worst_of(faults), faults=faults)
