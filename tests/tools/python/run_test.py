#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests virtual tests that are run from Python. They give the same bytes as the command line. Callbacks observe, stop and drive
them. After an error, the files written so far are kept."""
import contextlib
import gc
import io
import os
import signal
import subprocess
import sys
import tempfile
import threading
import types
import unittest
from pathlib import Path

import numpy

import crackle
from small import CASE, PLAN, TOP, InScratch, program, small, toml, write_rock


class SameBytes(InScratch):
    def run_by_program(self, *words, case=CASE, output="by_program"):
        Path("case.toml").write_text(toml(case), encoding="utf-8")
        done = program("test", "case.toml", "-o", output, "-q", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return output

    def test_of_the_command_line(self):
        self.run_by_program()
        result = crackle.test("case.toml", "by_python")
        self.assert_same_results("by_program", "by_python", ("curve.csv", "events.csv", "case.toml"))
        self.assertGreater(result.summary["bonds_broken"], 0)
        crackle.test(CASE, "by_dict")
        self.assert_same_results("by_program", "by_dict")

    def test_of_several_threads(self):
        # Enough bodies for two threads.
        case = small(packing={"count": 4000, "radius_min": 0.00163, "radius_max": 0.00326, "mean_overlap": 1e-5},
                     loading={"axial_strain_rate": 0.2, "max_axial_strain": 2e-5})
        self.run_by_program(case=case)
        result = crackle.test(case, "by_python", threads=2)
        self.assertEqual(result.summary["threads"], min(2, len(os.sched_getaffinity(0))))
        self.assert_same_results("by_program", "by_python")

    def test_of_a_test_that_is_looked_at(self):
        self.run_by_program()
        seen = []
        crackle.test(CASE, "rows", call=lambda state: seen.append(state.bodies["y"].sum()))
        self.assertGreater(len(seen), 100)
        self.assert_same_results("by_program", "rows")
        crackle.test(CASE, "steps", every=137, call=lambda state: seen.append(state.contacts()))
        self.assert_same_results("by_program", "steps")

    def test_of_a_test_by_tolerance_that_is_looked_at(self):
        case = small(loading={"axial_strain_rate": None, "rate_tolerance": 0.1, "max_axial_strain": 0.001})
        kept = []
        crackle.test(case, "unseen")
        crackle.test(case, "seen", every=101, call=lambda state: kept.append(state.bodies))
        self.assert_same_results("unseen", "seen")
        self.assertGreater(len(kept), 3)

    def test_after_an_interrupt_and_a_restart(self):
        self.run_by_program()

        def stop_half_way(state):
            if state.axial_strain > 0.0003:
                raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt) as raised:
            crackle.test(CASE, "by_python", call=stop_half_way)
        self.assertIn("kept in by_python; crackle.read reads them, and crackle.resume", str(raised.exception))
        self.assertTrue(crackle.read("by_python").summary["interrupted"])
        result = crackle.resume("by_python")
        self.assertFalse(result.summary["interrupted"])
        self.assert_same_results("by_program", "by_python")

    def test_in_a_folder_that_goes_with_the_result(self):
        result = crackle.test(CASE)
        folder = Path(result.folder)
        self.assertTrue((folder / "curve.csv").is_file())
        self.run_by_program()
        self.assert_same_results("by_program", folder)
        curve = result.curve
        del result
        self.assertFalse(folder.exists())
        self.assertGreater(curve.axial_stress.max(), 0.0)

    def test_in_a_folder_that_stays_where_the_test_does_not_end(self):
        os.environ["TMPDIR"], tempfile.tempdir = os.getcwd(), None
        self.addCleanup(setattr, tempfile, "tempdir", None)
        self.addCleanup(os.environ.pop, "TMPDIR")
        self.run_by_program()

        def stop_half_way(state):
            if state.axial_strain > 0.0003:
                raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt) as raised:
            crackle.test(CASE, call=stop_half_way)
        folder, = Path().glob("crackle-*/test")
        self.assertIn(str(folder.resolve()), str(raised.exception))
        self.assertTrue(crackle.read(folder).summary["interrupted"])
        self.assertFalse(crackle.resume(folder).summary["interrupted"])
        self.assert_same_results("by_program", folder)
        # A test that is refused before it begins leaves no files.
        with self.assertRaises(crackle.InputError) as refused:
            crackle.test(small(loading={"axial_strain_rate": 1e-12}))
        self.assertFalse(hasattr(refused.exception, "__notes__"))
        gc.collect()
        self.assertEqual(list(Path().glob("crackle-*/test")), [folder])


class Callbacks(InScratch):
    def test_rows_are_those_of_the_curve(self):
        strains, stresses = [], []

        def look(state):
            row = state.rows[-1]
            strains.append(row["axial_strain"])
            stresses.append(row["axial_stress"])
            self.assertEqual(state.row()["axial_stress"], row["axial_stress"])
            self.assertEqual(state.axial_strain, row["axial_strain"])
        result = crackle.test(CASE, call=look)
        judged = {strain: stress for strain, stress in zip(strains, stresses)}
        for strain, stress in list(zip(result.curve.axial_strain, result.curve.axial_stress))[:-1]:
            self.assertEqual(judged[strain], stress)

    def test_events_are_those_since_the_last_call(self):
        energies, counts = [], []

        def look(state):
            energies.extend(state.events["energy"])
            counts.append(state.bonds_broken)
        result = crackle.test(CASE, every=100, call=look)
        self.assertGreater(len(energies), 3)
        numpy.testing.assert_array_equal(energies, result.events.energy[:len(energies)])
        self.assertEqual(len(energies), counts[-1])

    def test_stop_ends_the_test_complete(self):
        def look(state):
            if state.axial_strain >= 0.0002:
                state.stop()
        for every in ("row", 50):
            with self.subTest(every=every):
                result = crackle.test(CASE, f"out_{every}", every=every, call=look)
                self.assertEqual(result.summary["ended_by"], "caller")
                self.assertFalse(result.summary["interrupted"])
                last = result.curve.axial_strain[-1]
                self.assertGreaterEqual(last, 0.0002)
                self.assertLess(last, 0.0002 + 2e-5)
                self.assertEqual(result.recording.frames[-1]["axial_strain"], last)
                self.assertIn("end", result.recording.frames[-1]["roles"])
                again = crackle.resume(f"out_{every}")
                self.assertEqual(again.curve.axial_strain[-1], last)

    def test_the_platen_goes_where_it_is_driven(self):
        # A saw-tooth below the strength: unloading follows the path of loading, except for forces of dashpots and
        # inertia.
        turns = iter([(0.00006, -1.0), (0.00002, 1.0), (0.0001, None)])
        self.turn = next(turns)

        def drive(state):
            at, sense = self.turn
            going_up = state.platen_speed > 0.0
            if (state.axial_strain >= at) != going_up:
                return
            if sense is None:
                state.stop()
                return
            state.platen_speed = sense * abs(state.platen_speed)
            self.turn = next(turns)
        result = crackle.test(CASE, every=10, call=drive)
        strain, stress = result.curve.axial_strain, result.curve.axial_stress
        self.assertEqual(result.summary["ended_by"], "caller")
        top = int(numpy.argmax(strain[:len(strain) // 2]))
        self.assertLess(strain[top:].min(), 0.000025)
        self.assertTrue(any("has controlled the speed of the driving part since a strain of" in text for text in result.summary["notices"]))
        modulus = result.summary["youngs_modulus"]
        # Loading at 0.02 1/s begins from rest: the jump of the platen's speed v sends a wave of stress sqrt(E ρ) v.
        wave = 2.0 * (modulus * CASE["material"]["density"]) ** 0.5 * 0.02 * result.summary["initial_height"]
        self.assertLess(numpy.abs(stress[1:] - modulus * strain[1:]).max(), 3.0 * wave)

    def test_a_speed_that_the_case_forbids(self):
        unloading = small(loading={"axial_strain_rate": None, "rate_tolerance": 0.1, "unload_at_strain": [0.0001]})

        def drive(state):
            state.platen_speed = 0.1
        with self.assertRaises(crackle.InputError) as refused:
            crackle.test(unloading, call=drive)
        self.assertIn("list of unloadings", str(refused.exception))

        def halt(state):
            state.platen_speed = 0.0
        with self.assertRaises(crackle.InputError) as refused:
            crackle.test(CASE, call=halt)
        self.assertIn("no further row is reached while the platen is at rest", str(refused.exception))

        def nothing(state):
            state.platen_speed = float("nan")
        with self.assertRaises(crackle.InputError):
            crackle.test(CASE, call=nothing)

    def test_what_a_callback_raises_ends_the_test_with_what_was_written_kept(self):
        def fail(state):
            if state.axial_strain > 0.0003:
                raise ZeroDivisionError("of the callback")
        with self.assertRaises(ZeroDivisionError) as raised:
            crackle.test(CASE, "out", call=fail)
        self.assertIn("of the callback", str(raised.exception))
        kept = crackle.read("out")
        self.assertGreater(kept.curve.axial_strain[-1], 0.00025)
        self.assertEqual(kept.summary["ended_by"], "interrupt")

    def test_a_state_kept_beyond_its_callback_says_so(self):
        kept = []
        crackle.test(CASE, call=kept.append)
        for use in (lambda s: s.bodies, lambda s: s.axial_strain, lambda s: s.row(), lambda s: s.contacts(),
                    lambda s: s.stop()):
            with self.assertRaises(RuntimeError) as refused:
                use(kept[0])
            self.assertIn("State used after its callback", str(refused.exception))

    def test_views_kept_beyond_their_callback_show_their_moment(self):
        views, copies = [], []

        def look(state):
            for array in (state.bodies, state.pairs, state.bonds, state.forces, state.rows, state.bond_overlaps):
                views.append(array)
                copies.append(array.copy())
        crackle.test(CASE, every=400, call=look)
        self.assertGreater(len(views), 30)
        for view, copy in zip(views, copies):
            self.assertEqual(view.tobytes(), copy.tobytes())
            self.assertFalse(view.flags.writeable)
            with self.assertRaises(ValueError):
                view[0] = view[0]

    def test_whole_numbers_of_numpy(self):
        steps = []
        crackle.test(CASE, every=numpy.int64(500), threads=numpy.int32(1), call=lambda state: steps.append(state.steps))
        self.assertEqual(set(numpy.diff(steps)), {500})

    def test_wrong_arguments(self):
        for wrong in (dict(every=0), dict(every=-5), dict(every="often"), dict(every=True), dict(every=1.5),
                      dict(every=numpy.array([5, 6])), dict(every=2**70), dict(threads=0), dict(threads="two"),
                      dict(threads=True), dict(threads=numpy.float64(2.0)), dict(threads=2**40)):
            with self.assertRaises(crackle.InputError, msg=wrong):
                crackle.test(CASE, call=lambda state: None, **wrong)
        with self.assertRaises(crackle.InputError) as refused:
            crackle.test(CASE, verify=True, call=lambda state: None)
        self.assertIn("verify", str(refused.exception))
        with self.assertRaises(TypeError):
            crackle.test(CASE, call=5)

    def test_reports_reach_a_callable(self):
        told = []
        crackle.test(CASE, progress=lambda kind, text, share: told.append((kind, text, share)))
        kinds = {kind for kind, _, _ in told}
        self.assertLessEqual({"stage", "work"}, kinds)
        self.assertTrue(any(text.startswith("bonded ") for kind, text, _ in told if kind == "stage"))

        def fail(kind, text, share):
            raise ArithmeticError("of the report")
        with self.assertRaises(ArithmeticError):
            crackle.test(CASE, progress=fail)

    def test_earlier_results_are_not_replaced_unasked(self):
        crackle.test(CASE, "out")
        before = Path("out/curve.csv").read_bytes()
        with self.assertRaises(crackle.InputError):
            crackle.test(CASE, "out")
        self.assertEqual(Path("out/curve.csv").read_bytes(), before)
        crackle.test(small(loading={"max_axial_strain": 0.0005}), "out", force=True)
        self.assertNotEqual(Path("out/curve.csv").read_bytes(), before)


class Progress(InScratch):
    """Progress is shown on a terminal and in a notebook, and nowhere else."""

    SCRIPT = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import crackle
from small import small
crackle.test(small(packing={{"count": 300}}))
"""

    def on_a_terminal(self, script):
        """The output of a script on a terminal."""
        pid, terminal = os.forkpty()
        if pid == 0:
            os.environ["TERM"] = "xterm"
            os.execv(sys.executable, [sys.executable, "-c", script])
        shown = b""
        try:
            while chunk := os.read(terminal, 4096):
                shown += chunk
        except OSError:  # the other end is closed
            pass
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), 0, shown)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-80:])
        return shown

    def test_a_terminal_shows_a_line_that_is_gone_in_the_end(self):
        self.assertIn(b"unbalanced by", self.on_a_terminal(self.SCRIPT))

    def test_a_terminal_shows_how_far_tables_of_tests_are(self):
        Path("case.toml").write_text(toml(small(loading={"max_axial_strain": 1e-4})), encoding="utf-8")
        Path("plan.toml").write_text(PLAN, encoding="utf-8")
        shown = self.on_a_terminal("import crackle; crackle.campaign('plan.toml', 'out', workers=1)")
        self.assertIn(b"  0 %  ", shown)
        self.assertIn(b"0 of 4 done, 0 without a result", shown)
        write_rock({"youngs_modulus": 1.4e10, "poissons_ratio": 0.25})
        shown = self.on_a_terminal("import crackle; crackle.calibrate('rock.toml', 'calibrated', workers=1)")
        self.assertIn(b"round 1: measuring the centre point on 4 packings", shown)
        self.assertIn(b"tests/s", shown)

    def test_tables_of_tests_report_to_a_callable(self):
        Path("case.toml").write_text(toml(small(loading={"max_axial_strain": 1e-4})), encoding="utf-8")
        Path("plan.toml").write_text(PLAN, encoding="utf-8")
        told = []
        crackle.campaign("plan.toml", "out", workers=1, progress=lambda *one: told.append(one))
        self.assertEqual(told[0][:2], ("stage", "4 tests of 2 points with 2 packings, 1 worker"))
        shares = [share for kind, _, share in told if kind == "progress"]
        self.assertEqual((shares[0], sorted(shares)), (0.0, shares))

        def fail(kind, text, share):
            raise ArithmeticError("of the report")
        with self.assertRaises(ArithmeticError) as raised:
            crackle.campaign("plan.toml", "again", workers=1, progress=fail)
        self.assertIn("finished work is kept in again", raised.exception.__notes__[0])

    def test_a_pipe_shows_nothing(self):
        done = subprocess.run([sys.executable, "-c", self.SCRIPT], capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))

    def test_a_notebook_shows_a_bar_that_is_gone_in_the_end(self):
        updates = []

        class ZMQInteractiveShell:
            pass

        class Handle:
            def update(self, shown):
                updates.append(shown)
        fake, display = types.ModuleType("IPython"), types.ModuleType("IPython.display")
        fake.get_ipython = ZMQInteractiveShell
        display.HTML = str
        told = io.StringIO()
        display.display = lambda shown, display_id: Handle()
        sys.modules.update({"IPython": fake, "IPython.display": display})
        fast = small(packing={"count": 300}, loading={"axial_strain_rate": 0.02})  # this rate causes a notice
        try:
            with contextlib.redirect_stderr(told):
                result = crackle.test(fast)
        finally:
            del sys.modules["IPython"], sys.modules["IPython.display"]
        self.assertTrue(any("unbalanced by" in text for text in updates))
        self.assertEqual(updates[-1], "")
        notices = result.summary["notices"]
        self.assertGreater(len(notices), 0)
        self.assertEqual(told.getvalue().splitlines(), [f"notice: {text}" for text in notices])


