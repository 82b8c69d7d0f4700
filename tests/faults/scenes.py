# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands that are disturbed, each in a separate folder, and the commands that a user runs after a failure."""

import shutil
from dataclasses import dataclass, field
from pathlib import Path

from program import below, contents

DECKS = Path(__file__).resolve().parents[2] / "specimens/demseg"

# About 30 circles, a checkpoint every 64 steps, and frames; runs for a quarter of a second.
CASE = """[packing]
count = 30
radius_min = 0.013
radius_max = 0.026
mean_overlap = 7.74e-5
[material]
density = 2500
normal_stiffness = 1e7
shear_stiffness = 2.5e6
friction_angle = 27
damping_ratio = 0.2
[loading]
kind = "tension"
axial_strain_rate = RATE
max_axial_strain = 0.004
[output]
curve_rows = 200
frames = 3
checkpoint_interval = 1e-9
"""
PACK = "pack --count 30 --radius-min 0.013 --radius-max 0.026 --mean-overlap 7.74e-5"
NEW_FILES = [f"new_{name}" for name in ("in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat", "state.bin")]
STAGED = (".dat.new", ".bin.new", ".csv.new")  # files of a deck run that get their final names at a save
OUTPUTS = ("output.dat", "cont.dat", "cont2.dat", "energy.dat", "f-d_curve.dat", "velocity_y.dat", "bonds.dat", "events.csv")


FORCED = ("pack", "mesh", "elastic", "plot", "test", "run")  # commands with --force
GO_ON = "run out --continue -q"


def as_it_was(before, after, expected, results):
    """Checks that earlier results are unchanged or replaced by complete new ones. @return what is wrong, or None"""
    for name in results:
        old = below(before, name)
        now = {key: data for key, data in below(after, name).items() if not key.endswith(STAGED)}
        if old and now not in (old, below(expected, name)):
            return f"{name} is neither the earlier one nor the new one"
    return None


def journalled(after):
    """Whether a replacement is recorded as complete in a journal; the next command then finishes it."""
    return any(name.endswith("new_files.journal") for name in after) or \
        any(name.endswith("replaces-older-results") and data.startswith(b"complete, being moved") for name, data in after.items())


@dataclass
class Scene:
    name: str
    command: str
    files: dict = field(default_factory=dict)  # name: text
    decks: dict = field(default_factory=dict)  # name: first row of in_bc.dat; copies of `deck`
    made_by: list = field(default_factory=list)  # commands, or (command, faults) for an interrupted one
    results: tuple = ()  # names of its outputs
    grows: bool = False  # the command appends to existing results
    resume: str = "test --resume out -q"
    otherwise: str = None  # command to use if nothing can be resumed
    further: str = None  # command that continues from the end
    saves_itself: bool = False  # if asked to end, the command replaces earlier results by unfinished ones that can be resumed
    unfinished: bool = False  # the earlier results are those of an unfinished test; only the final results are compared
    expected: dict = None
    accepted: list = None

    def prepare(self, program, place):
        """Makes the folder before the command, and the results of an undisturbed run."""
        work = place / "work"
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        for name, text in self.files.items():
            (work / name).write_text(text)
        for name, first_row in self.decks.items():
            shutil.copytree(DECKS / "controlled_segment_force", work / name)
            (work / name / "README.md").unlink()
            lines = (work / name / "in_bc.dat").read_text().splitlines()
            (work / name / "in_bc.dat").write_text("\n".join([first_row, *lines[1:]]) + "\n")
        for words in self.made_by:
            words, faults = (words, {}) if isinstance(words, str) else words
            done = program.run(words, place, **faults)
            if done.code != (130 if faults else 0):
                raise RuntimeError(f"{self.name}: crackle {words} ended with {done.code}: {done.err}")
        shutil.rmtree(place / "before", ignore_errors=True)
        shutil.copytree(work, place / "before")
        self.accepted = []
        for words in dict.fromkeys([self.command, self.forced(), self.otherwise or self.command]):
            self.restore(place)
            done = program.run(words, place)
            if done.code == 0:
                self.accepted.append(contents(work))
        if not self.accepted:
            raise RuntimeError(f"{self.name}: crackle {self.command} ended with {done.code}: {done.err}")
        self.expected, self.before = self.accepted[0], contents(place / "before")
        self.one_further = None
        if self.further:
            self.restore(place)
            for words in (self.command, self.further):
                program.run(words, place)
            self.one_further = contents(work)

    def restore(self, place, origin=None):
        shutil.rmtree(place / "work", ignore_errors=True)
        shutil.copytree((origin or place) / "before", place / "work")

    def forced(self):
        return self.command if "--force" in self.command or not self.can_force() else self.command + " --force"

    def can_force(self):
        words = self.command.split()
        return words[0] in FORCED and (not {"--resume", "--continue"} & set(words) or "-o" in words)

    def ways_on(self, stopped, after):
        """Commands that a user tries next, in order, until one succeeds."""
        kind = self.command.split()[0]
        ways = []
        if kind == "test" and "out/" in after and "out/" not in self.before:
            ways.append(self.resume)
        if kind == "test" and "out.new/checkpoint" in after:
            ways.append("test --resume out.new -q")
        if self.further and stopped.code == 130 and "out/" in after:
            ways.append(GO_ON)
        return list(dict.fromkeys([*ways, self.command, self.forced(), self.otherwise or self.command]))

    def damage(self, after):
        """Damage that a failed command has done to existing files. @return description, or None"""
        for name, data in self.before.items():
            mine = any(name == result or name.startswith(result + "/") for result in self.results)
            if not mine and after.get(name) != data:
                return f"{name}, which is no result, was changed or lost"
        if self.unfinished or journalled(after):
            return None
        if not self.grows:
            return as_it_was(self.before, after, self.expected, self.results)
        folder = self.results[0]
        for name in OUTPUTS:
            old = self.before.get(f"{folder}/{name}")
            if old is not None and not after.get(f"{folder}/{name}", b"").startswith(old):
                return f"{folder}/{name} has lost rows"
        sets = [{name: files.get(f"{folder}/{name}") for name in NEW_FILES} for files in (self.before, self.expected, after)]
        return None if sets[2] in sets[:2] else "new_* are of two parts"


