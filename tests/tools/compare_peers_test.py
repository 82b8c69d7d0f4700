#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests tests/benchmarks/peers/compare_peers with fake programs instead of crackle and the peers: ratios, medians, exit codes, messages."""
import csv
import importlib.machinery
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1] / "benchmarks" / "peers"
SCRIPT = FOLDER / "compare_peers"

# DEMseg writes exponents with d.
DISCS = [(0.01, 0.01, 0.01), (0.03, 0.01, 0.0101), (0.01, 0.03, 0.0102), (0.03, 0.03, 0.01)]
PACKING = "1 0 0\n1d-4 0 0\n1\n2500 1e7 2.5d6 0 0 45\n0 0.04 0 0.04 0\n4 0 0\n" + "".join(
    f"{number} 1 1\n0 0 0\n1 {radius}\n{x} {y} 0\n" for number, (x, y, radius) in enumerate(DISCS, 1))

# A fake program takes its particle-steps per second from the next line of NAME.rates; the last line is repeated.
NEXT_RATE = """
import json, pathlib, sys
FAKES = pathlib.Path(__file__).parent
def next_rate(name):
    path = FAKES / (name + ".rates")
    rates = path.read_text().split()
    path.write_text("\\n".join(rates[1:] or rates))
    return float(rates[0])
"""
CRACKLE = NEXT_RATE + f"""
words = dict(zip(sys.argv, sys.argv[1:]))
if sys.argv[1] == "pack":
    assert words["--count"] == "4"
    pathlib.Path(words["-o"]).write_text({PACKING!r})
else:
    (FAKES / "case.toml").write_text(pathlib.Path(sys.argv[2]).read_text())
    out = pathlib.Path(words["-o"])
    out.mkdir(exist_ok=True)
    # Timed runs are recognised by their 20 steps, the smallest number; the runs before them, which find start-up time
    # and steps, have more.
    case = dict(line.split(" = ") for line in pathlib.Path(sys.argv[2]).read_text().splitlines() if " = " in line)
    asked = round(float(case["max_axial_strain"]) / float(case["axial_strain_rate"]) / 2e-4)
    steps, particles = 1000, 4
    json.dump({{"steps": steps, "step_seconds": particles * steps / (next_rate("crackle") if asked == 20 else 1), "contacts_initial": 6, "version": "0.0.1", "time_step": 2e-4,
               "bonds_initial": 6, "bonds_broken": 0}}, open(out / "summary.json", "w"))
"""
# Half a processor, as on a busy machine.
PYTHON_PEER = NEXT_RATE + """
script, job = pathlib.Path(sys.argv[-2]), json.load(open(sys.argv[-1]))
(FAKES / (script.stem + ".job")).write_text(json.dumps(job))
seconds = 4 * job["steps"] / next_rate(script.stem)
print("some words")
print("RESULT " + json.dumps({"version": "1.2", "steps": job["steps"], "seconds": seconds, "processor_seconds": seconds / 2, "contacts": 8,
"bonds": 6,
                              "broken": 2, "peak_stress": 1.0}))
"""
LAMMPS = NEXT_RATE + """
steps = int(sys.argv[sys.argv.index("steps") + 1])
(FAKES / "discs.data").write_text(pathlib.Path(sys.argv[sys.argv.index("data") + 1]).read_text())
print("LAMMPS (1 Jan 2000)")
for share, number in ((90, steps // 10), (50, steps), (200, 0)):
    print(f"Loop time of {4 * number / next_rate('lammps') if number == steps else 1e-6} on 1 procs for {number} steps with 4 atoms")
    print(f"{share}% CPU use with 1 MPI tasks x 1 OpenMP threads")
print("CONTACTS 4")
"""
FAILING = "import sys\nprint('first line')\nprint('\\n'.join(f'line {n}' for n in range(30)))\nprint('out of discs', file=sys.stderr)\nsys.exit(3)\n"


