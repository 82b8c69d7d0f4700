# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges a disturbed command: whether it reports the fault, whether earlier results are intact, and whether the same command then succeeds."""

from dataclasses import dataclass, field
from pathlib import PurePosixPath

from program import CAUSES, OF_A_PATH, contents, differences

# Good outcomes.
UNTOUCHED, UNREACHED, SAID, STOPPED, FURTHER, LEFT, REFUSED = (
    "results correct despite the fault", "not reached", "reported, then correct", "stopped by the signal, then correct", "repeated, continues by one part",
    "correct, a file left over", "refused until the folder is moved away")
GOOD = (UNTOUCHED, UNREACHED, SAID, STOPPED, FURTHER, LEFT, REFUSED)
# Bad outcomes, worst first.
SILENT, LOST, MIXED, HUNG, ABORTED, UNMENDED, WORDS, CODE = (
    "exit 0, results wrong", "earlier results lost", "continued from a mixture", "hung", "aborted", "not correct afterwards", "wrong message", "wrong exit code")
BAD = (SILENT, LOST, MIXED, HUNG, ABORTED, UNMENDED, WORDS, CODE)
OF_TESTS = ("failed because of the system", "ended with a system error")  # messages about tests of a campaign or calibration do not state the cause


def worst_of(faults):
    """The worst kind among these faults."""
    return min((kind for kind, _ in faults), key=(*BAD, REFUSED, FURTHER, LEFT).index)


def left_over(final, scene):
    """Names of additional files beside correct results; empty if there are none, or if results are wrong."""
    for right in scene.accepted:
        if all(final.get(name) == data for name, data in right.items()):
            return ", ".join(name for name in final if name not in right)
    return ""


@dataclass
class Outcome:
    kind: str
    faults: list = field(default_factory=list)  # (kind, detail) of everything that is wrong or notable


def names_for(path):
    """The names by which a message may refer to a path: the file or a folder above it."""
    path = PurePosixPath(path)
    name = path.name
    found = {name} if name else set()
    found |= {part for part in path.parent.parts}
    return found | ({"."} if len(path.parts) <= 1 else set())


def wrong_words(run, error, calls):
    """What is wrong with the error message, or None."""
    lines = run.err.splitlines()
    if len(lines) != 1:
        return f"{len(lines)} lines: {run.err.strip()[:160]!r}"
    if error is None:
        return None
    if CAUSES[error] not in lines[0]:
        return f"no cause ({CAUSES[error]}): {lines[0]}"
    if error != "ENOMEM" and calls and calls[0].kind != "fork" and not any(name in lines[0] for call in calls for name in names_for(call.path)):
        return f"names no file ({calls[0].path}): {lines[0]}"
    return None


def went_on(program, scene, place, stopped, after):
    """Runs the commands that a user runs next. @return faults found"""
    found = []
    for words in scene.ways_on(stopped, after):
        done = program.run(words, place)
        if done.hung:
            return [(HUNG, f"crackle {words}")]
        if done.code == 0:
            final = contents(place / "work")
            if final in scene.accepted:
                return found
            if scene.one_further is not None and final == scene.one_further:
                return [*found, (FURTHER, f"crackle {words}")]
            if names := left_over(final, scene):
                return [*found, (LEFT, f"crackle {words}: {names}")]
            return [*found, (MIXED, f"crackle {words}: exit 0, {differences(final, scene.expected)}")]
        if not 1 <= done.code <= 4:
            return [*found, (ABORTED, f"crackle {words} ended with {done.code}: {done.err.strip()[:160]}")]
        if complaint := wrong_words(done, None, []):
            found.append((WORDS, f"crackle {words}: {complaint}"))
    return [*found, (UNMENDED, f"crackle {words}: {done.err.strip()[:200]}")]


def judge(program, scene, place, run, error=None, signal=None, mend=lambda: None):
    """Judges a run with a failing call or a signal. error: name of the call's error; signal: its name; mend: called before the user continues"""
    if run.hung:
        return Outcome(HUNG, faults=[(HUNG, "more than a minute of processor time, or no end")])
    after = contents(place / "work")
    if run.code == 0:
        if after in scene.accepted:
            return Outcome(UNTOUCHED if run.calls else UNREACHED)
        if names := left_over(after, scene):
            return Outcome(LEFT, faults=[(LEFT, names)])
        return Outcome(SILENT, faults=[(SILENT, differences(after, scene.expected))])
    faults = []
    if signal is None:
        if run.code < 0:
            faults.append((ABORTED, f"signal {-run.code}: {run.err.strip()[:160]}"))
        elif run.code > 4:
            faults.append((CODE, f"{run.code}: {run.err.strip()[:160]}"))
        elif error and run.code != (wanted := 2 if error in OF_A_PATH and not any(words in run.err for words in OF_TESTS) else 4):
            faults.append((CODE, f"{run.code}, expected {wanted}: {run.err.strip()[:160]}"))
        elif complaint := wrong_words(run, error, run.calls):
            faults.append((WORDS, complaint))
    elif run.code > 0:
        if complaint := wrong_words(run, None, []):
            faults.append((WORDS, complaint))
    if lost := None if run.code == 130 and scene.saves_itself else scene.damage(after):
        faults.append((LOST, lost + (f"; it says: {run.err.strip()[-60:]}" if "are unchanged" in run.err else "")))
    elif "are unchanged" in run.err and not all(after.get(name) == data for name, data in scene.before.items()):
        faults.append((WORDS, f"says that outputs are unchanged, and they are not: {run.err.strip()[:200]}"))
    mend()
    faults += went_on(program, scene, place, run, after)
    if faults:
        return Outcome(worst_of(faults), faults=faults)
    return Outcome(SAID if run.code > 0 else STOPPED)
