#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tools/check_english on generated trees: each kind of text is read, each rule finds its sentence, and the list can only shrink."""

import importlib.machinery
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "check_english"
loader = importlib.machinery.SourceFileLoader("check_english", str(SCRIPT))
check_english = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_english", loader))
loader.exec_module(check_english)
LONG = " ".join(["word"] * 31) + "."
LIST = "tools/english_allowed.txt"


class CheckEnglish(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)
        self.write({"tools/check_english": SCRIPT.read_text(encoding="utf-8")})
        shutil.copymode(SCRIPT, self.tree / "tools/check_english")
        self.git("init", "-q")

    def git(self, *words):
        subprocess.run(["git", *words], cwd=self.tree, check=True, capture_output=True)

    def write(self, files):
        for path, text in files.items():
            file = self.tree / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")

    def checked(self, *words):
        self.git("add", "-A")
        done = subprocess.run([self.tree / "tools/check_english", *words], capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def expect_finding(self, path, text, *words):
        found = [f"{path}:{finding.line}: {finding.rule}: {finding.sentence}" for finding in check_english.findings_of(path, text)]
        self.assertEqual(len(found), 1, f"{path}: {text}: {found}")
        for word in words:
            self.assertIn(word, found[0])

    def expect_nothing(self, path, text):
        self.assertEqual(list(check_english.findings_of(path, text)), [], text)

    def test_a_sentence_has_at_most_thirty_words_in_every_kind_of_text(self):
        half = " ".join(["word"] * 16)
        for path, text, line in (("solver/a.cpp", f"int a;\n// {half}\n// {half}.\n", 2),
                                 ("solver/a.hpp", f"int a;  ///< {half}\n        ///< {half}\n", 1),
                                 ("solver/a.cpp", f"/* {LONG} */\n", 1),
                                 ("solver/a.cpp", f'int a;\nfail("{half} "\n     "{half}");\n', 2),
                                 ("solver/a.cpp", f'char quote = \'"\';\nfail(R"({LONG})");\n', 2),
                                 ("tools/viewer/a.ts", f"const a = `//`; // {LONG}\n", 1),
                                 ("tools/a.py", f'"""Title.\n\n{half}\n{half}\n"""\n', 3),
                                 ("tools/a.py", f"a = 1  # {LONG}\n", 1),
                                 ("tools/a", f"#!/usr/bin/env bash\n# {half}\n# {half}\n", 2),
                                 ("CMakeLists.txt", f"project(a)\n# {LONG}\n", 2),
                                 ("solver/A.md", f"# Title\n\n- {half}\n  {half}\n", 3),
                                 ("solver/A.md", f"| a | {LONG} |\n", 1)):
            with self.subTest(text):
                self.expect_finding(path, text, f"{path}:{line}: ", " words: at most 30 in a sentence: ")

    def test_what_ends_a_sentence(self):
        twenty = "Word" + " word" * 19
        for path, text in (("solver/a.cpp", f"// {twenty}.\n// {twenty}.\n"), ("solver/a.cpp", f"// {twenty}\n//\n// {twenty}\n"),
                           ("solver/a.cpp", f"// {twenty}\n//     x = {LONG}\n// {twenty}\n"), ("solver/a.hpp", f"/// {twenty}\n/// @return {twenty}\n"),
                           ("solver/a.hpp", f"int a;  // {twenty}\nint b;  // {twenty}\n"), ("solver/A.md", f"- {twenty}\n- {twenty}\n"),
                           ("solver/A.md", f"| {twenty} | {twenty} |\n"), ("solver/a.cpp", f'fail("{twenty}; {twenty}");\n')):
            with self.subTest(text):
                self.expect_nothing(path, text)

    def test_what_is_no_text(self):
        for path, text in (("solver/A.md", f"```sh\n{LONG}\n```\n"), ("solver/A.md", f"Link: [a]({LONG})\n"), ("tests/a_test.cpp", f'expect("{LONG}");\n'),
                           ("solver/a.dat", LONG), ("solver/a.cpp", f'run("SELECT {LONG}");\n'), ("solver/a.cpp", '#include "told.hpp"\nconst char* key = "none";\n')):
            with self.subTest(text):
                self.expect_nothing(path, text)

    def test_phrases_are_found(self):
        for sentence, rule in (("A result that nobody receives is none.", "«none»"), ("found a value, expected none", "«none»"), ("For so many numbers.", "«so many»"),
                               ("The run is gone on with.", "«go on with»"), ("Loading hears by itself.", "«hear»"), ("In the order in which they are told.", "«tell»"),
                               ("That the specimen is wide is not so.", "«is so»"), ("Drawn anew by the page.", "«anew»"), ("No word is owed here.", "«owed»"),
                               ("Takes no more than a second.", "«no more than»"), ("All but for the last.", "«but for»"), ("What moved is said.", "«is said»"),
                               ("The strain gone through.", "«gone through»"), ("The figures once more.", "«once more»"),
                               ("A long word, say, is cut.", "«, say»"), ("Each is higher by so much.", "«so much»")):
            with self.subTest(sentence):
                self.expect_finding("solver/a.cpp", f"// A title.\n// {sentence}\n".replace("// That", "// It is false: that"), rule)
                self.expect_finding("solver/a.cpp", f'fail("{sentence}");\n', rule)

    def test_how_a_comment_may_not_begin(self):
        for opening in ("Of two bodies.", "That of the first.", "Those of the second.", "The same of a text."):
            with self.subTest(opening):
                self.expect_finding("solver/a.cpp", f"int a;\n// {opening}\n", "solver/a.cpp:2: begins with a dangling")
        self.expect_finding("solver/a.hpp", "int a;  ///< Likewise.\n", "«Likewise» is the whole comment")
        self.expect_nothing("solver/a.cpp", "// The force of two bodies. Of these the first.\n")

    def test_plain_sentences_pass(self):
        for sentence in ("Fails if there is none.", "None is left.", "The step is so small that nothing moves.", "So the force vanishes.", "They differ so much that one is small.", "The word `told` is code.", "offset, thereof"):
            with self.subTest(sentence):
                self.expect_nothing("solver/a.cpp", f"// {sentence}\n")

    def test_allowed_findings_pass_as_often_as_they_are_listed(self):
        sentence = "For so many numbers."
        self.write({"solver/a.cpp": f"// {sentence}\n"})
        self.allow(1)
        self.assertEqual(self.checked(), (0, ""))
        self.assertIn(sentence, self.checked("--all")[1])
        self.write({"solver/b.cpp": f"int a;  // {sentence}\n"})
        code, out = self.checked()
        self.assertEqual((code, out.count(sentence)), (1, 1), out)
        self.assertEqual(self.checked("solver/a.cpp"), (0, ""))

    def test_an_entry_that_no_file_needs_fails_until_the_list_shrinks(self):
        self.write({"solver/a.cpp": "// For so many numbers.\n"})
        self.allow(2)
        code, out = self.checked()
        self.assertEqual(code, 1)
        self.assertIn("no file needs this entry any more; remove it with tools/check_english --shrink", out)
        self.assertEqual(self.checked("--shrink"), (0, ""))
        self.assertEqual(self.checked(), (0, ""))
        self.write({"solver/a.cpp": "// Room for n numbers.\n"})
        self.assertEqual(self.checked("--shrink"), (0, ""))
        self.assertEqual((self.tree / LIST).read_text(encoding="utf-8"), "")

    def test_shrinking_adds_nothing(self):
        self.write({"solver/a.cpp": "// For so many numbers.\n", LIST: ""})
        self.assertEqual(self.checked("--shrink")[0], 1)
        self.assertEqual((self.tree / LIST).read_text(encoding="utf-8"), "")

    def test_numbers_do_not_count_in_the_list(self):
        self.write({"solver/a.cpp": "// For so many numbers: 12.5 in 3.\n"})
        self.allow(1)
        self.write({"solver/a.cpp": "// For so many numbers: 1.25e-3 in 40.\n"})
        self.assertEqual(self.checked(), (0, ""))

    def test_an_unknown_word_is_refused(self):
        self.git("add", "-A")
        done = subprocess.run([self.tree / "tools/check_english", "--grow"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("found '--grow', expected", done.stderr)

    def allow(self, number):
        """Writes the list for the only finding, in solver/a.cpp."""
        [finding] = check_english.findings_of("solver/a.cpp", (self.tree / "solver/a.cpp").read_text(encoding="utf-8"))
        self.write({LIST: f"{number} {check_english.key_of(finding)} {finding.sentence}\n"})


if __name__ == "__main__":
    unittest.main()