class Interrupts(InScratch):
    LONG = f"""
import sys, signal
sys.path.insert(0, {str(Path(__file__).parent)!r})
import crackle
from small import small
case = small(loading={{"axial_strain_rate": 1e-6}}, packing={{"count": 300}})
print("begun", flush=True)
"""

    def interrupted(self, body):
        script = self.LONG + body
        process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(process.kill)
        for line in process.stdout:
            if line.startswith("running"):
                break
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def test_ctrl_c_ends_a_test_that_can_be_gone_on_with(self):
        code, out, err = self.interrupted("""
def tell(kind, text, share):
    if kind == "progress":
        print("running", flush=True)
try:
    crackle.test(case, "out", long=True, progress=tell)
except KeyboardInterrupt:
    print("heard", crackle.read("out").summary["interrupted"], flush=True)
""")
        self.assertEqual((code, out.splitlines()[-1]), (0, "heard True"), err)

    def test_ctrl_c_ends_stepping(self):
        code, out, err = self.interrupted("""
world = crackle.World(case)
try:
    print("running", flush=True)
    while True:  # a signal between two calls is handled too
        world.step(10**9)
except KeyboardInterrupt:
    before = world.steps
    world.step(10)
    print("heard", world.steps - before, flush=True)
""")
        self.assertEqual((code, out.splitlines()[-1]), (0, "heard 10"), err)

    TELL = """
import time
def tell(kind, text, share):
    if kind == "progress" and share > 0:
        print("running", flush=True)
        time.sleep(0.3)  # the signal arrives before the work ends
"""

    def test_ctrl_c_ends_a_campaign_that_the_same_call_goes_on_with(self):
        Path("case.toml").write_text(toml(CASE), encoding="utf-8")
        Path("plan.toml").write_text(PLAN.replace("count = 2", "count = 30"), encoding="utf-8")
        code, out, err = self.interrupted(self.TELL + """
try:
    crackle.campaign("plan.toml", "out", workers=1, progress=tell)
except KeyboardInterrupt as interrupt:
    print("heard", interrupt, flush=True)
""")
        self.assertEqual(code, 0, err)
        self.assertEqual(out.splitlines()[-1], "heard finished work is kept in out; the same call resumes")
        self.assertEqual(err, "")
        before = sum(state is not None for state in crackle.read("out").results.state)
        self.assertGreater(before, 0)
        self.assertLess(before, 60)
        told = []
        results = crackle.campaign("plan.toml", "out", workers=2, progress=lambda *one: told.append(one)).results
        self.assertNotIn(None, results.state)
        self.assertEqual(next(share for kind, _, share in told if kind == "progress"), before / 60)

    def test_ctrl_c_ends_a_calibration_that_the_same_call_goes_on_with(self):
        write_rock({"youngs_modulus": 1.4e10, "poissons_ratio": 0.25})
        code, out, err = self.interrupted(self.TELL + """
try:
    crackle.calibrate("rock.toml", "out", workers=1, progress=tell)
except KeyboardInterrupt as interrupt:
    print("heard", interrupt, flush=True)
""")
        self.assertEqual(code, 0, err)
        self.assertIn("heard finished work is kept in out", out.splitlines()[-1])
        self.assertFalse(Path("out/calibration.json").exists())
        self.assertEqual(len(crackle.calibrate("rock.toml", "out").outcome["keys"]), 2)

    def test_other_threads_run_while_a_test_does(self):
        ticks = []
        over = threading.Event()

        def tick():
            while not over.wait(0.001):
                ticks.append(1)
        thread = threading.Thread(target=tick)
        thread.start()
        world = crackle.World(CASE)
        before = len(ticks)
        world.step(30_000)
        over.set()
        thread.join()
        self.assertGreater(len(ticks) - before, 10)

    def test_a_test_in_another_thread(self):
        found = []
        thread = threading.Thread(target=lambda: found.append(crackle.test(CASE).summary["peak_stress"]))
        thread.start()
        thread.join()
        self.assertEqual(found, [crackle.test(CASE).summary["peak_stress"]])

    @unittest.skipUnless(hasattr(os, "fork"), "no fork")
    def test_a_forked_process_with_threads_is_refused_not_hung(self):
        for use in (lambda world: world.step(10), lambda world: world.row(), lambda world: world.forces,
                    lambda world: world.contacts()):
            world = crackle.World(small(packing={"count": 300}), threads=2)
            world.step(10)
            asked = world.threads
            child = os.fork()
            if child == 0:
                signal.alarm(30)  # ends a process that hangs
                try:
                    use(world)
                    os._exit(0 if asked == 1 else 1)
                except crackle.InputError as refused:
                    os._exit(0 if "spawn" in str(refused) else 2)
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)


if __name__ == "__main__":
    unittest.main()
