#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that cases in Python have the same keys, defaults and error messages as on the command line."""
import ast
import copy
import inspect
import math
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

import crackle
from crackle import _engine
from small import CASE, TOP, InScratch, program, small, toml


class Cases(InScratch):
    def test_a_dict_a_text_and_a_file_are_one_case(self):
        Path("case.toml").write_text(toml(CASE), encoding="utf-8")
        resolved = crackle.read_case(CASE).resolved()
        self.assertIn("normal_stiffness = 10000000", resolved)
        self.assertEqual(crackle.read_case(toml(CASE)).resolved(), resolved)
        self.assertEqual(crackle.read_case("case.toml").resolved(), resolved)
        self.assertEqual(crackle.read_case(Path("case.toml")).resolved(), resolved)

    def test_numbers_of_numpy_and_absent_keys(self):
        case = small(packing={"count": numpy.int64(60), "seed": numpy.int32(1)},
                     material={"density": numpy.float64(2500.0), "tensile_strength": None})
        self.assertEqual(crackle.read_case(case).resolved(), crackle.read_case(CASE).resolved())

    def test_lists_of_tables(self):
        case = small(material={"units": "area", "normal_stiffness": None, "shear_stiffness": None,
                               "contact_modulus": 2e10, "stiffness_ratio": 2.5, "tensile_strength": 1e7,
                               "cohesion": 5e7},
                     bond={"law": "coulomb"}, mineral=None)
        case["mineral"] = [{"name": "quartz", "area_share": 0.3}, {"name": "feldspar", "contact_modulus": 1e10}]
        self.assertIn("quartz", crackle.read_case(case).resolved())
        case["mineral"][0]["area_share"] = -1
        with self.assertRaises(crackle.InputError) as refused:
            crackle.read_case(case)
        self.assertEqual(refused.exception.key, "mineral[1].area_share")

    def test_includes_lead_to_shipped_cases_from_anywhere(self):
        case = crackle.read_case({"include": "specimens/guide_rock/circles_tension.toml", "title": "mine"})
        self.assertEqual((case.title, case.kind), ("mine", "tension"))
        with self.assertRaises(crackle.InputError) as refused:
            crackle.read_case({"include": "nothing.toml"})
        self.assertIn("found no file", str(refused.exception))

    def test_a_refusal_is_the_command_lines(self):
        for change in ({"normal_stiffness": -1.0}, {"cohesive": 1.0}, {"density": "heavy"}):
            case = small(material=change)
            Path("case.toml").write_text(toml(case), encoding="utf-8")
            said = program("test", "case.toml", "-o", "out")
            self.assertEqual(said.returncode, 2)
            with self.assertRaises(crackle.InputError) as refused:
                crackle.test("case.toml", "out")
            self.assertEqual("crackle: " + str(refused.exception) + "\n", said.stderr)
            with self.assertRaises(crackle.InputError) as of_dict:
                crackle.test(case)
            line = refused.exception.where
            self.assertTrue(line.startswith("case.toml:"), line)
            self.assertEqual(str(of_dict.exception), str(refused.exception).replace(line, "case"))

    def test_parts_of_a_refusal(self):
        with self.assertRaises(crackle.InputError) as refused:
            crackle.read_case(small(material={"normal_stiffness": -1.0}))
        error = refused.exception
        self.assertEqual((error.where, error.key, error.found), ("case", "material.normal_stiffness", "-1"))
        self.assertIn("> 0", error.expected)
        self.assertIsInstance(error, ValueError)
        self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))

    def test_a_path_with_an_equals_sign(self):
        Path("seed=1").mkdir()
        for path in ("seed=1/case.toml", "seed=1/case"):
            Path(path).write_text(toml(CASE), encoding="utf-8")
            self.assertEqual(crackle.read_case(path).resolved(), crackle.read_case(CASE).resolved())
        with self.assertRaises(crackle.InputError) as refused:
            crackle.read_case("seed=2/case.toml")
        self.assertIn("seed=2/case.toml: found no such file", str(refused.exception))
        self.assertEqual(crackle.read_case('include = "seed=1/case.toml"').title, CASE["title"])

    def test_parts_of_other_messages(self):
        crackle.test(small(loading={"max_axial_strain": 1e-5}), "done")
        parts = ("where", "key", "found", "expected", "remedy")
        for raised, *expected in (
                (lambda: crackle.read_case("no.toml"), "no.toml", None, "no such file", "a case file",
                 "check the path"),
                (lambda: crackle.read("nothing"), "nothing", None, "no such file or folder",
                 "the folder of a test or of a deck, or a particle file", None),
                (lambda: crackle.read_case("a = ["), "case:1", None,
                 "not valid TOML: Error while parsing array: encountered end-of-file", None, None),
                (lambda: crackle.test(CASE, "done"), "done", None, "results", "an empty or new folder",
                 "--force replaces them, --resume continues them"),
                (lambda: crackle.test(CASE, "/proc/none/out"), "/proc/none/out", None,
                 "cannot be written (No such file or directory)", "a writable folder with free space", None),
                (lambda: crackle.pack(count=50.5), "crackle pack", "--count", "50.5", "a whole number",
                 "see crackle pack --help"),
                (lambda: crackle.read_case(small(loading={"unload_at_strain": [None]})), "case",
                 "loading.unload_at_strain[1]", "null", "a value", "leave it out"),
                (lambda: crackle.read_case({"packing": 3}), "case", "packing", "a whole number", "a table of keys",
                 "write [packing] above them"),
                (lambda: crackle.test(CASE, every=0), None, "every", "0", "\"row\" or a number of steps >= 1", None)):
            with self.assertRaises(crackle.InputError) as refused:
                raised()
            self.assertEqual([getattr(refused.exception, part) for part in parts], expected, str(refused.exception))

    def test_what_no_case_can_be(self):
        for wrong, words in ((5, "found a int"),
                             ({"packing": {"count": object()}}, "packing.count: found a object"),
                             ({"packing": {"count": 2**70}}, "64 bits"), ({1: {}}, "found a key 1"),
                             ({"material": {"density": math.nan}}, "material.density: found nan"),
                             ("a = [", "case:1: not valid TOML"), ({"packing": 5}, "packing"), ({}, "case: "),
                             ("no_such.toml", "found no such file"), ("", "case: found an empty text"),
                             ([], "found a list"),
                             ({"packing": {"count": {"a": {"b": 1}}}}, "packing.count: found a table")):
            with self.assertRaises(crackle.InputError, msg=wrong) as refused:
                crackle.read_case(wrong)
            self.assertIn(words, str(refused.exception))

    def test_all_keys_are_told(self):
        self.assertEqual(crackle.case_keys(), program("test", "--keys").stdout)


