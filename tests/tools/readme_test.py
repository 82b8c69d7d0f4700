#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the Markdown pages: their commands run, their tables name what the program writes, and their links lead to existing targets.

  tests/tools/readme_test.py Pages        everything except what follows
  tests/tools/readme_test.py SlowPages    pages with blocks marked `sh slow`
  CRACKLE_PROGRAM, CRACKLE_BENCH_PROGRAM    the programs
  CRACKLE_RECORD=1    replaces committed pictures by those that the commands make, in place of comparing them
Pages are all Markdown files of the tree. A page's blocks marked `sh` run in order in one shell, those of the README first. All run in one
folder, which contains specimens/, tools/recount and the built programs at the places that the README states. Then a page's blocks marked
`python` run as one script. Commands of blocks marked `sh ci` must be part of .ci/run. Commands that take long or need more packages are
marked `sh long`, or written as «Made by `...`» and «Run: `...`». They must name existing programs, options and folders.
Blocks marked `sh slow` take up to minutes. SlowPages runs them with the page's blocks marked `sh`, in the page's order. The tutorial
and the pages of concepts make their own pictures: `-o out/FOLDER/NAME.svg` makes FOLDER/NAME.svg, which must have the same bytes.
"""
import functools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ["CRACKLE_PROGRAM"]).resolve()
BENCH_PROGRAM = Path(os.environ["CRACKLE_BENCH_PROGRAM"]).resolve()  # crackle_bench is in the same folder as crackle
ROOMS = ("solver", "mesher", "specimens", "tools", "tests")
AT_MOST = {"README.md": 9000, "CONTRIBUTING.md": 9000}  # bytes
TUTORIAL = "specimens/TUTORIAL.md"
CONCEPTS = "specimens/concepts/"
TWO_SCREENS = 6000  # bytes of a page of concepts
LARGEST_PICTURE = 150_000  # bytes
PAGES = {name: (TOP / name).read_text(encoding="utf-8") for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")} | {
    str(path.relative_to(TOP)): path.read_text(encoding="utf-8")
    for room in ROOMS for path in sorted((TOP / room).rglob("*.md")) if "node_modules" not in path.parts}
README = PAGES["README.md"]
FILES = PAGES["specimens/results/FILES.md"]
ILLUSTRATED = [page for page in PAGES if page == TUTORIAL or page.startswith(CONCEPTS)]
RECORD = os.environ.get("CRACKLE_RECORD") == "1"
LONE = re.compile(r"(?:Made by|Run:) `([^`]+)`")


def blocks(mark, page):
    return re.findall(rf"^```{mark}\n(.*?)^```$", PAGES[page], re.MULTILINE | re.DOTALL)


def lines(mark, page):
    found = (line.split(" #")[0].strip() for block in blocks(mark, page) for line in block.splitlines())
    return [line for line in found if line]


def pictures_shown(page):
    return re.findall(r"!\[[^\]]+\]\(([^)]+)\)", PAGES[page])


def pictures_made(mark, page):
    """Names, in specimens/, of the pictures that a page's commands make below out/."""
    return re.findall(r"-o out/((?:tutorial|concepts)/[\w-]+\.(?:svg|png))\b", "\n".join(blocks(mark, page)))


def table(text, heading):
    """Names in backquotes in the first column of the first table after the line that begins with `heading`."""
    start = text.index("\n" + heading)
    rows = re.search(r"\n\n((?:\|.*\n)+)", text[start:]).group(1).splitlines()[2:]
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row.split("|")[1])]