class ComparePeers(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.fakes = self.folder / "fakes"
        self.fakes.mkdir()
        self.packing = self.folder / "in_gm.dat"
        self.packing.write_text(PACKING)
        self.install("crackle", CRACKLE, crackle=[50])

    def install(self, name, text, **rates):
        program = self.fakes / name
        program.write_text(f"#!{sys.executable}\n{text}")
        program.chmod(0o755)
        for model, values in rates.items():
            (self.fakes / f"{model}.rates").write_text("\n".join(map(str, values)))

    def compare(self, *more, packing=True):
        words = [sys.executable, SCRIPT, "--crackle", self.fakes / "crackle", "--out", self.folder / "out", "--seconds", "1", "-q"]
        words += ["--packing", self.packing] if packing else []
        # Only the fakes are on the PATH, so installed peers are not found.
        return subprocess.run(words + list(map(str, more)), capture_output=True, text=True, env={**os.environ, "PATH": str(self.fakes)})

    def rows(self, study="rate"):
        with open(self.folder / "out" / "peers.csv", newline="", encoding="utf-8") as file:
            return {(row["code"], row["model"].split()[0]): row for row in csv.DictReader(file) if row["study"] == study}

    def page(self):
        return (self.folder / "out" / "peers.md").read_text(encoding="utf-8")

    def test_peers_that_are_not_installed_are_named(self):
        done = self.compare("--repeats", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, self.page())
        self.assertIn("| 4 | YADE | frictional | not installed: apt-get install yade |", done.stdout)
        self.assertIn("not installed: apt-get install lammps", done.stdout)
        self.assertIn("| 4 | ESyS-Particle | bonded | not installed: apt-get install esys-particle openmpi-bin |", done.stdout)
        self.assertEqual({row["state"] for row in self.rows().values()},
                         {"done", *(f"not installed: apt-get install {p}" for p in ("yade", "lammps", "esys-particle openmpi-bin"))})
        asked = self.compare("--repeats", 1, "--peers", "yade")
        self.assertEqual(asked.returncode, 0, asked.stderr)
        self.assertNotIn("LAMMPS", asked.stdout)

    def test_ratios_are_those_of_medians(self):
        # The first rate is that of the pilot run. Medians differ from means, and from the first and the last value.
        self.install("crackle", CRACKLE, crackle=[900, 100, 600])
        self.install("yade", PYTHON_PEER, yade_bonded=[1, 10, 30, 2000], yade_frictional=[1, 60, 9000, 40])
        self.install("lmp", LAMMPS, lammps=[1, 300, 1, 200])
        self.install("esysparticle", "")
        self.install("mpirun", PYTHON_PEER, esys_bonded=[1, 120, 120, 120], esys_frictional=[1, 150, 150, 150])
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        expected = {("Crackle", "bonded,"): 600, ("YADE", "bonded"): 30, ("YADE", "frictional"): 60, ("LAMMPS", "granular"): 200,
                    ("ESyS-Particle", "bonded"): 120, ("ESyS-Particle", "frictional"): 150}
        self.assertEqual(set(rows), set(expected))
        ours = float(rows["Crackle", "bonded,"]["particle_steps_a_processor_second"])
        self.assertGreaterEqual(ours, 599)
        for name, rate in expected.items():
            row = rows[name]
            self.assertAlmostEqual(float(row["particle_steps_a_second"]), rate, places=6)
            self.assertAlmostEqual(float(row["ours_over_theirs"]), 600 / rate, places=6)
            self.assertEqual(row["repeats"], "3")
            if name[0] != "Crackle":
                self.assertAlmostEqual(float(row["particle_steps_a_processor_second"]), 2 * rate, places=6)
                self.assertAlmostEqual(float(row["share_of_a_processor"]), 0.5, places=6)
                self.assertAlmostEqual(float(row["ours_over_theirs_processor"]) / (ours / (2 * rate)), 1, places=6)
        self.assertAlmostEqual(float(rows["Crackle", "bonded,"]["contacts_a_particle"]), 1.5)
        self.assertAlmostEqual(float(rows["YADE", "bonded"]["contacts_a_particle"]), 2)
        self.assertIn("LAMMPS 1 Jan 2000", self.page())
        self.assertRegex(self.page(), r"\| 4 \| YADE \| bonded \(JCFpm\), compressed \| 2\.00 \| .* \| 20\.0 \| .* \| 50% \|")

    def test_everybody_gets_the_same_discs(self):
        self.install("yade", PYTHON_PEER, yade_bonded=[1], yade_frictional=[1])
        self.install("lmp", LAMMPS, lammps=[1])
        self.assertEqual(self.compare("--repeats", 1, "--count", 4, packing=False).returncode, 0)
        job = json.loads((self.fakes / "yade_bonded.job").read_text())
        self.assertEqual(job["discs"], [list(disc) for disc in DISCS])
        self.assertEqual((job["box"], job["density"], job["normal_stiffness"], job["shear_stiffness"]), ([0, 0.04, 0, 0.04], 2500, 1e7, 2.5e6))
        self.assertAlmostEqual(job["friction"], 1)
        self.assertEqual(job["time_step"], 2e-4)  # the time step that crackle derived
        atoms = [line.split() for line in (self.fakes / "discs.data").read_text().partition("# sphere\n")[2].split("\n") if line]
        self.assertEqual([(float(x), float(y), float(d) / 2) for _, _, d, _, x, y, _ in atoms], DISCS)
        self.assertIn("threads = 1\n", (self.fakes / "case.toml").read_text())

    def test_a_peer_that_fails_shows_its_last_lines_and_the_others_go_on(self):
        self.install("yade", FAILING)
        self.install("lmp", LAMMPS, lammps=[25])
        done = self.compare("--repeats", 1)
        self.assertEqual(done.returncode, 1)
        self.assertIn("YADE (yade_bonded.py) ended with 3, expected to end with 0; its last lines:", done.stderr)
        self.assertIn("line 29\n  out of discs\n", done.stderr)
        self.assertNotIn("first line", done.stderr)
        self.assertIn("failed: YADE", done.stderr)
        rows = self.rows()
        self.assertEqual(rows["YADE", "bonded"]["state"], "failed")
        self.assertEqual(rows["YADE", "bonded"]["ours_over_theirs"], "")
        self.assertAlmostEqual(float(rows["LAMMPS", "granular"]["ours_over_theirs"]), 2)

    def test_a_peer_without_a_result_has_failed(self):
        for text, words in (("print('RESULT {\"steps\": 5}')", "without a usable result"), ("print('all well')", "found no line «RESULT ...»"),
                            ("print('RESULT ' + '{')", "without a usable result"),
                            ("print('RESULT {\"steps\": 5, \"seconds\": 0, \"processor_seconds\": 1, \"contacts\": 1, \"version\": \"1\"}')", "found 5 steps in 0 s")):
            self.install("yade", text)
            done = self.compare("--repeats", 1, "--peers", "yade")
            self.assertEqual(done.returncode, 1, text)
            self.assertIn(words, done.stderr)
        self.install("yade", "import time\nprint('still at it', flush=True)\ntime.sleep(60)")
        done = self.compare("--repeats", 1, "--peers", "yade", "--limit", 5)
        self.assertEqual(done.returncode, 1)
        self.assertIn("was stopped after 5 s", done.stderr)
        self.assertIn("still at it", done.stderr)

    def test_nothing_is_compared_without_ours(self):
        self.install("crackle", FAILING)
        done = self.compare()
        self.assertEqual(done.returncode, 1)
        self.assertIn("crackle test ended with 3", done.stderr)
        self.assertIn("out of discs", done.stderr)
        self.assertFalse((self.folder / "out" / "peers.md").exists())

    def test_compression_compares_whole_processes(self):
        self.install("yade", PYTHON_PEER, yade_bonded=[1], yade_frictional=[1])
        done = self.compare("--repeats", 1, "--compression")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("compression")
        self.assertEqual(set(rows), {("Crackle", "bonded"), ("YADE", "bonded")})
        ours, theirs = rows["Crackle", "bonded"], rows["YADE", "bonded"]
        self.assertAlmostEqual(float(theirs["theirs_over_ours_whole"]), float(theirs["whole_seconds"]) / float(ours["whole_seconds"]), places=6)
        self.assertEqual((theirs["bonds"], theirs["broken"], theirs["steps"]), ("6", "2", "30000"))
        job = json.loads((self.fakes / "yade_bonded.job").read_text())
        self.assertEqual((job["strain_a_step"], job["stop_below"], job["warm_up"]), (1e-7, 0.5, 0))
        case = (self.fakes / "case.toml").read_text()
        self.assertIn("max_axial_strain = 0.003\n", case)
        self.assertIn("axial_strain_rate = 0.0005\n", case)  # 1e-7 per step of 2e-4 s
        self.assertIn("## Compression: 1e-07 axial strain a step", self.page())

    def test_bad_arguments_are_named(self):
        polygons, cut = self.folder / "polygons.dat", self.folder / "cut.dat"
        polygons.write_text(PACKING.replace("\n4 0 0\n", "\n4 1 0\n"))
        cut.write_text(PACKING[:-20])
        words = self.folder / "words.dat"
        words.write_text("not a packing")
        for more, message in ((("--crackle", "nowhere/crackle"), "expected the built program"), (("--seconds", "0"), "found 0, expected a number above 0"),
                              (("--seconds", "inf"), "found inf, expected a number above 0"), (("--repeats", "two"), "found two, expected a whole number above 0"),
                              (("--count", "-5"), "expected a whole number above 0"), (("--peers", "box2d"), "invalid choice: 'box2d'"),
                              (("--packing", "nowhere.dat"), "nowhere.dat"), (("--packing", polygons), "1 bodies of segments, expected circles only"),
                              (("--packing", cut), "found its end"), (("--packing", words), "expected an in_gm.dat")):
            done = self.compare(*more)
            self.assertEqual(done.returncode, 2, more)
            self.assertIn(message, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_help_shows_examples_and_exit_codes(self):
        done = subprocess.run([sys.executable, SCRIPT, "--help"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        self.assertIn("examples:", done.stdout)
        self.assertIn("exit codes:", done.stdout)


class Inputs(unittest.TestCase):
    def test_each_is_there_and_python_reads_it(self):
        loader = importlib.machinery.SourceFileLoader("compare_peers", str(SCRIPT))
        spec = importlib.util.spec_from_loader("compare_peers", loader)
        module = importlib.util.module_from_spec(spec)
        sys.modules["compare_peers"] = module
        written, sys.dont_write_bytecode = sys.dont_write_bytecode, True
        try:
            loader.exec_module(module)
        finally:
            sys.dont_write_bytecode = written
        scripts = [script for peer in module.PEERS.values() for script in peer.models.values()]
        self.assertEqual(len(scripts), 5)
        for script in scripts + ["yade_discs.py", "esys_discs.py"]:
            text = (FOLDER / script).read_text(encoding="utf-8")
            self.assertIn("Source: ", text) if script in scripts else None
            if script.endswith(".py"):
                compile(text, script, "exec")


if __name__ == "__main__":
    unittest.main()