class Importing(unittest.TestCase):
    def test_importing_loads_no_numpy(self):
        # Modules that make an import slow are loaded only when needed.
        script = "import crackle, sys; print('numpy' in sys.modules, 'IPython' in sys.modules)"
        told = subprocess.run([sys.executable, "-c", script],
                              capture_output=True, text=True, check=True, env=os.environ).stdout
        self.assertEqual(told.split(), ["False", "False"])

    def test_another_python_is_told_which_is_expected(self):
        package = Path(crackle.__file__).parent
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(package, Path(folder) / "crackle", ignore=shutil.ignore_patterns("_engine*.so"))
            (Path(folder) / "crackle" / "_engine.cpython-399-none.so").touch()
            told = subprocess.run([sys.executable, "-c", "import crackle"], capture_output=True, text=True, check=False,
                                  env=os.environ | {"PYTHONPATH": folder})
        self.assertIn(f"ImportError: crackle: found {sys.executable}, ", told.stderr)
        self.assertIn("the Python that _engine.cpython-399-none.so was built for", told.stderr)

    def test_all_names_are_documented(self):
        self.assertIn("crackle.test(", crackle.__doc__)
        for name in crackle.__all__:
            if inspect.isfunction(getattr(crackle, name)):
                self.assertIn(name, crackle.__doc__)
            self.assertTrue(getattr(crackle, name).__doc__, name)
            if inspect.isclass(getattr(crackle, name)):
                for part, value in vars(getattr(crackle, name)).items():
                    if not part.startswith("_") and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, f"{name}.{part}")


class Stubs(unittest.TestCase):
    """The stubs that editors use for completion agree with the module."""

    @staticmethod
    def arguments(function):
        """Names of the parameters of a definition in the stubs."""
        return [one.arg for one in function.args.args if one.arg != "self"]

    def assert_same_arguments(self, name, stub, function):
        told = re.match(r"\w+\((.*?)\) -> ", function.__doc__).group(1)
        names = [one for one in re.findall(r"(?:^|, )(\w+): ", told) if one != "self"]
        self.assertEqual(self.arguments(stub), names, name)

    def test_name_what_the_engine_has(self):
        stubs = ast.parse((Path(crackle.__file__).parent / "_engine.pyi").read_text(encoding="utf-8")).body
        functions = {one.name: one for one in stubs if isinstance(one, ast.FunctionDef)}
        classes = {one.name: one for one in stubs if isinstance(one, ast.ClassDef)}
        there = {name: value for name, value in vars(_engine).items() if not name.startswith("_")}
        self.assertEqual(sorted([*functions, *classes]), sorted(there))
        for name, stub in functions.items():
            self.assert_same_arguments(name, stub, there[name])
        for name, stub in classes.items():
            own = {part: value for part, value in vars(there[name]).items()
                   if not part.startswith("_") or part == "__len__"}
            told = {part.target.id if isinstance(part, ast.AnnAssign) else part.name: part for part in stub.body
                    if not isinstance(part, ast.Expr)}
            told.pop("__init__", None)
            if name == "World":
                own["stop"] = None  # NoReturn in the stub, which the engine's signature cannot state
            self.assertEqual(sorted(told), sorted(own), name)
            for part, value in own.items():
                method = isinstance(told[part], ast.FunctionDef) and not told[part].decorator_list
                self.assertEqual(method, value is None or callable(value), f"{name}.{part}")
                if method and value is not None and value.__doc__ and part != "__len__":
                    self.assert_same_arguments(f"{name}.{part}", told[part], value)

    def test_public_functions_are_annotated(self):
        for name in crackle.__all__:
            public = getattr(crackle, name)
            for function in ([public] if inspect.isfunction(public) else
                             [value.fget if isinstance(value, property) else value
                              for part, value in vars(public).items() if part == "__init__" or not part.startswith("_")]
                             if inspect.isclass(public) and public.__module__ != "crackle._engine" else []):
                if not inspect.isfunction(function):
                    continue
                signature = inspect.signature(function)
                missing = [one.name for one in signature.parameters.values()
                           if one.name != "self" and one.annotation is inspect.Parameter.empty]
                self.assertEqual(missing, [], f"{name}.{function.__name__}")
                self.assertIsNot(signature.return_annotation, inspect.Signature.empty, f"{name}.{function.__name__}")


if __name__ == "__main__":
    unittest.main()