def anchors(text):
    """Anchors of a page's headings."""
    headings = (re.sub(r"\]\([^)]*\)", "]", line) for line in re.findall(r"^#+ (.+)$", text, re.MULTILINE))
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@functools.cache
def printed(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    return done.stdout + done.stderr


def help_of(words):
    """A text that contains the options of a command's program, and the remaining words of the command."""
    name = words[0]
    if name in ("crackle", "crackle-bench"):
        return printed(PROGRAM if name == "crackle" else BENCH_PROGRAM, words[1], "--help"), words[2:]
    if name in ("node", "bash"):
        name, words = words[1], words[1:]
    if name.startswith("build/"):
        room, target = Path(*Path(name).parts[2:]).parent, Path(name).name
        assert f"add_executable({target} " in (TOP / room / "CMakeLists.txt").read_text(encoding="utf-8"), f"{name}: found no such target"
        return "", words[1:]
    script = TOP / name
    assert script.is_file(), f"{name}: found nothing, expected a program"
    text = script.read_text(encoding="utf-8")
    return text, words[1:]


@functools.cache
def build_names():
    """Names of presets, and of programs that CMake builds."""
    presets = json.loads((TOP / "CMakePresets.json").read_text(encoding="utf-8"))
    names = {preset["name"] for preset in presets["configurePresets"]}
    for room in ROOMS:
        for path in (TOP / room).rglob("CMakeLists.txt"):
            names |= set(re.findall(r"(?:add_executable\(|crackle_test\(NAME )(\w[\w-]*)", path.read_text(encoding="utf-8")))
    return names


def check_words(line):
    """Checks program, options and folders of a command that is not run."""
    words = shlex.split(line)
    if words[0] in ("cmake", "ctest"):
        for option, name in zip(words, words[1:]):
            if option in ("--preset", "--target"):
                assert name in build_names(), f"{line}: found {name}, expected a preset or a program of the build"
        return
    text, words = help_of(words)
    for word in words:
        if word.startswith("-"):
            assert re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", text), f"{line}: found {word}, expected an option of the program"
        if word.startswith("specimens/"):
            assert (TOP / word).exists(), f"{line}: found no {word}"


def flat(value, path=""):
    """Names of a summary's keys, as in FILES.md."""
    if path in ("columns", "units") or not isinstance(value, (dict, list)):
        return {path}
    inner = value.items() if isinstance(value, dict) else [("[]", entry) for entry in value if isinstance(entry, (dict, list))]
    names = {path} if path else set()
    for key, entry in inner:
        names |= flat(entry, f"{path}[]" if key == "[]" else f"{path}.{key}" if path else key)
    return names


def declared(name):
    """The name of a summary's key with the wildcards of FILES.md."""
    name = re.sub(r"^numerical_errors\.companions\.\w+", "numerical_errors.companions.*", name)
    name = re.sub(r"^crack_rose\.\w+", "crack_rose.*", name)
    name = re.sub(r"^traces\[\].*|^(joints\[\]\.at_end|energy_at_end)\..*", lambda found: found[1] or "traces", name)
    name = re.sub(r"^files\.(curve\.csv|events\.csv|slips\.csv|ae\.csv|checkpoint)", "files.*", name)
    return re.sub(r"^numerical_errors\.(youngs_modulus|peak_stress|peak_strain|crack_\w+_stress)", "numerical_errors.*", name)


# Together, the following tests write everything that FILES.md names. This one has two minerals and the guide's law, and
# ends before it fails, verified and profiled.
UNFAILED = """include = "{top}/specimens/guide_rock/voronoi_tension.toml"
[packing]
count = 30
[loading]
max_axial_strain = 1e-4
[numerics]
contact_law = "demseg"
[output]
curve_rows = 50
frames = 2
[[mineral]]
name = "quartz"
area_share = 0.3
normal_stiffness = 2e7
[[mineral]]
name = "feldspar"
"""
# A confined test; one strain leads to failure, the other does not.
CONFINED = """include = "{top}/specimens/guide_rock/circles_compression.toml"
[packing]
count = 60
[loading]
kind = "biaxial"
max_axial_strain = {strain}
[confinement]
pressure = 1e3
[output]
frames = 2
"""
# Other kinds of test, with and without failure, and a test with acoustic emission.
GRAIN = """include = "{top}/specimens/rocks/granite.toml"
[packing]
width = 0.03
height = {height}
"""
OTHERS = {
    "half_disc": (0.015, '[loading]\nkind = "scb"\nmax_axial_strain = 0.002\n'),
    "half_disc_unfailed": (0.015, '[loading]\nkind = "scb"\nmax_axial_strain = 1e-5\n'),
    "beam_unfailed": (0.007, '[loading]\nkind = "bending"\nspan = 0.02\nmax_axial_strain = 1e-5\n'),
    "sheared": (0.015, '[loading]\nkind = "direct_shear"\nnormal_stress = 1e6\nnormal_stiffness = 1e11\nmax_axial_strain = 0.003\n'),
    "sheared_unfailed": (0.015, '[loading]\nkind = "direct_shear"\nnormal_stress = 1e6\nnormal_stiffness = 1e11\nmax_axial_strain = 1e-5\n'),
    "unloaded": (0.015, '[loading]\nkind = "compression"\nunload_at_strain = [0.001]\nmax_axial_strain = 0.002\n'),
    "squeezed_verified": (0.015, '[loading]\nkind = "compression"\nmax_axial_strain = 0.004\n', "--verify"),
    "heard": (0.06, '[loading]\nkind = "tension"\nmax_axial_strain = 0.001\n[output]\nemission = true\n'),
}
CONTAINERS = {"files.*", "crack_rose.*", "numerical_errors.*", "numerical_errors.companions", "numerical_errors.companions.*", "profile.phases", "profile.phases[]", "minerals[]", "validity[]", "cycles[]", "joints[]"}


JOINTED = "plane"  # a folder that commands of a page make


class RunPages(unittest.TestCase):
    """Runs the commands of pages in a folder that has what the README's reader has."""
    runs: dict

    @classmethod
    def prepare(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.folder / "tools").mkdir()
        (cls.folder / "tools" / "recount").symlink_to(TOP / "tools" / "recount")
        (cls.folder / "specimens").symlink_to(TOP / "specimens")
        (cls.folder / "build" / "release").mkdir(parents=True)
        (cls.folder / "build" / "release" / "tools").symlink_to(PROGRAM.parent)
        (cls.folder / "build" / "release" / "python").symlink_to(PROGRAM.parents[1] / "python")
        cls.runs = {}

    @classmethod
    def run_page(cls, page, mark="sh"):
        """Runs a page's blocks marked `mark` as one script, then those marked `python`."""
        before = "" if page == "README.md" else 'export PATH="$PWD/build/release/tools:$PATH"\n'
        cls.run_of(page, mark, ["bash", "-eux", "-c", before + "\n".join(blocks(mark, page))])
        cls.run_of(page, "python", [sys.executable, "-c", "\n".join(blocks("python", page))])

    @classmethod
    def run_of(cls, page, mark, words):
        if not blocks(mark, page):
            return
        environment = os.environ | {"PYTHONPATH": str(cls.folder / "build" / "release" / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(words, cwd=cls.folder, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, env=environment)
        print(f"== {page}, {mark}", done.stdout, done.stderr, sep="\n")
        cls.runs[page, mark] = done

    def expect_success(self):
        for where, done in self.runs.items():
            self.assertEqual(done.returncode, 0, f"{where}: {done.stderr[-2000:]}")

    def compare_pictures(self, mark):
        """Compares the pictures that a page's commands have made with those that it shows."""
        for page in ILLUSTRATED:
            for name in pictures_made(mark, page):
                made, shown = self.folder / "out" / name, TOP / "specimens" / name
                with self.subTest(page=page, picture=name):
                    self.assertLessEqual(made.stat().st_size, LARGEST_PICTURE)
                    if RECORD:
                        shown.parent.mkdir(exist_ok=True)
                        shutil.copy(made, shown)
                    self.assertTrue(shown.is_file() and shown.read_bytes() == made.read_bytes(),
                                    f"{shown.relative_to(TOP)} is not what the page's command makes; CRACKLE_RECORD=1 replaces it")


class SlowPages(RunPages):
    @classmethod
    def setUpClass(cls):
        cls.prepare()
        for page in PAGES:
            if blocks("sh slow", page):
                cls.run_page(page, "sh(?: slow)?")

    def test_commands_run(self):
        self.assertIn((TUTORIAL, "sh(?: slow)?"), self.runs)
        self.expect_success()

    def test_pictures_are_those_that_the_commands_make(self):
        self.compare_pictures("sh slow")


class Pages(RunPages):
    @classmethod
    def setUpClass(cls):
        cls.prepare()
        for page in PAGES:
            cls.run_page(page)
        (cls.folder / "unfailed.toml").write_text(UNFAILED.format(top=TOP), encoding="utf-8")
        cls.unfailed = subprocess.run([PROGRAM, "test", "unfailed.toml", "-o", "out/unfailed", "--verify", "--profile", "-q"], cwd=cls.folder,
                                      capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
        print(cls.unfailed.stderr)
        cls.confined = []
        for name, strain in (("confined", 0.02), ("confined_unfailed", 1e-4)):
            (cls.folder / f"{name}.toml").write_text(CONFINED.format(top=TOP, strain=strain), encoding="utf-8")
            cls.confined.append(subprocess.run([PROGRAM, "test", f"{name}.toml", "-o", f"out/{name}", "-q"], cwd=cls.folder, capture_output=True,
                                               text=True, check=False, stdin=subprocess.DEVNULL))

        cls.others = []
        for name, (height, text, *flags) in OTHERS.items():
            (cls.folder / f"{name}.toml").write_text(GRAIN.format(top=TOP, height=height) + text, encoding="utf-8")
            cls.others.append(subprocess.run([PROGRAM, "test", f"{name}.toml", "-o", f"out/{name}", "-q", *flags], cwd=cls.folder, capture_output=True,
                                             text=True, check=False, stdin=subprocess.DEVNULL))

    def test_commands_run(self):
        self.assertGreaterEqual(len(blocks("sh", "README.md")), 6)
        self.assertGreaterEqual(len(self.runs), 3)
        self.expect_success()
        for made in ("out/in_gm.dat", "out/in_gm_volo.dat", "out/pulled/summary.json", "out/squeezed/curve.csv",
                     "out/report.html", "out/triangle/output.dat"):
            self.assertTrue((self.folder / made).is_file(), f"{made}: found nothing, expected what the README's commands make")
        self.assertNotEqual(self.runs["specimens/EXAMPLES.md", "python"].stdout, "")

    def test_commands_for_ci_stand_in_ci(self):
        script = (TOP / ".ci" / "run").read_text(encoding="utf-8")
        commands = [line for page in PAGES for line in lines("sh ci", page)]
        self.assertGreaterEqual(len(commands), 3)
        for command in commands:
            self.assertRegex(script, rf"(?m)^[^#\n]*{re.escape(command)}\b", f"«{command}» is not run by .ci/run")

    def test_long_commands_could_run(self):
        commands = [(page, line) for page in PAGES for line in lines("sh long", page) + LONE.findall(PAGES[page])]
        self.assertGreaterEqual(len(commands), 30)
        for page, command in commands:
            with self.subTest(page=page, command=command):
                check_words(command)

    def test_every_block_is_tested_or_of_another_language(self):
        for page, text in PAGES.items():
            for mark in re.findall(r"^```(.+)$", text, re.MULTILINE):
                self.assertIn(mark, ("sh", "sh ci", "sh long", "sh slow", "python", "toml"), f"{page}: a block that no test reads")

    def test_pictures_are_those_that_the_commands_make(self):
        self.compare_pictures("sh")

    def test_pages_of_concepts_are_short_listed_and_have_a_picture_of_their_own(self):
        pages = {page for page in ILLUSTRATED if page not in (TUTORIAL, CONCEPTS + "README.md")}
        listed = {CONCEPTS + link for link in re.findall(r"\]\((\w+\.md)\)", PAGES[CONCEPTS + "README.md"])}
        self.assertEqual(listed, pages)
        self.assertGreaterEqual(len(pages), 8)
        for page in pages:
            self.assertLessEqual(len(PAGES[page].encode()), TWO_SCREENS, page)
            self.assertEqual(len(pictures_shown(page)), 1, page)

    def test_pictures_are_made_by_the_page_that_shows_them(self):
        for page in ILLUSTRATED:
            made = pictures_made("sh(?: slow)?", page)
            self.assertCountEqual([str(Path(page).parent.joinpath(name).relative_to("specimens")) for name in pictures_shown(page)], made, page)

    def test_doors_are_short(self):
        for page, most in AT_MOST.items():
            self.assertLessEqual(len(PAGES[page].encode()), most, page)

    def test_pages_of_methods_are_short_listed_and_installed(self):
        index = PAGES["specimens/METHODS.md"]
        listed = {str((TOP / "specimens" / link).resolve().relative_to(TOP)) for link in re.findall(r"\]\(([\w./]+/METHODS\.md)\)", index)}
        pages = {page for page in PAGES if page.endswith("/METHODS.md")} - {"specimens/METHODS.md"}
        self.assertEqual(listed, pages)
        rooms = re.search(r"foreach\(room ([^)]+)\)\n  install\(FILES \S+/METHODS\.md", (TOP / "tools/CMakeLists.txt").read_text(encoding="utf-8"))[1].split()
        self.assertEqual({f"{room}/METHODS.md" for room in rooms}, pages | {"specimens/METHODS.md"})
        for page in pages:
            self.assertLessEqual(len(PAGES[page].encode()), 10_000, page)

    def test_files_that_contributing_names_are_there(self):
        named = re.findall(r"`((?:solver|specimens|tests|tools)/[\w./]+)`", PAGES["CONTRIBUTING.md"])
        self.assertGreaterEqual(len(named), 40)
        for path in named:
            self.assertTrue((TOP / path).exists(), f"CONTRIBUTING.md: {path}: found nothing")

    def test_page_of_files_is_what_the_program_prints(self):
        self.assertEqual(FILES, printed(PROGRAM, "test", "--files"), "make it again: crackle test --files > specimens/results/FILES.md")

    def results(self):
        for done in (self.unfailed, *self.confined):
            self.assertEqual(done.returncode, 0, done.stderr)
        return [self.folder / "out" / name for name in ("pulled", "squeezed", "verified", "unfailed", "granite", "confined", "confined_unfailed", JOINTED)]

    def test_files_are_those_of_a_test(self):
        for results in self.results():
            expected = table(FILES, "`crackle test CASE.toml -o OUT` leaves")
            for on_request in ("slips.csv", "ae.csv"):
                expected.remove(on_request)
            if json.loads((results / "summary.json").read_text(encoding="utf-8"))["specimen"] == "circles":
                expected.remove("specimen_polygons.dat")
            self.assertCountEqual(expected, [entry.name for entry in results.iterdir()])

    def test_columns_are_those_of_the_files(self):
        for results in self.results():
            for name in ("curve", "events"):
                header = (results / f"{name}.csv").read_text(encoding="utf-8").splitlines()[0]
                columns = table(FILES, f"## `{name}.csv`")
                if name == "curve" and "confined" not in results.name:
                    columns.remove("confinement_work")
                if name == "events" and results.name != JOINTED:
                    columns.remove("trace")
                self.assertEqual(columns, header.split(","))

    def test_keys_are_those_of_summaries(self):
        found = set()
        for done in self.others:
            self.assertEqual(done.returncode, 0, done.stderr)
        for results in (*self.results(), *(self.folder / "out" / name for name in OTHERS)):
            found |= {declared(name) for name in flat(json.loads((results / "summary.json").read_text(encoding="utf-8")))}
        self.assertEqual(sorted(set(table(FILES, "## `summary.json`")) ^ (found - CONTAINERS)), [])

    def test_arrays_are_those_of_the_frames(self):
        for results in self.results():
            jointed = results.name == JOINTED
            for name in ("particles", "contacts", "cracks", *(["joints"] if jointed else [])):
                poly = ElementTree.parse(min((results / "frames").glob(f"{name}_*.vtp"))).find("PolyData")
                arrays = table(FILES, f"Cell data of `{name}`:")
                if name == "cracks" and not jointed:
                    arrays.remove("trace")
                arrays = [array for array in arrays if array not in ("moment", "stress_begin", "stress_end", "slip") or name == "joints"]  # only with faces
                self.assertEqual(arrays, [array.get("Name") for array in poly.find("Piece/CellData")])
                self.assertEqual(table(FILES, "Field data of all of them:"), [array.get("Name") for array in poly.find("FieldData")])
            patterns = [name.replace("NNNNN", "*") for name in table(FILES, "## `frames/`")]
            for file in (results / "frames").iterdir():
                self.assertTrue(any(file.match(pattern) for pattern in patterns), f"{file.name}: not on the page")

    def test_commands_are_those_of_the_program(self):
        commands = re.findall(r"^  (\w+)  +\w", printed(PROGRAM, "--help"), re.MULTILINE)
        self.assertCountEqual([row.split()[1] for row in table(README, "## Commands")], commands)

    def test_rooms_are_those_of_the_tree(self):
        top, named = "", set()
        for row in re.findall(r"^\| (.+?) \|", README[README.index("## Where things are"):], re.MULTILINE)[2:]:
            names = re.findall(r"`([\w/]+)`", row)
            top = top if row.startswith("—") else names.pop(0)
            named |= {top} | {f"{top}{name}/" for name in names}
        for room in named:
            self.assertTrue((TOP / room).is_dir(), f"{room}: found no such folder")
        for room in ("solver", "specimens"):
            there = {f"{room}/{entry.name}/" for entry in (TOP / room).iterdir() if entry.is_dir()}
            self.assertLessEqual(there, named)

    def test_links_lead_somewhere(self):
        for page, text in PAGES.items():
            for link, _, heading in (found.partition("#") for found in re.findall(r"\]\(([^)]+)\)", text)):
                to = (TOP / page).parent.joinpath(link) if link else TOP / page
                self.assertTrue(to.exists(), f"{page}: {link}: found nothing")
                if heading:
                    self.assertIn(heading, anchors(to.read_text(encoding="utf-8")), f"{page}: {link}: found no such heading")


if __name__ == "__main__":
    unittest.main()