PLAN = """[[test]]
case = "case.toml"
[packings]
count = 2
[run]
keep = "curves"
"""
# Only moduli: two linear solves, one round, and the fresh packings.
ROCK = """[[test]]
name = "tension"
case = "case.toml"
[[target]]
test = "tension"
figure = "youngs_modulus"
value = 1e7
tolerance = 0.05
[[free]]
key = "material.normal_stiffness"
from = 2e6
to = 5e7
[packings]
fit = 4
polish = 4
fresh = 4
"""


def scenes():
    case = CASE.replace("RATE", "0.1")
    other = CASE.replace("RATE", "0.2")
    campaign = {"files": {"case.toml": case, "plan.toml": PLAN}, "made_by": ["campaign plan.toml -o out --workers 1 -q"]}
    packed = f"{PACK} -o in_gm.dat -q"
    done = "test case.toml -o out -q"
    deck, half = {"deck": "0 0 400 20 10"}, "run deck -o out --steps 250 -q"
    return [
        Scene("pack", f"{PACK} -o made/in_gm.dat -q", results=("made",)),
        Scene("pack --force", f"{PACK} -o in_gm.dat --seed 2 --force -q", made_by=[packed], results=("in_gm.dat",)),
        Scene("mesh", "mesh in_gm.dat --kind voronoi --thick 1e-3 -o mesh.dat -q", made_by=[packed], results=("mesh.dat",)),
        Scene("mesh --force", "mesh in_gm.dat --kind voronoi --thick 1e-3 -o mesh.dat --force -q",
              made_by=[packed, "mesh in_gm.dat --kind delaunay --thick 1e-3 -o mesh.dat -q"], results=("mesh.dat",)),
        Scene("run", "run deck -o out -q", decks=deck, results=("out",), further=GO_ON),
        Scene("run --force", "run deck -o out --force -q", decks=deck, made_by=[half], results=("out",), further=GO_ON, otherwise=GO_ON,
              saves_itself=True),
        Scene("run --continue", GO_ON, decks=deck, made_by=[half], results=("out",), grows=True, further=GO_ON, otherwise="run deck -o out --force -q"),
        Scene("run --continue -o", "run out --continue -o more -q", decks=deck, made_by=[half], results=("more",)),
        Scene("elastic --bonds", "elastic case.toml --bonds bonds.csv -q", files={"case.toml": case}, results=("bonds.csv",)),
        Scene("elastic --bonds --force", "elastic case.toml --bonds bonds.csv --force -q", files={"case.toml": case},
              made_by=["elastic case.toml --bonds bonds.csv --strain 2e-4 -q"], results=("bonds.csv",)),
        Scene("report", "report out -q", files={"case.toml": case}, made_by=[done, "report out --title earlier -q"], results=("out/report.html",)),
        Scene("plot", "plot out -o out.svg -q", files={"case.toml": case}, made_by=[done], results=("out.svg",)),
        Scene("plot --force", "plot out -o out.svg --force -q", files={"case.toml": case}, made_by=[done, "plot out -o out.svg --what curve -q"],
              results=("out.svg",)),
        Scene("test", done, files={"case.toml": case}, results=("out",)),
        Scene("test --force", "test case.toml -o out --force -q", files={"case.toml": case, "other.toml": other},
              made_by=["test other.toml -o out -q"], results=("out",)),
        Scene("test --resume", "test --resume out -q", files={"case.toml": case},
              made_by=[(done, {"call": "write", "at": 24, "signal": "INT"})], results=("out",), unfinished=True, otherwise="test case.toml -o out --force -q"),
        Scene("campaign", "campaign plan.toml -o out --workers 1 -q", files={"case.toml": case, "plan.toml": PLAN}, results=("out",), unfinished=True),
        Scene("campaign, again", "campaign plan.toml -o out --workers 1 -q", **campaign, results=("out",), unfinished=True),
        Scene("report of a campaign", "report out -o page.html -q", **campaign, results=("page.html",)),
        Scene("plot of a campaign", "plot out -o points.svg -q", **campaign, results=("points.svg",)),
        Scene("calibrate", "calibrate rock.toml -o out --workers 1 -q", files={"case.toml": case, "rock.toml": ROCK}, results=("out",), unfinished=True),
        Scene("test --verify", done + " --verify", files={"case.toml": case}, results=("out",), resume="test --resume out -q --verify"),
    ]
